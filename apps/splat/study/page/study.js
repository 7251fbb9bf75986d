// What pages of studies share: points on a chart and in a table, of which one is selected (see select() in common.js).

// A scatter chart on the canvas `id`. `points`: { x, y, name }, of which a click selects one; `dots`: how they are drawn, with
// `colours`, one a point; `isNamed`: which have their names beside them; `label`: a point's tooltip, if it has one; `more`: other
// datasets; `others`: other options.
function drawPoints(id, points, { colours, dots = {}, scales, isNamed, label, more = [], plugins = [], others = {} }) {
  const own = {
    label: 'points', data: points, pointBackgroundColor: 'transparent', pointBorderWidth: 2, pointBorderColor: colours, pointHoverBorderColor: colours,
    pointHoverBackgroundColor: 'transparent', ...dots,
  };
  drawChart(id, {
    type: 'scatter',
    data: { datasets: [own, ...more] },
    plugins: [...plugins, pointNames(p => (isNamed(p) ? p.name : ''))],
    options: {
      scales,
      plugins: { legend: { display: false }, tooltip: label ? { callbacks: { label: ({ raw }) => label(raw) } } : { enabled: false } },
      onClick: (event, found) => {
        const point = found.find(f => (f.datasetIndex ?? 0) === 0);
        if (point) select(points[point.index].name);
      },
      ...others,
    },
  });
}

// A line through points, which no pointer finds.
const lineOf = (label, points, which, more = {}) => ({ label, data: points, showLine: true, pointRadius: 0, pointHitRadius: 0, borderColor: colour(which), borderWidth: 1.5, ...more });

// The table #table of entries, sorted by state.sort, with the selected one and those on the front marked.
function drawEntries(columns, entries, nameOf, isOnFront = () => false) {
  drawColumns(byId('table'), columns, entries, state.sort, sort => { state.sort = sort; draw(); }, (row, e) => {
    row.classList.toggle('onfront', isOnFront(e));
    selects(row, nameOf(e), 'table');
  });
}

// For a page's test of itself: a click on a point of #plot selects it, and `shownIn` begins with its name.
function trySelecting(index, shownIn) {
  const { options, data: { datasets: [{ data: points }] } } = charts.plot;
  if (points.length < 2) throw new Error('fewer than two points');
  options.onClick({}, [{ datasetIndex: 0, index }]);
  if (!byId(shownIn).textContent.startsWith(points[index].name)) throw new Error('a click selects nothing');
  if (!document.querySelector('tr.selected')) throw new Error('no selection shown');
  const row = [...byId('table').tBodies[0].rows].at(-1);
  row.click();
  if (byId('table').querySelector('tr.selected')?.nextSibling !== byId('panel').closest('tr')) throw new Error('the panel is not below its row');
  options.onClick({}, [{ datasetIndex: 0, index }]);
  return points;
}
