// SPDX-License-Identifier: MIT
// Each card of the page by mouse and by keyboard: plots and their cursor, the experiment, a
// chip's record, a sensor's table, pictures, help and the three steps; axe-core in each width.
import { existsSync, readFileSync } from 'node:fs';
import { check, checkNone, choose, finish, fragment, frame, moduleOf, open, press, random, stale, text, violations } from './harness.mjs';

const { CAUSE, EXPERIMENT, HEAT_UP, STATUS } = await moduleOf('built');
const { experiment, startEngine } = await moduleOf('engine');
const { experimentText } = await moduleOf('experiment');
const { HELP, documentOf } = await moduleOf('help');
const { recordText } = await moduleOf('record');
const { PRESETS, ofLink, presetState } = await moduleOf('state');
await startEngine();

const PHONE = { width: 390, height: 844 };
const DESK = { width: 1300, height: 800 };
const opened = (here) => here.evaluate(() => document.querySelectorAll('#work details').forEach((one) => {
    one.open = true;
}));
const ends = (here, name) => {
    checkNone(`${name}: no error`, here.noted.errors);
    return here.close();
};

// --- The plots, with a mouse ----------------------------------------------------------
{
    const here = await open('p=flow');
    const from = await here.locator('#flags button').first().boundingBox();
    await here.mouse.move(from.x + 8, from.y + 8);
    await here.mouse.down();
    await here.mouse.move(from.x + 208, from.y + 8, { steps: 5 });
    await here.mouse.up();
    await frame(here);
    const at = Number(await here.locator('#events .at input').first().inputValue());
    const all = await here.locator('#plots').boundingBox();
    const wanted = 90 * (from.x + 208 - all.x - 56) / (all.width - 70);
    check(`a flag is dragged to ${at} s`, Math.abs(at - wanted) < 2, `not to ${wanted.toFixed(1)} s`);
    const slider = await here.locator('#work input[aria-label="kp, slider"]').boundingBox();
    await here.mouse.click(slider.x + slider.width * 0.8, slider.y + slider.height / 2);
    await frame(here);
    check('a slider is set', Number(await here.inputValue('#c-kp')) > 0.62);
    checkNone('nothing is stale', await stale(here));

    // The cursor draws nothing.
    await here.evaluate(() => {
        window.drawn = 0;
        for (const name of ['stroke', 'fill', 'fillRect', 'fillText', 'clearRect']) {
            const own = CanvasRenderingContext2D.prototype[name];
            CanvasRenderingContext2D.prototype[name] = function count(...more) {
                window.drawn += 1;
                return own.apply(this, more);
            };
        }
    });
    const drawn = () => here.evaluate(() => window.drawn);
    const marks = () => here.locator('#plots .cursor').evaluateAll((panes) => panes.map((one) => (one.hidden ? null : one.getBoundingClientRect().x)));
    const box = await here.locator('#plots canvas').first().boundingBox();
    const legend = await text(here, 'figcaption');
    for (const x of [100, 250, 333]) {
        await here.mouse.move(box.x + x, box.y + 60);
    }
    const places = await marks();
    check('the cursor is where the pointer is, in each pane, and nothing is drawn', places.length === 3 && places.every((x) => x !== null && Math.abs(x - box.x - 333) < 1.5) && await drawn() === 0, `${places}, not ${box.x + 333}, ${await drawn()} calls`);
    check('the legend has its values', (await text(here, 'figcaption')) !== legend);
    await here.mouse.move(box.x + 300, 2);
    check('away from the plots there is none', (await marks()).every((x) => x === null) && (await text(here, 'figcaption')) === legend);
    await here.fill('#c-kp', '0.7');
    await frame(here);
    check('a gain draws', await drawn() > 50, `${await drawn()}`);
    await ends(here, 'plots');
}
{
    const here = await open('p=flow', { viewport: PHONE });
    check('phone: no second plot at first', !(await here.isVisible('#mini')));
    await here.focus('#c-kp'); // below
    await here.waitForSelector('#mini', { state: 'visible' });
    const box = await here.locator('#mini').boundingBox();
    check('phone: by the sliders it stays in view, 30 % of the height', box.y === 0 && Math.abs(box.height - 0.3 * PHONE.height) <= 1 && box.width === PHONE.width, JSON.stringify(box));
    await press(here, 'ArrowUp');
    const field = await here.locator('#c-kp').boundingBox();
    check('phone: it does not cover the field', field.y >= box.height && field.y + field.height <= PHONE.height, JSON.stringify(field));
    const picture = () => here.evaluate(() => document.querySelector('#mini canvas').toDataURL());
    const first = await picture();
    await here.fill('#c-kp', '2');
    await frame(here);
    check('phone: it follows a gain, with its figures', await picture() !== first && (await text(here, '#mini dl')) === await here.locator('#key').evaluate((key) => [...key.querySelectorAll('dt, dd')].map((one) => one.textContent).join('')));
    await here.locator('#recording').scrollIntoViewIfNeeded();
    await here.waitForSelector('#mini', { state: 'hidden' });
    await ends(here, 'phone');
}
{
    const here = await open('', { viewport: DESK });
    await here.evaluate(() => window.scrollTo(0, 1e5));
    await frame(here);
    const box = await here.locator('#plots canvas').first().boundingBox();
    check('desk: the plot itself stays in view', !(await here.isVisible('#mini')) && box.y >= 0 && box.y + box.height < DESK.height && await here.evaluate(() => window.scrollY > 100), JSON.stringify(box));
    const order = await here.evaluate(() => ['#recording', '#plots', '#c-calm'].map((one) => document.querySelector(one).getBoundingClientRect().x));
    check('recording, plot, slider and header are side by side', order[0] < order[1] && order[1] < order[2] && await here.isVisible('#copy'), order.join());
    await here.evaluate(() => window.scrollTo(0, 0));
    const slider = await here.locator('#c-calm').boundingBox();
    const before = await text(here, '#header');
    await here.mouse.move(slider.x + slider.width / 2, slider.y + slider.height / 2);
    await here.mouse.down();
    await here.mouse.move(slider.x + slider.width * 0.7, slider.y + slider.height / 2, { steps: 3 });
    await frame(here);
    const kp = await here.inputValue('#c-kp');
    check('while a slider is dragged the header waits', (await text(here, '#header')) === before && kp !== '1.692', kp);
    await here.mouse.up();
    await frame(here);
    checkNone('when it is let go nothing is stale', await stale(here));
    check('and the header has it', (await text(here, '#header')) !== before);
    await ends(here, 'desk');
}

