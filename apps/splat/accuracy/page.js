// The page of `splat accuracy SCENE`: plots the measurements.

// The errors of a setting. `place`: position on the axis, higher for better; `tick`: label of the position.
const power = t => `1e${-t}`;
const METRICS = {
  psnr_db: { label: 'PSNR, dB', digits: 1 },
  ssim: { label: 'SSIM', digits: 6, place: v => -Math.log10(Math.max(1e-12, 1 - v)), tick: t => `1 − ${power(t)}` },
  largest: { label: 'largest error', digits: 5, place: v => -Math.log10(Math.max(1e-9, v)), tick: power },
  off_share: { label: 'pixels off by more than 1/255, %', digits: 4, scale: 100, place: v => -Math.log10(Math.max(1e-9, 100 * v)), tick: power },
};
const ALL_AXES = {
  cycles: { label: 'machine cycles, 16 lanes', scale: 1e-6, unit: 'M' },
  equal_area_cycles: { label: 'machine cycles at equal area', scale: 1e-6, unit: 'M' },
  cores_cycles: { label: 'machine cycles, kernels only', scale: 1e-6, unit: 'M' },
  chip_joules: { label: 'energy of the chip', scale: 1e3, unit: 'mJ' },
};
// Energy is there where it was asked for.
const AXES = Object.fromEntries(Object.entries(ALL_AXES).filter(([key]) => key !== 'chip_joules' || data.summaries[0].settings.some(s => s.times[key] !== null)));
// Shown as this where pictures are equal, which JSON has no number for.
const EQUAL_DB = 200;
// Times beyond so many times the default's are drawn at the edge.
const MOST_OF_DEFAULT = 1.4;

// The axis on which a front can be seen: with the most of the settings on it.
function seenAxis() {
  const fronts = data.summaries[0].fronts.psnr_db;
  return Object.keys(AXES).reduce((best, axis) => (fronts[axis].length > fronts[best].length ? axis : best));
}

// `view`: 0 for all views together, else the number of one.
const state = { view: 0, metric: 'psnr_db', axis: seenAxis(), floor: data.floor_db, selected: null, sort: { n: 1, down: true } };

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
function changeOf(value, base) {
  if (value === null || base === null) return '';
  const share = 100 * (value / base - 1), size = Math.abs(share).toFixed(1);
  return size === '0.0' ? '0.0 %' : `${share > 0 ? '+' : '−'}${size} %`;
}

// Of a lane, of the default's. Some knobs have no modelled cost.
const areaOf = e => (e.has_cost ? `${(100 * e.area).toFixed(1)} %` : 'not modelled');

// A colour for each kind of setting; the first that holds decides.
function kindOf(e, front, best) {
  return e.setting === state.selected ? 'chosen' : e === best ? 'good' : e.setting === 'default' ? 'ink' : front.includes(e) ? 'mark' : 'soft';
}

// Rings of settings that would cover each other become larger, one after the other, so that each can be seen.
const spread = {
  id: 'spread',
  afterUpdate(chart) {
    const placed = [], { data: points } = chart.data.datasets[0];
    chart.getDatasetMeta(0).data.forEach((ring, n) => {
      const radius = points[n].radius = 5 + 3.5 * placed.filter(p => Math.hypot(p.x - ring.x, p.y - ring.y) < 9).length;
      ring.options = { ...ring.options, radius, hoverRadius: radius };
      placed.push(ring);
    });
  },
};

