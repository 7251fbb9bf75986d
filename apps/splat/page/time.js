// The page of `splat render --html` and `splat compare --times --html`: one run or two.

const { runs } = data; // { name, report, picture }; picture is a data URI or null
const two = runs.length === 2;

const SCALES = { cycles: 'thousand cycles', percent: 'per cent of the stage' };
const HEATS = { list: 'entries of its list', blends: 'blends', cycles: 'cycles of its rasterizer', saturation: 'saturated pixels, %' };
// As the files of --heat-map: from dark to bright, so that the order shows without colours too.
const RAMP = [[5, 5, 26], [71, 18, 110], [184, 54, 84], [247, 140, 41], [252, 250, 184]];
const state = { unit: 'cores', scale: 'cycles', heat: 'list' };

const frameStages = report => report.time.stages.filter(s => s.of_the_frame && s.time);
// The stages of all runs, in the order of time.
const stageNames = [...new Set(runs.flatMap(r => frameStages(r.report).map(s => s.name)))];
const stageOf = (run, name) => frameStages(run.report).find(s => s.name === name);
const milliseconds = time => time.cycles / (1e3 * time.clock_mhz);
const megabytes = time => (time.dram.read_bursts + time.dram.write_bursts) * time.host.dram_burst_bytes / 1e6;
const letter = n => two ? 'AB'[n] : '';

function sizeBox(id, rows) {
  byId(id).style.height = `${rows}px`;
}

// The name of a bar inside it, where it fits.
const namesInside = {
  id: 'namesInside',
  afterDatasetsDraw(chart) {
    const { ctx } = chart;
    ctx.save();
    ctx.font = `12px ${Chart.defaults.font.family}`;
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    chart.data.datasets.forEach(({ label, backgroundColor }, n) => {
      ctx.fillStyle = inkOn(backgroundColor);
      for (const bar of chart.getDatasetMeta(n).data)
        if (bar.width > ctx.measureText(label).width + 8) ctx.fillText(label, bar.x - bar.width / 2, bar.y);
    });
    ctx.restore();
  },
};

function drawTimeline() {
  const parts = [...stageNames.map(name => ({ name, of: r => { const s = stageOf(r, name); return s ? milliseconds(s.time) : 0; } })),
    { name: 'launches', of: r => r.report.time.launch_ms }, { name: 'copies', of: r => r.report.time.copy_ms }];
  const datasets = parts.map(({ name, of }, n) => ({
    label: name, data: runs.map(of), backgroundColor: seriesColour(n), borderColor: colour('panel'), borderWidth: { right: 1 }, borderSkipped: false,
  }));
  sizeBox('timeline-box', 190 + 60 * (runs.length - 1) + (byId('timeline-box').clientWidth < 600 ? 110 : 0));
  drawChart('timeline', {
    type: 'bar',
    data: { labels: runs.map((_, n) => letter(n)), datasets },
    plugins: [namesInside],
    options: {
      indexAxis: 'y',
      scales: { x: { stacked: true, ...axis('time from the beginning of the frame, ms') }, y: { stacked: true, grid: { display: false } } },
      plugins: {
        legend: { position: 'bottom', labels: { boxWidth: 14 } },
        tooltip: { callbacks: { label: item => `${item.dataset.label}: ${number(item.raw, 3)} ms, ${number(100 * item.raw / runs[item.dataIndex].report.time.frame_ms, 1)} % of the frame` } },
      },
    },
  });
}

function drawReasons() {
  const { groups } = UNITS[state.unit], of = state.unit;
  const rows = stageNames.flatMap(name => runs.map((run, n) => ({ name, n, time: stageOf(run, name)?.time }))).filter(r => r.time);
  const share = (time, keys) => {
    const cycles = time[of].reduce((sum, unit) => sum + keys.reduce((s, k) => s + unit[k], 0), 0) / time[of].length;
    return state.scale === 'percent' ? 100 * cycles / time.cycles : cycles / 1e3;
  };
  const datasets = Object.entries(groups).map(([label, group]) =>
    ({ label, data: rows.map(r => share(r.time, group.reasons)), backgroundColor: group.colour, barPercentage: 0.95 }));
  const narrow = byId('reasons-box').clientWidth < 600;
  sizeBox('reasons-box', 110 + (narrow ? 130 : 20) + rows.length * 26);
  drawChart('reasons', {
    type: 'bar',
    data: { labels: rows.map(r => `${r.name} ${letter(r.n)}`.trim()), datasets },
    options: {
      indexAxis: 'y',
      scales: {
        x: { stacked: true, ...axis(SCALES[state.scale]), ...(state.scale === 'percent' ? { max: 100 } : {}) },
        y: { stacked: true, grid: { display: false }, ticks: { autoSkip: false } },
      },
      plugins: {
        legend: { position: 'bottom', labels: { boxWidth: 14 } },
        tooltip: { callbacks: { label: item => `${item.dataset.label}: ${number(item.raw, 1)} ${SCALES[state.scale]}` } },
      },
    },
  });
  const units = rows[0].time[of].length;
  const sums = Object.entries(groups).filter(([, g]) => g.reasons.length > 1).map(([label, g]) => `“${label}” is ${g.reasons.join(' + ')}`);
  byId('reasons-note').textContent = `The mean of ${units} ${UNITS[state.unit].label}; a bar is as long as its stage. Of the report's reasons, ${sums.join(', ')}.`;
}

