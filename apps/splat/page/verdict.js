// The page of an answer: one sentence, then what it rests on. data: { heading, verdict, charts, pictures, tables, made }.

function figureOf({ image, caption }) {
  return element('figure', {}, element('img', { src: image, alt: caption }), element('figcaption', {}, caption));
}

function tableOf({ columns, rows }) {
  return element('div', { class: 'wide' }, element('table', {}, element('thead', {}, rowOf(columns, 'th')),
    element('tbody', {}, ...rows.map(row => rowOf(row)))));
}

const redraw = () => {};

openPage(() => {
  document.title = data.heading;
  document.querySelector('h1').textContent = data.heading;
  byId('verdict').textContent = data.verdict;
  byId('charts').append(...data.charts.map(image => element('img', { src: image, alt: '', style: 'width: 100%; max-width: 60em' })));
  for (const { title, note, images } of data.pictures)
    byId('pictures').append(element('h2', {}, title), element('p', { class: 'note' }, note),
      element('div', { class: 'tiles' }, ...images.map(figureOf)));
  for (const table of data.tables)
    byId('tables').append(element('h2', {}, table.title), tableOf(table), element('p', { class: 'note' }, table.note));
}, redraw, () => {
  const images = document.images.length, rows = document.querySelectorAll('tbody tr').length;
  if (images + rows === 0) throw new Error('nothing is shown');
  return `${images} pictures and ${rows} rows`;
});
