// What pages with charts share besides elements.js: the page's colours, charts, its start and its test of itself.

// A colour of look.css by its name, which has the light ones first, and the colour of the n-th of several things. Paper is light.
const hasScreen = typeof window !== 'undefined'; // else splat-figures runs it
const isDark = matchMedia('(prefers-color-scheme: dark)');
const look = document.querySelector('style')?.textContent; // a page that is served has it elsewhere, and no figures for papers
const colour = name => (look ? [...look.matchAll(new RegExp(`--${name}: ([^;]*);`, 'g'))][isDark.matches && !onPaper ? 1 : 0][1] :
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
const seriesColour = n => { const all = colour('series').split(/\s+/); return all[n % all.length]; };

// A colour for white paper, as a dark screen has it.
const onScreen = hex => (isDark.matches && !onPaper ?
  `#${[1, 3, 5].map(at => Math.round(0.75 * parseInt(hex.slice(at, at + 2), 16) + 64).toString(16).padStart(2, '0')).join('')}` : hex);

// Black or white, whichever shows better on a colour.
function inkOn(hex) {
  const [r, g, b] = [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16) / 255);
  return 0.3 * r + 0.6 * g + 0.1 * b < 0.45 ? '#fff' : '#000';
}

const charts = {};

Chart.defaults.animation = false;
Chart.defaults.maintainAspectRatio = false;

// Draws `config` on the canvas `id`, in place of what was there. Texts and lines have the page's colours.
function drawChart(id, config) {
  config.options.plugins ??= {};
  Object.assign(Chart.defaults.font, onPaper ? { family: FONT, size: TEXT } : { family: 'system-ui, "DejaVu Sans", sans-serif', size: 13 });
  Object.assign(Chart.defaults, { color: colour('soft'), borderColor: colour('line') });
  Chart.defaults.plugins.legend.labels.boxWidth = Chart.defaults.font.size;
  if (onPaper) {
    onPaper[id] = config;
    return;
  }
  if (!hasScreen) return;
  charts[id]?.destroy();
  charts[id] = new Chart(byId(id), config);
}

// Draws on the canvas `id` what is no chart: `paint` gets a context whose pixels are those of the picture, `rows` has its numbers, `colour`
// gives the colour of a share of the scale, and `end` is the text at the scale's end.
function drawCells(id, cells) {
  if (onPaper) onPaper[id] = cells;
  else if (hasScreen) cells.paint(byId(id).getContext('2d'));
}

// The names of points beside them, empty for none: each where it covers no other name and no point, else at the end of a line from its point.
const pointNames = nameOf => ({
  id: 'pointNames',
  afterDatasetsDraw(chart) {
    const { ctx, chartArea: area } = chart, size = Chart.defaults.font.size * 0.9, taken = [];
    const isFree = box => box.x > area.left && box.x + box.w < area.right && box.y > area.top && box.y + box.h < area.bottom &&
      taken.every(t => box.x > t.x + t.w || t.x > box.x + box.w || box.y > t.y + t.h || t.y > box.y + box.h);
    const points = chart.data.datasets.flatMap(({ data: all, showLine }, n) => (showLine ? [] : chart.getDatasetMeta(n).data.map((at, k) => ({ at, name: shortened(nameOf(all[k])) }))));
    const takes = ({ x, y }, half) => taken.push({ x: x - half, y: y - half, w: 2 * half, h: 2 * half });
    for (const { at } of points) takes(at, 4);
    // And lines, every few pixels.
    chart.data.datasets.forEach(({ showLine }, n) => chart.getDatasetMeta(n).data.forEach((to, k, all) => {
      const from = all[k - 1], steps = showLine && from ? Math.hypot(to.x - from.x, to.y - from.y) / 5 : 0;
      for (let step = 0; step < steps; ++step) takes({ x: from.x + (to.x - from.x) * step / steps, y: from.y + (to.y - from.y) * step / steps }, 1);
    }));
    ctx.save();
    ctx.font = `${size}px ${Chart.defaults.font.family}`;
    ctx.textBaseline = 'middle';
    ctx.textAlign = 'left';
    for (const { at, name } of points.filter(p => p.name)) {
      const w = ctx.measureText(name).width, h = size * 1.15;
      const places = [7, 14, 24, 38, 56].flatMap(far => Array.from({ length: 12 }, (_, n) => {
        const angle = n * Math.PI / 6, x = at.x + far * Math.cos(angle), y = at.y + far * Math.sin(angle);
        return { x: x + (Math.cos(angle) > 0.1 ? 0 : Math.cos(angle) < -0.1 ? -w : -w / 2), y: y - h / 2, w, h, far, fromX: x, fromY: y };
      }));
      const box = places.find(isFree);
      if (!box) continue; // its row in the table has it
      taken.push(box);
      ctx.fillStyle = colour('ink');
      ctx.fillText(name, box.x, box.y + h / 2);
      if (box.far < 14) continue;
      ctx.strokeStyle = colour('soft');
      ctx.lineWidth = 0.5;
      ctx.beginPath();
      ctx.moveTo(at.x, at.y);
      ctx.lineTo(box.fromX, box.fromY);
      ctx.stroke();
    }
    ctx.restore();
  },
});
const shortened = text => (text.length > 34 ? `${text.slice(0, 33)}…` : text);