// --- Nothing stale ----------------------------------------------------------------
{
    const here = await open('p=flow');
    const draw = random(3);
    const actions = [
        ['another preset', () => choose(here, PRESETS[Math.floor(draw() * 5)].preset)],
        ['a gain', () => here.fill('#c-kp', (3 * draw()).toFixed(3))],
        ['the plant', () => here.fill('#c-gain', (50 + 100 * draw()).toFixed(0))],
        ['a refused gain', () => here.fill('#c-kp', '900')],
        ['a setpoint', () => here.fill('#c-setpoint', (20 + 30 * draw()).toFixed(0))],
        ['a time', () => here.locator('#events .at input').first().fill((draw()).toFixed(2))],
        ['an option', () => here.locator('#options input').nth(1).click()],
        ['autotune', () => here.click('#modes button[value=tune]')],
        ['control', () => here.click('#modes button[value=run]')],
    ];
    const found = [];
    await opened(here);
    for (let i = 0; i < 27; i++) {
        const [name, act] = actions[Math.floor(draw() * actions.length)];
        await act();
        await frame(here);
        const tuning = (await here.getAttribute('#modes button:last-child', 'aria-pressed')) === 'true';
        found.push(...(await stale(here, tuning)).map((one) => `after ${name}: ${one}`));
    }
    checkNone('nothing is stale after 27 random changes', found);
    await ends(here, 'changes');
}

