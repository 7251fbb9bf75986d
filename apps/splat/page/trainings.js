// The page of `splat compare --trainings --html`. data: { runs, rows, made }; a row: name, and its text of each run.

// The names of the files, if they differ; whole paths do not fit below a chart.
const fileNames = data.runs.map(r => r.name.split('/').pop());
if (new Set(fileNames).size === fileNames.length) data.runs.forEach((r, n) => { r.name = fileNames[n]; });

const redraw = () => drawCurves(data.runs);

openPage(() => {
  byId('rows').tHead.replaceChildren(rowOf(['', ...data.runs.map(r => r.name)], 'th'));
  byId('rows').tBodies[0].replaceChildren(...data.rows.map(row => rowOf(row)));
  redraw();
}, redraw, () => {
  if (new Set(data.rows.map(([name]) => name)).size !== data.rows.length) throw new Error('a row is there twice');
  if (charts.loss.data.datasets.length !== data.runs.length) throw new Error('not a curve a run');
  // Hidden, a canvas is empty.
  document.querySelectorAll('[hidden] canvas').forEach(canvas => canvas.remove());
  return `${data.runs.length} trainings`;
});
