// SPDX-License-Identifier: MIT
// What is taken along: a run as CSV, PNG and SVG, all settings as JSON, which comes back
// in, and what the header says of where it is from.
import { readFileSync } from 'node:fs';
import { check, checkNone, choose, finish, fragment, frame, moduleOf, open, stale, text } from './harness.mjs';

const { fragmentOf, ofLink, PRESETS } = await moduleOf('state');
const { csvOf, jsonOf, stateOfJson } = await moduleOf('saved');
const { wholeHeaderOf: headerOf } = await moduleOf('header');
const { run, startEngine } = await moduleOf('engine');
const { marginsOf } = await moduleOf('margins');
await startEngine();

// --- Without a browser ---------------------------------------------------------------
const links = [...PRESETS.map((one) => `p=${one.preset}`), 'p=own&plant=2&gain=-5&unit=a%26b%22&rule=PID', 'p=flow&kp=1.5&kept=p%3Dflow;p%3Daxis%26kp%3D2',
    'p=oven&loop=bed_2&events=setpoint_1.5_30~limits_2_-5_100~auto_3', 'p=flow&events='].map((one) => fragmentOf(ofLink(one)));
const written = (link) => {
    const s = ofLink(link);
    const found = run(s);
    return jsonOf(s, found.metrics, marginsOf(s, found.results), headerOf(s, found.results));
};
checkNone(`${links.length} settings come back from JSON`, links.map((link) => [link, stateOfJson(written(link))])
    .filter(([link, { state }]) => !state || fragmentOf(state) !== link).map(([link, { state, why }]) => `${link}: ${why ?? fragmentOf(state)}`));
const edited = JSON.parse(written('p=flow'));
edited.settings.kp = 2.5;
check('an edited number is taken', stateOfJson(JSON.stringify(edited)).state.KP === 2.5);
const wrong = { 'no JSON': '{', 'another JSON': '{"a": 1}', nothing: '', 'a list': '[]', null: 'null', 'no settings': '{"format": "fixpid tuner", "settings": null}' };
checkNone('what is none is refused with a sentence', Object.entries(wrong).filter(([, one]) => !/^This .*\.$/.test(stateOfJson(one).why ?? '')).map(([name]) => name));
const odd = [{ preset: '__proto__', kp: {} }, { preset: 'flow', kp: 'NaN', ki: [1], events: [null, 7, { what: 'x' }, { what: 'LOAD', at: 'a' }], kept: [null, {}, 5] },
    { preset: 'own', plant: 1e9, rate: 1e300, duration: -1 }];
checkNone('odd settings run', odd.filter((settings) => {
    const { state } = stateOfJson(JSON.stringify({ format: 'fixpid tuner', settings }));
    return !(run(state).n > 0) || state.events.some((event) => !Number.isFinite(event.at));
}).map((one) => JSON.stringify(one)));

const flow = ofLink('p=flow');
const found = run(flow);
const rows = csvOf(flow, found).trimEnd().split('\n').map((line) => line.split(','));
check(`a CSV has ${rows.length} lines`, rows.length === found.n + 1 && rows.every((row) => row.length === rows[0].length));
checkNone('each number of it is the run’s', rows.slice(1).map((row, i) => [i, row.map(Number), [i / flow.RATE,
    ...['SETPOINT', 'MEASUREMENT', 'OUTPUT', 'P', 'I', 'D', 'VALUE_TRUE', 'VALUE_TWIN'].map((name) => found.series[name][i])]])
    .filter(([, row, wanted]) => row.join() !== wanted.join()).map(([i]) => `line ${i}`));
check('its head names them', rows[0].join() === 'time_s,setpoint,measurement,output,p,i,d,value,value_in_double', rows[0].join());

const says = (link) => {
    const s = ofLink(link);
    return headerOf(s, run(s).results);
};
const header = says('p=flow&kp=1.5&unit=°%2F&kept=p%3Doven');
check('a header says plant and margins', /\/\/ Plant: 100 \/ at full drive, lag 8 s and 0\.6 s, dead time 1\.2 s\n\/\/ Margins: Ms \d\.\d+, phase \d+\.?\d* degrees, gain \d/.test(header), header);
check('and its settings, without kept runs', header.includes('\n// The page has it with #p=flow&kp=1.5&unit=%C2%B0%2F\n'), header);
check('and an unstable loop as such', says('p=flow&kp=30').includes('// Margins: unstable'));
checkNone('it is ASCII', PRESETS.filter((one) => /[^\x20-\x7E\n]/.test(says(`p=${one.preset}`))).map((one) => one.preset));