// The axis of a chart: a title with its unit.
const axis = (text, more = {}) => ({ title: { display: text !== '', text, color: colour('ink') }, ...more });

// Of some pages the reader selects a thing by its name, `state.selected`, on a chart or in a table; #panel is about it, and stands in
// #panel-home.
// `table`: where the reader has clicked a row, whose place on the screen is kept; none for a chart.
function select(name, table = null) {
  const top = () => table && byId(table).querySelector('tr.selected')?.getBoundingClientRect().top;
  Object.assign(state, { selected: name, table });
  const clicked = table && [...byId(table).tBodies[0].rows].find(row => row.dataset.name === name);
  const before = clicked?.getBoundingClientRect().top;
  page.redraw();
  if (clicked) scrollBy(0, top() - before);
}

// What #panel shows of the selected point stands below the row that was clicked, else where the page has it.
function drawAround(drawAll) {
  const panel = byId('panel'), home = byId('panel-home');
  home.append(panel); // tables are drawn again
  drawAll();
  const row = !onPaper && state.table && byId(state.table).querySelector('tr.selected');
  if (row) row.after(element('tr', { class: 'holds-panel' }, element('td', { colspan: row.children.length }, panel)));
}

// A row of `table` that selects `name`.
function selects(row, name, table) {
  row.dataset.name = name;
  row.classList.toggle('selected', name === state.selected);
  row.addEventListener('click', () => select(name, table));
}

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
    if (!isShown(canvas)) continue;
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

// And that every bar has its name.
function checkBars() {
  for (const [id, { config, scales, data: { labels } }] of Object.entries(charts))
    if (config.type === 'bar' && config.options.indexAxis === 'y' && scales.y.ticks.length !== labels.length)
      throw new Error(`${id}: ${scales.y.ticks.length} names of ${labels.length} bars`);
}

// And that a menu stands below what it saves.
function checkMenus() {
  for (const menu of document.querySelectorAll('.save')) {
    const of = menu.previousElementSibling.getBoundingClientRect(), { left, top, height } = menu.getBoundingClientRect();
    if (height && (!of.height || Math.abs(left - of.left) > 1 || Math.abs(top - of.bottom) > 8)) throw new Error(`a menu is not below ${menu.previousElementSibling.id}`);
  }
}

// And that every figure that is shown can be saved.
function checkFigures() {
  for (const { name, svg, csv } of figures())
    if (/NaN|undefined/.test(svg + csv) || csv.split('\n').length < 3) throw new Error(`the figure ${name} is not right: ${csv.slice(0, 300)}`);
  page.redraw();
}

// Links to the page's groups of figures, where there are several.
function addContents() {
  const groups = [...document.querySelectorAll('h2')].filter(isShown);
  if (groups.length < 4) return;
  groups.forEach((group, n) => group.setAttribute('id', `group-${n}`));
  byId('contents').append(...groups.map(group => element('a', { href: `#${group.id}` }, group.textContent)));
}

// The page that is open, for figures.js.
const page = {};

// Opened with #test, a page tries itself and says in data-test what came out: what a test reads.
function openPage(start, redraw, tryOut) {
  page.redraw = redraw;
  addEventListener('error', event => { document.documentElement.dataset.test = 'failed: ' + event.message; });
  byId('made').replaceChildren(...data.made.map(line => element('p', {}, line)));
  start();
  addMenus();
  addContents();
  for (const query of [isDark, matchMedia('print')]) query.addEventListener('change', redraw);
  if (location.hash !== '#test') return;
  const said = tryOut(), root = document.documentElement;
  for (const width of [400, 2000, root.clientWidth]) {
    root.style.width = `${width}px`;
    redraw();
    checkWidth(width);
    checkTitles();
    checkBars();
    checkMenus();
  }
  checkCanvases();
  checkFigures();
  root.style.width = '';
  const scheme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
  root.dataset.test = `passed with ${said}, ${scheme}`;
}
