// SPDX-License-Identifier: MIT
// The card of a board: Chromium with a serial port of the test's own, behind which a board
// runs the loop of docs/link.md with the library's C, as another WebAssembly.
import { readFileSync } from 'node:fs';
import { check, checkNone, finish, frame, moduleOf, open, text, violations, WORK } from './harness.mjs';
import { connect, equalOf, left, pressed, said, setSetpoint, verdict } from './serial.mjs';

const ALL = 15; // SETPOINT, GAINS, LIMITS, MANUAL
const ANSWERS = 4; // steps that the board makes when something was sent

async function loadBoard(allowed = ALL) {
    const { instance: { exports: c } } = await WebAssembly.instantiate(readFileSync(`${WORK}/board.wasm`), {});
    c.board_begin(allowed);
    const memory = (at, n) => new Uint8Array(c.memory.buffer, at, n);
    let waiting = [];
    return {
        kp: c.board_kp, meddle: c.board_meddle, retune: c.board_retune, lie: c.board_lie, setpoint: c.board_setpoint, begin: () => c.board_begin(allowed), sent: [],
        receive: (bytes) => waiting.push(...bytes),
        run(steps) {
            memory(c.board_in(), waiting.length).set(waiting);
            const n = c.board_run(waiting.length, steps);
            waiting = [];
            return memory(c.board_out(), n).slice();
        },
    };
}

// A page with a board behind its port, as serial.mjs has it.
const connected = async (allowed) => connect(await loadBoard(allowed), { answers: ANSWERS });

const state = (here) => here.evaluate(() => window.tuner.currentState());
const EQUAL = /^[\d\u202F]+ steps equal, bit for bit\.$/;

// --- Without a browser ------------------------------------------------------------
const { createComparison, stepFigures } = await moduleOf('predicted');
const { createTrace } = await moduleOf('trace');
const { presetState } = await moduleOf('state');
const { run: runScene, startEngine } = await moduleOf('engine');
const { STEP } = await moduleOf('built');
const { bytesOfFile, bytesOfText } = await moduleOf('log');
const { takeBytes, twinCounts, beginTwin, commandBytes } = await moduleOf('twin');
await startEngine();
{
    check('hexadecimal is read', bytesOfText('0x0b, 09 01;FF').bytes.join() === '11,9,1,255');
    check('what is no digit is named', bytesOfText('0b 0g').refused.includes('“g”'), bytesOfText('0b 0g').refused);
    check('half a byte is refused', bytesOfText('0b0').refused.includes('left over'));
    check('another JSON is refused', bytesOfText('{"a":1}').refused.includes('not a log'));
    check('a file with a 0 in it is bytes', bytesOfFile(Uint8Array.of(49, 0, 50)).bytes.length === 3 && bytesOfFile(Uint8Array.of(49, 50)).bytes.join() === '18');
}
{
    const { createCommands } = await moduleOf('commands');
    const { boardText, verdictOf } = await moduleOf('boardview');
    const board = { version: 1, allowed: ALL, name: 'b', library: '1.0.0', seconds: 0.1, manualSteps: 9 };
    const may = (version) => createCommands({}, { board: { ...board, version } }, { isOpen: true }, {}).may(1);
    const counts = { DIFFERENT: 0, EQUAL: 5, LEFT_THINNED: 0 };
    check('a board of another version is sent nothing', may(1) && !may(2) && boardText({ ...board, version: 2 }).includes('it gets no command'));
    check('nor is it said to be equal', verdictOf(counts, 1).good === true && verdictOf(counts, 2).good === null && verdictOf(counts, 2).text === 'Not compared: the board’s link is version 2.');
}
// What a board sends that is asked for its name, its record and its stream.
async function streamed(steps) {
    const board = await loadBoard();
    const asked = [[0x40, []], [0x41, []], [0x42, [1]]].map(([command, value]) => {
        board.receive(commandBytes(command, value));
        return board.run(1);
    });
    return Uint8Array.from([...asked, board.run(steps)].flatMap((bytes) => [...bytes]));
}
{
    beginTwin(false);
    let one;
    takeBytes(await streamed(1000), (numbers, n) => { one = numbers.slice(0, 10 * n); }, () => {});
    const counts = twinCounts();
    check('the twin has each step', counts.EQUAL === 1000 && counts.LEFT_BEGINNING === 1 && counts.DIFFERENT === 0, JSON.stringify(counts));
    const [output, p, i, d] = [one.at(-6), one.at(-3), one.at(-2), one.at(-1)];
    check('its terms add up to the output', Math.abs(p / 256 + i / 65536 + d / 256 - output) <= 0.51, `${p} ${i} ${d} ${output}`);
}
{
    const figures = stepFigures([0, 60, 130, 96, 104, 101, 100], { from: 0, to: 100, band: 5 });
    check('figures of a step', figures.overshoot === 30 && figures.settled === 3 && figures.iae === 100 + 40 + 30 + 4 + 4 + 1, JSON.stringify(figures));
    const down = stepFigures([100, 40, -20, 0, 9], { from: 100, to: 0, band: 5 });
    check('and of one downward that is not settled', down.overshoot === 20 && down.settled === null && down.iae === 169, JSON.stringify(down));
}
{
    // A "board" that is the page's own plant, with a step from 300 to 400 counts at 2000 and back at 4000.
    const s = { ...presetState('own'), SENSOR_LOW: 0, SENSOR_RANGE: 1023, SETPOINT: 300, NOISE: 0, START: 0, GAIN: 1000, DURATION: 600, events: [{ at: 200, what: 'SETPOINT', a: 400 }, { at: 400, what: 'SETPOINT', a: 300 }] };
    const { n, series } = runScene(s);
    const trace = createTrace(10000);
    const comparison = createComparison(trace, s);
    const size = Object.keys(STEP).length;
    const give = (to) => {
        for (let i = trace.places; i < to; i++) {
            const one = new Int32Array(size);
            [one[STEP.NUMBER], one[STEP.SETPOINT], one[STEP.MEASUREMENT]] = [i, series.SETPOINT[i], series.MEASUREMENT[i]];
            trace.take(one, 1);
        }
        return comparison.now();
    };
    check('before a step nothing is told', give(2000) === null && give(2010) === null && n === 6000);
    const first = give(3999);
    check('what comes is what was predicted', first !== null && first.rested && first.from === 300 && first.to === 400 && first.came.every((one, i) => Math.abs(one - first.predicted[i]) <= 2), JSON.stringify(first && [first.from, first.to, first.came.length]));
    const [a, b] = [first.came, first.predicted].map((y) => stepFigures(y, first));
    check('and so are its figures', a.settled !== null && Math.abs(a.settled / b.settled - 1) < 0.1 && Math.abs(a.iae / b.iae - 1) < 0.05, JSON.stringify([a, b]));
    const kept = give(4005);
    check('a new step does not replace it before it has settled', kept.to === 400 && kept.over && give(6000).to === 300);
}

