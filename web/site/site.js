// SPDX-License-Identifier: MIT
// Long tables of numbers, and those of CSV files, are sorted by a click on a column's name. Wide
// ones, like wide code, move sideways by themselves, and can be reached by keys to do so. The
// search has a name for those who hear it.
'use strict';

const LONG = 8; // rows

// The first number of a cell, or its text; an empty cell comes last.
function key(row, column) {
    const text = row.cells[column].textContent.trim();
    const number = /^-?[\d.]+/.exec(text);
    return number ? Number(number[0]) : text;
}

function order(one, other) {
    if (one === '' || other === '') {
        return (one === '') - (other === '');
    }
    if (typeof one === 'number' && typeof other === 'number') {
        return one - other;
    }
    return String(one).localeCompare(String(other));
}

function sort(table, column) {
    const header = table.tHead.rows[0].cells;
    const descending = header[column].getAttribute('aria-sort') === 'ascending';
    const body = table.tBodies[0];
    const rows = [...body.rows].map((row) => ({ row, key: key(row, column) }));
    const sign = descending ? -1 : 1;
    rows.sort((one, other) => (one.key === '' || other.key === '' ? 1 : sign) * order(one.key, other.key));
    body.append(...rows.map(({ row }) => row));
    for (const cell of header) {
        cell.removeAttribute('aria-sort');
    }
    header[column].setAttribute('aria-sort', descending ? 'descending' : 'ascending');
}

function hasNumbers(table) {
    const cells = [...table.tBodies[0].querySelectorAll('td')].filter((cell) => cell.textContent.trim());
    return 2 * cells.filter((cell) => /^-?\d/.test(cell.textContent)).length > cells.length;
}

function makeSortable(table) {
    [...table.tHead.rows[0].cells].forEach((cell, column) => {
        const button = document.createElement('button');
        button.type = 'button';
        button.className = 'sort';
        button.append(...cell.childNodes);
        button.addEventListener('click', () => sort(table, column));
        cell.append(button);
    });
}

for (const table of document.querySelectorAll('.md-typeset table:not([class])')) {
    if (table.tHead && table.tBodies[0].rows.length >= LONG && ('sorted' in table.dataset || hasNumbers(table))) {
        makeSortable(table);
    }
}

// What can be moved sideways.
function reachable() {
    for (const box of document.querySelectorAll('.md-typeset__scrollwrap, .md-typeset pre > code')) {
        const wide = box.scrollWidth > box.clientWidth;
        if (wide) {
            box.tabIndex = 0;
        } else {
            box.removeAttribute('tabindex');
        }
    }
}
addEventListener('load', reachable);
addEventListener('resize', reachable);

document.querySelector('.md-search').setAttribute('aria-label', 'Search');
