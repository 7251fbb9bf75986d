// The page of `splat accuracy SCENE`: draws the measurements and lets people choose.

// What a dot may be judged by. `logarithmic`: small errors over many orders of magnitude are shown by their logarithm.
const METRICS = {
  psnr_db: { label: 'PSNR, dB', digits: 1 },
  ssim: { label: 'SSIM', digits: 6, logarithmic: true },
  largest: { label: 'largest error', digits: 5, logarithmic: true },
  off_share: { label: 'pixels off by more than 1/255, %', digits: 4, scale: 100, logarithmic: true },
};
const AXES = {
  cycles: { label: 'machine cycles, 16 lanes', scale: 1e-6, unit: 'M' },
  equal_area_cycles: { label: 'machine cycles at equal area', scale: 1e-6, unit: 'M' },
  cores_cycles: { label: 'machine cycles, kernels only', scale: 1e-6, unit: 'M' },
};
// Shown as this where pictures are equal, which JSON has no number for.
const EQUAL_DB = 200;
// Times beyond so many times the default's are drawn at the edge.
const MOST_OF_DEFAULT = 1.4;

// `view`: 0 for all views together, else the number of one.
const state = { view: 0, metric: 'psnr_db', axis: 'cycles', floor: data.floor_db, selected: null, sort: null };

// The settings over a choice of views, from one of data.summaries: with the errors of the pictures that the axis times.
function entriesOf(summary) {
  return summary.settings.map(one => {
    const errors = { ...(state.axis === 'cores_cycles' && one.cores_errors ? one.cores_errors : one.errors) };
    errors.psnr_db ??= EQUAL_DB;
    return { ...one, errors };
  });
}

// The entry that is recommended for `floor` dB, if any.
function recommend(summary, entries, floor) {
  const step = summary.recommended[state.axis].find(s => s.most_db === null || floor <= s.most_db);
  return step && entries[step.best];
}

function format(value, { digits, scale = 1 }) {
  return value >= EQUAL_DB && digits === 1 ? 'equal' : (value * scale).toFixed(digits);
}
function time(value, axis) {
  return value === null ? '—' : `${(value * AXES[axis].scale).toFixed(3)} ${AXES[axis].unit}`;
}
function change(value, base) {
  if (value === null || base === null) return '';
  const share = 100 * (value / base - 1);
  return `${share >= 0 ? '+' : '−'}${Math.abs(share).toFixed(1)} %`;
}

function drawPlot(entries, front, best) {
  const { left, right } = PLOT;
  const { metric, axis } = state;
  const shown = entries.filter(e => e.times[axis] !== null);
  const svg = byId('plot');
  svg.replaceChildren();
  if (!shown.length) return;
  const metricScale = METRICS[metric].scale ?? 1;
  const { logarithmic } = METRICS[metric];
  const height = e => {
    const value = e.errors[metric];
    if (metric === 'ssim') return -Math.log10(Math.max(1e-12, 1 - value));
    return logarithmic ? Math.log10(Math.max(1e-9, value * metricScale)) : Math.min(value, EQUAL_DB);
  };
  // What is much slower than the default would press all others together: it goes to the right edge.
  const base = entries.find(e => e.setting === 'default')?.times[axis] ?? Infinity;
  const times = shown.map(e => Math.min(e.times[axis], MOST_OF_DEFAULT * base) * AXES[axis].scale);
  const tick = metric === 'ssim' ? t => `1−1e${(-t).toFixed(1)}` : logarithmic ? t => `1e${t.toFixed(1)}` : undefined;
  const { px, py, y0, y1 } = drawAxes(svg, { values: times, label: `${AXES[axis].label}, ${AXES[axis].unit}` },
    { values: shown.map(height), label: METRICS[metric].label, tick });
  const place = e => [px(e.times[axis] * AXES[axis].scale), py(height(e))];
  svg.append(element('path', { class: 'front', d: 'M' + front.map(e => place(e).join(' ')).join('L') }));
  if (metric === 'psnr_db' && state.floor > y0 && state.floor < y1)
    svg.append(element('line', { class: 'floor', x1: left, x2: right, y1: py(state.floor), y2: py(state.floor) }));
  for (const e of shown) {
    const [cx, cy] = place(e);
    const names = ['dot', front.includes(e) && 'onfront', e === best && 'best', e.setting === 'default' && 'default',
      e.setting === state.selected && 'selected', cx >= right && 'beyond'].filter(Boolean).join(' ');
    const dot = element('circle', { class: names, cx, cy, r: 5, 'data-setting': e.setting, tabindex: 0 });
    dot.addEventListener('mouseenter', event => showTip(e, event));
    dot.addEventListener('mouseleave', () => { byId('tip').style.display = 'none'; });
    dot.addEventListener('click', () => select(e.setting));
    svg.append(dot);
  }
}

const pointsOf = setting => data.points.filter(p => p.setting === setting && (state.view === 0 || p.view === data.views[state.view - 1]));

function pictures(point) {
  const box = element('div', { class: 'pair' });
  for (const [source, text] of [[point.picture, `${point.view}`], [point.difference, 'difference, 1e-5 black to 1 white, red beyond 1/255']])
    box.append(element('div', {}, element('img', { src: source, alt: text }), text));
  return box;
}

function showTip(entry, event) {
  const tip = byId('tip');
  tip.replaceChildren(element('b', {}, entry.setting), element('div', {},
    `${format(entry.errors.psnr_db, METRICS.psnr_db)} dB, ${time(entry.times[state.axis], state.axis)}`), pictures(pointsOf(entry.setting)[0]));
  tip.style.display = 'block';
  tip.style.left = Math.min(event.clientX + 15, window.innerWidth - 530) + 'px';
  tip.style.top = Math.min(event.clientY + 15, window.innerHeight - 230) + 'px';
}

