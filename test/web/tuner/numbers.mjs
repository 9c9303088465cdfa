// SPDX-License-Identifier: MIT
// Every number of every series that the page computes, against the same C
// compiled natively; and how long both take.
import { spawnSync } from 'node:child_process';
import { check, checkNone, finish, open, random, WORK } from './harness.mjs';

const NATIVES = ['native_gcc-O2', 'native_clang-O0', 'native_clang-O2'];
const OPTIMISED = NATIVES.filter((program) => program.endsWith('2'));
const SETTINGS = 100;
const RATIO_MAX = 3;

function input(scenes) {
    return Buffer.concat(scenes.map(({ verb, scene }) => {
        const numbers = [...scene.params, ...scene.events];
        const bytes = Buffer.alloc(8 + 8 * numbers.length);
        bytes.writeBigInt64LE(BigInt(verb), 0);
        numbers.forEach((value, i) => bytes.writeDoubleLE(value, 8 + 8 * i));
        return bytes;
    }));
}

function native(program, scenes, ...more) {
    const ran = spawnSync(`${WORK}/${program}`, more, { input: input(scenes), maxBuffer: 2 ** 30 });
    if (ran.status !== 0) {
        throw new Error(`${program}: ${ran.stderr}`);
    }
    return ran.stdout;
}

