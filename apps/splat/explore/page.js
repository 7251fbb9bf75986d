// The page of `splat explore`: plots the machines, of which one can be selected.

// What a machine does: the names of its figures, and of their factors against the base.
const WORK = {
  frames: {
    unit: 'frame', each: 'a frame', rate: 'frames_per_second', joules: 'chip_joules', rateFactor: 'rate_factor', energyFactor: 'energy_factor',
    rateLabel: 'frames per second', energyLabel: 'energy of the chip per frame', rateOrder: 'rate', energyOrder: 'chip_joules',
  },
  iterations: {
    unit: 'iteration', each: 'an iteration', rate: 'iterations_per_second', joules: 'iteration_joules', rateFactor: 'iteration_rate_factor', energyFactor: 'iteration_energy_factor',
    rateLabel: 'iterations per second', energyLabel: 'energy of the chip per iteration', rateOrder: 'iteration_rate', energyOrder: 'iteration_joules',
  },
};

const base = data.machines.find(m => m.machine === 'base');
const parts = data.parts ?? [];
const work = Object.values(WORK).filter(w => w.rate in base.whole);

// A part that is alone of its kind has the workload's figures.
const apart = parts.map((p, n) => ({ ...p, n })).filter(p => parts.filter(q => q.work === p.work).length > 1);

// What machines can be compared by: `of` takes it from the figures of a size. The parts' come after the workload's.
const AXES = {};
for (const w of work) {
  AXES[w.rate] = { label: w.rateLabel, of: f => f[w.rate], digits: 1 };
  AXES[w.joules] = { label: `${w.energyLabel}, mJ`, of: f => 1e3 * f[w.joules], digits: 2 };
}
AXES.chip_mm2 = { label: 'area of the chip, mm2', of: f => f.chip_mm2, digits: 2 };
for (const p of apart) {
  const w = WORK[p.work];
  AXES[`${p.part} ${w.rate}`] = { label: `${p.part}: ${w.rateLabel}`, of: f => f.parts[p.n][w.rate], digits: 1 };
  AXES[`${p.part} ${w.joules}`] = { label: `${p.part}: mJ of the chip per ${w.unit}`, of: f => 1e3 * f.parts[p.n][w.joules], digits: 2 };
}
const SIZES = { whole: 'full-size views', small: 'small views' };

const state = {
  across: work[0].joules, up: work[0].rate, size: 'whole', selected: 'base',
  sort: { n: 1, down: true }, worth: { n: 1, down: true },
};

const isJudged = (m, size) => m[size] && !m[size].refused;
const value = (figures, key) => AXES[key].of(figures);
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
  const points = shown.map(m => ({ x: value(m[state.size], state.across), y: value(m[state.size], state.up), name: m.machine }));
  drawPoints('plot', points, {
    isNamed: p => kindOf(data.machines.find(m => m.machine === p.name)) !== 'soft',
    colours: shown.map(m => colour(kindOf(m))), dots: { pointRadius: shown.map(m => (kindOf(m) === 'soft' ? 3 : 5)) },
    scales: { x: axisAround(state.across, figures), y: axisAround(state.up, figures) }, label: p => p.name.split(','),
  });
}

// The shares of a workload's parts, and what their own fronts have in common with the workload's.
function drawParts() {
  if (!parts.length) return;
  byId('workload').hidden = false;
  const chosen = data.machines.find(one => one.machine === state.selected);
  const shown = isJudged(chosen, 'whole') && chosen !== base ? [base, chosen] : [base];
  const who = m => (m === base ? 'base' : 'selected');
  const table = element('table', {}, rowOf(['part', 'weight', 'tasks', ...shown.flatMap(m => ['per second', 'mJ', '% of time', '% of energy'].map(c => `${who(m)}: ${c}`)), 'machines on its front', 'of these on the workload\'s front'], 'th'));
  parts.forEach((p, n) => {
    const figures = shown.flatMap(m => {
      const f = m.whole.parts[n], w = WORK[p.work];
      return [number(f[w.rate], 1), number(1e3 * f[w.joules], 2), number(100 * f.time_share, 1), number(100 * f.energy_share, 1)];
    });
    table.append(rowOf([`${p.part}, ${p.work}`, number(p.weight, Number.isInteger(p.weight) ? 0 : 3), number(p.tasks), ...figures, number(p.front.length), number(p.front.filter(name => data.front.includes(name)).length)]));
  });
  byId('parts').replaceChildren(table);
}

