// SPDX-License-Identifier: MIT
// One walk of a user through the page, by keyboard alone: a plant, its gains, the autotuner, a
// sensor that is read with a comma, the header and a link. Nothing is loaded on the way.
import { readFileSync } from 'node:fs';
import { check, checkNone, finish, fragment, frame, open, press, stale, text, WORK } from './harness.mjs';

const BYTES_MAX = 220000;
const source = readFileSync(`${WORK}/index.html`);
check(`the page is ${source.length} bytes`, source.length <= BYTES_MAX, `above ${BYTES_MAX}`);
checkNone('it has no address to load from', [...source.toString().matchAll(/(?:src|href)="(?!data:)[^"]*"|@import|https?:\/\/[^\s"']+/g)].map((one) => one[0]));

const here = await open();
const headerHas = async (words) => (await text(here, '#header')).includes(words);

// Tabs until the focus is on what the selector finds; false if it never is.
async function tabTo(selector) {
    for (let i = 0; i < 300; i++) {
        await here.keyboard.press('Tab');
        if (await here.evaluate((wanted) => document.activeElement.matches(wanted), selector)) {
            return true;
        }
    }
    return false;
}

check('a plant of one’s own is the first', (await here.inputValue('#preset')) === 'own' && await here.isVisible('#plant #recording'));
check('an example', await tabTo('#preset'));
await press(here, 'L', 'a', 'g');
check('it is shown', (await here.inputValue('#preset')) === 'flow' && await headerHas('FIXPID_PID_GAINS(0.62'));
check('kp', await tabTo('#c-kp'));
await press(here, 'Control+A', '1', ',', '5');
check('what is typed is in the header', await headerHas('384u'), await text(here, '#header'));
const before = await text(here, '#header');
check('one Tab further is ki, as the arrow keys do what a slider does', await tabTo('input') && await here.evaluate(() => document.activeElement.id === 'c-ki'));
await press(here, 'ArrowUp', 'ArrowUp');
check('it moves', (await text(here, '#header')) !== before && Number(await here.inputValue('#c-ki')) > 0.11);
check('the slider from calm to quick', await tabTo('#c-calm'));
await press(here, 'ArrowRight');
check('moves them all', Number(await here.inputValue('#c-kp')) < 1.5);
check('the loop’s name', await tabTo('#loop'));
await press(here, 'b', 'e', 'd', '-');
check('is in the header, as far as C has such a name', await headerHas('#define LOOP_BED_GAINS_H 0x') && (await text(here, '#loop-why')) === '“bed-” is not a C identifier: use letters, digits and _.' && (await text(here, '#file')).startsWith('loop_bed_gains.h'));
await press(here, 'Tab');
checkNone('nothing is stale', await stale(here));

await here.evaluate(() => document.activeElement.blur());
check('autotune', await tabTo('#modes button[value=tune]'));
await press(here, 'Enter');
check('the model is told', /^Measured after .* s, .* steps: gain 4\.\d+, lag 8\.\d+ s, delay \d.* s; output 500 holds the setpoint/.test(await text(here, '#found')), await text(here, '#found'));
check('a rule', await tabTo('#rules button[aria-label="Use PI, safe 16"]'));
await press(here, 'Enter');
check('it is in use', (await here.inputValue('#c-kd')) === '0' && (await here.getAttribute('#modes button[value=run]', 'aria-pressed')) === 'true');
check('and its loop is stable', /stable/.test(await text(here, '#margins')) && !/unstable/.test(await text(here, '#margins')), await text(here, '#margins'));

await here.evaluate(() => document.activeElement.blur());
check('an event', await tabTo('#flags button'));
const at = await here.getAttribute('#flags button', 'aria-label');
await press(here, 'ArrowRight');
check('it moves in time', (await here.getAttribute('#flags button', 'aria-label')) !== at);
await press(here, 'Delete');
check('it is removed, and the next one has the focus', (await here.locator('#flags button').count()) === 1 && await here.evaluate(() => document.activeElement.matches('#flags button')));
await press(here, 'Control+z');
check('it is back', (await here.locator('#flags button').count()) === 2);
check('the cursor', await tabTo('#plots'));
const end = await text(here, 'figcaption');
await press(here, 'Home');
check('it moves', (await text(here, 'figcaption')) !== end);
check('what happens', await tabTo('[data-title^="What happens"] summary'));
await press(here, 'Enter');
check('a new event', await tabTo('#events > button'));
await press(here, 'Enter');
check('it is there', (await here.locator('#flags button').count()) === 3);

await here.fill('#c-kp', '900');
await frame(here);
check('a refusal is said, and takes the header', (await text(here, '#advice')).includes('above 127.996') && (await text(here, '#header')) === '' && await here.isDisabled('#copy'));
await here.fill('#c-kp', '2.5');
await frame(here);
const linked = await open(await fragment(here));
check('a link has the settings', (await linked.inputValue('#c-kp')) === '2.5' && (await text(linked, '#header')) === (await text(here, '#header')) && await headerHas('640u'));
checkNone('no request but the file', [here, linked].flatMap(({ noted }) => noted.requests.filter((url, i) => (i > 0 || !url.startsWith('file:')) && !/^(data:|blob:)/.test(url))));
checkNone('no error', [...here.noted.errors, ...linked.noted.errors]);
await finish();
