// SPDX-License-Identifier: MIT
// What the page prints in C, under four compilers: the header, each rule's gains in it, guards
// and tables of sensors; and the costs that it states.
import { spawnSync } from 'node:child_process';
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { check, checkNone, finish, moduleOf, random, WORK } from './harness.mjs';

const { experiment, run, startEngine } = await moduleOf('engine');
const { PRESETS, presetState, ofLink } = await moduleOf('state');
const { wholeHeaderOf: headerOf } = await moduleOf('header');
const { guardOf, guardText } = await moduleOf('guard');
const { tableOf, tableText } = await moduleOf('sensor');
const { gainsOfRule } = await moduleOf('rules');
const { costsOf } = await moduleOf('cards');
await startEngine();

const COMPILERS = [['gcc', '-std=c99', '-x', 'c'], ['clang', '-std=c99', '-x', 'c'], ['g++', '-std=c++98', '-x', 'c++'],
    ['g++', '-std=c++17', '-x', 'c++'], ['avr-g++', '-mmcu=atmega328p', '-Os', '-x', 'c++']];
const FOLDER = `${WORK}/printed`;
mkdirSync(FOLDER, { recursive: true });

function command(name, ...more) {
    const ran = spawnSync(name, more, { encoding: 'utf8' });
    return ran.status === 0 ? ran.stdout : `${name}: ${ran.stderr || ran.error || ran.status}`;
}

// A constant configuration folds: on the AVR the whole program is `return 0`, which its code
// shows, as there is nothing to run it on here.
const returnsZero = (object) => /<main>:\s+\S+:\s+80 e0\s+ldi\s+r24, 0x00[^\n]*\n\s+\S+:\s+90 e0\s+ldi\s+r25, 0x00[^\n]*\n\s+\S+:\s+08 95\s+ret/.test(command('avr-objdump', '-d', object));

// What is wrong with `text`, where `conditions(isAvr)`, expressions of C, all hold. `library`
// is a module that they call, which is only compiled for the AVR.
function faultsOf(name, text, conditions, library = null) {
    const object = `${FOLDER}/library.o`;
    if (library !== null) {
        const sources = readdirSync(`src/${library}`).filter((file) => /^fixpid_.*(?<!_pic1[48])\.c$/.test(file)).map((file) => `src/${library}/${file}`);
        command('gcc', '-std=c99', '-Iinclude', '-DFIXPID_NO_ASSEMBLY', '-r', ...sources, '-o', object);
    }
    return COMPILERS.flatMap(([compiler, ...options]) => {
        const avr = compiler === 'avr-g++';
        writeFileSync(`${FOLDER}/use.txt`, `${text}\nint main(void) {\n    int good = 1;\n${conditions(avr).map((one) => `    good &= (${one});\n`).join('')}    return good ? 0 : 1;\n}\n`);
        const said = command(compiler, ...options, '-O2', '-Wall', '-Wextra', '-Werror', '-Iinclude', ...(avr ? ['-c'] : library ? ['-DFIXPID_NO_ASSEMBLY'] : []),
            `${FOLDER}/use.txt`, ...(library && !avr ? ['-x', 'none', object] : []), '-o', `${FOLDER}/use`);
        if (said !== '') {
            return [`${name}, ${compiler}: ${said}`];
        }
        const good = avr ? library !== null || returnsZero(`${FOLDER}/use`) : spawnSync(`${FOLDER}/use`).status === 0;
        return good ? [] : [`${name}, ${compiler}: other integers`];
    });
}

// --- Headers ------------------------------------------------------------------------
const NOUNS = ['fixpid_pid', 'fixpid_an937', 'fixpid_an964'];
const MEMBERS = {
    fixpid_pid: ['gains.kp_q8', 'gains.ki_q24', 'gains.kd_q8', 'gains.derivative_filter', 'output_min', 'output_max', 'integral_min', 'integral_max',
        'setpoint_weight_q8', 'reverse', 'derivative_on_error', 'proportional_on_measurement'],
    fixpid_an937: ['kp_q4', 'ki_q4', 'kd_q4', 'accumulated_error_limit', 'derivative_period_ticks'],
    fixpid_an964: ['kp', 'ki', 'kd'],
};
const TYPES = { fixpid_pid: 'fixpid_pid_config', fixpid_an937: 'fixpid_an937_config', fixpid_an964: 'fixpid_an964_gains' };

