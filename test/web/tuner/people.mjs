// SPDX-License-Identifier: MIT
// How the page works for people: by keyboard alone, on a phone, in the dark, with
// a reader, without a network; and that nothing stale is left after a change.
import { readFileSync, statSync } from 'node:fs';
import { AXE, check, checkNone, finish, fragment, frame, open, press, random, stale, text, WORK } from './harness.mjs';

const BYTES_MAX = 220000;
const PHONE = { viewport: { width: 390, height: 844 } };

check(`the page is ${statSync(`${WORK}/index.html`).size} bytes`, statSync(`${WORK}/index.html`).size <= BYTES_MAX,
    `above ${BYTES_MAX}`);

const page = await open();
const presets = await page.evaluate(() => window.tuner.PRESETS.map((one) => one.preset));

// Tabs until the focus is on what the selector finds; false if it never is.
async function tabTo(here, selector) {
    for (let i = 0; i < 300; i++) {
        await here.keyboard.press('Tab');
        if (await here.evaluate((wanted) => document.activeElement.matches(wanted), selector)) {
            return true;
        }
    }
    return false;
}

// --- By keyboard alone ---------------------------------------------------------
{
    const here = await open();
    check('keyboard: a preset', await tabTo(here, '#presets button[value=flow]'));
    await press(here, 'Enter');
    check('keyboard: the preset is shown', (await text(here, '#presets [aria-pressed=true]')) === 'Lag and dead time');
    const before = await text(here, '#header');
    check('keyboard: kp', await tabTo(here, '#c-kp'));
    await press(here, 'Control+A', '1', '.', '5');
    check('keyboard: what is typed is in the header', (await text(here, '#header')).includes('384u'), await text(here, '#header'));
    check('keyboard: ki’s slider', await tabTo(here, '#panel input[aria-label="ki, slider"]'));
    await press(here, 'ArrowRight', 'ArrowRight');
    check('keyboard: the slider moves', (await text(here, '#header')) !== before && Number(await here.inputValue('#c-ki')) > 0.11);
    checkNone('keyboard: nothing is stale', await stale(here));
    await here.evaluate(() => document.activeElement.blur());
    check('keyboard: autotune', await tabTo(here, '#modes button[value=tune]'));
    await press(here, 'Enter');
    check('keyboard: a rule', await tabTo(here, '#rules button[aria-label="Use PI, safe 16"]'));
    await press(here, 'Enter');
    check('keyboard: the rule is in use', (await here.inputValue('#c-kd')) === '0' &&
        (await here.getAttribute('#modes button[value=run]', 'aria-pressed')) === 'true');
    await here.evaluate(() => document.activeElement.blur());
    check('keyboard: an event', await tabTo(here, '#flags button'));
    const at = await here.getAttribute('#flags button', 'aria-label');
    await press(here, 'ArrowRight');
    check('keyboard: the event moves', (await here.getAttribute('#flags button', 'aria-label')) !== at);
    await press(here, 'Delete');
    check('keyboard: the event is removed', (await here.locator('#flags button').count()) === 1);
    check('keyboard: the next one has the focus', await here.evaluate(() => document.activeElement.matches('#flags button')));
    await press(here, 'Control+z');
    check('keyboard: it is back', (await here.locator('#flags button').count()) === 2);
    check('keyboard: the cursor', await tabTo(here, '#plots'));
    const end = await text(here, 'figcaption');
    await press(here, 'Home');
    check('keyboard: the cursor moves', (await text(here, 'figcaption')) !== end);
    check('keyboard: a new event', await tabTo(here, '#events > button'));
    await press(here, 'Enter');
    check('keyboard: it is there', (await here.locator('#flags button').count()) === 3);
    checkNone('keyboard: no error', here.noted.errors);
    await here.close();
}