// --- A good wire --------------------------------------------------------------------
{
    const { here, board, run } = await connected();
    check('the baud rate is the chosen one', await here.evaluate(() => window.baud) === 115200);
    const about = await text(here, '#live-board');
    check('the board is told in words', /^“oven”, fixpid \d+\.\d+\.\d+, 100 steps per second\. Allowed: setpoint: yes, gains: yes, limits: yes, output by hand: for 3\.00 s at a time\.$/.test(about), about);
    for (let i = 0; i < 10; i++) {
        await run(10000);
    }
    const sentence = await verdict(here);
    check(`100 000 steps are equal: ${sentence}`, equalOf(sentence) >= 100000 && EQUAL.test(sentence), sentence);
    check('what is not compared is counted', (await left(here)) === 'Not compared: 1 before the record and the first key frame.', await left(here));
    const legend = await here.locator('#live-plots figcaption').allTextContents();
    check('setpoint, measurement, output and terms are drawn', ['setpoint 300.0', 'measured', 'output', 'P', 'I', 'D'].every((word) => legend.join().includes(word)), legend.join());

    // Commands.
    await setSetpoint(here, 450);
    check('a setpoint is taken', board.setpoint() === 450);
    await setSetpoint(here, 950, /^Refused by the board: the setpoint is outside/);
    check('a refused one changes nothing', board.setpoint() === 450);
    await pressed(here, 'send', /take the board’s settings first/);
    check('gains for another rate are not sent', !(await here.isVisible('#live-confirm')));
    await here.click('#live-use');
    await frame(here);
    const own = await state(here);
    check('the page has the board’s settings', own.KP === 1 && own.RATE === 100 && own.OUTPUT_MAX === 255 && own.unit === 'counts' && (await text(here, '#header')).includes('256u'), JSON.stringify(own));
    await here.fill('#c-kp', '2.5');
    await frame(here);
    await here.click('#live-send');
    const compared = await here.locator('#live-compare tbody tr').first().locator('td').allTextContents();
    check('old and new stand beside each other, and nothing is sent before', compared.join() === '256,640' && board.kp() === 256, compared.join());
    check('a much larger kp is asked about', await here.isDisabled('#live-sure') && await here.isVisible('#live-bold'));
    checkNone('axe-core, with all of the card in view', await violations(here));
    await here.check('#live-bold');
    await pressed(here, 'sure', /^Sent: .* equal in all bytes/);
    check('the board has the page’s gains, and without a step there is nothing to compare', board.kp() === 640 && !(await here.isVisible('#live-told')), `${board.kp()}`);
    await run(2000);
    await pressed(here, 'revert', /^The board has its former gains again\.$/);
    check('and its own again', board.kp() === 256 && await here.isDisabled('#live-revert'));
    await run(2000);
    const after = await verdict(here);
    check('all of it is equal', EQUAL.test(after) && equalOf(after) > 104000, `${after} ${await left(here)}`);

    // A step, and the plant of it.
    await here.fill('#live-step', '-150');
    await here.fill('#live-length', '6');
    await pressed(here, 'record', /^The setpoint is 300; 600 steps are recorded\.$/);
    await run(700);
    await said(here, /^The setpoint is 450 again\.$/);
    await here.waitForSelector('#live-fit', { state: 'visible' });
    const fit = await text(here, '#live-fit-said');
    const [, gain, lag, dead] = fit.match(/^Gain ([\d.]+) counts for a drive of 1, lag ([\d.]+) s, dead time ([\d.]+) s/) ?? [];
    check(`the plant is found: ${fit}`, Math.abs(gain - 4) < 0.2 && Math.abs(lag - 0.64) < 0.04 && dead > 0.06 && dead < 0.11, fit);
    await here.click('#live-fit-use');
    await frame(here);
    const plant = await state(here);
    check('it becomes the page’s plant, with the board’s gains, and is said to be a prediction', Math.abs(plant.GAIN - 4 * 255) < 50 && Math.abs(plant.T1 - 0.64) < 0.04 && plant.KP === 1 &&
        (await text(here, '#said')).includes('prediction'), JSON.stringify(plant));

    // Other gains for it, and whether they do what was predicted.
    await here.fill('#c-kp', '1.2');
    await frame(here);
    await here.click('#live-send');
    await pressed(here, 'sure', /^Sent: .* equal in all bytes/);
    await run(1000);
    await setSetpoint(here, 600);
    await run(1500);
    await here.waitForSelector('#live-told', { state: 'visible' });
    const told = await here.locator('#live-told-figures tr').evaluateAll((rows) => rows.map((row) => [...row.querySelectorAll('th, td')].map((cell) => cell.textContent)));
    const numbers = (row) => told[row].slice(1).map((cell) => Number(cell.match(/^[\d.]+/)?.[0]) * (/ ms$/.test(cell) ? 0.001 : 1));
    const [[over, overCame], [settled, settledCame], [iae, iaeCame]] = [1, 2, 3].map(numbers);
    check(`predicted beside what came: ${told.slice(1).map((row) => row.join(' ')).join('; ')}`,
        Math.abs(over - overCame) < 6 && Math.abs(settled - settledCame) < 1.5 && Math.abs(iae / iaeCame - 1) < 0.15 && iae > 20, JSON.stringify(told));
    check('and for which step', /^The setpoint from 450 to 600, (so far )?[\d.]+ s$/.test(await text(here, '#live-told caption')) && (await text(here, '#live-told-said')) === '', await text(here, '#live-told'));
    checkNone('axe-core, with the comparison', await violations(here));
    await pressed(here, 'revert', /^The board has its former gains again\.$/);
    check('which ends with a revert', !(await here.isVisible('#live-told')));
    await setSetpoint(here, 450);

    // The program changes its gains itself: nobody has to ask.
    const sentBefore = board.sent.length;
    // Each is sent again, behind a 0, until it is answered.
    const asked = () => new Set(board.sent.slice(sentBefore).map((bytes) => `${bytes}`.replace(/^0,/, ''))).size;
    board.retune(300);
    await run(20);
    for (let i = 0; i < 50 && asked() < 2; i++) {
        await here.waitForTimeout(50);
    }
    await run(500);
    const retuned = await verdict(here);
    check('a program that changed its gains is asked for its record', asked() === 2 && EQUAL.test(retuned) && (await left(here)).includes('where the program itself changed the controller'), `${asked()} ${retuned} ${await left(here)}`);
    await here.click('#live-send');
    check('and its gains are the ones beside the page’s', (await here.locator('#live-compare tbody td').first().textContent()) === '300');
    await here.click('#live-not');
    board.retune(256);
    await run(20);
    await here.waitForTimeout(300);
    await run(500);

    // By hand: for the card of recordings.
    await run(1000);
    await here.fill('#live-step', '40');
    await pressed(here, 'hand', /^The output is \d+; 600 steps are recorded\.$/);
    for (let i = 0; i < 16; i++) {
        await run(50);
        await here.waitForTimeout(110);
    }
    await said(here, /automatic again/);
    await here.waitForSelector('#recorder[data-done]:not([data-busy])');
    const hand = await text(here, '#fit');
    check(`a step by hand goes to the card of recordings: ${hand}`, /^Gain (9|10)\d\d counts at full drive, lag 0\.6\d+ s/.test(hand) && !(await here.isDisabled('#use-fit')), hand);
    await run(500);
    const last = await verdict(here);
    check('a hand, too, is equal in each step', !last.includes('Different'), last);

    // What is saved is read again.
    const [json] = await Promise.all([here.waitForEvent('download'), here.click('#live-json')]);
    const saved = readFileSync(await json.path());
    const log = JSON.parse(saved);
    check('the JSON has the board, its gains and the bytes', log.format === 'fixpid live' && log.board.name === 'oven' && log.config.kp === 256 && log.bytes.length > 30000 && log.whole, JSON.stringify({ ...log, bytes: 0 }));
    const [csv] = await Promise.all([here.waitForEvent('download'), here.click('#live-csv')]);
    const rows = readFileSync(await csv.path(), 'utf8').trim().split('\n');
    check('the CSV has each step with its terms', rows[0] === 'time_s,setpoint,measurement,output,p,i,d,flags,compared' && rows.length > 100000 && /^[\d.e-]+(,-?[\d.e-]+){7},equal$/.test(rows.at(-1)), `${rows.length} ${rows.at(-1)}`);
    const before = equalOf(last);
    await here.setInputFiles('#live-file', { name: 'board.json', mimeType: 'application/json', buffer: saved });
    await said(here, /^board\.json: [\d\u202F]+ steps in/);
    const again = await verdict(here);
    check('opened again, it is compared again', equalOf(again) > 0.95 * before && !again.includes('Different'), `${again} of ${before}: ${await left(here)}`);
    check('a log sends nothing', !(await here.isVisible('#live-commands')) && await here.evaluate(() => window.portClosed));
    checkNone('a good wire: no error', here.noted.errors);
    await here.close();
}