// The header of a state: its members are the run's integers, its macro of gains folds to them,
// and its counts are the sensor's.
function headerFaults(state, scaleOf = (scale) => scale) {
    const { results: r } = run(state);
    const header = headerOf(state, r);
    const noun = NOUNS[state.CONTROLLER];
    const wanted = [[r.KP, r.KI, r.KD, r.FILTER, state.OUTPUT_MIN, state.OUTPUT_MAX, state.INTEGRAL_MIN, state.INTEGRAL_MAX, r.WEIGHT,
        ...[0x80, 0x40, 0x20].map((bit) => Number((r.OPTIONS & bit) !== 0))], [r.KP, r.KI, r.KD, state.INTEGRAL_MAX, r.FILTER], [r.KP, r.KI, r.KD]][state.CONTROLLER];
    const counts = [0, 0.123, 0.5, 0.77, 1].map((part) => state.SENSOR_LOW + Number((part * state.SENSOR_RANGE).toPrecision(4)))
        .map((x) => [`LOOP_COUNTS(${x})`, Math.floor((x - state.SENSOR_LOW) / state.SENSOR_RANGE * (2 ** state.SENSOR_BITS - 1) + 0.5)]);
    const macro = header.match(/FIXPID_PID_GAINS\([^)]*\)/)?.[0];
    const text = `${header}\nstatic const struct ${TYPES[noun]} config = LOOP_CONFIG;\n${macro ? `#ifndef __AVR__\nstatic const struct fixpid_pid_gains folded = ${macro};\n#endif\n` : ''}`;
    // Where double has 32 bits the macro may fold to a neighbour.
    return faultsOf(state.preset, text, (avr) => [...MEMBERS[noun].map((member, i) => `config.${member} == ${wanted[i]}`),
        ...(avr ? [] : scaleOf([...counts, ['LOOP_RATE', state.RATE]]).map(([one, value]) => `${one} == ${value}`)),
        ...(macro && !avr ? ['kp_q8', 'ki_q24', 'kd_q8', 'derivative_filter'].map((name) => `folded.${name} == config.gains.${name}`) : [])]);
}

for (const preset of PRESETS) {
    checkNone(`header of ${preset.preset}: ${COMPILERS.length} compilers`, headerFaults(preset));
}
const draw = random(7);
checkNone('headers of random settings', ['°C', 'a*/b\\', '', '??/'].flatMap((unit, i) => headerFaults({ ...PRESETS[1], KP: 0.1 + 3 * draw(), KI: 0.1 + draw(), KD: 0.1 + draw(),
    WEIGHT: 0.1 + 0.9 * draw(), RATE: 7 + i, OPTIONS: i % 3 === 0 ? 0x80 : 0, unit })));
// A setpoint beyond the sensor is no constant of the firmware.
const beyond = ['LOOP_COUNTS(500)', 'LOOP_COUNTS(-1)'].map((one) => headerFaults(PRESETS[0], () => [[one, 0]]));
check('LOOP_COUNTS beyond the sensor compiles nowhere', beyond.every((faults) => faults.length === 4 && !faults.some((fault) => fault.includes('other integers'))), `${beyond}`);

// Two loops in one firmware have a header each: with names of their own both hold; of one name
// two that differ do not compile, and a second copy of the same does no harm.
const named = (kp, loop) => ({ ...PRESETS[1], KP: kp, loop });
const headersOf = (...states) => states.map((s) => headerOf(s, run(s).results)).join('\n');
checkNone('two named headers in one file', faultsOf('two loops', `${headersOf(named(1, 'bed'), named(2, 'Nozzle'), named(1, 'bed'))}
static const struct fixpid_pid_config bed = LOOP_BED_CONFIG, nozzle = LOOP_NOZZLE_CONFIG;`,
() => ['bed.gains.kp_q8 == 256', 'nozzle.gains.kp_q8 == 512', 'LOOP_BED_RATE == LOOP_NOZZLE_RATE']));
for (const [loop, said] of [['', 'two headers of gains without a name differ: give each loop a name'], ['bed', 'two headers of gains for the loop bed differ']]) {
    const faults = faultsOf('two loops', headersOf(named(1, loop), named(2, loop)), () => []);
    check(`two headers ${loop ? 'of one name' : 'without a name'} that differ compile nowhere`, faults.length === COMPILERS.length && faults.every((one) => one.includes(said)), `${faults}`);
}

// Each rule's gains fold to the very integers that the autotuner gave. A motor without dead
// time swings too fast for it, and it says so.
for (const preset of PRESETS.filter((one) => one.CONTROLLER === 0 && one.preset !== 'spring')) {
    const { results: { STATUS }, rules } = experiment(preset);
    const had = rules.filter(({ has }) => has);
    const [status, has] = preset.preset === 'motor' ? [6, 0] : [2, 6];
    check(`autotune of ${preset.preset}: status ${STATUS}, ${had.length} of 6 gains`, STATUS === status && had.length === has, `not status ${status} and ${has}`);
    checkNone(`rules of ${preset.preset} keep their integers`, had.filter(({ results }) => {
        const again = run({ ...preset, ...gainsOfRule(preset, results) }).results;
        return ['KP', 'KI', 'KD', 'FILTER'].some((name) => again[name] !== results[name]);
    }).map(({ rule }) => rule));
}