// --- With a mouse --------------------------------------------------------------
{
    const here = await open('p=flow');
    const flag = here.locator('#flags button').first();
    const from = await flag.boundingBox();
    await here.mouse.move(from.x + 8, from.y + 8);
    await here.mouse.down();
    await here.mouse.move(from.x + 208, from.y + 8, { steps: 5 });
    await here.mouse.up();
    await frame(here);
    const at = Number(await here.locator('#events .at input').first().inputValue());
    const box = await here.locator('#plots').boundingBox();
    const wanted = 90 * (from.x + 208 - box.x - 56) / (box.width - 70);
    check(`mouse: a flag is dragged to ${at} s`, Math.abs(at - wanted) < 2, `not to ${wanted.toFixed(1)} s`);
    checkNone('mouse: nothing is stale', await stale(here));
    const slider = await here.locator('#panel input[aria-label="kp, slider"]').boundingBox();
    const before = await here.inputValue('#c-kp');
    await here.mouse.click(slider.x + slider.width * 0.8, slider.y + slider.height / 2);
    await frame(here);
    check('mouse: a slider is set', Number(await here.inputValue('#c-kp')) > Number(before));
    const values = await text(here, 'figcaption');
    await here.hover('#plots canvas', { position: { x: 200, y: 60 } });
    check('mouse: the legend has the values at the cursor', (await text(here, 'figcaption')) !== values);
    await here.click('#keep');
    await here.fill('#c-kp', '0.3');
    await frame(here);
    check('mouse: what is kept is beside it', (await text(here, 'figcaption')).includes('kept A'), await text(here, 'figcaption'));
    await here.click('#presets button[value=oven]');
    await frame(here);
    check('mouse: another plant has no curve of it', !(await text(here, 'figcaption')).includes('kept'));
    await here.close();
}