function heatColour(share) {
  const at = Math.min(Math.max(share, 0), 1) * (RAMP.length - 1), step = Math.min(Math.floor(at), RAMP.length - 2);
  return `rgb(${RAMP[step].map((from, k) => Math.round(from + (at - step) * (RAMP[step + 1][k] - from))).join(' ')})`;
}

function drawMaps() {
  const mapped = runs.map((run, n) => ({ ...run, n })).filter(r => r.report.heat_map);
  byId('map-section').hidden = !mapped.length && !runs.some(r => r.picture);
  const most = Math.max(...mapped.map(r => r.report.heat_map.scales[state.heat]));
  byId('most').textContent = mapped.length ? `${number(most)} ${HEATS[state.heat]}` : '';
  byId('ramp').style.background = `linear-gradient(to right, ${RAMP.map(c => `rgb(${c.join(' ')})`).join(', ')})`;
  const figures = [];
  for (const run of runs)
    if (run.picture) figures.push(element('figure', {}, element('img', { src: run.picture, alt: 'the picture' }), element('figcaption', {}, `view ${run.report.view}`)));
  for (const { report, n, name } of mapped) {
    const [width, height] = report.resolution;
    const title = `${two ? `${letter(n)}: ${name}, ` : ''}${HEATS[state.heat]}, tile by tile`;
    const canvas = element('canvas', { width, height, id: `map${n}`, role: 'img', 'aria-label': `${HEATS[state.heat]} of each tile` });
    const caption = element('figcaption', {}, title);
    const context = canvas.getContext('2d');
    const inside = (tile, x, y) => x >= tile.x && y >= tile.y && x < tile.x + tile.width && y < tile.y + tile.height;
    context.fillStyle = '#404040';
    context.fillRect(0, 0, width, height);
    for (const tile of report.heat_map.tiles) {
      context.fillStyle = heatColour(most ? tile[state.heat] / most : 0);
      context.fillRect(tile.x, tile.y, tile.width, tile.height);
    }
    canvas.addEventListener('pointermove', event => {
      const x = event.offsetX * width / canvas.clientWidth, y = event.offsetY * height / canvas.clientHeight;
      const tile = report.heat_map.tiles.find(t => inside(t, x, y));
      caption.textContent = tile ? `tile at ${tile.x}, ${tile.y}: ` + Object.entries(HEATS).map(([k, label]) => `${label} ${number(tile[k])}`).join('; ') : title;
    });
    figures.push(element('figure', {}, canvas, caption));
  }
  byId('maps').replaceChildren(...figures);
}

// [name, time of run 0, time of run 1] to a row.
function stageRow(name, times) {
  const cells = [name];
  for (const time of times)
    cells.push(...(time ? [number(time.cycles), number(milliseconds(time), 3), number(megabytes(time), 2)] : ['—', '—', '—']));
  if (two) cells.push(change(times[0]?.cycles, times[1]?.cycles));
  return rowOf(cells);
}

function drawStages() {
  const head = ['stage', ...runs.flatMap((_, n) => ['cycles', 'ms', 'DRAM, MB'].map(label => `${label} ${letter(n)}`.trim())), ...(two ? ['cycles, A to B'] : [])];
  byId('stages').tHead.replaceChildren(rowOf(head, 'th'));
  const total = stageRow('kernels of the frame', runs.map(r => r.report.time.sum));
  total.className = 'total';
  byId('stages').tBodies[0].replaceChildren(...stageNames.map(name => stageRow(name, runs.map(r => stageOf(r, name)?.time))), total);
}

// A figure in mJ with the interval of 90 % of the draws.
const millijoules = e => e ? `${number(1e3 * e.value, 3)} (${number(1e3 * e.low, 3)} to ${number(1e3 * e.high, 3)})` : '—';

