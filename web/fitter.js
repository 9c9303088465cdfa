// SPDX-License-Identifier: MIT
// Fits are made by a worker, so that the page is never held: its script is the page's own, as a blob
// that needs no other file. Where a browser has none the page makes them itself.
import { find } from './dom.js';
import { startEngine } from './engine.js';
import { fitOf, recordingOf } from './models.js';

// A job is { text, choices } of a recording, or { lines, before } of columns.
const doneOf = ({ text, choices, lines, before }) => (text === undefined ? fitOf(lines, before) : recordingOf(text, choices));

// What the worker does.
export function serveFits() {
    const started = startEngine();
    self.onmessage = async ({ data: { id, job } }) => {
        await started;
        self.postMessage({ id, found: doneOf(job) });
    };
}

let workerAddress = null;

function makeWorker() {
    workerAddress ??= URL.createObjectURL(new Blob(['"use strict";', find('#code').textContent], { type: 'text/javascript' }));
    return new Worker(workerAddress);
}

// { ask(job), stop(), works() }: `onFound` gets what was found for what was asked last.
export function createFitter(onFound) {
    let [worker, broken, asked, waiting] = [null, false, 0, null];

    function answer(id, found) {
        if (id === asked) {
            waiting = null;
            onFound(found);
        }
    }

    function here() {
        const id = asked;
        setTimeout(() => waiting !== null && answer(id, doneOf(waiting)), 0);
    }

    function fail(event) {
        event?.preventDefault?.();
        [worker, broken] = [null, true];
        here();
    }

    // What is not needed any more.
    function stop() {
        asked += 1;
        if (waiting !== null && worker !== null) {
            worker.terminate();
            worker = null;
        }
        waiting = null;
    }

    function ask(job) {
        stop();
        waiting = job;
        try {
            if (!broken && worker === null) {
                worker = makeWorker();
                worker.onmessage = ({ data }) => answer(data.id, data.found);
                worker.onerror = fail;
            }
        } catch {
            broken = true;
        }
        if (broken) {
            here();
        } else {
            worker.postMessage({ id: asked, job });
        }
    }

    return { ask, stop, works: () => (broken ? 'page' : 'worker') };
}
