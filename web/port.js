// SPDX-License-Identifier: MIT
// A serial port of the browser's, opened by a person: bytes in, bytes out, and what goes
// wrong in words.

const PASSING = ['BreakError', 'BufferOverrunError', 'FramingError', 'ParityError'];

export function hasSerial() {
    return 'serial' in navigator;
}

// Promises { write(bytes), close() }, or throws a sentence. onBytes(bytes) gets what comes,
// and onGone(sentence) is called once, if the port ends by itself.
export async function openPort(baudRate, { onBytes, onGone }) {
    let port;
    try {
        port = await navigator.serial.requestPort();
    } catch (error) {
        throw new Error(error.name === 'NotFoundError' ? 'No port was chosen.' : `The browser gives no port: ${error.message}.`);
    }
    try {
        await port.open({ baudRate });
    } catch (error) {
        throw new Error(`The port cannot be opened: ${error.message.replace(/\.$/, '')}. Does another program have it, such as an IDE’s monitor?`);
    }
    let [open, reader] = [true, null];
    const writer = port.writable.getWriter();

    function gone(sentence) {
        if (open) {
            open = false;
            onGone(sentence);
        }
    }

    // After an error that passes the port has another stream.
    async function read() {
        while (open && port.readable) {
            reader = port.readable.getReader();
            try {
                for (let part = await reader.read(); !part.done; part = await reader.read()) {
                    onBytes(part.value);
                }
                if (open) {
                    gone('The port was closed.');
                }
            } catch (error) {
                if (!PASSING.includes(error.name)) {
                    gone(`The port is gone: ${error.message.replace(/\.$/, '')}. Is the cable still in?`);
                }
            } finally {
                reader.releaseLock();
            }
        }
        gone('The port is gone. Is the cable still in?');
    }
    const reading = read();

    function write(bytes) {
        writer.write(bytes).catch((error) => gone(`The port accepts no more bytes: ${error.message.replace(/\.$/, '')}.`));
    }

    async function close() {
        open = false;
        const quietly = (act) => act().catch(() => {}); // what is gone cannot be closed
        await quietly(() => reader.cancel());
        await reading;
        await quietly(() => writer.close());
        await quietly(() => port.close());
    }

    return { write, close };
}
