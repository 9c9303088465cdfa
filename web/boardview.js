// SPDX-License-Identifier: MIT
// What is shown of a session: its steps in plots, what of them the same C here makes equal,
// and a step with new gains beside what was foretold of it.
import { ALLOWED, VERSION } from './built.js';
import { make, setText, table } from './dom.js';
import { digits, percent, time, whole } from './format.js';
import { createPlots } from './plot.js';
import { stepFigures } from './predicted.js';
import { MISSED } from './trace.js';
import { LINK_VERSION, twinCounts } from './twin.js';

const SHOWN = 60; // seconds
const SHOWN_MOST = 60000; // steps
const OUTPUT_LIMITED = 3; // flags

export function boardText({ name, library, seconds, allowed, manualSteps, version }) {
    const may = (bit, word) => ((allowed & bit) !== 0 ? `${word}: yes` : `${word}: no`);
    const hand = (allowed & ALLOWED.MANUAL) !== 0 && manualSteps > 0 ? `output by hand: for ${time(manualSteps * seconds)} at a time` : 'output by hand: no';
    const other = library === VERSION ? '' : ` This page is ${VERSION}: where the arithmetic of the two differs, so do their steps.`;
    const form = version === LINK_VERSION ? '' : ` Its link is version ${version}, and this page knows version ${LINK_VERSION}: it gets no command, and what is shown may be wrong.`;
    return `“${name}”, fixpid ${library}, ${digits(1 / seconds)} steps per second. Allowed: ${may(ALLOWED.SETPOINT, 'setpoint')}, ${may(ALLOWED.GAINS, 'gains')}, ` +
        `${may(ALLOWED.LIMITS, 'limits')}, ${hand}.${other}${form}`;
}

// { text, good: true, false or null }, of a board by its link's version
export function verdictOf(counts, version) {
    if (version !== LINK_VERSION) {
        return { good: null, text: `Not compared: the board’s link is version ${version}.` };
    }
    const equal = `${whole(counts.EQUAL)} step${counts.EQUAL === 1 ? '' : 's'} equal, bit for bit`;
    if (counts.DIFFERENT > 0) {
        const number = whole(counts.FIRST_NUMBER >>> 0);
        const what = counts.FIRST_STATE === 1 ? `in step ${number} output and flags are equal, but the integral, the derivative or the feed-forward inside differs`
            : `in step ${number} the board’s output is ${counts.FIRST_OUTPUT} with flags ${counts.FIRST_FLAGS}, this page’s ${counts.FIRST_OWN_OUTPUT} with flags ${counts.FIRST_OWN_FLAGS}`;
        const times = counts.DIFFERENT === 1 ? '' : `, the first of ${whole(counts.DIFFERENT)} differences`;
        return { good: false, text: `Different: ${what}${times}. Either the board does not run this fixpid, or its program changed the controller without calling fixpid_link_changed. ${equal}.` };
    }
    if (counts.EQUAL === 0) {
        return { good: null, text: counts.LEFT_THINNED > 0 ? 'Not compared: only every so many steps are sent, so there is a plot but no twin.' : 'No step is compared yet: that begins with the board’s record and a key frame.' };
    }
    return { good: true, text: `${equal}.` };
}

// What was not compared, and why, of `missing` steps beside: texts.
function leftOf(counts, missing) {
    const reasons = [
        [counts.LEFT_BEGINNING, 'before the record and the first key frame'],
        [counts.LEFT_GAP, `after ${whole(counts.GAPS)} gap${counts.GAPS === 1 ? '' : 's'}, up to the next key frame`],
        [counts.LEFT_THINNED, 'in a stream that is thinned out'],
        [counts.LEFT_DIFFERENCE, 'after a difference, up to the next key frame'],
        [counts.LEFT_CHANGED, 'where the program itself changed the controller'],
    ];
    const found = reasons.filter(([count]) => count > 0).map(([count, why]) => `${whole(count)} ${why}`);
    return [...(found.length > 0 ? [`Not compared: ${found.join('; ')}.`] : []),
        ...(missing > 0 ? [`${whole(missing)} step${missing === 1 ? '' : 's'} did not come.`] : []),
        ...(counts.SPOILT > 0 ? [`${whole(counts.SPOILT)} ${counts.SPOILT === 1 ? 'piece between two frames is' : 'pieces between two frames are'} no frame: damaged bytes, or text.`] : [])];
}

