// SPDX-License-Identifier: MIT
// The five figures that matter and their change, kept runs in the page and in its link, and the
// load alone, against what an integral has to do for a load.
import { check, checkNone, choose, finish, fragment, frame, moduleOf, open, press, stale, text } from './harness.mjs';

const { PRESETS, fragmentOf, ofLink } = await moduleOf('state');
const { keptWith, keyFigures, runOf } = await moduleOf('runs');
const { loadAlone, loadFigures, restText } = await moduleOf('load');
const { run, startEngine } = await moduleOf('engine');
const { marginsOf } = await moduleOf('margins');
await startEngine();

// --- Kept runs and figures, without a browser -----------------------------------------
const figures = (s) => {
    const found = run(s);
    return keyFigures(s, found.metrics, marginsOf(s, found.results));
};
const links = ['p=flow&kp=1', 'p=flow&kp=1.5&unit=a%26b~c', 'p=axis&kp=2&events=load_1_-0.1_0~load_2_0_0', 'p=own&plant=2&gain=5'].map((one) => fragmentOf(ofLink(one)));
const all = { ...ofLink('p=oven&kp=3'), kept: links };
checkNone('four kept runs come back from a link', ofLink(fragmentOf(all)).kept.filter((one, i) => one !== links[i]));
check('no fifth', ofLink(`p=oven&kept=${[...links, 'p=spring'].map(encodeURIComponent).join(';')}`).kept.length === 4);
check('a fifth that is kept takes the oldest one’s place', keptWith(all).join() === [...links.slice(1), 'p=oven&kp=3'].join(), keptWith(all).join());
check('the same run is kept once', keptWith({ ...ofLink(links[0]), kept: links }).join() === [...links.slice(1), links[0]].join());
check('a kept run keeps none', ofLink(`p=oven&kept=${encodeURIComponent(`p=flow&kept=${encodeURIComponent('p=axis')}`)}`).kept.join() === 'p=flow');
checkNone('a link that makes no sense makes no error', ['p=flow&kept=%', 'p=flow&kept=;;;', 'p=flow&kept=p%3Dflow%26kp%3D900', `p=flow&kept=${'x'.repeat(1e5)}`, 'p=nonsense', '&&&=',
    'p=oven&kp=NaN&ki=1e999&unit=%E0%A4%A', 'p=flow&events=setpoint_1~load_x_y~bad', 'p=axis&rate=-5', 'p=flow&duration=1e9&rate=1e9', 'p=oven&t1=0&t2=0', 'p=an964&sensor_bits=99', 'p=motor&gain=1e300']
    .filter((odd) => ofLink(odd).kept.length > 4 || !(run(ofLink(odd)).n < 0 || figures(ofLink(odd)).length >= 4)));
check('a refused one has no figures', runOf('p=flow&kp=900') === null);

const flow = ofLink('p=flow');
const { n, series } = run(flow);
let iae = 0;
for (let i = 0; i < n; i++) {
    iae += Math.abs(series.VALUE_TRUE[i] - flow.SENSOR_LOW - series.SETPOINT[i] * flow.SENSOR_RANGE / (2 ** flow.SENSOR_BITS - 1)) / flow.RATE;
}
const found = run(flow).metrics;
check(`IAE ${found.iae.toFixed(3)} is the sum of the errors’ sizes`, Math.abs(found.iae - iae) < 1e-9 * iae, `${iae}`);

// The change is the difference of what is shown, within its last digit.
const before = figures(flow);
const after = figures({ ...ofLink('p=flow&kp=1.2'), kept: ['p=flow'] });
check('five figures, and nothing kept, no change', before.map(([name]) => name).join() === 'Overshoot,Settled,Load,Ms,Phase margin' && before.every(([, , change]) => change === ''), before.join());
const number = (said) => Number(said.replace('−', '-').replace(/[^-\d.].*$/, ''));
for (const [i, [name, value, change]] of after.entries()) {
    const difference = number(value) - number(before[i][1]);
    const size = change === '±0' ? 0 : number(change.slice(1)) * (change[0] === '−' ? -1 : 1);
    check(`${name}: ${before[i][1]} to ${value} is ${change}`, change !== '' && Math.abs(size - difference) <= 0.02 * Math.abs(difference) + 0.11, `${difference}`);
}
check('a run in another unit is no run to compare with', figures({ ...flow, kept: ['p=oven'] }).every(([, , change]) => change === ''));
check('a pendulum has its base’s way', figures(ofLink('p=an964'))[0][0] === 'Base’s way');

