// SPDX-License-Identifier: MIT
// Elements.

export function find(selector) {
    return document.querySelector(selector);
}

// Attributes with a dash, `role` and `style` are set as such, others as properties.
export function make(name, more = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(more)) {
        if (key.includes('-') || key === 'role' || key === 'style' || key === 'scope') {
            made.setAttribute(key, value);
        } else {
            made[key] = value;
        }
    }
    made.append(...children);
    return made;
}

// Puts children in place without touching those that are the same text.
export function setText(place, text) {
    if (place.textContent !== text) {
        place.textContent = text;
    }
}

// Files that are chosen by an input or dropped on a part of the page, and texts that are dropped.
export function listenForFiles(section, input, { onFile, onText }) {
    input.addEventListener('change', async () => {
        await onFile(input.files[0]);
        input.value = ''; // the same file again is a change, too
    });
    const over = (is) => (event) => {
        event.preventDefault();
        section.classList.toggle('over', is);
    };
    section.addEventListener('dragover', over(true));
    section.addEventListener('dragleave', over(false));
    section.addEventListener('drop', (event) => {
        over(false)(event);
        const [file] = event.dataTransfer.files;
        return file ? onFile(file) : onText(event.dataTransfer.getData('text'));
    });
}

// A table of texts or elements; the first column names its row. Numbers stand
// right, under each other.
export function table(caption, head, rows) {
    const cell = (value, at) => {
        const made = at === 0 ? make('th', { scope: 'row' }) : make('td');
        made.append(value);
        return made;
    };
    return make('table', {},
        make('caption', { textContent: caption }),
        make('thead', {}, make('tr', {}, ...head.map((text) => make('th', { scope: 'col', textContent: text })))),
        make('tbody', {}, ...rows.map((row) => {
            const made = make('tr', {}, ...row.cells.map(cell));
            made.className = row.chosen ? 'chosen' : '';
            return made;
        })));
}

// An empty canvas as sharp as the screen: its context in CSS pixels, width and height, which
// the browser need not be asked for where they are known.
export function blank(canvas, width = canvas.clientWidth, height = canvas.clientHeight) {
    const ratio = window.devicePixelRatio || 1;
    const [across, down] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== across || canvas.height !== down) {
        [canvas.width, canvas.height] = [across, down];
    }
    const context = canvas.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    return { context, width, height };
}
