// SPDX-License-Identifier: MIT
// A plant of one lag and dead time from a closed loop: what the board drove and measured
// while its setpoint was stepped. The fit sees only what the controller has excited.
import { lowest } from './models.js';

const ROUGH = 0.2; // residual as a part of the swing that is refused
const LAGS = [0.01, 0.03, 0.08, 0.2, 0.6]; // parts of the recording
const DEADS = [0, 0.01, 0.03, 0.08, 0.2];

// Solves a symmetric system of three by elimination; zeros where it has no solution.
function solvedThree(rows) {
    const a = rows.map((row) => [...row]);
    for (let k = 0; k < 3; k++) {
        const pivot = a.slice(k).reduce((best, row) => (Math.abs(row[k]) > Math.abs(best[k]) ? row : best));
        const at = a.indexOf(pivot);
        [a[k], a[at]] = [a[at], a[k]];
        if (Math.abs(a[k][k]) < 1e-9) {
            return [0, 0, 0];
        }
        for (let i = 0; i < 3; i++) {
            if (i !== k) {
                const factor = a[i][k] / a[k][k];
                a[i] = a[i].map((one, c) => one - factor * a[k][c]);
            }
        }
    }
    return a.map((row, k) => row[3] / row[k]);
}

// With a lag and a dead time in steps, the gain, the rest and how far the plant was from its
// rest at the beginning follow by a linear fit: { gain, rest, away, error }. Up to the dead
// time the plant answers what was driven before, which is not known.
function lineOf(u, y, lag, dead) {
    const n = y.length;
    const part = 1 - Math.exp(-1 / lag);
    const [whole, fraction] = [Math.floor(dead), dead - Math.floor(dead)];
    const rows = [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]];
    let [x, decay, yy] = [u[0], 1, 0];
    for (let k = 0; k < n; k++) {
        const columns = [x, 1, decay, y[k]];
        for (let i = 0; i < 3 && k > whole; i++) {
            for (let c = 0; c < 4; c++) {
                rows[i][c] += columns[i] * columns[c];
            }
        }
        yy += k > whole ? y[k] * y[k] : 0;
        const driven = (1 - fraction) * u[Math.max(0, k - whole)] + fraction * u[Math.max(0, k - whole - 1)];
        x += part * (driven - x);
        decay *= 1 - part;
    }
    const [gain, rest, away] = solvedThree(rows);
    const left = yy - gain * rows[0][3] - rest * rows[1][3] - away * rows[2][3];
    return { gain, rest, away, error: Math.sqrt(Math.max(0, left) / (n - whole - 1)) };
}

// What the plant measures with this output, from the first step on.
export function simulated({ gain, rest, away, lag, dead }, u) {
    const part = 1 - Math.exp(-1 / lag);
    const [whole, fraction] = [Math.floor(dead), dead - Math.floor(dead)];
    let [x, decay] = [u[0], 1];
    return Float64Array.from(u, (_, k) => {
        const value = gain * x + rest + away * decay;
        x += part * ((1 - fraction) * u[Math.max(0, k - whole)] + fraction * u[Math.max(0, k - whole - 1)] - x);
        decay *= 1 - part;
        return value;
    });
}

const span = (list) => list.reduce(([a, b], one) => [Math.min(a, one), Math.max(b, one)], [Infinity, -Infinity]).reduce((a, b) => b - a);

// { gain: counts per count, rest, away, lag, dead: in steps, error: counts, part: of the
// swing, refused: a sentence or null }. u and y are of the same steps.
export function fitLoop(u, y) {
    const n = y.length;
    if (n < 40) {
        return { refused: `Only ${n} steps were recorded; at least 40 are needed.` };
    }
    if (span(u) < 2) {
        return { refused: 'The output stood still, so nothing is known of the plant.' };
    }
    const judged = ([a, dead]) => lineOf(u, y, Math.exp(Math.min(20, Math.max(-3, a))), Math.min(n / 2, Math.abs(dead)));
    const starts = LAGS.flatMap((lag) => DEADS.map((dead) => [Math.log(lag * n), dead * n]));
    const best = starts.map((start) => ({ start, error: judged(start).error })).sort((a, b) => a.error - b.error).slice(0, 3)
        .map(({ start }) => lowest((x) => judged(x).error, start, [0.3, Math.max(1, 0.01 * n)], 120))
        .reduce((one, other) => (judged(one).error < judged(other).error ? one : other));
    const found = { ...judged(best), lag: Math.exp(best[0]), dead: Math.abs(best[1]) };
    const part = found.error / span(y);
    const refused = !(part < ROUGH) ? `This is no single lag with dead time: ${Math.round(100 * part)} % of the swing is left.`
        : found.dead > n / 3 || found.lag > 3 * n ? 'The recording is too short for this plant: its lag or its dead time is not over in it.'
            : Math.abs(found.gain) < 1e-6 ? 'The measurement does not follow the output.' : null;
    return { ...found, part, refused };
}
