// SPDX-License-Identifier: MIT
// A plant of one's own: its first gains against numbers that were worked out by hand
// from Skogestad's table, and their margins; that what a person said of sensor, actuator
// and rate stays, whatever is fitted or tuned; and one slider for all gains, and a wanted Ms.
import { check, checkNone, choose, finish, fragment, frame, moduleOf, open, press, stale, text } from './harness.mjs';

const { calmAt, calmGains, gainsForMs, hasLine, placeOf, wishText } = await moduleOf('calm');
const { calmOf, simcGains, plantOfKind, withPlant } = await moduleOf('own');
const { firstRow } = await moduleOf('rules');
const { ofLink, presetState, withinReason } = await moduleOf('state');
const { run, startEngine } = await moduleOf('engine');
const { marginsOf } = await moduleOf('margins');
await startEngine();

// --- First gains, without a browser -------------------------------------------------
const LAGS = { PLANT: 0, GAIN: 100, T1: 10, T2: 0, DEAD: 1, SENSOR_RANGE: 100, OUTPUT_MIN: 0, OUTPUT_MAX: 1000, RATE: 10 };
const TWO = { ...LAGS, GAIN: 240, T1: 60, T2: 8, DEAD: 5, SENSOR_RANGE: 300, OUTPUT_MAX: 255 };
const INTEGRATOR = { ...TWO, PLANT: 2, GAIN: 6, T2: 1, DEAD: 0.5 };
const OSCILLATOR = { ...TWO, PLANT: 1, T1: 5, DAMPING: 0.3, DEAD: 0.2 };
const MOTOR = { PLANT: 4, GAIN: 24, T1: 26, T2: 4, DEAD: 0, SENSOR_RANGE: 480, OUTPUT_MIN: -255, OUTPUT_MAX: 255, RATE: 1000 };
// [plant, bits, kp, ki, kd]; a motor's by its exact poles, which are within 0.5 %.
const BY_HAND = [
    ['one lag', LAGS, 12, 1.16286, 0.138436, 0], ['one lag', LAGS, 10, 4.65484, 0.554148, 0],
    ['two lags', TWO, 12, 0.275231, 0.00430049, 0], ['two lags', TWO, 10, 1.10173, 0.0172146, 0],
    ['a negative gain', { ...TWO, GAIN: -240 }, 12, 0.275231, 0.00430049, 0],
    ['two lags, the longer one second', { ...TWO, T1: 8, T2: 60 }, 12, 0.275231, 0.00430049, 0],
    ['an integrator', INTEGRATOR, 12, 1.48264, 0.176505, 0], ['an integrator', INTEGRATOR, 10, 5.93493, 0.706539, 0],
    ['what oscillates', OSCILLATOR, 12, 0.0444793, 0.0148264, 0.370661], ['what oscillates', OSCILLATOR, 10, 0.178048, 0.0593493, 1.48373],
    ['a motor', MOTOR, 12, 0.508250, 41.6881, 0], ['a motor', MOTOR, 10, 2.03449, 166.875, 0],
];
for (const [name, plant, bits, ...wanted] of BY_HAND) {
    const { KP, KI, KD } = simcGains({ ...plant, SENSOR_BITS: bits });
    const limit = plant === MOTOR ? 0.005 : 0.0005; // the page rounds to four figures
    const away = Math.max(...[KP, KI, KD].map((one, i) => Math.abs(one - wanted[i]) / (wanted[i] || 1)));
    check(`${name} at ${bits} bits: kp ${KP}, ki ${KI}, kd ${KD}`, away <= limit, `not ${wanted.join(', ')}`);
}

const HARDWARE = ['SENSOR_BITS', 'SENSOR_LOW', 'SENSOR_RANGE', 'OUTPUT_MIN', 'OUTPUT_MAX', 'RATE', 'NOISE', 'unit'];
for (const bits of [12, 10]) {
    for (const [kind, name, more] of [[0, 'lags'], [2, 'integrator'], [1, 'oscillator'], [4, 'motor', { RATE: 1000, SENSOR_RANGE: 480, OUTPUT_MIN: -255, START: 0 }]]) {
        const mine = { ...presetState('own'), SENSOR_BITS: bits, ...more };
        const s = withinReason(withPlant(mine, plantOfKind(mine, kind)));
        const { n, results } = run(s);
        const margins = n > 0 ? marginsOf(s, results) : { ms: Infinity };
        check(`a ${name} that is chosen anew at ${bits} bits: Ms ${margins.ms.toFixed(2)}`, margins.stable && margins.ms < 2, 'above 2, or unstable');
        checkNone(`a ${name} at ${bits} bits leaves the hardware`, HARDWARE.filter((key) => s[key] !== mine[key]));
    }
}

