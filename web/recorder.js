// SPDX-License-Identifier: MIT
// The card of a recording: what is pasted, dropped or opened is read and fitted by a worker. What its
// columns are taken for stands beside them and can be changed, what nobody can know is asked, and a
// model that is safe to tune for can be taken as the plant.
import { FIT_REASON } from './built.js';
import { blank, listenForFiles, make, setText, table } from './dom.js';
import { readNumber } from './fields.js';
import { createFitter } from './fitter.js';
import { digits } from './format.js';
import { fitNotes, KIND_NAMES, modelText, plantOfModel } from './models.js';
import { color, drawGrid } from './plot.js';

const LONG = 100000; // characters that a text field shows without holding the page
const PAUSE = 80; // milliseconds
const PLOT = { left: 56, right: 14, top: 8, bottom: 24 };
const ROLES = { time: 'Time', drive: 'Drive', value: 'Measurement' };

// --- The plot ---------------------------------------------------------------------

// Where a number of the plot is on the canvas.
function scalesOf({ points, range }, width, height) {
    const room = 0.08 * (range.high - range.low) || 1;
    const [low, high, duration] = [range.low - room, range.high + room, points.t.at(-1) || 1];
    const area = { left: PLOT.left, right: width - PLOT.right, top: PLOT.top, bottom: height - PLOT.bottom };
    return { low, high, duration, area, hasAxis: true, x: (t) => area.left + (area.right - area.left) * t / duration,
        y: (value) => Math.min(area.bottom, Math.max(area.top, area.bottom - (area.bottom - area.top) * (value - low) / (high - low))) };
}

// What drove it, held, in the lowest fifth.
function drawDrive(context, { points: { t, u } }, { x, area }) {
    const most = u.reduce((high, one) => Math.max(high, Math.abs(one)), 0) || 1;
    const y = (drive) => area.bottom - (area.bottom - area.top) / 5 * Math.abs(drive) / most;
    context.beginPath();
    t.forEach((one, i) => {
        context.lineTo(x(one), y(u[Math.max(0, i - 1)]));
        context.lineTo(x(one), y(u[i]));
    });
    context.strokeStyle = color('output');
    context.lineWidth = 1;
    context.stroke();
}

function drawRecording(canvas, read, shown, chosen) {
    const { context, width, height } = blank(canvas);
    const scales = scalesOf(read, width, height);
    const { x, y } = scales;
    drawGrid(context, scales);
    drawDrive(context, read, scales);
    context.fillStyle = color('setpoint');
    read.points.t.forEach((t, i) => context.fillRect(x(t) - 1.25, y(read.points.y[i]) - 1.25, 2.5, 2.5));
    for (const model of [...shown].sort((a) => (a === chosen ? 1 : -1))) {
        context.strokeStyle = color(model === chosen ? 'measured' : 'kept');
        context.lineWidth = model === chosen ? 2 : 1;
        context.beginPath();
        model.curve.t.forEach((t, i) => context.lineTo(x(t), y(model.curve.y[i])));
        context.stroke();
    }
}

// --- Questions --------------------------------------------------------------------

const numberField = (label, value = '') => make('input', { type: 'text', inputMode: 'decimal', size: 6, value, 'aria-label': label });

// A question: its answers as buttons, and a field where another number may be one. onAnswer(value).
function questionRow({ key, text, answers = [], chosen, other, step }, onAnswer) {
    const button = (textContent, value, more = {}) => {
        const made = make('button', { type: 'button', textContent, ...more });
        made.addEventListener('click', () => onAnswer(typeof value === 'function' ? value() : value));
        return made;
    };
    const fields = step ? [['from', '0'], ['to', ''], ['at', '0']].map(([name, value]) => [name, numberField(`The step: ${name}`, value)]) : [];
    const field = numberField(`${text} ${other}`);
    const valid = (found) => (Object.values(found).every(Number.isFinite) ? found : null);
    const told = () => valid(Object.fromEntries(fields.map(([name, one]) => [name, readNumber(one.value).value])));
    const rest = step ? [...fields.flatMap(([name, one]) => [` ${name} `, one, name === 'at' ? ' s ' : ' % ']), button('Take it', told)]
        : other ? [`${other} `, field, ' ', button('Take it', () => valid({ value: readNumber(field.value).value })?.value ?? null)] : [];
    return make('div', { className: 'ask', role: 'group', 'aria-label': text }, make('p', { textContent: text }),
        ...answers.map((one) => button(one.text, one.value, { className: one.value === chosen ? 'likely' : '', value: `${key} ${one.value}` })), ...rest);
}

