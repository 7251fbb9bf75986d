// The page of `splat eval --html` and `splat train --html`: each view's picture, photograph and their difference.

const { views, scene } = data; // views: { name, held_out, resolution, psnr8_db, ssim, ms_ssim, drawn, photograph, difference }
const state = { selected: views[0].name, table: null, sort: { n: 1, down: false } };

const decibels = v => v.psnr8_db === null ? 'equal' : number(v.psnr8_db, 3);
const share = value => value === null ? '–' : number(value, 5);

function means() {
  for (const [of, mean] of [['held out', data.mean_held_out], ['in training', data.mean_in_training]]) {
    if (!mean) continue;
    for (const [text, name] of [[`${decibels(mean)} dB`, 'PSNR'], [share(mean.ssim), 'SSIM'], [share(mean.ms_ssim), 'MS-SSIM']].filter(([t]) => t !== '–'))
      byId('figures').append(element('div', {}, element('b', {}, text), element('span', {}, `${name}, mean of ${mean.views} ${of}`)));
  }
}

function show() {
  const v = views.find(one => one.name === state.selected);
  byId('view').value = v.name;
  const parts = [['drawn', 'picture'], ['photograph', 'photograph'], ['difference', 'difference, four times as large']];
  byId('panel').replaceChildren(...parts.map(([key, text]) => element('figure', {},
    element('img', { src: v[key], alt: `${text} of ${v.name}`, width: v.resolution[0], height: v.resolution[1] }),
    element('figcaption', {}, text))));
}

function table() {
  const columns = [
    ['view', v => v.name, v => v.name], ['PSNR, dB', v => v.psnr8_db ?? Infinity, decibels],
    ['SSIM', v => v.ssim, v => share(v.ssim)], ['MS-SSIM', v => v.ms_ssim ?? 0, v => share(v.ms_ssim)],
    ['', v => v.held_out, v => v.held_out ? 'held out' : 'in training'],
  ];
  drawColumns(byId('scores'), columns, views, state.sort, sort => { state.sort = sort; redraw(); }, (row, v) => selects(row, v.name, 'scores'));
}

const redraw = () => drawAround(() => {
  byId('chart-box').style.height = `${120 + 18 * views.length}px`;
  // A series a kind, so that the legend says what the colours are. A paper has no pictures below.
  const isBelow = v => !onPaper && v.name === state.selected;
  const kinds = [
    ['held out', seriesColour(0), v => !isBelow(v) && v.held_out],
    ['in training', seriesColour(1), v => !isBelow(v) && !v.held_out],
    ['pictures below', colour('chosen'), isBelow],
  ].filter(([, , is]) => views.some(is));
  drawChart('chart', {
    type: 'bar',
    data: {
      labels: views.map(v => v.name),
      datasets: kinds.map(([label, backgroundColor, is]) => ({
        label, backgroundColor, grouped: false, data: views.map(v => (is(v) ? v.psnr8_db : null)),
      })),
    },
    options: {
      indexAxis: 'y', onClick: (_, hit) => { if (hit.length) select(views[hit[0].index].name); },
      plugins: { legend: { display: true, onClick: () => {} } },
      scales: { x: axis('PSNR of 8-bit values, dB'), y: { ticks: { autoSkip: false } } },
    },
  });
  if (data.training) drawCurves([data.training]);
  show();
  table();
});

openPage(() => {
  byId('lede').textContent = `${scene}: what it shows from the places of ${views.length} photographs.`;
  byId('lpips').textContent = data.lpips_note + '.';
  means();
  byId('training').hidden = !data.training;
  fill(byId('view'), views.map(v => [v.name, v.name]), name => select(name));
  redraw();
}, redraw, () => {
  tryControls(['view']);
  // Hidden, a canvas is empty.
  document.querySelectorAll('[hidden] canvas').forEach(canvas => canvas.remove());
  byId('scores').tHead.querySelectorAll('th')[2].click();
  byId('scores').tBodies[0].rows[0].click();
  if (document.querySelectorAll('#panel img').length !== 3) throw new Error('three pictures are expected');
  return `${views.length} views`;
});