// --- An experiment, in words ---------------------------------------------------------
{
    const here = await open('p=flow');
    const label = await here.locator('label[for=c-robustness]').textContent();
    check('the words of robustness have their numbers', label.includes('8 quick, 16 safe, 32 calm'), label);
    await here.click('#modes button[value=tune]');
    const rows = here.locator('#rules tbody tr');
    const words = ['quick 8', 'safe 16', 'calm 32'].flatMap((word) => [`PI, ${word}`, `PID, ${word}`]).sort();
    check('both rules by three words', (await rows.locator('th').allTextContents()).sort().join() === words.join());
    const marked = await rows.filter({ hasText: 'take this first' }).locator('th').allTextContents();
    check('one row is to be taken first', marked.join() === 'PI, safe 16', marked.join());
    const found = await text(here, '#found');
    check('it is over at its end', /^At [\d.]+ s it is over\.$/.test(await text(here, '#stage')), await text(here, '#stage'));
    await here.focus('#plots');
    await press(here, 'Home');
    check('it begins with the noise', /^At 0 (ms|s) it measures the noise: 0 of 10 cycles, 0 %\.$/.test(await text(here, '#stage')), await text(here, '#stage'));
    await press(here, ...new Array(60).fill('ArrowRight'));
    const amid = await text(here, '#stage');
    const [, at, done, left] = amid.match(/^At (.*) s it swings .*: (\d+) of 10 cycles, \d+ %; at most (.*) s more\.$/) ?? [];
    const whole = Number(found.match(/after ([\d.]+) s/)[1]);
    check('amid it says what is left', Number(done) > 4 && Number(done) < 10 && Number(at) + Number(left) >= whole * 0.95 && Number(left) < 0.8 * whole, amid);
    const s = presetState('flow');
    const { BAND, PATIENCE } = experiment(s).results;
    const guard = await text(here, '#guard pre');
    check('its guard is beside the gains', BAND > 0 && new RegExp(`${BAND}, +/\\* band.*\\n +${PATIENCE}, +/\\* patience`).test(guard), guard);
    await here.evaluate(() => window.tuner.change({ ROBUSTNESS: 24 }));
    await frame(here);
    check('another number has rows of its own', await rows.count() === 8);
    await here.click('#rules button[aria-label="Use PID, 24"]');
    await frame(here);
    check('and is used with its rule', /robustness=24&rule=PID/.test(await fragment(here)), await fragment(here));
    await ends(here, 'an experiment');
    const said = (status, REASON, kind = EXPERIMENT.RELAY) => experimentText(1, 'Measured', { results: { EXPERIMENT: kind, STATUS: status, HAS_MODEL: 0, DONE: 1, EXPECTED: 10 },
        rules: [{ rule: 'PI', robustness: 16, has: false, results: { REASON } }] });
    const texts = [...Object.values(STATUS).map((one) => said(one, CAUSE.SHAPE)), ...Object.values(CAUSE).map((one) => said(STATUS.DONE, one)),
        ...Object.values(HEAT_UP).map((one) => said(one, CAUSE.NO_REASON, EXPERIMENT.HEAT_UP))];
    const shared = /wave|These limits|more steps than|out of its range|too many steps/i;
    checkNone('each status and each reason has a sentence', texts.filter((one, i) => !/^[A-Z].{20,}\.$/.test(one) || one.includes('undefined') || (texts.indexOf(one) !== i && !shared.test(one))));
}
{
    const here = await open('p=flow');
    await here.click('#modes button[value=tune]');
    await here.selectOption('#experiment', { label: 'Heat-up, from rest towards the setpoint' });
    await frame(here);
    check('a heat-up that would go too far says so', (await text(here, '#found')).startsWith('What is stored would bring the measurement to the setpoint') && !(await here.isVisible('#rules')), await text(here, '#found'));
    await here.click('#work details[data-title="Autotune"] summary');
    await here.fill('#c-drive', '0');
    await frame(here);
    check('without an output it is refused', (await text(here, '#found')) === 'It refuses these limits.', await text(here, '#found'));
    await choose(here, 'oven');
    await here.click('#modes button[value=tune]');
    await frame(here);
    const lasted = Number((await text(here, '#found')).match(/^Measured after (\d+)[\d.]* s, \d+ steps: it moves by 0\.\d+ counts per second for each of the output, delay \d.* s; noise \d.* counts\.$/)?.[1]);
    check('an oven is measured within a minute', lasted > 5 && lasted < 60, await text(here, '#found'));
    await here.focus('#plots');
    await press(here, 'End', ...new Array(20).fill('ArrowLeft'));
    check('on its way it heats', /^At .* s it heats: \d+ %\.$/.test(await text(here, '#stage')), await text(here, '#stage'));
    const marked = await here.locator('#rules tbody tr').filter({ hasText: 'take this first' }).locator('th').allTextContents();
    check('PID is to be taken first', marked.join() === 'PID, safe 16' && await here.isDisabled('#copy-record'), marked.join());
    check('its guard has no reach', /0, +\/\* reach_max/.test(await text(here, '#guard pre')), await text(here, '#guard pre'));
    await press(here, 'Escape');
    checkNone('nothing is stale', await stale(here, true));
    await here.click('#rules button[aria-label="Use PID, safe 16"]');
    await frame(here);
    check('and is used with half a setpoint weight', (await here.inputValue('#c-weight')) === '0.5' && /rule=PID/.test(await fragment(here)), await fragment(here));
    await ends(here, 'a heat-up');
}