// --- Another arithmetic, permissions, and ends --------------------------------------------
{
    const { here, board, run } = await connected();
    await run(3000);
    board.lie(1);
    await run(2000);
    const sentence = await verdict(here);
    check(`a count on the board that is another is said: ${sentence.slice(0, 120)}`, /^Different: in step [\d\u202F]+ the board’s output is -?\d+ with flags \d+, this page’s -?\d+ with flags \d+/.test(sentence), sentence);
    check('and what was not compared since', (await left(here)).includes('after a difference'), await left(here));
    await here.click('#live-use');
    await here.fill('#c-kp', '1.25');
    await frame(here);
    board.meddle(77);
    await here.click('#live-send');
    await here.click('#live-not');
    check('not now is no', !(await here.isVisible('#live-confirm')) && board.kp() === 256);
    await here.click('#live-send');
    await pressed(here, 'sure', /^The board’s record is not what was sent/);
    check('gains that are not in its record are not said to be sent', await here.isDisabled('#live-revert'));
    await here.evaluate(() => window.port.end('The device has been lost.'));
    await said(here, /^The port is gone: The device has been lost\. Is the cable still in\?$/);
    check('a port that vanishes is said, and another may be opened', await here.isVisible('#live-connect') && !(await here.isVisible('#live-commands')));
    check('what came stays', (await text(here, '#live-verdict')).startsWith('Different'));
    await pressed(here, 'connect', /^Connected\.$/);
    check('and it begins anew', equalOf(await verdict(here)) < 100);
    await pressed(here, 'disconnect', /^The port is closed; what came is kept\.$/);
    await here.evaluate(() => { window.refused = true; });
    await pressed(here, 'connect', /^The port cannot be opened: Failed to open serial port\. Does another program/);
    await here.evaluate(() => { window.noPort = true; });
    await pressed(here, 'connect', /^No port was chosen\.$/);
    checkNone('ends: no error', here.noted.errors);
    await here.close();
}
{
    const { here, board, run } = await connected(0);
    check('what is not allowed cannot be pressed', await here.isDisabled('#live-set') && await here.isDisabled('#live-send') && await here.isDisabled('#live-hand'));
    // A program may take its permission back.
    await here.evaluate(() => { document.querySelector('#live-set').disabled = false; document.querySelector('#live-setpoint').disabled = false; });
    await setSetpoint(here, 400, /^Not allowed: .*FIXPID_LINK_SETPOINT\.$/);
    check('the reason is told', board.setpoint() === 300);
    await run(1000);
    board.begin();
    await run(10);
    await said(here, /^Connected again: the board had fallen silent/);
    await run(1000);
    await said(here, /^The board began anew: its setpoint and its gains are its program’s again\.$/);
    // One that is only slow is not said to be silent when its steps come again.
    const { receive } = board;
    board.receive = () => {};
    await said(here, /^The board speaks again\.$/);
    board.receive = receive;
    await said(here, /^Connected again/);
    const sentence = await verdict(here);
    check('a board that began anew is asked again', /^[\d\u202F]+ steps equal/.test(sentence) && equalOf(sentence) > 1900, `${sentence} ${await left(here)}`);
    checkNone('no permission: no error', here.noted.errors);
    await here.close();
}

