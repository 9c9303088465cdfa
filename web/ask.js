// SPDX-License-Identifier: MIT
// Commands to a board, one at a time: each is sent again until it is answered, and given
// up in the end.
import { ASK, commandBytes, forgetCommand, twinCounts } from './twin.js';

const PATIENCE = 200; // milliseconds
const TRIES = 40; // a board that begins anew when its port is opened takes two seconds

// `send(bytes)` writes to the wire. { ask(command, value), took(frame), stop(why), idle }: ask
// promises the frame that answers, or throws a sentence.
export function createAsker(send) {
    const queue = [];
    let [current, timer, stopped] = [null, 0, null];

    function end(act) {
        clearTimeout(timer);
        const done = current;
        current = null;
        act(done);
        next();
    }

    function transmit() {
        if (current.tries === TRIES) {
            forgetCommand();
            end((done) => done.reject(new Error('The board does not answer.')));
            return;
        }
        // A 0 first ends what is left of a spoilt one.
        send(current.tries === 0 ? current.bytes : Uint8Array.of(0, ...current.bytes));
        current.tries += 1;
        timer = setTimeout(transmit, PATIENCE);
    }

    function next() {
        if (current === null && queue.length > 0) {
            current = queue.shift();
            current.bytes = commandBytes(current.command, current.value);
            current.tries = 0;
            transmit();
        }
    }

    function ask(command, value = []) {
        return new Promise((resolve, reject) => {
            if (stopped !== null) {
                reject(new Error(stopped));
                return;
            }
            queue.push({ command, value, resolve, reject });
            next();
        });
    }

    // Whether it answers is known to the twin.
    function took(frame) {
        if (current !== null && twinCounts().WAITING === 0) {
            end((done) => done.resolve(frame));
        }
    }

    function stop(why) {
        stopped = why;
        clearTimeout(timer);
        forgetCommand();
        for (const one of [current, ...queue.splice(0)].filter((each) => each !== null)) {
            one.reject(new Error(why));
        }
        current = null;
    }

    return { ask, took, stop, get idle() { return current === null && queue.length === 0; } };
}

export function int16Bytes(value) {
    return [value & 0xFF, (value >> 8) & 0xFF];
}

// Why a board did not do it, in words; '' where it did.
export function commandRefusal({ command, result }) {
    const needs = { [ASK.SETPOINT]: 'SETPOINT', [ASK.WRITE]: 'GAINS' }[command] ?? 'MANUAL';
    const reasons = { [ASK.SETPOINT]: 'the setpoint is outside the range that its program gives', [ASK.MANUAL]: 'its program allows no time for an output by hand',
        [ASK.WRITE]: 'other options or weight than it was initialised with, limits beyond its own, or gains that fixpid_pid does not take' };
    switch (result) {
    case 0: return '';
    case 1: return `Not allowed: the board’s program does not call fixpid_link_allow with FIXPID_LINK_${needs}.`;
    default: return `Refused by the board: ${reasons[command] ?? 'its firmware cannot do it'}.`;
    }
}
