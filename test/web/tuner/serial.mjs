// SPDX-License-Identifier: MIT
// What the tests of the live card share: a page with a serial port of the test's own, a wire
// that spoils bytes, and what the card says.
import { open, text } from './harness.mjs';

// One of a hundred bytes is lost, has a wrong bit or is doubled.
export function spoiled(bytes, draw) {
    const damaged = [() => [], (byte) => [byte ^ (1 << Math.floor(8 * draw()))], (byte) => [byte, byte]];
    return Uint8Array.from([...bytes].flatMap((byte) => (draw() < 0.01 ? damaged[Math.floor(3 * draw())](byte) : [byte])));
}

// In the page: a port as Web Serial has it, whose bytes go through the test.
function fakeSerial() {
    const takes = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    let source = null;
    window.port = {
        give: (base64) => source.enqueue(takes(base64)),
        end: (message) => source.error(new DOMException(message, 'NetworkError')),
    };
    const port = {
        readable: null, writable: null,
        async open({ baudRate }) {
            if (window.refused) {
                throw new DOMException('Failed to open serial port.', 'NetworkError');
            }
            window.baud = baudRate;
            port.readable = new ReadableStream({ start(controller) { source = controller; }, cancel() { port.readable = null; } });
            port.writable = new WritableStream({ write: (bytes) => window.toBoard([...bytes]) });
        },
        async close() { window.portClosed = true; },
    };
    Object.defineProperty(navigator, 'serial', { value: {
        async requestPort() {
            if (window.noPort) {
                throw new DOMException('No port selected by the user.', 'NotFoundError');
            }
            return port;
        },
    } });
}

// A page with `board` behind its port, which makes `answers` steps when something was sent.
// `spoil(bytes, isToPage)` is what the wire makes of bytes. { here, board, run(steps) }
export async function connect(board, { answers, spoil = (bytes) => bytes, options = {} }) {
    const here = await open('', options, undefined, async (page) => {
        await page.exposeFunction('toBoard', async (bytes) => {
            board.sent.push(bytes);
            board.receive(spoil(Uint8Array.from(bytes), false));
            await run(answers);
        });
        await page.addInitScript(fakeSerial);
    });
    async function run(steps) {
        const bytes = Buffer.from(spoil(await board.run(steps), true)).toString('base64');
        await here.evaluate((base64) => window.port.give(base64), bytes);
    }
    await here.click('#open-live');
    await pressed(here, 'connect', /^Connected\.$/);
    return { here, board, run };
}

export const said = (here, wanted) => here.waitForFunction(([source]) => new RegExp(source).test(document.querySelector('#live-said').textContent), [wanted.source]);
export const verdict = async (here) => {
    await here.waitForTimeout(150); // it is drawn ten times a second
    return text(here, '#live-verdict');
};
export const equalOf = (sentence) => Number((sentence.match(/([\d\u202F]+) steps? equal/) ?? ['', '0'])[1].replaceAll('\u202F', ''));
export const left = (here) => text(here, '#live-left');

// A button of the card, and what it then says.
export async function pressed(here, button, sentence) {
    await here.click(`#live-${button}`);
    await said(here, sentence);
}

export async function setSetpoint(here, value, answer = new RegExp(`^The setpoint is ${value}\\.$`)) {
    await here.fill('#live-setpoint', String(value));
    await pressed(here, 'set', answer);
}
