// SPDX-License-Identifier: MIT
// What the columns of a recording are: the time, the drive and the measurement,
// the moment of the step, and which values are none.
import { readTable } from './cells.js';

export const LEAST_ROWS = 8;
const POINTS_KEPT = 2000;
const PREVIEW = 5;
const UNITS = { ns: 1e-9, 'µs': 1e-6, ms: 1e-3, s: 1, min: 60, h: 3600 };
const TIME_NAME = /^(t|x|time|zeit|sec(ond)?s?|sekunden?|s|ms|millis|min(ute)?s?|timestamp|date|epoch|uptime)\b/i;
const DRIVE_NAME = /^(u|out(put)?|op|co|drive|duty|pwm|power|heat(er)?|valve|stell\w*|ausgang)\b/i;
const GOAL_NAME = /^(sp|set ?point|set|soll\w*|ref(erence)?|goal|target|r|w)\b/i;

export function quantile(values, part) {
    const sorted = Float64Array.from(values).sort();
    return sorted[Math.min(sorted.length - 1, Math.max(0, Math.round(part * (sorted.length - 1))))];
}

export function median(values) {
    return quantile(values, 0.5);
}

const knownOf = (column) => column.filter((value) => !Number.isNaN(value));

// Every so many: enough to judge a column by.
function sampled(column, most) {
    const every = Math.max(1, Math.floor(column.length / most));
    return every === 1 ? column : column.filter((_, i) => i % every === 0);
}

// The share of a column's steps that do not go back; 0 where it mostly stands still.
function risingPart(column) {
    const values = knownOf(column);
    let [forward, still] = [0, 0];
    for (let i = 1; i < values.length; i++) {
        forward += values[i] >= values[i - 1] ? 1 : 0;
        still += values[i] === values[i - 1] ? 1 : 0;
    }
    return values.length < 2 || still > 0.5 * values.length ? 0 : forward / (values.length - 1);
}

function timeColumn({ names, columns, kinds }) {
    const clock = kinds.findIndex((kind) => kind !== 'number');
    if (clock >= 0) {
        return clock;
    }
    const rising = columns.map(risingPart);
    const named = names.findIndex((name, i) => TIME_NAME.test(name) && rising[i] > 0.9);
    return named >= 0 ? named : rising.findIndex((part) => part > 0.98);
}

// The jump of a column that stands still before and after it: { at, next: where it
// moves again, from, to }, or null. A measurement moves all the time.
export function jumpOf(column) {
    let [at, most] = [-1, 0];
    const moves = [];
    for (let i = 1; i < column.length; i++) {
        const move = Math.abs(column[i] - column[i - 1]);
        if (move > 0) {
            moves.push(i);
        }
        if (move > most * (1 + 1e-9)) {
            [at, most] = [i, move];
        }
    }
    if (at < 0) {
        return null;
    }
    const large = moves.filter((i) => Math.abs(column[i] - column[i - 1]) > 0.25 * most);
    const first = large.filter((i) => i < at).at(-1) ?? 0;
    const next = large.find((i) => i > at) ?? column.length;
    const [from, to] = [median(column.slice(first, at)), median(column.slice(at, next))];
    const still = (value, level) => Math.abs(value - level) <= 0.05 * Math.abs(to - from);
    const quiet = column.filter((value, i) => i >= first && i < next && still(value, i < at ? from : to)).length;
    return large.length <= 6 && quiet >= 0.97 * (next - first) && next - at >= LEAST_ROWS ? { at, first, next, from, to } : null;
}

function driveColumn({ names, columns }, time, value) {
    const found = columns.map((column, i) => ({ i, name: names[i],
        fits: i !== time && i !== value && jumpOf(column) !== null })).filter(({ fits }) => fits);
    return (found.find(({ name }) => DRIVE_NAME.test(name)) ?? found.find(({ name }) => !GOAL_NAME.test(name)) ?? { i: -1 }).i;
}

// The first column that is left and moves, but not as a drive does.
function valueColumn({ names, columns }, time, drive) {
    const left = columns.map((column, i) => ({ i, moves: new Set(sampled(knownOf(column), 200)).size > 1, name: names[i] }))
        .filter(({ i }) => i !== time && i !== drive);
    const own = left.filter(({ i, name, moves }) => moves && !GOAL_NAME.test(name) && !DRIVE_NAME.test(name) && (left.length < 2 || jumpOf(columns[i]) === null));
    return (own[0] ?? left.find(({ moves }) => moves) ?? left[0] ?? { i: -1 }).i;
}

