// SPDX-License-Identifier: MIT
// One slider for all gains, from calm to quick: Skogestad's rules with another time
// constant of the loop. And the gains of a wanted Ms, which are found on it.
import { CONTROLLER, PLANT } from './built.js';
import { make, setText } from './dom.js';
import { run } from './engine.js';
import { readNumber } from './fields.js';
import { digits, time } from './format.js';
import { helpFor } from './help.js';
import { marginsOf } from './margins.js';
import { calmOf, simcGains } from './own.js';
import { currentState } from './state.js';

const CALMEST = 8; // times the time constant that SIMC advises, and the quickest is 1 / 8
const PLACES = 120;
const OFF_WISH = 0.02;

// Whether there is such a line: a note's integers are too few, and SIMC knows no pendulum.
export function hasLine(s) {
    return s.CONTROLLER === CONTROLLER.PID && s.PLANT !== PLANT.PENDULUM;
}

export function calmAt(place) {
    return CALMEST ** (1 - 2 * place / PLACES);
}

export function placeOf(calm) {
    const place = PLACES / 2 * (1 - Math.log(calm) / Math.log(CALMEST));
    return Math.round(Math.min(PLACES, Math.max(0, place)));
}

// kp, ki, kd and the derivative's filter; the setpoint weight is not of them.
export function calmGains(s, calm) {
    const { WEIGHT, ...gains } = simcGains(s, calm);
    return gains;
}

// Infinite where the loop is unstable, and null where the controller refuses the gains.
function msOf(s, gains) {
    const next = { ...s, ...gains, events: [], DURATION: 4 / s.RATE };
    const { n, results } = run(next);
    const margins = n > 0 ? marginsOf(next, results) : null;
    return margins === null ? null : margins.stable ? margins.ms : Infinity;
}

// { gains, ms } of the quickest loop with this Ms, or { low, high }: what Ms there are on
// the line, or {} where there are none. Gains are integers in the end: `ms` is theirs.
export function gainsForMs(s, wish) {
    const at = (place) => ({ place, ms: msOf(s, calmGains(s, calmAt(place))) });
    const known = Array.from({ length: 13 }, (_, i) => at(PLACES * (1 - i / 12))).filter(({ ms }) => ms !== null);
    const next = known.findIndex(({ ms }, i) => i > 0 && ms <= wish && known[i - 1].ms >= wish);
    if (next < 0) {
        const all = known.map(({ ms }) => ms).filter(Number.isFinite);
        return all.length > 0 ? { low: Math.min(...all), high: Math.max(...all) } : {};
    }
    let [quick, calm] = [known[next - 1], known[next]];
    for (let i = 0; i < 14 && wish - calm.ms > 1e-4; i++) {
        const middle = at((quick.place + calm.place) / 2);
        [quick, calm] = middle.ms === null || middle.ms > wish ? [middle, calm] : [quick, middle];
    }
    return { gains: calmGains(s, calmAt(calm.place)), ms: calm.ms };
}

// Of the line and of where the gains are on it.
function lineText(s) {
    const found = calmOf(s);
    return found === null ? 'these gains are not on its line' : `time constant ${time(found.seconds)}${Math.abs(found.calm - 1) < 0.005 ? ', as SIMC advises' : ''}`;
}

export function wishText(found, wish) {
    if (found.gains) {
        const near = Math.abs(found.ms - wish) <= OFF_WISH;
        return near ? `Ms ${found.ms.toFixed(2)} is set.` : `Ms ${found.ms.toFixed(2)} is set, the nearest below ${digits(wish)}: the gains are coarse.`;
    }
    return found.low === undefined ? 'No gains on this line are stable.'
        : `Ms ${digits(wish)} cannot be reached: from calm to quick it is ${found.low.toFixed(2)} to ${found.high.toFixed(2)}.`;
}

// What stands above the gains: { row, update(state) }.
export function calmSlider(onMore) {
    const slider = make('input', { type: 'range', id: 'c-calm', min: 0, max: PLACES, step: 1, 'aria-describedby': 'calm-note', title: 'A double click resets it' });
    const note = make('em', { id: 'calm-note' });
    const name = make('span', { className: 'name' }, make('label', { htmlFor: 'c-calm', textContent: 'Calm to quick' }));
    const wish = make('input', { type: 'text', inputMode: 'decimal', id: 'c-ms', value: '1.6', autocomplete: 'off', 'aria-describedby': 'ms-said' });
    const take = make('button', { type: 'button', id: 'take-ms', textContent: 'Set' });
    const said = make('p', { id: 'ms-said', className: 'caption', role: 'status' });
    let heard = null; // the gains that were said something of
    const gainsOf = (s) => JSON.stringify({ ...s, kept: [] });

    function wanted() {
        const s = currentState();
        const { value, why } = readNumber(wish.value);
        const wrong = why ?? (value > 1 ? '' : 'Ms is above 1.');
        wish.setAttribute('aria-invalid', String(wrong !== ''));
        const found = wrong === '' ? gainsForMs(s, value) : {};
        if (found.gains) {
            onMore(found.gains);
        }
        heard = gainsOf(currentState());
        setText(said, wrong || wishText(found, value));
    }
    slider.addEventListener('input', () => onMore(calmGains(currentState(), calmAt(Number(slider.value)))));
    slider.addEventListener('dblclick', () => onMore(calmGains(currentState(), 1)));
    take.addEventListener('click', wanted);
    wish.addEventListener('keydown', (event) => event.key === 'Enter' && wanted());
    const row = make('div', { className: 'control calm', id: 'calm' }, name, note, slider,
        make('span', { className: 'wish' }, make('label', { htmlFor: 'c-ms', textContent: 'Ms ' }), wish, take), said, helpFor('calm'), helpFor('wish'));
    return { row, update: (s) => {
        const found = calmOf(s);
        const simc = s.KP > 0 ? simcGains(s) : null;
        slider.value = placeOf(found?.calm ?? (simc === null ? CALMEST : simc.KP / s.KP));
        slider.setAttribute('aria-valuetext', lineText(s));
        slider.classList.toggle('off', found === null);
        setText(note, lineText(s));
        if (gainsOf(s) !== heard) {
            setText(said, '');
        }
    } };
}
