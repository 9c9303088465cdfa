// SPDX-License-Identifier: MIT
// What the columns of a recording are: the time, the setpoint, the drive and the measurement. What
// its text decides is taken, and why is said; what it does not is a question with its answers; what
// cannot be is refused.
import { readTable } from './cells.js';
import { digits, short, time } from './format.js';

export const LEAST_ROWS = 8;
const POINTS_KEPT = 1500; // for the plot
const MOST_VALUES = 4; // columns that are tried as the measurement
const FOLLOWS = 0.1; // of its swing a measurement is away from its setpoint at most
export const UNITS = { ns: 1e-9, 'µs': 1e-6, ms: 1e-3, s: 1, min: 60, h: 3600 };
const TIMES = /^(t|x|time|zeit|sec(ond)?s?|sekunden?|s|ms|millis|min(ute)?s?|timestamp|date|epoch|elapsed|uptime)$/;
const DRIVES = /^(u|out(put)?|op|co|drive|duty.*|pwm|power|heat(er|ing)?(power)?|valve|q|fan|pump|ssr|relay|stell.*|ausgang)$/;
const GOALS = /^((t|temp)?(set|sp|ref|target|goal|wanted|desired)(points?|pt|temp(erature)?|val(ue)?|erence|speed)?|(t|temp)?soll.*|sv)$/;
const FULLS = [255, 1023, 4095, 10000, 32767, 65535];

function quantile(values, part) {
    const sorted = Float64Array.from(values).sort();
    return sorted[Math.round(part * (sorted.length - 1))];
}

const median = (values) => quantile(values, 0.5);
const knownOf = (column) => column.filter((value) => !Number.isNaN(value));
const differences = (column) => column.slice(1).map((value, i) => value - column[i]);
const rangeOf = (column) => column.reduce(([low, high], one) => [Math.min(low, one), Math.max(high, one)], [Infinity, -Infinity]);
// With holes as the value before them.
function holesFilled(column) {
    let last = column.find((value) => !Number.isNaN(value));
    return column.map((value) => (last = Number.isNaN(value) ? last : value));
}

const swingOf = (column) => rangeOf(column).reduce((low, high) => high - low);

// The words of a name, without its unit, with digits and capitals as ends.
const wordsOf = (name) => name.replace(/[[(].*?[\])]/g, ' ').replace(/([a-z])([A-Z])/g, '$1 $2').toLowerCase().split(/[^a-zäöüß]+/).filter(Boolean);
const isDriveName = (name) => wordsOf(name).some((word, _, all) => DRIVES.test(word) || (word === 'mv' && all.length === 1));
const isGoalName = (name) => wordsOf(name).some((word, _, all) => GOALS.test(word) || (word === 'w' && all.length === 1));

// --- The time -----------------------------------------------------------------------

// The share of a column's steps that do not go back; 0 where it mostly stands still.
function risingPart(column) {
    const steps = differences(knownOf(column));
    const still = steps.filter((step) => step === 0).length;
    return steps.length < 1 || still > 0.5 * steps.length ? 0 : steps.filter((step) => step >= 0).length / steps.length;
}

// Lines come more evenly than a measurement rises.
function isEven(column) {
    const steps = differences(knownOf(column)).filter((step) => step > 0);
    return steps.length > 0 && quantile(steps, 0.9) < 5 * quantile(steps, 0.1);
}

function timeColumn({ names, columns, kinds }) {
    const clock = kinds.findIndex((kind) => kind !== 'number');
    if (clock >= 0 || columns.length < 2) {
        return clock;
    }
    const rising = columns.map(risingPart);
    const named = [...names.keys()].filter((i) => TIMES.test(wordsOf(names[i])[0]) && rising[i] > 0.9);
    return named.find((i) => isEven(columns[i])) ?? named[0] ?? rising.findIndex((part, i) => part > 0.98 && isEven(columns[i]));
}

