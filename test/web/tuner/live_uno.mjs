// SPDX-License-Identifier: MIT
// The card of a board, in Chromium, with the sketch Live on a simulated Arduino Uno behind
// the serial port: uno.c, with which this test speaks over a socket.
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { readFileSync } from 'node:fs';
import { check, checkNone, finish, frame, random, text, WORK } from './harness.mjs';
import { connect, equalOf, left, said, setSetpoint, spoiled, verdict } from './serial.mjs';

const STEPS = Number(process.env.STEPS ?? 25000);
const RATE = 2500; // steps per second, by fast_live of test/use/packages/steps.sh
const AT_ONCE = 500; // steps: a page that gets none for 5 s asks its board again
const NOISY = 5000;
const NOISY_SETPOINTS = Array.from({ length: 12 }, (_, i) => 440 + i);
const ANSWERS = 20; // steps in which a command comes, is carried out and its answer has gone
const KEYS_APART = 256; // frames, as docs/link.md has it
const FLIGHT = 4; // steps whose frames may be on their way, behind a long one
const OWN_SETPOINT = 600; // the sketch's
const SETPOINTS = [500, 700];
const EQUAL = /^[\d\u202F]+ steps equal, bit for bit\.$/;

// The simulated Uno as connect() takes it. `steps` are those that it was asked for.
function startUno(name) {
    const child = spawn(`${WORK}/uno/uno`, [`${WORK}/uno/${name}.elf`], { stdio: ['pipe', 'pipe', 'inherit'] });
    const over = once(child, 'close');
    let [came, taken, waiting, before] = [Buffer.alloc(0), null, [], Promise.resolve()];
    child.stdin.on('error', () => {}); // of a program that has ended; `over` is said then
    child.stdout.on('data', (part) => {
        came = Buffer.concat([came, part]);
        const from = came.indexOf('\n') + 1;
        const end = from > 0 ? from + Number(came.subarray(0, from)) : Infinity;
        if (came.length >= end) {
            const found = came.subarray(from, end);
            came = came.subarray(end);
            taken(found);
        }
    });
    const ask = (steps) => new Promise((take, fail) => {
        taken = take;
        over.then(([code]) => fail(new Error(`uno.c has ended with ${code}`)));
        child.stdin.write(Buffer.concat([Buffer.from(`${steps} ${waiting.length}\n`), Buffer.from(waiting)]));
        waiting = [];
        board.steps += steps;
    });
    const board = {
        sent: [], steps: 0,
        receive: (bytes) => waiting.push(...bytes),
        run(steps) {
            before = before.then(() => ask(steps));
            return before;
        },
        async end() {
            child.stdin.end();
            return (await over)[0];
        },
    };
    return board;
}

async function saved(here, button) {
    const [file] = await Promise.all([here.waitForEvent('download'), here.click(button)]);
    return readFileSync(await file.path(), 'utf8');
}

// The steps that came: their places among all, setpoints, and whether they are equal.
async function rowsOf(here) {
    const [, ...lines] = (await saved(here, '#live-csv')).trim().split('\n');
    return lines.map((line) => line.split(',')).map(([seconds, setpoint, ...more]) => ({ place: Math.round(seconds * RATE), setpoint: Number(setpoint), equal: more.at(-1) === 'equal' }));
}

const configOf = async (here) => JSON.parse(await saved(here, '#live-json')).config;

// All steps that the card has a word for: equal, not compared for a reason, or not come.
async function accounted(here) {
    const words = `${await verdict(here)} ${await left(here)}`;
    const counts = [...words.matchAll(/([\d\u202F]+) (?:steps? equal|before|behind|after|steps? did not come)/g)];
    return counts.reduce((sum, [, count]) => sum + Number(count.replaceAll('\u202F', '')), 0);
}

async function runAll(run, steps) {
    for (let done = 0; done < steps; done += AT_ONCE) {
        await run(Math.min(AT_ONCE, steps - done));
    }
}

async function setpoints({ here, run }, values) {
    for (const value of values) {
        await setSetpoint(here, value);
        await run(ANSWERS);
    }
}

// Gains of the page with another kp, to a board whose settings the page has. It may have to
// ask for the board's record first.
async function sendKp({ here, run }, kp) {
    await here.fill('#c-kp', kp);
    await frame(here);
    for (let i = 0; i < 100 && !(await here.isVisible('#live-confirm')); i++) {
        await run(ANSWERS);
        await here.waitForTimeout(100);
        await here.click('#live-send');
    }
    await here.click('#live-sure');
    await said(here, /^Sent: .* equal in all bytes/);
}

