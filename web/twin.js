// SPDX-License-Identifier: MIT
// The other end of a board's fixpid_link: the C of sim/link as WebAssembly. Bytes go in;
// frames come out, steps with the terms of the board's controller once more, and what of
// them was equal.
import { CONFIG, LIMIT, STEP, TWIN } from './built.js';
import { exported } from './engine.js';

export const ASK = { HELLO: 0x40, RECORD: 0x41, STREAM: 0x42, SETPOINT: 0x43, MANUAL: 0x44, AUTO: 0x45, SEED: 0x46, WRITE: 0x47 };
export const DONE = 0;
export const LINK_VERSION = 1; // what this page speaks
export const FRAME = { ANSWER: 2, HELLO: 3, RECORD: 4 };

const memory = (Type, at, n) => new Type(exported().memory.buffer, at, n);
const bytesOf = (n) => memory(Uint8Array, exported().live_bytes(), n);
const named = (names, numbers) => Object.fromEntries(Object.entries(names).map(([name, at]) => [name, numbers[at]]));

// Of a board that may be asked, or of a log.
export function beginTwin(asks) {
    exported().live_begin(Number(asks));
}

// What a frame that is no step's says; others are a step's.
function meaningOf(payload) {
    const view = new DataView(payload.buffer, payload.byteOffset, payload.length);
    switch (payload[0]) {
    case FRAME.ANSWER: return { kind: FRAME.ANSWER, tag: payload[1], command: payload[2], result: payload[3] };
    case FRAME.HELLO: return { kind: FRAME.HELLO, tag: payload[1], version: payload[2], library: [...payload.subarray(3, 6)].join('.'),
        features: payload[6], allowed: payload[7], seconds: view.getUint32(8, true) / 1e6, manualSteps: view.getUint16(12, true),
        name: String.fromCharCode(...payload.subarray(14)).replace(/\0.*$/s, '').replace(/[^\x20-\x7E]/g, '?') };
    default: return { kind: FRAME.RECORD, tag: payload[1], record: payload.slice(2) };
    }
}

// onSteps(numbers, n): n steps, of each the numbers of STEP, only until it returns.
// onFrame(meaning): any other frame. Both in the order in which they came.
export function takeBytes(bytes, onSteps, onFrame) {
    const size = Object.keys(STEP).length;
    for (let from = 0; from < bytes.length; from += LIMIT.LIVE_BYTES) {
        const part = bytes.subarray(from, from + LIMIT.LIVE_BYTES);
        for (let at = 0; at < part.length;) {
            bytesOf(part.length).set(part); // onFrame may have made a command of it
            at = exported().live_take(at, part.length);
            const n = exported().live_steps();
            if (n > 0) {
                onSteps(memory(Int32Array, exported().live_step_numbers(), size * n), n);
            }
            const length = exported().live_payload_bytes();
            if (length > 0) {
                onFrame(meaningOf(memory(Uint8Array, exported().live_payload(), length).slice()));
            }
        }
    }
}

export function twinCounts() {
    return named(TWIN, memory(Int32Array, exported().live_counts(), Object.keys(TWIN).length));
}

// A command's bytes, to be sent until it is answered.
export function commandBytes(command, value = []) {
    bytesOf(value.length).set(value);
    return bytesOf(exported().live_command(command, value.length)).slice();
}

export function forgetCommand() {
    exported().live_forget();
}

// The board's configuration as the twin has it, or null.
export function boardConfig() {
    const at = exported().live_config();
    return at === 0 ? null : named(CONFIG, memory(Int32Array, at, Object.keys(CONFIG).length));
}

// The bytes of a record with these gains and all else of that configuration.
export function recordBytes({ KP, KI, KD, FILTER }) {
    return bytesOf(exported().live_record(KP, KI, KD, FILTER)).slice();
}
