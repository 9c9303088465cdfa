// SPDX-License-Identifier: MIT
// A log of what a board sent: its bytes as they came, as hexadecimal text, or as the JSON
// that this page saves; and what is saved of a session.
import { CONFIG, VERSION } from './built.js';
import { LEAST_ROWS } from './columns.js';
import { MISSED } from './trace.js';

const LOG_FORMAT = 'fixpid live';
const HEX_LINE = 32; // bytes
const digitsOf = (byte) => byte.toString(16).padStart(2, '0');

function bytesOfHex(text) {
    const digits = text.replace(/0x|[\s,;:]/gi, '');
    const wrong = digits.match(/[^0-9a-f]/i);
    if (wrong !== null || digits.length % 2 === 1) {
        return { refused: wrong !== null ? `A log is hexadecimal, and “${wrong[0]}” is not a hexadecimal digit.` : 'A log has two digits for each byte; here one digit is left over.' };
    }
    const bytes = new Uint8Array(digits.length / 2);
    for (let at = 0; at < bytes.length; at++) {
        bytes[at] = parseInt(digits.slice(2 * at, 2 * at + 2), 16);
    }
    return { bytes };
}

// A text whose lines have numbers, as a serial plotter takes them, or null.
export function columnsOfText(text) {
    const lines = text.split(/[\r\n]+/).filter((line) => line.trim() !== '');
    const numbers = lines.filter((line) => /(^|[^\w.])[-+]?\.?\d/.test(line)).length;
    return lines.length >= LEAST_ROWS && numbers >= 0.75 * lines.length ? text : null;
}

// { bytes } or { refused: a sentence } of a text, with its `columns` if it may have some.
export function bytesOfText(text) {
    return { ...bytesOfLog(text), columns: columnsOfText(text) };
}

function bytesOfLog(text) {
    if (text.trimStart().startsWith('{')) {
        try {
            const found = JSON.parse(text);
            return found.format === LOG_FORMAT && Array.isArray(found.bytes) ? bytesOfHex(found.bytes.join('')) : { refused: 'This JSON is not a log that this page saved.' };
        } catch (error) {
            return { refused: `This is not JSON: ${error.message}.` };
        }
    }
    return bytesOfHex(text);
}

// Of a file, which is text only if every byte of it can be.
export function bytesOfFile(bytes) {
    const isText = bytes.every((byte) => (byte >= 32 && byte < 127) || byte === 9 || byte === 10 || byte === 13);
    return isText ? bytesOfText(new TextDecoder().decode(bytes)) : { bytes };
}

// The steps that are held, of `view` as a trace gives it.
export function csvOfTrace(view, seconds) {
    const lines = ['time_s,setpoint,measurement,output,p,i,d,flags,compared'];
    for (let i = 0; i < view.n; i++) {
        if (view.marks[i] !== MISSED) {
            lines.push([i * seconds, view.SETPOINT[i], view.MEASUREMENT[i], view.OUTPUT[i],
                ...['P', 'I', 'D'].map((name) => (view.marks[i] === 0 ? Number(view[name][i].toPrecision(7)) : '')), view.FLAGS[i], view.marks[i] === 0 ? 'equal' : 'no'].join());
        }
    }
    return `${lines.join('\n')}\n`;
}

// All that is known, with the bytes themselves: opened again, it is compared again.
export function jsonOfSession({ board, config, counts, sent, bytes, whole }) {
    const lines = [];
    for (let at = 0; at < bytes.length; at += HEX_LINE) {
        lines.push(Array.from(bytes.subarray(at, at + HEX_LINE), digitsOf).join(''));
    }
    const settings = config && Object.fromEntries(Object.keys(CONFIG).map((name) => [name.toLowerCase(), config[name]]));
    return `${JSON.stringify({ format: LOG_FORMAT, version: VERSION, board, config: settings, counts, sent, whole, bytes: lines }, null, 1)}\n`;
}
