// SPDX-License-Identifier: MIT
// The load alone, against what an integral has to do for a load; the cursor, which draws
// nothing; and the three steps that a new user sees.
import { check, checkNone, finish, frame, moduleOf, open, press, text } from './harness.mjs';

const { loadAlone, loadFigures, restText } = await moduleOf('load');
const { metricsOf } = await moduleOf('metrics');
const { PRESETS, ofLink } = await moduleOf('state');
const { run, startEngine } = await moduleOf('engine');
await startEngine();

// --- The load alone, without a browser -----------------------------------------------------
const sum = (values) => values.reduce((total, one) => total + one, 0);
// The integral ends at what the load takes: ki times the sum of the errors. A motor's load of
// 0.08 N m is 0.08 / 0.05 A, by 2.4 ohms 3.84 V, of 24 V 160 counts of 1000.
for (const [link, counts] of [['p=flow', 150], ['p=axis', 200], ['p=motor', 160], ['p=own', 25.5]]) {
    const s = ofLink(`${link}&noise=0`);
    const { found, lead } = loadAlone(s);
    const { SETPOINT, MEASUREMENT, OUTPUT } = found.series;
    const done = sum([...SETPOINT.slice(lead)].map((goal, i) => goal - MEASUREMENT[lead + i])) * found.results.KI / 2 ** 24;
    const moved = OUTPUT.at(-1) - OUTPUT[lead - 1];
    check(`${link}: the integral takes ${done.toFixed(1)} counts, and the output ${moved}`, Math.abs(done / counts - 1) < 0.03 && Math.abs(moved - done) < 0.03 * Math.abs(done) + 2, `not ${counts}`);
}
const flow = ofLink('p=flow&noise=0');
const alone = loadAlone(flow);
const figures = loadFigures(alone);
const inScene = metricsOf(flow, run(flow)).load;
check(`the load takes it ${figures.most.toFixed(2)} away, as at the end of its scene`, Math.abs(figures.most / inScene - 1) < 0.05, `${inScene}`);
const goal = alone.found.series.SETPOINT[0] * 100 / 4095;
check('it meets the setpoint before it', new Set(alone.found.series.SETPOINT).size === 1 && Math.abs(goal - 65) < 0.02, `${goal}`);
check('and no other', loadAlone({ ...flow, events: [{ at: 40, what: 'SETPOINT', a: 20 }, { at: 30, what: 'LOAD', a: -0.1 }] }).s.SETPOINT === 50);
check('a scene without a load gets one', loadAlone({ ...flow, events: [] }).s.events[0].a === -0.1);
const errors = alone.found.series.VALUE_TRUE.slice(alone.lead).map((value) => Math.abs(value - goal));
const back = Math.round(figures.back * flow.RATE);
check(`it is back after ${figures.back} s`, back > 0 && errors.slice(back).every((one) => one <= figures.most / 10 + 1e-9) && errors[back - 1] > 0.99 * figures.most / 10 && Math.abs(errors[Math.round(figures.at * flow.RATE)] - figures.most) < 1e-9);
checkNone('each preset is at rest before', PRESETS.map(({ preset }) => [preset, restText(loadAlone(ofLink(`p=${preset}`)))]).filter(([, said]) => said !== null).map(([preset]) => preset));
check('one that is not is told', /^The loop is not at rest/.test(restText(loadAlone({ ...flow, KI: 0.004 })) ?? ''));
const long = loadAlone(ofLink('p=flow&duration=1000'));
check(`a long scene ends in time, with ${long.found.n} steps`, long.found.n > 1000 && long.found.n <= 20000 && long.s.DURATION === long.found.n / 20);

// --- The load alone, in the browser ----------------------------------------------------------
const here = await open('p=flow');
const metrics = () => text(here, '#metrics');
const before = await metrics();
await here.click('#modes button[value=load]');
await frame(here);
check('a button shows the load alone', (await here.getAttribute('#modes button[value=load]', 'aria-pressed')) === 'true' && /^Load, at most.*Back within a tenth of it/.test(await metrics()), await metrics());
check('without the flags of the scene', !(await here.isVisible('#flags')) && !(await here.isVisible('#keep')));
const first = await metrics();
await here.fill('#c-kp', '1');
await frame(here);
const second = await metrics();
check('it follows a gain', second !== first);
const fresh = await open(await here.evaluate(() => window.tuner.fragmentOf(window.tuner.currentState())));
await fresh.click('#modes button[value=load]');
check('as a page does that is opened anew', (await text(fresh, '#metrics')) === second && (await text(fresh, 'figcaption')) === (await text(here, 'figcaption')));
await fresh.close();
await here.fill('#c-ki', '0.004');
await frame(here);
check('a loop that is not at rest is told', (await text(here, '#advice')).includes('not at rest'), await text(here, '#advice'));
await here.fill('#c-ki', '0.11');
await here.fill('#c-kp', '0.62');
await here.click('#modes button[value=run]');
await frame(here);
check('and back', (await metrics()) === before);

