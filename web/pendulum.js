// SPDX-License-Identifier: MIT
// The pendulum as a moving picture: the base on its line, the rod, and the
// twin's rod behind it. Who asked for less motion gets it standing until it is
// started.
import { blank } from './dom.js';
import { color } from './plot.js';

// update(view or null) shows a run, { n, seconds, angle, base, twin }; onTime
// is told the second that is shown.
export function createPendulum(place, onTime) {
    const canvas = place.querySelector('canvas');
    const button = place.querySelector('button');
    const still = matchMedia('(prefers-reduced-motion: reduce)');
    let run = null;
    let shown = 0;
    let started = null; // of the clock at second 0, while it moves

    function label() {
        button.textContent = started === null ? 'Play' : 'Pause';
    }

    function play() {
        started = performance.now() - 1000 * shown;
        label();
        requestAnimationFrame(frame);
    }

    function pause() {
        started = null;
        label();
    }

    function frame(now) {
        if (started === null || run === null) {
            return;
        }
        shown = (now - started) / 1000;
        if (shown > run.n * run.seconds) {
            shown = 0;
            started = now;
        }
        draw();
        onTime(shown);
        requestAnimationFrame(frame);
    }

    function draw() {
        const { context, width, height } = blank(canvas);
        if (run === null) {
            return;
        }
        const i = Math.min(run.n - 1, Math.max(0, Math.floor(shown / run.seconds)));
        const floor = height - 26;
        const rod = Math.min(height - 56, width / 3);
        drawLine(context, { width, floor, scale: rod / 0.5, base: run.base[i] });
        drawRod(context, { x: width / 2, floor, rod, angle: run.twin[i], stroke: 'kept', thick: 3 });
        drawRod(context, { x: width / 2, floor, rod, angle: run.angle[i], stroke: 'measured', thick: 4 });
        drawBase(context, width / 2, floor);
    }

    button.addEventListener('click', () => (started === null ? play() : pause()));
    new ResizeObserver(draw).observe(canvas);
    label();
    return {
        update(next) {
            place.hidden = next === null;
            const first = run === null && next !== null;
            run = next;
            if (next === null) {
                pause();
                shown = 0;
                return;
            }
            if (first && !still.matches) {
                play();
            }
            draw();
        },
        at(seconds) {
            if (run !== null && started === null && seconds !== null) {
                shown = seconds;
                draw();
            }
        },
    };
}

// The ground moves under the base, which stays in the middle.
function drawLine(context, { width, floor, scale, base }) {
    context.strokeStyle = color('line');
    context.fillStyle = color('dim');
    context.lineWidth = 1;
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'center';
    context.beginPath();
    context.moveTo(0, floor);
    context.lineTo(width, floor);
    const span = width / scale / 2;
    for (let mark = Math.ceil((base - span) * 2) / 2; mark <= base + span; mark += 0.5) {
        const x = width / 2 + (mark - base) * scale;
        context.moveTo(x, floor);
        context.lineTo(x, floor + 5);
        if (Number.isInteger(mark)) {
            context.fillText(`${mark} m`.replace('-', '−'), x, floor + 20);
        }
    }
    context.stroke();
}

function drawRod(context, { x, floor, rod, angle, stroke, thick }) {
    const radians = angle * Math.PI / 180;
    const [tipX, tipY] = [x + rod * Math.sin(radians), floor - 12 - rod * Math.cos(radians)];
    context.strokeStyle = color(stroke);
    context.fillStyle = color(stroke);
    context.lineWidth = thick;
    context.lineCap = 'round';
    context.beginPath();
    context.moveTo(x, floor - 12);
    context.lineTo(tipX, tipY);
    context.stroke();
    context.beginPath();
    context.arc(tipX, tipY, 9, 0, 2 * Math.PI);
    context.fill();
}

function drawBase(context, x, floor) {
    context.fillStyle = color('ink');
    context.beginPath();
    context.roundRect(x - 34, floor - 20, 68, 14, 4);
    context.fill();
    for (const wheel of [-20, 20]) {
        context.beginPath();
        context.arc(x + wheel, floor - 5, 5, 0, 2 * Math.PI);
        context.fill();
    }
}
