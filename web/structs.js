// SPDX-License-Identifier: MIT
// The structures of the C, in its memory: written there, and read from it, by the layouts
// of their headers. Names are as in the C, but camelCase.
import { LAYOUT } from './built.js';
import { exported } from './engine.js';

const SCALARS = { bool: 'Uint8', int: 'Int32', pointer: 'Uint32', double: 'Float64' };
const PAGE = 65536;

let lent = { at: 0, bytes: 0 };

// Where so many bytes are free, until the next call: what a call of the C is given, and
// what it returns.
export function room(bytes) {
    if (bytes > lent.bytes) {
        const pages = Math.ceil((bytes - lent.bytes) / PAGE);
        const at = exported().memory.grow(pages) * PAGE;
        lent = { at: lent.at || at, bytes: lent.bytes + pages * PAGE };
    }
    return lent.at;
}

export const sizeOf = (type) => LAYOUT[type].size;

function readFrom(view, type, at) {
    if (type in SCALARS) {
        const value = view[`get${SCALARS[type]}`](at, true);
        return type === 'bool' ? value !== 0 : value;
    }
    return Object.fromEntries(Object.entries(LAYOUT[type].members).map(([name, [of, from, count]]) => {
        if (count === undefined) {
            return [name, readFrom(view, of, at + from)];
        }
        return [name, of === 'double' ? new Float64Array(view.buffer, at + from, count).slice()
            : Array.from({ length: count }, (_, i) => readFrom(view, of, at + from + i * sizeOf(of)))];
    }));
}

function writeTo(view, type, at, value) {
    if (type in SCALARS) {
        view[`set${SCALARS[type]}`](at, Number(value), true);
    } else {
        Object.entries(LAYOUT[type].members).forEach(([name, [of, from]]) => writeTo(view, of, at + from, value[name]));
    }
}

const view = () => new DataView(exported().memory.buffer);

export const read = (type, at) => readFrom(view(), type, at);

// One without arrays.
export const write = (type, at, value) => writeTo(view(), type, at, value);

export const doubles = (at, count) => new Float64Array(exported().memory.buffer, at, count);
