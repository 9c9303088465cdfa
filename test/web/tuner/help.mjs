// SPDX-License-Identifier: MIT
// Help: each number, option and figure has a sentence and a link, each link's document
// and heading exist, and it opens and closes by keyboard.
import { existsSync, readFileSync } from 'node:fs';
import { check, checkNone, finish, frame, moduleOf, open, press } from './harness.mjs';

const { HELP, documentOf } = await moduleOf('help');

const slug = (heading) => heading.toLowerCase().replace(/[^\w\- ]/g, '').replaceAll(' ', '-');
const headings = (name) => [...readFileSync(`docs/${name}.md`, 'utf8').matchAll(/^#+ (.*)$/gm)].map(([, heading]) => slug(heading));
checkNone(`${Object.keys(HELP).length} links lead to a heading`, Object.values(HELP).map(([, link]) => link)
    .filter((link) => !existsSync(`docs/${link.split('#')[0]}.md`) || !headings(link.split('#')[0]).includes(link.split('#')[1])));
checkNone('each help is one sentence', Object.entries(HELP).filter(([, [sentence]]) => !/^[A-Z].{15,150}\.$/.test(sentence) || /[.!?] [A-Z]/.test(sentence)).map(([key]) => key));
check('on the site it is a page, in the sources a document', documentOf('tuning#tuning', { href: 'file:///a/site/tuner/index.html' }) === '../docs/tuning.html#tuning' &&
    documentOf('tuning#tuning', { href: 'file:///a/build/tuner/index.html' }) === '../../docs/tuning.md#tuning');

const here = await open('p=own');
const without = await here.evaluate(() => {
    const name = (one) => one.querySelector('label, dt').textContent;
    return [...document.querySelectorAll('#panel .control, #options div, #key > div')].filter((one) => !one.querySelector('.help')).map(name);
});
checkNone('each number, option and figure has help', without);
await here.focus('.control:has(#c-kp) .help');
await press(here, 'Enter');
check('Enter opens it', await here.isVisible('#help') && (await here.locator('#help p').textContent()) === HELP.KP[0]);
const box = await here.locator('#help').boundingBox();
check('within the window', box.x >= 0 && box.y >= 0 && box.x + box.width <= 1360 && box.y + box.height <= 1000, JSON.stringify(box));
check('its link has the focus', (await here.evaluate(() => document.activeElement.getAttribute('href'))) === documentOf(HELP.KP[1], { href: here.url() }));
await press(here, 'Escape');
check('Escape closes it and the focus is back', !(await here.isVisible('#help')) && (await here.evaluate(() => document.activeElement.getAttribute('aria-label'))) === 'What is kp?');
await here.focus('#key .help');
await here.evaluate(() => window.tuner.change({ KP: 2 }));
await frame(here);
check('a figure’s mark keeps the focus while the figure changes', (await here.evaluate(() => document.activeElement.getAttribute('aria-label'))) === 'What is Overshoot?');
checkNone('no error', here.noted.errors);
await finish();
