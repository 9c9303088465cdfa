// SPDX-License-Identifier: MIT
// Each controller on each plant: the notes’ by their equations, done here again;
// what their limits take away, and what a step takes of the time.
import { readFileSync } from 'node:fs';
import { check, checkNone, choose, finish, fragment, frame, moduleOf, open, stale, text } from './harness.mjs';

const { PRESETS, ofLink, presetState, withController, withinReason } = await moduleOf('state');
const { gainsFor, notesLimits, plantOfKind, withPlant } = await moduleOf('own');
const { run, startEngine } = await moduleOf('engine');
const { costsOf, shareOf } = await moduleOf('cards');
const { wholeHeaderOf: headerOf } = await moduleOf('header');
await startEngine();

const [AN937, AN964] = [1, 2];
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

// Equation 4 of AN937 as fixpid_an937.h has it: one tick for each step.
function an937(s, r) {
    let [sum, delta, last, ticks] = [0, 0, 0, 0];
    return (error) => {
        sum = clamp(sum + error, -s.INTEGRAL_MAX, s.INTEGRAL_MAX);
        ticks -= 1;
        if (ticks <= 0) {
            [delta, last, ticks] = [error - last, error, r.FILTER];
        }
        const all = clamp(r.KP * error + r.KI * sum + r.KD * delta, -(2 ** 24 - 1), 2 ** 24 - 1);
        return clamp(Math.trunc(all / 16), -32768, 32767);
    };
}

// The equations of fixpid_an964.h, at fixpid_an964_step.
function an964(s, r) {
    let sum = 0;
    const before = [0, 0, 0];
    return (error) => {
        const e = clamp(error, -1023, 1023);
        sum = clamp(sum + e, 1 - 30000, 30000);
        const integral = Math.trunc(Math.trunc(sum / 256) * r.KI / 16);
        const rise = clamp(e - before.pop(), -120, 120);
        before.unshift(e);
        const derivative = clamp(Math.floor(rise * r.KD / 32), -120, 120);
        return clamp(Math.trunc((e + integral + derivative) * r.KP / 1024), -1000, 1000);
    };
}

function faultsOf(s) {
    const { n, results, series } = run(s);
    if (n < 0) {
        return ['refused'];
    }
    const step = (s.CONTROLLER === AN937 ? an937 : an964)(s, results);
    const scale = (s.PLANT === 4 && s.CONTROLLER === AN937 ? 4 : 1) * ((s.OPTIONS & 0x80) !== 0 ? -1 : 1);
    for (let i = 0; i < n; i++) {
        const error = clamp(scale * (series.SETPOINT[i] - series.MEASUREMENT[i]), -32768, 32767);
        const wanted = clamp(step(error), s.OUTPUT_MIN, s.OUTPUT_MAX);
        if (wanted !== series.OUTPUT[i]) {
            return [`step ${i}: ${series.OUTPUT[i]}, not ${wanted}`];
        }
    }
    return [];
}

const scenes = PRESETS.filter((one) => one.preset !== 'an964').flatMap((one) => [0, AN937, AN964].map((controller) => withinReason(withController(one, controller))));
for (const s of scenes.filter((one) => one.CONTROLLER !== 0)) {
    const name = `${['', 'AN937', 'AN964'][s.CONTROLLER]} on ${s.preset}`;
    checkNone(`${name} is its equations`, faultsOf(s));
    checkNone(`${name}, reversed, with more bits and a gain below 0`, faultsOf(withinReason({ ...s, OPTIONS: 0x80, SENSOR_BITS: 15, GAIN: s.PLANT === 4 ? s.GAIN : -s.GAIN, KP: Math.min(s.KP + 1, 255), KI: Math.min(s.KI + 3, 255), KD: Math.min(s.KD + 9, 255) })));
}
{
    const { series } = run(withinReason({ ...withController(presetState('flow'), AN964), OUTPUT_MAX: 4000, KP: 1023, KI: 1023, NOISE: 0 }));
    const most = [series.OUTPUT, series.VALUE_TWIN_OUTPUT].map((outputs) => Math.max(...outputs));
    check(`AN964 and its twin end at the same output: ${most}`, most.join() === '1000,1000');
}
check('a pendulum has AN964 alone', withinReason({ ...presetState('an964'), CONTROLLER: 0 }).CONTROLLER === AN964 && ofLink('p=an964&controller=1').CONTROLLER === AN964);
check('a link has the controller', ofLink('p=flow&controller=1').CONTROLLER === AN937 && ofLink('p=flow&controller=9').CONTROLLER === AN964);
check('the preset’s own controller has its gains again', withController(withController(presetState('flow'), AN964), 0).KP === 0.62);

