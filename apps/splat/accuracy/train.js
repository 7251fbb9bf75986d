// The page of `splat accuracy --train`: what each reciprocal unit and order of sums costs, and what it does to training.

const single = value => ({ mean: value, least: value, most: value });

// What a setting may be shown against: its value, and what its seeds range over, if they do.
const AXES = {
  machine_seconds: { label: `machine-seconds to ${data.reached_db.toFixed(2)} dB`, of: s => s.machine_seconds, digits: 3 },
  cycles: { label: 'Mcycles per iteration', of: s => s.cycles, scale: 1e-6, digits: 4 },
  ...(data.settings[0].chip_joules && { chip_joules: { label: 'energy of the chip per iteration, mJ', of: s => s.chip_joules, scale: 1e3, digits: 3 } }),
  area: { label: 'area, µm² per pair', of: s => single(s.reciprocal_um2), digits: 0 },
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

// From the least to the greatest of the seeds, on both axes.
const spreads = {
  id: 'spreads',
  beforeDatasetsDraw(chart) {
    const { ctx, scales: { x, y } } = chart;
    ctx.save();
    ctx.strokeStyle = colour('soft');
    for (const { at, db } of chart.data.datasets[0].data)
      for (const [x0, y0, x1, y1] of [[at.mean, db.least, at.mean, db.most], [at.least, db.mean, at.most, db.mean]]) {
        ctx.beginPath();
        ctx.moveTo(x.getPixelForValue(x0), y.getPixelForValue(y0));
        ctx.lineTo(x.getPixelForValue(x1), y.getPixelForValue(y1));
        ctx.stroke();
      }
    ctx.restore();
  },
};

function drawPlot() {
  const { label, logarithmic } = AXES[state.axis];
  const points = data.settings.map(s => {
    const at = placed(s, state.axis), db = s.psnr8_db;
    return { x: at.mean, y: db.mean, name: s.setting, at, db, setting: s };
  });
  const colours = points.map(({ setting: { setting } }) => colour(setting === state.selected ? 'chosen' : setting === 'default' ? 'ink' : 'mark'));
  const ends = axis => points.flatMap(p => [p[axis].least, p[axis].most]);
  drawPoints('plot', points, {
    colours, plugins: [spreads], isNamed: () => true,
    dots: { pointRadius: 6, pointHoverRadius: 8, pointBackgroundColor: colours.map(c => c + '90'), pointHoverBackgroundColor: undefined, pointStyle: points.map(p => (p.name === 'default' ? 'rect' : 'circle')) },
    scales: {
      x: axis(label, { grace: '5%', suggestedMin: Math.min(...ends('at')), suggestedMax: Math.max(...ends('at')), ticks: logarithmic ? { callback: t => `1e${t.toFixed(1)}` } : {} }),
      y: axis(`PSNR of held-out views after ${data.iterations} iterations, dB`, { grace: '5%', suggestedMin: Math.min(...ends('db')), suggestedMax: Math.max(...ends('db')) }),
    },
    label: p => `${p.name}: ${p.db.mean.toFixed(2)} dB, ${label} ${text(p.setting, state.axis)}`,
  });
}

function drawTable() {
  const columns = [['setting', s => s.setting, s => s.setting]];
  for (const axis of ['error', 'area', 'cycles', 'chip_joules', 'machine_seconds'].filter(key => AXES[key]))
    columns.push([AXES[axis].label, s => AXES[axis].of(s).mean, s => text(s, axis)]);
  for (const [label, key] of [['PSNR, mean', 'mean'], ['minimum', 'least'], ['maximum', 'most']])
    columns.push([label, s => s.psnr8_db[key], s => s.psnr8_db[key].toFixed(3)]);
  drawEntries(columns, data.settings, s => s.setting);
}

function drawCurves() {
  const shown = data.curves.filter(c => ['default', state.selected].includes(c.setting));
  byId('selected').textContent = `${state.selected}, one line per seed${state.selected === 'default' ? '' : '; grey: the default'}`;
  drawChart('curves', {
    type: 'scatter',
    data: { datasets: shown.map(({ setting, seed, curve }) => ({
      label: `${setting}, ${seed}`, data: curve.map(p => ({ x: p.machine_seconds, y: p.psnr8_db })), showLine: true, pointRadius: 2, borderWidth: 1.5,
      borderColor: colour(setting === state.selected ? 'chosen' : 'soft'), backgroundColor: colour(setting === state.selected ? 'chosen' : 'soft'),
    })) },
    options: { scales: { x: axis('machine-seconds'), y: axis('PSNR of held-out views, dB') }, plugins: { legend: { position: 'bottom' } } },
  });
}

const draw = () => drawAround(() => {
  drawPlot();
  drawTable();
  drawCurves();
});

function start() {
  byId('machine').textContent = `Times are those of ${data.clocked_machine}.`;
  fill(byId('axis'), Object.entries(AXES).map(([k, a]) => [k, a.label]), value => { state.axis = value; draw(); });
  draw();
}

function tryOut() {
  if (!/ MHz, clock version \d+\.$/.test(byId('machine').textContent)) throw new Error('the times have no machine');
  const { length } = charts.plot.data.datasets[0].data;
  if (length !== data.settings.length) throw new Error('not a point a setting');
  trySelecting(length - 1, 'selected');
  if (charts.curves.data.datasets.length < 2) throw new Error('fewer than two curves');
  tryControls(['axis']);
  document.querySelectorAll('#table th').forEach(cell => cell.dispatchEvent(new MouseEvent('click')));
  if (document.body.innerText.includes('NaN')) throw new Error('something is not a number');
  return `${length} settings`;
}

openPage(start, draw, tryOut);
