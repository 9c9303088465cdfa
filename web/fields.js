// SPDX-License-Identifier: MIT
// A field for one number. It reads what people type, with a comma or a point, and
// shows what runs: while it is typed in, the person's text, and else the number
// that is in use.
import { make } from './dom.js';
import { short } from './format.js';

const DECIMAL = /^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i;

// { value } of a text, or { why } it is no number. `1/16` is a number, too.
export function readNumber(text) {
    const written = text.trim().replace(/\s*\/\s*/, '/').replaceAll('−', '-');
    const parts = written.split('/');
    if (written === '') {
        return { why: 'Nothing is written here.' };
    }
    if (parts.length > 2 || !parts.every((part) => DECIMAL.test(part))) {
        const both = /\d[.,]\d+[.,]/.test(written);
        return { why: both ? `“${text.trim()}” has more than one comma or point: write 1234.5.` : `“${text.trim()}” is no number.` };
    }
    const [over, under = 1] = parts.map((part) => Number(part.replace(',', '.')));
    const value = over / under;
    return Number.isFinite(value) ? { value } : { why: `“${text.trim()}” is too large.` };
}

// About 1 % of the value, as 1, 2 or 5 times a power of ten.
function stepAt(value) {
    const wanted = Math.abs(value) / 100;
    const power = 10 ** Math.floor(Math.log10(wanted));
    return power * [1, 2, 5, 10].reduce((best, one) =>
        (Math.abs(Math.log(one * power / wanted)) < Math.abs(Math.log(best * power / wanted)) ? one : best));
}

// The value one arrow key further. `least` is the step from 0, and of whole numbers 1.
export function stepped(value, way, { least, whole = false }) {
    const own = value === 0 ? least : stepAt(value);
    const step = whole ? Math.max(1, Math.round(own)) : own;
    return Number(((Math.round(value / step) + way) * step).toPrecision(12));
}

// { field, why, update() }: the input, the element that says why a text is no
// number, and what shows the value that `read` gives. `more` are attributes of the
// input; `step()` is as `stepped` has it.
export function createField(id, more, { read, step, onInput }) {
    const why = make('span', { className: 'why', id: `${id}-why`, role: 'status' });
    const field = make('input', { type: 'text', inputMode: 'decimal', autocomplete: 'off', id, 'aria-describedby': why.id, ...more });
    let typing = false;

    function refuse(text) {
        field.setAttribute('aria-invalid', String(text !== ''));
        why.textContent = text;
    }
    function update() {
        if (!typing) {
            field.value = short(read());
        }
    }
    field.addEventListener('input', () => {
        typing = true;
        const { value, why: reason = '' } = readNumber(field.value);
        refuse(reason);
        if (value !== undefined) {
            onInput(value);
        }
    });
    // The reason stays in view beside the number that is still in use.
    field.addEventListener('change', () => {
        const { why: reason = '' } = readNumber(field.value);
        typing = false;
        update();
        refuse('');
        why.textContent = reason && `${reason} ${field.value} is in use.`;
    });
    field.addEventListener('blur', () => {
        typing = false;
        update();
    });
    field.addEventListener('keydown', (event) => {
        const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
        if (way !== undefined && !event.ctrlKey && !event.altKey && !event.metaKey) {
            event.preventDefault();
            typing = false;
            refuse('');
            onInput(stepped(read(), way * (event.shiftKey ? 10 : 1), step()));
            update();
        }
    });
    return { field, why, update };
}
