// SPDX-License-Identifier: MIT
// The frequency response of the sampled loop in two pictures, Nyquist's and Bode's, and what
// a plant does to it whose gain is not the one that was said.
import { blank } from './dom.js';
import { digits, percent } from './format.js';
import { OFF } from './margins.js';
import { color } from './plot.js';

function path(context, points) {
    context.beginPath();
    points.forEach((point, i) => context[i === 0 ? 'moveTo' : 'lineTo'](...point));
}

// The loop's curve around -1, and where it may be with the plant's gain up to OFF away; the
// circle is Ms 2.
export function drawNyquist(canvas, margins) {
    const { context, width, height } = blank(canvas);
    const unit = height / 3.4;
    const [x0, y0] = [width * 0.66, height * 0.42];
    const at = ([re, im]) => [x0 + unit * re, y0 - unit * im];
    const circle = (centre, radius, name) => {
        context.beginPath();
        context.strokeStyle = color(name);
        context.arc(...at(centre), radius * unit, 0, 2 * Math.PI);
        context.stroke();
    };
    context.lineWidth = 1;
    context.strokeStyle = color('grid');
    context.beginPath();
    context.moveTo(0, y0);
    context.lineTo(width, y0);
    context.moveTo(x0, 0);
    context.lineTo(x0, height);
    context.stroke();
    circle([0, 0], 1, 'line');
    circle([-1, 0], 0.5, 'output');
    context.fillStyle = color('output');
    context.beginPath();
    context.arc(...at([-1, 0]), 3, 0, 2 * Math.PI);
    context.fill();
    const inside = (factor) => (point) => {
        const scale = Math.min(factor, 40 / Math.hypot(...point));
        return at(point.map((one) => one * scale));
    };
    path(context, [...margins.curve.map(inside(1 + OFF)), ...margins.curve.map(inside(1 - OFF)).reverse()]);
    context.fillStyle = color('band');
    context.fill();
    path(context, margins.curve.map(inside(1)));
    context.strokeStyle = color('measured');
    context.lineWidth = 1.75;
    context.stroke();
    canvas.setAttribute('aria-label', `The loop’s frequency response about −1, Ms ${margins.ms.toFixed(2)}`);
}

// Size and phase of each point. The dead time turns the curve by more than half a turn from
// one point to the next, where it is long, so its turn is put on last.
export function bodeOf({ curve, angles, steps }) {
    let last = -80 * Math.PI / 180; // it begins between -260 and 100 degrees
    const degrees = curve.map(([re, im], i) => {
        const dead = angles[i] * steps;
        const alone = Math.atan2(im * Math.cos(dead) + re * Math.sin(dead), re * Math.cos(dead) - im * Math.sin(dead));
        last = alone + 2 * Math.PI * Math.round((last - alone) / (2 * Math.PI));
        return (last - dead) * 180 / Math.PI;
    });
    return { decibels: curve.map((point) => 20 * Math.log10(Math.hypot(...point))), degrees };
}

// Of a value for each of `angles`, the one at w.
export function betweenAngles(values, angles, w) {
    const i = Math.max(1, angles.findIndex((angle) => angle >= w));
    const part = Math.log(w / angles[i - 1]) / Math.log(angles[i] / angles[i - 1]);
    return values[i - 1] + part * (values[i] - values[i - 1]);
}

const [LEFT, MIDDLE, UNDER] = [48, 10, 20]; // pixels beside, between and under the two panes

function bodePane(context, { top, bottom, right, low, high, step, unit, x, rates }) {
    const y = (value) => bottom - (bottom - top) * (value - low) / (high - low);
    const rule = (from, to, name) => {
        path(context, [from, to]);
        context.strokeStyle = color(name);
        context.stroke();
    };
    context.lineWidth = 1;
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    context.fillStyle = color('dim');
    for (let value = low; value <= high; value += step) {
        rule([LEFT, y(value)], [right, y(value)], value === (unit === '°' ? -180 : 0) ? 'line' : 'grid');
        context.fillText(`${value}${value === high ? unit : ''}`.replace('-', '−'), LEFT - 6, y(value) + (value === high ? 4 : 0));
    }
    for (const rate of rates) {
        rule([x(rate), top], [x(rate), bottom], 'grid');
    }
    return y;
}

