// SPDX-License-Identifier: MIT
// The port to a board: opened by a person, asked for the board's record and stream, watched,
// and closed.
import { createAsker } from './ask.js';
import { columnsOfText } from './log.js';
import { openPort } from './port.js';
import { ASK, twinCounts } from './twin.js';

const SILENT = 5000; // milliseconds and three steps without a frame, and the board is asked again
const TEXT_OFFERED = 1 << 16; // characters of a port's text that may be a recording

function noBoardText(error, printable) {
    return printable.length > 8 ? `Bytes come, but not from a board that speaks fixpid_link at this baud rate. They read: ${printable}`
        : `${error.message} Does its program call fixpid_link, and is this its baud rate?`;
}

// The card's begin(asks) makes room for a board, and its gone(sentence) is called when the port
// is. { isOpen, isIdle, connect(baud), disconnect(), watch(): now and then, took(frame),
// ask(command, value): promises the frame that answers, or throws a sentence, fail(error) }
export function createConnection({ say, refresh, begin, gone, offer }, session) {
    let [port, asker, restarting] = [null, null, false];
    let [silentSince, restarts] = [null, 0];

    async function ask(command, value) {
        if (asker === null) {
            throw new Error('');
        }
        return asker.ask(command, value);
    }

    // Of a port that is gone it is said why already.
    const fail = (error) => port !== null && say(error.message);

    // The record first, then the stream, whose first frame is a key frame.
    async function askForStream() {
        await ask(ASK.RECORD);
        await ask(ASK.STREAM, [1]);
    }

    async function start(done = 'Connected.') {
        restarting = true;
        try {
            await ask(ASK.HELLO);
            await askForStream();
            say(done);
            refresh();
        } catch (error) {
            offer(columnsOfText(String.fromCharCode(...session.bytes().subarray(0, TEXT_OFFERED))), 'what came from the port');
            fail(new Error(noBoardText(error, session.printable())));
        }
        restarting = false;
    }

    // What a board has done meanwhile: it speaks again, or it began anew.
    function hear() {
        if (silentSince !== null && session.lastFrame > silentSince) {
            silentSince = null;
            say('The board speaks again.');
        }
        if (session.trace.restarts > restarts) {
            say('The board began anew: its setpoint and its gains are its program’s again.');
        }
        ({ restarts } = session.trace);
    }

    // What the twin lacks is asked for again; so is a board that has fallen silent.
    async function watch() {
        hear();
        if (port === null || session.board === null || restarting || !asker.idle) {
            return;
        }
        if (performance.now() - session.lastFrame > SILENT + 3000 * session.seconds) {
            say('The board is silent, and is asked again.');
            silentSince = session.lastFrame = performance.now();
            await start('Connected again: the board had fallen silent.');
        } else if (twinCounts().WANTS_RECORD === 1) {
            await askForStream().catch(() => {}); // it is asked for again when the board is silent
        }
    }

    function leave(sentence) {
        asker.stop('The port is closed.');
        [port, asker] = [null, null];
        gone(sentence);
    }

    async function connect(baud) {
        try {
            const opened = await openPort(baud, { onBytes: session.take, onGone: leave });
            begin(true);
            port = opened;
        } catch (error) {
            say(error.message);
            return;
        }
        asker = createAsker((bytes) => port.write(bytes));
        session.lastFrame = performance.now();
        say('The port is open; the board is asked who it is.');
        refresh();
        await start();
    }

    async function disconnect() {
        const closing = port;
        leave('The port is closed; what came is kept.');
        await closing.close();
    }
    return { ask, fail, watch, connect, disconnect, took: (frame) => asker?.took(frame), get isOpen() { return port !== null; }, get isIdle() { return asker.idle; } };
}