// --- The card ---------------------------------------------------------------------

// Fills the card `section`. onUse(plant, { plants, full, calm }, range) takes a plant; onAsk(open) is
// told whether a question is open; outputMost() is the highest output that the page has, rate() its
// steps per second, unit() that of its measurement.
export function createRecorder(section, { onUse, onAsk, outputMost, rate, unit }) {
    const own = (id) => section.querySelector(id);
    const field = own('#recording');
    const canvas = own('#fit-plot');
    let held = null; // a text that is too long for the field
    let answers = {}; // by the keys of questions and columns
    let [found, kind, timer] = [null, null, 0];
    const fitter = createFitter(show);

    const text = () => held ?? field.value;
    const questions = () => found?.read.questions ?? [];
    const chosen = () => found?.fit?.models?.[kind] ?? null;

    // Whether a plant can be taken is not known until it is fitted.
    function wait() {
        own('#use-fit').disabled = true;
        section.dataset.busy = 'yes';
    }

    function choices() {
        const numbers = Object.fromEntries(['time', 'drive', 'value', 'full', 'every', 'part'].filter((key) => key in answers).map((key) => [key, Number(answers[key])]));
        const before = answers.before === undefined || answers.before === 'moving' ? answers.before ?? null : Number(answers.before);
        return { ...numbers, unit: answers.unit ?? null, step: answers.step ?? null, before, rate: rate(), most: outputMost() };
    }

    function ask() {
        wait();
        if (text().trim() === '') {
            fitter.stop();
            show(null);
        } else {
            fitter.ask({ text: text(), choices: choices() });
        }
    }

    // When nobody has typed for a moment.
    function later(what) {
        clearTimeout(timer);
        timer = setTimeout(what, PAUSE);
        wait();
    }

    // What was said of another recording is not kept for a new one, of which `known` is known.
    function take(next, name, anew = true, known = {}) {
        held = next.length > LONG ? next : null;
        field.readOnly = held !== null;
        const lines = held === null ? 0 : next.split('\n').length;
        const seen = held === null ? next : `${next.slice(0, 2000).split('\n').slice(0, 20).join('\n')}\n… ${name}, ${lines} lines`;
        if (field.value !== seen) {
            field.value = seen;
        }
        answers = anew ? known : answers;
        ask();
    }

    // Another answer; null or '' is none.
    function say(key, value) {
        answers = Object.fromEntries(Object.entries({ ...answers, [key]: value }).filter(([, one]) => one !== null && one !== ''));
        ask();
    }

    function show(next) {
        found = next;
        kind = next?.fit?.chosen ?? null;
        delete section.dataset.busy;
        section.dataset.done = fitter.works();
        own('#record-clear').hidden = next === null;
        own('#record-asks').replaceChildren(...questions().map((one) => questionRow(one, (value) => say(one.key, value))), ...againButtons());
        showColumns(next?.read ?? null);
        showFit();
        onAsk(questions().length > 0);
    }

    // What was answered, and is in no field beside a column, can be asked again.
    function againButtons() {
        const names = { part: 'the part', every: 'the time between lines', before: 'what was before', step: 'the step' };
        return Object.entries(names).filter(([key]) => key in answers).map(([key, name]) => {
            const button = make('button', { type: 'button', className: 'quiet', textContent: `Ask again for ${name}` });
            button.addEventListener('click', () => say(key, null));
            return button;
        });
    }

    function showColumns(read) {
        const columns = read?.names ?? [];
        own('#record-roles').hidden = read?.roles === undefined;
        if (read?.roles === undefined) {
            return;
        }
        const { roles, whys, unit: seconds, full } = read;
        const names = columns.map((name, i) => `${i + 1}${name === '' ? '' : `: ${name}`}`);
        const places = { time: roles.time, drive: roles.drive, value: read.value ?? -1 };
        for (const [role, word] of Object.entries(ROLES)) {
            const select = own(`#record-${role}`);
            select.replaceChildren(make('option', { value: role === 'drive' ? '-1' : '', textContent: 'none' }), ...names.map((name, i) => make('option', { value: String(i), textContent: name })));
            select.value = places[role] < 0 ? select.options[0].value : String(places[role]);
            select.setAttribute('aria-label', `Column of the ${word.toLowerCase()}`);
            setText(own(`#record-${role}-why`), whys[role] ?? '');
        }
        own('#record-seconds').value = seconds;
        own('#record-full').parentElement.hidden = roles.drive < 0;
        if (document.activeElement !== own('#record-full')) {
            own('#record-full').value = full ?? '';
        }
        setText(own('#record-full-why'), whys.full ?? '');
    }

    function worthText(model) {
        if (model.reason !== FIT_REASON.USABLE) {
            return model.sentence;
        }
        const slower = model.calm > 1 ? `, made ${model.calm} times slower as not all is known,` : '';
        return `SIMC’s gains${slower} have Ms of ${digits(model.ms)} or less for nine of ten plants that the recording allows.`;
    }

    function showFit() {
        const { read = null, fit = null } = found ?? {};
        const open = questions().length > 0;
        const model = questions().some(({ step }) => step) ? null : chosen(); // of an unknown step there is none
        const refused = read?.refused ?? (model === null ? fit?.sentence || null : model.reason === FIT_REASON.USABLE ? null : model.sentence);
        const about = model === null ? '' : `${modelText(model.plant, read.full, unit())}. R² is ${model.r2.toFixed(4)}. `;
        setText(own('#fit'), read === null ? '' : refused !== null ? `${refused}${model === null ? '' : ` Not to be used: ${about}`}` : model === null ? 'Answer first.' : `${open ? 'With the likely answers: ' : ''}${about}${worthText(model)}`);
        own('#fit').className = refused !== null ? 'refused' : model === null ? '' : open || model.calm > 1 ? 'fair' : 'good';
        own('#use-fit').disabled = model === null || refused !== null || open || 'busy' in section.dataset;
        own('#record-notes').replaceChildren(...[...read?.notes ?? [], ...model?.reason === FIT_REASON.USABLE ? fitNotes(fit) : []].map((note) => make('li', { textContent: note })));
        const usable = model === null ? [] : fit.models.filter((one, i) => i === fit.chosen || one.reason === FIT_REASON.USABLE);
        canvas.hidden = read?.points === undefined;
        if (!canvas.hidden) {
            drawRecording(canvas, read, usable, model);
        }
        fillModels(usable);
    }

    function fillModels(models) {
        own('#record-models').hidden = models.length < 2;
        const button = ({ plant }) => {
            const made = make('button', { type: 'button', textContent: KIND_NAMES[plant.kind], 'aria-pressed': String(plant.kind === kind) });
            made.addEventListener('click', () => {
                ({ kind } = plant);
                showFit();
                own('#record-models [aria-pressed=true]').focus();
            });
            return made;
        };
        own('#record-models').replaceChildren(table('Models that may be used', ['Model', 'Ms, nine of ten', 'R²'], models.map((model) => ({ chosen: model.plant.kind === kind,
            cells: [button(model), model.calm > 0 ? digits(model.ms) : '–', model.r2.toFixed(4)] }))));
    }

    function use() {
        const { read, fit } = found;
        onUse(plantOfModel(chosen(), read.full), { plants: fit.plants, full: read.full, calm: chosen().calm }, read.range);
    }

    field.addEventListener('input', (event) => later(() => take(field.value, 'pasted', event.inputType === 'insertFromPaste')));
    field.addEventListener('paste', (event) => {
        const pasted = event.clipboardData.getData('text');
        if (pasted.length > LONG) { // the field itself would take seconds for it
            event.preventDefault();
            take(pasted, 'pasted');
        }
    });
    own('#record-clear').addEventListener('click', () => take('', ''));
    own('#record-open').addEventListener('click', () => own('#record-file').click());
    listenForFiles(section, own('#record-file'), { onFile: async (file) => take(await file.text(), file.name), onText: (text) => take(text, 'dropped') });
    for (const role of Object.keys(ROLES)) {
        own(`#record-${role}`).addEventListener('change', (event) => say(role, event.target.value));
    }
    own('#record-seconds').addEventListener('change', (event) => say('unit', event.target.value));
    own('#record-full').addEventListener('change', (event) => say('full', readNumber(event.target.value).value > 0 ? readNumber(event.target.value).value : null));
    own('#use-fit').addEventListener('click', use);
    return { draw: showFit, take, asks: () => questions().length > 0 };
}
