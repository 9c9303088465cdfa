// SPDX-License-Identifier: MIT
// The cards below the plots: figures, margins, rules, chips.
import { CONTROLLER, COSTS, FEATURES, PLANT } from './built.js';
import { make, table } from './dom.js';
import { ruleName } from './experiment.js';
import { digits, percent, short, time, whole } from './format.js';
import { NOUN, featuresOf, hex } from './header.js';
import { firstRow } from './rules.js';

// Pairs of a name and a figure.
export function fillFigures(place, pairs) {
    place.replaceChildren(...pairs.map(([name, value, title = '']) =>
        make('div', { title }, make('dt', { textContent: name }), make('dd', { textContent: value }))));
}

function seconds(value, none) {
    return value === null ? none : time(value);
}

// Beside those above the plots.
export function figuresOf(s, found) {
    return [
        s.PLANT === PLANT.PENDULUM ? ['Base’s way', `${digits(found.travel)} m`] : ['Rise to 90 %', seconds(found.rise, 'not reached')],
        ['Mean error', `${digits(found.meanError)} ${s.unit}`],
        ['IAE', `${digits(found.iae)} ${s.unit} s`, 'Integral of the absolute error over all that is shown'],
        ['Output limited', percent(found.limited, 0)],
        ['Output moves', `${digits(found.moved)} / step`, 'Mean change of the output from step to step, in counts'],
    ];
}

function inDecibels(factor) {
    return `${(20 * Math.log10(factor)).toFixed(1)} dB`;
}

export function marginFigures(s, margins) {
    const { gainMargin, lowerGainMargin, delayMargin, stable, crossover } = margins;
    return [
        ['Loop', stable ? 'stable' : 'unstable'],
        ['Crossover', !stable || crossover === null ? '–' : `${digits(crossover * s.RATE)} rad/s`],
        ['Dead time margin', !stable || delayMargin === null ? '–' : time(delayMargin)],
        ['Gain margin', !stable || gainMargin === null ? '–' : `${digits(gainMargin)} (${inDecibels(gainMargin)})`],
        ...(stable && lowerGainMargin !== null
            ? [['and down to', `${digits(lowerGainMargin)} (${inDecibels(lowerGainMargin)})`]] : []),
    ];
}

// --- Rules ------------------------------------------------------------------

// Takes a row's gains; onUse gets the row. The row to begin with says so.
function useButton(row, rows, onUse) {
    const use = make('button', { type: 'button', textContent: 'Use', 'aria-label': `Use ${ruleName(row)}` });
    use.addEventListener('click', () => onUse(row));
    return row === firstRow(rows) ? make('span', { className: 'first' }, make('small', { textContent: 'take this first ' }), use) : use;
}

function gainsOf({ KP, KI, KD }) {
    return [digits(KP), digits(KI), digits(KD)];
}

// `rows` are { rule, robustness, gains or null, found: the run's figures, margins }.
export function fillRules(place, rows, isChosen, onUse) {
    const cellsOf = (row) => {
        const { gains, found, margins } = row;
        return gains === null ? [ruleName(row), ...new Array(9).fill('–')]
            : [ruleName(row), useButton(row, rows, onUse), ...gainsOf(gains),
                margins.stable ? margins.ms.toFixed(2) : 'unstable',
                margins.stable && margins.phaseMargin !== null ? `${margins.phaseMargin.toFixed(0)}°` : '–',
                percent(found.overshoot), seconds(found.settled, 'no'), digits(found.meanError)];
    };
    place.replaceChildren(table('Gains and what they do in this scene',
        ['Rule', 'Take it', 'kp', 'ki', 'kd', 'Ms', 'Phase', 'Overshoot', 'Settled', 'Mean error'],
        rows.map((row) => ({ cells: cellsOf(row), chosen: isChosen(row) }))));
}

// The same of a record, whose plant the page does not know.
export function fillRecordRules(place, rows, onUse) {
    place.replaceChildren(table('Gains for the chip, per count; ki per second, kd in seconds',
        ['Rule', 'Take it', 'kp', 'ki', 'kd'],
        rows.map((row) => ({ cells: row.gains === null ? [ruleName(row), ...new Array(4).fill('–')]
            : [ruleName(row), useButton(row, rows, onUse), ...gainsOf(row.gains)] }))));
}

// --- Chips --------------------------------------------------------------------

const TITLES = { [CONTROLLER.AN937]: 'AN937', [CONTROLLER.AN964]: 'AN964' };

// Rows { chip, most, flash, unit, ram, all }: of fixpid_pid with no features, with
// those that are summed up here, or with all.
export function costsOf(s, results) {
    const rows = (title) => COSTS.filter(([name]) => name === title)
        .map(([, chip, most, flash, unit, ram]) => ({ chip, most, flash, unit, ram, all: false }));
    if (s.CONTROLLER !== CONTROLLER.PID) {
        return rows(TITLES[s.CONTROLLER]);
    }
    const features = featuresOf(s, results);
    if (features === 0) {
        return rows('PID, typical');
    }
    return rows('PID').map((row) => {
        const known = FEATURES[row.chip];
        if (!known) {
            return { ...row, all: true };
        }
        const sum = (at) => known.reduce((total, one) => total + (one[0] === 0 || (features & one[0]) !== 0 ? one[at] : 0), 0);
        return { ...row, most: Math.min(row.most, sum(1)), flash: Math.min(row.flash, sum(2)) };
    });
}

// The part of the time at the state's clock, of which a PIC's cycle takes four.
export function shareOf({ chip, most }, s) {
    const clocks = chip.startsWith('PIC') ? 4 : 1;
    return INSTRUCTIONS.test(chip) ? null : most * clocks * s.RATE / (s.CLOCK * 1e6);
}

// Of instructions nobody knows the cycles here.
function shareText(row, s) {
    const share = shareOf(row, s);
    return share === null ? '–' : share < 0.0005 ? '< 0.1 %' : share > 1 ? `${percent(share, 0)}: too slow` : percent(share, share < 0.1 ? 1 : 0);
}

const INSTRUCTIONS = /^(Cortex|RV32)/;

export function fillChips(text, place, s, results) {
    const costs = costsOf(s, results);
    const rows = costs.map((row) => {
        const unit = INSTRUCTIONS.test(row.chip) ? 'instr.' : 'cycles';
        const flash = row.unit === 'bytes' ? '' : ` ${row.unit}`;
        return { cells: [`${row.chip}${row.all ? ' *' : ''}`, `${whole(row.most)} ${unit}`, `${whole(row.flash)}${flash}`,
            `${row.ram}`, whole(row.most * s.RATE), shareText(row, s)] };
    });
    text.replaceChildren(`What a step of ${NOUN[s.CONTROLLER]} takes at most, by the code’s bound; flash of step and init and RAM of one controller in bytes, ` +
        'as docs/cost.md has them.');
    if (s.CONTROLLER === CONTROLLER.PID) {
        text.append(' Built with ', make('code', { textContent: `-DFIXPID_PID_FEATURES=${hex(featuresOf(s, results))}` }),
            ', which is what these settings need.');
    }
    text.append(costs.some((row) => row.all) ? ' * with all features, as single ones were not measured there.' : '');
    place.replaceChildren(table(`At most, at ${short(s.RATE)} steps per second`,
        ['Chip', 'A step', 'Flash', 'RAM', 'A second', 'Of the time'], rows));
}
