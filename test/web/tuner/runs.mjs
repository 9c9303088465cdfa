// SPDX-License-Identifier: MIT
// The five figures that matter and their change, kept runs in the page and in its link,
// and that the plot is always in view.
import { check, checkNone, finish, fragment, frame, moduleOf, open, press, stale, text } from './harness.mjs';

const { fragmentOf, ofLink } = await moduleOf('state');
const { keptWith, keyFigures, runOf } = await moduleOf('runs');
const { run, startEngine } = await moduleOf('engine');
const { marginsOf } = await moduleOf('margins');
const { metricsOf } = await moduleOf('metrics');
await startEngine();

// --- Without a browser ------------------------------------------------------------
const figures = (s) => {
    const found = run(s);
    return keyFigures(s, metricsOf(s, found), marginsOf(s, found.results));
};
const links = ['p=flow&kp=1', 'p=flow&kp=1.5&unit=a%26b~c', 'p=axis&kp=2&events=load_1_-0.1_0~load_2_0_0', 'p=own&plant=2&gain=5'].map((one) => fragmentOf(ofLink(one)));
const all = { ...ofLink('p=oven&kp=3'), kept: links };
checkNone('four kept runs come back from a link', ofLink(fragmentOf(all)).kept.filter((one, i) => one !== links[i]));
check('no fifth', ofLink(`p=oven&kept=${[...links, 'p=spring'].map(encodeURIComponent).join(';')}`).kept.length === 4);
check('a fifth that is kept takes the oldest one’s place', keptWith(all).join() === [...links.slice(1), 'p=oven&kp=3'].join(), keptWith(all).join());
check('the same run is kept once', keptWith({ ...ofLink(links[0]), kept: links }).join() === [...links.slice(1), links[0]].join());
check('a kept run keeps none', ofLink(`p=oven&kept=${encodeURIComponent(`p=flow&kept=${encodeURIComponent('p=axis')}`)}`).kept.join() === 'p=flow');
for (const odd of ['p=flow&kept=%', 'p=flow&kept=;;;', 'p=flow&kept=p%3Dflow%26kp%3D900', `p=flow&kept=${'x'.repeat(1e5)}`]) {
    const s = ofLink(odd);
    const many = figures(s);
    check(`a kept run that is none makes no error: ${odd.slice(0, 40)}`, many.length === 5 && s.kept.length <= 4);
}
check('a refused one has no figures', runOf('p=flow&kp=900') === null);

const flow = ofLink('p=flow');
const { n, series } = run(flow);
const top = 2 ** flow.SENSOR_BITS - 1;
let iae = 0;
for (let i = 0; i < n; i++) {
    iae += Math.abs(series.VALUE_TRUE[i] - flow.SENSOR_LOW - series.SETPOINT[i] * flow.SENSOR_RANGE / top) / flow.RATE;
}
const found = metricsOf(flow, run(flow));
check(`IAE ${found.iae.toFixed(3)} is the sum of the errors’ sizes`, Math.abs(found.iae - iae) < 1e-9 * iae, `${iae}`);

// The change is the difference of what is shown, within its last digit.
const before = figures(flow);
const after = figures({ ...ofLink('p=flow&kp=1.2'), kept: ['p=flow'] });
check('five figures', before.map(([name]) => name).join() === 'Overshoot,Settled,Load,Ms,Phase margin', before.join());
check('nothing kept, no change', before.every(([, , change]) => change === ''));
const number = (said) => Number(said.replace('−', '-').replace(/[^-\d.].*$/, ''));
for (const [i, [name, value, change]] of after.entries()) {
    const difference = number(value) - number(before[i][1]);
    const size = change === '±0' ? 0 : number(change.slice(1)) * (change[0] === '−' ? -1 : 1);
    check(`${name}: ${before[i][1]} to ${value} is ${change}`, change !== '' && Math.abs(size - difference) <= 0.02 * Math.abs(difference) + 0.11, `${difference}`);
}
check('a run in another unit is no run to compare with', figures({ ...flow, kept: ['p=oven'] }).every(([, , change]) => change === ''));
check('a pendulum has its base’s way', figures(ofLink('p=an964'))[0][0] === 'Base’s way');

