// What pages with charts share besides elements.js: the page's colours, charts, its start and its test of itself.

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

// A label of an axis, with as many digits as tell it from its neighbours.
function tickText(value, n, all) {
  const step = all.length > 1 ? Math.abs(all[1].value - all[0].value) : 1;
  return number(value, Math.min(9, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9))));
}

// From a to b, as an element; of what is `worse` where it is more, green for less and red for more.
function change(a, b, worse = true) {
  if (!a || b === undefined || b === null) return '';
  const percent = 100 * (b / a - 1);
  if (Math.abs(percent) < 0.005) return '0 %';
  const sign = percent > 0 ? '+' : '−';
  return element('span', { class: worse ? (percent > 0 ? 'worse' : 'better') : '' }, `${sign}${number(Math.abs(percent), 2)} %`);
}

// For a page's test of itself: that nothing ends beyond `width` pixels, which the page is given.
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

// And that the title of every axis fits beside its axis.
function checkTitles() {
  for (const [id, chart] of Object.entries(charts))
    for (const scale of Object.values(chart.scales)) {
      const { display, text } = scale.options.title, context = chart.ctx;
      if (!display) continue;
      context.save();
      context.font = `${Chart.defaults.font.size}px ${Chart.defaults.font.family}`;
      const room = scale.isHorizontal() ? scale.width : scale.height, { width } = context.measureText(text);
      context.restore();
      if (width > room) throw new Error(`${id}: "${text}" takes ${Math.round(width)} px beside an axis of ${Math.round(room)}`);
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
    checkTitles();
  }
  checkCanvases();
  root.style.width = '';
  const scheme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
  root.dataset.test = `passed with ${said}, ${scheme}`;
}