function drawDetails() {
  const m = data.machines.find(one => one.machine === state.selected);
  const box = byId('details');
  box.replaceChildren(element('p', {}, element('b', {}, m.machine), m.views?.length ? `: ${m.views[0].clocked_machine}` : ''));
  for (const [text, words] of [['--set ', m.settings], ['', m.arguments.join(' ')]])
    if (words) box.append(element('p', { class: 'note' }, element('code', {}, text + words)));
  if (!isJudged(m, 'whole')) {
    box.append(element('p', {}, (m.whole ?? m.small).refused ?? 'It was measured only on small views.'));
    return;
  }
  const table = element('table', {}, rowOf([parts.length ? 'task' : 'view', 'stage', 'Mcycles', `share of the ${work.map(w => w.unit).join(' or ')}`, 'main reason', '% of its cycles', 'work, % of peak', 'DRAM, % of peak'], 'th'));
  for (const view of m.views) {
    const all = view.stages.reduce((sum, s) => sum + s.cycles, 0);
    for (const s of view.stages)
      table.append(rowOf([taskOf(view), s.name, number(s.cycles * 1e-6, 3), `${number(100 * s.cycles / all, 1)} %`, `${s.unit}: ${s.reason}`, number(100 * s.share), number(100 * s.work_share, 1), number(100 * s.memory_share, 1)]));
  }
  box.append(table);
}

// What a machine was measured at: a view, or a part's view or iterations.
const taskOf = view => (view.view ? [view.part, view.view].filter(word => word).join(' ') : `${view.part}, ${view.iterations === 1 ? 'an iteration' : `mean of ${view.iterations} iterations`}`);

// A stage's place: work for the traffic that it makes, and work, as shares of the most. What moves nothing is drawn at the right edge.
const FURTHEST = 1e4;
const placesOf = m => m.views.flatMap(view => view.stages.map(stage => ({
  x: Math.min(FURTHEST, stage.memory_share ? stage.work_share / stage.memory_share : FURTHEST), y: stage.work_share, view: taskOf(view), stage, name: m.views.length > 1 ? `${stage.name}, ${taskOf(view)}` : stage.name,
}))).filter(p => p.x > 0 && p.y > 0);

