// Curves of trainings: of one run that goes on or is done, or of several.

// Pairs of an iteration and the mean of the losses around it, at most `parts` of them.
function meanLosses(losses, parts = 200) {
  const count = Math.min(parts, losses.length);
  return Array.from({ length: count }, (_, n) => {
    const begin = Math.floor(n * losses.length / count), end = Math.floor((n + 1) * losses.length / count);
    let sum = 0;
    for (let i = begin; i < end; ++i) sum += losses[i];
    return [(begin + 1 + end) / 2, sum / (end - begin)];
  });
}

// Steps, up to the last iteration.
function steps(counts, last) {
  const all = counts.flatMap(([iteration, count], n) => n ? [[iteration, counts[n - 1][1]], [iteration, count]] : [[iteration, count]]);
  return all.length && all[all.length - 1][0] < last ? [...all, [last, all[all.length - 1][1]]] : all;
}

// The charts by the ids of their canvases. `runs`: { name, losses, gaussian_counts, scores, machine_ms }, the last three pairs
// of an iteration and a value.
const CURVES = {
  loss: { text: 'mean loss', of: r => meanLosses(r.losses) },
  gaussians: { text: 'Gaussians', whole: true, of: r => steps(r.gaussian_counts, r.losses.length) },
  'scores-curve': { text: 'held-out PSNR, dB', of: r => r.scores, dots: true },
  machine: { text: 'machine time, ms', of: r => r.machine_ms, dots: true },
};

// Draws those that have something to show, and hides the boxes of the others.
function drawCurves(runs) {
  const last = Math.max(1, ...runs.map(r => r.losses.length));
  for (const [id, { text, of, dots, whole }] of Object.entries(CURVES)) {
    const lines = runs.map(r => of(r));
    byId(`${id}-box`).hidden = lines.every(line => line.length === 0);
    if (byId(`${id}-box`).hidden) continue;
    drawChart(id, {
      type: 'scatter',
      data: { datasets: lines.map((line, n) => ({
        label: runs[n].name, data: line.map(([x, y]) => ({ x, y })), showLine: true, borderWidth: 1.5, pointRadius: dots ? 3 : 0,
        borderColor: seriesColour(n), backgroundColor: seriesColour(n),
      })) },
      options: {
        scales: { x: axis('iteration', { min: 0, max: last, ticks: { callback: tickText } }), y: axis(text, { ticks: { callback: tickText, ...(whole && { precision: 0 }) } }) },
        plugins: { legend: { display: runs.length > 1, position: 'bottom' } },
      },
    });
  }
}
