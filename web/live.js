// SPDX-License-Identifier: MIT
// The card of a board that is connected, or of a log of one: its steps in plots, what of
// them the same C here makes equal, and the commands that the board allows.
import { ALLOWED, LIMIT, OPTION, VERSION } from './built.js';
import { createAsker, int16Bytes, commandRefusal } from './ask.js';
import { make, setText, table } from './dom.js';
import { readNumber } from './fields.js';
import { digits, percent, short, time, whole } from './format.js';
import { documentOf, helpFor } from './help.js';
import { bytesOfFile, bytesOfText, columnsOfText, csvOfTrace, jsonOfSession } from './log.js';
import { fitLoop, simulated } from './loopfit.js';
import { createPlots } from './plot.js';
import { hasSerial, openPort } from './port.js';
import { createComparison, stepFigures } from './predicted.js';
import { createTrace, MISSED } from './trace.js';
import { ASK, FRAME, beginTwin, boardConfig, recordBytes, takeBytes, twinCounts } from './twin.js';

const HELD = 120000; // steps
const SHOWN = 60; // seconds
const SHOWN_MOST = 60000; // steps
const REDRAW = 100; // milliseconds
const SILENT = 5000; // milliseconds and three steps without a frame, and the board is asked again
const BYTES_KEPT = 4 * 1024 * 1024;
const LOG_SLICE = 1 << 17; // bytes of a log at once
const TEXT_SHOWN = 120; // characters of what is no frame
const TEXT_OFFERED = 1 << 16; // characters of a port's text that may be a recording
const SETS_KEPT = 10; // gains that can be gone back to
const HOLD = 5; // the part of a recording for which the output stands still before it is stepped by hand
const OUTPUT_LIMITED = 3; // flags

const sameBytes = (a, b) => a.length === b.length && a.every((one, i) => one === b[i]);

// --- Words ------------------------------------------------------------------------

function boardText({ name, library, seconds, allowed, manualSteps, version }) {
    const may = (bit, word) => ((allowed & bit) !== 0 ? `${word}: yes` : `${word}: no`);
    const hand = (allowed & ALLOWED.MANUAL) !== 0 && manualSteps > 0 ? `output by hand: for ${time(manualSteps * seconds)} at a time` : 'output by hand: no';
    const other = library === VERSION ? '' : ` This page is ${VERSION}: where the arithmetic of the two differs, so do their steps.`;
    const form = version === 1 ? '' : ` Its link is version ${version}, and this page knows version 1: what is shown may be wrong.`;
    return `“${name}”, fixpid ${library}, ${digits(1 / seconds)} steps per second. Allowed: ${may(ALLOWED.SETPOINT, 'setpoint')}, ${may(ALLOWED.GAINS, 'gains')}, ` +
        `${may(ALLOWED.LIMITS, 'limits')}, ${hand}.${other}${form}`;
}

// { text, good: true, false or null }
export function verdictOf(counts) {
    const equal = `${whole(counts.EQUAL)} step${counts.EQUAL === 1 ? '' : 's'} equal, bit for bit`;
    if (counts.DIFFERENT > 0) {
        const number = whole(counts.FIRST_NUMBER >>> 0);
        const what = counts.FIRST_STATE === 1 ? `in step ${number} output and flags are equal, and the integral, the derivative or the feed-forward inside is not`
            : `in step ${number} the board’s output is ${counts.FIRST_OUTPUT} with flags ${counts.FIRST_FLAGS}, this page’s ${counts.FIRST_OWN_OUTPUT} with flags ${counts.FIRST_OWN_FLAGS}`;
        const times = counts.DIFFERENT === 1 ? '' : `, the first of ${whole(counts.DIFFERENT)} differences`;
        return { good: false, text: `Different: ${what}${times}. Either the board does not run this fixpid, or its program changed the controller and did not say so by fixpid_link_changed. ${equal}.` };
    }
    if (counts.EQUAL === 0) {
        return { good: null, text: counts.LEFT_THINNED > 0 ? 'Not compared: only each so many steps are sent, so there is a plot and no twin.' : 'No step is compared yet: that begins with the board’s record and a key frame.' };
    }
    return { good: true, text: `${equal}.` };
}

