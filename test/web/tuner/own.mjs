// SPDX-License-Identifier: MIT
// A plant of one's own: its first gains against numbers that were worked out by hand
// from Skogestad's table, and their margins; and that what a person said of sensor,
// actuator and rate stays, whatever is fitted or tuned.
import { check, checkNone, finish, fragment, frame, moduleOf, open, press, stale, text } from './harness.mjs';

const { simcGains, plantOfKind, withPlant } = await moduleOf('own');
const { presetState, withinReason } = await moduleOf('state');
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

// --- In the browser ------------------------------------------------------------------
const state = (here) => here.evaluate(() => window.tuner.currentState());
const here = await open('p=own');
check('it is the first tab', (await text(here, '#presets button')) === 'Your own' &&
    (await here.getAttribute('#presets button', 'aria-pressed')) === 'true');
const titles = await here.locator('#panel summary').allTextContents();
check('first the hardware, then the plant, then the gains', /^1 Your sensor.*,2 Your plant,3 Your gains,/.test(titles.join()), titles.join());
const SET = { 'c-sensor_bits': '10', 'c-sensor_low': '-20', 'c-sensor_range': '320', 'c-output_min': '0', 'c-output_max': '255', 'c-rate': '4', 'c-noise': '0,5' };
await here.evaluate(() => document.querySelectorAll('#panel details').forEach((one) => {
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
    checkNone(`another kind of plant, ${kind}, leaves it`, lost(await state(here)));
    checkNone(`and nothing is stale, ${kind}`, await stale(here));
}

async function paste(rise, step) {
    const lines = Array.from({ length: 120 }, (_, i) => `${i}, ${(60 + (i > 5 ? rise * (1 - Math.exp(-(i - 5) / 12)) : 0)).toFixed(3)}`);
    await here.fill('#recording', lines.join('\n'));
    await here.fill('#record-step', step);
    await here.click('#use-fit');
    await frame(here);
    return state(here);
}
const near = (value, right) => Math.abs(value / right - 1) < 0.01;
let now = await paste(60, '50');
checkNone('a recorded plant leaves it', lost(now));
check('the plant is the recorded one', now.preset === 'own' && near(now.GAIN, 120) && near(now.T1, 12) && near(now.DEAD, 5), `${now.GAIN} ${now.T1} ${now.DEAD}`);
check('its setpoints are within the sensor', [now.SETPOINT, now.events[0].a].every((value) => value >= -20 && value <= 300));
checkNone('its gains are the first ones', Object.entries(simcGains(now)).filter(([key, value]) => now[key] !== value).map(([key]) => key));
const margins = await text(here, '#margins');
check('they are sound', /stable/.test(margins) && !/unstable/.test(margins) && Number(margins.match(/Ms(\d\.\d+)/)[1]) < 2, margins);
await here.click('#modes button[value=tune]');
await here.click('#rules tbody button');
await frame(here);
checkNone('tuned gains leave it', lost(await state(here)));
await here.fill('#c-kp', '99');
await here.click('#first-gains');
await frame(here);
check('the first gains are a button away', (await state(here)).KP === simcGains(now).KP);
await here.fill('#c-gain', '150');
await here.locator('#panel input[aria-label="kp, slider"]').dblclick({ position: { x: 20, y: 8 } });
await frame(here);
check('a double click has kp of the plant as it is now', (await state(here)).KP === simcGains({ ...now, GAIN: 150 }).KP);

now = await paste(-60, '50');
check('a plant that falls is reverse acting', near(now.GAIN, -120) && (now.OPTIONS & 0x80) !== 0);
check('and its loop is stable', !/unstable/.test(await text(here, '#margins')));
now = await paste(60, '50');
check('a direction that is set stays, and it is said', (now.OPTIONS & 0x80) !== 0 && (await text(here, '#advice')).includes('change “reverse acting”'), await text(here, '#advice'));

// From another tab: what that had is kept, and the heading is another.
await here.click('#presets button[value=flow]');
await here.evaluate((more) => window.tuner.changeNow({ ...window.tuner.currentState(), ...more }), wanted);
now = await paste(60, '50');
checkNone('from another tab it stays, too', lost(now));
check('the heading is not another plant’s', (await text(here, '#story')).startsWith('Your plant on your hardware'), await text(here, '#story'));
checkNone('nothing is stale', await stale(here));
await here.focus('#c-kp');
await press(here, 'ArrowUp');
check('its link has all of it', (await fragment(here)).startsWith('p=own&'), await fragment(here));
checkNone('no error', here.noted.errors);
await finish();
