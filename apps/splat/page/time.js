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
const linkMegabytes = time =>
    (time.link.bytes_to_l2 + time.link.bytes_from_l2) / 1e6;
const hasLink = runs.some(run => linkMegabytes(run.report.time.sum) > 0);
const letter = n => two ? 'AB'[n] : '';

function sizeBox(id, rows) {
  byId(id).style.height = `${rows}px`;
}

const millisecondsOf = (report, name) => { const s = stageOf({ report }, name); return s ? milliseconds(s.time) : undefined; };

// A setting, which may go on in the next line behind a comma.
const breakable = set => set.split(/(?<=,)/).flatMap((part, n) => (n ? [element('wbr'), part] : [part]));

// What helps a stage: what was measured, and what was not.
function helpOf({ report }, { ms: before, helps }) {
  const parts = helps.map(({ set, ms }) => (ms === null ? [...breakable(set), ': not measured'] : [...breakable(set), `: ${number(before, 3)} to ${number(ms, 3)} ms, `, change(before, ms), ', measured']));
  return element('span', {}, ...(parts.length ? parts.flatMap((part, n) => (n ? ['; ', ...part] : part)) : [report.what_if ? 'no setting that was measured' : 'nothing known']));
}

function drawBounds() {
  const rows = runs.flatMap((run, n) => (run.report.bounds ?? []).map(bound => ({ run, n, bound })));
  byId('bounds-section').hidden = !rows.length;
  byId('bounds').tHead.replaceChildren(rowOf(['stage', 'ms', 'bound by', 'what helps', 'cycles, %', 'unit, % of peak', 'DRAM, % of peak'], 'th'));
  byId('bounds').tBodies[0].replaceChildren(...rows.map(({ run, n, bound }) => rowOf([`${bound.stage} ${letter(n)}`.trim(),
    number(bound.ms, 3), `${bound.unit}: ${bound.reason}`, helpOf(run, bound), number(100 * bound.share),
    number(100 * bound.work_share, 1), number(100 * bound.memory_share, 1)])));
  byId('bounds-note').textContent = 'The reason of most cycles in which the unit was not idle, of cores or, if these mostly wait for rasterizers, of rasterizers. ' +
    'Times are modelled. splat render --what-if SETTING measures a setting.';
}

// The frame with other settings beside it.
function drawWhatIfs() {
  const [{ report }] = runs, others = report.what_if ?? [];
  byId('what-if-section').hidden = two || !others.length;
  if (two || !others.length) return;
  const all = [{ set: 'as it is', time: report.time, same_picture: true }, ...others];
  sizeBox('what-if-box', 110 + stageNames.length * (10 + 14 * all.length));
  drawChart('what-if', {
    type: 'bar',
    data: { labels: stageNames, datasets: all.map(({ set, time }, n) => ({ label: set, data: stageNames.map(name => millisecondsOf({ time }, name)), backgroundColor: seriesColour(n) })) },
    options: {
      indexAxis: 'y', scales: { x: axis('time, ms'), y: { grid: { display: false }, ticks: { autoSkip: false } } },
      plugins: { legend: { position: 'bottom' } },
    },
  });
  byId('what-ifs').tHead.replaceChildren(rowOf(['setting', 'frame, ms', 'change', 'frames a second', 'picture'], 'th'));
  byId('what-ifs').tBodies[0].replaceChildren(...all.map(({ set, time, same_picture: same }) => rowOf([set, number(time.frame_ms, 3),
    change(report.time.frame_ms, time.frame_ms), number(time.fps, 1), same ? 'the same' : 'another'])));
}