// What was not compared, and why, of `missing` steps beside: texts.
export function leftOf(counts, missing) {
    const reasons = [
        [counts.LEFT_BEGINNING, 'before the record and the first key frame'],
        [counts.LEFT_GAP, `behind ${whole(counts.GAPS)} gap${counts.GAPS === 1 ? '' : 's'}, up to the next key frame`],
        [counts.LEFT_THINNED, 'in a stream that is thinned out'],
        [counts.LEFT_DIFFERENCE, 'after a difference, up to the next key frame'],
        [counts.LEFT_CHANGED, 'where the program itself changed the controller'],
    ];
    const found = reasons.filter(([count]) => count > 0).map(([count, why]) => `${whole(count)} ${why}`);
    return [...(found.length > 0 ? [`Not compared: ${found.join('; ')}.`] : []),
        ...(missing > 0 ? [`${whole(missing)} step${missing === 1 ? '' : 's'} did not come.`] : []),
        ...(counts.SPOILT > 0 ? [`${whole(counts.SPOILT)} ${counts.SPOILT === 1 ? 'piece between two frames is' : 'pieces between two frames are'} no frame: damaged bytes, or text.`] : [])];
}

const GAINS = [['KP', 'kp_q8'], ['KI', 'ki_q24'], ['KD', 'kd_q8'], ['FILTER', 'derivative_filter']];

// A board's configuration as gains and limits of the page's state.
export function stateOfConfig(config, seconds) {
    const rate = 1 / seconds;
    return { RATE: rate, KP: config.KP / 256, KI: (config.KI >>> 0) * rate / 2 ** 24, KD: config.KD * 2 ** config.FILTER / 256 / rate, FILTER: config.FILTER,
        OUTPUT_MIN: config.OUTPUT_MIN, OUTPUT_MAX: config.OUTPUT_MAX, INTEGRAL_MIN: config.INTEGRAL_MIN, INTEGRAL_MAX: config.INTEGRAL_MAX,
        WEIGHT: (config.WEIGHT === 0 ? 256 : config.WEIGHT) / 256, OPTIONS: config.OPTIONS & Object.values(OPTION).reduce((all, bit) => all | bit) };
}

// --- The card ---------------------------------------------------------------------

