// SPDX-License-Identifier: MIT
// A number's field: what it reads, without a browser; and by keyboard, in an English
// and a German browser, that it shows what runs.
import { check, checkNone, finish, frame, launch, moduleOf, open, press, text } from './harness.mjs';

const { readNumber, stepped } = await moduleOf('fields');

const NUMBERS = { '2.5': 2.5, '2,5': 2.5, ' 2,5 ': 2.5, '.5': 0.5, ',5': 0.5, '5,': 5, '1e-3': 0.001, '1,5E2': 150, '1/16': 0.0625,
    '1 / 16': 0.0625, '-1/4': -0.25, '−3': -3, '+7': 7, 0: 0 };
const NONE = ['', ' ', '-', '.', ',', 'e3', '1e', '2.5.1', '1,234.56', '1.234,56', '1/0', '0/0', '1//2', '1/2/3', '1e999', 'NaN',
    'Infinity', '0x10', '2 5', '12 °C', '٣', '1_000', '--1'];
checkNone('what is a number is read', Object.entries(NUMBERS).filter(([written, value]) => readNumber(written).value !== value)
    .map(([written, value]) => `“${written}” is ${readNumber(written).value}, not ${value}`));
checkNone('what is none has a reason', NONE.filter((written) => readNumber(written).value !== undefined || !/^[“N].*\.$/.test(readNumber(written).why))
    .map((written) => `“${written}”: ${JSON.stringify(readNumber(written))}`));

const STEPS = [[2.1, 1, {}, 2.12], [2.1, -1, {}, 2.08], [2.1, 10, {}, 2.3], [0.07, 1, {}, 0.0705], [100, 1, {}, 101], [1000, -1, {}, 990],
    [0, 1, { least: 0.25 }, 0.25], [0, -1, { least: 0.25 }, -0.25], [-2.1, 1, {}, -2.08], [12, 1, { whole: true }, 13],
    [0, 10, { whole: true, least: 0.01 }, 10], [1000, 1, { whole: true }, 1010], [1e-5, 1, {}, 1.01e-5]];
checkNone('an arrow moves about 1 %', STEPS.filter(([value, way, how, wanted]) => stepped(value, way, { least: 1, ...how }) !== wanted)
    .map(([value, way, how, wanted]) => `${value} by ${way}: ${stepped(value, way, { least: 1, ...how })}, not ${wanted}`));

const runs = (here, key) => here.evaluate((name) => window.tuner.currentState()[name], key);
const kpOfHeader = async (here) => Number((await text(here, '#header')).match(/FIXPID_PID_GAINS\(([^,]*),/)?.[1]);

// What is wrong if the field, the state and the header are not all this kp.
async function differing(here, wanted) {
    const seen = [Number(await here.inputValue('#c-kp')), await runs(here, 'KP'), await kpOfHeader(here)];
    return seen.every((one) => one === wanted) ? [] : [`field, state and header are ${seen.join(', ')}, not ${wanted}`];
}

for (const lang of ['en-US', 'de-DE']) {
    const browser = await launch(`--lang=${lang}`, `--accept-lang=${lang}`);
    const here = await open('p=oven', { locale: undefined }, browser);
    check(`${lang}: the browser speaks it`, (await here.evaluate(() => navigator.language)) === lang, await here.evaluate(() => navigator.language));

    await here.focus('#c-kp');
    await press(here, 'ArrowUp');
    checkNone(`${lang}: an arrow key`, await differing(here, 2.12));
    await press(here, 'ArrowDown', 'ArrowDown');
    checkNone(`${lang}: and back`, await differing(here, 2.08));
    await press(here, 'Shift+ArrowUp');
    checkNone(`${lang}: ten times that with Shift`, await differing(here, 2.28));
    await press(here, ...new Array(8).fill('ArrowUp'));
    checkNone(`${lang}: eight in one frame or more`, await differing(here, 2.44));

    for (const [typed, wanted] of [['2,5', 2.5], ['2.5', 2.5], ['1e-1', 0.1], ['1/16', 0.0625], ['1,25e0', 1.25]]) {
        await here.focus('#c-kp');
        await press(here, 'Control+A', ...typed);
        check(`${lang}: ${typed} runs, and stays as it is typed`, (await runs(here, 'KP')) === wanted && (await here.inputValue('#c-kp')) === typed, `${await runs(here, 'KP')} ${await here.inputValue('#c-kp')}`);
        await press(here, 'Tab');
        checkNone(`${lang}: ${typed} is ${wanted} when it is left`, await differing(here, wanted));
    }

    await here.focus('#c-kp');
    await press(here, 'Control+A', 'Delete');
    for (const key of '2..7') {
        await press(here, key);
    }
    const [red, why] = await here.evaluate(() => ['#c-kp', '#c-kp-why'].map((id) => getComputedStyle(document.querySelector(id)).color));
    check(`${lang}: what is no number is red, and says why`, red === why && (await here.getAttribute('#c-kp', 'aria-invalid')) === 'true' && (await text(here, '#c-kp-why')) === '“2..7” is no number.' &&
        (await here.getAttribute('#c-kp', 'aria-describedby')) === 'c-kp-why', await text(here, '#c-kp-why'));
    check(`${lang}: and is not used`, (await runs(here, 'KP')) === 2, `${await runs(here, 'KP')}`); // what stood there before the second point
    await press(here, 'Tab');
    checkNone(`${lang}: when it is left, the field shows what runs`, await differing(here, 2));
    check(`${lang}: and what was wrong`, (await text(here, '#c-kp-why')) === '“2..7” is no number. 2 is in use.' &&
        (await here.getAttribute('#c-kp', 'aria-invalid')) === 'false', await text(here, '#c-kp-why'));
    await here.focus('#c-kp');
    await press(here, 'ArrowUp');
    check(`${lang}: until the next number`, (await text(here, '#c-kp-why')) === '');

    // What the page limits is shown as limited.
    await here.evaluate(() => document.querySelectorAll('#work details').forEach((one) => {
        one.open = true;
    }));
    await here.fill('#c-sensor_bits', '99');
    await press(here, 'Enter');
    check(`${lang}: a limited value is shown as it runs`, (await here.inputValue('#c-sensor_bits')) === '15' && (await runs(here, 'SENSOR_BITS')) === 15);
    await press(here, 'ArrowDown');
    check(`${lang}: a whole number moves by whole numbers`, (await here.inputValue('#c-sensor_bits')) === '14');
    await here.locator('#events .at input').first().fill('2,5e2');
    await frame(here);
    check(`${lang}: an event's time reads a comma`, (await here.evaluate(() => window.tuner.currentState().events[0].at)) === 250);
    await here.locator('#events .at input').first().fill('x');
    check(`${lang}: an event's field says why`, (await here.locator('#events .why').first().textContent()) === '“x” is no number.');
    await here.click('#open-tools');
    await here.fill('#s-r25', '10,0');
    await here.click('#choose');
    check(`${lang}: a sensor's field reads a comma`, (await text(here, '#table-found')).startsWith('Worst error 0.146 °C'), await text(here, '#table-found'));
    checkNone(`${lang}: no error`, here.noted.errors);
    await browser.close();
}
await finish();
