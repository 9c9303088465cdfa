// SPDX-License-Identifier: MIT
// What the tests of the page share: a browser, and lines `ok` and `FAILED`.
import { createRequire } from 'node:module';

const require = createRequire(`${process.env.browser}/package.json`);
const { chromium } = require('playwright-core');

export const AXE = require.resolve('axe-core/axe.min.js');
export const WORK = 'build/tuner';
export const PAGE = `file://${process.cwd()}/${WORK}/index.html`;

let failures = 0;

export function check(name, good, why = '') {
    console.log(good ? `ok ${name}` : `FAILED ${name}: ${why}`);
    failures += good ? 0 : 1;
}

// Lists what differs, or nothing.
export function checkNone(name, found) {
    check(name, found.length === 0, found.slice(0, 5).join('; '));
}

// In a container the user is root, whom Chromium's sandbox does not serve.
const root = process.getuid() === 0;
const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--disable-gpu', ...(root ? ['--no-sandbox'] : [])],
});

// A page that notes its errors and requests in `page.noted`.
export async function open(fragment = '', options = {}) {
    const page = await browser.newPage({ viewport: { width: 1360, height: 1000 }, ...options });
    page.noted = { errors: [], requests: [] };
    page.on('pageerror', (error) => page.noted.errors.push(error.message));
    page.on('console', (message) => message.type() === 'error' && page.noted.errors.push(message.text()));
    page.on('request', (request) => page.noted.requests.push(request.url().slice(0, 80)));
    await page.goto(`${PAGE}${fragment ? '#' : ''}${fragment}`);
    await page.waitForSelector('body[data-ready]');
    return page;
}

export async function finish() {
    await browser.close();
    process.exitCode = failures > 0 ? 1 : 0;
}

// The same numbers in each run.
export function random(seed) {
    let state = seed;
    return () => {
        state = (state * 48271) % 2147483647;
        return state / 2147483647;
    };
}