// 5 ms, 1.5 s, 3 min 20 s, 1 h 40 min
function lasting(seconds) {
    const [large, small, size] = seconds < 5400 ? ['min', 's', 60] : ['h', 'min', 3600];
    if (seconds < 120) {
        return time(seconds);
    }
    const rest = Math.round((seconds % size) / (size / 60));
    return `${Math.floor(seconds / size)} ${large}${rest > 0 ? ` ${rest} ${small}` : ''}`;
}

// { unit, why }, of a column of times, or { unit, ask } where whole numbers tell nothing.
export function unitOfTime(name, kind, column) {
    if (kind !== 'number') {
        return { unit: 's', why: 'a clock’s time' };
    }
    const named = /(?:^|[^a-z])(ns|µs|us|ms|millis\w*|sec\w*|s|min\w*|h)[\])]?$/i.exec(name.trim());
    if (named !== null) {
        const word = named[1].toLowerCase();
        const unit = word.startsWith('milli') ? 'ms' : word.startsWith('sec') ? 's' : word.startsWith('min') ? 'min' : word === 'us' ? 'µs' : word;
        return { unit, why: 'by its name' };
    }
    const size = Math.abs(median(column.slice(0, 1000)));
    if (size > 1e9) {
        return { unit: size > 1e17 ? 'ns' : size > 1e14 ? 'µs' : size > 1e11 ? 'ms' : 's', why: 'it counts from 1970' };
    }
    if (!column.every(Number.isInteger)) {
        return { unit: 's', why: 'its steps have fractions' };
    }
    const steps = differences(column).filter((step) => step > 0);
    const step = median(steps);
    const regular = step === 1 || steps.every((one) => one % step === 0); // missing lines are whole steps
    const all = swingOf(column);
    const answers = [['s', 1], ['ms', 1e-3]].map(([value, scale]) => ({ value, text: `${value}: ${lasting(step * scale)} apart, ${lasting(all * scale)} in all` }));
    return { unit: regular ? 's' : 'ms', ask: { key: 'unit', text: 'Are the times seconds or milliseconds? They are whole numbers without a unit.', answers, chosen: regular ? 's' : 'ms',
        ...(steps.every((one) => one === 1) ? { other: 'lines, so many seconds apart:' } : {}) } };
}

// From one line at which the time goes back to the next: [{ from, to }], places of rows.
function partsOf(times) {
    const starts = [0, ...differences(times).flatMap((step, i) => (step < 0 ? [i + 1] : [])), times.length];
    return starts.slice(1).map((to, i) => ({ from: starts[i], to }));
}

// The rows that are used, in the order in which they were written: { t (seconds from the first),
// columns, ask: a question, or null }.
function rowsOf(table, times, scale, choice) {
    const at = [...times.keys()].filter((i) => !Number.isNaN(times[i]));
    const parts = partsOf(at.map((i) => times[i]));
    const longest = parts.reduce((best, one, k) => (one.to - one.from > parts[best].to - parts[best].from ? k : best), 0);
    const { from, to } = parts[choice ?? longest] ?? parts[longest];
    const used = at.slice(from, to);
    const line = (place) => table.lines[at[place]];
    const ask = parts.length < 2 ? null : { key: 'part', text: `The time goes back in line ${line(parts[1].from)}. Which part is the recording?`, chosen: String(longest),
        answers: parts.slice(0, 6).map((part, k) => ({ value: String(k), text: `lines ${line(part.from)} to ${line(part.to - 1)}` })) };
    return { t: used.map((i) => (times[i] - times[used[0]]) * scale), columns: table.columns.map((column) => used.map((i) => column[i])), ask };
}

// --- The setpoint, the drive and the measurement --------------------------------------

// Where a column that stands still by stretches ends each of them: places.
const stretchEnds = (column) => [...differences(column).flatMap((step, i) => (step !== 0 ? [i] : [])), column.length - 1];

