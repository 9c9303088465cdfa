// SPDX-License-Identifier: MIT
// Whether a loop is safe with all plants that a recording allows: Ms of the header's integers with
// each of them. It is known where the plant is one that was recorded, when the hand rests.
import { digits } from './format.js';
import { msOfEach } from './margins.js';

const REST_MS = 150;
const MOST_MS = 2.2;
const allowances = new Map(); // of a plant's numbers, what its recording allows

const plantKey = ({ PLANT, GAIN, T1, T2, DAMPING, DEAD }) => [PLANT, GAIN, T1, T2, DAMPING, DEAD].join();

// Of the state's plant: { plants, full }, what else its recording allows.
export function rememberPlants(s, allowed) {
    allowances.set(plantKey(s), allowed);
}

// { low, high } of the Ms of nine of ten, which are sorted.
export function ninthOf(each) {
    return { low: each[0], high: each[Math.floor(0.9 * each.length)] };
}

export function verdictText(ms, { low, high }) {
    return `Ms ${digits(ms)}; ${digits(low)} to ${Number.isFinite(high) ? digits(high) : 'unstable'} for nine of ten plants that the recording allows`;
}

export const isRisky = ({ high }) => !(high <= MOST_MS);

// A function of the state, its results and its margins: { low, high }, or null where nothing is
// recorded or it is not known yet: onKnown() is called then.
export function createVerdict(onKnown) {
    let [key, found, timer] = ['', null, 0];
    return (s, results) => {
        const allowed = allowances.get(plantKey(s));
        const now = allowed === undefined ? '' : JSON.stringify([{ ...s, kept: [], events: [] }, results]);
        if (now !== key) {
            clearTimeout(timer);
            [key, found] = [now, null];
            timer = allowed === undefined ? 0 : setTimeout(() => {
                found = ninthOf(msOfEach(s, results, allowed.plants, allowed.full));
                onKnown();
            }, REST_MS);
        }
        return found;
    };
}
