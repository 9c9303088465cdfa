// SPDX-License-Identifier: MIT
// The card of a recording: what is pasted, dropped or opened is read and fitted by a
// worker, or in short parts where there is none; what was understood is shown, and a
// model that fits can be taken as the plant.
import { PLANT } from './built.js';
import { partOfDrive } from './columns.js';
import { blank, find, make, setText, table } from './dom.js';
import { digits, percent } from './format.js';
import { KIND_NAMES, modelAt, modelText, recordingOf } from './models.js';
import { color, drawGrid } from './plot.js';

const LONG = 100000; // characters that a text field shows without holding the page
const PAUSE = 80; // milliseconds
const SLICE = 12; // milliseconds of a part
const PLOT = { left: 56, right: 14, top: 8, bottom: 24 };
const ROLES = { time: 'Time', drive: 'Drive', value: 'Measurement' };
const CHOICES = ['#record-time', '#record-drive', '#record-value', '#record-seconds', '#record-at'];

// What the worker does: this page's script is its script, too.
export function serveRecordings() {
    self.onmessage = ({ data: { id, text, choices } }) => {
        const parts = recordingOf(text, choices);
        let part = parts.next();
        while (!part.done) {
            part = parts.next();
        }
        self.postMessage({ id, found: part.value });
    };
}

let workerAddress = null;

function makeWorker() {
    workerAddress ??= URL.createObjectURL(new Blob(['"use strict";', find('#code').textContent], { type: 'text/javascript' }));
    return new Worker(workerAddress);
}

// { ask(text, choices), stop(), works() }: `onFound` gets what was found for what was asked
// last.
function createReader(onFound) {
    let [worker, broken, asked, waiting] = [null, false, 0, null];

    async function inSlices(id, { text, choices }) {
        const parts = recordingOf(text, choices);
        for (let part = { done: false }; id === asked;) {
            const until = performance.now() + SLICE;
            while (!part.done && performance.now() < until) {
                part = parts.next();
            }
            if (part.done) {
                answer(id, part.value);
                return;
            }
            await new Promise((go) => {
                setTimeout(go, 0);
            });
        }
    }

    function answer(id, found) {
        if (id === asked) {
            waiting = null;
            onFound(found);
        }
    }

    function fail(event) {
        event?.preventDefault?.();
        [worker, broken] = [null, true];
        if (waiting !== null) {
            inSlices(asked, waiting);
        }
    }

    // What is not needed any more.
    function stop() {
        asked += 1;
        if (waiting !== null && worker !== null) {
            worker.terminate();
            worker = null;
        }
        waiting = null;
    }

    function ask(text, choices) {
        stop();
        waiting = { text, choices };
        try {
            if (!broken && worker === null) {
                worker = makeWorker();
                worker.onmessage = ({ data }) => answer(data.id, data.found);
                worker.onerror = fail;
            }
        } catch {
            broken = true;
        }
        if (broken) {
            inSlices(asked, waiting);
        } else {
            worker.postMessage({ id: asked, text, choices });
        }
    }

    return { ask, stop, works: () => (broken ? 'slices' : 'worker') };
}

// --- The plot ---------------------------------------------------------------------

function limitsOf({ times, values, outliers }) {
    const all = [...values, ...outliers.map(({ value }) => value)].filter(Number.isFinite);
    const seen = all.length > 0 ? values : [0, 1];
    const [low, high] = seen.reduce(([a, b], one) => [Math.min(a, one), Math.max(b, one)], [Infinity, -Infinity]);
    const room = 0.08 * (high - low) || 1;
    return { low: low - room, high: high + room, duration: times.at(-1) };
}

// Where a number of the plot is on the canvas.
function scalesOf(read, width, height) {
    const { low, high, duration } = limitsOf(read);
    const area = { left: PLOT.left, right: width - PLOT.right, top: PLOT.top, bottom: height - PLOT.bottom };
    return { low, high, duration, area, hasAxis: true, x: (t) => area.left + (area.right - area.left) * t / duration,
        y: (value) => area.bottom - (area.bottom - area.top) * (value - low) / (high - low) };
}