// In the page: what a scene gives, as one string of bytes in the order of the
// native program's answer.
function answersOf(states) {
    const { tuner } = window;
    const parts = [];
    const put = (array) => parts.push(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    const whole = (n) => put(BigInt64Array.of(BigInt(n)));
    const list = (results) => put(Float64Array.from(Object.values(results)));
    const lengths = [];
    const numbers = [];
    for (const { verb, state } of states) {
        const found = verb === 1 ? tuner.experiment(state) : tuner.run(state);
        whole(found.n);
        list(found.results);
        const rules = (all) => all.forEach((rule) => {
            whole(Number(rule.has));
            list(rule.results);
        });
        if (verb === 1) {
            rules(found.rules);
            whole(Number(found.record !== null));
        }
        if (found.record) {
            const again = tuner.recorded(state, found.record);
            put(found.record);
            whole(Number(again !== null));
            list(again.results);
            rules(again.rules);
        }
        for (const series of Object.values(found.series)) {
            put(series);
        }
        lengths.push(found.n);
        numbers.push(Object.values(found.series).length * Math.max(found.n, 0));
    }
    const total = parts.reduce((sum, part) => sum + part.length, 0);
    const all = new Uint8Array(total);
    parts.reduce((at, part) => (all.set(part, at), at + part.length), 0);
    let text = '';
    for (let i = 0; i < all.length; i += 32768) {
        text += String.fromCharCode(...all.subarray(i, i + 32768));
    }
    return { bytes: btoa(text), lengths, numbers, scenes: states.map(({ state }) => tuner.sceneOf(state)) };
}

// How many bytes of both differ, at most one for each number.
function differences(a, b) {
    if (a.length !== b.length) {
        return `${a.length} bytes and ${b.length}`;
    }
    let differ = 0;
    for (let i = 0; i < a.length; i += 4) {
        differ += a.compare(b, i, Math.min(i + 4, b.length), i, Math.min(i + 4, a.length)) === 0 ? 0 : 1;
    }
    return differ === 0 ? '' : `${differ} numbers differ`;
}

let numbers = 0;

// With a bit of the native answers turned, which must be seen.
async function compare(page, name, states, turn = 0) {
    const found = await page.evaluate(answersOf, states);
    const ours = Buffer.from(found.bytes, 'base64');
    const scenes = found.scenes.map((scene, i) => ({ scene, verb: states[i].verb }));
    for (const program of NATIVES) {
        const theirs = native(program, scenes);
        theirs[theirs.length - 1] ^= turn;
        const differ = differences(ours, theirs);
        if (turn === 0) {
            checkNone(`${name}, ${program}`, [differ].filter(Boolean));
        } else {
            check(`${name}, ${program}, with a bit turned`, differ === '1 numbers differ', differ);
        }
    }
    numbers += found.numbers.reduce((sum, one) => sum + one, 0);
    return found;
}

// A setting that a person might make, or not: some are refused.
function disturbed(preset, draw) {
    const factor = (spread) => Math.exp((2 * draw() - 1) * Math.log(spread));
    const whole = (low, high) => Math.floor(low + draw() * (high - low + 1));
    const state = { ...preset };
    if (preset.CONTROLLER !== 2 && draw() < 0.3) { // another controller on the same plant
        state.CONTROLLER = whole(0, 2);
        state.INTEGRAL_MAX = whole(1, 30000);
    }
    const pid = state.CONTROLLER === 0;
    state.KP = pid ? preset.KP * factor(20) : whole(0, 255);
    state.KI = pid ? preset.KI * factor(20) : whole(0, 255);
    state.KD = pid ? preset.KD * factor(20) : whole(0, 255);
    state.FILTER = pid ? whole(0, 7) : whole(1, 9);
    state.WEIGHT = draw();
    state.OPTIONS = pid && draw() < 0.4 ? 32 * whole(0, 7) : 0;
    state.NOISE = draw() < 0.5 ? 0 : 6 * draw();
    state.SENSOR_BITS = preset.CONTROLLER === 0 ? whole(8, 15) : 10;
    state.GAIN = preset.GAIN * factor(1.5);
    state.T1 = preset.T1 * factor(2);
    state.T2 = preset.T2 * factor(2);
    state.DEAD = preset.DEAD * 2 * draw();
    state.DAMPING = 0.05 + draw();
    if (pid && draw() < 0.4) {
        state.INTEGRAL_MIN = -whole(0, 500);
        state.INTEGRAL_MAX = whole(1, 1500);
    }
    const kinds = ['SETPOINT', 'LOAD', 'MANUAL', 'AUTO', 'LIMITS', 'FEEDFORWARD'];
    state.events = Array.from({ length: whole(0, 8) }, () => {
        const what = kinds[whole(0, 5)];
        const a = { SETPOINT: state.SENSOR_LOW + draw() * state.SENSOR_RANGE, LOAD: 0.4 * draw() - 0.2,
            MANUAL: whole(-100, 900), AUTO: 0, LIMITS: whole(-200, 300), FEEDFORWARD: whole(-200, 200) }[what];
        return { at: draw() * state.DURATION, what, a, b: what === 'LIMITS' ? whole(200, 1000) : 0 };
    });
    return state;
}

const page = await open();
const presets = await page.evaluate(() => window.tuner.PRESETS);
for (const preset of presets) {
    const found = await compare(page, `run of ${preset.preset}`, [{ verb: 0, state: preset }]);
    check(`${preset.preset} runs`, found.lengths[0] > 1, `${found.lengths[0]} steps`);
}
for (const preset of presets.filter((one) => one.CONTROLLER === 0)) {
    const found = await compare(page, `autotune of ${preset.preset}`, [{ verb: 1, state: preset }]);
    check(`${preset.preset} is tuned`, found.lengths[0] > 100, `${found.lengths[0]} steps`);
}
await compare(page, `run of ${presets[0].preset}`, [{ verb: 0, state: presets[0] }], 1);
const draw = random(20261122);
const states = Array.from({ length: SETTINGS }, (_, i) =>
    ({ verb: 0, state: disturbed(presets[i % presets.length], draw) }));
let accepted = 0;
for (let i = 0; i < SETTINGS; i += 10) {
    const found = await compare(page, `random settings from ${i}`, states.slice(i, i + 10));
    accepted += found.lengths.filter((n) => n > 1).length;
}
check(`most random settings are accepted: ${accepted} of ${SETTINGS}`, accepted >= 0.6 * SETTINGS);
check(`numbers compared: ${numbers}, each with three programs`, numbers > 1e6);

// In the same run, the shortest of many: what is short is seldom interrupted.
const long = { ...presets.find((one) => one.preset === 'flow'), RATE: 1000, DURATION: 20 };
const [ours, scene] = await page.evaluate((one) =>
    [window.tuner.timeRuns(one, 200) / 1000, window.tuner.sceneOf(one)], long);
const theirs = Math.min(...OPTIMISED.map((program) => Number(native(program, [{ verb: 0, scene }], '200').toString())));
check(`20 000 steps: ${(1000 * ours).toFixed(1)} ms, natively ${(1000 * theirs).toFixed(1)} ms, ` +
    `${(ours / theirs).toFixed(2)} times`, ours <= RATIO_MAX * theirs, `more than ${RATIO_MAX} times`);
checkNone('no error in the page', page.noted.errors);
await finish();
