// SPDX-License-Identifier: MIT
// What the tests of pages share: a browser, and lines `ok` and `FAILED`. What it
// imports is in the folder that the variable `browser` names: tools/lib/build/browser.sh.
import { createRequire } from 'node:module';

const require = createRequire(`${process.env.browser}/package.json`);
const { chromium } = require('playwright-core');

export const AXE = require.resolve('axe-core/axe.min.js');

// Milliseconds for a page to do something, on a machine that does other things, too.
export const PATIENCE = 120000;

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
export const launch = (...more) => chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium-headless-shell',
    args: ['--disable-gpu', ...(root ? ['--no-sandbox'] : []), ...more],
});
let started = null;
export const browser = () => (started ??= launch()); // one for all pages, where there are some

// What axe-core has against the page as it is shown; by `rules` only, if there are any, and
// `without` what these selectors find. Of what is good it need not make a list.
export async function violations(page, rules, without = []) {
    if (!(await page.evaluate(() => 'axe' in globalThis))) {
        await page.addScriptTag({ path: AXE });
    }
    const options = { ...(rules ? { runOnly: rules } : {}), resultTypes: ['violations'] };
    const { violations: found } = await page.evaluate(([exclude, how]) =>
        globalThis.axe.run({ exclude }, how), [without.map((one) => [one]), options]);
    return found.map(({ id, nodes }) => `${id} (${nodes.length}): ${nodes[0].html.slice(0, 120)}`);
}

export async function finish() {
    await (await started)?.close();
    process.exitCode = failures > 0 ? 1 : 0;
}
