// SPDX-License-Identifier: MIT
// The C of sim/identify/identify.h: a plant from a recording. What it says of models and
// plants is as in the header.
import { LIMIT } from './built.js';
import { exported } from './engine.js';
import { doubles, room, read, sizeOf, write } from './structs.js';

// The columns of a recording: seconds, what drove the plant, what was measured. `before` is
// the drive with which it stood still until the first line, or null.
export function identify({ t, u, y, before = null }) {
    const lines = t.length;
    const at = room(24 * lines + sizeOf('identify_recording') + sizeOf('identify_result'));
    const columns = [t, u, y].map((values, i) => {
        doubles(at + 8 * i * lines, lines).set(values);
        return at + 8 * i * lines;
    });
    const recording = at + 24 * lines;
    const result = recording + sizeOf('identify_recording');
    write('identify_recording', recording, { lines, t: columns[0], u: columns[1], y: columns[2],
        before: before ?? 0, beforeKnown: before !== null });
    exported().identify(recording, result);
    return read('identify_result', result);
}

// What a model of the last recording measures, at seconds after its first line.
export function identifyCurve(model) {
    const { LINES } = LIMIT; // at most
    const at = room(16 * LINES + sizeOf('identify_model'));
    write('identify_model', at + 16 * LINES, model);
    const count = exported().identify_curve(at + 16 * LINES, at, at + 8 * LINES);
    return { t: doubles(at, count).slice(), y: doubles(at + 8 * LINES, count).slice() };
}

// SIMC's kp, ki and kd, in units and seconds, for a controller that steps each `step` seconds.
export function identifySimc(plant, step, calm) {
    const at = room(24 + sizeOf('identify_plant'));
    write('identify_plant', at + 24, plant);
    exported().identify_simc(at + 24, step, calm, at);
    return [...doubles(at, 3)];
}

// What is said of a recording that is refused for this reason; '' of a usable one.
export function sentenceOf(reason) {
    const bytes = new Uint8Array(exported().memory.buffer, exported().verdict_sentence(reason));
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}
