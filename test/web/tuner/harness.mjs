// SPDX-License-Identifier: MIT
// What the tests of the page share, beside what all pages' tests do.
import { browser, PATIENCE } from '../browser/browser.mjs';

export { check, checkNone, finish, launch, violations } from '../browser/browser.mjs';

export const WORK = 'build/tuner';
export const PAGE = `file://${process.cwd()}/${WORK}/index.html`;

// A module of the page in Node.
export const moduleOf = (name) => import(`${process.cwd()}/${WORK}/modules/${name}.js`);

// A page that notes its errors and requests in `page.noted`. `before(page)` prepares it.
export async function open(fragment = '', options = {}, within = browser(), before = () => {}) {
    const page = await (await within).newPage({ viewport: { width: 1360, height: 1000 }, ...options });
    page.setDefaultTimeout(PATIENCE);
    page.noted = { errors: [], requests: [] };
    page.on('pageerror', (error) => page.noted.errors.push(error.message));
    page.on('console', (message) => message.type() === 'error' && page.noted.errors.push(message.text()));
    page.on('request', (request) => page.noted.requests.push(request.url().slice(0, 80)));
    await before(page);
    await page.goto(`${PAGE}${fragment ? '#' : ''}${fragment}`);
    await page.waitForSelector('body[data-ready]');
    return page;
}

// After the frame in which the page shows what was changed.
export const frame = (here) => here.evaluate(() => new Promise((done) => {
    requestAnimationFrame(() => requestAnimationFrame(done));
}));

export async function press(here, ...keys) {
    for (const key of keys) {
        await here.keyboard.press(key);
    }
    await frame(here);
}

// Another plant, as its list has it.
export async function choose(here, preset) {
    await here.selectOption('#preset', preset);
    await frame(here);
}

export const text = (here, selector) => here.locator(selector).first().textContent();

// All that a person reads, but what is said in passing, and what a recording allows, which no link has.
function readable() {
    const texts = ['#story', '#advice', '#key', '#metrics', '#runs', '#found', '#rules', '#guard', '#stage', '#margins', '#off', '#header', '#chips-text', '#chips']
        .map((place) => `${place}: ${document.querySelector(place).hidden ? '' : document.querySelector(place).textContent.replace(/^\/\/ (Ms|Warning:|unstable;) .*\n/gm, '')}`);
    const legends = [...document.querySelectorAll('figcaption, #flags, #file')].map((one) => one.textContent);
    const fields = [...document.querySelectorAll('#preset, #work .control input, #loop, #events input, #events select, #options input')]
        .map((one) => (one.type === 'checkbox' ? one.checked : one.inputMode === 'decimal' ? Number(one.value) : one.value));
    return [...texts, ...legends, `notes ${[...document.querySelectorAll('.control em')].map((one) => one.textContent)}`, `fields ${fields}`];
}

// Of what the page shows; its link gets it when nothing more changes.
export const fragment = (here) => here.evaluate(() => window.tuner.fragmentOf(window.tuner.currentState()));

// What differs from a page that is opened anew by the link of this one.
export async function stale(here, tuning = false) {
    const fresh = await open(await fragment(here));
    if (await here.isVisible('#tools')) {
        await fresh.click('#open-tools');
    }
    if (tuning) {
        await fresh.getByRole('button', { name: 'Autotune', exact: true }).click();
    }
    const [a, b] = [await here.evaluate(readable), await fresh.evaluate(readable)];
    await fresh.close();
    const differ = a.filter((text, i) => text !== b[i]).map((text) => `${text} / ${b[a.indexOf(text)]}`);
    return a.length === b.length ? differ : [...differ, `${a.length} texts and ${b.length}`];
}

// The same numbers in each run.
export function random(seed) {
    let state = seed;
    return () => {
        state = (state * 48271) % 2147483647;
        return state / 2147483647;
    };
}