function drawPlot(entries, front, best) {
  const { metric, axis: time } = state;
  const { place, tick, label } = METRICS[metric];
  const shown = entries.filter(e => e.times[time] !== null);
  if (!shown.length) {
    charts.plot?.destroy();
    return;
  }
  // Equal pictures have no PSNR: they stand above the others.
  const most = Math.max(...shown.map(e => e.errors.psnr_db).filter(v => v < EQUAL_DB), state.floor);
  const equal = Math.ceil(most / 10) * 10 + 10;
  const height = e => (place ? place(e.errors[metric]) : e.errors[metric] >= EQUAL_DB ? equal : e.errors[metric]);
  // What is much slower than the default would press all others together: it goes to the right edge.
  const base = entries.find(e => e.setting === 'default')?.times[time] ?? Infinity;
  const edge = MOST_OF_DEFAULT * base;
  const points = shown.map(e => ({ x: Math.min(e.times[time], edge) * AXES[time].scale, y: height(e), name: e.setting, entry: e, beyond: e.times[time] > edge }));
  const lines = [lineOf('Pareto front', front.map(e => ({ x: e.times[time] * AXES[time].scale, y: height(e) })), 'mark')];
  const [low, high] = [Math.min(...points.map(p => p.x)), Math.max(...points.map(p => p.x))];
  const room = 0.04 * (high - low || high);
  if (metric === 'psnr_db') lines.push(lineOf('minimum', [{ x: low - room, y: state.floor }, { x: high + room, y: state.floor }], 'bad', { borderDash: [5, 4] }));
  const ticks = { callback: value => (tick ? (Number.isInteger(value) ? tick(value) : '') : value === equal ? 'equal' : value > most + 5 ? '' : value) };
  drawPoints('plot', points, {
    isNamed: p => ['chosen', 'good', 'ink', 'mark'].includes(kindOf(p.entry, front, best)),
    colours: points.map(p => colour(kindOf(p.entry, front, best))), dots: { pointBorderWidth: 2.5, pointHoverBorderWidth: 3.5 }, more: lines, plugins: [spread, dashBeyond],
    scales: {
      x: axis(`${AXES[time].label}, ${AXES[time].unit}`, { min: low - room, max: high + room, ticks: { includeBounds: false, maxRotation: 0, callback: tickText } }),
      y: axis(`${label}, better is higher`, { grace: '6%', ticks }),
    },
    others: { layout: { padding: { right: 14, top: 8 } }, onHover: (event, found) => showTip(entriesAt(found), event.native) },
  });
}

// The settings of what a chart found under the pointer.
const entriesAt = found => found.filter(f => f.datasetIndex === 0).map(f => charts.plot.data.datasets[0].data[f.index].entry);

// A second, dashed ring around what is slower than is shown.
const dashBeyond = {
  id: 'dashBeyond',
  afterDatasetsDraw(chart) {
    const { ctx, data: { datasets } } = chart;
    ctx.save();
    ctx.setLineDash([3, 3]);
    ctx.strokeStyle = colour('soft');
    chart.getDatasetMeta(0).data.forEach((point, n) => {
      if (!datasets[0].data[n]?.beyond) return;
      ctx.beginPath();
      ctx.arc(point.x, point.y, (datasets[0].data[n].radius ?? 5) + 3, 0, 2 * Math.PI);
      ctx.stroke();
    });
    ctx.restore();
  },
};

const pointsOf = setting => data.points.filter(p => p.setting === setting && (state.view === 0 || p.view === data.views[state.view - 1]));

function pictures(point) {
  const box = element('div', { class: 'pair' });
  for (const [source, text] of [[point.picture, `${point.view}`], [point.difference, 'difference, 1e-5 black to 1 white, red beyond 1/255']])
    box.append(element('div', {}, element('img', { src: source, alt: text }), text));
  return box;
}

function showTip(found, event) {
  const tip = byId('tip');
  tip.style.display = found.length ? 'block' : 'none';
  if (!found.length) return;
  const lines = found.map(e => element('div', {}, element('b', {}, e.setting), `: ${format(e.errors.psnr_db, METRICS.psnr_db)} dB, ${time(e.times[state.axis], state.axis)}`));
  tip.replaceChildren(...lines, pictures(pointsOf(found[0].setting)[0]));
  tip.style.left = Math.max(5, Math.min(event.clientX + 15, window.innerWidth - 530)) + 'px';
  tip.style.top = Math.max(5, Math.min(event.clientY + 15, window.innerHeight - 260)) + 'px';
}

