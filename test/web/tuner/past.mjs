// SPDX-License-Identifier: MIT
// What was shown before, in Chromium: undo and redo by keys and by the browser, the link, and a
// browser that takes no more links or has forgotten old ones.
import { check, checkNone, choose, finish, open, press, stale, text } from './harness.mjs';

const here = await open('p=flow');
await here.evaluate(() => {
    for (const name of ['pushState', 'replaceState']) {
        const own = history[name].bind(history);
        history[name] = (...more) => {
            if (window.refuses) {
                throw new Error('too many');
            }
            own(...more);
        };
    }
});
const linked = (part) => here.waitForFunction((wanted) => location.hash.includes(wanted), part);
const until = (kp) => here.waitForFunction((wanted) => window.tuner.currentState().KP === wanted, kp);
const kept = () => here.evaluate(() => history.length);
const undo = () => press(here, 'Control+z');
const redo = () => press(here, 'Control+y');

// One entry: what comes next is behind a while of quiet.
async function change(kp) {
    await here.fill('#c-kp', String(kp));
    await here.focus('#work input[aria-label="kp, slider"]');
    await here.waitForTimeout(400);
}

const before = await kept();
await here.fill('#c-kp', '0.9');
check('no link before 300 ms of quiet', await here.evaluate(() => !location.hash.includes('kp=')));
await change(1);
await linked('kp=1');
check('then one for all changes', await kept() === before + 1);
await change(2);
const ways = [['keys', undo, redo], ['other keys', undo, () => press(here, 'Control+Shift+z')], ['the browser', () => here.goBack(), () => here.goForward()]];
for (const [name, back, on] of ways) {
    await back();
    await until(1);
    const header = await text(here, '#header');
    await on();
    await until(2);
    check(`${name}: undone and done again`, header.includes('256u') && (await text(here, '#header')).includes('512u'), header);
}

// The value of kp after each act.
for (const [name, ...steps] of [
    ['undo ends at the first', [undo, 1], [undo, 0.62], [undo, 0.62]], ['redo at the last', [redo, 1], [redo, 2], [redo, 2]],
    ['a change forgets what could be redone', [undo, 1], [() => change(3), 3], [redo, 3], [undo, 1], [redo, 3]],
    ['a link that is typed is an entry', [() => here.evaluate(() => { location.hash = 'p=flow&kp=5'; }), 5], [undo, 3], [redo, 5]],
    ['a browser that takes no link', [() => here.evaluate(() => { window.refuses = true; }), 5], [() => change(6), 6], [() => change(7), 7], [undo, 6], [undo, 5], [redo, 6], [redo, 7]],
    ['a browser that forgets entries', [() => here.evaluate(() => { [window.refuses, history.go] = [false, () => {}]; }), 7], [() => change(8), 8], [() => change(9), 9], [undo, 8], [undo, 7], [redo, 8]],
]) {
    for (const [act, kp] of steps) {
        await act();
        await until(kp);
        await here.waitForTimeout(100);
    }
    const last = await here.evaluate(() => window.tuner.currentState().KP);
    check(name, last === steps.at(-1)[1], `kp is ${last}`);
}

await choose(here, 'oven');
await linked('p=oven');
await undo();
await until(8);
checkNone('another plant can be undone, and nothing is stale', await stale(here));
await here.locator('#work input[aria-label="kp, slider"]').dblclick({ position: { x: 20, y: 8 } });
await until(0.62); // a double click resets a slider
checkNone('no error', here.noted.errors);
await finish();
