// SPDX-License-Identifier: MIT
// The page: all that it shows follows from the one state, each time anew.
import { CONTROLLER, EXPERIMENT, LIMIT, OPTION, PLANT, VERSION } from './built.js';
import { adviceOf, notesOf } from './advice.js';
import { figuresOf, fillFigures, fillRules, marginFigures } from './cards.js';
import { calmGains } from './calm.js';
import { createPanel } from './controls.js';
import { find, make, setText } from './dom.js';
import { experiment, run, startEngine } from './engine.js';
import { createEventList, createFlags } from './events.js';
import { experimentText, isMeasured, ringingText, ruleName, stageText } from './experiment.js';
import { serveFits } from './fitter.js';
import { digits, whole } from './format.js';
import { fillGuard } from './guard.js';
import { fileOf, wholeHeaderOf } from './header.js';
import { listenForHelp } from './help.js';
import { createLive } from './live.js';
import { loadAlone, loadPairs, restText } from './load.js';
import { marginsOf } from './margins.js';
import { measurementPane, panesOf } from './panes.js';
import { createPendulum } from './pendulum.js';
import { plantOfKind } from './own.js';
import { createPast, wayOfKey } from './past.js';
import { createPlots, color, followPlots } from './plot.js';
import { recordText } from './record.js';
import { createRecorder } from './recorder.js';
import { drawBode, drawNyquist, offText } from './response.js';
import { gainsOfRule } from './rules.js';
import { fillKey, fillRuns, keptWith, keyFigures } from './runs.js';
import { csvOf, jsonOf, stateOfJson } from './saved.js';
import { LOOP_NAME, PRESETS, change, changeNow, currentState, fragmentOf, onChange, ownState, presetState, stateOfFragment } from './state.js';
import { createSvg } from './svg.js';
import { createTools } from './tools.js';
import { showTour } from './tour.js';
import { createVerdict, rememberPlants } from './verdict.js';

let plots = null;
let flags = null;
let events = null;
let panel = null;
let pendulum = null;
let past = null;
let recorder = null;
let live = null;
let tools = null;
let judge = null;
let held = false; // a hand drags a slider or a flag
let mode = 'run'; // or 'load', or 'tune': what the plots show
let cursor = null;
let shown = 0; // seconds that the plots show

// --- The autotuner, remembered while the plant is the same ------------------

const OWN_OF_GAINS = ['KP', 'KI', 'KD', 'FILTER', 'WEIGHT', 'rule', 'name', 'story', 'kept']; // ROBUSTNESS may add a row
let tuned = { key: '', found: null };

function hasTuner(s) {
    return s.CONTROLLER === CONTROLLER.PID && s.PLANT !== PLANT.PENDULUM;
}

function tunedFor(s) {
    const key = JSON.stringify(Object.entries(s).filter(([name]) => !OWN_OF_GAINS.includes(name)));
    if (tuned.key !== key) {
        tuned = { key, found: experiment(s), rows: null };
    }
    return tuned.found;
}

function rowsFor(s) {
    const heated = tuned.found.results.EXPERIMENT === EXPERIMENT.HEAT_UP;
    tuned.rows ??= tuned.found.rules.map(({ rule, robustness, has, results }) => {
        if (!has) {
            return { rule, robustness, heated, gains: null };
        }
        const gains = gainsOfRule(s, results);
        const one = run({ ...s, ...gains });
        return one.n < 0 ? { rule, robustness, heated, gains: null }
            : { rule, robustness, heated, gains, found: one.metrics, margins: marginsOf({ ...s, ...gains }, one.results) };
    });
    return tuned.rows;
}

// --- Plots --------------------------------------------------------------------

function showPlots(s, found, panes) {
    const seconds = 1 / s.RATE;
    shown = mode === 'tune' ? Math.max(1, found.n) * seconds : Math.min(s.DURATION, LIMIT.STEPS * seconds);
    plots.show({ panes, seconds, events: mode === 'tune' ? [] : s.events, duration: shown });
    showStage(s);
}

function setCursor(seconds) {
    cursor = seconds;
    plots.cursorAt(seconds);
    pendulum.at(seconds);
    showStage(currentState());
}

function moveCursor(event) {
    const way = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity }[event.key];
    if (event.key === 'Escape') {
        setCursor(null);
    } else if (way !== undefined && event.target.id === 'plots') {
        event.preventDefault();
        setCursor(Math.min(shown, Math.max(0, (cursor ?? shown) + way * shown / 100)));
    }
}

