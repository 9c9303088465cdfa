// SPDX-License-Identifier: MIT
// The site's search without a browser: search.mjs SITE. The theme's own worker is asked what
// people type, and must show a guide first.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import vm from 'node:vm';

const [site] = process.argv.slice(2);

// The page that must be the first result for each of these words.
const QUERIES = {
    'docs/start/index.html': ['getting started'], 'docs/start/glossary.html': ['bumpless', 'kd', 'FOPDT'], 'docs/start/stm32.html': ['STM32', 'FreeRTOS', 'CMake', 'thread safe'],
    'docs/start/esp.html': ['ESP32', 'ESP-IDF'], 'docs/start/mplabx.html': ['MPLAB', 'XC8'], 'docs/start/sdcc.html': ['SDCC'], 'docs/start/zephyr.html': ['Zephyr'],
    'docs/start/arduino.html': ['Arduino Uno', 'PlatformIO'], 'docs/installing.html': ['install', 'download', 'find_package'], 'docs/project.html': ['license', 'roadmap'],
    'docs/choosing.html': ['DCL', 'compare'], 'docs/recipes.html': ['deadband', 'cascade', 'EEPROM', 'interrupt'],
    'docs/scaling.html': ['sample time', 'setpoint weight'], 'docs/tuning.html': ['overshoot', 'Ziegler Nichols', 'autotune'], 'docs/controller.html': ['anti-windup', 'transfer function', 'Laplace', 'backward Euler', 'Tustin', 'bilinear', 'overflow'],
    'docs/migrating.html': ['FastPID', 'PIDMain', 'C18'], 'docs/cost.html': ['flash size'], 'docs/assurance.html': ['MISRA'], 'docs/faults.html': ['watchdog'],
    'python/index.html': ['numpy'], 'docs/chips.html': ['simulator'],
    'include/fixpid_slew.h.html': ['slew'], 'include/fixpid_table.h.html': ['NTC', 'thermistor'], 'docs/python.html': ['gain margin', 'Bode'],
};

// What is in one header only: its page is among the first.
const NAMES = [
    ['fixpid_pid_track', 'include/fixpid_pid.h.html'],
    ['FIXPID_SLEW_RATE', 'include/fixpid_slew.h.html'],
    ['fixpid_tpo_step', 'include/fixpid_tpo.h.html'],
];
const AMONG = 3;

const workers = join(site, 'assets/javascripts/workers');
const worker = readdirSync(workers).find((name) => /^search\..*\.js$/.test(name));
let listener;
let answered;
const world = {
    addEventListener: (_, heard) => { listener = heard; },
    postMessage: (message) => answered(message),
    importScripts: () => { throw new Error('the search wants another language'); },
    console,
};
world.self = world;
vm.runInNewContext(readFileSync(join(workers, worker), 'utf8'), world);

function ask(type, data) {
    return new Promise((resolve) => {
        answered = resolve;
        listener({ data: { type, data } });
    });
}

const { config, docs } = JSON.parse(readFileSync(join(site, 'search/search_index.json'), 'utf8'));
const options = { pipeline: ['trimmer', 'stopWordFilter'], suggestions: false };
await ask(0, { config, docs, options });

let failures = 0;
function judge(name, problem) {
    failures += problem ? 1 : 0;
    console.log(problem ? `FAILED ${name}: ${problem}` : `ok ${name}`);
}

// Pages, the best first.
async function found(words) {
    const { data } = await ask(2, words);
    return data.items.map(([first]) => first.location.replace(/#.*/, ''));
}

for (const [words, wanted] of Object.entries(QUERIES).flatMap(([page, all]) => all.map((one) => [one, page]))) {
    const pages = await found(words);
    judge(`search for ${words}`, pages[0] === wanted ? '' : `${wanted} is not before ${pages.slice(0, 4)}`);
}
for (const [words, wanted] of NAMES) {
    const pages = await found(words);
    judge(`search for ${words}`, pages.slice(0, AMONG).includes(wanted) ? '' : `${wanted} is not among ${pages.slice(0, AMONG)}`);
}
// What stands above a page's first heading: the longest word of it finds the page.
const begun = new Map(docs.filter(({ location }) => location.includes('#')).reverse().map(({ location, text }) => [location.replace(/#.*/, ''), text]));
const lost = [];
for (const [page, text] of begun) {
    const longest = (text.replace(/<[^>]*>/g, ' ').match(/\b[a-z]+\b/g) ?? []).sort((a, b) => b.length - a.length)[0];
    if (longest && !(await found(longest)).includes(page)) {
        lost.push(`${longest} of ${page}`);
    }
}
judge('search for what pages begin with', begun.size < 20 ? `${begun.size} pages` : lost.slice(0, 4).join(', '));
const sources = docs.map(({ location }) => location).filter((name) => /^(examples|port|sim|src|test|tools)\//.test(name));
judge('search without sources', sources.length > 0 ? sources.slice(0, 3).join(' ') : '');
process.exit(failures > 0 ? 1 : 0);