// A stage's bar is as long as it took, and begins where the one before ended.
function drawTimeline() {
  const parts = [...stageNames.map(name => ({ name, of: r => { const s = stageOf(r, name); return s ? milliseconds(s.time) : 0; } })),
    { name: 'launches', of: r => r.report.time.launch_ms }, { name: 'copies', of: r => r.report.time.copy_ms }]
    .filter(({ of }) => runs.some(run => of(run) > 0));
  const datasets = runs.map((run, n) => {
    let end = 0;
    return {
      label: two ? `${letter(n)}: ${run.name}` : 'time', backgroundColor: seriesColour(n), barPercentage: 0.9, minBarLength: 1.5,
      data: parts.map(({ of }) => [end, end += of(run)]),
    };
  });
  sizeBox('timeline-box', 80 + (two ? 30 : 0) + parts.length * (two ? 34 : 24));
  drawChart('timeline', {
    type: 'bar',
    data: { labels: parts.map(p => p.name), datasets },
    options: {
      indexAxis: 'y',
      scales: { x: { min: 0, ...axis('time in the frame, ms') }, y: { grid: { display: false }, ticks: { autoSkip: false } } },
      plugins: {
        legend: { display: two, position: 'bottom' },
        tooltip: { callbacks: { label: ({ datasetIndex: n, raw: [from, to] }) => `${number(to - from, 3)} ms, ${number(100 * (to - from) / runs[n].report.time.frame_ms, 1)} % of the frame` } },
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
    ({ label, data: rows.map(r => share(r.time, group.reasons)), backgroundColor: onScreen(group.colour), barPercentage: 0.95 }))
    .filter(({ data: values }) => values.some(v => v > 0));
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
        legend: { position: 'bottom' },
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
  return `rgb(${RAMP[step].map((from, k) => Math.round(from + (at - step) * (RAMP[step + 1][k] - from))).join(',')})`; // as SVG 1.1 has it
}

const mapped = runs.map((run, n) => ({ ...run, n })).filter(r => r.report.heat_map);
const tileTitle = ({ n, name }) => `${two ? `${letter(n)}: ${name}, ` : ''}${HEATS[state.heat]}, tile by tile`;

// The pictures, and a canvas for each heat map.
function addMaps() {
  byId('map-section').hidden = !mapped.length && !runs.some(r => r.picture);
  for (const run of runs)
    if (run.picture) byId('maps').append(element('figure', {}, element('img', { src: run.picture, alt: 'the picture' }), element('figcaption', {}, `view ${run.report.view}`)));
  for (const run of mapped) {
    const { heat_map: { tiles }, resolution: [width, height] } = run.report;
    const canvas = element('canvas', { width, height, id: `map${run.n}`, role: 'img' }), caption = element('figcaption');
    const inside = (tile, x, y) => x >= tile.x && y >= tile.y && x < tile.x + tile.width && y < tile.y + tile.height;
    canvas.addEventListener('pointermove', event => {
      const x = event.offsetX * width / canvas.clientWidth, y = event.offsetY * height / canvas.clientHeight;
      const tile = tiles.find(t => inside(t, x, y));
      caption.textContent = tile ? `tile at ${tile.x}, ${tile.y}: ` + Object.entries(HEATS).map(([k, label]) => `${label} ${number(tile[k])}`).join('; ') : tileTitle(run);
    });
    byId('maps').append(element('figure', { class: 'map' }, canvas, caption));
  }
}

function drawMaps() {
  const { heat } = state;
  const most = Math.max(...mapped.map(r => r.report.heat_map.scales[heat]));
  const end = mapped.length ? `${number(most)} ${HEATS[heat]}` : '';
  byId('most').textContent = end;
  byId('ramp').style.background = `linear-gradient(to right, ${RAMP.map(c => `rgb(${c.join(' ')})`).join(', ')})`;
  for (const run of mapped) {
    const { heat_map: { tiles }, resolution: [width, height] } = run.report, canvas = byId(`map${run.n}`);
    canvas.setAttribute('aria-label', tileTitle(run));
    canvas.nextElementSibling.textContent = tileTitle(run);
    drawCells(canvas.id, {
      width, height, rows: [['x', 'y', HEATS[heat]], ...tiles.map(tile => [tile.x, tile.y, tile[heat]])], colour: heatColour, end,
      paint: context => {
        context.fillStyle = '#404040';
        context.fillRect(0, 0, width, height);
        for (const tile of tiles) {
          context.fillStyle = heatColour(most ? tile[heat] / most : 0);
          context.fillRect(tile.x, tile.y, tile.width, tile.height);
        }
      },
    });
  }
}

const busyShares =
    time => ['to', 'from']
                .map(way => number(
                         100 * time.link[`busy_${way}_l2`] / time.cycles, 1))
                .join(' / ');
// The columns of the stages: heading, whether the machines have it, its text.
const STAGE_FIGURES = [
  [ 'cycles', true, time => number(time.cycles) ],
  [ 'ms', true, time => number(milliseconds(time), 3) ],
  [ 'DRAM, MB', true, time => number(megabytes(time), 2) ],
  [ 'link, MB', hasLink, time => number(linkMegabytes(time), 2) ],
  [ 'link busy to / from the L2, %', hasLink, busyShares ],
].filter(([, isThere ]) => isThere);

// [name, time of run 0, time of run 1] to a row.
function stageRow(name, times) {
  const cells = [name];
  for (const time of times)
    cells.push(
        ...STAGE_FIGURES.map(([, , figure ]) => time ? figure(time) : '—'));
  if (two) cells.push(change(times[0]?.cycles, times[1]?.cycles));
  return rowOf(cells);
}

function drawStages() {
  const head = [
    'stage',
    ...runs.flatMap((_, n) => STAGE_FIGURES.map(
                        ([ label ]) => `${label} ${letter(n)}`.trim())),
    ...(two ? [ 'cycles, A to B' ] : [])
  ];
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
    `${letter(n) ? `${letter(n)}: t` : 'T'}echnology ${e.technology} at ${number(e.volts, 3)} V, ${number(e.chip_watts.value, 2)} W of the chip, ` +
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
  drawBounds();
  drawWhatIfs();
  drawTimeline();
  drawReasons();
  drawMaps();
  drawStages();
  drawEnergy();
  drawChanges();
}

function start() {
  const choose = (id, choices) => fill(byId(id), Object.entries(choices), value => { state[id] = value; draw(); });
  // A machine may lack units of a kind.
  choose('unit', Object.fromEntries(Object.entries(UNITS).filter(([k]) => runs.every(r => r.report.time.sum[k].length)).map(([k, u]) => [k, u.label])));
  choose('scale', SCALES);
  choose('heat', HEATS);
  addMaps();
  draw();
}

function tryOut() {
  tryControls(['unit', 'scale', 'heat']);
  const rows = byId('stages').tBodies[0].rows.length;
  if (rows !== stageNames.length + 1) throw new Error('not a row a stage');
  const drawn = charts.timeline.data.datasets[0].data.at(-1)[1];
  if (Math.abs(drawn / runs[0].report.time.frame_ms - 1) > 1e-6) throw new Error('the stages are not the frame');
  for (const { energy } of runs.map(r => r.report))
    if (energy && Math.abs(energy.units.reduce((sum, u) => sum + u.joules.value, 0) / energy.joules.value - 1) > 1e-6)
      throw new Error('the units are not all energy');
  if (document.body.innerText.includes('NaN')) throw new Error('something is not a number');
  return `${rows} rows`;
}

openPage(start, draw, tryOut);