// --- The load alone, without a browser -----------------------------------------------------
const sum = (values) => values.reduce((total, one) => total + one, 0);
// The integral ends at what the load takes: ki times the sum of the errors. A motor's load of
// 0.08 N m is 0.08 / 0.05 A, by 2.4 ohms 3.84 V, of 24 V 160 counts of 1000.
for (const [link, counts] of [['p=flow', 150], ['p=axis', 200], ['p=motor', 160], ['p=own', 25.5]]) {
    const { found: { series: all4, results }, lead } = loadAlone(ofLink(`${link}&noise=0`));
    const done = sum([...all4.SETPOINT.slice(lead)].map((goal, i) => goal - all4.MEASUREMENT[lead + i])) * results.KI / 2 ** 24;
    const moved = all4.OUTPUT.at(-1) - all4.OUTPUT[lead - 1];
    check(`${link}: the integral takes ${done.toFixed(1)} counts, and the output ${moved}`, Math.abs(done / counts - 1) < 0.03 && Math.abs(moved - done) < 0.03 * Math.abs(done) + 2, `not ${counts}`);
}
const quiet = ofLink('p=flow&noise=0');
const alone = loadAlone(quiet);
const { most, back, at } = loadFigures(alone);
const goal = alone.found.series.SETPOINT[0] * 100 / 4095;
const errors = alone.found.series.VALUE_TRUE.slice(alone.lead).map((value) => Math.abs(value - goal));
const behind = Math.round(back * quiet.RATE);
check(`the load takes it ${most.toFixed(2)} away, as at the end of its scene`, Math.abs(most / run(quiet).metrics.load - 1) < 0.05 && Math.abs(errors[Math.round(at * quiet.RATE)] - most) < 1e-9);
check(`it is back after ${back} s`, behind > 0 && errors.slice(behind).every((one) => one <= most / 10 + 1e-9) && errors[behind - 1] > 0.99 * most / 10);
check('it meets the setpoint before it, and no other', new Set(alone.found.series.SETPOINT).size === 1 && Math.abs(goal - 65) < 0.02 &&
    loadAlone({ ...quiet, events: [{ at: 40, what: 'SETPOINT', a: 20 }, { at: 30, what: 'LOAD', a: -0.1 }] }).s.SETPOINT === 50, `${goal}`);
check('a scene without a load gets one', loadAlone({ ...quiet, events: [] }).s.events[0].a === -0.1);
checkNone('each preset is at rest before', PRESETS.map(({ preset }) => preset).filter((preset) => restText(loadAlone(ofLink(`p=${preset}`))) !== null));
check('one that is not is told', /^The loop is not at rest/.test(restText(loadAlone({ ...quiet, KI: 0.004 })) ?? ''));
const long = loadAlone(ofLink('p=flow&duration=1000'));
check(`a long scene ends in time, with ${long.found.n} steps`, long.found.n > 1000 && long.found.n <= 20000 && long.s.DURATION === long.found.n / 20);

// --- In the browser ------------------------------------------------------------------
const here = await open('p=flow');
const set = async (id, value) => {
    await here.fill(id, value);
    await frame(here);
};
const row = (name) => here.locator('#runs tbody tr').filter({ has: here.locator('th', { hasText: new RegExp(`^${name}$`) }) });
check('nothing is kept at first', !(await here.isVisible('#runs')));
await here.click('#keep');
await set('#c-kp', '1.2');
const shown = await text(here, '#key');
checkNone('the figures above the plot are these', after.filter(([name, value, change]) => !shown.includes(`${name}${value} ${change}`)).map((one) => `${one} is not in ${shown}`));
await here.click('#keep');
await set('#c-kp', '2');
const legend = await text(here, 'figcaption');
check('both are drawn', legend.includes('kept A') && legend.includes('kept B'), legend);
const cells = await row('B').locator('td').allTextContents();
const fresh = await open('p=flow&kp=1.2');
const own = await fresh.locator('#metrics > div', { hasText: 'IAE' }).locator('dd').textContent();
const wanted = ['1.20', '0.110', '0.170', ...await fresh.locator('#key dd').allTextContents(), own].join();
await fresh.close();
check('a kept run has all its figures', cells.slice(2).join() === wanted, `${cells.slice(2)} / ${wanted}`);
checkNone('a link has the kept runs, and nothing is stale', await stale(here));
await choose(here, 'oven');
await frame(here);
check('another plant keeps them in the table, but draws none of them', await row('A').count() === 1 && await row('Now').count() === 1 && !(await text(here, 'figcaption')).includes('kept'));
await here.click('#runs button[aria-label="Use A"]');
await frame(here);
await here.waitForFunction(() => location.hash.slice(1) === window.tuner.fragmentOf(window.tuner.currentState()));
check('a kept run can be used again', (await fragment(here)).startsWith('p=flow&kept='), await fragment(here));
await here.click('#runs button[aria-label="Drop A"]');
await frame(here);
check('and dropped', await row('B').count() === 0 && (await row('A').locator('td').nth(2).textContent()) === '1.20');
await press(here, 'Control+z');
await here.waitForFunction(() => window.tuner.currentState().kept.length === 2);
check('Ti is beside ki', /^Ti 5\.64 s$/.test(await text(here, '.control:has(#c-ki) em')) && /^Td 0\.274 s$/.test(await text(here, '.control:has(#c-kd) em')), await text(here, '.control:has(#c-ki) em'));
await here.click('#open-tools');
check('costs are said to be bounds', (await text(here, '#chips-text')).includes('at most, by the code’s bound') && (await text(here, '#chips caption')).startsWith('At most, at 20 steps'));

const metrics = () => text(here, '#key');
const inScene = await metrics();
await here.click('#modes button[value=load]');
await frame(here);
check('a button shows the load alone', (await here.getAttribute('#modes button[value=load]', 'aria-pressed')) === 'true' && /^Load, at most.*Back within a tenth of it/.test(await metrics()) && !(await here.isVisible('#flags')), await metrics());
const first = await metrics();
await set('#c-kp', '1');
const anew = await open(await fragment(here));
await anew.click('#modes button[value=load]');
check('it follows a gain, as a page does that is opened anew', (await metrics()) !== first && (await text(anew, '#key')) === await metrics() && (await text(anew, 'figcaption')) === await text(here, 'figcaption'));
await anew.close();
await set('#c-ki', '0.004');
check('a loop that is not at rest is told', (await text(here, '#advice')).includes('not at rest'), await text(here, '#advice'));
await set('#c-ki', '0.11');
await set('#c-kp', '0.62');
await here.click('#modes button[value=run]');
await frame(here);
check('and back', (await metrics()) === inScene, `${await metrics()} / ${inScene}`);
checkNone('no error', here.noted.errors);
await finish();