// --- A chip's record ------------------------------------------------------------------
{
    const here = await open('p=flow');
    await here.click('#open-tools');
    // As a chip has it: other limits, reverse acting.
    const record = recordText(experiment({ ...ofLink('p=flow'), GAIN: -100, START: 90, OPTIONS: 0x80, OUTPUT_MIN: -50, OUTPUT_MAX: 900 }).record);
    const said = () => text(here, '#record-found');
    const shown = async () => (await here.isVisible('#record-rules')) && here.locator('#record-rules button').count();
    await here.fill('#record', record);
    check('a record is computed', /^At 20 steps per second, as set on this page: gain 4\.\d+, lag 8\.\d+ s/.test(await said()) && (await shown()) === 6, await said());
    const first = await said();
    const guard = await text(here, '#record-guard pre');
    check('its guard has its limits and its sign', /-50, +\/\* output_min.*\n +900, +\/\* output_max/.test(guard) && /true, +\/\* reverse/.test(guard) && /0, +\/\* reach_max/.test(guard), guard);
    await here.fill('#record', record.replace(/[0-9a-f]+/g, '0x$&,').toUpperCase());
    check('an array of C is the same', (await said()) === first, await said());
    await here.evaluate(() => window.tuner.change({ RATE: 40 }));
    await frame(here);
    check('its times are of the page’s rate', /^At 40 steps .*, lag 4\.\d+ s/.test(await said()), await said());
    await here.evaluate(() => window.tuner.change({ RATE: 20 }));
    await frame(here);
    const ki = await here.locator('#record-rules tr').nth(4).locator('td').nth(2).textContent();
    await here.click('#record-rules button[aria-label="Use PID, quick 8"]');
    await frame(here);
    const taken = await here.evaluate(() => window.tuner.currentState());
    check('its gains and its actuator are taken', taken.KP > 0 && taken.KD > 0 && Math.abs(taken.KI - Number(ki)) < 0.005 * taken.KI &&
        taken.OPTIONS === 0x80 && taken.OUTPUT_MIN === -50 && taken.OUTPUT_MAX === 900 && taken.rule === 'PID' && taken.ROBUSTNESS === 8, JSON.stringify(taken));
    check('and it is said', (await text(here, '#said')).includes('by PID, quick 8 are in use'), await text(here, '#said'));
    for (const [pasted, sentence] of [[record.replace(/.$/, (digit) => (digit === '0' ? '1' : '0')), 'A byte of the record is wrong'], [`02${record.slice(2)}`, 'version 2, and this page reads version 3'],
        [record.slice(0, -3), 'this has 122 digits instead of 124'], [record.replace(/f/, 'g'), '“g” is not a hexadecimal digit'], [' \n', '']]) {
        await here.fill('#record', pasted);
        check(`a record is refused: ${sentence || 'nothing says nothing'}`, (await said()).includes(sentence) && ((await said()) === '') === (sentence === '') && !(await shown()), await said());
    }
    await choose(here, 'an937');
    await frame(here);
    check('a note’s controller has no such card', !(await here.isVisible('#chip')));
    await ends(here, 'a record');
}