// { unit, why }: of a column of times, from its name, its size or its steps.
export function unitOfTime(name, kind, column) {
    if (kind !== 'number') {
        return { unit: 's', why: 'it is a clock’s time' };
    }
    const named = /(?:^|[^a-z])(ns|µs|us|ms|millis\w*|sec\w*|s|min\w*|h)[\])]?$/i.exec(name.trim());
    if (named !== null) {
        const word = named[1].toLowerCase();
        const unit = word.startsWith('milli') ? 'ms' : word.startsWith('sec') ? 's' : word.startsWith('min') ? 'min' : word === 'us' ? 'µs' : word;
        return { unit, why: `its name is “${name}”` };
    }
    const size = Math.abs(median(sampled(column, 1000)));
    if (size > 1e9) {
        return { unit: size > 1e17 ? 'ns' : size > 1e14 ? 'µs' : size > 1e11 ? 'ms' : 's', why: 'it counts from 1970' };
    }
    const head = column.slice(0, 1000);
    const step = median(head.slice(1).map((value, i) => value - head[i]).filter((one) => one > 0));
    const whole = head.every(Number.isInteger);
    if (whole && step >= 5 && step % 60 !== 0 && step !== 15 && step !== 30) {
        return { unit: 'ms', why: `its lines are whole numbers, ${step} apart` };
    }
    return { unit: 's', why: 'nothing speaks for another' };
}

// The places of values that stand alone, far from the neighbours on both sides, which
// agree.
export function* outliersOf(values) {
    const reach = 3;
    const residuals = new Float64Array(values.length);
    for (let i = 1; i < values.length - 1; i++) {
        if (i % 5000 === 0) {
            yield;
        }
        residuals[i] = values[i] - median(values.slice(Math.max(0, i - reach), i + reach + 1));
    }
    const sizes = residuals.map(Math.abs);
    const range = quantile(values, 0.95) - quantile(values, 0.05);
    const limit = Math.max(8 * 1.4826 * median(sizes), 0.15 * range);
    const alone = (i) => {
        const [before, behind] = [median(values.slice(Math.max(0, i - reach), i)), median(values.slice(i + 1, i + 1 + reach))];
        return Math.abs(before - behind) < 0.3 * Math.min(Math.abs(values[i] - before), Math.abs(values[i] - behind));
    };
    const far = [...sizes.keys()].filter((i) => sizes[i] > limit && alone(i));
    return far.length > 0.05 * values.length ? [] : far;
}

// Means of neighbours, so that at most `most` points are left.
export function thinned(times, values, most = POINTS_KEPT) {
    const every = Math.ceil(times.length / most);
    const means = (list) => Array.from({ length: Math.ceil(list.length / every) }, (_, i) => {
        const part = list.slice(i * every, (i + 1) * every);
        return part.reduce((sum, one) => sum + one, 0) / part.length;
    });
    return every <= 1 ? { times, values } : { times: means(times), values: means(values) };
}

// Where no column is a time, one is added with a line for each step, if the rate is known.
// Its place, or -1.
function withLineTimes(table, rate) {
    if (!(rate > 0) || timeColumn(table) >= 0) {
        return -1;
    }
    table.names.push('lines');
    table.kinds.push('number');
    return table.columns.push(table.lines.map((_, i) => i / rate)) - 1;
}

function rolesOf(table, choices) {
    const own = (asked, found) => (Number.isInteger(asked) && asked < table.columns.length ? asked : found());
    const time = own(choices.time, () => timeColumn(table));
    const drive = own(choices.drive, () => (table.columns.length < 3 ? -1 : driveColumn(table, time, choices.value)));
    const value = own(choices.value, () => valueColumn(table, time, drive));
    return { time, drive, value };
}

// Rows in the order of their times, without those that lack one of them.
function rowsOf(table, roles, scale) {
    const [t, y] = [table.columns[roles.time], table.columns[roles.value]];
    const u = table.columns[roles.drive];
    let order = t.map((_, i) => i).filter((i) => !Number.isNaN(t[i]));
    const holes = order.filter((i) => Number.isNaN(y[i])).length;
    order = order.filter((i) => !Number.isNaN(y[i]));
    const back = order.find((i, k) => k > 0 && t[i] < t[order[k - 1]]);
    if (back !== undefined) {
        order.sort((a, b) => t[a] - t[b]);
    }
    const start = order.length > 0 ? t[order[0]] : 0;
    return { times: order.map((i) => (t[i] - start) * scale), values: order.map((i) => y[i]), drive: u && order.map((i) => u[i]),
        lines: order.map((i) => table.lines[i]), holes, back: back === undefined ? null : table.lines[back] };
}

function without(rows, places) {
    const gone = new Set(places);
    const left = (list) => list && list.filter((_, i) => !gone.has(i));
    return { ...rows, times: left(rows.times), values: left(rows.values), drive: left(rows.drive), lines: left(rows.lines) };
}

