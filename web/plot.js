// SPDX-License-Identifier: MIT
// Series over time on canvases that share their time axis: a pane for each, its
// legend above it with the values where the cursor is, or at the end.
import { blank, make, setText } from './dom.js';
import { digits } from './format.js';

const GUTTER = 56;
const RIGHT = 14;
const AXIS = 22;

// A color of page.css; asked for once, until the screen's scheme is another.
const colors = new Map();
globalThis.matchMedia?.('(prefers-color-scheme: dark)').addEventListener('change', () => colors.clear());

export function color(name) {
    if (!colors.has(name)) {
        colors.set(name, getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
    }
    return colors.get(name);
}

// A step of 1, 2 or 5 times a power of ten that makes about `count` of them.
export function niceStep(span, count) {
    const rough = Math.max(span, 1e-12) / count;
    const power = 10 ** Math.floor(Math.log10(rough));
    return power * ([1, 2, 5, 10].find((one) => one * power >= rough) ?? 10);
}

// At least two of them.
function ticks(low, high, count) {
    let step = niceStep(high - low, count);
    for (let i = 0; i < 3 && Math.floor(high / step) <= Math.ceil(low / step); i++) {
        step = niceStep(step, 2.5);
    }
    const found = [];
    for (let at = Math.ceil(low / step) * step; at <= high + step * 1e-6; at += step) {
        found.push(Math.abs(at) < step * 1e-6 ? 0 : at);
    }
    return { found, places: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

function extremes(pane) {
    let [low, high] = [Infinity, -Infinity];
    for (const one of pane.series.filter((each) => each.data.length > 0)) {
        for (let i = 0; i < one.data.length; i++) {
            const value = one.data[i];
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
    }
    if (low > high) {
        return [0, 1];
    }
    const least = Math.max(pane.leastSpan ?? 0, 1e-9);
    if (high - low < least) {
        [low, high] = [(low + high - least) / 2, (low + high + least) / 2];
    }
    const room = 0.06 * (high - low);
    return [low - room, high + room];
}

// Builds the panes; returns { element, show(view), cursorAt(seconds or null) }. The first pane is drawn on `mini`, too, while that is shown. The cursor is an element
// above each canvas: moving it draws nothing.
export function createPlots(element, onCursor, mini) {
    const small = { canvas: mini, mark: cursorMark(), values: [] };
    mini.after(small.mark);
    let parts = [];
    let view = null;
    let cursor = null;

    function build(panes) {
        parts = panes.map((pane, i) => {
            const { legend, places } = createLegend(pane);
            const canvas = make('canvas', { 'aria-hidden': 'true', className: i === 0 ? 'tall' : 'low' });
            canvas.addEventListener('pointermove', (event) => moved(event, canvas));
            canvas.addEventListener('pointerdown', (event) => moved(event, canvas));
            canvas.addEventListener('pointerleave', () => onCursor(null));
            return { canvas, legend, places, mark: cursorMark(), key: keyOf(pane), values: [] };
        });
        element.replaceChildren(...parts.map(({ legend, canvas, mark }) => make('figure', { className: 'pane' }, legend, canvas, mark)));
        measure();
    }

    // Sizes are asked for here alone: in between each would have the browser lay out the page.
    function measure() {
        for (const part of [...parts, small]) {
            const { offsetLeft, offsetTop, clientWidth, clientHeight } = part.canvas;
            part.size = { left: offsetLeft, top: offsetTop, width: clientWidth, height: clientHeight };
        }
    }

    function moved(event, canvas) {
        const box = canvas.getBoundingClientRect();
        const width = box.width - GUTTER - RIGHT;
        const part = (event.clientX - box.left - GUTTER) / width;
        onCursor(part < 0 || part > 1 ? null : part * view.duration);
    }

    // Of a view with its first pane alone the others stay as they are.
    function show(next) {
        const first = view !== null && next.panes.length < view.panes.length;
        view = first ? { ...next, panes: [...next.panes, ...view.panes.slice(next.panes.length)] } : next;
        if (parts.map((part) => part.key).join('|') !== view.panes.map(keyOf).join('|')) {
            build(view.panes);
        }
        draw(first);
    }

    function draw(first) {
        if (view === null) {
            return;
        }
        const drawn = (part, pane, hasAxis) => {
            const { width, height } = part.size;
            paintPane(blank(part.canvas, width, height).context, width, height, pane, view, hasAxis);
            part.box = boxOf(part.size, hasAxis);
        };
        view.panes.forEach((pane, i) => {
            parts[i].values = filled(pane).map((one, k) => ({ one, place: parts[i].places[k] }));
            if (i === 0 || !first) {
                drawn(parts[i], pane, i === view.panes.length - 1);
            }
        });
        if (small.size.width > 0) {
            drawn(small, view.panes[0], true);
        }
        placeCursor();
    }

    function placeCursor() {
        for (const { mark, box, values } of [...parts, small]) {
            placeMark(mark, box, cursor, view);
            values.forEach(({ one, place }) => setText(place, digits(valueAt(one, view, cursor), 4)));
        }
    }

    function cursorAt(seconds) {
        cursor = seconds;
        if (view !== null) {
            placeCursor();
        }
    }

    const observer = new ResizeObserver(() => {
        measure();
        draw(false);
    });
    observer.observe(element);
    observer.observe(mini); // it is drawn when it comes to be seen
    measure();
    return { element, show, cursorAt, gutter: GUTTER, right: RIGHT, paint: (context) => paintAll(context, view),
        size: () => [PICTURE_WIDTH, view.panes.reduce((sum, _, i) => sum + CAPTION + heightOf(i, view), 0)] };
}

const filled = (pane) => pane.series.filter((one) => one.data.length > 0);
const keyOf = (pane) => [pane.title, pane.unit, ...filled(pane).map((one) => one.name)].join();

// --- The cursor --------------------------------------------------------------------

function cursorMark() {
    return make('i', { className: 'cursor', 'aria-hidden': 'true', hidden: true });
}

// Where the curves of a canvas are, in what it stands in.
function boxOf({ left, top, width, height }, hasAxis) {
    return { left: left + GUTTER, width: width - GUTTER - RIGHT, top: top + 6, height: height - 6 - (hasAxis ? AXIS : 6) };
}

function placeMark(mark, box, cursor, view) {
    mark.hidden = cursor === null || box === undefined;
    if (!mark.hidden) {
        mark.style.transform = `translate(${box.left + box.width * cursor / view.duration}px, ${box.top}px)`;
        mark.style.height = `${box.height}px`;
    }
}

// Shows `small` while the first pane is out of sight and `needs`, whose sliders move it, is not;
// and keeps what has the focus from under it.
export function followPlots(element, needs, small) {
    const follow = () => {
        const box = element.querySelector('canvas')?.getBoundingClientRect();
        const height = 0.3 * window.innerHeight;
        const there = needs.getBoundingClientRect();
        small.hidden = box === undefined || box.bottom > height || there.bottom < height || there.top > window.innerHeight;
        document.documentElement.classList.toggle('followed', !small.hidden);
    };
    document.addEventListener('scroll', follow, { passive: true });
    window.addEventListener('resize', follow);
    follow();
}

// --- All panes as one picture ---------------------------------------------------

const PICTURE_WIDTH = 900;
const CAPTION = 26;
const LETTER_WIDTH = 7.5; // pixels, about

function heightOf(i, view) {
    return [260, 130, 100, 100][i] + (i === view.panes.length - 1 ? AXIS : 0);
}

function paintCaption(context, pane) {
    let x = GUTTER;
    const write = (text, name, font = '13px') => {
        context.font = `${font} system-ui, sans-serif`;
        context.fillStyle = color(name);
        context.fillText(text, x, CAPTION / 2 + 2);
        x += LETTER_WIDTH * text.length + 12;
    };
    context.textAlign = 'left';
    context.textBaseline = 'middle';
    write(pane.title, 'ink', 'bold 13px');
    write(pane.unit, 'dim');
    for (const one of pane.series.filter(({ data }) => data.length > 0)) {
        line(context, x, CAPTION / 2 + 2, x + 18, CAPTION / 2 + 2, one.color, one.dash ?? []);
        x += 24;
        write(one.name, 'ink');
    }
}

function paintAll(context, view) {
    let top = 0;
    view.panes.forEach((pane, i) => {
        const height = heightOf(i, view);
        context.save();
        context.translate(0, top);
        paintCaption(context, pane);
        context.translate(0, CAPTION);
        paintPane(context, PICTURE_WIDTH, height, pane, view, i === view.panes.length - 1);
        context.restore();
        top += CAPTION + height;
    });
}

function valueAt(one, view, cursor) {
    const last = one.data.length - 1;
    if (last < 0) {
        return null;
    }
    const at = cursor === null ? last : Math.round(cursor / (one.seconds ?? view.seconds));
    return at > last ? null : one.data[Math.max(0, at)];
}

// { legend, places: what shows the value of each series }
function createLegend(pane) {
    const entries = filled(pane).map((one) => ({ one, place: make('span', { className: 'value' }) }));
    const marked = entries.map(({ one, place }) => {
        const mark = make('i', { style: `border-top: 2px ${one.dash?.length > 0 ? 'dashed' : 'solid'} var(--${one.color})` });
        return make('span', { className: 'entry' }, mark, `${one.name} `, place);
    });
    return { places: entries.map(({ place }) => place),
        legend: make('figcaption', {}, make('b', { textContent: pane.title }), make('small', { textContent: pane.unit }), ...marked) };
}

// The same on any context that has what a canvas has.
function paintPane(context, width, height, pane, view, hasAxis) {
    const [low, high] = extremes(pane);
    const bottom = height - (hasAxis ? AXIS : 6);
    const area = { left: GUTTER, right: width - RIGHT, top: 6, bottom };
    const x = (seconds) => area.left + (area.right - area.left) * seconds / view.duration;
    const y = (value) => area.bottom - (area.bottom - area.top) * (value - low) / (high - low);

    drawBands(context, pane, view, area, x);
    drawGrid(context, { low, high, area, x, y, hasAxis, duration: view.duration });
    drawEvents(context, view, area, x);
    context.save();
    context.beginPath();
    context.rect(area.left, area.top - 4, area.right - area.left, area.bottom - area.top + 8);
    context.clip();
    for (const one of pane.series) {
        drawSeries(context, one, view, x, y, area);
    }
    context.restore();
}

function line(context, x0, y0, x1, y1, name, dash) {
    context.beginPath();
    context.setLineDash(dash);
    context.strokeStyle = color(name);
    context.lineWidth = 1;
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
    context.setLineDash([]);
}

// Where the output was limited.
function drawBands(context, pane, view, area, x) {
    if (!pane.limited) {
        return;
    }
    context.fillStyle = color('limited');
    let from = -1;
    for (let i = 0; i <= pane.limited.length; i++) {
        const on = pane.limited[i] === 1;
        if (on && from < 0) {
            from = i;
        } else if (!on && from >= 0) {
            const [x0, x1] = [x(from * view.seconds), x(i * view.seconds)];
            context.fillRect(x0, area.top, Math.max(1, x1 - x0), area.bottom - area.top);
            from = -1;
        }
    }
}

export function drawGrid(context, { low, high, area, x, y, hasAxis, duration }) {
    context.font = '12px system-ui, sans-serif';
    context.fillStyle = color('dim');
    const tall = ticks(low, high, Math.max(2, (area.bottom - area.top) / 44));
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    for (const value of tall.found) {
        line(context, area.left, y(value), area.right, y(value), 'grid', []);
        context.fillText(value.toFixed(tall.places).replace('-', '−'), area.left - 8, y(value));
    }
    const wide = ticks(0, duration, Math.max(3, (area.right - area.left) / 90));
    context.textAlign = 'center';
    context.textBaseline = 'top';
    wide.found.forEach((seconds, i) => {
        line(context, x(seconds), area.top, x(seconds), area.bottom, 'grid', []);
        if (hasAxis) {
            const text = seconds.toFixed(wide.places);
            const last = i === wide.found.length - 1;
            context.fillText(last ? `${text} s` : text, Math.min(x(seconds), area.right - 10), area.bottom + 6);
        }
    });
}

function drawEvents(context, view, area, x) {
    for (const event of view.events) {
        if (event.at <= view.duration) {
            line(context, x(event.at), area.top, x(event.at), area.bottom, 'event', [2, 4]);
        }
    }
}

// With more steps than pixels, each pixel's lowest and highest value.
function drawSeries(context, one, view, x, y, area) {
    const n = one.data.length;
    if (n === 0) {
        return;
    }
    const seconds = one.seconds ?? view.seconds;
    const perPixel = Math.max(1, Math.floor(view.duration / seconds / (area.right - area.left) / 2));
    context.beginPath();
    context.strokeStyle = color(one.color);
    context.lineWidth = one.width ?? 1.75;
    context.setLineDash(one.dash ?? []);
    context.lineJoin = 'round';
    let last = null;
    for (let i = 0; i < n; i += perPixel) {
        let [least, most] = [one.data[i], one.data[i]];
        for (let k = i; k < Math.min(n, i + perPixel); k++) {
            least = Math.min(least, one.data[k]);
            most = Math.max(most, one.data[k]);
        }
        const at = x(i * seconds);
        if (one.held && last !== null) {
            context.lineTo(at, last);
        }
        context.lineTo(at, y(least));
        if (most !== least) {
            context.lineTo(at, y(most));
        }
        last = y(perPixel > 1 ? one.data[Math.min(n, i + perPixel) - 1] : most);
    }
    context.stroke();
    context.setLineDash([]);
}
