// SPDX-License-Identifier: MIT
// A recording's models: which plant it tells of, in words, and as the page's plant.
import { FIT_KIND, FIT_REASON, FIT_START, PLANT } from './built.js';
import { linesOf, nameOf, thinned, understood } from './columns.js';
import { digits } from './format.js';
import { identify, identifyCurve, sentenceOf } from './identify.js';

export const KIND_NAMES = { [FIT_KIND.FIRST]: 'One lag', [FIT_KIND.SECOND]: 'Two lags', [FIT_KIND.INTEGRATING]: 'Integrating', [FIT_KIND.RINGING]: 'Ringing' };
const ALIKE = 0.9; // r2 of a second measurement that the drive explains, too

// The fit of lines { t, u, y } in seconds, as identify.js has it, with the sentence of its reason and
// each model's curve; null in the place of models that there are none of.
export function fitOf(lines, before) {
    const found = identify({ ...lines, before });
    const known = found.models.some(({ plant }) => plant.gain !== 0);
    const models = known ? found.models.map((model) => ({ ...model, curve: identifyCurve(model), sentence: sentenceOf(model.reason) })) : null;
    return { ...found, models, sentence: sentenceOf(found.reason) };
}

// Whether nobody knows what was before the first line, and it matters.
function asksBefore(fit, { u }, { before = null }) {
    return before === null && u[0] !== 0 && (fit.reason === FIT_REASON.DRIVE_STANDS || fit.reason === FIT_REASON.UNSURE_START);
}

const ASK_BEFORE = { key: 'before', text: 'Was the drive off before the first line, and the plant at rest?', other: 'at rest with another drive',
    answers: [{ value: '0', text: 'off and at rest' }, { value: 'moving', text: 'it was running' }] };

// What is understood of a text, and the fit of its best measurement: { read, fit }; fit is null where
// a question comes first or all is refused.
export function recordingOf(text, choices) {
    const read = understood(text, choices);
    if (read.drive === undefined) {
        return { read: shownOf(read), fit: null };
    }
    const fits = read.roles.values.map((value) => {
        const lines = linesOf(read, value);
        const fit = fitOf(lines, Number.isFinite(read.before) ? read.before : null);
        return { value, lines, fit, r2: fit.models?.[fit.chosen].r2 ?? 0 };
    });
    const best = fits.reduce((one, other) => (other.r2 > one.r2 ? other : one));
    const alike = fits.filter((one) => one === best || (one.r2 > ALIKE && one.fit.reason === FIT_REASON.USABLE));
    const { roles: { values } } = read;
    const why = choices.value != null ? 'as you chose' : values.length > 1 ? 'the drive explains it best' : 'the only one that is left';
    const asked = [...(alike.length > 1 ? [{ key: 'value', text: 'The drive moves more than one column. Which one is the measurement?', chosen: String(best.value),
        answers: alike.map(({ value }) => ({ value: String(value), text: nameOf(read.names, value) })) }] : []), ...(asksBefore(best.fit, best.lines, choices) ? [ASK_BEFORE] : [])];
    return { read: shownOf({ ...read, value: best.value, whys: { ...read.whys, value: why }, questions: [...read.questions, ...asked] }, best.lines), fit: best.fit };
}

// What the page shows of it: no whole columns.
function shownOf({ t, columns, drive, ...read }, lines = null) {
    const { low, high } = lines === null ? {} : lines.y.reduce((ends, one) => ({ low: Math.min(ends.low, one), high: Math.max(ends.high, one) }), { low: Infinity, high: -Infinity });
    return lines === null ? read : { ...read, range: { low, high }, count: lines.t.length, notes: [...read.notes, ...(lines.holes > 0 ? [`${lines.holes} line${lines.holes > 1 ? 's' : ''} without a measurement left out.`] : [])],
        points: { t: thinned(lines.t), y: thinned(lines.y), u: thinned(lines.u) } };
}

// What has to be said of a fit, beside its numbers.
export function fitNotes({ models, chosen, assumed, outliers, stuckFrom, stuckTo }) {
    const start = models?.[chosen].start;
    return [...(outliers > 0 ? [`${outliers} line${outliers > 1 ? 's' : ''} that stand alone left out.`] : []),
        ...(stuckTo > 0 ? [`The sensor stood still from ${digits(stuckFrom)} s to ${digits(stuckTo)} s, which is left out.`] : []),
        ...(assumed ? ['Rest before the first move of the drive is taken for granted: too few lines are before it.'] : []),
        ...(start === FIT_START.COLD ? ['It is taken to be off and at rest before the first line.'] : []),
        ...(start === FIT_START.MOVING ? ['It was on its way from something before: that is fitted, too.'] : []),
        ...(start === FIT_START.DRIFTING ? ['It drifted evenly before the drive moved: that is fitted, too.'] : [])];
}

// What is far shorter than all else is none.
const shownSeconds = (x, { lag, lag2, dead }) => (x < 1e-4 * (lag + lag2 + dead) ? 0 : x);

// A plant's numbers, of a recording whose full drive is known, or for a unit of its drive.
export function modelText(plant, full, unit) {
    const { kind, gain, lag, lag2, damping } = plant;
    const per = `${digits(gain * (full ?? 1))} ${unit}${kind === FIT_KIND.INTEGRATING ? '/s' : ''} ${full === null ? 'for a drive of 1' : 'at full drive'}`;
    const late = `dead time ${digits(shownSeconds(plant.dead, plant))} s`;
    switch (kind) {
    case FIT_KIND.INTEGRATING: return `Slope ${per}, lag ${digits(lag2)} s, ${late}`;
    case FIT_KIND.SECOND: return `Gain ${per}, lags ${digits(lag)} s and ${digits(lag2)} s, ${late}`;
    case FIT_KIND.RINGING: return `Gain ${per}, rings every ${digits(2 * Math.PI * lag / Math.sqrt(1 - damping ** 2))} s with damping ${digits(damping)}, ${late}`;
    default: return `Gain ${per}, lag ${digits(lag)} s, ${late}`;
    }
}

// What a state calls a model of a recording with this full drive.
export function plantOfModel({ plant, rest }, full) {
    const round = (x) => Number(x.toPrecision(4));
    const found = { GAIN: round(plant.gain * full), T1: round(plant.lag), T2: round(shownSeconds(plant.lag2, plant)), DEAD: round(shownSeconds(plant.dead, plant)), START: round(rest) };
    switch (plant.kind) {
    case FIT_KIND.INTEGRATING: return { ...found, PLANT: PLANT.INTEGRATOR, T1: 1 };
    case FIT_KIND.RINGING: return { ...found, PLANT: PLANT.OSCILLATOR, T2: 0, DAMPING: round(plant.damping) };
    default: return { ...found, PLANT: PLANT.LAGS };
    }
}