// --- One slider for all gains, without a browser ----------------------------------------
{
    const LAG = { ...presetState('own'), GAIN: 100, T1: 10, T2: 0, DEAD: 1, SENSOR_BITS: 12, SENSOR_RANGE: 100, OUTPUT_MAX: 1000, RATE: 10 };
    const near = (value, right, part) => Math.abs(value - right) <= part * Math.abs(right);
    // By hand: a gain of 4.095 counts, a lag of 10 s, 1.05 s of dead time and hold; the loop's
    // time constant is 1.05 s times the first number.
    for (const [calm, kp, ki] of [[2, 0.775226, 0.0775226], [1, 1.16284, 0.138433], [0.5, 1.55045, 0.246104]]) {
        const { KP, KI, KD, ...others } = calmGains(LAG, calm);
        check(`${calm} times the time constant: kp ${KP}, ki ${KI}`, near(KP, kp, 5e-4) && near(KI, ki, 5e-4) && KD === 0 && Object.keys(others).join() === 'FILTER', `not ${kp}, ${ki}`);
    }
    const lines = ['p=oven', 'p=flow', 'p=spring', 'p=axis', 'p=motor', 'p=own', 'p=own&gain=-5&options=128', 'p=own&plant=1'].map(ofLink);
    const places = [0, 7, 33, 60, 90, 120];
    checkNone('gains of the line are found on it', lines.flatMap((s) => places.map((place) => [s, place, calmOf({ ...s, ...calmGains(s, calmAt(place)) })]))
        .filter(([, place, found]) => found === null || placeOf(found.calm) !== place).map(([s, place]) => `${s.preset} at ${place}`));
    checkNone('gains beside it are not', lines.flatMap((s) => [['KP', 1.01], ['KI', 1.01], ['KI', 0]].map(([key, factor]) => {
        const on = { ...s, ...calmGains(s, 0.7) };
        return [`${s.preset} ${key} times ${factor}`, calmOf({ ...on, [key]: on[key] * factor })];
    })).filter(([, found]) => found !== null).map(([name]) => name));
    check('nor are other presets’, none and those of a note’s controller', calmOf(ofLink('p=oven')) === null && calmOf({ ...LAG, KP: 0 }) === null && calmOf({ ...LAG, KP: -1 }) === null &&
        !hasLine(ofLink('p=an937')) && !hasLine(ofLink('p=an964')) && hasLine(ofLink('p=motor')));

    // --- A wanted Ms -----------------------------------------------------------------------
    const msOfGains = (gains) => marginsOf(LAG, run({ ...LAG, ...gains }).results).ms;
    for (const wish of [1.2, 1.4, 1.6, 2]) {
        const { gains, ms } = gainsForMs(LAG, wish);
        const own = msOfGains(gains);
        check(`Ms ${wish} has kp ${gains.KP}, ki ${gains.KI}: ${own.toFixed(3)}`, near(own, wish, 0.01) && near(ms, own, 0.01), `${ms}`);
        const { calm } = calmOf({ ...LAG, ...gains });
        check(`Ms ${wish} is of the line, and quicker ones have more`, msOfGains(calmGains(LAG, 0.95 * calm)) > own && msOfGains(calmGains(LAG, 1.05 * calm)) < own);
    }
    const none = gainsForMs(LAG, 1.001);
    check(`Ms 1.001 is not to be had: ${none.low?.toFixed(2)} to ${none.high?.toFixed(2)} are`, none.gains === undefined &&
        near(none.low, msOfGains(calmGains(LAG, 8)), 0.01) && near(none.high, msOfGains(calmGains(LAG, 1 / 8)), 0.01));
    checkNone('each plant has an Ms of 1.6', lines.map((s) => [s, gainsForMs(s, 1.6)])
        .filter(([, { ms }]) => !(Math.abs(ms - 1.6) < 0.02)).map(([s, found]) => `${s.preset}: ${JSON.stringify(found)}`));
    const COARSE = { ...LAG, OUTPUT_MAX: 20 };
    const coarse = gainsForMs(COARSE, 1.6);
    const { KP: steps } = run({ ...COARSE, ...coarse.gains }).results;
    check(`gains of ${steps} / 256 come near: Ms ${coarse.ms?.toFixed(3)}`, steps > 2 && steps < 10 && coarse.ms <= 1.6 && coarse.ms > 1.3);
    check('gains that come no nearer are told', wishText({ gains: {}, ms: 1.5 }, 1.6) === 'Ms 1.50 is set, the nearest below 1.60: the gains are coarse.' &&
        wishText({}, 1.6) === 'No gains on this line are stable.');
    const refused = gainsForMs({ ...LAG, OUTPUT_MAX: 4 }, 1.001);
    check(`calm gains that the controller refuses are passed over: from ${refused.low?.toFixed(2)}`, refused.low > none.low + 0.05);

    // --- Which row to take first -------------------------------------------------------------
    const row = (rule, robustness, gains = {}) => ({ rule, robustness, gains });
    const all = [row('PI', 8), row('PI', 16), row('PI', 32), row('PID', 8), row('PID', 16)];
    check('PI, safe is first', firstRow(all) === all[1] && firstRow([...all].reverse()) === all[1]);
    const others = [row('PI', 8), row('PI', 16, null), row('PID', 8), row('PID', 16)];
    check('PID, safe where PI has no gains', firstRow(others) === others[3]);
    check('else none is', firstRow([row('PI', 8), row('PI', 16, null)]) === null && firstRow([]) === null);
}

