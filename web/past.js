// SPDX-License-Identifier: MIT
// What was shown before, and the page's link. A change becomes an entry and the link
// when nothing more has changed for a while: a browser refuses too many links in too
// short a time. Where it takes none, undo and redo work all the same.

const QUIET_MS = 300;
const TRAVEL_MS = 500; // after which the browser has no such entry, as it forgets old ones

// `fragment()` is that of what is shown, `go(fragment)` shows another. Returns { later,
// settle, travel, arrived }.
export function createPast({ fragment, go }) {
    let entries = []; // fragments; the browser's history state has which one
    let at = -1;
    let waiting = 0; // for quiet, or 0
    let travelling = 0;

    function write(way) {
        try {
            history[way]({ at }, '', `#${entries[at]}`);
        } catch {
            // The link stays an older one until the browser takes the next.
        }
    }

    // What is shown is an entry, and the link is its own, from now on.
    function settle() {
        clearTimeout(waiting);
        waiting = 0;
        const now = fragment();
        if (now !== entries[at]) {
            entries = [...entries.slice(0, at + 1), now];
            at += 1;
            write(at === 0 ? 'replaceState' : 'pushState');
        }
    }

    function later() {
        clearTimeout(waiting);
        waiting = setTimeout(settle, QUIET_MS);
    }

    function show(to) {
        at = to;
        go(entries[at]);
        if (location.hash.slice(1) !== entries[at]) {
            write('replaceState');
        }
        settle();
    }

    // By the browser's history, so that Back and Forward stay in step with it.
    function travel(way) {
        settle();
        const to = at + way;
        if (entries[to] === undefined) {
            return;
        }
        if (history.state?.at !== at) {
            show(to);
            return;
        }
        history.go(way);
        clearTimeout(travelling);
        travelling = setTimeout(() => at !== to && show(to), TRAVEL_MS);
    }

    // The browser shows another link: one of the entries, or one that was written.
    function arrived() {
        const now = location.hash.slice(1);
        const to = history.state?.at;
        if (now === fragment()) {
            return;
        }
        if (entries[to] === now) {
            clearTimeout(travelling);
            show(to);
        } else {
            go(now);
            if (fragment() !== entries[at]) {
                entries = [...entries.slice(0, at + 1), fragment()];
                at += 1;
            }
            write('replaceState');
            settle();
        }
    }

    return { later, settle, travel, arrived };
}

// Which way a key goes, or 0. In a field these keys are the browser's own.
export function wayOfKey(event) {
    const typed = event.target.matches('textarea, input:not([type=range], [type=checkbox])');
    if (typed || event.altKey || !(event.ctrlKey || event.metaKey)) {
        return 0;
    }
    const key = event.key.toLowerCase();
    if (key === 'z') {
        return event.shiftKey ? 1 : -1;
    }
    return key === 'y' ? 1 : 0;
}