// --- What follows from the state ------------------------------------------------

function showAdvice(s, advice, tuning) {
    const entries = [
        ...advice.refused.map((text) => make('li', { className: 'refused', textContent: text })),
        ...(tuning ? [] : advice.warnings.map((text) => make('li', { textContent: text }))),
    ];
    const place = find('#advice');
    if (place.textContent !== entries.map((one) => one.textContent).join('')) {
        place.replaceChildren(...entries);
    }
}

// How far the experiment is where the cursor stands, or at its end.
function showStage(s) {
    const seen = mode === 'tune' && tuned.found !== null && tuned.found.n > 0;
    find('#stage').hidden = !seen;
    setText(find('#stage'), seen ? stageText(s, tuned.found, Math.round((cursor ?? shown) * s.RATE)) : '');
}

function showTuning(s) {
    find('#tuning').hidden = mode !== 'tune';
    if (mode !== 'tune') {
        find('#found').textContent = '';
        find('#rules').replaceChildren();
        fillGuard(find('#guard'), null);
        return null;
    }
    find('#experiment').value = s.EXPERIMENT;
    const found = tunedFor(s);
    const lasted = `Measured after ${digits(found.n / s.RATE)} s, ${whole(found.n)} steps`;
    const rows = isMeasured(found.results) ? rowsFor(s) : [];
    const has = rows.some((row) => row.gains !== null);
    setText(find('#found'), experimentText(s.RATE, lasted, found) + (has ? ringingText(s) : ''));
    find('#rules').hidden = !has;
    find('#copy-record').disabled = found.record === null;
    fillGuard(find('#guard'), found.results, { outputMin: s.OUTPUT_MIN, outputMax: s.OUTPUT_MAX, reverse: (s.OPTIONS & OPTION.REVERSE) !== 0,
        top: 2 ** s.SENSOR_BITS - 1, rest: found.series.MEASUREMENT[0], setpoint: found.series.SETPOINT[0] });
    fillRules(find('#rules'), has ? rows : [], (row) => row.rule === s.rule && row.robustness === s.ROBUSTNESS, useRule);
    return found;
}

function showMargins(s, margins) {
    fillFigures(find('#margins'), marginFigures(s, margins));
    setText(find('#off'), offText(margins));
    if (find('#judged').open) {
        drawNyquist(find('#nyquist'), margins);
        drawBode(find('#bode'), margins, s.RATE);
    }
}

function showModes(s) {
    const names = { run: 'Control', load: 'Load alone', ...(hasTuner(s) ? { tune: 'Autotune' } : {}) };
    const place = find('#modes');
    if (place.children.length !== Object.keys(names).length) {
        place.replaceChildren(...Object.entries(names).map(([key, text]) => {
            const button = make('button', { type: 'button', textContent: text, value: key });
            button.addEventListener('click', () => setMode(key));
            return button;
        }));
    }
    for (const button of place.children) {
        button.setAttribute('aria-pressed', String(button.value === mode));
    }
    find('#keep').hidden = mode !== 'run';
    find('#flags').hidden = mode !== 'run';
}

function showPicture(s, found) {
    const seen = s.PLANT === PLANT.PENDULUM && mode === 'run' && found.n > 0;
    pendulum.update(seen ? { n: found.n, seconds: 1 / s.RATE, angle: found.series.VALUE_TRUE,
        base: found.series.VALUE_BASE, twin: found.series.VALUE_TWIN } : null);
}

function showHead(s) {
    find('#preset').value = s.preset;
    setText(find('#story'), s.story);
    const field = find('#loop');
    if (document.activeElement !== field) {
        field.value = s.loop;
    }
}

// While a question of the recording is open, no gains leave the page.
function allowTaking(allowed) {
    for (const id of ['copy', 'save', 'share', 'keep', 'take-png', 'take-svg', 'take-csv', 'take-json']) {
        find(`#${id}`).disabled = !allowed || recorder.asks();
    }
}

// Nothing of an earlier state is left where these settings are refused.
function showRefused(s, found) {
    find('#stage').hidden = true;
    fillFigures(find('#metrics'), []);
    fillFigures(find('#margins'), []);
    fillKey([find('#key'), find('#mini dl')], []);
    find('#runs').hidden = true;
    for (const id of ['nyquist', 'bode']) {
        find(`#${id}`).getContext('2d').clearRect(0, 0, 1e4, 1e4);
    }
    setText(find('#off'), '');
    find('#verdict').hidden = true;
    find('#header').textContent = '';
    setText(find('#file'), fileOf(s));
    allowTaking(false);
    pendulum.update(null);
    plots.show({ panes: panesOf(s, { ...found, n: 0 }, mode), seconds: 1 / s.RATE,
        events: [], duration: s.DURATION });
}

