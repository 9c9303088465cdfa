// SPDX-License-Identifier: MIT
// The page's sim/identify on the recordings of test/support/recordings: the same bits as
// Python's, whose test judges them, and how long the slowest takes.
import { readFileSync } from 'node:fs';
import { check, checkNone, finish, moduleOf } from './harness.mjs';

const { startEngine } = await moduleOf('engine');
const { identify } = await moduleOf('identify');
const { FIT_REASON } = await moduleOf('built');
await startEngine();

const FOLDER = 'test/support/recordings/';
const MOST_S = 0.7; // of CPU
const linesOf = (path) => readFileSync(path, 'utf8').trim().split('\n');
const beforeOf = new Map(linesOf(`${FOLDER}expected.csv`).map((line) => line.split(',')).map(([file, before]) => [file, before === '' ? null : Number(before)]));

// The least of three: the machine may be busy.
function secondsOf(call) {
    return Math.min(...[1, 2, 3].map(() => {
        const from = process.cpuUsage();
        call();
        return process.cpuUsage(from).user / 1e6;
    }));
}

let slowest = 0;
function foundIn(file) {
    const rows = linesOf(FOLDER + file).slice(1).map((line) => line.split(',').map(Number));
    const [t, u, y] = [0, 1, 2].map((k) => rows.map((row) => row[k]));
    const recording = { t, u, y, before: beforeOf.get(file) };
    const result = identify(recording);
    slowest = Math.max(slowest, secondsOf(() => identify(recording)));
    const { plant: p, calm } = result.models[result.chosen];
    const reason = Object.entries(FIT_REASON).find(([, value]) => value === result.reason)[0].toLowerCase();
    return [reason, ...[p.kind, p.gain, p.lag, p.lag2, p.damping, p.dead, calm].map(String)];
}

const native = linesOf(process.argv[2]).map((line) => line.match(/^ok (\S+\.csv): (.*)$/)?.slice(1)).filter(Boolean);
for (const [file, text] of native) {
    const [reason, ...numbers] = text.split(' ');
    const expected = [reason, ...numbers.map((number) => String(Number(number)))];
    checkNone(`${file} in Python and in the page`, foundIn(file).filter((value, i) => value !== expected[i]));
}
check(`the slowest of ${native.length} takes ${slowest.toFixed(2)} s of CPU`, native.length === 30 && slowest <= MOST_S);
finish();
