// SPDX-License-Identifier: MIT
// Recordings of our own making: plants that are known, their noise, how a logger
// writes them down, and what goes wrong on the way. The same in each run.

// Responses to a step of 1 at 0, of plants with gain 1: from the poles, each by itself.
const PLANTS = {
    first: ({ lag }) => (t) => 1 - Math.exp(-t / lag),
    second: ({ lag, lag2 }) => (t) => 1 + (lag2 * Math.exp(-t / lag2) - lag * Math.exp(-t / lag)) / (lag - lag2),
    integrating: ({ lag2 = 0 }) => (t) => (lag2 === 0 ? t : t + lag2 * Math.expm1(-t / lag2)),
    ringing: ({ period, damping }) => (t) => {
        const [real, imaginary] = [-damping / period, Math.sqrt(1 - damping ** 2) / period];
        return 1 - Math.exp(real * t) * (Math.cos(imaginary * t) - real / imaginary * Math.sin(imaginary * t));
    },
    ramp: ({ lag }) => (t) => Math.min(1, t / lag),
    none: () => () => 0,
};

// Lines { t, u, y } of a plant: `gain` for a drive of 1, which goes from 0 to `step` after
// `rest` seconds. `load` takes a part of the step away later, `back` all of it; `spikes` moves
// a line now and then. `random` makes a generator of a seed.
export function record(random, { plant, gain = 1, step = 0.3, dead = 0, start = 20, rest = 0, n = 300, every = 2, uneven = 0.2, noise = 0, grid = 0,
    seed = 1, load = null, back = null, spikes = null, ...numbers }) {
    const draw = random(seed);
    const normal = () => Math.sqrt(-2 * Math.log(draw())) * Math.cos(2 * Math.PI * draw());
    const shape = PLANTS[plant](numbers);
    const answer = (t) => (t <= dead ? 0 : shape(t - dead));
    const lines = [];
    let t = 0;
    for (let i = 0; i < n; i++) {
        const u = t >= rest && !(back !== null && t >= back) ? step : 0;
        const pushed = answer(t - rest) - (load === null ? 0 : load.part * answer(t - load.at)) - (back === null ? 0 : answer(t - back));
        const y = start + gain * step * pushed + noise * normal() + (spikes !== null && i % spikes.every === 0 ? spikes.size : 0);
        lines.push({ t, u, y: grid > 0 ? Math.round(y / grid) * grid : y });
        t += every * (1 + uneven * (2 * draw() - 1));
    }
    return lines;
}

const pad = (value) => String(value).padStart(2, '0');

// A time of day, from so many seconds after midnight; of 12 hours with am and pm.
function clock(seconds, half) {
    const hours = Math.floor(seconds / 3600) % 24;
    const rest = `${pad(Math.floor(seconds / 60) % 60)}:${(seconds % 60).toFixed(1).padStart(4, '0')}`;
    return half ? `${hours % 12 === 0 ? 12 : hours % 12}:${rest} ${hours < 12 ? 'am' : 'pm'}` : `${pad(hours)}:${rest}`;
}

const TIMES = {
    s: (t) => t.toFixed(2),
    ms: (t) => String(Math.round(1000 * t)),
    min: (t) => (t / 60).toFixed(5),
    epoch: (t) => (1795694400 + t).toFixed(2),
    epochMs: (t) => String(1795694400000 + Math.round(1000 * t)),
    clock: (t) => clock(12 * 3600 + 245 + t, false),
    midnight: (t) => clock(86400 - 120 + t, false),
    noon: (t) => clock(12 * 3600 - 60 + t, true),
    iso: (t) => new Date(1795694400000 + Math.round(1000 * t)).toISOString(),
    isoBlank: (t) => new Date(1795694400000 + Math.round(1000 * t)).toISOString().replace('T', ' ').replace('Z', ''),
    german: (t) => `26.11.2026 ${clock(12 * 3600 + t, false).replace('.', ',')}`,
};

// The text that a logger makes of lines: separator, decimal mark, thousands, quotes, a
// head, which columns in which order, and how the time is written.
export function written(lines, { separator = ',', decimal = '.', thousands = '', quotes = false, head = '', columns = 'ty', time = 's', drive = 1,
    labels = null, end = '\n', every = {}, add = '' } = {}) {
    const mark = (text) => {
        const [whole, part] = text.split('.');
        const grouped = thousands === '' ? whole : whole.replace(/\B(?=(\d{3})+$)/g, thousands);
        return part === undefined ? grouped : `${grouped}${decimal}${part}`;
    };
    const cell = {
        t: ({ t }) => (['s', 'ms', 'min', 'epoch', 'epochMs'].includes(time) ? mark(TIMES[time](t)) : TIMES[time](t)),
        u: ({ u }) => mark((drive * u).toFixed(drive > 1 ? 0 : 2)),
        y: ({ y }) => mark(y.toFixed(2)),
        g: () => mark('200.0'), // a setpoint that stands still
        a: ({ t }) => mark((23 + 0.4 * Math.sin(t / 50)).toFixed(2)), // the air, nothing to do with it
    };
    const rows = lines.map((line, i) => {
        const cells = [...columns].map((name, k) => {
            const text = cell[name](line);
            return `${labels ? `${labels[k]}=` : ''}${quotes ? `"${text}"` : text}${name === 'y' ? add : ''}`;
        });
        return every[i] ?? cells.join(separator);
    });
    return `${head}${rows.join(end)}${end}`;
}
