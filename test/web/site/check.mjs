// SPDX-License-Identifier: MIT
// The site in headless Chromium: check.mjs SITE [PAGE]...
//
// All pages, or those named, over a server of this program's own: no request leaves the
// host, no link is dead, nothing moves sideways on a phone, axe-core has nothing to say
// in light or dark. Of all pages together: the search in a page, the tables, the
// system's dark mode.
import { createServer } from 'node:http';
import { readFileSync, readdirSync, existsSync, statSync } from 'node:fs';
import { dirname, extname, join, relative } from 'node:path';
import { pathToFileURL } from 'node:url';
import { AXE, browser, check, checkNone, finish, PATIENCE, violations } from '../browser/browser.mjs';

const [site, ...named] = process.argv.slice(2);
const PHONE = { width: 390, height: 844 }; // pixels
const DESK = { width: 1300, height: 900 };
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json',
    '.png': 'image/png', '.svg': 'image/svg+xml' };

// Where pages find axe-core: the browser compiles an address once, and a script of a file for each page.
const READER = '/axe.min.js';
const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, 'http://host');
    const path = pathname === READER ? AXE : join(site, decodeURIComponent(pathname));
    const found = existsSync(path) && statSync(path).isFile();
    // The script of the search's words is half of what a page loads: it is taken once.
    const type = TYPES[extname(path)] ?? 'text/plain';
    response.writeHead(found ? 200 : 404, { 'content-type': type, 'cache-control': 'max-age=3600' });
    response.end(found ? readFileSync(path) : 'not found');
}).listen(0, '127.0.0.1');
await new Promise((resolve) => server.on('listening', resolve));
const host = `http://127.0.0.1:${server.address().port}`;

function htmlFiles(folder) {
    return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
        const path = join(folder, entry.name);
        return entry.isDirectory() ? htmlFiles(path) : extname(path) === '.html' ? [relative(site, path)] : [];
    });
}

// The page for what is not there has no place; the tuner has tests of its own.
const all = htmlFiles(site).filter((name) => name !== '404.html' && !name.startsWith('tuner/')).sort();
const pages = named.length > 0 ? named : all;

// What axe-core asks where only the colours are others, and where only the places are.
const COLOURS = ['color-contrast', 'link-in-text-block'];
const PLACES = ['scrollable-region-focusable', 'aria-hidden-focus', 'target-size'];

