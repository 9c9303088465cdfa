// SPDX-License-Identifier: MIT
// Three steps for who is here for the first time: each leads to its place on the page. They
// stand in the page, cover nothing, and do not come back once they are dismissed.
import { find, make } from './dom.js';

const KEY = 'fixpid-tour';
// [name, sentence, where it leads to: the first of these that is shown].
const TOUR = [
    ['1 Your plant', 'Take “Your own” and say what your hardware and your plant are, or paste a step that you recorded.', ['#presets button']],
    ['2 Tune', 'Move one slider from calm to quick, ask for an Ms, or take a row of the autotuner.', ['#c-calm', '#c-kp']],
    ['3 Take', 'Copy the header into your firmware: its integers are those that ran here; or connect a board and send them.', ['#copy']],
];

// A browser may refuse to remember.
function remembered(act) {
    try {
        return act(window.localStorage);
    } catch {
        return null;
    }
}

function lead(selectors) {
    const place = selectors.map(find).find((one) => one !== null);
    const section = place.closest('details');
    if (section !== null) {
        section.open = true;
    }
    place.scrollIntoView({ block: 'center' });
    place.focus();
}

export function showTour(place) {
    place.hidden = remembered((storage) => storage.getItem(KEY)) !== null;
    const steps = TOUR.map(([name, sentence, selectors]) => {
        const button = make('button', { type: 'button', textContent: name });
        button.addEventListener('click', () => lead(selectors));
        return make('li', {}, button, ' ', sentence);
    });
    const done = make('button', { type: 'button', id: 'tour-done', className: 'quiet', textContent: 'Dismiss', 'aria-label': 'Dismiss the three steps' });
    done.addEventListener('click', () => {
        place.hidden = true;
        remembered((storage) => storage.setItem(KEY, 'done'));
        find('#presets [aria-pressed=true]').focus();
    });
    place.replaceChildren(make('ol', {}, ...steps), done);
}