function drawTable(entries, front, base) {
  const columns = [['setting', e => e.setting, e => e.setting]];
  for (const [key, metric] of Object.entries(METRICS))
    columns.push([metric.label, e => e.errors[key], e => format(e.errors[key], metric)]);
  for (const axis of Object.keys(AXES))
    columns.push([AXES[axis].label, e => e.times[axis] ?? Infinity, e => time(e.times[axis], axis)],
      ['change', e => e.times[axis] ?? Infinity, e => (base ? changeOf(e.times[axis], base.times[axis]) : '')]);
  columns.push(['lane area', e => e.area, areaOf]);
  drawEntries(columns, entries, e => e.setting, e => front.includes(e));
}

// Why the recommended setting is not on the displayed front; empty if it is.
function whyOffFront(chosen, front) {
  if (front.some(e => e.setting === chosen.setting)) return '';
  const reasons = [];
  if (state.metric !== 'psnr_db') reasons.push(`uses ${METRICS[state.metric].label}, and the recommendation uses PSNR`);
  const shown = state.view === 0 ? data.views : [data.views[state.view - 1]];
  if (shown.join() !== data.chosen_on.join()) reasons.push(`is that of ${shown.join(', ')}, and the recommendation that of ${data.chosen_on.join(', ')}`);
  return `It is not on the displayed front, which ${reasons.join('; it ')}.`;
}

function drawRecommended(front) {
  const box = byId('recommended');
  const chosen = recommend(data.chosen, entriesOf(data.chosen), state.floor);
  if (!chosen) {
    box.textContent = `No setting reaches ${state.floor} dB on ${data.chosen_on.join(', ')} with this cost.`;
    return;
  }
  const table = element('table', {}, rowOf(['view', 'used for', 'PSNR, dB', 'SSIM', AXES[state.axis].label, 'change from the default'], 'th'));
  for (const [n, view] of data.views.entries()) {
    const all = entriesOf(data.summaries[n + 1]);
    const own = all.find(e => e.setting === chosen.setting), base = all.find(e => e.setting === 'default');
    if (!own || !base) continue;
    const row = rowOf([view, data.chosen_on.includes(view) ? 'selection' : 'check', format(own.errors.psnr_db, METRICS.psnr_db),
      format(own.errors.ssim, METRICS.ssim), time(own.times[state.axis], state.axis), changeOf(own.times[state.axis], base.times[state.axis])]);
    row.children[2].className = own.errors.psnr_db >= state.floor ? 'kept' : 'missed';
    table.append(row);
  }
  box.replaceChildren(element('p', {}, element('b', {}, chosen.setting),
    `, the ${state.axis === 'chip_joules' ? 'setting with the lowest energy' : 'fastest setting'} with at least ${state.floor} dB on ${data.chosen_on.join(', ')}; lane area, of the default's: ${areaOf(chosen)}`), element('p', { id: 'off-front' }, whyOffFront(chosen, front)), table);
}

function drawFree(free, base) {
  if (!base) return;
  const table = element('table', {}, rowOf(['setting', 'change of cycles', 'PSNR, dB', 'lane area', 'at equal area'], 'th'));
  for (const e of free)
    table.append(rowOf([e.setting, changeOf(e.times.cycles, base.times.cycles), format(e.errors.psnr_db, METRICS.psnr_db),
      areaOf(e), changeOf(e.times.equal_area_cycles, base.times.equal_area_cycles)]));
  byId('free').replaceChildren(table);
}

function drawDetails(entries, base) {
  const e = entries.find(x => x.setting === state.selected);
  if (!e) return;
  const list = element('p', {}, element('b', {}, e.setting));
  for (const [key, metric] of Object.entries(METRICS)) list.append(`; ${metric.label} ${format(e.errors[key], metric)}`);
  for (const axis of Object.keys(AXES))
    if (e.times[axis] !== null)
      list.append(`; ${AXES[axis].label} ${time(e.times[axis], axis)} ${base ? changeOf(e.times[axis], base.times[axis]) : ''}`);
  byId('details').replaceChildren(list, ...pointsOf(e.setting).map(pictures));
}