function drawRecording(canvas, read, fit, kind) {
    const { context, width, height } = blank(canvas);
    const scales = scalesOf(read, width, height);
    const { x, y, area, duration } = scales;
    drawGrid(context, scales);
    context.fillStyle = color('setpoint');
    read.times.forEach((t, i) => context.fillRect(x(t) - 1.25, y(read.values[i]) - 1.25, 2.5, 2.5));
    context.strokeStyle = color('bad');
    context.lineWidth = 1.5;
    for (const { t, value } of read.outliers) { // at the edge where they are beyond it
        const at = Math.min(area.bottom, Math.max(area.top, y(value)));
        context.strokeRect(x(t) - 3, at - 3, 6, 6);
    }
    context.setLineDash([6, 4]);
    context.strokeStyle = color('output');
    context.beginPath();
    context.moveTo(x(read.stepAt), area.top);
    context.lineTo(x(read.stepAt), area.bottom);
    context.stroke();
    context.setLineDash([]);
    const shown = fit?.models?.filter((model) => model.kind === kind || model.refused === null) ?? [];
    for (const model of [...shown].sort((a) => (a.kind === kind ? 1 : -1))) {
        const chosen = model.kind === kind;
        context.strokeStyle = color(chosen ? 'measured' : 'kept');
        context.lineWidth = chosen ? 2 : 1;
        context.beginPath();
        for (let i = 0; i <= 400; i++) {
            const t = duration * i / 400;
            context.lineTo(x(t), Math.min(area.bottom, Math.max(area.top, y(modelAt(model, t - read.stepAt)))));
        }
        context.stroke();
    }
}

// --- The card ---------------------------------------------------------------------

function numberOf(field) {
    const text = field.value.trim().replace(',', '.').replace('−', '-');
    return text === '' ? NaN : Number(text);
}

// What a state calls a model that was recorded with a step of this part of full drive,
// from `rest`.
export function plantOfModel(model, { step, rest }) {
    const round = (x) => Number(x.toPrecision(4));
    const gain = model.rise / step;
    const plant = { GAIN: round(gain), T1: round(model.T1 ?? 1), T2: round(model.T2 ?? 0), DEAD: round(model.dead), START: round(model.start - gain * rest) };
    switch (model.kind) {
    case 'integrating': return { ...plant, PLANT: PLANT.INTEGRATOR, START: round(model.start) };
    case 'ringing': return { ...plant, PLANT: PLANT.OSCILLATOR, DAMPING: round(model.damping) };
    default: return { ...plant, PLANT: PLANT.LAGS };
    }
}

