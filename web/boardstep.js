// SPDX-License-Identifier: MIT
// A step of a board that is recorded: of its setpoint, with the plant that fits it, or of its
// output by hand, for the card of recordings.
import { ALLOWED, FIT_REASON, LIMIT } from './built.js';
import { int16Bytes } from './ask.js';
import { make, setText } from './dom.js';
import { readNumber } from './fields.js';
import { createFitter } from './fitter.js';
import { digits, percent, short, whole } from './format.js';
import { modelText, plantOfModel } from './models.js';
import { createPlots } from './plot.js';
import { hardwareOf } from './session.js';
import { MISSED } from './trace.js';
import { ASK, boardConfig } from './twin.js';

const HOLD = 5; // the part of a recording for which the output stands still before it is stepped by hand

// By hand the output first stands still, where it was on average, so that the step is seen to
// be one. What was just before belongs to a step of the setpoint.
function planned(trace, { byHand, size, steps }) {
    const before = Math.ceil(steps / HOLD);
    const outputs = trace.view(before).OUTPUT;
    const from = byHand ? Math.round(outputs.reduce((sum, one) => sum + one, 0) / outputs.length) : trace.view(1).SETPOINT[0];
    return { byHand, from, to: from + size, value: byHand ? from : from + size, wait: byHand ? before : 0, steps, begun: trace.places - outputs.length };
}

function fitText({ models, chosen, reason, sentence }, missing) {
    const model = models?.[chosen] ?? null;
    const found = reason !== FIT_REASON.USABLE ? sentence : `${modelText(model.plant, null, 'counts')}; ` +
        `${digits(model.error)} counts are left on average, ${percent(model.part)} of what the output moved. The loop was closed, so the fit knows only what the controller excited.`;
    return `${found}${missing > 0 ? ` ${whole(missing)} steps did not come, and are as the one before.` : ''}`;
}

// A curve's value at a time, as its last point before has it.
function at({ t, y }, seconds) {
    const next = t.findIndex((one) => one > seconds);
    return y[next < 0 ? t.length - 1 : Math.max(0, next - 1)];
}

// { begin(), show(), drop(), record(byHand), goOn(stopped): now and then, useFit() }
export function createBoardStep({ own, say, refresh }, session, connection, { may, tell, hasConfig }, { onPlant, onStep, onText }) {
    const plots = createPlots(own('fit-plots'), () => {}, make('canvas'));
    let [recording, columns, fit] = [null, null, null]; // columns: { u, y, missing } of the last one
    const fitter = createFitter(showFit);

    function begin() {
        fitter.stop();
        [recording, columns, fit] = [null, null, null];
        own('fit').hidden = true;
    }

    function show() {
        for (const id of ['setpoint', 'set', 'record']) {
            own(id).disabled = !may(ALLOWED.SETPOINT) || recording !== null;
        }
        own('hand').disabled = !may(ALLOWED.MANUAL) || recording !== null || session.board.manualSteps === 0;
        own('stop').hidden = recording === null;
    }

    async function record(byHand) {
        const [size, length] = ['step', 'length'].map((id) => readNumber(own(id).value).value);
        const { trace } = session;
        if (!Number.isInteger(size) || size === 0 || !(length > 0) || trace.view(1).n === 0) {
            say('A step is a whole number of counts, and its time some seconds.');
            return;
        }
        const plan = planned(trace, { byHand, size, steps: Math.min(LIMIT.STEPS, Math.max(1, Math.round(length / session.seconds))) });
        if (await tell(byHand ? ASK.MANUAL : ASK.SETPOINT, int16Bytes(plan.value), `The ${byHand ? 'output' : 'setpoint'} is ${plan.value}; ${whole(plan.steps)} steps are recorded.`)) {
            const stepAt = trace.places + plan.wait;
            recording = { ...plan, begun: byHand ? trace.places : plan.begun, stepAt, end: stepAt + plan.steps, told: trace.places };
        }
        refresh();
    }

    // A hand has to speak again before the board lets go.
    function holdHand() {
        const { places } = session.trace;
        const stepped = recording.value !== recording.to && places >= recording.stepAt;
        if (connection.isIdle && (stepped || places - recording.told > session.board.manualSteps / 3)) {
            recording.value = stepped ? recording.to : recording.value;
            recording.told = places;
            tell(ASK.MANUAL, int16Bytes(recording.value), `The output is ${recording.value}.`);
        }
    }

    function handOver(u, y) {
        const text = ['time_s;output;measurement', ...Array.from(u, (one, i) => `${short(i * session.seconds)};${one};${y[i]}`)].join('\n');
        const name = 'the board’s step';
        if (hasConfig()) {
            onStep(hardwareOf(session), text, name);
        } else {
            onText(text, name);
        }
    }

    function showFit(found) {
        const { seconds } = session;
        const { u, y, missing } = columns;
        fit = found;
        const good = fit.reason === FIT_REASON.USABLE;
        own('fit').hidden = false;
        setText(own('fit-said'), fitText(fit, missing));
        own('fit-said').className = good ? 'good' : 'refused';
        own('fit-use').disabled = !good;
        const { curve = { t: [0], y: [NaN] } } = fit.models?.[fit.chosen] ?? {};
        const fitted = Float64Array.from(y, (_, i) => at(curve, i * seconds));
        plots.show({ seconds, events: [], duration: y.length * seconds, panes: [
            { title: 'Measurement', unit: 'counts', leastSpan: 8, series: [{ name: 'recorded', color: 'setpoint', data: y }, { name: 'fitted', color: 'measured', dash: [5, 3], data: fitted }] },
            { title: 'Output', unit: 'counts', series: [{ name: 'recorded', color: 'output', held: true, data: u }] }] });
    }

    // At its end, or when it is stopped, the board is as it was.
    async function goOn(stopped = false) {
        if (recording?.byHand) {
            holdHand();
        }
        if (recording === null || (session.trace.places < recording.end && !stopped)) {
            return;
        }
        const { from, byHand, begun } = recording;
        recording = null;
        const view = session.trace.view(session.trace.places - begun);
        const [u, y] = [view.OUTPUT.slice(), view.MEASUREMENT.slice()];
        const missing = view.marks.reduce((sum, mark) => sum + Number(mark === MISSED), 0);
        if (byHand) {
            await tell(ASK.AUTO, [], 'The controller is automatic again; the recording is in “Your plant”.');
            handOver(u, y);
        } else {
            await tell(ASK.SETPOINT, int16Bytes(from), `The setpoint is ${from} again.`);
            columns = { u, y, missing };
            fitter.ask({ lines: { t: Float64Array.from(u, (_, i) => i * session.seconds), u, y }, before: null });
        }
        refresh();
    }

    function useFit() {
        if (hasConfig()) {
            const { OUTPUT_MIN, OUTPUT_MAX } = boardConfig();
            const full = Math.max(OUTPUT_MAX, -OUTPUT_MIN);
            onPlant(hardwareOf(session), plantOfModel(fit.models[fit.chosen], full), { plants: fit.plants, full });
        }
    }
    return { begin, show, record, goOn, useFit, drop: () => { recording = null; } };
}
