// The page of an answer: one sentence, then what it rests on. data: { heading, verdict, charts, pictures, tables, made }.

function figureOf({ image, caption }) {
  return element('figure', {}, element('img', { src: image, alt: caption }), element('figcaption', {}, caption));
}

function tableOf({ title, columns, rows }) {
  return element('div', { class: 'wide' }, element('table', { id: slug(title) }, element('thead', {}, rowOf(columns, 'th')),
    element('tbody', {}, ...rows.map(row => rowOf(row)))));
}

// Beside colours, for readers who cannot tell them apart.
const DASHES = [[], [7, 3], [2, 3], [9, 3, 2, 3], [1, 2], [12, 3], [4, 4]];

function redraw() {
  data.charts.forEach(({ title, x_label: x, y_label: y, places, bars, series }) => drawChart(slug(title), {
    type: bars ? 'bar' : 'line',
    data: { labels: places, datasets: series.map(({ name, values }, k) => ({ label: name, data: values, backgroundColor: seriesColour(k), borderColor: seriesColour(k),
      borderDash: bars ? [] : DASHES[k % DASHES.length], borderWidth: bars ? 0 : 1.5, pointRadius: 0 })) },
    options: {
      scales: { x: axis(x, { ticks: { autoSkip: !bars } }), y: axis(y, { beginAtZero: true }) },
      plugins: { title: { display: true, text: title, color: colour('ink') }, legend: { position: 'bottom' } },
    },
  }));
}

openPage(() => {
  document.title = data.heading;
  document.querySelector('h1').textContent = data.heading;
  byId('verdict').textContent = data.verdict;
  byId('charts').append(...data.charts.map(({ title }) => element('div', { class: 'chart', style: 'height: 24em' },
    element('canvas', { id: slug(title), role: 'img', 'aria-label': title }))));
  for (const { title, note, images } of data.pictures)
    byId('pictures').append(element('h2', {}, title), element('p', { class: 'note' }, note),
      element('div', { class: 'tiles' }, ...images.map(figureOf)));
  for (const table of data.tables)
    byId('tables').append(element('h2', {}, table.title), tableOf(table), element('p', { class: 'note' }, table.note));
  redraw();
}, redraw, () => {
  const images = document.images.length, rows = document.querySelectorAll('tbody tr').length;
  if (images + rows === 0) throw new Error('nothing is shown');
  return `${images} pictures and ${rows} rows`;
});
