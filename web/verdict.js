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

// { text, warning: a sentence, or null }, of the loop's own Ms and of that with each plant in their
// order, infinite where it is unstable. Python's package says the same with another digit.
export function verdictOfEach(own, each) {
    const most = each[Math.floor(0.9 * each.length)];
    const above = each.filter((one) => one > MOST_MS).length;
    const said = Number.isFinite(most) ? `${digits(each[0], 2)} to ${digits(most, 2)} for nine of ten plants` : 'unstable for more than one of ten plants';
    return { text: `${Number.isFinite(own) ? `Ms ${digits(own, 2)}` : 'unstable'}; ${said} that the recording allows`,
        warning: most <= MOST_MS ? null : `${above} of ${each.length} plants that the recording allows have Ms above ${MOST_MS} with these gains: take calmer ones, or record again.` };
}

// A function of the state, its results and its margins: what verdictOfEach says, or null where nothing
// is recorded or it is not known yet: onKnown() is called then.
export function createVerdict(onKnown) {
    let [key, found, timer] = ['', null, 0];
    return (s, results, { stable, ms }) => {
        const allowed = allowances.get(plantKey(s));
        const now = allowed === undefined ? '' : JSON.stringify([{ ...s, kept: [], events: [] }, results]);
        if (now !== key) {
            clearTimeout(timer);
            [key, found] = [now, null];
            timer = allowed === undefined ? 0 : setTimeout(() => {
                found = verdictOfEach(stable ? ms : Infinity, msOfEach(s, results, allowed.plants, allowed.full));
                onKnown();
            }, REST_MS);
        }
        return found;
    };
}
