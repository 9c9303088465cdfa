// SPDX-License-Identifier: MIT
// What was shown before: entries, undo, redo and the link with a browser that is
// played here; then in Chromium by mouse and by keyboard.
import { check, checkNone, choose, finish, moduleOf, open, press, stale, text } from './harness.mjs';

const { createPast } = await moduleOf('past');

// A browser's history as a list, and its timers by hand.
function played({ refuses = false, forgets = Infinity } = {}) {
    const stack = [{ state: null, hash: '#a' }];
    const timers = new Map();
    const calls = [];
    let [at, timer, shown] = [0, 0, 'a'];
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
    const past = createPast({ browser, fragment: () => shown, go: (fragment) => { shown = fragment; past.later(); } });
    past.settle();
    return { past, browser, calls, tick, stack, timers, change: (to) => { shown = to; past.later(); }, now: () => shown,
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
    one.past.travel(-1);
    expect('undo is to what was settled', [one.now(), one.link()], ['c', '#c']);
    one.past.travel(-1);
    one.past.travel(-1);
    expect('and no further than the first', one.now(), 'a');
    one.past.travel(1);
    one.past.travel(1);
    one.past.travel(1);
    expect('redo is to the last', [one.now(), one.link()], ['d', '#d']);
    one.browser.history.go(-2);
    expect('the browser’s Back is undo', one.now(), 'a');
    one.change('e');
    one.tick(300);
    expect('a change forgets what could be redone', one.stack.map(({ hash }) => hash), ['#a', '#e']);
    one.typed('#f');
    expect('a link that is typed is an entry', one.now(), 'f');
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
const linked = (here, part) => here.waitForFunction((wanted) => location.hash.includes(wanted), part);
const until = (here, kp) => here.waitForFunction((wanted) => window.tuner.currentState().KP === wanted, kp);
{
    const here = await open('p=flow');
    await here.fill('#c-kp', '1');
    await linked(here, 'kp=1');
    await here.fill('#c-kp', '2');
    await linked(here, 'kp=2');
    await here.focus('#work input[aria-label="kp, slider"]');
    const ways = [['keys', () => press(here, 'Control+z'), () => press(here, 'Control+y')],
        ['other keys', () => press(here, 'Control+z'), () => press(here, 'Control+Shift+z')], ['the browser', () => here.goBack(), () => here.goForward()]];
    for (const [name, undo, redo] of ways) {
        await undo();
        await until(here, 1);
        const back = await text(here, '#header');
        await redo();
        await until(here, 2);
        check(`${name}: undone and done again`, back.includes('256u') && (await text(here, '#header')).includes('512u'), back);
    }
    await choose(here, 'oven');
    await linked(here, 'p=oven');
    await press(here, 'Control+z');
    await until(here, 2);
    checkNone('another plant can be undone, and nothing is stale', await stale(here));
    await here.locator('#work input[aria-label="kp, slider"]').dblclick({ position: { x: 20, y: 8 } });
    await until(here, 0.62); // a double click resets a slider
    checkNone('no error', here.noted.errors);
    await here.close();
}
await finish();