function showRun(s, found, margins, alone) {
    const { results } = found;
    const experimenting = showTuning(s);
    const figures = found.metrics;
    fillFigures(find('#metrics'), mode === 'run' ? figuresOf(s, figures) : []);
    fillKey([find('#key'), find('#mini dl')], mode === 'tune' ? [] : alone !== null ? loadPairs(alone) : keyFigures(s, figures, margins));
    fillRuns(find('#runs'), mode === 'tune' ? { ...s, kept: [] } : s, figures, margins, onKept);
    const [scene, seen] = [alone?.s ?? s, experimenting ?? alone?.found ?? found];
    showPlots(scene, seen, panesOf(scene, seen, mode));
    showPicture(s, found);
    showMargins(s, margins);
    const { text = null, warning = null } = judge(s, results, margins) ?? {};
    setText(find('#verdict'), [text && `${text}.`, warning].filter(Boolean).join(' '));
    find('#verdict').hidden = text === null;
    find('#verdict').classList.toggle('risky', warning !== null);
    setText(find('#header'), wholeHeaderOf(s, results, margins, [text, warning && `Warning: ${warning}`].filter(Boolean)));
    setText(find('#file'), `${fileOf(s)}: kp ${results.KP}, ki ${results.KI}, kd ${results.KD}`);
    allowTaking(true);
}

// While something is dragged: what the hand looks at; false where nothing runs. The rest comes when it lets go.
function showHeld(s) {
    const found = run(s, ['SETPOINT', 'MEASUREMENT']);
    if (found.n <= 0) {
        return false;
    }
    const margins = marginsOf(s, found.results);
    panel(s, notesOf(s));
    flags(s);
    fillKey([find('#key'), find('#mini dl')], keyFigures(s, found.metrics, margins));
    showPlots(s, found, [measurementPane(s, found, mode)]);
    return true;
}

function show() {
    const s = currentState();
    if (mode === 'tune' && !hasTuner(s)) {
        mode = 'run';
    }
    if (held && mode === 'run' && showHeld(s)) {
        return;
    }
    const found = run(s);
    const good = found.n > 0;
    const margins = good ? marginsOf(s, found.results) : null;
    const alone = good && mode === 'load' ? loadAlone(s) : null;
    const advice = adviceOf(s, found, margins);
    advice.warnings.push(...(alone === null ? [] : [restText(alone) ?? []].flat()));
    showHead(s);
    showModes(s);
    showAdvice(s, advice, mode === 'tune');
    panel(s, notesOf(s));
    tools(s, good ? found.results : null, hasTuner(s));
    events(s);
    flags(s);
    if (good) {
        showRun(s, found, margins, alone);
    } else {
        showTuning(s);
        showRefused(s, found);
    }
}

// Of another state nothing that was said of the last one is left.
function showChange() {
    show();
    setText(find('#said'), '');
    past.later(); // last: what is shown does not depend on the link
}

// --- What a person does -----------------------------------------------------------

function say(text) {
    setText(find('#said'), text);
}

function setMode(next) {
    mode = next;
    setCursor(null);
    show();
}

function useRule(row) {
    const s = currentState();
    mode = 'run';
    changeNow({ ...s, ...row.gains, rule: row.rule, ROBUSTNESS: row.robustness });
    say(`${ruleName(row)} is in use.`);
    find('#modes').firstChild.focus();
}

function useRecord(row) {
    useRule(row);
    find('#view').scrollIntoView();
    say(`The record’s gains by ${ruleName(row)} are in use, with its range of outputs. The plant is still this page’s.`);
}

function keep() {
    const s = currentState();
    changeNow({ ...s, kept: keptWith(s) });
}

const onKept = {
    onUse: (fragment) => withKept(stateOfFragment(fragment), currentState().kept),
    onDrop: (i) => withKept(currentState(), currentState().kept.filter((_, k) => k !== i)),
};

// The table of kept runs is another then, and what had the focus is gone.
function withKept(s, kept) {
    changeNow({ ...s, kept });
    find('#keep').focus();
}

function linkOf(s) {
    return `${location.href.replace(/#.*/, '')}#${fragmentOf(s)}`;
}

async function toClipboard(text, done) {
    try {
        await navigator.clipboard.writeText(text);
        say(done);
    } catch {
        say('The browser does not allow copying here: select the text instead.');
    }
}