// Whether it moves seldom and far, as a drive that is stepped by hand; a measurement moves all the time.
function isStepped(column) {
    const moves = differences(column).filter((step) => step !== 0).map(Math.abs);
    return moves.length > 0 && (new Set(column).size === 2 || (moves.length <= 0.2 * column.length && median(moves) >= 0.1 * swingOf(column)));
}

// How near a measurement comes to what this column says at the end of most of its stretches, as a part
// of its swing.
function distanceOf(column, value) {
    return quantile(stretchEnds(column).map((i) => Math.abs(value[i] - column[i])), 0.5) / swingOf(value);
}

// Of columns that are no time, why each is a setpoint: by its name, or as a measurement comes to it.
function setpointsOf(others, choices) {
    const isFollower = (goal, one) => one !== goal && one.moves && !one.named && !isStepped(one.column) && distanceOf(goal.column, one.column) <= FOLLOWS;
    const whyOf = (one) => {
        if (one.i === choices.drive || one.i === choices.value) {
            return null;
        }
        const followed = !one.named && one.moves && isStepped(one.column) && others.some((other) => isFollower(one, other));
        return isGoalName(one.name) ? 'a setpoint, by its name' : followed ? 'a setpoint: the measurement comes to it' : null;
    };
    return others.map((one) => ({ ...one, why: whyOf(one) })).filter(({ why }) => why !== null);
}

// The one of these columns that comes to a setpoint by far the nearest, or null.
function followerOf(goals, columns) {
    const goal = goals.find(({ moves }) => moves);
    const [nearest, second] = goal === undefined ? [] : columns.map((one) => ({ one, away: distanceOf(goal.column, one.column) })).sort((a, b) => a.away - b.away);
    return nearest?.away <= FOLLOWS && !(second?.away <= Math.min(FOLLOWS, 5 * nearest.away)) ? nearest.one : null;
}

// Which columns may be the drive, and why. `left` are those that move and are no setpoint.
function drivesOf(left, { others, goals, value }) {
    const named = left.filter((one) => one.named);
    const still = others.filter((one) => one.named && !one.moves).slice(0, 1);
    const stepped = left.filter(({ column }) => isStepped(column));
    const follower = followerOf(goals, left);
    const alone = follower !== null || value !== null ? left.filter((one) => one !== follower) : left.length > 1 ? left : [];
    const kinds = [[named, 'by its name'], [still, 'by its name'], [stepped, 'it stands still and steps'], [alone, 'the only other one that moves']];
    const [candidates, why] = kinds.find(([list]) => list.length > 0) ?? [[], ''];
    return { candidates: candidates.map(({ i }) => i), why };
}

// { time, goals, drive, values, asked: columns of which one is the drive, or [], loads: other drives,
// whys }. A drive of -1 is none.
function rolesOf({ names, columns }, time, choices) {
    const others = columns.map((whole, i) => ({ i, name: names[i], column: holesFilled(whole), named: isDriveName(names[i]) }))
        .filter(({ i, column }) => i !== time && column[0] !== undefined).map((one) => ({ ...one, moves: swingOf(one.column) > 0 }));
    const setpoints = setpointsOf(others, choices);
    const goals = setpoints.map(({ i }) => i);
    const left = others.filter(({ i, moves }) => moves && !goals.includes(i) && i !== choices.value);
    const { candidates, why } = drivesOf(left, { others: others.filter(({ i }) => !goals.includes(i)), goals: setpoints, value: choices.value });
    const drive = choices.drive ?? (candidates.length === 1 ? candidates[0] : -1);
    const undriven = left.filter(({ i }) => i !== drive);
    const measured = undriven.filter(({ named }) => !named);
    const values = choices.value !== null ? [choices.value] : (measured.length > 0 ? measured : undriven).slice(0, MOST_VALUES).map(({ i }) => i);
    return { time, goals, drive, values, asked: choices.drive === null && candidates.length > 1 ? candidates : [],
        loads: drive < 0 ? [] : undriven.filter(({ named }) => named).map(({ i }) => i),
        whys: { ...Object.fromEntries(setpoints.map((one) => [one.i, one.why])), drive: choices.drive !== null ? 'as you chose' : drive < 0 ? '' : why } };
}