// --- The cursor --------------------------------------------------------------------------------
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
const drawn = (act) => here.evaluate((what) => {
    window.drawn = 0;
    if (what === 'redraw') {
        window.tuner.redraw();
    }
    return window.drawn;
}, act);
const whole = await drawn('redraw');
check(`the plots are drawn by ${whole} calls, each time the same`, whole > 100 && (await drawn('redraw')) === whole);
await drawn();
const box = await here.locator('#plots canvas').first().boundingBox();
const legend = await text(here, 'figcaption');
for (const x of [100, 160, 250, 333]) {
    await here.mouse.move(box.x + x, box.y + 60);
}
const marks = () => here.locator('#plots .cursor').evaluateAll((all) => all.map((one) => (one.hidden ? null : one.getBoundingClientRect().x)));
const moved = await here.evaluate(() => window.drawn);
check('moving the pointer draws nothing', moved === 0, `${moved} calls`);
check('the cursor is where the pointer is, in each pane', (await marks()).length === 4 && (await marks()).every((x) => x !== null && Math.abs(x - box.x - 333) < 1.5), `${await marks()}, not ${box.x + 333}`);
check('and the legend has its values', (await text(here, 'figcaption')) !== legend);
await here.mouse.move(box.x + 300, 2);
check('away from the plots there is none', (await marks()).every((x) => x === null) && (await text(here, 'figcaption')) === legend);
await here.fill('#c-kp', '0.7');
await frame(here);
check('a gain draws', (await here.evaluate(() => window.drawn)) >= whole);
await here.focus('#plots');
await here.evaluate(() => window.scrollTo(0, document.body.scrollHeight));
await here.waitForSelector('#mini', { state: 'visible' });
await press(here, 'ArrowLeft');
check('the small plot has it, too', await here.isVisible('#mini .cursor'));
await press(here, 'Escape');
check('until Escape', !(await here.isVisible('#mini .cursor')));

// --- Three steps ---------------------------------------------------------------------------------
await here.evaluate(() => window.scrollTo(0, 0));
const shown = () => here.isVisible('#tour');
const steps = await here.locator('#tour li button').allTextContents();
check('three steps at first', await shown() && steps.join() === '1 Your plant,2 Tune,3 Take', steps.join());
const leads = [];
for (const i of [0, 1, 2]) {
    await here.locator('#tour li button').nth(i).focus();
    await press(here, 'Enter');
    leads.push(await here.evaluate(() => (document.activeElement.id || document.activeElement.value)));
}
check('each leads to its place', leads.join() === 'own,c-calm,copy', leads.join());
await press(here, 'Tab');
check('and the keyboard goes on from there', (await here.evaluate(() => document.activeElement.id)) === 'save');
await here.click('#presets button[value=an964]');
await here.locator('#tour li button').nth(1).click();
check('a plant without a slider has its gains', (await here.evaluate(() => document.activeElement.id)) === 'c-kp');
await here.click('#tour-done');
check('dismissed, they are gone', !(await shown()) && (await here.evaluate(() => document.activeElement.value)) === 'an964');
await here.reload();
await here.waitForSelector('body[data-ready]');
check('for good', !(await shown()));
const refusing = await open('', {}, { newPage: async (options) => {
    const page = await here.context().browser().newPage(options);
    await page.addInitScript(() => Object.defineProperty(window, 'localStorage', { get: () => { throw new Error('no storage'); } }));
    return page;
} });
await refusing.click('#tour-done');
check('without storage, too, as long as the page is open', !(await refusing.isVisible('#tour')));
checkNone('and without an error', refusing.noted.errors);
checkNone('no error', here.noted.errors);
await finish();
