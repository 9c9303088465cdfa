// SPDX-License-Identifier: MIT
// What a person has a board do: its setpoint, and this page's gains, which are shown beside
// its own, sent, compared with the record that comes back, and taken back.
import { ALLOWED } from './built.js';
import { commandRefusal, int16Bytes } from './ask.js';
import { setText, table } from './dom.js';
import { short } from './format.js';
import { createComparison } from './predicted.js';
import { settingsOf } from './session.js';
import { ASK, LINK_VERSION, boardConfig, recordBytes } from './twin.js';

const NO_RECORD = 'The board’s record has not come yet.';
const SETS_KEPT = 10; // gains that can be gone back to
const GAINS = [['KP', 'kp_q8'], ['KI', 'ki_q24'], ['KD', 'kd_q8'], ['FILTER', 'derivative_filter']];

const sameBytes = (a, b) => a.length === b.length && a.every((one, i) => one === b[i]);

// Why the page's gains are none for a board, or null.
function unfitText(page, seconds) {
    return page === null ? 'The page’s controller refuses its gains, or is not a fixpid_pid.'
        : Math.abs(page.RATE * seconds - 1) > 1e-3 ? `The page’s loop makes ${short(page.RATE)} steps per second and the board ${short(1 / seconds)}: take the board’s settings first.` : null;
}

// { begin(), show(), may(bit), tell(command, value, done), setSetpoint(value), confirm(), send(),
// revert(), hasConfig(), sets: gains that were there before, told(): see predicted.js, or null }
export function createCommands({ own, say, refresh }, session, connection, { gains, scene }) {
    let [sets, comparison] = [[], null];

    function begin() {
        [sets, comparison] = [[], null];
    }

    const may = (bit) => connection.isOpen && session.board?.version === LINK_VERSION && (session.board.allowed & bit) !== 0;

    function show() {
        own('commands').hidden = !connection.isOpen || session.board === null;
        own('send').disabled = !may(ALLOWED.GAINS);
        own('revert').disabled = !may(ALLOWED.GAINS) || sets.length === 0;
        setText(own('revert'), sets.length > 1 ? `Revert (${sets.length} sets are kept)` : 'Revert');
        own('confirm').hidden ||= !may(ALLOWED.GAINS); // it waits for a person, whatever the board does
        own('use').disabled = session.board?.version !== LINK_VERSION;
    }

    // Says what came of it; true if it is done.
    async function tell(command, value, done, judge = commandRefusal) {
        try {
            const why = judge(await connection.ask(command, value));
            say(why || done);
            return why === '';
        } catch (error) {
            connection.fail(error);
            return false;
        }
    }

    async function setSetpoint(value) {
        if (Number.isInteger(value) && Math.abs(value) <= 32767) {
            await tell(ASK.SETPOINT, int16Bytes(value), `The setpoint is ${value}.`);
        } else {
            say('A setpoint is a whole number of counts.');
        }
    }

    // While the record is asked for again, the twin has none.
    function hasConfig() {
        const has = boardConfig() !== null;
        if (!has) {
            say(NO_RECORD);
        }
        return has;
    }

    // Old and new beside each other, and a button that sends them.
    function confirm() {
        const [page, old] = [gains(), boardConfig()];
        const wrong = old !== null ? unfitText(page, session.seconds) : NO_RECORD;
        if (wrong !== null) {
            say(wrong);
            return;
        }
        const bold = page.KP > 2 * old.KP;
        own('compare').replaceChildren(table('The integers of both', ['Gain', 'Board', 'Page'], GAINS.map(([name, field]) => ({ cells: [field, String(old[name] >>> 0), String(page[name])] }))));
        own('bold').closest('label').hidden = !bold;
        own('bold').checked = false;
        own('sure').disabled = bold;
        own('confirm').hidden = false;
        own('sure').focus();
    }

    // Only an answer and an equal record are good.
    const write = async (record, done) => await tell(ASK.WRITE, [...record], 'The board has taken them; its record is asked for.') &&
        tell(ASK.RECORD, undefined, done, ({ record: now }) => (sameBytes(now, record) ? '' : 'The board’s record is not what was sent: another program has changed it.'));

    // What comes from now on is compared with what the page foretells of these gains.
    function changed(setsNow) {
        sets = setsNow.slice(-SETS_KEPT);
        own('told').hidden = true;
        comparison = boardConfig() === null ? null : createComparison(session.trace, { ...scene(), ...settingsOf(session) });
    }

    async function send() {
        const page = gains();
        own('confirm').hidden = true;
        if (!hasConfig()) {
            return;
        }
        const [before, record] = [boardConfig(), page].map(recordBytes);
        if (await write(record, 'Sent: the board runs with them, and its record is equal in all bytes. It forgets them at power-off, unless its program keeps the record.')) {
            changed([...sets, before]);
        }
        refresh();
    }

    async function revert() {
        if (await write(sets.at(-1), 'The board has its former gains again.')) {
            changed(sets.slice(0, -1));
        }
        refresh();
    }
    return { begin, show, may, tell, setSetpoint, hasConfig, confirm, send, revert, told: () => comparison?.now() ?? null, get sets() { return sets; } };
}