// --- Without Web Serial: a log ----------------------------------------------------------
{
    const bytes = await streamed(3000);
    const here = await open('', { viewport: { width: 390, height: 844 }, colorScheme: 'dark' }, undefined, (page) => page.addInitScript(() => { delete Navigator.prototype.serial; }));
    check('a board’s part waits for a button', !(await here.isVisible('#live')));
    await here.click('#open-live');
    check('without Web Serial it is said what to do', await here.isDisabled('#live-connect') && (await text(here, '#live-none')).includes('log of the board’s bytes') && await here.isVisible('#live-none'));
    await here.click('#live summary');
    await here.fill('#live-log', [...bytes].map((byte) => byte.toString(16).padStart(2, '0')).join(' '));
    await pressed(here, 'read', /^The log: 3\u202F001 steps in [\d\u202F]+ bytes\.$/);
    check('the board’s settings may be taken of it', !(await here.isDisabled('#live-use')) && !(await here.isVisible('#live-commands')));
    check('a pasted log is compared', (await verdict(here)) === '3\u202F000 steps equal, bit for bit.', await verdict(here));
    checkNone('axe-core, on a phone in the dark', await violations(here));
    await here.evaluate(() => document.querySelector('#live-plots').scrollIntoView());
    await here.waitForTimeout(100);
    check('the small plot of the page does not lie on the board’s', !(await here.isVisible('#mini')));
    check('it does not scroll sideways on a phone', await here.evaluate(() => document.documentElement.scrollWidth) <= 390);
    await here.setInputFiles('#live-file', { name: 'raw.bin', mimeType: 'application/octet-stream', buffer: Buffer.from(bytes.slice(0, 20000)) });
    await said(here, /^raw\.bin: /);
    check('a file of bytes is, too', equalOf(await verdict(here)) > 1500);
    await here.fill('#live-log', 'hello');
    await pressed(here, 'read', /“h” is not a hexadecimal digit/);
    await here.fill('#live-log', '01 02 03 04');
    await pressed(here, 'read', /no frame of fixpid_link is in these 4 bytes/);
    check('bytes are no lines of numbers', !(await here.isVisible('#live-other')));
    const lines = Array.from({ length: 400 }, (_, i) => `setpoint:600,measurement:${Math.round(100 + (i < 60 ? 0 : 300 * (1 - Math.exp((60 - i) / 50))) + (i % 3))},output:${i < 60 ? 20 : 90}`).join('\n');
    await here.setInputFiles('#live-file', { name: 'plotter.log', mimeType: 'text/plain', buffer: Buffer.from(lines) });
    await here.waitForSelector('#live-other', { state: 'visible' });
    await here.click('#live-hand-over');
    await here.waitForSelector('#recorder[data-done]:not([data-busy])');
    for (const answer of ['this page’s step', '100 %']) {
        await here.locator('#record-asks button', { hasText: answer }).first().click();
        await here.waitForSelector('#recorder[data-done]:not([data-busy])');
    }
    const read = await text(here, '#fit');
    check(`a serial plotter’s lines go to the card of recordings: ${read}`, /lag [45]\.\d+ s/.test(read) && !(await here.isVisible('#live-other')) && !(await here.isDisabled('#use-fit')), `${read} ${await text(here, '#record-notes')}`);
    checkNone('a log: no error', here.noted.errors);
    await here.close();
}
await finish();