const draw = () => drawAround(() => {
  const summary = data.summaries[state.view], entries = entriesOf(summary);
  const base = entries.find(e => e.setting === 'default');
  const front = summary.fronts[state.metric][state.axis].map(n => entries[n]);
  const best = recommend(summary, entries, state.floor);
  drawPlot(entries, front, best);
  drawTable(entries, front, base);
  drawRecommended(front);
  drawFree(summary.free.map(n => entries[n]), base);
  drawDetails(entries, base);
});

// Seconds of the host for ways to simulate, with the error of their cycles.
function drawHost() {
  byId('host-section').hidden = data.host.length === 0;
  const seconds = h => h.seconds.length === 0 ? '–' : [Math.min(...h.seconds), Math.max(...h.seconds)].map(s => s.toPrecision(3))
    .filter((s, n, all) => n === 0 || s !== all[0]).join(' to ') + (h.extrapolated ? ' (extrapolated)' : '');
  const off = h => h.cycles_error_percent === null ? '–' : `${h.cycles_error_percent.toFixed(2)} %`;
  byId('host').append(rowOf(['simulation', 'host, s', 'cycle error', ''], 'th'),
    ...data.host.map(h => rowOf([h.simulation, seconds(h), off(h), h.note])));
}

function start() {
  byId('verdict').textContent = data.verdict;
  drawHost();
  byId('machine').textContent = `Times are those of ${data.clocked_machine}.`;
  const choose = (id, choices, read = v => v) => fill(byId(id), choices, value => { state[id] = read(value); draw(); });
  choose('view', [[0, 'all (worst error, sum of times)'], ...data.views.map((v, n) => [n + 1, v])], Number);
  choose('metric', Object.entries(METRICS).map(([k, m]) => [k, m.label]));
  choose('axis', Object.entries(AXES).map(([k, a]) => [k, a.label]));
  byId('axis').value = state.axis;
  byId('floor').value = state.floor;
  byId('floor').addEventListener('input', () => { state.floor = +byId('floor').value; draw(); });
  draw();
}

// Whatever is shown, the recommended setting is on the front, or a sentence says why not.
function checkRecommended() {
  for (const metric of Object.keys(METRICS))
    for (let view = 0; view <= data.views.length; ++view)
      for (const axis of Object.keys(AXES)) {
        Object.assign(state, { metric, view, axis });
        draw();
        const chosen = recommend(data.chosen, entriesOf(data.chosen), state.floor);
        if (!chosen) continue;
        const front = data.summaries[view].fronts[metric][axis].map(n => data.summaries[view].settings[n].setting);
        const why = byId('off-front').textContent;
        if (front.includes(chosen.setting) ? why !== '' : !/ uses | is that of /.test(why)) throw new Error(`${chosen.setting}, of ${axis} and ${metric}: ${why}`);
      }
  Object.assign(state, { metric: 'psnr_db', view: 0, axis: seenAxis() });
  draw();
}

function tryOut() {
  if (!/ MHz, clock version \d+\.$/.test(byId('machine').textContent)) throw new Error('the times have no machine');
  checkRecommended();
  const index = charts.plot.data.datasets[0].data.length - 1, found = [{ datasetIndex: 0, index }];
  charts.plot.options.onHover({ native: { clientX: 10, clientY: 10 } }, found);
  if (byId('tip').style.display !== 'block' || !byId('tip').querySelector('img')) throw new Error('no picture on hover');
  charts.plot.options.onHover({}, []);
  const points = trySelecting(index, 'details');
  const covered = charts.plot.getDatasetMeta(0).data.filter((p, n, all) =>
    all.some((q, m) => m < n && Math.hypot(p.x - q.x, p.y - q.y) < 1 && p.options.radius === q.options.radius));
  if (covered.length) throw new Error(`${covered.length} settings are hidden`);
  tryControls(['view', 'metric', 'axis']);
  return `${points.length} settings`;
}

openPage(start, draw, tryOut);