// --- In the browser ------------------------------------------------------------------
{
    const here = await open('p=flow');
    const row = (name) => here.locator('#runs tbody tr').filter({ has: here.locator('th', { hasText: new RegExp(`^${name}$`) }) });
    check('nothing is kept at first', !(await here.isVisible('#runs')));
    await here.click('#keep');
    await here.fill('#c-kp', '1.2');
    await frame(here);
    const shown = await text(here, '#key');
    checkNone('the figures above the plot are these', after.filter(([name, value, change]) => !shown.includes(`${name}?${value} ${change}`)).map((one) => `${one} is not in ${shown}`));
    await here.click('#keep');
    await here.fill('#c-kp', '2');
    await frame(here);
    const legend = await text(here, 'figcaption');
    check('both are drawn', legend.includes('kept A') && legend.includes('kept B'), legend);
    const cells = await row('B').locator('td').allTextContents();
    const fresh = await open('p=flow&kp=1.2');
    const [over, settled, load, ms, phase] = await fresh.locator('#key dd').allTextContents();
    const own = await fresh.locator('#metrics > div', { hasText: 'IAE' }).locator('dd').textContent();
    await fresh.close();
    check('a kept run has all its figures', cells.slice(2).join() === ['1.20', '0.110', '0.170', over, settled, load, ms, phase, own].join(), `${cells.slice(2)} / ${[over, settled, load, ms, phase, own]}`);
    checkNone('a link has the kept runs, and nothing is stale', await stale(here));
    await here.click('#presets button[value=oven]');
    await frame(here);
    check('another plant keeps them in the table', await row('A').count() === 1 && await row('Now').count() === 1);
    check('but draws none of them', !(await text(here, 'figcaption')).includes('kept'));
    await here.click('#runs button[aria-label="Use A"]');
    await frame(here);
    await here.waitForFunction(() => location.hash.slice(1) === window.tuner.fragmentOf(window.tuner.currentState()));
    check('a kept run can be used again', (await fragment(here)).startsWith('p=flow&kept='), await fragment(here));
    await here.click('#runs button[aria-label="Drop A"]');
    await frame(here);
    check('and dropped', await row('B').count() === 0 && (await row('A').locator('td').nth(2).textContent()) === '1.20');
    await here.click('#undo');
    await here.waitForFunction(() => window.tuner.currentState().kept.length === 2);
    check('which can be undone', await row('B').count() === 1);
    check('Ti is beside ki', /, Ti 5\.64 s$/.test(await text(here, '.control:has(#c-ki) em')) && /, Td 0\.274 s$/.test(await text(here, '.control:has(#c-kd) em')), await text(here, '.control:has(#c-ki) em'));
    check('costs are said to be bounds', (await text(here, '#chips-text')).includes('at most, by the code’s bound') && (await text(here, '#chips caption')).startsWith('At most, at 20 steps'));
    checkNone('no error', here.noted.errors);
    await here.close();
}
for (const [name, viewport] of [['a phone', { width: 390, height: 844 }], ['a desk', { width: 1300, height: 800 }]]) {
    const here = await open('p=flow', { viewport });
    check(`${name}: the plot is there once at first`, !(await here.isVisible('#mini')));
    await here.focus('#recording'); // far below
    await here.waitForSelector('#mini', { state: 'visible' });
    const box = await here.locator('#mini').boundingBox();
    check(`${name}: it stays in view, 30 % of the height`, box.y === 0 && Math.abs(box.height - 0.3 * viewport.height) <= 1 && box.width === viewport.width, JSON.stringify(box));
    await here.focus('#c-kp');
    await press(here, 'ArrowUp');
    const field = await here.locator('#c-kp').boundingBox();
    const small = await here.isVisible('#mini') ? (await here.locator('#mini').boundingBox()).height : 0;
    check(`${name}: it does not cover the field`, field.y >= small && field.y + field.height <= viewport.height, `${JSON.stringify(field)}, ${small}`);
    if (small > 0) {
        const picture = () => here.evaluate(() => document.querySelector('#mini canvas').toDataURL());
        const first = await picture();
        await here.fill('#c-kp', '2');
        await frame(here);
        check(`${name}: it follows a gain`, await picture() !== first);
        check(`${name}: with its figures`, (await text(here, '#mini dl')) === (await text(here, '#key')).replaceAll('?', ''));
    }
    await here.evaluate(() => window.scrollTo(0, 0));
    await here.waitForSelector('#mini', { state: 'hidden' });
    checkNone(`${name}: no error`, here.noted.errors);
    await here.close();
}
await finish();
