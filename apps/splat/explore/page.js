// The page of `splat explore`: draws the machines and lets people choose one.

const AXES = {
  frames_per_second: { label: 'frames a second', scale: 1, digits: 1 },
  chip_joules: { label: 'energy of the chip a frame, mJ', scale: 1e3, digits: 2 },
  chip_mm2: { label: 'area of the chip, mm2', scale: 1, digits: 2 },
};
const SIZES = { whole: 'whole views', small: 'small views' };

const base = data.machines.find(m => m.machine === 'base');
const state = {
  across: 'chip_joules', up: 'frames_per_second', size: 'whole', selected: 'base',
  sort: { n: 1, down: true }, worth: { n: 1, down: true },
};

const isJudged = (m, size) => m[size] && !m[size].refused;
const value = (figures, key) => figures[key] * AXES[key].scale;
const format = (figures, key) => number(value(figures, key), AXES[key].digits);
const kindOf = m => (m.machine === state.selected ? 'chosen' : m === base ? 'ink' : m.on_front ? 'mark' : 'soft');

// An axis around what is shown. A logarithmic one has too few labels unless the values are ten times apart.
function axisAround(key, figures) {
  const values = figures.map(f => value(f, key));
  const [min, max] = [Math.min(...values) / 1.1, Math.max(...values) * 1.1];
  return axis(AXES[key].label, max > 10 * min ? { type: 'logarithmic', min, max } : { type: 'linear', min, max, ticks: { includeBounds: false, maxRotation: 0, callback: tickText } });
}

function drawPlot() {
  // What matters is drawn last, above the others.
  const order = ['soft', 'mark', 'ink', 'chosen'];
  const shown = data.machines.filter(m => isJudged(m, state.size)).sort((a, b) => order.indexOf(kindOf(a)) - order.indexOf(kindOf(b)));
  const figures = shown.map(m => m[state.size]);
  const colours = shown.map(m => colour(kindOf(m)));
  const rings = {
    data: shown.map(m => ({ x: value(m[state.size], state.across), y: value(m[state.size], state.up), machine: m })),
    pointRadius: shown.map(m => (kindOf(m) === 'soft' ? 3 : 5)), pointBorderWidth: 2, pointBackgroundColor: 'transparent', pointBorderColor: colours,
    pointHoverBorderColor: colours, pointHoverBackgroundColor: 'transparent',
  };
  drawChart('plot', {
    type: 'scatter',
    data: { datasets: [rings] },
    options: {
      scales: { x: axisAround(state.across, figures), y: axisAround(state.up, figures) },
      plugins: { legend: { display: false }, tooltip: { callbacks: { label: item => item.raw.machine.machine.split(',') } } },
      onClick: (event, found) => { if (found.length) select(rings.data[found[0].index].machine.machine); },
    },
  });
}

function drawDetails() {
  const m = data.machines.find(one => one.machine === state.selected);
  const box = byId('details');
  box.replaceChildren(element('p', {}, element('b', {}, m.machine)));
  for (const [text, words] of [['--set ', m.settings], ['', m.arguments.join(' ')]])
    if (words) box.append(element('p', { class: 'note' }, element('code', {}, text + words)));
  if (!isJudged(m, 'whole')) {
    box.append(element('p', {}, (m.whole ?? m.small).refused ?? 'It was judged on small views alone.'));
    return;
  }
  const table = element('table', {}, rowOf(['view', 'stage', 'Mcycles', 'share of the frame', 'most cycles go to', 'in % of its cycles', 'work, % of the most', 'DRAM, % of the most'], 'th'));
  for (const view of m.views) {
    const all = view.stages.reduce((sum, s) => sum + s.cycles, 0);
    for (const s of view.stages)
      table.append(rowOf([view.view, s.name, number(s.cycles * 1e-6, 3), `${number(100 * s.cycles / all, 1)} %`, `${s.unit}: ${s.reason}`, number(100 * s.share), number(100 * s.work_share, 1), number(100 * s.memory_share, 1)]));
  }
  box.append(table);
}

// A stage's place: work for the traffic that it makes, and work, as shares of the most. What moves nothing is drawn at the right edge.
const FURTHEST = 1e4;
const placesOf = m => m.views.flatMap(view => view.stages.map(stage => ({
  x: Math.min(FURTHEST, stage.memory_share ? stage.work_share / stage.memory_share : FURTHEST), y: stage.work_share, view: view.view, stage,
}))).filter(p => p.x > 0 && p.y > 0);