// --- In the browser ------------------------------------------------------------------
const state = (here) => here.evaluate(() => window.tuner.currentState());
const here = await open('p=own');
const titles = await here.locator('#work summary').allTextContents();
check('it is the first in the list; then the hardware, the plant, the gains', (await text(here, '#preset option')) === 'Your own' && /^1 Sensor, actuator, rate,2 Your plant,.*3 Gains,/.test(titles.join()), titles.join());
const SET = { 'c-sensor_bits': '10', 'c-sensor_low': '-20', 'c-sensor_range': '320', 'c-output_min': '0', 'c-output_max': '255', 'c-rate': '4', 'c-noise': '0,5' };
await here.evaluate(() => document.querySelectorAll('#work details').forEach((one) => {
    one.open = true;
}));
for (const [id, value] of Object.entries(SET)) {
    await here.fill(`#${id}`, value);
}
await here.fill('#c-unit', '°F');
await frame(here);
const wanted = { SENSOR_BITS: 10, SENSOR_LOW: -20, SENSOR_RANGE: 320, OUTPUT_MIN: 0, OUTPUT_MAX: 255, RATE: 4, NOISE: 0.5 };
const lost = (now) => Object.entries(wanted).filter(([key, value]) => now[key] !== value).map(([key, value]) => `${key} is ${now[key]}, not ${value}`);
checkNone('the hardware is as it was typed', [...lost(await state(here)), ...((await state(here)).unit === '°F' ? [] : ['unit'])]);

for (const kind of ['2', '1', '0']) {
    await here.selectOption('#c-plant', kind);
    await frame(here);
    checkNone(`another kind of plant, ${kind}, leaves it, and nothing is stale`, [...lost(await state(here)), ...await stale(here)]);
}

