// SPDX-License-Identifier: MIT
// What the page's plant foretells of a step of the setpoint with the gains that were sent,
// beside what the board then measured.
import { LIMIT } from './built.js';
import { run } from './engine.js';
import { MISSED } from './trace.js';
import { unitsOf } from './units.js';

const LEAST_COUNTS = 8; // of a step that is worth figures
const LEAST_STEPS = 20;
const BEFORE = 20; // steps by whose measurement it is seen whether the board was at rest
const TIMES_SETTLED = 4; // so long is a step watched, of the time that was predicted

// { overshoot: counts, settled: steps or null, iae: counts and steps } of a step to `to`.
export function stepFigures(y, { from, to, band }) {
    const way = Math.sign(to - from);
    const settled = y.findLastIndex((one) => Math.abs(one - to) > band) + 1;
    return { overshoot: y.reduce((most, one) => Math.max(most, way * (one - to)), 0), settled: settled < y.length ? settled : null,
        iae: y.reduce((sum, one) => sum + Math.abs(to - one), 0) };
}

// The measurement that this state's loop has from the step on, which it meets at rest.
function foretold(s, { from, to }) {
    const before = Math.max(BEFORE, Math.min(Math.round(s.DURATION * s.RATE), LIMIT.STEPS / 2));
    const { n, series } = run({ ...s, SETPOINT: unitsOf(s, from), DURATION: LIMIT.STEPS / s.RATE,
        events: [{ at: before / s.RATE, what: 'SETPOINT', a: unitsOf(s, to) }] });
    return n < 0 ? null : series.MEASUREMENT.subarray(before);
}

// Follows the setpoint of a trace for a state with the board's gains. now() looks for what
// is new, and gives the last step that has settled, or is over:
// { from, to, band, rested, missing, came, predicted: measurements, over }; null: none yet.
export function createComparison(trace, s) {
    let [seen, step, told] = [trace.places, null, null];

    function begin(place, from, to) {
        const lead = trace.view(trace.places - place + BEFORE).MEASUREMENT.subarray(0, BEFORE);
        const mean = lead.reduce((sum, one) => sum + one, 0) / lead.length;
        const spread = lead.reduce((most, one) => Math.max(most, Math.abs(one - mean)), 0);
        const size = Math.abs(to - from);
        const band = Math.max(0.02 * size, 1) + Math.min(spread, 0.1 * size);
        const rested = Math.abs(mean - from) <= band;
        const all = foretold(s, { from, to });
        const settled = all === null ? null : stepFigures(all, { from, to, band }).settled;
        const most = all === null ? 0 : Math.min(all.length, settled === null ? Math.round(s.DURATION * s.RATE) : Math.max(LEAST_STEPS, TIMES_SETTLED * settled));
        step = { from, to, band, place, end: place + most, all, rested };
    }

    // The step as it is now; null where it says nothing yet.
    function judged(over) {
        const n = Math.min(trace.places, step.end) - step.place;
        const view = trace.view(trace.places - step.place);
        const came = view.MEASUREMENT.slice(0, n);
        const ended = over || n === step.end - step.place;
        if (n < LEAST_STEPS || !(ended || stepFigures(came, step).settled !== null)) {
            return null;
        }
        return { ...step, over: ended, came, predicted: step.all.slice(0, n),
            missing: view.marks.subarray(0, n).reduce((sum, mark) => sum + Number(mark === MISSED), 0) };
    }

    function now() {
        const { SETPOINT: setpoints, n } = trace.view(trace.places - seen + 1);
        for (let i = 1; i < n; i++) {
            if (setpoints[i] !== setpoints[i - 1]) {
                const place = trace.places - n + i;
                if (step !== null && step.end > place) {
                    step.end = place;
                }
                told = step === null ? told : judged(true) ?? told;
                step = null;
                if (Math.abs(setpoints[i] - setpoints[i - 1]) >= LEAST_COUNTS) {
                    begin(place, setpoints[i - 1], setpoints[i]);
                }
            }
        }
        seen = trace.places;
        if (step !== null) {
            told = judged(false) ?? told;
            step = trace.places >= step.end ? null : step;
        }
        return told;
    }

    return { now };
}