function download(name, content, type) {
    const link = make('a', { href: URL.createObjectURL(new Blob([content], { type })), download: name });
    link.click();
    URL.revokeObjectURL(link.href);
}

// --- What is taken along --------------------------------------------------------------

function saveSvg() {
    const svg = createSvg(...plots.size(), color('card'));
    plots.paint(svg.context);
    download('loop.svg', svg.text(), 'image/svg+xml');
}

function savePng() {
    const [width, height] = plots.size();
    const canvas = make('canvas', { width: 2 * width, height: 2 * height });
    const context = canvas.getContext('2d');
    context.scale(2, 2);
    context.fillStyle = color('card');
    context.fillRect(0, 0, width, height);
    plots.paint(context);
    canvas.toBlob((picture) => download('loop.png', picture, 'image/png'));
}

function saveCsv() {
    const s = currentState();
    const of = mode === 'load' ? loadAlone(s) : { s, found: mode === 'tune' ? tunedFor(s) : run(s) };
    download('loop.csv', csvOf(of.s, of.found), 'text/csv');
}

function saveJson() {
    const s = currentState();
    const found = run(s);
    download('loop.json', jsonOf(s, found.metrics, marginsOf(s, found.results), find('#header').textContent), 'application/json');
}

async function openJson(event) {
    const [file] = event.target.files;
    const { state, why } = stateOfJson(await file.text());
    event.target.value = ''; // the same file again is a change, too
    if (state) {
        mode = 'run';
        changeNow(state);
    }
    say(why ?? `${file.name} is open.`);
}

// --- A recording --------------------------------------------------------------------

// With gains as calm as its recording wants them.
function useRecorded(plant, allowed) {
    mode = 'run';
    const next = ownState(currentState(), plant);
    changeNow({ ...next, ...(next.CONTROLLER === CONTROLLER.PID ? calmGains(next, allowed.calm) : {}) });
    rememberPlants(currentState(), allowed);
    show();
    find('#view').scrollIntoView();
    say('The plant is the one that was recorded; sensor, output and rate are yours.');
}

// --- A board ------------------------------------------------------------------------

function gainsOfPage() {
    const s = currentState();
    const { n, results } = run(s);
    return s.CONTROLLER === CONTROLLER.PID && n >= 0 ? { ...results, RATE: s.RATE } : null;
}

// The board's hardware and gains, on a plant that was found there or the page's own.
function useBoard(hardware, plant, allowed = null) {
    const s = { ...currentState(), ...hardware };
    const own = s.preset === 'own' && s.PLANT !== PLANT.PENDULUM ? {} : plantOfKind(s, PLANT.LAGS);
    const { KP, KI, KD, FILTER, WEIGHT, INTEGRAL_MIN, INTEGRAL_MAX, OPTIONS } = hardware;
    mode = 'run';
    changeNow({ ...ownState(s, plant ?? own), CONTROLLER: CONTROLLER.PID, KP, KI, KD, FILTER, WEIGHT, INTEGRAL_MIN, INTEGRAL_MAX, OPTIONS });
    if (allowed !== null) {
        rememberPlants(currentState(), allowed);
        show();
    }
    find('#view').scrollIntoView();
    say(plant === null ? 'Rate, limits and gains are the board’s; the plant is this page’s.' : 'Plant, rate, limits and gains are the board’s: what is shown is a prediction.');
}

function useLines(text, name, known = {}) {
    recorder.take(text, name, true, known);
    find('#recorder').scrollIntoView();
}

function useHandStep(hardware, text, name) {
    useBoard(hardware, null);
    useLines(text, name, { full: String(Math.max(hardware.OUTPUT_MAX, -hardware.OUTPUT_MIN)) });
}

// --- From the start -----------------------------------------------------------------

function choosePreset(event) {
    mode = 'run';
    setCursor(null);
    changeNow({ ...presetState(event.target.value), kept: currentState().kept });
}

function buildHead() {
    const [own, ...others] = [...PRESETS].reverse();
    const option = ({ preset, name }) => make('option', { value: preset, textContent: name });
    find('#preset').append(option(own), make('optgroup', { label: 'Examples' }, ...others.reverse().map(option)));
    find('#preset').addEventListener('change', choosePreset);
    setText(find('#version'), VERSION);
    showTour(find('#tour'));
    listenForHelp(find('#explain'));
}