function drawTable(entries, front, base) {
  const columns = [['setting', e => e.setting, e => e.setting]];
  for (const [key, metric] of Object.entries(METRICS))
    columns.push([metric.label, e => e.errors[key], e => format(e.errors[key], metric)]);
  for (const axis of Object.keys(AXES))
    columns.push([AXES[axis].label, e => e.times[axis] ?? Infinity,
      e => `${time(e.times[axis], axis)} ${base ? change(e.times[axis], base.times[axis]) : ''}`]);
  columns.push(['lane area', e => e.area, e => `${(100 * e.area).toFixed(1)} %`]);
  drawColumns(byId('table'), columns, entries, state.sort ?? { n: 1, down: true }, sort => { state.sort = sort; draw(); }, (row, e) => {
    if (front.includes(e)) row.classList.add('onfront');
    if (e.setting === state.selected) row.classList.add('selected');
    row.addEventListener('click', () => select(e.setting));
  });
}

function drawRecommended() {
  const box = byId('recommended');
  const chosen = recommend(data.chosen, entriesOf(data.chosen), state.floor);
  if (!chosen) {
    box.textContent = `No setting reaches ${state.floor} dB on ${data.chosen_on.join(', ')} with this time.`;
    return;
  }
  const table = element('table', {}, rowOf(['view', 'used for', 'PSNR, dB', 'SSIM', AXES[state.axis].label, 'against the default'], 'th'));
  for (const [n, view] of data.views.entries()) {
    const all = entriesOf(data.summaries[n + 1]);
    const own = all.find(e => e.setting === chosen.setting), base = all.find(e => e.setting === 'default');
    if (!own || !base) continue;
    const row = rowOf([view, data.chosen_on.includes(view) ? 'choosing' : 'checking', format(own.errors.psnr_db, METRICS.psnr_db),
      format(own.errors.ssim, METRICS.ssim), time(own.times[state.axis], state.axis), change(own.times[state.axis], base.times[state.axis])]);
    row.children[2].className = own.errors.psnr_db >= state.floor ? 'kept' : 'missed';
    table.append(row);
  }
  box.replaceChildren(element('p', {}, element('b', {}, chosen.setting),
    `, the fastest with at least ${state.floor} dB on ${data.chosen_on.join(', ')}; lane area ${(100 * chosen.area).toFixed(1)} % of the default's`), table);
}

function drawFree(free, base) {
  if (!base) return;
  const table = element('table', {}, rowOf(['setting', 'cycles', 'PSNR, dB', 'lane area', 'at equal area'], 'th'));
  for (const e of free)
    table.append(rowOf([e.setting, 'free: ' + change(e.times.cycles, base.times.cycles), format(e.errors.psnr_db, METRICS.psnr_db),
      `${(100 * e.area).toFixed(1)} %`, change(e.times.equal_area_cycles, base.times.equal_area_cycles)]));
  byId('free').replaceChildren(table);
}

function drawDetails(entries, base) {
  const e = entries.find(x => x.setting === state.selected);
  if (!e) return;
  const list = element('p', {}, element('b', {}, e.setting));
  for (const [key, metric] of Object.entries(METRICS)) list.append(`; ${metric.label} ${format(e.errors[key], metric)}`);
  for (const axis of Object.keys(AXES))
    if (e.times[axis] !== null)
      list.append(`; ${AXES[axis].label} ${time(e.times[axis], axis)} ${base ? change(e.times[axis], base.times[axis]) : ''}`);
  byId('details').replaceChildren(list, ...pointsOf(e.setting).map(pictures));
}

function select(setting) {
  state.selected = setting;
  draw();
}

function draw() {
  const summary = data.summaries[state.view], entries = entriesOf(summary);
  const base = entries.find(e => e.setting === 'default');
  const front = summary.fronts[state.metric][state.axis].map(n => entries[n]);
  const best = recommend(summary, entries, state.floor);
  drawPlot(entries, front, best);
  drawTable(entries, front, base);
  drawRecommended();
  drawFree(summary.free.map(n => entries[n]), base);
  drawDetails(entries, base);
}

function start() {
  const choose = (id, choices, read = v => v) => fill(byId(id), choices, value => { state[id] = read(value); draw(); });
  choose('view', [[0, 'all (worst error, sum of times)'], ...data.views.map((v, n) => [n + 1, v])], Number);
  choose('metric', Object.entries(METRICS).map(([k, m]) => [k, m.label]));
  choose('axis', Object.entries(AXES).map(([k, a]) => [k, a.label]));
  byId('floor').value = state.floor;
  byId('floor').addEventListener('input', () => { state.floor = +byId('floor').value; draw(); });
  draw();
}

function tryOut() {
  const dots = [...document.querySelectorAll('.dot')];
  if (dots.length < 2) throw new Error('fewer than two dots');
  const dot = dots[dots.length - 1], setting = dot.dataset.setting;
  dot.dispatchEvent(new MouseEvent('mouseenter', { clientX: 10, clientY: 10 }));
  if (byId('tip').style.display !== 'block' || !byId('tip').querySelector('img')) throw new Error('no picture on hover');
  dot.dispatchEvent(new MouseEvent('mouseleave'));
  dot.dispatchEvent(new MouseEvent('click'));
  if (!byId('details').textContent.startsWith(setting)) throw new Error('a click selects nothing');
  if (!document.querySelector('.dot.selected') || !document.querySelector('tr.selected')) throw new Error('no selection shown');
  tryControls(['view', 'metric', 'axis']);
  return `passed with ${dots.length} dots`;
}

openPage(start, tryOut);