function drawRoof() {
  const chosen = data.machines.find(one => one.machine === state.selected);
  const ofChosen = isJudged(chosen, 'whole') ? placesOf(chosen) : [], ofBase = placesOf(base);
  const all = [...ofChosen, ...ofBase];
  const [left, low] = ['x', 'y'].map(key => Math.min(0.1, ...all.map(p => p[key])) / 1.5), right = Math.max(10, ...all.map(p => p.x)) * 1.5;
  const dots = (places, which, filled) => ({
    data: places, pointRadius: filled ? 5 : 7, pointBorderWidth: 2, pointBorderColor: colour(which), pointBackgroundColor: filled ? colour(which) : 'transparent',
  });
  const roof = { data: [{ x: left, y: left }, { x: 1, y: 1 }, { x: right, y: 1 }], showLine: true, pointRadius: 0, pointHitRadius: 0, borderColor: colour('mark'), borderWidth: 1.5 };
  drawChart('roof', {
    type: 'scatter',
    data: { datasets: [dots(ofChosen, 'chosen', true), dots(ofBase, 'ink', false), roof] },
    options: {
      scales: {
        x: axis('work against traffic, as shares of the most', { type: 'logarithmic', min: left, max: right }),
        y: axis('share of the most work', { type: 'logarithmic', min: low, max: 1.3 }),
      },
      plugins: {
        legend: { display: false },
        tooltip: {
          callbacks: {
            label: ({ raw: { view, stage } }) => `${view} ${stage.name}: ${number(100 * stage.work_share, 1)} % of the work, ${number(100 * stage.memory_share, 1)} % of DRAM, ${stage.unit}: ${stage.reason}`,
          },
        },
      },
    },
  });
}

const factor = f => (f === undefined ? '—' : `× ${number(f, 3)}`);

function drawWorth() {
  const columns = [
    ['change', w => w.machine, w => w.machine],
    ['frames a second', w => w.rate_factor ?? 0, w => (w.refused ? `cannot be: ${w.refused}` : factor(w.rate_factor))],
    ['energy of the chip', w => w.energy_factor ?? 0, w => factor(w.energy_factor)],
    ['area of the chip', w => w.area_factor ?? 0, w => factor(w.area_factor)],
  ];
  drawColumns(byId('worth'), columns, data.worth, state.worth, sort => { state.worth = sort; drawWorth(); }, (row, w) => {
    row.addEventListener('click', () => select(w.machine));
  });
}

function drawPairs() {
  const box = byId('pairs');
  if (!data.pairs.length) {
    box.textContent = 'None was found.';
    return;
  }
  const table = element('table', {}, rowOf(['one', 'other', 'together beyond both', 'one standard error'], 'th'));
  for (const p of data.pairs.slice(0, 20))
    table.append(rowOf([p.first, p.second, factor(p.rate_factor), `${number(100 * p.log_error, 1)} %`]));
  box.replaceChildren(table);
}

function drawTable() {
  const entries = data.machines.filter(m => isJudged(m, 'whole'));
  const columns = [['machine', m => m.machine, m => m.machine]];
  for (const key of Object.keys(AXES)) columns.push([AXES[key].label, m => m.whole[key], m => format(m.whole, key)]);
  const most = m => m.views[0].stages.reduce((a, b) => (b.cycles > a.cycles ? b : a));
  columns.push(['longest stage', m => most(m).name, m => `${most(m).name}, ${most(m).unit}: ${most(m).reason}`]);
  drawColumns(byId('table'), columns, entries, state.sort, sort => { state.sort = sort; drawTable(); }, (row, m) => {
    if (m.on_front) row.classList.add('onfront');
    if (m.machine === state.selected) row.classList.add('selected');
    row.addEventListener('click', () => select(m.machine));
  });
}

function drawSummary() {
  const whole = data.machines.filter(m => isJudged(m, 'whole')).length, refused = data.machines.filter(m => (m.whole ?? m.small).refused).length;
  const both = data.small_beside_whole;
  const lines = [`${data.machines.length} machines, ${whole} of them judged on whole views (${data.views.join(', ')}), ${data.front.length} on the front, ${refused} cannot be.`];
  if (both)
    lines.push(`Small views put ${both.machines} machines that were drawn at random in the order of whole ones with a rank correlation of ` +
      `${number(both.rate, 3)} by frames a second and ${number(both.chip_joules, 3)} by energy.`);
  if (data.different_pictures > 1) lines.push(`The machines draw ${data.different_pictures} pictures that differ in some bits.`);
  byId('summary').textContent = lines.join(' ');
}

function select(machine) {
  state.selected = machine;
  draw();
}

function draw() {
  drawPlot();
  drawDetails();
  drawRoof();
  drawWorth();
  drawTable();
}

function start() {
  const choose = (id, choices) => {
    fill(byId(id), choices, chosen => { state[id] = chosen; draw(); });
    byId(id).value = state[id];
  };
  const axes = Object.entries(AXES).map(([key, a]) => [key, a.label]);
  choose('across', axes);
  choose('up', axes);
  choose('size', Object.entries(SIZES).filter(([key]) => data.machines.some(m => isJudged(m, key))));
  drawSummary();
  drawPairs();
  draw();
}

function tryOut() {
  const points = charts.plot.data.datasets[0].data;
  if (points.length < 2) throw new Error('fewer than two machines');
  charts.plot.options.onClick({}, [{ index: 0 }]);
  if (!byId('details').textContent.startsWith(points[0].machine.machine)) throw new Error('a click selects nothing');
  if (!document.querySelector('tr.selected')) throw new Error('no selection shown');
  if (!charts.roof.data.datasets[1].data.length) throw new Error('no stage under the roof');
  if (charts.roof.data.datasets[1].data.some(p => p.y > 1 || p.stage.memory_share > 1)) throw new Error('a stage is above the roof');
  tryControls(['across', 'up', 'size']);
  if (document.body.innerText.includes('NaN')) throw new Error('something is not a number');
  return `${points.length} machines`;
}

openPage(start, draw, tryOut);