// --- Nothing stale ----------------------------------------------------------------
{
    const here = await open('p=flow');
    const draw = random(3);
    const actions = [
        ['another preset', () => here.click(`#presets button[value=${presets[Math.floor(draw() * 5)]}]`)],
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
    for (let i = 0; i < 27; i++) {
        const [name, act] = actions[Math.floor(draw() * actions.length)];
        await act();
        await frame(here);
        const tuning = (await here.getAttribute('#modes button:last-child', 'aria-pressed')) === 'true';
        found.push(...(await stale(here, tuning)).map((one) => `after ${name}: ${one}`));
    }
    checkNone('nothing is stale after 27 random changes', found);
    await here.click('#presets button[value=oven]');
    await here.fill('#c-kp', '900');
    await frame(here);
    check('a refusal is said', (await text(here, '#advice')).includes('above 127.996'));
    check('a refused header is empty', (await text(here, '#header')) === '' && await here.isDisabled('#copy'));
    await here.fill('#c-kp', '0.01');
    await frame(here);
    check('a coarse gain is said', (await text(here, '#advice')).includes('kp is 3 steps of 1/256'), await text(here, '#advice'));
    await here.close();
}

// --- Links ------------------------------------------------------------------------
{
    const odd = ['p=nonsense', '&&&=', 'p=oven&kp=NaN&ki=1e999&unit=%E0%A4%A', 'p=flow&events=setpoint_1~load_x_y~bad',
        'p=axis&rate=-5', 'p=flow&duration=1e9&rate=1e9', 'p=oven&t1=0&t2=0', 'p=an964&sensor_bits=99', 'p=motor&gain=1e300'];
    const found = [];
    for (const fragment of odd) {
        const here = await open(fragment);
        found.push(...here.noted.errors.map((error) => `${fragment}: ${error}`));
        await here.close();
    }
    checkNone(`${odd.length} links that make no sense open without an error`, found);
    const here = await open('p=flow&kp=2.5&unit=%25');
    check('a link has its settings', (await here.inputValue('#c-kp')) === '2.5');
    check('its unit may be %', (await text(here, 'figcaption')).includes('%'));
    await here.close();
}

// --- A recording ---------------------------------------------------------------------
{
    const here = await open();
    const lines = Array.from({ length: 80 }, (_, i) => `${i}, ${(20 + (i > 5 ? 60 * (1 - Math.exp(-(i - 5) / 12)) : 0)).toFixed(3)}`);
    await here.fill('#recording', lines.join('\n'));
    await here.fill('#record-unit', '°F');
    const fitted = () => here.waitForSelector('#recorder[data-done]:not([data-busy])');
    await fitted();
    check('a recording is fitted', /^Gain 60\.0 °F .* lag 12\.0 s, dead time 5\.0/.test(await text(here, '#fit')), await text(here, '#fit'));
    await here.click('#use-fit');
    await frame(here);
    check('it becomes the plant', (await here.inputValue('#c-gain')) === '60' && (await text(here, 'figcaption')).includes('°F'));
    const margins = await text(here, '#margins');
    check('its first gains are sound', /stable/.test(margins) && !/unstable/.test(margins), margins);
    checkNone('a fitted plant leaves nothing stale', await stale(here));
    await here.fill('#recording', 'nonsense');
    await fitted();
    check('what is none is said', (await text(here, '#fit')).includes('No line has a number') && await here.isDisabled('#use-fit'));
    await here.close();
}

// --- An experiment, in words ---------------------------------------------------------
{
    const here = await open('p=flow');
    const label = await here.locator('label[for=c-robustness]').textContent();
    check('the words of robustness have their numbers', label.includes('8 quick, 16 safe, 32 calm'), label);
    await here.click('#modes button[value=tune]');
    const names = () => here.locator('#rules tbody th').allTextContents();
    const words = ['quick 8', 'safe 16', 'calm 32'].flatMap((word) => [`PI, ${word}`, `PID, ${word}`]).sort();
    check('both rules by three words', (await names()).sort().join() === words.join(), (await names()).join());
    const found = await text(here, '#found');
    check('the model is told', /^Measured after .* s, .* steps: gain 4\.\d+, lag 8\.\d+ s, delay \d.* s; output 500 holds the setpoint/.test(found), found);
    check('it is over at its end', /^At \d+ s it is over\.$/.test(await text(here, '#stage')), await text(here, '#stage'));
    await here.focus('#plots');
    await press(here, 'Home');
    const start = await text(here, '#stage');
    check('it begins with the noise', /^At 0 (ms|s) it measures the noise: 0 of 13 cycles, 0 %\.$/.test(start), start);
    await press(here, ...new Array(60).fill('ArrowRight'));
    const amid = await text(here, '#stage');
    const [, at, done, left] = amid.match(/^At (.*) s it swings .*: (\d+) of 13 cycles, \d+ %; at most (.*) s more\.$/) ?? [];
    const whole = Number(found.match(/after (\d+) s/)[1]);
    check('amid it says what is left', Number(done) > 5 && Number(done) < 13 && Number(at) + Number(left) >= whole * 0.95 && Number(left) < 0.8 * whole, amid);
    await here.evaluate(() => window.tuner.change({ ROBUSTNESS: 24 }));
    await frame(here);
    check('another number has rows of its own', (await names()).includes('PID, 24') && (await names()).length === 8, (await names()).join());
    await here.click('#rules button[aria-label="Use PID, 24"]');
    await frame(here);
    check('and is used with its rule', /robustness=24&rule=PID/.test(await fragment(here)), await fragment(here));
    const untold = await here.evaluate(() => {
        const { CAUSE, STATUS, experimentText } = window.tuner;
        const said = (STATUS, REASON) => experimentText(1, 'Measured', { results: { STATUS, HAS_MODEL: 0, DONE: 1, EXPECTED: 13 }, rules: [{ rule: 'PI', robustness: 16, has: false, results: { REASON } }] });
        const texts = [...Object.values(STATUS).map((one) => said(one, CAUSE.SHAPE)), ...Object.values(CAUSE).filter((one) => one !== CAUSE.NO_REASON).map((one) => said(STATUS.DONE, one))];
        return texts.filter((one, i) => !/^[A-Z].{20,}\.$/.test(one) || one.includes('undefined') || (texts.indexOf(one) !== i && !one.includes('wave')));
    });
    checkNone('each status and each reason has a sentence', untold);
    checkNone('an experiment makes no error', here.noted.errors);
    await here.close();
}

// --- A chip's record ------------------------------------------------------------------
{
    const here = await open('p=flow');
    // As a chip has it: other limits, reverse acting.
    const record = await here.evaluate(() => {
        const { currentState, experiment, recordText } = window.tuner;
        const s = { ...currentState(), GAIN: -100, START: 90, OPTIONS: 0x80, OUTPUT_MIN: -50, OUTPUT_MAX: 900 };
        return recordText(experiment(s).record);
    });
    check('a record has 62 bytes', record.split(/\s+/).length === 62, record);
    const said = () => text(here, '#record-found');
    const shown = async () => (await here.isVisible('#record-rules')) && here.locator('#record-rules button').count();
    await here.fill('#record', record);
    check('a record is computed', /^At 20 steps per second, as set on this page: gain 4\.\d+, lag 8\.\d+ s/.test(await said()) && (await shown()) === 6, await said());
    const first = await said();
    const guard = await text(here, '#record-guard pre');
    check('its guard has its limits and its sign', /-50, +\/\* output_min.*\n +900, +\/\* output_max/.test(guard) && /true, +\/\* reverse/.test(guard) &&
        /0, +\/\* reach_max/.test(guard), guard);
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
    const taken = await here.evaluate(() => {
        const { KP, KI, KD, OPTIONS, OUTPUT_MIN, OUTPUT_MAX, rule, ROBUSTNESS } = window.tuner.currentState();
        return { KP, KI, KD, OPTIONS, OUTPUT_MIN, OUTPUT_MAX, rule, ROBUSTNESS };
    });
    check('its gains and its actuator are taken', taken.KP > 0 && taken.KD > 0 && Math.abs(taken.KI - Number(ki)) < 0.005 * taken.KI &&
        taken.OPTIONS === 0x80 && taken.OUTPUT_MIN === -50 && taken.OUTPUT_MAX === 900 && taken.rule === 'PID' && taken.ROBUSTNESS === 8, JSON.stringify(taken));
    check('the header has them', /-50, +\/\* output_min.*\n.*900, +\/\* output_max/.test(await text(here, '#header')) && /true, +\/\* reverse/.test(await text(here, '#header')), await text(here, '#header'));
    check('and it is said', (await text(here, '#said')).includes('by PID, quick 8 are in use'), await text(here, '#said'));
    const wrong = {
        'a byte is wrong': [record.replace(/.$/, (digit) => (digit === '0' ? '1' : '0')), 'A byte of the record is wrong'],
        'another version': [`02${record.slice(2)}`, 'version 2, and this page reads version 3'],
        'bytes are missing': [record.slice(0, -3), 'this has 122 digits instead of 124'],
        'no digit': [record.replace(/f/, 'g'), '“g” is no such digit'],
    };
    for (const [name, [pasted, sentence]] of Object.entries(wrong)) {
        await here.fill('#record', pasted);
        check(`${name}: it is refused with a sentence`, (await said()).includes(sentence) && !(await shown()), await said());
    }
    await here.fill('#record', ' \n');
    check('nothing says nothing', (await said()) === '' && !(await shown()) && !(await here.isVisible('#record-guard')), await said());
    await here.click('#presets button[value=an937]');
    await frame(here);
    check('a note’s controller has no such card', !(await here.isVisible('#chip')));
    checkNone('a record makes no error', here.noted.errors);
    await here.close();
}

// --- Narrow, dark, and with a reader --------------------------------------------------
const READ = ['oven', 'an964']; // the others are made of the same parts
const AXE_SOURCE = readFileSync(AXE, 'utf8');

async function violations(here) {
    await here.evaluate(AXE_SOURCE);
    const found = await here.evaluate(() => window.axe.run({ runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'best-practice'] }));
    return found.violations.map((one) => `${one.id} (${one.impact}): ${one.nodes[0].target} ${one.nodes[0].failureSummary.slice(0, 200)}`);
}

