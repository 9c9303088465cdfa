// SPDX-License-Identifier: MIT
// Three steps for who is here for the first time: each leads to its place on the page. They
// stand in the page, cover nothing, and do not come back once they are dismissed.
import { find, make } from './dom.js';

const KEY = 'fixpid-tour';
// [name, sentence, where it leads to: the first of these that is shown].
const TOUR = [
    ['2 Your plant', 'Paste a step that you recorded, or write its numbers.', ['#recording']],
    ['3 Gains', 'Move one slider from calm to quick.', ['#c-calm', '#c-kp']],
    ['4 Header', 'Copy the header into your firmware.', ['#copy']],
];

// A browser may refuse to remember.
function remembered(act) {
    try {
        return act(window.localStorage);
    } catch {
        return null;
    }
}

// The place is in the middle of the window, has the focus, and its part of the page is marked
// for a moment.
function lead(selectors) {
    const place = selectors.map(find).find((one) => one !== null);
    const part = place.closest('[data-title]') ?? place.closest('.card');
    part.open = true;
    place.focus({ preventScroll: true });
    part.scrollIntoView({ block: 'nearest' });
    part.classList.remove('led');
    part.getBoundingClientRect(); // so that it is marked anew
    part.classList.add('led');
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
        find('#preset').focus();
    });
    place.replaceChildren(make('ol', {}, ...steps), done);
}