// Fills the card. `gains()` gives the page's integers and its rate, or null, and `scene()`
// its state; onPlant(hardware, plant) takes both; onStep(hardware, text, name) takes a
// recording as lines, onText(text, name) one of any program; `download(name, text, type)`.
export function createLive(section, { gains, scene, onPlant, onStep, onText, download }) {
    const own = (id) => section.querySelector(`#live-${id}`);
    const plots = createPlots(own('plots'), () => {}, make('canvas'));
    const fitPlots = createPlots(own('fit-plots'), () => {}, make('canvas'));
    const toldPlots = createPlots(own('told-plots'), () => {}, make('canvas'));
    let trace = null;
    let [port, asker, board, kept, keptBytes] = [null, null, null, [], 0];
    let [drawn, lastFrame, tail, restarting, log] = [0, 0, '', false, 0];
    let [sets, recording, fit, comparison, shown, other] = [[], null, null, null, null, null];

    const say = (text) => setText(own('said'), text);
    const seconds = () => board?.seconds || 1;

    function begin(asks) {
        beginTwin(asks);
        trace = createTrace(HELD);
        [board, kept, keptBytes, drawn, tail, sets, fit, recording, comparison, shown] = [null, [], 0, 0, '', [], null, null, null, null];
        setText(own('board'), '');
        for (const id of ['data', 'fit', 'told']) {
            own(id).hidden = true;
        }
        offer(null);
        showCommands();
    }

    // --- What comes ---

    function keep(bytes) {
        keptBytes += bytes.length; // from the first that has no room on none is kept
        if (keptBytes <= BYTES_KEPT) {
            kept.push(bytes.slice());
        }
    }

    function takeFrame(frame) {
        if (frame.kind === FRAME.HELLO) {
            board = frame;
            setText(own('board'), boardText(board));
        }
        asker?.took(frame);
    }

    function takeSteps(numbers, n) {
        trace.take(numbers, n);
        lastFrame = performance.now();
    }

    function take(bytes) {
        keep(bytes);
        if (board === null && trace.count === 0) {
            tail = `${tail}${String.fromCharCode(...bytes.subarray(-TEXT_SHOWN))}`.slice(-TEXT_SHOWN);
        }
        takeBytes(bytes, takeSteps, takeFrame);
    }

    // --- What is shown ---

    function panesOf(view) {
        const missing = view.marks.map((mark) => Number(mark === MISSED));
        const limited = view.FLAGS.map((flags) => Number((flags & OUTPUT_LIMITED) !== 0));
        return [
            { title: 'Measurement', unit: 'counts', leastSpan: 8, limited: missing, series: [
                { name: 'setpoint', color: 'setpoint', dash: [6, 4], held: true, data: view.SETPOINT },
                { name: 'measured', color: 'measured', data: view.MEASUREMENT }] },
            { title: 'Output', unit: 'counts', limited, series: [{ name: 'output', color: 'output', held: true, data: view.OUTPUT }] },
            { title: 'Terms, of the twin', unit: 'counts', series: [['P', 'p'], ['I', 'i'], ['D', 'd']].map(([name, hue]) => ({ name, color: hue, width: 1.25, data: view[name] })) },
        ];
    }

    function showVerdict() {
        const counts = twinCounts();
        const { text, good } = verdictOf(counts);
        setText(own('verdict'), text);
        own('verdict').className = good === null ? '' : good ? 'good' : 'refused';
        const left = leftOf(counts, trace.places - trace.count);
        if (own('left').textContent !== left.join('')) {
            own('left').replaceChildren(...left.map((one) => make('li', { textContent: one })));
        }
    }

    // What came of a step with the gains that were sent, beside what the page foretold.
    function showComparison(anyway) {
        const told = comparison?.now() ?? null;
        if (told === null || (told === shown && !anyway)) {
            return;
        }
        shown = told;
        const { from, to, band, came, predicted, rested, missing, over } = told;
        const one = seconds();
        const cells = ({ overshoot, settled, iae }) => [`${digits(overshoot)} (${percent(overshoot / Math.abs(to - from))})`,
            settled === null ? 'not yet' : time(settled * one), digits(iae * one)];
        const [before, behind] = [predicted, came].map((y) => cells(stepFigures(y, told)));
        const rows = ['Overshoot, counts', `Settled (±${digits(band, 2)})`, 'IAE, counts × s'].map((name, i) => ({ cells: [name, before[i], behind[i]] }));
        own('told').hidden = false;
        own('told-figures').replaceChildren(table(`The setpoint from ${from} to ${to}, ${over ? '' : 'so far '}${time(came.length * one)}`, ['Figure', 'Predicted', 'Came'], rows));
        setText(own('told-said'), [...(rested ? [] : ['The board was not at rest before this step, and the prediction is of one that is.']),
            ...(missing > 0 ? [`${whole(missing)} steps did not come, and are as the one before.`] : [])].join(' '));
        toldPlots.show({ seconds: one, events: [], duration: came.length * one, panes: [
            { title: 'Measurement', unit: 'counts', leastSpan: 8, series: [{ name: 'predicted', color: 'setpoint', dash: [5, 3], data: predicted }, { name: 'came', color: 'measured', data: came }] }] });
    }

    // Only where something came, and a person may see it.
    function draw(anyway = false) {
        if ((trace.count === drawn && !anyway) || trace.count === 0 || document.hidden) {
            return;
        }
        drawn = trace.count;
        own('data').hidden = false;
        const view = trace.view(Math.min(SHOWN_MOST, Math.max(100, Math.round(SHOWN / seconds()))));
        plots.show({ panes: panesOf(view), seconds: seconds(), events: [], duration: Math.max(10, view.n - 1) * seconds() });
        showVerdict();
        showComparison(anyway);
    }

    // --- A port ---

    // The record first, then the stream, whose first frame is a key frame.
    async function ask(command, value) {
        if (asker === null) {
            throw new Error('');
        }
        return asker.ask(command, value);
    }

    // Of a port that is gone it is said why already.
    function fail(error) {
        if (port !== null) {
            say(error.message);
        }
    }

    async function start(done = 'Connected.') {
        restarting = true;
        try {
            await ask(ASK.HELLO);
            await ask(ASK.RECORD);
            await ask(ASK.STREAM, [1]);
            say(done);
            showCommands();
        } catch (error) {
            const printable = tail.replace(/[^\x20-\x7E]+/g, ' ').trim();
            offer(columnsOfText(String.fromCharCode(...allBytes().subarray(0, TEXT_OFFERED))), 'what came from the port');
            fail(new Error(printable.length > 8 ? `Bytes come, but no board that speaks fixpid_link at this baud rate. They read: ${printable}`
                : `${error.message} Does its program call fixpid_link, and is this its baud rate?`));
        }
        restarting = false;
    }

    // What the twin lacks is asked for again; so is a board that has fallen silent.
    async function watch() {
        draw();
        stepRecording();
        if (port === null || board === null || restarting || !asker.idle) {
            return;
        }
        if (performance.now() - lastFrame > SILENT + 3000 * seconds()) {
            say('The board is silent, and is asked again.');
            lastFrame = performance.now();
            await start('Connected again: the board had fallen silent. It may have begun anew.');
        } else if (twinCounts().WANTS_RECORD === 1) {
            try {
                await ask(ASK.RECORD);
                await ask(ASK.STREAM, [1]);
            } catch {
                // it is asked for again when the board is silent
            }
        }
    }

    function gone(sentence) {
        asker.stop('The port is closed.');
        [port, asker, recording] = [null, null, null];
        say(sentence);
        showConnection();
        showCommands();
        draw(true);
    }

    async function connect() {
        const baud = Number(own('baud').value);
        log += 1; // one that is still read is left
        try {
            const opened = await openPort(baud, { onBytes: take, onGone: gone });
            begin(true);
            port = opened;
        } catch (error) {
            say(error.message);
            return;
        }
        asker = createAsker((bytes) => port.write(bytes));
        lastFrame = performance.now();
        say('The port is open; the board is asked who it is.');
        showConnection();
        await start();
    }

    async function disconnect() {
        const closing = port;
        gone('The port is closed; what came is kept.');
        await closing.close();
    }

    function showConnection() {
        own('connect').hidden = port !== null;
        own('disconnect').hidden = port === null;
        own('baud').disabled = port !== null;
    }

    // --- A log ---

    async function readLog({ bytes, refused, columns = null }, name) {
        if (refused !== undefined) {
            say(refused);
            offer(columns, name);
            return;
        }
        if (port !== null) {
            await disconnect();
        }
        begin(false);
        log += 1;
        const mine = log;
        for (let at = 0; at < bytes.length && mine === log; at += LOG_SLICE) {
            take(bytes.subarray(at, at + LOG_SLICE));
            draw();
            await new Promise((go) => {
                setTimeout(go, 0);
            });
        }
        if (mine !== log) {
            return;
        }
        // A frame ends with a 0: so does the last one of a log that was cut there.
        take(Uint8Array.of(0));
        draw(true);
        showCommands();
        offer(trace.count === 0 ? columns : null, name);
        say(trace.count === 0 ? `${name}: no frame of fixpid_link is in these ${whole(bytes.length)} bytes.` : `${name}: ${whole(trace.count)} steps in ${whole(bytes.length)} bytes.`);
    }

    // Lines of numbers are for the card of recordings; null: there are none.
    function offer(text, name) {
        other = text === null ? null : { text, name };
        own('other').hidden = other === null;
    }

    // --- Commands ---

    function showCommands() {
        const may = (bit) => port !== null && board !== null && (board.allowed & bit) !== 0;
        own('commands').hidden = port === null || board === null;
        for (const id of ['setpoint', 'set', 'record']) {
            own(id).disabled = !may(ALLOWED.SETPOINT) || recording !== null;
        }
        own('hand').disabled = !may(ALLOWED.MANUAL) || recording !== null || board.manualSteps === 0;
        own('send').disabled = !may(ALLOWED.GAINS);
        own('revert').disabled = !may(ALLOWED.GAINS) || sets.length === 0;
        setText(own('revert'), sets.length > 1 ? `Revert (${sets.length} sets are kept)` : 'Revert');
        own('confirm').hidden ||= !may(ALLOWED.GAINS); // it waits for a person, whatever the board does
        own('stop').hidden = recording === null;
        own('use').disabled = board === null;
    }

    // Says what came of it; true if it is done.
    async function tell(command, value, done) {
        try {
            const why = commandRefusal(await ask(command, value));
            say(why || done);
            return why === '';
        } catch (error) {
            fail(error);
            return false;
        }
    }

    async function setSetpoint(value, done = `The setpoint is ${value}.`) {
        if (!Number.isInteger(value) || Math.abs(value) > 32767) {
            say('A setpoint is a whole number of counts.');
            return false;
        }
        return tell(ASK.SETPOINT, int16Bytes(value), done);
    }

    // Old and new beside each other, and a button that sends them.
    function confirm() {
        const page = gains();
        const old = boardConfig();
        if (!hasConfig()) {
            return;
        }
        const wrong = page === null ? 'The page’s controller refuses its gains, or is not a fixpid_pid.'
            : Math.abs(page.RATE * seconds() - 1) > 1e-3 ? `The page’s loop makes ${short(page.RATE)} steps per second and the board ${short(1 / seconds())}: take the board’s settings first.` : null;
        if (wrong !== null) {
            say(wrong);
            return;
        }
        const bold = page.KP > 2 * old.KP;
        own('compare').replaceChildren(table('The integers of both', ['Gain', 'Board', 'Page'], GAINS.map(([name, field]) => ({ cells: [field, String(old[name] >>> 0), String(page[name])] }))));
        own('bold').closest('label').hidden = !bold;
        own('bold').checked = false;
        own('sure').disabled = bold;
        own('confirm').hidden = false;
        own('sure').focus();
    }

    // Only an answer and an equal record are good.
    async function write(record, done) {
        if (!(await tell(ASK.WRITE, [...record], 'The board has taken them; its record is asked for.'))) {
            return false;
        }
        try {
            const { record: now } = await ask(ASK.RECORD);
            const same = sameBytes(now, record);
            say(same ? done : 'The board’s record is not what was sent: another program has changed it.');
            return same;
        } catch (error) {
            fail(error);
            return false;
        }
    }

    async function send() {
        const page = gains();
        own('confirm').hidden = true;
        if (!hasConfig()) {
            return;
        }
        const before = recordBytes(boardNumbers());
        const record = recordBytes(page);
        if (await write(record, 'Sent: the board runs with them, and its record is equal in all bytes. It forgets them at power-off, unless its program keeps the record.')) {
            sets = [...sets, before].slice(-SETS_KEPT);
            compareFromNow();
        }
        showCommands();
    }

    // While the record is asked for again, the twin has none.
    function hasConfig() {
        const has = boardConfig() !== null;
        if (!has) {
            say('The board’s record has not come yet.');
        }
        return has;
    }

    function compareFromNow() {
        own('told').hidden = true;
        const config = boardConfig();
        comparison = config === null ? null : createComparison(trace, { ...scene(), ...stateOfConfig(config, seconds()) });
    }

    function boardNumbers() {
        const { KP, KI, KD, FILTER } = boardConfig();
        return { KP, KI, KD, FILTER };
    }

    async function revert() {
        if (await write(sets.at(-1), 'The board has its former gains again.')) {
            sets = sets.slice(0, -1);
            compareFromNow();
        }
        showCommands();
    }

    // --- A step that is recorded ---

    // Of the setpoint, or of the output by hand: then the output first stands still, where it
    // was on average, so that the step is seen to be one. What was just before belongs to it.
    async function record(byHand) {
        const { value: size } = readNumber(own('step').value);
        const { value: length } = readNumber(own('length').value);
        const now = trace.view(1);
        if (!Number.isInteger(size) || size === 0 || !(length > 0) || now.n === 0) {
            say('A step is a whole number of counts, and its time some seconds.');
            return;
        }
        const steps = Math.min(LIMIT.STEPS, Math.max(1, Math.round(length / seconds())));
        const before = Math.ceil(steps / HOLD);
        const outputs = trace.view(before).OUTPUT;
        const from = byHand ? Math.round(outputs.reduce((sum, one) => sum + one, 0) / outputs.length) : now.SETPOINT[0];
        const value = byHand ? from : from + size;
        const begun = trace.places - outputs.length;
        if (await tell(byHand ? ASK.MANUAL : ASK.SETPOINT, int16Bytes(value), `The ${byHand ? 'output' : 'setpoint'} is ${value}; ${whole(steps)} steps are recorded.`)) {
            const stepAt = trace.places + (byHand ? before : 0);
            recording = { byHand, from, to: from + size, value, begun: byHand ? trace.places : begun, stepAt, end: stepAt + steps, told: trace.places };
        }
        showCommands();
    }

    // A hand has to speak again before the board lets go.
    function holdHand() {
        const due = trace.places - recording.told > board.manualSteps / 3;
        const stepped = recording.value !== recording.to && trace.places >= recording.stepAt;
        if (asker.idle && (due || stepped)) {
            recording.value = stepped ? recording.to : recording.value;
            recording.told = trace.places;
            tell(ASK.MANUAL, int16Bytes(recording.value), `The output is ${recording.value}.`);
        }
    }

    // At its end, or when it is stopped, the board is as it was.
    async function stepRecording(stopped = false) {
        if (recording?.byHand) {
            holdHand();
        }
        if (recording === null || (trace.places < recording.end && !stopped)) {
            return;
        }
        const { from, byHand, begun } = recording;
        recording = null;
        const view = trace.view(trace.places - begun);
        const [u, y] = [view.OUTPUT.slice(), view.MEASUREMENT.slice()];
        const missing = view.marks.reduce((sum, mark) => sum + Number(mark === MISSED), 0);
        if (byHand) {
            await tell(ASK.AUTO, [], 'The controller is automatic again; the recording is in “Your plant, from a step that you recorded”.');
            const text = ['time_s;output;measurement', ...Array.from(u, (one, i) => `${short(i * seconds())};${one};${y[i]}`)].join('\n');
            const name = 'the board’s step';
            if (hasConfig()) {
                onStep(hardware(), text, name);
            } else {
                onText(text, name);
            }
        } else {
            await tell(ASK.SETPOINT, int16Bytes(from), `The setpoint is ${from} again.`);
            fit = { ...fitLoop(u, y), u, y };
            showFit(missing);
        }
        showCommands();
    }

    function showFit(missing) {
        const { u, y, refused } = fit;
        own('fit').hidden = false;
        const lost = missing > 0 ? ` ${whole(missing)} steps did not come, and are as the one before.` : '';
        const found = refused === undefined || refused === null ? `Gain ${digits(fit.gain)} counts per count of output, lag ${time(fit.lag * seconds())}, dead time ${time(fit.dead * seconds())}; ` +
            `${digits(fit.error)} counts are left on average, ${percent(fit.part)} of the swing. The loop was closed, so the fit knows only what the controller excited.` : refused;
        setText(own('fit-said'), `${found}${lost}`);
        own('fit-said').className = refused ? 'refused' : 'good';
        own('fit-use').disabled = Boolean(refused);
        const fitted = fit.lag === undefined ? new Float64Array(0) : simulated(fit, u);
        fitPlots.show({ seconds: seconds(), events: [], duration: y.length * seconds(), panes: [
            { title: 'Measurement', unit: 'counts', leastSpan: 8, series: [{ name: 'recorded', color: 'setpoint', data: y }, { name: 'fitted', color: 'measured', dash: [5, 3], data: fitted }] },
            { title: 'Output', unit: 'counts', series: [{ name: 'recorded', color: 'output', held: true, data: u }] }] });
    }

    // The hardware of the board as the page's settings: a unit is a count.
    function hardware() {
        const config = boardConfig();
        const view = trace.view(HELD);
        const highest = Math.max(view.SETPOINT.reduce((a, b) => Math.max(a, b), 0), view.MEASUREMENT.reduce((a, b) => Math.max(a, b), 0));
        const bits = Math.min(15, Math.max(10, Math.ceil(Math.log2(highest + 1))));
        return { ...stateOfConfig(config, seconds()), SENSOR_BITS: bits, SENSOR_LOW: 0, SENSOR_RANGE: 2 ** bits - 1, NOISE: 0, unit: 'counts' };
    }

    function useFit() {
        if (!hasConfig()) {
            return;
        }
        const { OUTPUT_MIN, OUTPUT_MAX } = boardConfig();
        const full = Math.max(OUTPUT_MAX, -OUTPUT_MIN);
        const round = (x) => Number(x.toPrecision(4));
        onPlant(hardware(), { GAIN: round(fit.gain * full), T1: round(fit.lag * seconds()), T2: 0, DEAD: round(fit.dead * seconds()), START: round(fit.rest) });
    }

    // --- What is saved ---

    function allBytes() {
        const found = new Uint8Array(kept.reduce((sum, one) => sum + one.length, 0));
        let at = 0;
        for (const one of kept) {
            found.set(one, at);
            at += one.length;
        }
        return found;
    }

    function saveCsv() {
        const view = trace.view(2 * HELD);
        download('board.csv', csvOfTrace(view, seconds()), 'text/csv');
    }

    function saveJson() {
        download('board.json', jsonOfSession({ board, config: boardConfig(), counts: twinCounts(), sent: sets.map((one) => [...one]), bytes: allBytes(), whole: keptBytes <= BYTES_KEPT }), 'application/json');
    }

    // --- From the start ---

    function listen() {
        const on = (id, act) => own(id).addEventListener('click', act);
        on('connect', connect);
        on('disconnect', disconnect);
        on('open', () => own('file').click());
        own('file').addEventListener('change', async (event) => {
            const [file] = event.target.files;
            await readLog(bytesOfFile(new Uint8Array(await file.arrayBuffer())), file.name);
            event.target.value = '';
        });
        on('read', () => readLog(bytesOfText(own('log').value), 'The log'));
        on('set', () => setSetpoint(readNumber(own('setpoint').value).value));
        on('send', confirm);
        on('sure', send);
        on('not', () => {
            own('confirm').hidden = true;
            own('send').focus();
        });
        own('bold').addEventListener('change', () => {
            own('sure').disabled = !own('bold').checked;
        });
        on('revert', revert);
        on('record', () => record(false));
        on('hand', () => record(true));
        on('stop', () => stepRecording(true));
        on('use', () => hasConfig() && onPlant(hardware(), null));
        on('hand-over', () => {
            onText(other.text, other.name);
            offer(null);
        });
        on('fit-use', useFit);
        on('csv', saveCsv);
        on('json', saveJson);
        section.addEventListener('dragover', (event) => {
            event.preventDefault();
            section.classList.add('over');
        });
        section.addEventListener('dragleave', () => section.classList.remove('over'));
        section.addEventListener('drop', async (event) => {
            event.preventDefault();
            section.classList.remove('over');
            const [file] = event.dataTransfer.files;
            if (file) {
                await readLog(bytesOfFile(new Uint8Array(await file.arrayBuffer())), file.name);
            } else {
                await readLog(bytesOfText(event.dataTransfer.getData('text')), 'The log');
            }
        });
    }

    for (const id of ['baud', 'setpoint', 'step', 'length']) {
        const label = own(id).closest('label');
        const name = label.firstChild.textContent.trim();
        label.after(helpFor(name, name));
    }
    own('docs').href = documentOf('link#a-live-link', location);
    own('connect').disabled = !hasSerial();
    own('none').hidden = hasSerial();
    listen();
    showConnection();
    begin(false);
    setInterval(watch, REDRAW);
    return { draw: () => draw(true) };
}
