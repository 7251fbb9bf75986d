// What all pages share: the data beside the script, elements, charts in the page's colours, tables. Uses nothing of any
// network.
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

// A colour of look.css by its name, and the colour of the n-th of several things.
const colour = name => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
const seriesColour = n => { const all = colour('series').split(/\s+/); return all[n % all.length]; };

// Black or white, whichever shows better on a colour.
function inkOn(hex) {
  const [r, g, b] = [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16) / 255);
  return 0.3 * r + 0.6 * g + 0.1 * b < 0.45 ? '#fff' : '#000';
}

const charts = {};

// Draws `config` on the canvas `id`, in place of what was there. Texts and lines have the page's colours.
function drawChart(id, config) {
  charts[id]?.destroy();
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  Chart.defaults.font.size = 13;
  Chart.defaults.color = colour('soft');
  Chart.defaults.borderColor = colour('line');
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  charts[id] = new Chart(byId(id), config);
  return charts[id];
}

// The axis of a chart: a title with its unit.
const axis = (text, more = {}) => ({ title: { display: true, text, color: colour('ink') }, ...more });

function number(value, digits = 0) {
  return value.toLocaleString('en', { minimumFractionDigits: digits, maximumFractionDigits: digits });
}

// From a to b, as an element; of what is `worse` where it is more, green for less and red for more.
function change(a, b, worse = true) {
  if (!a || b === undefined || b === null) return '';
  const percent = 100 * (b / a - 1);
  if (Math.abs(percent) < 0.005) return '0 %';
  const sign = percent > 0 ? '+' : '−';
  return element('span', { class: worse ? (percent > 0 ? 'worse' : 'better') : '' }, `${sign}${number(Math.abs(percent), 2)} %`);
}

// Fills `table`, a row an entry; columns: [label, what to sort by, text]. `sort`: { n, down }; `resort` gets another one.
// `mark` is given each row and its entry.
function drawColumns(table, columns, entries, sort, resort, mark) {
  const header = rowOf(columns.map(c => c[0]), 'th');
  [...header.children].forEach((cell, n) => {
    cell.classList.add('sorts');
    if (n === sort.n) cell.append(sort.down ? ' ▾' : ' ▴');
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

// For the same: that nothing ends beyond `width` pixels, which the page is given.
function checkWidth(width) {
  for (const e of document.body.querySelectorAll('*')) {
    const { right } = e.getBoundingClientRect();
    if (right > width + 1 && !e.closest('.wide')) throw new Error(`${e.tagName} ${e.id} ends at ${right} of ${width} px`);
  }
}

// And that every canvas shows something.
function checkCanvases() {
  for (const canvas of document.querySelectorAll('canvas')) {
    const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    if (new Set(new Uint32Array(pixels.buffer)).size < 2) throw new Error(`the canvas ${canvas.id} is empty`);
  }
}

// Opened with #test, a page tries itself and says in data-test what came out: what a test reads.
function openPage(start, redraw, tryOut) {
  window.addEventListener('error', event => { document.documentElement.dataset.test = 'failed: ' + event.message; });
  byId('made').replaceChildren(...data.made.map(line => element('p', {}, line)));
  start();
  for (const query of ['(prefers-color-scheme: dark)', 'print'])
    matchMedia(query).addEventListener('change', redraw);
  if (location.hash !== '#test') return;
  const said = tryOut(), root = document.documentElement;
  for (const width of [400, 2000, root.clientWidth]) {
    root.style.width = `${width}px`;
    redraw();
    checkWidth(width);
  }
  checkCanvases();
  root.style.width = '';
  const scheme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
  root.dataset.test = `passed with ${said}, ${scheme}`;
}