{
    const board = startUno('sound');
    const draw = random(17);
    let spoil = (bytes) => bytes;
    const page = await connect(board, { answers: ANSWERS, spoil: (bytes, isToPage) => spoil(bytes, isToPage) });
    const { here, run } = page;
    const about = await text(here, '#live-board');
    check('an Uno says what it is', about.startsWith('“heater”') && about.includes(`, ${RATE} steps per second. Allowed: setpoint: yes, gains: yes, limits: no, output by hand: for 5.00 s`), about);

    // A good wire.
    await run(1000);
    const unsaid = board.steps - await accounted(here); // before the stream
    await runAll(run, STEPS / 2);
    await setpoints(page, SETPOINTS);
    await here.click('#live-use');
    await sendKp(page, '3');
    await runAll(run, STEPS / 2);
    const clean = await verdict(here);
    check(`an Uno: ${STEPS} steps are equal, with a setpoint and gains that change: ${clean}`, equalOf(clean) >= STEPS && EQUAL.test(clean), clean);
    check('an Uno: what is not compared is counted', /^(Not compared: \d+ before the record and the first key frame\.)?$/.test(await left(here)), await left(here));

    // One byte in a hundred, both ways.
    spoil = (bytes) => spoiled(bytes, draw);
    await runAll(run, NOISY);
    await setpoints(page, NOISY_SETPOINTS);
    await sendKp(page, '2');
    const noisy = await verdict(here);
    check(`an Uno, a bad wire: nothing is said to be different: ${noisy}`, EQUAL.test(noisy), noisy);
    const lost = await left(here);
    check('an Uno, a bad wire: what was not compared is counted', /after [\d\u202F]+ gaps, up to the next key frame/.test(lost) && /[\d\u202F]+ steps did not come/.test(lost) && /pieces between two frames are no frame/.test(lost), lost);
    spoil = (bytes) => bytes;
    for (let i = 0, equal = 0; i < 40 && equal < KEYS_APART - FLIGHT; i++) {
        equal = -equalOf(await verdict(here));
        await run(KEYS_APART); // the record is asked for again, and the stream
        equal += equalOf(await verdict(here));
    }
    await runAll(run, NOISY);
    const mended = await verdict(here);
    const rows = await rowsOf(here);
    const last = rows.slice(-NOISY + FLIGHT);
    check(`an Uno, mended: equal from a key frame on: ${mended}`, EQUAL.test(mended) && last.every(({ equal }) => equal) && last.at(-1).place - last[0].place === last.length - 1, await left(here));
    const [steps, told] = [board.steps - unsaid, await accounted(here)];
    check(`an Uno: each of ${steps} steps is equal, not compared or did not come`, Math.abs(steps - told) <= FLIGHT, `${told} are accounted for`);

    // What was carried out is what was sent, in its order. Of a setpoint only one frame and
    // the key frames tell, which may all be lost.
    const sent = [OWN_SETPOINT, ...SETPOINTS, ...NOISY_SETPOINTS];
    const seen = rows.map(({ setpoint }) => setpoint).filter((one, i, all) => one !== all[i - 1]);
    check('an Uno: it had the setpoints that were sent, and no other', seen.join() === sent.filter((one) => seen.includes(one)).join() &&
        seen.length > sent.length / 2 && seen.at(-1) === sent.at(-1), seen.join());
    const { kp, ki, kd, output_min: least, output_max: most } = await configOf(here);
    check('an Uno: it has the gains that were sent last', kp === 512 && [ki, kd, least, most].join() === '10737,32000,0,255', [kp, ki, kd, least, most].join());
    checkNone('an Uno: no error', here.noted.errors);
    check('an Uno: it ran to the end', await board.end() === 0);
    await here.close();
}
{
    const board = startUno('planted');
    const page = await connect(board, { answers: ANSWERS });
    const { here, run } = page;
    await runAll(run, NOISY);
    await setpoints(page, [450, 750]);
    const sentence = await verdict(here);
    check(`an Uno whose library has one bit planted is said: ${sentence.slice(0, 110)}`, /^Different: in step [\d\u202F]+ /.test(sentence), sentence);
    await board.end();
    await here.close();
}
await finish();