async function paste(rise, step) {
    const lines = Array.from({ length: 120 }, (_, i) => `${i},${i < 6 ? 0 : step},${(60 + (i > 11 ? rise * (1 - Math.exp(-(i - 11) / 12)) : 0)).toFixed(3)}`);
    await here.fill('#recording', ['t_s,duty_%,T', ...lines].join('\n'));
    await here.click('#use-fit');
    await frame(here);
    return state(here);
}
const near = (value, right) => Math.abs(value / right - 1) < 0.01;
let now = await paste(60, '50');
checkNone('a recorded plant leaves it', lost(now));
check('the plant is the recorded one', now.preset === 'own' && near(now.GAIN, 120) && near(now.T1, 12) && Math.abs(now.DEAD - 5.5) < 0.6, `${now.GAIN} ${now.T1} ${now.DEAD}`);
check('its setpoints are within the sensor', [now.SETPOINT, now.events[0].a].every((value) => value >= -20 && value <= 300));
await here.click('#modes button[value=tune]');
await here.click('#rules tbody button');
await frame(here);
checkNone('tuned gains leave it', lost(await state(here)));
await here.fill('#c-kp', '99');
await here.click('#first-gains');
await frame(here);
check('the first gains are a button away', (await state(here)).KP === simcGains(now).KP);
await here.fill('#c-gain', '150');
await here.locator('#work input[aria-label="kp, slider"]').dblclick({ position: { x: 20, y: 8 } });
await frame(here);
check('a double click has kp of the plant as it is now', (await state(here)).KP === simcGains({ ...now, GAIN: 150 }).KP);

now = await paste(-60, '50');
check('a plant that falls is reverse acting, and its loop is stable', near(now.GAIN, -120) && (now.OPTIONS & 0x80) !== 0 && !/unstable/.test(await text(here, '#margins')));
now = await paste(60, '50');
check('a direction that is set stays, and it is said', (now.OPTIONS & 0x80) !== 0 && (await text(here, '#advice')).includes('change “reverse acting”'), await text(here, '#advice'));

// From another tab: what that had is kept, and the heading is another.
await choose(here, 'flow');
await here.evaluate((more) => window.tuner.changeNow({ ...window.tuner.currentState(), ...more }), wanted);
now = await paste(60, '50');
checkNone('from another tab it stays, too', lost(now));
check('the heading is not another plant’s', (await text(here, '#story')).startsWith('Your plant on your hardware'), await text(here, '#story'));
checkNone('nothing is stale', await stale(here));
await here.focus('#c-kp');
await press(here, 'ArrowUp');
check('its link has all of it', (await fragment(here)).startsWith('p=own&'), await fragment(here));
checkNone('no error', here.noted.errors);

// --- The slider, in the browser -----------------------------------------------------------
const there = await open('p=own');
const note = () => text(there, '#calm-note');
check('first gains stand in the middle', (await there.inputValue('#c-calm')) === '60' && /^time constant .* s, as SIMC advises$/.test(await note()), await note());
await there.focus('#c-calm');
await press(there, ...new Array(12).fill('ArrowRight'));
const quick = await state(there);
const gainsOf = ({ KP, KI, KD, FILTER }) => [KP, KI, KD, FILTER].join();
check('the arrow keys make it quicker', gainsOf(quick) === gainsOf(calmGains(quick, calmAt(72))) && (await there.inputValue('#c-kp')) === String(quick.KP), gainsOf(quick));
check('and say its time constant', /^time constant \d+(\.\d+)? s$/.test(await note()) && (await there.getAttribute('#c-calm', 'aria-valuetext')) === await note(), await note());
await there.fill('#c-ki', '0.5');
await frame(there);
check('a gain of one’s own is not on the line', (await note()) === 'these gains are not on its line', await note());
await there.fill('#c-ms', '1,6');
await there.press('#c-ms', 'Enter');
await frame(there);
check('an Ms that is wanted is set', /Ms1\.60/.test(await text(there, '#key')) && (await text(there, '#ms-said')) === 'Ms 1.60 is set.', await text(there, '#ms-said'));
checkNone('nothing is stale', (await stale(there)).filter((one) => !one.startsWith('fields')));
const before = gainsOf(await state(there));
for (const [wish, sentence] of [['1.01', /^Ms 1\.01 cannot be reached: from calm to quick it is 1\.\d\d to \d+\.\d\d\.$/], ['1', /^Ms is above 1\.$/], ['x', /is no number/]]) {
    await there.fill('#c-ms', wish);
    await there.click('#take-ms');
    await frame(there);
    check(`Ms ${wish} is refused with a sentence`, sentence.test(await text(there, '#ms-said')) && gainsOf(await state(there)) === before, await text(there, '#ms-said'));
}
await there.fill('#c-kp', '2');
await frame(there);
check('of other gains nothing is said', (await text(there, '#ms-said')) === '');
checkNone('the slider: no error', there.noted.errors);
await finish();
