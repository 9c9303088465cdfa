// SPDX-License-Identifier: MIT
// Other jobs than to tune this loop: a table for a sensor, the gains of an experiment that a
// chip has made, and what a step costs on a chip.
import { OPTION } from './built.js';
import { fillChips, fillRecordRules } from './cards.js';
import { setText } from './dom.js';
import { recorded } from './engine.js';
import { experimentText, isMeasured } from './experiment.js';
import { createField, readNumber } from './fields.js';
import { digits, short } from './format.js';
import { fillGuard } from './guard.js';
import { readRecord } from './record.js';
import { gainsOfRecord } from './rules.js';
import { tableOf, tableText } from './sensor.js';
import { change, currentState } from './state.js';

// --- A sensor ---------------------------------------------------------------------

function createSensor(own, copy) {
    function sensor() {
        const number = (id) => readNumber(own(`#s-${id}`).value).value ?? NaN;
        const numbers = ['r25', 'beta', 'series', 'bits', 'microvolts', 'low', 'high', 'scale', 'points'].map((id) => [id, number(id)]);
        return { ...Object.fromEntries(numbers), kind: own('#s-kind').value, supply: own('#s-supply').value !== '' };
    }

    function show(found, s) {
        const good = found?.points !== undefined;
        own('#table').hidden = !good;
        own('#copy-table').disabled = !good;
        setText(own('#table'), good ? tableText(found, s.kind === 'ntc' ? 'ntc' : 'type_k', s.scale) : '');
        setText(own('#table-found'), good ? `Worst error ${digits(found.error / s.scale)} °C, over every count, with ${found.points.length} points.` : found?.refused ?? '');
        own('#table-found').classList.toggle('refused', found !== null && !good);
    }

    // What was chosen for other values is not shown beside these.
    own('#sensor').addEventListener('input', (event) => {
        const { kind } = sensor();
        if (event.target.id === 's-kind') {
            own('#s-high').value = kind === 'ntc' ? 150 : 1372;
            own('#s-scale').value = kind === 'ntc' ? 100 : 10;
        }
        for (const label of own('#sensor').querySelectorAll('[data-of]')) {
            label.hidden = label.dataset.of !== kind;
        }
        show(null);
    });
    own('#choose').addEventListener('click', () => show(tableOf(sensor()), sensor()));
    own('#copy-table').addEventListener('click', () => copy(own('#table').textContent, 'The table is copied.'));
}

// --- A chip's record: its rate is the page's ------------------------------------------

function showRecord(own, s, useRecord) {
    const { bytes, refused } = readRecord(own('#record').value);
    const found = bytes ? recorded(s, bytes) : null;
    const rows = found === null || !isMeasured(found.results) ? []
        : found.rules.map((one) => ({ ...one, gains: one.has ? gainsOfRecord(s, one.results) : null }));
    const has = rows.some((row) => row.gains !== null);
    const lasted = `At ${short(s.RATE)} steps per second, as set on this page`;
    const wrong = bytes ? 'A byte of the record is wrong: its check does not match.' : refused ?? '';
    setText(own('#record-found'), found === null ? wrong : experimentText(s.RATE, lasted, found));
    own('#record-found').classList.toggle('refused', found === null && wrong !== '');
    own('#record-rules').hidden = !has;
    fillRecordRules(own('#record-rules'), has ? rows : [], useRecord);
    const results = found?.results;
    fillGuard(own('#record-guard'), results, { outputMin: results?.OUTPUT_MIN, outputMax: results?.OUTPUT_MAX, reverse: (results?.OPTIONS & OPTION.REVERSE) !== 0,
        top: 2 ** s.SENSOR_BITS - 1, rest: 2, setpoint: null });
}

// Returns show(state, results: of a run, or null; hasTuner), which does nothing while nobody
// sees it. copy(text, done) and useRecord(row) are the page's.
export function createTools(section, { copy, useRecord }) {
    const own = (selector) => section.querySelector(selector);
    const clock = createField('c-clock', {}, { read: () => currentState().CLOCK, onInput: (value) => change({ CLOCK: value }), step: () => ({ least: 1 }) });
    own('#clock label').after(' ', clock.field);
    own('#clock').append(' ', clock.why);
    own('#record').addEventListener('input', () => showRecord(own, currentState(), useRecord));
    createSensor(own, copy);
    return (s, results, hasTuner) => {
        if (section.hidden) {
            return;
        }
        own('#chip').hidden = !hasTuner;
        showRecord(own, s, useRecord);
        clock.update();
        own('#chips').hidden = results === null;
        own('#chips-text').hidden = results === null;
        if (results !== null) {
            fillChips(own('#chips-text'), own('#chips'), s, results);
        }
    };
}
