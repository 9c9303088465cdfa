// SPDX-License-Identifier: MIT
// The text of a recording as a table of numbers: how its lines are cut and which
// mark its decimals have is found from the lines themselves.

const SAMPLE = 300; // lines by which the form is chosen
const HOLES = /^(nan|n\/a|#n\/a|null|none|nil|-+|\?+|err(or)?|ovf)?$/i;
const SWITCHED = { on: 1, true: 1, ein: 1, off: 0, false: 0, aus: 0 };
const CLOCK = /^(?:(\d{4})-(\d\d?)-(\d\d?)|(\d\d?)([./])(\d\d?)\5(\d{4}))?[T ]?(?:(\d{1,4}):(\d\d)(?::(\d\d)(?:[.,](\d+))?)?)? ?([ap])?m?(Z|[+-]\d\d:?\d\d)?$/i;
const THOUSANDS_OR_TWO = /(?:^|,)[1-9]\d{0,2},0\d\d(?:\.\d*)?(?:,|$)/;
const DATE_AND_TIME = /(\d{4}-\d\d?-\d\d?|\d\d?([./])\d\d?\2\d{4})[ ,;\t]+(?=\d\d?:\d\d)/g;
const HALF_OF_DAY = /(:\d\d(?:[.,]\d+)?)\s+([ap])\.?m\b\.?/gi;
const LABEL = /^[A-Za-z_][\w ]*[=:] */;

// Separators in the order in which they are tried.
const FORMS = [
    { name: 'tabs', cut: '\t', decimal: '.' }, { name: 'tabs', cut: '\t', decimal: ',' },
    { name: 'semicolons', cut: ';', decimal: '.' }, { name: 'semicolons', cut: ';', decimal: ',' },
    { name: 'commas', cut: ',', decimal: '.' }, { name: 'commas and blanks', cut: /, +/, decimal: '.' },
    { name: 'blanks', cut: / +/, decimal: '.' }, { name: 'blanks', cut: / +/, decimal: ',' },
    { name: 'commas and blanks', cut: /, +/, decimal: ',' },
];
const PLAIN = {
    '.': /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?) ?([a-z%°µ/]*)$/i,
    ',': /^([+-]?(?:\d+,?\d*|,\d+)(?:e[+-]?\d+)?) ?([a-z%°µ/]*)$/i,
};
const THOUSANDS = {
    '.': /^[+-]?[1-9]\d{0,2}(?:[,'’\u00a0\u202f]\d{3})+(?:\.\d*)?$/,
    ',': /^[+-]?[1-9]\d{0,2}(?:[.'’\u00a0\u202f]\d{3})+(?:,\d*)?$/,
};

// What a cell says: { kind, value } with a kind of number, thousands, clock, hole or
// text, and `why` where it is text that was meant to be more.
export function readCell(cell, decimal) {
    const plain = PLAIN[decimal].exec(cell);
    const beyond = plain !== null && !Number.isFinite(Number(plain[1].replace(',', '.')));
    if (plain !== null && !beyond) {
        return { kind: 'number', value: Number(plain[1].replace(',', '.')), unit: plain[2] };
    }
    if (THOUSANDS[decimal].test(cell)) {
        const digitsOnly = cell.replace(decimal === '.' ? /[,'’\u00a0\u202f]/g : /[.'’\u00a0\u202f]/g, '');
        return { kind: 'thousands', value: Number(digitsOnly.replace(',', '.')) };
    }
    if (Object.hasOwn(SWITCHED, cell.toLowerCase())) {
        return { kind: 'number', value: SWITCHED[cell.toLowerCase()] };
    }
    if (HOLES.test(cell)) {
        return { kind: 'hole', value: NaN };
    }
    if (beyond || /^[+-]?inf(inity)?$/i.test(cell)) {
        return { kind: 'hole', value: NaN, why: `“${cell}” is no measurement` };
    }
    return clockOf(cell);
}

// Seconds since midnight, or since 1970 where the cell has a date.
function clockOf(cell) {
    const found = CLOCK.exec(cell);
    const text = (why) => ({ kind: 'text', value: NaN, why });
    if (found === null || (found[8] === undefined && found[1] === undefined && found[4] === undefined)) {
        return text(`“${cell.slice(0, 20)}” is no number`);
    }
    const half = found[12]?.toLowerCase();
    let hours = Number(found[8] ?? 0);
    const [minutes, seconds] = [Number(found[9] ?? 0), Number(found[10] ?? 0)];
    if (minutes > 59 || seconds > 60 || (half !== undefined && (hours < 1 || hours > 12))) {
        return text(`“${cell.slice(0, 20)}” is no time of day`);
    }
    if (half !== undefined) {
        hours = hours % 12 + (half === 'p' ? 12 : 0); // 12 am is midnight, 12 pm is noon
    }
    const inDay = 3600 * hours + 60 * minutes + seconds + Number(`0.${found[11] ?? 0}`);
    if (found[1] === undefined && found[4] === undefined) {
        return { kind: 'clock', value: inDay };
    }
    const american = found[5] === '/' && Number(found[4]) <= 12;
    const [year, month, day] = (found[1] !== undefined ? found.slice(1, 4)
        : american ? [found[7], found[4], found[6]] : [found[7], found[6], found[4]]).map(Number);
    if (month < 1 || month > 12 || day < 1 || day > 31) {
        return text(`“${cell.slice(0, 20)}” is no date`);
    }
    const zone = /([+-])(\d\d):?(\d\d)/.exec(found[13] ?? '');
    const ahead = zone === null ? 0 : Number(`${zone[1]}1`) * (3600 * Number(zone[2]) + 60 * Number(zone[3]));
    return { kind: 'date', value: Date.UTC(year, month - 1, day) / 1000 + inDay - ahead };
}

// What stands before the numbers of a line, as in `temp:21.5`.
const labelsOf = (line, { cut }) => line.split(cut).map((cell) => LABEL.exec(cell.trim())?.[0].replace(/[=:] *$/, '') ?? '');

// The cells of a line; what stands in quotes is not cut.
function cutLine(line, { cut }) {
    const trimmed = (cell) => cell.trim().replace(/^"(.*)"$/, '$1').replace(/""/g, '"').trim().replace(LABEL, '');
    if (!line.includes('"')) {
        return line.split(cut).map(trimmed);
    }
    const hidden = [];
    const open = line.replace(/"[^"]*"/g, (quoted) => `\u0001${hidden.push(quoted) - 1}\u0001`);
    return open.split(cut).map((cell) => trimmed(cell.replace(/\u0001(\d+)\u0001/g, (_, at) => hidden[at])));
}

function tidyLine(line) {
    return line.includes(':') ? line.replace(DATE_AND_TIME, '$1T').replace(HALF_OF_DAY, '$1$2m').trim() : line.trim();
}

const isComment = (line) => line === '' || /^(#|\/\/|%|--)/.test(line);

function isData(cells, decimal) {
    const kinds = cells.map((cell) => readCell(cell, decimal).kind);
    return kinds.some((kind) => kind !== 'text' && kind !== 'hole') && kinds.filter((kind) => kind === 'text').length * 2 < kinds.length;
}

function commonest(numbers) {
    const times = new Map();
    numbers.forEach((one) => times.set(one, (times.get(one) ?? 0) + 1));
    return [...times].reduce((most, one) => (one[1] > most[1] ? one : most), [0, 0])[0];
}

// How well a form reads these lines: one point for each line that has the commonest
// number of cells, all read; a little less where a mark is taken for thousands.
function scoreOf(form, lines) {
    // In `0.5, 1,234.56` the comma that no blank follows separates nothing.
    const mixed = form.cut === ',' && lines.filter((line) => /,\s/.test(line) && /,\S/.test(line)).length > lines.length / 2;
    const rows = mixed ? [] : lines.map((line) => cutLine(line, form));
    const width = commonest(rows.map((cells) => cells.length));
    if (width < 2) {
        return { score: 0, width };
    }
    let score = 0;
    for (const cells of rows.filter((one) => one.length === width)) {
        const kinds = cells.map((cell) => readCell(cell, form.decimal).kind);
        const read = kinds.filter((kind) => kind !== 'text').length;
        score += read >= 2 ? read / width - 0.1 * kinds.filter((kind) => kind === 'thousands').length / width : 0;
    }
    return { score: score / rows.length, width };
}

function formOf(lines) {
    const withDigits = lines.filter((line) => /\d/.test(line) && !isComment(line));
    const from = Math.max(0, Math.min(20, withDigits.length - 40)); // head lines are at the start
    const sample = withDigits.slice(from, from + SAMPLE);
    return FORMS.map((form) => ({ ...form, ...scoreOf(form, sample) }))
        .reduce((best, one) => (one.score > best.score + 1e-9 ? one : best), alone(sample));
}

// One number on each line.
function alone(sample) {
    const numbers = sample.filter((line) => readCell(line.replace(LABEL, ''), '.').kind === 'number').length;
    return { name: 'single numbers', cut: '\n', decimal: '.', width: 1, score: numbers > 0.9 * sample.length ? 0.5 : 0 };
}

function headOf(cells, width) {
    return cells.length === width ? cells.map((cell) => cell.slice(0, 24)) : [];
}

// A clock that has no date begins anew at midnight.
function unwrapped(column) {
    let [days, last] = [0, NaN];
    return column.map((value) => {
        days += value < last - 43200 ? 1 : 0;
        last = Number.isNaN(value) ? last : value;
        return value + 86400 * days;
    });
}

// Why a text is no table, in one sentence.
function refusalOf(lines) {
    const at = lines.findIndex((line) => !isComment(line));
    if (at < 0) {
        return 'There is no line yet.';
    }
    const first = lines.findIndex((line) => /\d/.test(line) && !isComment(line));
    if (first < 0) {
        return `No line has a number; line ${at + 1} is “${lines[at].slice(0, 30)}”.`;
    }
    const whyOf = (line) => line.split(/[,;\t]/).map((cell) => readCell(cell.trim().replace(LABEL, ''), '.').why).find(Boolean);
    const bad = lines.findIndex((line) => /\d/.test(line) && !isComment(line) && whyOf(line) !== undefined);
    return `Line ${(bad < 0 ? first : bad) + 1} is no row of numbers: ${whyOf(lines[bad] ?? '') ?? `“${lines[first].slice(0, 30)}”`}.`;
}

// The table of a text:
// { names, columns (arrays with NaN for holes), kinds, lines (their numbers), skipped:
// [{ line, why }], form }, or { refused }.
export function readTable(text) {
    const lines = text.replace(/^\ufeff/, '').split(/\r\n|\n|\r/).map(tidyLine);
    const form = formOf(lines);
    if (form.score < 0.3) {
        return { refused: refusalOf(lines) };
    }
    const { width, decimal } = form;
    const twofold = form.cut === ',' ? lines.findIndex((line) => THOUSANDS_OR_TWO.test(line)) : -1;
    if (twofold >= 0) {
        return { refused: `Line ${twofold + 1} may have a number with a comma for its thousands: “${lines[twofold].slice(0, 30)}”. Write numbers without it, or in quotes.` };
    }
    const columns = Array.from({ length: width }, () => []);
    const kinds = Array.from({ length: width }, () => 'number');
    const numbers = [];
    const skipped = [];
    let names = [];
    for (const [at, line] of lines.entries()) {
        if (isComment(line)) {
            continue;
        }
        const cells = cutLine(line, form);
        if (numbers.length === 0 && !isData(cells, decimal)) {
            names = headOf(cells, width);
            continue;
        }
        if (cells.length !== width) {
            skipped.push({ line: at + 1, why: `it has ${cells.length} cells instead of ${width}` });
            continue;
        }
        names = numbers.length === 0 && names.length === 0 && LABEL.test(line) ? labelsOf(line, form) : names;
        const read = cells.map((cell) => readCell(cell, decimal));
        const wrong = read.find((one) => one.why !== undefined);
        if (wrong !== undefined && read.filter((one) => one.why === undefined).length < Math.min(2, width)) {
            skipped.push({ line: at + 1, why: wrong.why });
            continue;
        }
        if (wrong !== undefined) {
            skipped.push({ line: at + 1, why: `${wrong.why}; the rest of it is read` });
        }
        read.forEach(({ kind, value, unit }, i) => {
            columns[i].push(value);
            kinds[i] = kind === 'clock' || kind === 'date' ? kind : kinds[i];
            names[i] ??= unit ?? '';
        });
        numbers.push(at + 1);
    }
    return { names: Array.from({ length: width }, (_, i) => names[i] ?? ''), kinds, lines: numbers, skipped, form,
        columns: columns.map((column, i) => (kinds[i] === 'clock' ? unwrapped(column) : column)) };
}
