// The page of `splat accuracy --train`: what each reciprocal unit and order of sums costs, and what it does to training.

const single = value => ({ mean: value, least: value, most: value });

// What a setting may be shown against: its value, and what its seeds range over, if they do.
const AXES = {
  machine_seconds: { label: `machine-seconds to ${data.reached_db.toFixed(2)} dB`, of: s => s.machine_seconds, digits: 3 },
  cycles: { label: 'Mcycles an iteration', of: s => s.cycles, scale: 1e-6, digits: 4 },
  area: { label: 'area, um² a pair', of: s => single(s.reciprocal_um2), digits: 0 },
  error: { label: 'gradient error', of: s => single(s.gradient_error.largest), logarithmic: true },
};
const state = { axis: 'machine_seconds', selected: 'default', sort: { n: 0, down: false } };

// A setting's mean, least and most on an axis, as they are drawn.
function placed(setting, axis) {
  const { of, scale = 1, logarithmic } = AXES[axis];
  const drawn = v => logarithmic ? Math.log10(Math.max(1e-9, v)) : v * scale;
  return Object.fromEntries(['mean', 'least', 'most'].map(k => [k, drawn(of(setting)[k])]));
}

function text(setting, axis) {
  const { of, scale = 1, digits, logarithmic } = AXES[axis];
  const { mean, least, most } = of(setting);
  if (logarithmic) return mean.toExponential(1);
  const one = v => (v * scale).toFixed(digits);
  return least === most ? one(mean) : `${one(mean)} (${one(least)} to ${one(most)})`;
}

function drawPlot() {
  const { settings } = data, svg = byId('plot');
  const at = settings.map(s => placed(s, state.axis)), db = settings.map(s => s.psnr8_db);
  const { label, logarithmic } = AXES[state.axis];
  const { px, py } = drawAxes(svg,
    { values: at.flatMap(p => [p.least, p.most]), label, tick: logarithmic && (t => `1e${t.toFixed(1)}`) || undefined },
    { values: db.flatMap(p => [p.least, p.most]), label: `PSNR of held-out views after ${data.iterations} iterations, dB` });
  const middle = n => [px(at[n].mean), py(db[n].mean)];
  settings.forEach((_, n) => {
    const [cx, cy] = middle(n);
    svg.append(element('line', { class: 'spread', x1: cx, x2: cx, y1: py(db[n].least), y2: py(db[n].most) }),
      element('line', { class: 'spread', x1: px(at[n].least), x2: px(at[n].most), y1: cy, y2: cy }));
  });
  settings.forEach((s, n) => {
    const [cx, cy] = middle(n);
    const names = ['dot', s.setting === 'default' && 'default', s.setting === state.selected && 'selected'];
    const dot = element('circle', { class: names.filter(Boolean).join(' '), cx, cy, r: 5, 'data-setting': s.setting, tabindex: 0 },
      element('title', {}, `${s.setting}: ${db[n].mean.toFixed(2)} dB, ${label} ${text(s, state.axis)}`));
    dot.addEventListener('click', () => select(s.setting));
    svg.append(dot);
  });
}

function drawTable() {
  const columns = [['setting', s => s.setting, s => s.setting]];
  for (const axis of ['error', 'area', 'cycles', 'machine_seconds'])
    columns.push([AXES[axis].label, s => AXES[axis].of(s).mean, s => text(s, axis)]);
  for (const [label, key] of [['PSNR, mean', 'mean'], ['least', 'least'], ['greatest', 'most']])
    columns.push([label, s => s.psnr8_db[key], s => s.psnr8_db[key].toFixed(3)]);
  drawColumns(byId('table'), columns, data.settings, state.sort, sort => { state.sort = sort; draw(); }, (row, s) => {
    if (s.setting === state.selected) row.classList.add('selected');
    row.addEventListener('click', () => select(s.setting));
  });
}

function drawCurves() {
  const shown = data.curves.filter(c => ['default', state.selected].includes(c.setting));
  byId('selected').textContent = `${state.selected}, a line a seed; grey: the default`;
  const points = shown.flatMap(c => c.curve), svg = byId('curves');
  const { px, py } = drawAxes(svg, { values: points.map(p => p.machine_seconds), label: 'machine-seconds' },
    { values: points.map(p => p.psnr8_db), label: 'PSNR of held-out views, dB' });
  for (const { setting, curve } of shown)
    svg.append(element('path', { class: setting === state.selected ? 'curve' : 'curve default',
      d: 'M' + curve.map(p => `${px(p.machine_seconds)} ${py(p.psnr8_db)}`).join('L') }));
}

function draw() {
  drawPlot();
  drawTable();
  drawCurves();
}

function select(setting) {
  state.selected = setting;
  draw();
}

function start() {
  fill(byId('axis'), Object.entries(AXES).map(([k, a]) => [k, a.label]), value => { state.axis = value; draw(); });
  draw();
}

function tryOut() {
  const dots = [...document.querySelectorAll('#plot .dot')];
  if (dots.length !== data.settings.length) throw new Error('not a dot a setting');
  const setting = dots[dots.length - 1].dataset.setting;
  dots[dots.length - 1].dispatchEvent(new MouseEvent('click'));
  if (!byId('selected').textContent.startsWith(setting)) throw new Error('a click selects nothing');
  if (!document.querySelector('#plot .selected') || !document.querySelector('tr.selected')) throw new Error('no selection shown');
  if (document.querySelectorAll('#curves .curve').length < 2) throw new Error('fewer than two curves');
  tryControls(['axis']);
  document.querySelectorAll('#table th').forEach(cell => cell.dispatchEvent(new MouseEvent('click')));
  if (['plot', 'table', 'curves'].some(id => byId(id).outerHTML.includes('NaN'))) throw new Error('something is not a number');
  return `passed with ${dots.length} dots`;
}

openPage(start, tryOut);