// --- A sensor's table --------------------------------------------------------------------
{
    const here = await open();
    await here.click('#open-tools');
    const found = () => text(here, '#table-found');
    await here.click('#choose');
    check('the worst error is stated, and the table printed', /^Worst error 0\.146 °C, over every count, with 16 points\.$/.test(await found()) && (await text(here, '#table')).includes('    ntc_points[] = {'), await found());
    await here.fill('#s-points', '8');
    check('another number drops it', !(await here.isVisible('#table')) && (await found()) === '');
    for (const [id, value] of [['#s-points', '1'], ['#s-bits', ''], ['#s-low', '200'], ['#s-r25', '10.0.1']]) {
        const before = await here.inputValue(id);
        await here.fill(id, value);
        await here.click('#choose');
        check(`${id} ${value || 'empty'} is refused with a sentence`, /^A value is missing/.test(await found()) && await here.isDisabled('#copy-table'));
        await here.fill(id, before);
    }
    await here.selectOption('#s-kind', 'k');
    await here.fill('#s-points', '16');
    await here.click('#choose');
    check('a thermocouple has its own fields and table', await here.isVisible('#s-microvolts') && !(await here.isVisible('#s-beta')) && /^Worst error 0\.17\d °C/.test(await found()), await found());
    await ends(here, 'a sensor');
}

// --- Pictures ---------------------------------------------------------------------------------
{
    const here = await open('p=flow');
    await here.click('#judged summary');
    const picture = (id) => here.evaluate((one) => document.querySelector(one).toDataURL(), id);
    const blank = (id) => here.evaluate((one) => {
        const canvas = document.querySelector(one);
        return canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.every((byte) => byte === 0);
    }, id);
    for (const [id, kp] of [['#nyquist', '0.3'], ['#bode', '0.9']]) {
        const first = await picture(id);
        const empty = await blank(id);
        await here.fill('#c-kp', kp);
        await frame(here);
        check(`${id} is drawn, and follows a gain`, !empty && await picture(id) !== first);
    }
    check('both are in words', /20 % off/.test(await text(here, '#off')) && (await here.getAttribute('#bode', 'aria-label')).startsWith('Bode plot of the loop: its gain is 1 at'));
    await here.fill('#c-kp', '900');
    await frame(here);
    check('of refused gains nothing is left', await blank('#bode') && await blank('#nyquist') && (await text(here, '#off')) === '');
    await ends(here, 'pictures');
}
for (const reducedMotion of ['reduce', 'no-preference']) {
    const here = await open('p=an964', { reducedMotion });
    const picture = () => here.evaluate(() => document.querySelector('#picture canvas').toDataURL());
    const first = await picture();
    await here.waitForTimeout(600);
    const moves = first !== await picture();
    check(`the pendulum ${reducedMotion === 'reduce' ? 'stands' : 'moves'} with ${reducedMotion}`, moves === (reducedMotion !== 'reduce'));
    await here.close();
}