// --- Guards and tables ---------------------------------------------------------------
// Each with the error in counts that the package found, with a sensor in Python's own arithmetic.
const NTC = { kind: 'ntc', r25: 10, beta: 3950, series: 10, supply: true, bits: 10, low: 0, high: 150, scale: 100, points: 16 };
const K = { kind: 'k', microvolts: 2, low: 0, high: 1372, scale: 10, points: 16 };
const sensors = [[NTC, 14.644642746], [{ ...NTC, points: 24 }, 6.273444198], [{ ...NTC, bits: 12, scale: 10 }, 1.820264251],
    [{ ...NTC, supply: false, low: -20, high: 100 }, 8.329641003], [{ ...NTC, r25: 100, beta: 4190, series: 4.7, high: 250, points: 12 }, 56.221092951],
    [K, 1.734641486], [{ ...K, low: -200 }, 4.101252475], [{ ...K, microvolts: 10, points: 8 }, 5.843254019]];

for (const id of ['oven', 'axis']) {
    const s = presetState(id);
    const { results } = experiment(s);
    const config = guardOf(results, { outputMin: s.OUTPUT_MIN, outputMax: s.OUTPUT_MAX, reverse: id === 'axis', top: 4095, rest: 0, setpoint: null });
    const model = [results.SLOPE, results.DEAD, results.NOISE, results.GAIN].map((number) => `${number}u`);
    const text = `${guardText(config)}\nstatic struct fixpid_guard guard;\nstatic struct fixpid_guard_config found;\n` +
        `static const struct fixpid_guard_model model = {${model}, 0, 0};`;
    checkNone(`the library takes a guard of ${id}, and would choose it`, faultsOf('guard', text, () => ['fixpid_guard_init(&guard, &guard_config)',
        '(found = guard_config, found.band = 0, fixpid_guard_from_model(&found, &model))', 'found.band == guard_config.band',
        'found.patience == guard_config.patience', 'found.noisy == guard_config.noisy'], 'guard'));
}
for (const [i, [sensor, error]] of sensors.entries()) {
    const table = tableOf(sensor);
    const printed = tableText(table, 'sensor', sensor.scale);
    check(`table ${i + 1}, ${sensor.kind}: within ${(table.error / sensor.scale).toFixed(4)} degrees`, Math.abs(table.error - error) < 1e-6 * error, `Python: ${error} counts, and here ${table.error}`);
    checkNone(`table ${i + 1} in C`, [...printed.split('\n').filter((line) => line.length > 52), ...faultsOf('table', printed, () => [`sensor.count == ${sensor.points}`,
        ...table.points.flatMap(([x, y], k) => [`fixpid_table_at(&sensor, ${x}) == ${y}`, `sensor.points[${k}].x == ${x}`, `sensor.points[${k}].y == ${y}`])], 'table')]);
}

// --- Costs ----------------------------------------------------------------------
// The card's figures are those of docs/data: of one noun on each chip, and with a feature for
// each chip that has prices.
function documented(name) {
    return readFileSync(`docs/data/${name}.csv`, 'utf8').trim().split('\n')
        .map((line) => line.match(/"[^"]*"|[^,]+/g).map((cell) => cell.replaceAll('"', '')));
}

const [titles, ...steps] = documented('cost_steps');
const features = documented('features');

function costOf(noun, chip) {
    const row = steps.find((one) => one[0] === noun && one[1] === chip && ['object', '-O2'].includes(one[2]));
    return ['bound', 'with init', 'RAM each'].map((title) => Number(row?.[titles.indexOf(title)]));
}

function withFilter(chip) {
    const at = features[0].findIndex((title) => title.startsWith(chip));
    const sum = (column) => Number(features[1][column]) + Number(features[2][column]);
    return at < 0 ? costOf('PID', chip) : [sum(at), sum(at + 1), costOf('PID', chip)[2]];
}

for (const [link, wanted] of [['p=an937', (chip) => costOf('AN937', chip)], ['p=an964', (chip) => costOf('AN964', chip)],
    ['p=flow&filter=0', (chip) => costOf('PID, typical', chip)], ['p=flow&filter=3', withFilter]]) {
    const rows = costsOf(ofLink(link), run(ofLink(link)).results);
    checkNone(`${link}: costs on ${rows.length} chips`, rows.length < 7 ? ['too few'] : rows.filter(({ chip, most, flash, ram }) => [most, flash, ram].join() !== wanted(chip).join())
        .map(({ chip, ...costs }) => `${chip}: ${Object.values(costs)}, not ${wanted(chip)}`));
}
await finish();
