// SPDX-License-Identifier: MIT
// What was shown before: entries, undo, redo and the link with a browser that is
// played here; then in Chromium by mouse and by keyboard, and where it takes no link.
import { check, checkNone, finish, frame, moduleOf, open, press, stale, text } from './harness.mjs';

const { createPast } = await moduleOf('past');

// A browser's history as a list, and its timers by hand.
function played({ refuses = false, forgets = Infinity } = {}) {
    const stack = [{ state: null, hash: '#a' }];
    const timers = new Map();
    const calls = [];
    let [at, timer, shown, said] = [0, 0, 'a', null];
    const write = (name, put) => (state, _, hash) => {
        calls.push(`${name} ${hash}`);
        if (refuses) {
            throw new Error('too many');
        }
        put({ state, hash });
    };
    const tick = (ms) => {
        for (const [id, [due, what]] of [...timers]) {
            if (due <= ms) {
                timers.delete(id);
                what();
            }
        }
    };
    const browser = {
        setTimeout: (what, ms) => timers.set(++timer, [ms, what]) && timer,
        clearTimeout: (id) => timers.delete(id),
        location: { get hash() { return stack[at].hash; } },
        history: {
            get state() { return stack[at].state; },
            pushState: write('push', (entry) => { stack.splice(at + 1, Infinity, entry); at += 1; }),
            replaceState: write('replace', (entry) => { stack[at] = entry; }),
            go: (way) => { // what it has forgotten is never reached
                if (stack[at + way] !== undefined && at + way > stack.length - 1 - forgets) {
                    at += way;
                    past.arrived();
                }
            },
        },
    };
    const past = createPast({ browser, fragment: () => shown, go: (fragment) => { shown = fragment; past.later(); }, changed: (can) => { said = can; } });
    past.settle();
    return { past, browser, calls, tick, stack, timers, change: (to) => { shown = to; past.later(); }, now: () => shown, can: () => said,
        link: () => stack[at].hash, typed: (hash) => { stack.splice(at + 1, Infinity, { state: null, hash }); at += 1; past.arrived(); } };
}

function expect(name, got, wanted) {
    check(name, JSON.stringify(got) === JSON.stringify(wanted), `${JSON.stringify(got)}, not ${JSON.stringify(wanted)}`);
}

{
    const one = played();
    one.change('b');
    one.change('c');
    one.tick(299);
    expect('no link before 300 ms of quiet', one.link(), '#a');
    check('one timer waits for quiet', one.timers.size === 1);
    one.tick(300);
    expect('then one for all changes', one.calls, ['replace #a', 'push #c']);
    one.change('d');
    expect('what waits can be undone', one.can(), { undo: true, redo: false });
    one.past.travel(-1);
    expect('undo is to what was settled', [one.now(), one.link(), one.can()], ['c', '#c', { undo: true, redo: true }]);
    one.past.travel(-1);
    one.past.travel(-1);
    expect('and no further than the first', [one.now(), one.can()], ['a', { undo: false, redo: true }]);
    one.past.travel(1);
    one.past.travel(1);
    one.past.travel(1);
    expect('redo is to the last', [one.now(), one.link()], ['d', '#d']);
    one.browser.history.go(-2);
    expect('the browser’s Back is undo', [one.now(), one.can()], ['a', { undo: false, redo: true }]);
    one.change('e');
    one.tick(300);
    expect('a change forgets what could be redone', [one.can(), one.stack.map(({ hash }) => hash)], [{ undo: true, redo: false }, ['#a', '#e']]);
    one.typed('#f');
    expect('a link that is typed is an entry', [one.now(), one.can()], ['f', { undo: true, redo: false }]);
    one.past.travel(-1);
    expect('and can be undone', [one.now(), one.link()], ['e', '#e']);
}
for (const [name, options] of [['takes no link', { refuses: true }], ['forgets entries', { forgets: 1 }]]) {
    const one = played(options);
    for (const to of ['b', 'c', 'd']) {
        one.change(to);
        one.tick(300);
    }
    one.past.travel(-1);
    one.tick(500);
    one.past.travel(-1);
    one.tick(500);
    expect(`a browser that ${name}: undo`, one.now(), 'b');
    one.past.travel(1);
    one.tick(500);
    expect(`a browser that ${name}: redo`, one.now(), 'c');
}

// --- In Chromium ------------------------------------------------------------------
const runs = (here, key) => here.evaluate((name) => window.tuner.currentState()[name], key);
const linked = (here, part) => here.waitForFunction((wanted) => location.hash.includes(wanted), part);
const until = (here, kp) => here.waitForFunction((wanted) => window.tuner.currentState().KP === wanted, kp);
{
    const here = await open('p=flow');
    check('nothing can be undone at first', await here.isDisabled('#undo') && await here.isDisabled('#redo'));
    await here.fill('#c-kp', '1');
    await linked(here, 'kp=1');
    await here.fill('#c-kp', '2');
    await linked(here, 'kp=2');
    await here.click('#undo');
    await until(here, 1);
    check('a button undoes', (await text(here, '#header')).includes('256u'), await text(here, '#header'));
    await here.click('#redo');
    await until(here, 2);
    await here.focus('#panel input[aria-label="kp, slider"]');
    await press(here, 'Control+z');
    await until(here, 1);
    await press(here, 'Control+y');
    await until(here, 2);
    await press(here, 'Control+z');
    await until(here, 1);
    await press(here, 'Control+Shift+z');
    await until(here, 2);
    check('keys undo and redo', (await here.inputValue('#c-kp')) === '2');
    await here.goBack();
    await until(here, 1);
    await here.goForward();
    await until(here, 2);
    check('Back and Forward do', (await here.inputValue('#c-kp')) === '2');
    await here.click('#presets button[value=oven]');
    await linked(here, 'p=oven');
    await here.click('#undo');
    await until(here, 2);
    check('another plant can be undone', (await runs(here, 'preset')) === 'flow');
    checkNone('and nothing is stale', await stale(here));
    const slider = here.locator('#panel input[aria-label="kp, slider"]');
    await slider.dblclick({ position: { x: 20, y: 8 } });
    await frame(here);
    check('a double click resets a slider', (await runs(here, 'KP')) === 0.62, `${await runs(here, 'KP')}`);
    checkNone('no error', here.noted.errors);
    await here.close();
}
{
    const here = await open('p=flow');
    await here.evaluate(() => {
        window.asked = 0;
        for (const name of ['replaceState', 'pushState']) {
            history[name] = () => {
                window.asked += 1;
                throw new DOMException('too many', 'SecurityError');
            };
        }
    });
    for (const kp of ['1', '9', '1.5']) {
        await here.fill('#c-kp', kp);
        await here.waitForFunction((before) => window.asked > before, await here.evaluate(() => window.asked));
    }
    check('a refused link leaves the rest right', (await text(here, '#header')).includes('384u') && (await text(here, '.control:has(#c-kp) em')) === '384 / 256', await text(here, '#header'));
    check('the link is the old one', new URL(here.url()).hash === '#p=flow', here.url());
    checkNone('with a refused link nothing is stale', await stale(here));
    await here.click('#undo');
    await until(here, 9);
    check('with a refused link undo works', (await text(here, '#header')).includes(`${9 * 256}u`));
    checkNone('and is no error', here.noted.errors);
    await here.close();
}
await finish();