for (const scheme of ['light', 'dark']) {
    for (const [name, options] of [['wide', {}], ['phone', PHONE]]) {
        const found = [];
        const wide = [];
        for (const preset of presets) {
            const here = await open(`p=${preset}`, { colorScheme: scheme, ...options });
            for (const tuning of preset === 'oven' ? [false, true] : [false]) {
                if (tuning) {
                    await here.click('#modes button[value=tune]');
                }
                if (READ.includes(preset)) {
                    found.push(...(await violations(here)).map((one) => `${preset}: ${one}`));
                }
                const width = await here.evaluate(() => document.documentElement.scrollWidth);
                wide.push(...(width > (options.viewport?.width ?? 1360) ? [`${preset}: ${width}`] : []));
            }
            await here.close();
        }
        checkNone(`${scheme}, ${name}: axe-core`, found);
        checkNone(`${scheme}, ${name}: no sideways scroll`, wide);
    }
}
{
    const [light, dark] = await Promise.all(['light', 'dark'].map(async (colorScheme) => {
        const here = await open('', { colorScheme });
        const colour = await here.evaluate(() => getComputedStyle(document.body).backgroundColor);
        await here.close();
        return colour;
    }));
    check('dark is another page than light', light !== dark, light);
}

// --- Motion ------------------------------------------------------------------------------
for (const reducedMotion of ['reduce', 'no-preference']) {
    const here = await open('p=an964', { reducedMotion });
    const picture = () => here.evaluate(() => document.querySelector('#picture canvas').toDataURL());
    const first = await picture();
    await here.waitForTimeout(600);
    const moves = first !== await picture();
    check(`the pendulum ${reducedMotion === 'reduce' ? 'stands' : 'moves'} with ${reducedMotion}`, moves === (reducedMotion !== 'reduce'));
    await here.close();
}

// --- Nothing is loaded -----------------------------------------------------------------------
checkNone('no request but the file', page.noted.requests.filter((url) => !/^(file:|data:|blob:)/.test(url)));
check('the file is one request', page.noted.requests.filter((url) => url.startsWith('file:')).length === 1);
checkNone('no address to load from', [...readFileSync(`${WORK}/index.html`, 'utf8').matchAll(/(?:src|href)="(?!data:)[^"]*"|@import|https?:\/\/[^\s"']+/g)].map((one) => one[0]));
checkNone('no error in the page', page.noted.errors);
await finish();
