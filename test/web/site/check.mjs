// SPDX-License-Identifier: MIT
// The site in headless Chromium, over a server of this program's own, so that no request leaves
// the host:
//
//   check.mjs SITE          one walk: the search, a table, the system's dark mode
//   check.mjs SITE all      what else a person does, and every page: nothing moves sideways on
//                           a phone, and axe-core has nothing to say in light or dark
//   check.mjs SITE PAGE...  these pages, as index.html
import { createServer } from 'node:http';
import { readFileSync, readdirSync, existsSync, statSync } from 'node:fs';
import { extname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { browser, check, checkNone, finish, PATIENCE, violations } from '../browser/browser.mjs';

const [site, ...named] = process.argv.slice(2);
const PHONE = { width: 390, height: 844 }; // pixels
const DESK = { width: 1300, height: 900 };
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json', '.png': 'image/png', '.svg': 'image/svg+xml' };

const server = createServer((request, response) => {
    const path = join(site, decodeURIComponent(new URL(request.url, 'http://host').pathname));
    const found = existsSync(path) && statSync(path).isFile();
    // The script of the search's words is half of what a page loads: it is taken once.
    response.writeHead(found ? 200 : 404, { 'content-type': TYPES[extname(path)] ?? 'text/plain', 'cache-control': 'max-age=3600' });
    response.end(found ? readFileSync(path) : 'not found');
}).listen(0, '127.0.0.1');
await new Promise((resolve) => server.on('listening', resolve));
const host = `http://127.0.0.1:${server.address().port}`;

const context = await (await browser()).newContext({ reducedMotion: 'reduce' });
context.setDefaultTimeout(PATIENCE);
const [away, errors] = [[], []];
context.on('request', (request) => request.url().startsWith(host) || /^(data|blob|file):/.test(request.url()) || away.push(request.url()));
context.on('response', (response) => response.status() >= 400 && errors.push(`${response.status()} ${response.url()}`));

async function tab(address, viewport = DESK) {
    const page = await context.newPage();
    page.on('pageerror', (error) => errors.push(`${page.url()}: ${error.message}`));
    page.on('console', (message) => message.type() === 'error' && errors.push(`${page.url()}: ${message.text()}`));
    await page.setViewportSize(viewport);
    await page.goto(address);
    return page;
}

// --- A walk -----------------------------------------------------------------------

// Word, and the page that one of its first five results must be of. search.mjs has more.
const WORDS = [['fixpid_pid_track', 'include/fixpid_pid.h.html'], ['deadband', 'docs/recipes.html']];

async function searches(base) {
    const page = await tab(`${base}/index.html`);
    const lost = [];
    for (const [word, wanted] of WORDS) {
        await page.fill('.md-search__input', '');
        await page.locator('.md-search__input').pressSequentially(word);
        await page.waitForFunction((address) => [...document.querySelectorAll('.md-search-result__item')].slice(0, 5).some((item) => item.querySelector('a').href.includes(address)),
            wanted, { timeout: PATIENCE / 4 }).catch(() => lost.push(word));
    }
    await page.close();
    return lost;
}

async function sorting() {
    const page = await tab(`${host}/docs/data/cost_steps.csv.html`);
    const table = page.locator('table', { has: page.getByRole('button', { name: 'worst found', exact: true }) }).first();
    const column = (await table.locator('th').allInnerTexts()).findIndex((text) => text.trim() === 'worst found');
    const values = async () => (await table.locator(`tbody td:nth-child(${column + 1})`).allInnerTexts()).map(Number);
    const before = await values();
    const ascending = [...before].sort((one, other) => one - other);
    const problems = before.length < 50 || String(before) === String(ascending) ? ['the table is short, or was sorted before'] : [];
    for (const wanted of [ascending, [...ascending].reverse()]) {
        await table.getByRole('button', { name: 'worst found', exact: true }).press('Enter');
        problems.push(...(String(await values()) === String(wanted) ? [] : [`sorted: ${await values()}`]));
    }
    await page.goto(`${host}/docs/data/claims.csv.html`);
    problems.push(...(await page.locator('th button').count() === 4 ? [] : ['a CSV file is no table that can be sorted']));
    await page.close();
    return problems;
}

// On a dark page a picture is dark, and what is drawn on it is light.
async function pictures() {
    const page = await tab(`${host}/docs/controller.html`);
    const problems = [];
    await page.evaluate(() => document.body.setAttribute('data-md-color-scheme', 'slate'));
    for (const picture of await page.locator('article img').all()) {
        const seen = `data:image/png;base64,${(await picture.screenshot()).toString('base64')}`;
        const [mean, most] = await page.evaluate(async (address) => {
            const image = new Image();
            image.src = address;
            await image.decode();
            const canvas = new OffscreenCanvas(image.width, image.height).getContext('2d');
            canvas.drawImage(image, 0, 0);
            const { data } = canvas.getImageData(0, 0, image.width, image.height);
            const green = data.filter((_, i) => i % 4 === 1);
            return [green.reduce((sum, value) => sum + value, 0) / green.length, Math.max(...green.slice(0, 100000))];
        }, seen);
        if (mean > 64 || most < 160) {
            problems.push(`${await picture.getAttribute('src')}: light ${mean}, at most ${most} of 255`);
        }
    }
    await page.close();
    return problems;
}

// A person whose system is dark gets a dark page.
async function system() {
    const problems = [];
    for (const [colorScheme, wanted] of [['dark', 'slate'], ['light', 'default']]) {
        const person = await (await browser()).newContext({ colorScheme }); // who was not here before
        const page = await person.newPage();
        await page.goto(`${host}/index.html`);
        const scheme = await page.evaluate(() => document.body.getAttribute('data-md-color-scheme'));
        problems.push(...(scheme === wanted ? [] : [`${colorScheme}: ${scheme}`]));
        await person.close();
    }
    return problems;
}

// On a phone a row's name stays while its numbers move.
async function names() {
    const page = await tab(`${host}/docs/data/cost_steps.csv.html`, PHONE);
    const places = await page.evaluate(() => {
        const box = document.querySelector('.md-typeset__scrollwrap');
        const cell = box.querySelector('tbody td');
        const before = cell.getBoundingClientRect().left;
        box.scrollLeft = 300;
        return { moved: box.scrollLeft, by: before - cell.getBoundingClientRect().left, wide: cell.getBoundingClientRect().width };
    });
    await page.close();
    return places.moved === 300 && places.by < 20 && places.wide < PHONE.width / 2 ? [] : [JSON.stringify(places)];
}

// --- Pages --------------------------------------------------------------------------

// What axe-core asks where only the colours are others, and where only the places are.
const COLOURS = ['color-contrast', 'link-in-text-block'];
const PLACES = ['scrollable-region-focusable', 'aria-hidden-focus', 'target-size'];

// What all pages have around their article, which axe-core reads on the first page.
const TEMPLATE = ['.md-header', '.md-tabs', '.md-sidebar--primary', '.md-footer'];

// Pages that show a source file are alike: one of them is enough for axe-core.
const isSource = (name) => /^(examples|port|sim|test|tools)\//.test(name);

// In the page: of a long table or program the first lines are like the others, and axe-core takes
// milliseconds for each.
function shorten() {
    document.querySelectorAll('tbody').forEach((one) => [...one.rows].slice(6).forEach((row) => row.remove()));
    document.querySelectorAll('article pre code').forEach((one) => [...one.querySelectorAll('span[class]')].slice(25).forEach((word) => word.replaceWith(word.textContent)));
}

async function readPages(pages) {
    const [wide, light, dark] = [[], [], []];
    const firstSource = pages.find(isSource);
    const page = await tab(`${host}/index.html`); // one tab keeps what it has read of the theme
    for (const name of pages) {
        await page.setViewportSize(PHONE);
        await page.goto(`${host}/${name}`);
        const width = await page.evaluate(() => document.documentElement.scrollWidth);
        wide.push(...(width > PHONE.width ? [`${name}: ${width} pixels`] : []));
        if (!isSource(name) || name === firstSource) {
            const without = name === 'index.html' ? [] : TEMPLATE;
            await page.evaluate(shorten);
            light.push(...(await violations(page, PLACES, without)).map((text) => `${name} on a phone: ${text}`));
            await page.setViewportSize(DESK);
            await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
            light.push(...(await violations(page, undefined, without)).map((text) => `${name}: ${text}`));
            await page.evaluate(() => document.body.setAttribute('data-md-color-scheme', 'slate'));
            dark.push(...(await violations(page, COLOURS, without)).map((text) => `${name}: ${text}`));
        }
    }
    await page.close();
    checkNone(`nothing moves sideways at ${PHONE.width} pixels`, wide);
    checkNone('axe-core in light', light);
    checkNone('axe-core in dark', dark);
}

if (named.length === 0) {
    checkNone('the search finds words', await searches(host));
    checkNone('a page is dark where the system is', await system());
    checkNone('a table is sorted by keys', await sorting());
} else if (named[0] === 'all') {
    checkNone('the search finds them from a file, too', await searches(pathToFileURL(site).href));
    checkNone('names of rows stay on a phone', await names());
    checkNone('pictures are dark on a dark page', await pictures());
    // The page for what is not there has no place; the tuner has tests of its own.
    const all = readdirSync(site, { recursive: true }).filter((name) => extname(name) === '.html' && name !== '404.html' && !name.startsWith('tuner/')).sort();
    check('pages', all.length > 40, `only ${all.length}`);
    await readPages(all);
} else {
    await readPages(named);
}
checkNone('no request leaves the host', away);
checkNone('no error', errors);
server.close();
await finish();
