// SPDX-License-Identifier: MIT
// The steps of a board, evenly in time: one place for each step, also for those that did
// not come, which are as the one before and marked.
import { STEP } from './built.js';

const NAMES = ['SETPOINT', 'MEASUREMENT', 'OUTPUT', 'FLAGS', 'P', 'I', 'D'];
const COUNTS_OF = { P: 256, I: 65536, D: 256 };
const SIZE = Object.keys(STEP).length;
const MASK = 0x3FFF;
// `marks`: a step did not come, or was not compared.
export const MISSED = 1;
export const UNCOMPARED = 2;

// Holds the last `most` steps at least: { take(numbers, n), view(n), count: of steps that
// came, places: of all, restarts: how often the board began anew }.
export function createTrace(most) {
    const room = 2 * most;
    const series = Object.fromEntries(NAMES.map((name) => [name, new Float32Array(room)]));
    const marks = new Uint8Array(room);
    const all = [...Object.values(series), marks];
    let [end, last, count, places] = [0, null, 0, 0];
    let [lastKey, restarts] = [null, 0]; // a key frame has its whole number

    function step() {
        if (end === room) {
            all.forEach((one) => one.copyWithin(0, most));
            end = most;
        }
        end += 1;
        places += 1;
        return end - 1;
    }

    // As many places as steps did not come; of a stop that is longer than the memory, or of
    // a board that begins anew, none.
    function skip(lost) {
        for (let i = 0; i < lost; i++) {
            const at = step();
            for (const name of NAMES) {
                series[name][at] = at > 0 ? series[name][at - 1] : 0;
            }
            marks[at] = MISSED;
        }
    }

    function take(numbers, n) {
        for (let from = 0; from < n * SIZE; from += SIZE) {
            const number = numbers[from + STEP.NUMBER] >>> 0;
            const forward = last === null ? 1 : (number - last) & MASK;
            const anew = numbers[from + STEP.IS_KEY] === 1 && last !== null && number < last && last <= MASK;
            if (numbers[from + STEP.IS_KEY] === 1) {
                restarts += Number(lastKey !== null && number < lastKey && lastKey - number < 2 ** 31);
                lastKey = number;
            }
            if (forward > 1 && forward < most && !anew) {
                skip(forward - 1);
            }
            last = number;
            count += 1;
            const at = step();
            const compared = numbers[from + STEP.COMPARED] === 1;
            for (const name of NAMES) {
                const known = compared || COUNTS_OF[name] === undefined; // terms are the twin's
                series[name][at] = known ? numbers[from + STEP[name]] / (COUNTS_OF[name] ?? 1) : NaN;
            }
            marks[at] = compared ? 0 : UNCOMPARED;
        }
    }

    // The last n steps, without a copy: to be used before the next are taken.
    function view(n) {
        const from = Math.max(0, end - n);
        const found = Object.fromEntries(NAMES.map((name) => [name, series[name].subarray(from, end)]));
        return { ...found, marks: marks.subarray(from, end), n: end - from };
    }

    return { take, view, get count() { return count; }, get places() { return places; }, get restarts() { return restarts; } };
}
