// SPDX-License-Identifier: MIT
// A record of fixpid_autotune_pack, as a chip prints it.
import { LIMIT } from './built.js';

// { bytes } or { refused: a sentence }; neither where there is no text. Between
// the bytes may be white space, commas and 0x, as in an array of C.
export function readRecord(text) {
    const digits = text.replace(/0x|[\s,]/gi, '');
    if (digits === '') {
        return {};
    }
    const wrong = digits.match(/[^0-9a-f]/i);
    if (wrong !== null) {
        return { refused: `A record is hexadecimal, and “${wrong[0]}” is not a hexadecimal digit.` };
    }
    if (digits.length !== 2 * LIMIT.RECORD_SIZE) {
        return { refused: `A record has ${LIMIT.RECORD_SIZE} bytes, two digits each; this has ${digits.length} digits instead of ${2 * LIMIT.RECORD_SIZE}.` };
    }
    const bytes = Uint8Array.from(digits.match(/../g), (pair) => parseInt(pair, 16));
    if (bytes[0] !== LIMIT.RECORD_VERSION) {
        return { refused: `The record is of version ${bytes[0]}, and this page reads version ${LIMIT.RECORD_VERSION}.` };
    }
    return { bytes };
}

// Sixteen bytes a line.
export function recordText(bytes) {
    const pairs = Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0'));
    const lines = pairs.map((pair, i) => pair + (i % 16 === 15 ? '\n' : ' '));
    return lines.join('').trim();
}
