// SPDX-License-Identifier: MIT
// What a rule of the autotuner found, as gains of the page's state.
import { OPTION, WORD } from './built.js';
import { shortest } from './format.js';

// The integers of a rule as the state's real units, which fold to them again.
export function gainsOfRule(s, results) {
    const kiFold = (ki) => Math.floor(ki * 16777216 / s.RATE + 0.5);
    const kdFold = (kd) => Math.floor(kd * 256 * s.RATE / 2 ** results.FILTER + 0.5);
    const options = s.OPTIONS & ~OPTION.PROPORTIONAL_ON_MEASUREMENT;
    return {
        KP: results.KP / 256,
        KI: shortest(results.KI * s.RATE / 16777216, kiFold),
        KD: shortest(results.KD * 2 ** results.FILTER / 256 / s.RATE, kdFold),
        FILTER: results.FILTER, WEIGHT: results.WEIGHT === 0 ? 1 : results.WEIGHT / 256,
        OPTIONS: options | results.OPTIONS,
    };
}

// The same of a record, and what its configuration says of the actuator.
export function gainsOfRecord(s, results) {
    return { ...gainsOfRule({ ...s, OPTIONS: s.OPTIONS & ~OPTION.REVERSE }, results),
        OUTPUT_MIN: results.OUTPUT_MIN, OUTPUT_MAX: results.OUTPUT_MAX };
}

// The row to take first, as docs/tuning.md advises: safe, by a relay PI, by a heat-up PID, or the
// other one where that has no gains.
export function firstRow(rows) {
    const liked = rows[0]?.heated ? 'PID' : 'PI';
    const safe = rows.filter(({ gains, robustness }) => gains !== null && robustness === WORD.SAFE);
    return safe.find(({ rule }) => rule === liked) ?? safe[0] ?? null;
}
