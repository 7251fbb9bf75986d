// What all pages share: the data beside the script, elements, tables, controls. Uses nothing of any network.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);
const byId = id => document.getElementById(id);

function element(name, attributes = {}, ...children) {
  const e = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  e.append(...children);
  return e;
}

function rowOf(cells, name = 'td') {
  return element('tr', {}, ...cells.map(c => element(name, {}, c)));
}

// Fills `table`, a row an entry; columns: [label, what to sort by, text]. `sort`: { n, down }; `resort` gets another one.
// `mark` is given each row and its entry.
function drawColumns(table, columns, entries, sort, resort, mark) {
  const header = rowOf(columns.map(c => c[0]), 'th');
  [...header.children].forEach((cell, n) => {
    cell.classList.add('sorts');
    if (n === sort.n) cell.classList.add(sort.down ? 'down' : 'up');
    cell.addEventListener('click', () => resort({ n, down: sort.n === n && !sort.down }));
  });
  table.tHead.replaceChildren(header);
  const order = [...entries];
  order.sort((a, b) => {
    const [x, y] = [columns[sort.n][1](a), columns[sort.n][1](b)];
    return (x < y ? -1 : x > y ? 1 : 0) * (sort.down ? -1 : 1);
  });
  table.tBodies[0].replaceChildren(...order.map(e => {
    const row = rowOf(columns.map(c => c[2](e)));
    mark(row, e);
    return row;
  }));
}

// A control: choices are [value, label]; `chosen` gets the value.
function fill(select, choices, chosen) {
  for (const [value, label] of choices) select.append(element('option', { value }, label));
  select.addEventListener('change', () => chosen(select.value));
}

// For a page's test of itself: every choice of these controls, then the one that was chosen before.
function tryControls(ids) {
  const choose = (id, value) => {
    byId(id).value = value;
    byId(id).dispatchEvent(new Event('change'));
  };
  for (const id of ids) {
    const before = byId(id).value;
    for (const option of byId(id).options) choose(id, option.value);
    choose(id, before);
  }
}