function drawRoof() {
  const chosen = data.machines.find(one => one.machine === state.selected);
  const ofChosen = isJudged(chosen, 'whole') ? placesOf(chosen) : [], ofBase = placesOf(base);
  const all = [...ofChosen, ...ofBase];
  const [left, low] = ['x', 'y'].map(key => Math.min(0.1, ...all.map(p => p[key])) / 1.5), right = Math.max(10, ...all.map(p => p.x)) * 1.5;
  const dots = (label, places, which, filled) => ({
    label, data: places, pointRadius: filled ? 5 : 7, pointBorderWidth: 2, pointBorderColor: colour(which), pointBackgroundColor: filled ? colour(which) : 'transparent',
  });
  const roof = lineOf('roof', [{ x: left, y: left }, { x: 1, y: 1 }, { x: right, y: 1 }], 'mark');
  drawChart('roof', {
    type: 'scatter',
    data: { datasets: [dots(chosen.machine, ofChosen, 'chosen', true), dots('base', chosen === base ? [] : ofBase, 'ink', false), roof] },
    plugins: [pointNames(p => p.name)],
    options: {
      scales: {
        x: axis('work / traffic, fractions of peak', { type: 'logarithmic', min: left, max: right, ticks: { maxRotation: 0 } }),
        y: axis('work, fraction of peak', { type: 'logarithmic', min: low, max: 1.3 }),
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
  ];
  const add = (label, of) => columns.push([label, w => of(w) ?? 0, w => factor(of(w))]);
  for (const w of work) {
    add(w.rateLabel, one => one[w.rateFactor]);
    add(work.length > 1 ? w.energyLabel : 'energy of the chip', one => one[w.energyFactor]);
  }
  add('area of the chip', one => one.area_factor);
  for (const p of apart) {
    add(`${p.part}: ${WORK[p.work].rateLabel}`, one => one.parts?.[p.n][WORK[p.work].rateFactor]);
    add(`${p.part}: energy`, one => one.parts?.[p.n][WORK[p.work].energyFactor]);
  }
  // Why one cannot be stands where its first figure would.
  const text = columns[1][2];
  columns[1][2] = w => (w.refused ? `impossible: ${w.refused}` : text(w));
  drawColumns(byId('worth'), columns, data.worth, state.worth, sort => { state.worth = sort; draw(); }, (row, w) => selects(row, w.machine, 'worth'));
}

function drawPairs() {
  const box = byId('pairs');
  if (!data.pairs.length) {
    box.textContent = 'None found.';
    return;
  }
  const several = work.length > 1;
  const table = element('table', {}, rowOf([...(several ? ['of'] : []), 'first', 'second', 'interaction', 'standard error'], 'th'));
  for (const w of work) {
    const kind = Object.keys(WORK).find(key => WORK[key] === w);
    for (const p of data.pairs.filter(one => one.of === kind).slice(0, 20))
      table.append(rowOf([...(several ? [w.rateLabel] : []), p.first, p.second, factor(p.rate_factor), `${number(100 * p.log_error, 1)} %`]));
  }
  box.replaceChildren(table);
}

function drawTable() {
  const entries = data.machines.filter(m => isJudged(m, 'whole'));
  const columns = [['machine', m => m.machine, m => m.machine]];
  for (const key of Object.keys(AXES)) columns.push([AXES[key].label, m => value(m.whole, key), m => format(m.whole, key)]);
  const most = m => m.views[0].stages.reduce((a, b) => (b.cycles > a.cycles ? b : a));
  if (!parts.length) columns.push(['longest stage', m => most(m).name, m => `${most(m).name}, ${most(m).unit}: ${most(m).reason}`]);
  drawEntries(columns, entries, m => m.machine, m => m.on_front);
}

function drawSummary() {
  const whole = data.machines.filter(m => isJudged(m, 'whole')).length, refused = data.machines.filter(m => (m.whole ?? m.small).refused).length;
  const both = data.small_beside_whole;
  const lines = [`The base is ${base.views[0].clocked_machine}. ${data.machines.length} machines, ${whole} of them at full size (${data.views.join(', ')}), ${data.front.length} on the front, ${refused} impossible.`];
  if (both)
    lines.push(`Rank correlation of small and full-size views, ${both.machines} random machines: ` +
      `${work.map(w => `${number(both[w.rateOrder], 3)} for ${w.rateLabel} and ${number(both[w.energyOrder], 3)} for energy${work.length > 1 ? ` of ${w.each}` : ''}`).join(', ')}.`);
  if (data.different_pictures > 1) lines.push(`The machines render ${data.different_pictures} pictures that are not bit-identical.`);
  byId('summary').textContent = lines.join(' ');
}

function sayHowJoined() {
  const several = work.length > 1;
  byId('criteria').textContent = `${work.map(w => `${w.rateLabel}, energy${several ? ` of ${w.each}` : ''}`).join(', ')} and area`;
  byId('paired').textContent = work.map(w => w.rateLabel).join(' or ');
  byId('joined').textContent = `${several ? 'Frames and iterations are not combined: each has its own rate and energy. ' : ''}` +
    `The rate is the sum of the weights divided by the sum of the weighted times of all ${work.map(w => `${w.unit}s`).join(', or of all ')}; the energy is their weighted mean. ` +
    'Shares are those of the weighted times or energies.';
}

const draw = () => drawAround(() => {
  drawPlot();
  drawParts();
  drawDetails();
  drawRoof();
  drawWorth();
  drawTable();
});

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
  sayHowJoined();
  drawPairs();
  draw();
}

function tryOut() {
  const points = trySelecting(0, 'details');
  const stages = charts.roof.data.datasets.slice(0, 2).flatMap(d => d.data);
  if (!stages.length) throw new Error('no stage under the roof');
  if (stages.some(p => p.y > 1 || p.stage.memory_share > 1)) throw new Error('a stage is above the roof');
  if (!/^The base is .* MHz, clock version \d+\. /.test(byId('summary').textContent)) throw new Error('the base has no clock');
  if (parts.length !== Math.max(0, byId('parts').querySelectorAll('tr').length - 1)) throw new Error('not every part has a row');
  tryControls(['across', 'up', 'size']);
  if (document.body.innerText.includes('NaN')) throw new Error('something is not a number');
  return `${points.length} machines`;
}

openPage(start, draw, tryOut);