// What --energy says, of the runs that have it.
function drawEnergy() {
  const energies = runs.map(r => r.report.energy);
  const known = energies.filter(e => e);
  byId('energy-section').hidden = !known.length;
  if (!known.length) return;
  byId('energy-note').textContent = `mJ of the frame's kernels, with 5 and 95 % of the draws. ` + energies.map((e, n) => e ?
    `${letter(n) ? letter(n) + ': ' : ''}technology ${e.technology} at ${number(e.volts, 3)} V, ${number(e.chip_watts.value, 2)} W of the chip, ` +
    `whose area is ${number(e.area.chip_um2.value / 1e6, 1)} mm².` : '').join(' ');
  byId('energies').tHead.replaceChildren(rowOf(['unit', ...runs.flatMap((_, n) => [`mJ ${letter(n)}`.trim(), `% ${letter(n)}`.trim()])], 'th'));
  const row = (name, of, share) => rowOf([name, ...energies.flatMap(e => e ? [millijoules(of(e)), number(100 * share(e), 1)] : ['—', '—'])]);
  const unitOf = (e, name) => e.units.find(u => u.unit === name);
  const names = [...new Set(known.flatMap(e => e.units.map(u => u.unit)))];
  const all = row('all', e => e.joules, () => 1);
  all.className = 'total';
  byId('energies').tBodies[0].replaceChildren(...names.map(name => row(name, e => unitOf(e, name)?.joules, e => unitOf(e, name)?.share.value ?? 0)),
    row('chip', e => e.chip_joules, e => e.chip_joules.value / e.joules.value), all);
}

function drawChanges() {
  byId('changes-section').hidden = !data.changes;
  if (!data.changes) return;
  const differ = data.changes.filter(c => c.a !== c.b);
  byId('changes').tHead.replaceChildren(rowOf(['figure', 'A', 'B', 'A to B'], 'th'));
  const text = value => value === null ? '—' : number(value, Number.isInteger(value) ? 0 : 3);
  byId('changes').tBodies[0].replaceChildren(...differ.map(c => rowOf([`${c.group ? c.group + ': ' : ''}${c.name}`, text(c.a), text(c.b), change(c.a, c.b, /cycles|^$/.test(c.group))])));
  if (!differ.length) byId('changes').tBodies[0].replaceChildren(rowOf(['nothing', '', '', '']));
}

function drawFigures() {
  const { report } = runs[0];
  byId('lede').textContent = `View ${report.view}, ${report.resolution.join(' × ')} pixels, ${number(report.scene.gaussians)} Gaussians, of which ` +
    `${number(report.counts.visible)} are seen; ${report.rules} rules, support ${report.support}, path ${report.path}.` +
    (two ? ` A: ${runs[0].name}. B: ${runs[1].name}.` : '');
  const boxes = [];
  runs.forEach((run, n) => {
    const { time } = run.report;
    for (const [value, label] of [[`${number(time.frame_ms, 3)} ms`, `a frame at ${time.sum.clock_mhz} MHz`], [number(time.fps, 1), 'frames a second'],
      [number(time.sum.cycles), 'cycles of kernels'], [`${number(megabytes(time.sum), 2)} MB`, 'of DRAM traffic'], [time.sum.machine, `the machine, clock version ${time.sum.clock_version}`]])
      boxes.push(element('div', {}, element('b', {}, value), element('span', {}, two ? `${letter(n)}: ${label}` : label)));
  });
  if (two) boxes.push(element('div', {}, element('b', {}, change(runs[0].report.time.frame_ms, runs[1].report.time.frame_ms)), element('span', {}, 'frame, A to B')));
  byId('figures').replaceChildren(...boxes);
}

function draw() {
  drawFigures();
  drawTimeline();
  drawReasons();
  drawMaps();
  drawStages();
  drawEnergy();
  drawChanges();
}

function start() {
  const choose = (id, choices) => fill(byId(id), Object.entries(choices), value => { state[id] = value; draw(); });
  choose('unit', Object.fromEntries(Object.entries(UNITS).map(([k, u]) => [k, u.label])));
  choose('scale', SCALES);
  choose('heat', HEATS);
  draw();
}

function tryOut() {
  tryControls(['unit', 'scale', 'heat']);
  const rows = byId('stages').tBodies[0].rows.length;
  if (rows !== stageNames.length + 1) throw new Error('not a row a stage');
  const drawn = charts.timeline.data.datasets.reduce((sum, d) => sum + d.data[0], 0);
  if (Math.abs(drawn / runs[0].report.time.frame_ms - 1) > 1e-6) throw new Error('the stages are not the frame');
  for (const { energy } of runs.map(r => r.report))
    if (energy && Math.abs(energy.units.reduce((sum, u) => sum + u.joules.value, 0) / energy.joules.value - 1) > 1e-6)
      throw new Error('the units are not all energy');
  if (document.body.innerText.includes('NaN')) throw new Error('something is not a number');
  return `${rows} rows`;
}

openPage(start, draw, tryOut);
