// SPDX-License-Identifier: MIT
// What the tests of the page share, beside what all pages' tests do.
import { browser, PATIENCE } from '../browser/browser.mjs';

export { AXE, check, checkNone, finish } from '../browser/browser.mjs';

export const WORK = 'build/tuner';
export const PAGE = `file://${process.cwd()}/${WORK}/index.html`;

// A page that notes its errors and requests in `page.noted`.
export async function open(fragment = '', options = {}) {
    const page = await browser.newPage({ viewport: { width: 1360, height: 1000 }, ...options });
    page.setDefaultTimeout(PATIENCE);
    page.noted = { errors: [], requests: [] };
    page.on('pageerror', (error) => page.noted.errors.push(error.message));
    page.on('console', (message) => message.type() === 'error' && page.noted.errors.push(message.text()));
    page.on('request', (request) => page.noted.requests.push(request.url().slice(0, 80)));
    await page.goto(`${PAGE}${fragment ? '#' : ''}${fragment}`);
    await page.waitForSelector('body[data-ready]');
    return page;
}

// The same numbers in each run.
export function random(seed) {
    let state = seed;
    return () => {
        state = (state * 48271) % 2147483647;
        return state / 2147483647;
    };
}
