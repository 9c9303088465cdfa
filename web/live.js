// SPDX-License-Identifier: MIT
// The card of a board that is connected, or of a log of one: its parts, its buttons, the logs
// that it reads and what it saves.
import { boardText, createBoardView } from './boardview.js';
import { createBoardStep } from './boardstep.js';
import { createCommands } from './commands.js';
import { createConnection } from './connection.js';
import { listenForFiles, setText } from './dom.js';
import { readNumber } from './fields.js';
import { whole } from './format.js';
import { documentOf, helpFor } from './help.js';
import { bytesOfFile, bytesOfText, csvOfTrace, jsonOfSession } from './log.js';
import { hasSerial } from './port.js';
import { createSession, hardwareOf } from './session.js';
import { FRAME, boardConfig, twinCounts } from './twin.js';

const REDRAW = 100; // milliseconds
const LOG_SLICE = 1 << 17; // bytes of a log at once

// Reads one log after another: a function of what log.js gives, and of its name. A log that is
// still read is left when another begins, or when `leave` of it is called.
function createLogReader({ say, offer, begin, refresh }, session, connection, view) {
    let last = 0;

    async function read({ bytes, refused, columns = null }, name) {
        if (refused !== undefined) {
            say(refused);
            offer(columns, name);
            return;
        }
        if (connection.isOpen) {
            await connection.disconnect();
        }
        begin(false);
        last += 1;
        const mine = last;
        for (let at = 0; at < bytes.length && mine === last; at += LOG_SLICE) {
            session.take(bytes.subarray(at, at + LOG_SLICE));
            view.draw();
            await new Promise((go) => {
                setTimeout(go, 0);
            });
        }
        if (mine !== last) {
            return;
        }
        // A frame ends with a 0: so does the last one of a log that was cut there.
        session.take(Uint8Array.of(0));
        view.draw(true);
        refresh();
        const { count } = session.trace;
        offer(count === 0 ? columns : null, name);
        say(count === 0 ? `${name}: no frame of fixpid_link is in these ${whole(bytes.length)} bytes.` : `${name}: ${whole(count)} steps in ${whole(bytes.length)} bytes.`);
    }
    return Object.assign(read, { leave: () => { last += 1; } });
}

function dress(own) {
    for (const id of ['baud', 'setpoint', 'step', 'length']) {
        const label = own(id).closest('label');
        label.after(helpFor(label.firstChild.textContent.trim()));
    }
    own('docs').href = documentOf('link#a-live-link', location);
    own('connect').disabled = !hasSerial();
    own('none').hidden = hasSerial();
}

function listenForClicks({ own, handOver }, { session, connection, commands, step, read }, { onPlant, download }) {
    const acts = {
        connect: () => {
            read.leave();
            return connection.connect(Number(own('baud').value));
        },
        disconnect: connection.disconnect, open: () => own('file').click(), read: () => read(bytesOfText(own('log').value), 'The log'),
        set: () => commands.setSetpoint(readNumber(own('setpoint').value).value), send: commands.confirm, sure: commands.send, revert: commands.revert,
        record: () => step.record(false), hand: () => step.record(true), stop: () => step.goOn(true), 'fit-use': step.useFit,
        use: () => commands.hasConfig() && onPlant(hardwareOf(session), null),
        csv: () => download('board.csv', csvOfTrace(session.allSteps(), session.seconds), 'text/csv'),
        json: () => download('board.json', jsonOfSession({ board: session.board, config: boardConfig(), counts: twinCounts(), sent: commands.sets.map((one) => [...one]), bytes: session.bytes(), whole: session.whole }), 'application/json'),
        not: () => {
            own('confirm').hidden = true;
            own('send').focus();
        },
        'hand-over': handOver,
    };
    for (const [id, act] of Object.entries(acts)) {
        own(id).addEventListener('click', () => act());
    }
    own('bold').addEventListener('change', () => {
        own('sure').disabled = !own('bold').checked;
    });
}

// Fills the card. `gains()` of `page` gives its integers and its rate, or null, and `scene()`
// its state; onPlant(hardware, plant) takes both; onStep(hardware, text, name) takes a
// recording as lines, onText(text, name) one of any program; `download(name, text, type)`.
export function createLive(section, page) {
    const own = (id) => section.querySelector(`#live-${id}`);
    const say = (text) => setText(own('said'), text);
    const card = { own, say, offer, handOver, begin, refresh, gone }; // what its parts know of it
    let other = null; // { text, name } of lines of numbers
    const session = createSession((frame) => {
        if (frame.kind === FRAME.HELLO) {
            setText(own('board'), boardText(frame));
        }
        connection.took(frame);
    });
    const connection = createConnection(card, session);
    const commands = createCommands(card, session, connection, page);
    const step = createBoardStep(card, session, connection, commands, page);
    const view = createBoardView(card, session, commands.told);
    const read = createLogReader(card, session, connection, view);

    // Lines of numbers are for the card of recordings; null: there are none.
    function offer(text, name) {
        other = text === null ? null : { text, name };
        own('other').hidden = other === null;
    }

    function handOver() {
        page.onText(other.text, other.name);
        offer(null);
    }

    function begin(asks) {
        [session, view, commands, step].forEach((part) => part.begin(asks));
        offer(null);
        refresh();
    }

    // What can be done now.
    function refresh() {
        own('connect').hidden = connection.isOpen;
        own('disconnect').hidden = !connection.isOpen;
        own('baud').disabled = connection.isOpen;
        commands.show();
        step.show();
    }

    function gone(sentence) {
        step.drop();
        say(sentence);
        refresh();
        view.draw(true);
    }
    dress(own);
    listenForFiles(section, own('file'), { onFile: async (file) => read(bytesOfFile(new Uint8Array(await file.arrayBuffer())), file.name),
        onText: (text) => read(bytesOfText(text), 'The log') });
    listenForClicks(card, { session, connection, commands, step, read }, page);
    begin(false);
    setInterval(() => [view.draw(), step.goOn(), connection.watch()], REDRAW);
    return { draw: () => view.draw(true) };
}