// Fills the card `section`. onUse(plant, unit, { low, high }) takes a plant; outputMost()
// is the highest output that the page has, rate() its steps per second.
export function createRecorder(section, { onUse, outputMost, rate }) {
    const own = (id) => section.querySelector(id);
    const field = own('#recording');
    const canvas = own('#fit-plot');
    let held = null; // a text that is too long for the field
    let [found, kind, timer] = [null, null, 0];
    const reader = createReader(show);

    const text = () => held ?? field.value;

    function choices() {
        const column = (id) => (own(id).value === '' ? null : Number(own(id).value));
        return { time: column('#record-time'), drive: column('#record-drive'), value: column('#record-value'),
            unit: own('#record-seconds').value, stepAt: numberOf(own('#record-at')), rate: rate() };
    }

    // Whether a plant can be taken is not known until it is fitted.
    function wait() {
        own('#use-fit').disabled = true;
        section.dataset.busy = 'yes';
    }

    function ask() {
        wait();
        if (text().trim() === '') {
            reader.stop();
            show(null);
        } else {
            reader.ask(text(), choices());
        }
    }

    // When nobody has typed for a moment.
    function later(what) {
        clearTimeout(timer);
        timer = setTimeout(what, PAUSE);
        wait();
    }

    // What was chosen for another recording is not kept for a new one.
    function take(next, name, anew = true) {
        held = next.length > LONG ? next : null;
        field.readOnly = held !== null;
        own('#record-clear').hidden = held === null;
        const lines = held === null ? 0 : next.split('\n').length;
        const seen = held === null ? next : `${next.slice(0, 2000).split('\n').slice(0, 20).join('\n')}\n… ${name}, ${lines} lines`;
        if (field.value !== seen) {
            field.value = seen;
        }
        if (anew) {
            for (const id of CHOICES) {
                own(id).value = '';
            }
            own('#record-step').dataset.own = '';
        }
        ask();
    }

    function stepOf() {
        const { read } = found;
        const size = numberOf(own('#record-step')) / 100;
        const jump = read?.jump ?? null;
        const rest = jump === null ? 0 : size * jump.from / (jump.to - jump.from);
        return { step: size, rest };
    }

    function chosen() {
        return found?.fit?.models?.find((model) => model.kind === kind) ?? null;
    }

    function show(next) {
        found = next;
        kind = next?.fit?.chosen ?? null;
        delete section.dataset.busy;
        section.dataset.done = reader.works();
        const jump = next?.read.jump ?? null;
        if (jump !== null && own('#record-step').dataset.own !== 'yes') {
            const { step } = partOfDrive(jump, next.read.names[next.read.roles.drive] ?? '', outputMost());
            own('#record-step').value = String(Number((100 * step).toPrecision(4)));
        }
        showColumns(next?.read ?? null);
        showFit();
    }

    function showColumns(read) {
        const columns = read?.names ?? [];
        own('#record-roles').hidden = columns.length === 0;
        for (const [role, word] of Object.entries(ROLES)) {
            const select = own(`#record-${role}`);
            const asked = select.value;
            const names = columns.map((name, i) => `${i + 1}${name === '' ? '' : `: ${name}`}`);
            const is = read?.roles?.[role] ?? -1;
            const auto = `found: ${is >= 0 ? names[is] ?? '–' : 'none'}`;
            select.replaceChildren(make('option', { value: '', textContent: asked === '' ? auto : 'by itself' }),
                ...(role === 'drive' ? [make('option', { value: '-1', textContent: 'none' })] : []),
                ...names.map((name, i) => make('option', { value: String(i), textContent: name })));
            select.value = asked;
            select.setAttribute('aria-label', `Column of the ${word.toLowerCase()}`);
        }
        own('#record-seconds').firstChild.textContent = read?.unit === undefined || own('#record-seconds').value !== '' ? 'by itself' : `found: ${read.unit}`;
        own('#record-at').placeholder = read?.stepAt === undefined ? '' : digits(read.stepAt, 4);
        const known = read?.preview !== undefined;
        own('#record-preview').hidden = !known;
        if (known) {
            const heads = read.names.map((name, i) => {
                const role = Object.keys(ROLES).find((one) => read.roles[one] === i);
                return `${role === undefined ? 'not used' : ROLES[role]}${name === '' ? '' : ` (${name})`}${role === 'time' ? `, ${read.unit}` : ''}`;
            });
            own('#record-lines').replaceChildren(table('The first lines as they are understood', ['Line', ...heads],
                read.preview.map(({ line, cells }) => ({ cells: [String(line), ...cells.map((cell) => (Number.isNaN(cell) ? 'none' : String(Number(cell.toPrecision(12)))))] }))));
        }
    }

    function showFit() {
        const { read = null, fit = null } = found ?? {};
        const model = chosen();
        const { step } = found === null ? { step: NaN } : stepOf();
        const unit = own('#record-unit').value;
        const noStep = !(Number.isFinite(step) && step !== 0) ? 'How far was the output stepped? A step of 0 % moves nothing.' : null;
        const refused = found === null ? null : read.refused ?? fit.refused ?? model.refused ?? noStep;
        setText(own('#fit'), found === null ? '' : refused ?? sentenceOf(model, step, unit, read));
        own('#fit').className = refused !== null ? 'refused' : model === null ? '' : model.word === 'fits well' ? 'good' : 'fair';
        own('#use-fit').disabled = found === null || refused !== null || 'busy' in section.dataset;
        own('#record-notes').replaceChildren(...(read?.notes ?? []).map((note) => make('li', { textContent: note })));
        const drawn = read?.times !== undefined;
        canvas.hidden = !drawn;
        if (drawn) {
            drawRecording(canvas, read, fit, kind);
        }
        fillModels(fit?.models ?? [], Number.isFinite(step) && step !== 0 ? step : 1);
    }

    function sentenceOf(model, step, unit, read) {
        const worth = `It ${model.word}: ${percent(model.part)} of the rise is left on average, R² is ${model.r2.toFixed(4)}`;
        const rest = read.by === 'start' && model.dead > 0.3 * (model.T1 ?? 0) && model.dead > 5 * read.every
            ? ' The first line is taken as the moment of the step: if there was rest before it, say when the step was.' : '';
        const slow = model.kind === 'integrating' ? ' A lag far longer than the recording would look the same, and gets the same gains.' : '';
        return `${modelText(model, step, unit)}. ${worth}.${slow}${rest}`;
    }

    function fillModels(models, step) {
        own('#record-models').hidden = models.length === 0;
        const button = (model) => {
            const made = make('button', { type: 'button', textContent: 'Show', 'aria-pressed': String(model.kind === kind), 'aria-label': `Show ${KIND_NAMES[model.kind]}` });
            made.addEventListener('click', () => {
                ({ kind } = model);
                showFit();
                own(`#record-models [aria-label="Show ${KIND_NAMES[model.kind]}"]`).focus();
            });
            return made;
        };
        const lags = ({ kind: of, T1, T2, damping }) => ({ first: () => digits(T1), second: () => `${digits(T1)}, ${digits(T2)}`, integrating: () => digits(T2),
            ringing: () => `${digits(T1)}, ζ ${digits(damping, 2)}` })[of]();
        own('#record-models').replaceChildren(table('Gain at full drive; times in seconds',
            ['Model', 'Look', 'Worth', 'Gain', 'Lags', 'Dead time', 'R²', 'Left'], models.map((model) => ({ chosen: model.kind === kind, cells: [KIND_NAMES[model.kind], button(model),
                model.refused === null ? model.word : 'refused', digits(model.rise / step), lags(model), digits(model.dead), model.r2.toFixed(4), percent(Math.min(9.99, model.part))] }))));
    }

    function use() {
        const { read } = found;
        const range = read.values.reduce(({ low, high }, one) => ({ low: Math.min(low, one), high: Math.max(high, one) }), { low: Infinity, high: -Infinity });
        onUse({ ...plantOfModel(chosen(), stepOf()), unit: own('#record-unit').value }, range);
    }

    // The line of the step is gripped within 12 pixels of it.
    function grip(event) {
        const { x, area, duration } = scalesOf(found.read, canvas.clientWidth, canvas.clientHeight);
        const at = (one) => (one.clientX - canvas.getBoundingClientRect().left - area.left) / (area.right - area.left) * duration;
        if (Math.abs(x(at(event)) - x(found.read.stepAt)) > 12) {
            return;
        }
        canvas.setPointerCapture(event.pointerId);
        canvas.onpointermove = (one) => {
            found.read.stepAt = Math.min(duration, Math.max(0, at(one)));
            own('#record-at').value = String(Number(found.read.stepAt.toPrecision(4)));
            drawRecording(canvas, found.read, null, null);
        };
        canvas.onpointerup = () => {
            canvas.onpointermove = null;
            canvas.onpointerup = null;
            ask();
        };
    }

    async function takeFile(file) {
        if (file) {
            take(await file.text(), file.name);
        }
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
    own('#record-file').addEventListener('change', (event) => takeFile(event.target.files[0]));
    own('#record-open').addEventListener('click', () => own('#record-file').click());
    section.addEventListener('dragover', (event) => {
        event.preventDefault();
        section.classList.add('over');
    });
    section.addEventListener('dragleave', () => section.classList.remove('over'));
    section.addEventListener('drop', (event) => {
        event.preventDefault();
        section.classList.remove('over');
        const file = event.dataTransfer.files[0];
        if (file) {
            takeFile(file);
        } else {
            take(event.dataTransfer.getData('text'), 'dropped');
        }
    });
    CHOICES.forEach((id) => own(id).addEventListener('input', () => later(ask)));
    own('#record-step').addEventListener('input', () => {
        own('#record-step').dataset.own = 'yes';
        showFit();
    });
    own('#record-unit').addEventListener('input', showFit);
    own('#use-fit').addEventListener('click', use);
    canvas.addEventListener('pointerdown', grip);
    return { draw: showFit, take };
}