// Whether an on/off drive switches faster than it is logged: its runs are mostly one line, and do not
// come in windows of some lines.
function isAliased(drive) {
    const ends = stretchEnds(drive);
    const runs = ends.map((end, k) => end - (ends[k - 1] ?? -1));
    const windows = runs.slice(2).map((run, k) => run + runs[k + 1]);
    const usual = windows.length > 0 ? median(windows) : 0;
    const regular = usual > 3 && windows.filter((one) => Math.abs(one - usual) <= 1).length > 0.8 * windows.length;
    return new Set(drive).size === 2 && runs.length >= 8 && !regular && runs.filter((length) => length === 1).length >= 0.4 * runs.length;
}

// What full drive is, in the recording's numbers: { full, why } or { ask }.
export function fullOf(name, drive, most) {
    const high = Math.max(...rangeOf(drive).map(Math.abs));
    if (/%|percent|prozent|pct/i.test(name)) {
        return { full: 100, why: 'percent, by its name' };
    }
    if (drive.every((one) => one === 0 || one === 1)) {
        return { full: 1, why: 'on and off' };
    }
    const near = FULLS.find((one) => Math.abs(high / one - 1) <= 0.01);
    if (near !== undefined) {
        return { full: near, why: `it goes to ${short(high)}` };
    }
    const own = most > 0 && !FULLS.includes(most) && most !== 100 ? [[most, `${most}, this page’s highest output`]] : [];
    const all = [[1, '1'], [100, '100 %'], [255, '255'], [1023, '1023'], [4095, '4095'], ...own];
    const answers = [...all, ...(all.some(([value]) => value === high) ? [] : [[high, `${short(high)}, the highest here`]])].filter(([value]) => value >= high && (value > 1 || high <= 1))
        .map(([value, text]) => ({ value: String(value), text }));
    return { ask: { key: 'full', text: `The drive goes up to ${short(high)}. How much is full drive?`, answers, other: 'another number', chosen: drive.includes(100) ? '100' : undefined } };
}

// --- All of it ------------------------------------------------------------------------

// Means of neighbours, so that POINTS_KEPT points are left for a plot.
export function thinned(list) {
    const every = Math.ceil(list.length / POINTS_KEPT);
    return every <= 1 ? list : Array.from({ length: Math.ceil(list.length / every) }, (_, i) => {
        const part = list.slice(i * every, (i + 1) * every);
        return part.reduce((sum, one) => sum + one, 0) / part.length;
    });
}

// Lines of one measurement: { t, u, y, holes }.
export function linesOf({ t, columns, drive }, value) {
    const y = columns[value];
    const at = [...t.keys()].filter((i) => !Number.isNaN(y[i]));
    return { t: at.map((i) => t[i]), u: at.map((i) => drive[i]), y: at.map((i) => y[i]), holes: t.length - at.length };
}

function readingNotes(table, names, { loads, goals, whys }) {
    const plural = (count, noun) => `${count} ${noun}${count === 1 ? '' : 's'}`;
    return [...goals.map((i) => `${nameOf(names, i)} is ${whys[i]}.`), ...loads.map((i) => `${nameOf(names, i)} moves, too: to this fit it is a load.`),
        ...(table.form.decimal === ',' ? ['Decimals have a comma.'] : []), ...table.skipped.slice(0, 3).map(({ line, why }) => `Line ${line}: ${why}.`),
        ...(table.skipped.length > 3 ? [`${plural(table.skipped.length - 3, 'more line')} of this kind.`] : [])];
}

export const nameOf = (names, i) => (names[i] ? `“${names[i]}”` : `Column ${i + 1}`);

// A drive that is not in the recording, from a step that was told: { drive, before, ask }.
function toldDrive(t, step) {
    const ask = { key: 'step', text: 'No column is the drive. What was stepped, and when?', step: true };
    return step === null ? { drive: t.map(() => 100), before: 0, ask } : { drive: t.map((one) => (one >= step.at ? step.to : step.from)), before: step.from };
}