// First gains, by hand: 12 bits, 1000 counts of output; see own.mjs for kp and ki of it.
const flow = { ...presetState('own'), GAIN: 100, T1: 10, T2: 0, DEAD: 1, SENSOR_LOW: 0, SENSOR_RANGE: 100, OUTPUT_MIN: 0, OUTPUT_MAX: 1000, RATE: 10 };
const hand = [[AN937, 12, [19, 0, 0]], [AN937, 10, [74, 1, 0]], [AN964, 12, [1023, 57, 0]], [AN964, 10, [1023, 227, 0]]];
for (const [controller, bits, wanted] of hand) {
    const s = { ...flow, SENSOR_BITS: bits, CONTROLLER: controller };
    const { KP, KI, KD } = gainsFor(s);
    check(`first gains of controller ${controller} at ${bits} bits: ${[KP, KI, KD]}`, [KP, KI, KD].join() === wanted.join(), wanted.join());
}
// What of the notes' limits is said.
const said = (s) => notesLimits({ ...s, ...gainsFor(s) }).join(' ');
const clamped = said({ ...flow, SENSOR_BITS: 10, CONTROLLER: AN964 });
check('a gain that AN964’s limit clamps is said', /kp ends at 1023; this plant’s first gains want 4767\./.test(clamped), clamped);
check('and a sensor that its error does not reach', said({ ...flow, SENSOR_BITS: 12, CONTROLLER: AN964 }).includes('Its error ends at 1023 counts') && !clamped.includes('Its error'), clamped);
for (const [sentence, more] of [['Its integral alone reaches 58 of 1000', {}], ['Its output ends at 1000 of 4000', { OUTPUT_MAX: 4000 }]]) {
    const notes = notesLimits({ ...flow, SENSOR_BITS: 10, CONTROLLER: AN964, KP: 512, KI: 16, ...more }).join();
    check(`and what is not reached: ${sentence}`, notes.includes(sentence), notes);
}
check('and a ki that AN937 cannot have', said({ ...flow, SENSOR_BITS: 12, CONTROLLER: AN937 }).includes('ki of 1 is more than this plant’s first gains want'), said({ ...flow, SENSOR_BITS: 12, CONTROLLER: AN937 }));

const limits = readFileSync('include/fixpid_an964.h', 'utf8');
const s964 = withinReason(withController(presetState('flow'), AN964));
const header = headerOf(s964, run(s964).results);
checkNone('AN964’s header has the limits of the library', ['SUM', 'TERM', 'OUTPUT'].filter((name) => {
    const value = limits.match(new RegExp(`#define FIXPID_AN964_${name}_LIMIT (\\d+)`))[1];
    return !header.includes(`// -DFIXPID_AN964_${name}_LIMIT=${value}\n`) || !header.includes(`#if FIXPID_AN964_${name}_LIMIT != ${value}\n`);
}));
check('and says what its error is', header.includes('// Its error is setpoint - measurement, in counts.'), header);

// --- Of the time -----------------------------------------------------------------------
const pendulum = presetState('an964');
const row = costsOf(pendulum, {}).find(({ chip }) => chip === 'PIC16F684');
check('the note’s loop takes a PIC16F684 at 4 MHz its steps’ part of a second', Math.abs(shareOf(row, pendulum) - row.most * 256 / 1e6) < 1e-12 && pendulum.CLOCK === 4);
const here = await open('p=an964');
await here.click('#open-tools');
const cell = async (chip) => here.locator('#chips tbody tr').filter({ hasText: chip }).first().locator('td').last().textContent();
check(`the card says ${await cell('PIC16F684')}`, (await cell('PIC16F684')) === `${Math.round(100 * shareOf(row, pendulum))} %`);
await here.fill('#c-clock', '0,5');
await frame(here);
check('a slow clock is said to be too slow', (await cell('PIC16F684')).endsWith('%: too slow'), await cell('PIC16F684'));
check('no part is said of instructions', (await cell('Cortex-M0')) === '–');
check('the clock is in the link', (await fragment(here)).includes('clock=0.5'), await fragment(here));
check('a pendulum has no other controller', await here.locator('#c-controller').count() === 0);
await choose(here, 'flow');
await here.click('[data-title="Controller and options"] summary');
for (const controller of ['2', '1', '0']) {
    await here.selectOption('#c-controller', controller);
    await frame(here);
    check(`controller ${controller} is in use`, (await text(here, '#header')).includes(`#include "fixpid_${['pid', 'an937', 'an964'][controller]}.h"`));
    checkNone(`controller ${controller}: nothing is stale`, await stale(here));
}
await choose(here, 'own');
await here.selectOption('#c-controller', '2');
await here.selectOption('#c-plant', '2');
await frame(here);
check('another plant keeps the controller', (await here.evaluate(() => window.tuner.currentState().CONTROLLER)) === AN964 && (await here.inputValue('#c-controller')) === '2');
checkNone('and nothing is stale', await stale(here));
checkNone('no error', here.noted.errors);
await finish();