// Pages that show a source file are alike: one of them is enough for what takes long.
const sources = pages.filter((name) => /^(examples|port|sim|test|tools)\//.test(name));

// What all pages have around their article: axe-core reads it on the first page of each folder.
const TEMPLATE = ['.md-header', '.md-tabs', '.md-sidebar--primary', '.md-footer'];
const folderOf = (name) => (sources.includes(name) ? 'sources' : dirname(name));
const firstOf = (folder) => pages.find((name) => folderOf(name) === folder);
const whole = pages.filter((name) => name === 'index.html' || name === firstOf(folderOf(name)));

// In the page: of rows and of coloured words of programs that differ in what they say only,
// each page keeps a few. Axe-core takes milliseconds for each of thousands.
function thin() {
    const seen = new Map();
    const isFew = (kind) => {
        seen.set(kind, (seen.get(kind) ?? 0) + 1);
        return seen.get(kind) <= 3;
    };
    const kindOf = (word) => [word, word.parentElement, word.closest('div, td, th')]
        .map((one) => `${one?.tagName} ${one?.className} ${one?.getAttribute('style')}`).join();
    for (const [i, body] of document.querySelectorAll('tbody').entries()) {
        for (const row of [...body.rows]) {
            const kind = row.outerHTML.replace(/ (href|id|title|aria-label)="[^"]+"/g, ' $1')
                .replace(/>[^<]*[^<\s][^<]*/g, '>text');
            if (!isFew(`${i} ${kind}`)) {
                row.remove();
            }
        }
    }
    for (const word of document.querySelectorAll('article pre span[class]')) {
        if (word.children.length === 0 && !isFew(kindOf(word))) {
            word.replaceWith(word.textContent);
        }
    }
}

const context = await browser.newContext({ reducedMotion: 'reduce' });
context.setDefaultTimeout(PATIENCE);
const away = [];
const errors = [];
context.on('request', (request) => {
    if (!request.url().startsWith(host) && !/^(data|blob|file):/.test(request.url())) {
        away.push(request.url());
    }
});
context.on('response', (response) => {
    if (response.status() >= 400) {
        errors.push(`${response.status()} ${response.url()}`);
    }
});

async function tab(viewport = DESK) {
    const page = await context.newPage();
    await page.setViewportSize(viewport);
    return page;
}

// Word, and the page that one of its first five results must be of. search.mjs has more.
const WORDS = [
    ['fixpid_pid_track', 'include/fixpid_pid.h.html'],
    ['CMSIS-DSP', 'docs/migrating.html'],
    ['deadband', 'docs/recipes.html'],
];

async function searches(base) {
    const page = await tab();
    const lost = [];
    await page.goto(`${base}/index.html`);
    for (const [word, wanted] of WORDS) {
        await page.fill('.md-search__input', '');
        await page.locator('.md-search__input').pressSequentially(word);
        const found = await page.waitForFunction((wanted) => {
            const results = [...document.querySelectorAll('.md-search-result__item')].slice(0, 5);
            return results.some((item) => item.querySelector('a').href.includes(wanted));
        }, wanted, { timeout: PATIENCE / 4 }).catch(() => undefined);
        if (!found) {
            const first = await page.$$eval('.md-search-result__item > a', (all) => all.map((a) => a.href));
            lost.push(`${word}: ${first.slice(0, 5)}`);
        }
    }
    await page.close();
    return lost;
}

async function sorting() {
    const page = await tab();
    const problems = [];
    await page.goto(`${host}/docs/cost.html`);
    const table = page.locator('table', { has: page.getByRole('button', { name: 'worst found', exact: true }) }).first();
    const column = (await table.locator('th').allInnerTexts()).findIndex((text) => text.trim() === 'worst found');
    const values = async () => (await table.locator(`tbody td:nth-child(${column + 1})`).allInnerTexts()).map(Number);
    const before = await values();
    const ascending = [...before].sort((one, other) => one - other);
    for (const wanted of [ascending, [...ascending].reverse()]) {
        await table.getByRole('button', { name: 'worst found', exact: true }).press('Enter');
        if (String(await values()) !== String(wanted)) {
            problems.push(`sorted: ${await values()}`);
        }
    }
    if (before.length < 50 || String(before) === String(ascending)) {
        problems.push('the table is short, or was sorted before');
    }
    await page.close();
    return problems;
}

// On a dark page a picture is dark, and what is drawn on it is light.
async function pictures() {
    const page = await tab();
    const problems = [];
    await page.goto(`${host}/docs/behaviour.html`);
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

// A person whose system is dark gets a dark page, and can make it light.
async function system() {
    const problems = [];
    for (const [colorScheme, wanted] of [['dark', 'slate'], ['light', 'default']]) {
        const person = await browser.newContext({ colorScheme }); // who was not here before
        const page = await person.newPage();
        await page.goto(`${host}/index.html`);
        const scheme = await page.evaluate(() => document.body.getAttribute('data-md-color-scheme'));
        if (scheme !== wanted) {
            problems.push(`${colorScheme}: ${scheme}`);
        }
        await person.close();
    }
    return problems;
}

// On a phone a row's name stays while its numbers move.
async function names() {
    const page = await tab(PHONE);
    await page.goto(`${host}/docs/cost.html`);
    const places = await page.evaluate(() => {
        const box = document.querySelector('.md-typeset__scrollwrap');
        const cell = box.querySelector('tbody td');
        const before = cell.getBoundingClientRect().left;
        box.scrollLeft = 300;
        const moved = box.scrollLeft;
        return { moved, by: before - cell.getBoundingClientRect().left, wide: cell.getBoundingClientRect().width };
    });
    await page.close();
    const { moved, by, wide } = places;
    return moved === 300 && by < 20 && wide < PHONE.width / 2 ? [] : [JSON.stringify(places)];
}

if (named.length === 0) {
    checkNone('the search finds words', await searches(host));
    checkNone('the search finds them from a file, too', await searches(pathToFileURL(site).href));
    checkNone('a page is dark where the system is', await system());
    checkNone('names of rows stay on a phone', await names());
    checkNone('a table is sorted by keys', await sorting());
    checkNone('pictures are dark on a dark page', await pictures());
    check('pages', pages.length > 40, `only ${pages.length}`);
}

const links = new Map(); // from address to a page that has it
const anchors = new Map(); // of a page
const wide = [];
const light = [];
const dark = [];

// All are shown in one tab, which keeps what it has read of the theme.
const page = await tab(PHONE);
let shown = '';
page.on('pageerror', (error) => errors.push(`${shown}: ${error.message}`));
page.on('console', (message) => message.type() === 'error' && errors.push(`${shown}: ${message.text()}`));

async function read() {
    const without = whole.includes(shown) ? [] : TEMPLATE;
    await page.addScriptTag({ url: `${host}${READER}` });
    light.push(...(await violations(page, PLACES, without)).map((text) => `${shown} on a phone: ${text}`));
    await page.evaluate(thin); // before the page hears that its size is another
    await page.setViewportSize(DESK);
    await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
    light.push(...(await violations(page, undefined, without)).map((text) => `${shown}: ${text}`));
    await page.evaluate(() => document.body.setAttribute('data-md-color-scheme', 'slate'));
    dark.push(...(await violations(page, COLOURS, without)).map((text) => `${shown}: ${text}`));
    await page.setViewportSize(PHONE);
}

for (const name of pages) {
    shown = name;
    await page.goto(`${host}/${name}`);
    for (const address of await page.evaluate(() => [...document.querySelectorAll('a[href]')].map((a) => a.href))) {
        links.set(address, name);
    }
    anchors.set(name, new Set(await page.evaluate(() => [...document.querySelectorAll('[id]')].map((e) => e.id))));
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    if (width > PHONE.width) {
        wide.push(`${name}: ${width} pixels`);
    }
    if (!sources.includes(name) || name === sources[0]) {
        await read();
    }
}
await page.close();

function deadLinks() {
    return [...links].filter(([address]) => {
        if (!address.startsWith(host)) {
            return !/^https?:/.test(address);
        }
        const url = new URL(address);
        const name = decodeURIComponent(url.pathname).slice(1) || 'index.html';
        const id = decodeURIComponent(url.hash.slice(1));
        const there = existsSync(join(site, name)) && statSync(join(site, name)).isFile();
        return !there || (id && anchors.has(name) && !anchors.get(name).has(id));
    }).map(([address, name]) => `${name}: ${address.replace(host, '')}`);
}

checkNone('no link is dead', deadLinks());
checkNone('no request leaves the host', away);
checkNone('no error', errors);
checkNone(`nothing moves sideways at ${PHONE.width} pixels`, wide);
checkNone('axe-core in light', light);
checkNone('axe-core in dark', dark);
server.close();
await finish();