// --- Help, and three steps ---------------------------------------------------------------------
{
    const slug = (heading) => heading.toLowerCase().replace(/[^\w\- ]/g, '').replaceAll(' ', '-');
    const headings = (name) => [...readFileSync(`docs/${name}.md`, 'utf8').matchAll(/^#+ (.*)$/gm)].map(([, heading]) => slug(heading));
    const links = Object.values(HELP).map(([, link]) => link.split('#'));
    checkNone(`${links.length} links lead to a heading`, links.filter(([name, heading]) => !existsSync(`docs/${name}.md`) || !headings(name).includes(heading)));
    checkNone('each help is one sentence', Object.entries(HELP).filter(([, [sentence]]) => !/^[A-Z].{15,150}\.$/.test(sentence) || /[.!?] [A-Z]/.test(sentence)).map(([key]) => key));
    check('on the site it is a page, in the sources a document', documentOf('tuning#tuning', { href: 'file:///a/site/tuner/index.html' }) === '../docs/tuning.html#tuning' &&
        documentOf('tuning#tuning', { href: 'file:///a/build/tuner/index.html' }) === '../../docs/tuning.md#tuning');

    const here = await open('p=own');
    await opened(here);
    checkNone('each number, option and figure has help', await here.evaluate(() => [...document.querySelectorAll('#work .control, #options div, #key > div')]
        .filter((one) => !one.querySelector('.help')).map((one) => one.querySelector('label, dt').textContent)));
    const help = here.locator('.control:has(#c-kp) .help');
    check('no help at first', !(await help.isVisible()));
    await here.focus('#explain');
    await press(here, 'Enter');
    check('a button explains all', await help.isVisible() && (await help.textContent()) === `${HELP.KP[0]} More` && (await help.locator('a').getAttribute('href')) === documentOf(HELP.KP[1], { href: here.url() }));
    await press(here, 'Enter');
    check('and no more', !(await help.isVisible()) && (await here.getAttribute('#explain', 'aria-pressed')) === 'false');

    const shown = () => here.isVisible('#tour');
    const steps = here.locator('#tour li button');
    check('three steps at first', await shown() && (await steps.allTextContents()).join() === '2 Your plant,3 Gains,4 Header');
    for (const [i, [place, part]] of [['recording', '[data-title="2 Your plant"]'], ['c-calm', '[data-title="3 Gains"]'], ['copy', '#take']].entries()) {
        await here.locator(part).evaluate((one) => { one.open = false; });
        await steps.nth(i).click();
        const seen = await here.locator(`#${place}`).boundingBox();
        check(`the step leads to ${place}, which is seen and marked`, (await here.evaluate(() => document.activeElement.id)) === place && seen.y > 0 && seen.y + seen.height < 1000 &&
            await here.locator(part).evaluate((one) => getComputedStyle(one).animationName) === 'led', JSON.stringify(seen));
    }
    await choose(here, 'an964');
    await steps.nth(1).click();
    check('a plant without a slider has its gains', (await here.evaluate(() => document.activeElement.id)) === 'c-kp');
    await here.click('#tour-done');
    const gone = !(await shown());
    await here.reload();
    await here.waitForSelector('body[data-ready]');
    check('dismissed, they are gone for good', gone && !(await shown()));
    await ends(here, 'help');
    const refusing = await open('', {}, undefined, (page) => page.addInitScript(() => Object.defineProperty(window, 'localStorage', { get: () => { throw new Error('no storage'); } })));
    await refusing.click('#tour-done');
    check('without storage, too, as long as the page is open', !(await refusing.isVisible('#tour')));
    await ends(refusing, 'without storage');
}

// --- Narrow, dark, and with a reader --------------------------------------------------
const READ = ['oven', 'an964']; // the others are made of the same parts
const backgrounds = new Set();
for (const colorScheme of ['light', 'dark']) {
    for (const [name, viewport] of Object.entries({ phone: PHONE, desk: DESK })) {
        const [found, wide] = [[], []];
        for (const { preset } of PRESETS) {
            const here = await open(`p=${preset}`, { colorScheme, viewport });
            backgrounds.add(await here.evaluate(() => getComputedStyle(document.body).backgroundColor));
            for (const mode of preset === 'oven' ? ['run', 'tune'] : ['run']) {
                await here.click(`#modes button[value=${mode}]`);
                found.push(...(READ.includes(preset) ? await violations(here) : []).map((one) => `${preset}: ${one}`));
                const width = await here.evaluate(() => document.documentElement.scrollWidth);
                wide.push(...(width > viewport.width ? [`${preset}: ${width}`] : []));
            }
            await here.close();
        }
        checkNone(`${colorScheme}, ${name}: axe-core`, found);
        checkNone(`${colorScheme}, ${name}: no sideways scroll`, wide);
    }
}
check('dark is another page than light', backgrounds.size === 2, [...backgrounds].join());
await finish();