function timesOf(table, choices) {
    const at = choices.time ?? timeColumn(table);
    if (at >= 0) {
        const found = unitOfTime(table.names[at], table.kinds[at], knownOf(table.columns[at]));
        return { at, times: table.columns[at], ...found, ...(choices.unit === null ? {} : { unit: choices.unit, why: 'as you chose', ask: undefined }) };
    }
    const every = choices.every ?? 1 / choices.rate;
    const ask = { key: 'every', text: 'No column is a time. How many seconds are the lines apart?', other: 'seconds', chosen: String(every),
        answers: [{ value: String(every), text: `${digits(every)} s, this page’s step` }] };
    return { at: -1, times: table.lines.map((_, i) => i * every), unit: 's', why: 'lines are evenly apart', ask: choices.every === null ? ask : undefined };
}

const NO_CHOICE = { time: null, drive: null, value: null, unit: null, full: null, before: null, part: null, every: null, step: null, rate: 1, most: 0 };

// What is understood of a text: { refused } or { names, roles, unit, full, whys, questions, notes,
// t, columns, drive, before: a number, or null where it is not known }. `choices` are what a
// person said, null where nothing.
export function understood(text, more = {}) {
    const choices = { ...NO_CHOICE, ...more };
    const table = readTable(text);
    if (table.refused !== undefined) {
        return { refused: table.refused };
    }
    const { names } = table;
    const bad = table.skipped.filter(({ why }) => !why.endsWith('is read'));
    if (bad.length > 0.1 * (table.lines.length + bad.length)) {
        return { refused: `${bad.length} of ${table.lines.length + bad.length} lines cannot be read: line ${bad[0].line}: ${bad[0].why}.` };
    }
    const { at: time, times, unit, why, ask } = timesOf(table, choices);
    const rows = rowsOf(table, times, UNITS[unit] ?? Number(unit), choices.part);
    const roles = rolesOf({ names, columns: rows.columns }, time, choices);
    const found = { names, roles, unit, whys: { ...roles.whys, time: why }, notes: readingNotes(table, names, roles), t: rows.t, columns: rows.columns,
        questions: [ask, choices.part === null ? rows.ask : null].filter(Boolean) };
    return { ...found, ...drivenBy(found, choices) };
}

// What drove it: { drive, before, full, questions } or { refused }.
function drivenBy({ names, roles, t, columns, whys, questions }, choices) {
    if (roles.values.length === 0) {
        return { questions: [], refused: 'No column is left for the measurement, or it never moves: choose another.' };
    }
    if (roles.asked.length > 0) {
        return { questions: [...questions, { key: 'drive', text: 'More than one column moves. Which one drove the plant?', answers: [...roles.asked.map((i) => ({ value: String(i), text: nameOf(names, i) })), { value: '-1', text: 'none of them' }] }] };
    }
    if (roles.drive < 0 && choices.drive === null && roles.goals.length > 0) {
        return { questions: [], refused: `${nameOf(names, roles.goals[0])} is a setpoint, which drives nothing: log the output, too. A closed loop without it tells nothing.` };
    }
    if (roles.drive < 0) {
        const { ask, ...told } = toldDrive(t, choices.step);
        return { ...told, full: 100, questions: ask === undefined ? questions : [...questions, ask] };
    }
    const drive = holesFilled(columns[roles.drive]);
    if (isAliased(drive)) {
        return { questions: [], refused: `${nameOf(names, roles.drive)} switches faster than it is logged: log its duty, or log faster.` };
    }
    const { full = null, why = '', ask } = choices.full === null ? fullOf(names[roles.drive], drive, choices.most) : { full: choices.full, why: 'as you chose' };
    return { drive, before: choices.before, full, whys: { ...whys, full: why }, questions: ask === undefined ? questions : [...questions, ask] };
}