// What has to be said of the reading.
function readingNotes(table, rows, far, { unit, why }, chosen) {
    const plural = (count, noun) => `${count} ${noun}${count === 1 ? '' : 's'}`;
    const notes = [`Time is in ${unit}, ${chosen ? 'as you chose' : `as ${why}`}.`];
    const say = (yes, text) => yes && notes.push(text);
    say(table.form.decimal === ',', 'Decimals have a comma.');
    say(far.length > 0, `Left out as outliers: ${far.slice(0, 4).map((i) => `${rows.values[i]} in line ${rows.lines[i]}`).join(', ')}${far.length > 4 ? ` and ${far.length - 4} more` : ''}.`);
    say(rows.holes > 0, `${plural(rows.holes, 'line')} without a measurement left out.`);
    say(rows.back !== null, `Sorted by time, as line ${rows.back} goes back.`);
    table.skipped.slice(0, 3).forEach(({ line, why: reason }) => notes.push(`Line ${line}: ${reason}.`));
    say(table.skipped.length > 3, `${plural(table.skipped.length - 3, 'more line')} of this kind.`);
    return notes;
}

// The step of the drive as a part of what it can be: 30 of 100 %, 76 of 255, 0.3 of 1.
export function partOfDrive({ from, to }, name, most) {
    const high = Math.max(Math.abs(from), Math.abs(to));
    const full = high <= 1 ? 1 : /%/.test(name) ? 100 : most >= high && most !== 1000 ? most
        : [100, 255, 1000, 1023, 4095, 10000, 32767, 65535].find((one) => one >= high) ?? high;
    return { full, step: (to - from) / full, rest: from / full };
}

// What is understood of a text: { refused } or { names, roles, unit, notes, preview, times,
// values (thinned, in seconds from the first line), outliers, stepAt, by: how that was
// found, jump: { from, to } of the drive or null, every: seconds between lines }.
export function* understood(text, choices = {}) {
    const table = yield* readTable(text);
    if (table.refused !== undefined) {
        return { refused: table.refused };
    }
    const timed = withLineTimes(table, choices.rate);
    const refused = (sentence) => ({ refused: sentence, names: table.names, roles, notes: table.skipped.slice(0, 3).map(({ line, why }) => `Line ${line}: ${why}.`) });
    const roles = rolesOf(table, choices);
    const bad = table.skipped.filter(({ why }) => !why.endsWith('is read'));
    if (bad.length > 0.1 * (table.lines.length + bad.length)) {
        return refused(`${bad.length} of ${table.lines.length + bad.length} lines cannot be read: line ${bad[0].line}: ${bad[0].why}.`);
    }
    if (table.lines.length < LEAST_ROWS) {
        return refused(`${table.lines.length} lines can be read; at least ${LEAST_ROWS} are needed.`);
    }
    if (roles.time < 0) {
        return refused('No column rises from line to line: choose the one that is the time.');
    }
    if (roles.value < 0 || roles.value === roles.time) {
        return refused('No column is left for the measurement: choose another.');
    }
    yield;
    const found = choices.unit in UNITS ? { unit: choices.unit }
        : roles.time === timed ? { unit: 's', why: 'no column rises: each line is a step of this page’s rate, which is set first' }
            : unitOfTime(table.names[roles.time], table.kinds[roles.time], knownOf(table.columns[roles.time]));
    const all = rowsOf(table, roles, UNITS[found.unit]);
    if (all.times.length < LEAST_ROWS || all.times.at(-1) <= 0) {
        return refused(all.times.length < LEAST_ROWS ? `${all.times.length} lines have a time and a measurement; at least ${LEAST_ROWS} are needed.`
            : 'The time stands still.');
    }
    yield;
    const far = yield* outliersOf(all.values);
    yield;
    const notes = readingNotes(table, all, far, found, choices.unit in UNITS);
    const rows = without(all, far);
    const jump = rows.drive ? jumpOf(rows.drive) : null;
    if (roles.drive >= 0 && jump === null) {
        notes.push('The drive has no step between two values that stand still.');
    }
    const [from, to] = jump === null ? [0, rows.times.length] : [jump.first, jump.next];
    if (to < rows.times.length) {
        notes.push(`Used up to line ${rows.lines[to - 1]}, where the drive moves again.`);
    }
    const asked = Number.isFinite(choices.stepAt) ? choices.stepAt : null;
    const stepAt = asked ?? (jump === null ? 0 : (rows.times[jump.at - 1] + rows.times[jump.at]) / 2);
    const steps = rows.times.slice(1).map((t, i) => t - rows.times[i]);
    return { names: table.names, roles, unit: found.unit, notes, every: median(steps), count: table.lines.length,
        preview: Array.from({ length: Math.min(PREVIEW, table.lines.length) }, (_, i) => ({ line: table.lines[i], cells: table.columns.map((column) => column[i]) })),
        outliers: far.map((i) => ({ t: all.times[i], value: all.values[i] })), stepAt, by: asked !== null ? 'you' : jump === null ? 'start' : 'drive',
        jump, ...thinned(rows.times.slice(from, to), rows.values.slice(from, to)) };
}
