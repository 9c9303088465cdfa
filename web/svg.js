// SPDX-License-Identifier: MIT
// A picture in SVG by the calls of a canvas: those that the plots make.

function attribute(text) {
    return String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
}

// A name and no address: nothing is loaded from it.
const NAMESPACE = ['http:', '', 'www.w3.org', '2000', 'svg'].join('/');
const ANCHOR = { left: 'start', center: 'middle', right: 'end' };
const BASELINE = { top: 'hanging', middle: 'central' };

// { context, text() }: what is drawn on, and the file.
export function createSvg(width, height, background) {
    const parts = [];
    const open = [0]; // groups since each save
    let [path, dash, clips, box] = ['', [], 0, null];
    const place = (x, y) => `${x.toFixed(1)} ${y.toFixed(1)}`;
    const group = (more) => {
        parts.push(`<g ${more}>`);
        open[open.length - 1] += 1;
    };
    const context = {
        beginPath: () => { path = ''; },
        moveTo: (x, y) => { path += `M${place(x, y)}`; },
        lineTo: (x, y) => { path += `${path === '' ? 'M' : 'L'}${place(x, y)}`; },
        rect: (...sides) => { box = sides; },
        setLineDash: (next) => { dash = next; },
        stroke: () => path !== '' && parts.push(`<path d="${path}" fill="none" stroke="${attribute(context.strokeStyle)}" stroke-width="${context.lineWidth}"` +
            ` stroke-linejoin="round"${dash.length > 0 ? ` stroke-dasharray="${dash.join(' ')}"` : ''}/>`),
        fillRect: (x, y, w, h) => parts.push(`<rect x="${x.toFixed(1)}" y="${y.toFixed(1)}" width="${w.toFixed(1)}" height="${h.toFixed(1)}" fill="${attribute(context.fillStyle)}"/>`),
        fillText: (text, x, y) => parts.push(`<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" fill="${attribute(context.fillStyle)}" text-anchor="${ANCHOR[context.textAlign]}"` +
            ` dominant-baseline="${BASELINE[context.textBaseline]}" style="font: ${attribute(context.font)}">${attribute(text)}</text>`),
        save: () => open.push(0),
        restore: () => parts.push('</g>'.repeat(open.pop())),
        translate: (x, y) => group(`transform="translate(${x} ${y})"`),
        clip: () => {
            clips += 1;
            const [x, y, w, h] = box.map((side) => side.toFixed(1));
            parts.push(`<clipPath id="c${clips}"><rect x="${x}" y="${y}" width="${w}" height="${h}"/></clipPath>`);
            group(`clip-path="url(#c${clips})"`);
        },
    };
    return { context, text: () => [`<svg xmlns="${NAMESPACE}" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}">`,
        `<rect width="100%" height="100%" fill="${attribute(background)}"/>`, ...parts, '</svg>', ''].join('\n') };
}
