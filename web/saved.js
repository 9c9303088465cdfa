// SPDX-License-Identifier: MIT
// What is taken along: a run as a table, and all settings and figures as JSON, which
// comes back in.
import { VERSION } from './built.js';
import { LINKED, eventsText, fragmentOf, ofLink } from './state.js';

const FORMAT = 'fixpid tuner';
const COLUMNS = ['SETPOINT', 'MEASUREMENT', 'OUTPUT', 'P', 'I', 'D'];

// Counts, and the measurement in units: as it is, and beside double precision.
export function csvOf(s, { n, series }) {
    const lines = [`time_s,${COLUMNS.map((name) => name.toLowerCase()).join()},value,value_in_double`];
    for (let i = 0; i < n; i++) {
        lines.push([i / s.RATE, ...COLUMNS.map((name) => series[name][i]), series.VALUE_TRUE[i], series.VALUE_TWIN[i]].join());
    }
    return `${lines.join('\n')}\n`;
}

export function jsonOf(s, figures, margins, header) {
    const settings = { preset: s.preset };
    for (const name of [...LINKED, 'unit', 'loop', 'rule', 'events', 'kept']) {
        settings[name.toLowerCase()] = s[name];
    }
    const { curve, angles, steps, ...numbers } = margins;
    return `${JSON.stringify({ format: FORMAT, version: VERSION, link: `#${fragmentOf(s)}`, settings, figures, margins: numbers, header }, null, 2)}\n`;
}

// { state } of such a text, or { why } it is none. What settings do not say is the
// preset's; each goes the way of a link, which lets nothing through that is none.
export function stateOfJson(text) {
    let found;
    try {
        found = JSON.parse(text);
    } catch (error) {
        return { why: `This is not JSON: ${error.message}.` };
    }
    const settings = found?.settings;
    if (found?.format !== FORMAT || typeof settings !== 'object' || settings === null) {
        return { why: 'This JSON was not saved by this page: it lacks its “format” and “settings”.' };
    }
    const parts = [`p=${settings.preset}`];
    for (const name of [...LINKED, 'unit', 'loop', 'rule'].map((one) => one.toLowerCase())) {
        if (['number', 'string'].includes(typeof settings[name])) {
            parts.push(`${name}=${encodeURIComponent(settings[name])}`);
        }
    }
    if (Array.isArray(settings.events)) {
        parts.push(`events=${eventsText(settings.events.filter((event) => typeof event?.what === 'string'))}`);
    }
    if (Array.isArray(settings.kept)) {
        parts.push(`kept=${settings.kept.map((one) => encodeURIComponent(one)).join(';')}`);
    }
    return { state: ofLink(parts.join('&')) };
}