// A margin: a line at its frequency, and from the value to its limit.
function mark(context, y, { at, value, limit, text, top, bottom, right }) {
    context.strokeStyle = color('dim');
    context.lineWidth = 1;
    context.setLineDash([3, 4]);
    path(context, [[at, top], [at, bottom]]);
    context.stroke();
    context.setLineDash([]);
    if (text === '') {
        return;
    }
    context.strokeStyle = color('output');
    context.lineWidth = 3;
    path(context, [[at, y(limit)], [at, y(value)]]);
    context.stroke();
    context.fillStyle = color('ink');
    const left = at > right - 60;
    context.textAlign = left ? 'right' : 'left';
    context.fillText(text, at + (left ? -6 : 6), (y(limit) + y(value)) / 2);
}

// What a reader hears of it, and the caption.
export function bodeText({ stable, crossover, turnover, phaseMargin, gainMargin }, rate) {
    const crosses = crossover === null ? 'its gain is 1 at no frequency' : `its gain is 1 at ${digits(crossover * rate)} rad/s, ${phaseMargin.toFixed(0)}° from −180°`;
    const turns = turnover === null ? '' : `; −180° are at ${digits(turnover * rate)} rad/s, ${(20 * Math.log10(gainMargin)).toFixed(1)} dB below 1`;
    return stable ? `Bode plot of the loop: ${crosses}${turns}` : 'Bode plot of the loop, which is unstable';
}

export function drawBode(canvas, margins, rate) {
    const { context, width, height } = blank(canvas);
    const { angles, stable, crossover, turnover, phaseMargin, gainMargin } = margins;
    const { decibels, degrees } = bodeOf(margins);
    const [first, last] = [angles[0] * rate, Math.PI * rate];
    const right = width - 8;
    const x = (w) => LEFT + (right - LEFT) * Math.log(w / first) / Math.log(last / first);
    const half = (height - UNDER - MIDDLE - 6) / 2;
    const rates = [];
    for (let power = Math.ceil(Math.log10(first)); power <= Math.log10(last); power++) {
        rates.push(10 ** power);
    }
    const upper = { top: 6, bottom: 6 + half, right, low: -40, high: 40, step: 20, unit: ' dB', x, rates };
    const lower = { top: 6 + half + MIDDLE, bottom: height - UNDER, right, low: -270, high: Math.max(...degrees) > 5 ? 90 : 0, step: 90, unit: '°', x, rates };
    context.font = '12px system-ui, sans-serif';
    const [tall, turned] = [upper, lower].map((pane) => bodePane(context, pane));
    context.textAlign = 'center';
    context.textBaseline = 'top';
    context.fillStyle = color('dim');
    rates.forEach((one, i) => context.fillText(`${digits(one, 1)}${i === rates.length - 1 ? ' rad/s' : ''}`, Math.min(x(one), right - 24), lower.bottom + 5));
    for (const [pane, y, values] of [[upper, tall, decibels], [lower, turned, degrees]]) {
        context.save();
        context.beginPath();
        context.rect(LEFT, pane.top, right - LEFT, pane.bottom - pane.top);
        context.clip();
        path(context, values.map((value, i) => [x(angles[i] * rate), y(value)]));
        context.strokeStyle = color('measured');
        context.lineWidth = 1.75;
        context.stroke();
        context.restore();
    }
    context.textBaseline = 'middle';
    const whole = { right, top: upper.top, bottom: lower.bottom };
    if (stable && crossover !== null) {
        const value = betweenAngles(degrees, angles, crossover);
        const limit = 360 * Math.round((value - 180) / 360) + 180;
        mark(context, turned, { ...whole, at: x(crossover * rate), value, limit, text: `${phaseMargin.toFixed(0)}°` });
    }
    if (stable && turnover !== null) {
        const value = betweenAngles(decibels, angles, turnover);
        mark(context, tall, { ...whole, at: x(turnover * rate), value: Math.max(-40, value), limit: 0, text: `${(20 * Math.log10(gainMargin)).toFixed(1)} dB` });
    }
    canvas.setAttribute('aria-label', bodeText(margins, rate));
}

// What becomes of the loop where the plant's gain is off.
export function offText({ stable, off }) {
    const by = `With the plant’s gain up to ${percent(OFF, 0)} off, the shaded band,`;
    if (!stable) {
        return '';
    }
    return off.stable ? `${by} the loop stays stable and Ms is at most ${digits(off.ms)}.` : `${by} the loop becomes unstable.`;
}