// A name that C can have is used; of another it is said why it is not.
function nameLoop() {
    const field = find('#loop');
    const good = LOOP_NAME.test(field.value);
    field.setAttribute('aria-invalid', String(!good));
    setText(find('#loop-why'), good ? '' : `“${field.value}” is not a C identifier: use letters, digits and _.`);
    if (good) {
        change({ loop: field.value });
    }
}

function leaveName() {
    const field = find('#loop');
    field.value = currentState().loop;
    field.setAttribute('aria-invalid', 'false');
    setText(find('#loop-why'), '');
}

// A button for a part of the page that few need.
function opens(button, section) {
    button.addEventListener('click', () => {
        section.hidden = !section.hidden;
        button.setAttribute('aria-expanded', String(!section.hidden));
        if (!section.hidden) {
            show();
            section.scrollIntoView();
        }
    });
}

function letGo() {
    if (held) {
        held = false;
        show();
    }
}

function listenForHands() {
    document.addEventListener('pointerdown', (event) => {
        held = event.target.matches('input[type=range], .flag');
    });
    document.addEventListener('pointerup', letGo);
    document.addEventListener('pointercancel', letGo);
}

function listen() {
    find('#plots').addEventListener('keydown', moveCursor);
    find('#keep').addEventListener('click', keep);
    find('#share').addEventListener('click', () => toClipboard(linkOf(currentState()), 'The link is copied: it has all settings.'));
    document.addEventListener('keydown', (event) => {
        const way = wayOfKey(event);
        if (way !== 0) {
            event.preventDefault();
            past.travel(way);
        }
    });
    find('#experiment').addEventListener('change', (event) => change({ EXPERIMENT: Number(event.target.value) }));
    find('#copy-record').addEventListener('click', () => toClipboard(recordText(tuned.found.record), 'The record is copied.'));
    find('#loop').addEventListener('input', nameLoop);
    find('#loop').addEventListener('blur', leaveName);
    find('#copy').addEventListener('click', () => toClipboard(find('#header').textContent, 'The header is copied.'));
    find('#save').addEventListener('click', () => download(fileOf(currentState()), find('#header').textContent, 'text/x-c'));
    for (const [id, act] of Object.entries({ png: savePng, svg: saveSvg, csv: saveCsv, json: saveJson, print: () => window.print() })) {
        find(`#take-${id}`).addEventListener('click', act);
    }
    find('#open-json').addEventListener('change', openJson);
    find('#judged').addEventListener('toggle', show);
    opens(find('#open-live'), find('#live'));
    opens(find('#open-tools'), find('#tools'));
    listenForHands();
    window.addEventListener('popstate', () => past.arrived());
    window.addEventListener('hashchange', () => past.arrived());
    matchMedia('print').addEventListener('change', ({ matches }) => ['#look', '#judged'].forEach((id) => {
        find(id).open ||= matches;
    }));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
        show();
        recorder.draw();
        live.draw();
    });
}

async function startPage() {
    await startEngine();
    buildHead();
    plots = createPlots(find('#plots'), setCursor, find('#mini canvas'));
    followPlots(find('#plots'), find('#gains'), find('#mini'));
    pendulum = createPendulum(find('#picture'), (seconds) => plots.cursorAt(seconds));
    flags = createFlags(find('#flags'), plots, currentState, (next) => change({ events: next }));
    events = createEventList(find('#events'), currentState, (next) => change({ events: next }));
    panel = createPanel(change);
    past = createPast({ fragment: () => fragmentOf(currentState()), go: (fragment) => changeNow(stateOfFragment(fragment)) });
    recorder = createRecorder(find('#recorder'), { onUse: useRecorded, onAsk: () => allowTaking(find('#header').textContent !== ''),
        outputMost: () => currentState().OUTPUT_MAX, rate: () => currentState().RATE, unit: () => currentState().unit });
    judge = createVerdict(show);
    live = createLive(find('#live'), { gains: gainsOfPage, scene: currentState, onPlant: useBoard, onStep: useHandStep, onText: useLines, download });
    tools = createTools(find('#tools'), { copy: toClipboard, useRecord });
    listen();
    onChange(showChange);
    changeNow(location.hash.length > 1 ? stateOfFragment(location.hash.slice(1)) : presetState('own'));
    past.settle();
    // What the tests take hold of.
    window.tuner = { live, change, changeNow, currentState, fragmentOf };
    document.body.dataset.ready = 'yes';
}

// A worker that makes fits has this script, too, and no document.
if (typeof document === 'undefined') {
    serveFits();
} else {
    startPage();
}
