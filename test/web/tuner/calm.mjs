// SPDX-License-Identifier: MIT
// One slider for all gains and a wanted Ms, against numbers that were worked out by hand and
// a lag's frequency response by its formula; which row of the rules to take first.
import { msByFormula } from './formula.mjs';
import { check, checkNone, finish, frame, moduleOf, open, press, stale, text } from './harness.mjs';

const { calmAt, calmGains, gainsForMs, hasLine, placeOf, wishText } = await moduleOf('calm');
const { calmOf } = await moduleOf('own');
const { firstRow } = await moduleOf('rules');
const { ofLink, presetState } = await moduleOf('state');
const { run, startEngine } = await moduleOf('engine');
await startEngine();

// --- The line, without a browser ---------------------------------------------------------
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
check('nor are other presets’ and none', calmOf(ofLink('p=oven')) === null && calmOf({ ...LAG, KP: 0 }) === null && calmOf({ ...LAG, KP: -1 }) === null);
check('a note’s controller and a pendulum have no line', !hasLine(ofLink('p=an937')) && !hasLine(ofLink('p=an964')) && hasLine(ofLink('p=motor')));

// --- A wanted Ms -----------------------------------------------------------------------
const PLANT = { gain: 4.095, lag: 10, dead: 1, rate: 10 };
const msOfGains = ({ KP, KI }) => msByFormula(PLANT, { kp: KP, ki: KI / 10 });
for (const wish of [1.2, 1.4, 1.6, 2]) {
    const { gains, ms } = gainsForMs(LAG, wish);
    const own = msOfGains(gains);
    check(`Ms ${wish} has kp ${gains.KP}, ki ${gains.KI}: by the formula ${own.toFixed(3)}`, near(own, wish, 0.01) && near(ms, own, 0.01), `${ms}`);
    const { calm } = calmOf({ ...LAG, ...gains });
    check(`Ms ${wish} is of the line, and quicker ones have more`, msOfGains(calmGains(LAG, 0.95 * calm)) > own && msOfGains(calmGains(LAG, 1.05 * calm)) < own);
}
const none = gainsForMs(LAG, 1.001);
check(`Ms 1.001 is not to be had: ${none.low?.toFixed(2)} to ${none.high?.toFixed(2)} are`, none.gains === undefined &&
    near(none.low, msOfGains(calmGains(LAG, 8)), 0.01) && near(none.high, msOfGains(calmGains(LAG, 1 / 8)), 0.01));
const more = gainsForMs(LAG, 50);
check('nor is 50', more.gains === undefined && more.high === none.high);
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

// --- In the browser ------------------------------------------------------------------------
const state = (here) => here.evaluate(() => window.tuner.currentState());
const here = await open('p=own');
const note = () => text(here, '#calm-note');
check('first gains stand in the middle', (await here.inputValue('#c-calm')) === '60' && /^time constant .* s, as SIMC advises$/.test(await note()), await note());
await here.focus('#c-calm');
await press(here, ...new Array(12).fill('ArrowRight'));
const quick = await state(here);
const gains = ({ KP, KI, KD, FILTER }) => [KP, KI, KD, FILTER].join();
check('the arrow keys make it quicker', gains(quick) === gains(calmGains(quick, calmAt(72))) && (await here.inputValue('#c-kp')) === String(quick.KP), gains(quick));
check('and say its time constant', /^time constant \d+(\.\d+)? s$/.test(await note()) && (await here.getAttribute('#c-calm', 'aria-valuetext')) === await note(), await note());
await here.fill('#c-ki', '0.5');
await frame(here);
check('a gain of one’s own is not on the line', (await note()) === 'these gains are not on its line', await note());
await here.fill('#c-ms', '1,6');
await here.press('#c-ms', 'Enter');
await frame(here);
check('an Ms that is wanted is set', /Ms1\.60/.test(await text(here, '#margins')) && (await text(here, '#ms-said')) === 'Ms 1.60 is set.', await text(here, '#ms-said'));
checkNone('nothing is stale', (await stale(here)).filter((one) => !one.startsWith('fields')));
const before = gains(await state(here));
for (const [wish, sentence] of [['1.01', /^Ms 1\.01 cannot be reached: from calm to quick it is 1\.\d\d to \d+\.\d\d\.$/], ['1', /^Ms is above 1\.$/], ['x', /is no number/]]) {
    await here.fill('#c-ms', wish);
    await here.click('#take-ms');
    await frame(here);
    check(`Ms ${wish} is refused with a sentence`, sentence.test(await text(here, '#ms-said')) && gains(await state(here)) === before, await text(here, '#ms-said'));
}
await here.fill('#c-kp', '2');
await frame(here);
check('of other gains nothing is said', (await text(here, '#ms-said')) === '');
await here.click('#presets button[value=flow]');
await here.click('#modes button[value=tune]');
const marked = await here.locator('#rules tbody tr').evaluateAll((rows) => rows.filter((one) => one.textContent.includes('take this first')).map((one) => one.cells[0].textContent));
check('one row is to be taken first', marked.join() === 'PI, safe 16', marked.join());
checkNone('no error', here.noted.errors);
await finish();