// --- In the browser ------------------------------------------------------------------
const here = await open('p=flow&kp=1.5&kept=p%3Dflow', { acceptDownloads: true });
async function taken(id) {
    if (id.startsWith('#take')) {
        await here.locator('#menu').evaluate((menu) => { menu.open = true; });
    }
    const [download] = await Promise.all([here.waitForEvent('download'), here.click(id)]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}
const png = await taken('#take-png');
check(`${png.name} is a picture of ${png.bytes.length} bytes`, png.name === 'loop.png' && png.bytes.subarray(0, 4).toString('latin1') === '\x89PNG' &&
    png.bytes.readUInt32BE(16) === 1800 && png.bytes.length > 20000);
const svg = await taken('#take-svg');
const drawn = await here.evaluate((source) => {
    const parsed = new DOMParser().parseFromString(source, 'image/svg+xml');
    return { wrong: parsed.querySelector('parsererror')?.textContent ?? '', root: parsed.documentElement.tagName,
        paths: parsed.querySelectorAll('path').length, texts: [...parsed.querySelectorAll('text')].map((one) => one.textContent) };
}, svg.bytes.toString());
check(`${svg.name} is well formed`, svg.name === 'loop.svg' && drawn.wrong === '' && drawn.root === 'svg', drawn.wrong);
check('it has all curves and their names', drawn.paths > 30 && ['Measurement', 'setpoint', 'kept A', 'Output', 'P', 'I', 'D'].every((name) => drawn.texts.includes(name)), drawn.texts.join());
checkNone('it has no number that is none', [...svg.bytes.toString().matchAll(/NaN|undefined|Infinity/g)].map((one) => one[0]));
const csv = await taken('#take-csv');
check(csv.name, csv.name === 'loop.csv' && csv.bytes.toString() === csvOf(ofLink('p=flow&kp=1.5'), run(ofLink('p=flow&kp=1.5'))));
const json = await taken('#take-json');
const before = await fragment(here);
await choose(here, 'oven');
await here.setInputFiles('#open-json', { name: json.name, mimeType: 'application/json', buffer: json.bytes });
await here.waitForFunction((wanted) => window.tuner.fragmentOf(window.tuner.currentState()) === wanted, before);
check('a JSON comes back in', json.name === 'loop.json' && (await text(here, '#said')) === 'loop.json is open.', await text(here, '#said'));
checkNone('nothing is stale', await stale(here));
await here.setInputFiles('#open-json', { name: 'other.json', mimeType: 'application/json', buffer: Buffer.from('{"a": 1}') });
await here.waitForFunction(() => document.querySelector('#said').textContent.startsWith('This JSON was not'));
check('another JSON changes nothing', (await fragment(here)) === before);
const gains = await taken('#save');
check('the header is a file', gains.name === 'loop_gains.h' && gains.bytes.toString() === (await text(here, '#header')));
await here.fill('#loop', 'Bed');
await frame(here);
check('a loop’s name is its file’s, too, and in its link', (await taken('#save')).name === 'loop_bed_gains.h' && /loop=Bed/.test(await fragment(here)));
await here.fill('#c-kp', '900');
await frame(here);
checkNone('what is refused is not taken', (await Promise.all(['png', 'svg', 'csv', 'json'].map(async (id) => [id, await here.isDisabled(`#take-${id}`)]))).filter(([, off]) => !off));
await here.fill('#c-kp', '1');
await frame(here);
await here.emulateMedia({ media: 'print' });
const paper = await here.evaluate(() => ({ shown: ['#plots', '#header', '#key'].every((one) => document.querySelector(one).offsetHeight > 0),
    hidden: ['#plant', '#gains', '#share', '#take-png'].every((one) => document.querySelector(one).offsetHeight === 0),
    cut: [...document.querySelectorAll('#header')].filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.id) }));
check('on paper there are plots, figures and header, and no buttons', paper.shown && paper.hidden, JSON.stringify(paper));
checkNone('and nothing of them is cut', paper.cut);
checkNone('no error', here.noted.errors);
await finish();
