// SPDX-License-Identifier: MIT
// Numbers as people read them.

// Without digits that say nothing: 0.30000000000000004 is 0.3.
export function short(value) {
    return String(Number(Number(value).toPrecision(6)));
}

export function digits(value, figures = 3) {
    if (value === null || value === undefined || Number.isNaN(value)) {
        return '–';
    }
    if (!Number.isFinite(value)) {
        return '∞';
    }
    const size = Math.abs(value);
    if (size === 0) {
        return '0';
    }
    if (size >= 1e6 || size < 1e-4) {
        return value.toExponential(figures - 1).replace('e', ' e').replace('-', '−');
    }
    const places = Math.max(0, figures - 1 - Math.floor(Math.log10(size)));
    return value.toFixed(Math.min(places, 6)).replace('-', '−');
}

export function time(seconds) {
    return seconds < 0.1 ? `${digits(1000 * seconds)} ms` : `${digits(seconds)} s`;
}

export function percent(part, places = 1) {
    return `${(100 * part).toFixed(places)} %`.replace('-', '−');
}

// Thousands apart, by a narrow space.
export function whole(value) {
    return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, '\u202F').replace('-', '−');
}

// The shortest decimal that `fold` makes the same integer of.
export function shortest(value, fold) {
    const wanted = fold(value);
    for (let figures = 1; figures < 17; figures++) {
        const tried = Number(value.toPrecision(figures));
        if (fold(tried) === wanted) {
            return tried;
        }
    }
    return value;
}