function boardPanes(view) {
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

// { caption, cells of each figure, words } of a step that was told.
function comparisonOf(told, seconds) {
    const { from, to, band, came, predicted, rested, missing, over } = told;
    const cells = ({ overshoot, settled, iae }) => [`${digits(overshoot)} (${percent(overshoot / Math.abs(to - from))})`,
        settled === null ? 'not yet' : time(settled * seconds), digits(iae * seconds)];
    const [before, behind] = [predicted, came].map((y) => cells(stepFigures(y, told)));
    const rows = ['Overshoot, counts', `Settled (±${digits(band, 2)})`, 'IAE, counts × s'].map((name, i) => ({ cells: [name, before[i], behind[i]] }));
    const words = [...(rested ? [] : ['The board was not at rest before this step; the prediction assumes that it was.']),
        ...(missing > 0 ? [`${whole(missing)} steps did not come, and are as the one before.`] : [])].join(' ');
    return { figures: table(`The setpoint from ${from} to ${to}, ${over ? '' : 'so far '}${time(came.length * seconds)}`, ['Figure', 'Predicted', 'Came'], rows), words };
}

// { begin(), draw(anyway) } of a session, and of the step that told() gives to compare, or null.
export function createBoardView({ own }, session, told) {
    const plots = createPlots(own('plots'), () => {}, make('canvas'));
    const toldPlots = createPlots(own('told-plots'), () => {}, make('canvas'));
    let [drawn, shown] = [0, null];

    function begin() {
        [drawn, shown] = [0, null];
        setText(own('board'), '');
        own('data').hidden = true;
        own('told').hidden = true;
    }

    function showVerdict() {
        const counts = twinCounts();
        const { text, good } = verdictOf(counts, session.board?.version ?? LINK_VERSION);
        setText(own('verdict'), text);
        own('verdict').className = good === null ? '' : good ? 'good' : 'refused';
        const left = leftOf(counts, session.trace.places - session.trace.count);
        if (own('left').textContent !== left.join('')) {
            own('left').replaceChildren(...left.map((one) => make('li', { textContent: one })));
        }
    }

    // What came of a step with the gains that were sent, beside what the page foretold.
    function showComparison(anyway) {
        const now = told();
        if (now === null || (now === shown && !anyway)) {
            return;
        }
        shown = now;
        const { figures, words } = comparisonOf(now, session.seconds);
        own('told').hidden = false;
        own('told-figures').replaceChildren(figures);
        setText(own('told-said'), words);
        toldPlots.show({ seconds: session.seconds, events: [], duration: now.came.length * session.seconds, panes: [
            { title: 'Measurement', unit: 'counts', leastSpan: 8, series: [{ name: 'predicted', color: 'setpoint', dash: [5, 3], data: now.predicted }, { name: 'came', color: 'measured', data: now.came }] }] });
    }

    // Only where something came, and a person may see it.
    function draw(anyway = false) {
        const { trace, seconds } = session;
        if ((trace.count === drawn && !anyway) || trace.count === 0 || document.hidden) {
            return;
        }
        drawn = trace.count;
        own('data').hidden = false;
        const view = trace.view(Math.min(SHOWN_MOST, Math.max(100, Math.round(SHOWN / seconds))));
        plots.show({ panes: boardPanes(view), seconds, events: [], duration: Math.max(10, view.n - 1) * seconds });
        showVerdict();
        showComparison(anyway);
    }
    return { begin, draw };
}
