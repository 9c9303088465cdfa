// SPDX-License-Identifier: MIT
// What came of a board, or of a log of one, since it began: who it says it is, its steps and
// its bytes; and its numbers as the page's settings.
import { OPTION } from './built.js';
import { createTrace } from './trace.js';
import { FRAME, beginTwin, boardConfig, takeBytes } from './twin.js';

const HELD = 120000; // steps
const BYTES_KEPT = 4 * 1024 * 1024;
const TEXT_SHOWN = 120; // characters of what is no frame

// { begin(asks), take(bytes), trace, board: as it says, seconds: of a step, lastFrame: when a
// step came, whole: are all bytes kept, bytes(), printable() }; onFrame(frame) gets what is no step.
export function createSession(onFrame) {
    let [kept, tail, count] = [[], '', 0];
    const session = {
        trace: null, board: null, lastFrame: 0,
        get seconds() { return session.board?.seconds || 1; },
        get whole() { return count <= BYTES_KEPT; },
        begin(asks) {
            beginTwin(asks);
            [session.trace, session.board] = [createTrace(HELD), null];
            [kept, tail, count] = [[], '', 0];
        },
        take(bytes) {
            count += bytes.length; // from the first that has no room on none is kept
            kept.push(...(session.whole ? [bytes.slice()] : []));
            if (session.board === null && session.trace.count === 0) {
                tail = `${tail}${String.fromCharCode(...bytes.subarray(-TEXT_SHOWN))}`.slice(-TEXT_SHOWN);
            }
            takeBytes(bytes, takeSteps, takeFrame);
        },
        bytes() {
            const found = new Uint8Array(kept.reduce((sum, one) => sum + one.length, 0));
            kept.reduce((at, one) => (found.set(one, at), at + one.length), 0);
            return found;
        },
        // What came last, where it was no board's.
        printable: () => tail.replace(/[^\x20-\x7E]+/g, ' ').trim(),
        allSteps: () => session.trace.view(2 * HELD),
    };

    function takeSteps(numbers, n) {
        session.trace.take(numbers, n);
        session.lastFrame = performance.now();
    }

    function takeFrame(frame) {
        session.board = frame.kind === FRAME.HELLO ? frame : session.board;
        onFrame(frame);
    }
    return session;
}

// A board's configuration, which has come, as gains and limits of the page's state.
export function settingsOf({ seconds }) {
    const config = boardConfig();
    const rate = 1 / seconds;
    return { RATE: rate, KP: config.KP / 256, KI: (config.KI >>> 0) * rate / 2 ** 24, KD: config.KD * 2 ** config.FILTER / 256 / rate, FILTER: config.FILTER,
        OUTPUT_MIN: config.OUTPUT_MIN, OUTPUT_MAX: config.OUTPUT_MAX, INTEGRAL_MIN: config.INTEGRAL_MIN, INTEGRAL_MAX: config.INTEGRAL_MAX,
        WEIGHT: (config.WEIGHT === 0 ? 256 : config.WEIGHT) / 256, OPTIONS: config.OPTIONS & Object.values(OPTION).reduce((all, bit) => all | bit) };
}

// With its hardware: a unit is a count.
export function hardwareOf(session) {
    const { SETPOINT, MEASUREMENT } = session.trace.view(HELD);
    const highest = [SETPOINT, MEASUREMENT].reduce((most, series) => series.reduce((a, b) => Math.max(a, b), most), 0);
    const bits = Math.min(15, Math.max(10, Math.ceil(Math.log2(highest + 1))));
    return { ...settingsOf(session), SENSOR_BITS: bits, SENSOR_LOW: 0, SENSOR_RANGE: 2 ** bits - 1, NOISE: 0, unit: 'counts' };
}
