// What the pages of `splat accuracy` share: the measurements beside the script, elements, plots, tables. Uses nothing of
// any network.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);
const byId = id => document.getElementById(id);

function element(name, attributes = {}, ...children) {
  const inSvg = ['circle', 'line', 'path', 'text', 'title'].includes(name);
  const e = inSvg ? document.createElementNS('http://www.w3.org/2000/svg', name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  e.append(...children);
  return e;
}

function rowOf(cells, name = 'td') {
  return element('tr', {}, ...cells.map(c => element(name, {}, c)));
}

// Round numbers from low to high.
function ticks(low, high) {
  const step = 10 ** Math.floor(Math.log10((high - low) / 4 || 1));
  const wide = [1, 2, 5, 10].map(f => f * step).find(s => (high - low) / s <= 7);
  const all = [];
  for (let t = Math.ceil(low / wide) * wide; t <= high; t += wide) all.push(t);
  return all;
}

const PLOT = { left: 70, right: 1080, top: 20, bottom: 430 };

// Clears `svg` and draws axes for x and y, each { values, label, tick }: the values to be shown, and a number's text. Gives
// where numbers are, what is beyond x.values' most at the edge.
function drawAxes(svg, x, y) {
  const { left, right, top, bottom } = PLOT;
  const range = values => {
    const [low, high] = [Math.min(...values), Math.max(...values)];
    return [low - 0.05 * (high - low || 1), high + 0.05 * (high - low || 1)];
  };
  const [x0, x1] = range(x.values), [y0, y1] = range(y.values);
  const px = v => left + Math.min(1, (v - x0) / (x1 - x0)) * (right - left);
  const py = v => bottom - (v - y0) / (y1 - y0) * (bottom - top);
  const plain = t => +t.toPrecision(6);
  svg.replaceChildren();
  for (const t of ticks(x0, x1))
    svg.append(element('line', { class: 'grid', x1: px(t), x2: px(t), y1: top, y2: bottom }),
      element('text', { x: px(t), y: bottom + 18, 'text-anchor': 'middle' }, (x.tick ?? plain)(t)));
  for (const t of ticks(y0, y1))
    svg.append(element('line', { class: 'grid', x1: left, x2: right, y1: py(t), y2: py(t) }),
      element('text', { x: left - 6, y: py(t) + 4, 'text-anchor': 'end' }, (y.tick ?? plain)(t)));
  svg.append(element('text', { x: (left + right) / 2, y: bottom + 40, 'text-anchor': 'middle' }, x.label),
    element('text', { x: left, y: top - 6 }, y.label));
  return { px, py, y0, y1 };
}

// Fills `table`, a row an entry; columns: [label, what to sort by, text]. `sort`: { n, down }; `resort` gets another one.
// `mark` is given each row and its entry.
function drawColumns(table, columns, entries, sort, resort, mark) {
  const header = rowOf(columns.map(c => c[0]), 'th');
  [...header.children].forEach((cell, n) =>
    cell.addEventListener('click', () => resort({ n, down: sort.n === n && !sort.down })));
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

// For a page's test of itself: every choice of these controls, then the first again.
function tryControls(ids) {
  for (const id of ids)
    for (const option of byId(id).options) {
      byId(id).value = option.value;
      byId(id).dispatchEvent(new Event('change'));
    }
  for (const id of ids) {
    byId(id).selectedIndex = 0;
    byId(id).dispatchEvent(new Event('change'));
  }
}

// Opened with #test, a page tries itself and says in data-test what came out: what a test reads.
function openPage(start, tryOut) {
  window.addEventListener('error', event => { document.documentElement.dataset.test = 'failed: ' + event.message; });
  byId('made').textContent = data.made;
  start();
  if (location.hash === '#test') document.documentElement.dataset.test = tryOut();
}
