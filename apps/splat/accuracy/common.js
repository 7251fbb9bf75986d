// What the pages of `splat accuracy` share besides page/elements.js: plots, and the page's start.

// Round numbers from low to high.
function ticks(low, high) {
  const step = 10 ** Math.floor(Math.log10((high - low) / 4 || 1));
  const wide = [1, 2, 5, 10].map(f => f * step).find(s => (high - low) / s <= 7);
  const all = [];
  for (let t = Math.ceil(low / wide) * wide; t <= high; t += wide) all.push(t);
  return all;
}

const PLOT = { left: 70, right: 1080, top: 20, bottom: 430 };

// Clears `svg` and draws axes for x and y, each { values, label, tick }: the values to be shown, and a number's text. Gives
// where numbers are, what is beyond x.values' most at the edge.
function drawAxes(svg, x, y) {
  const { left, right, top, bottom } = PLOT;
  const range = values => {
    const [low, high] = [Math.min(...values), Math.max(...values)];
    return [low - 0.05 * (high - low || 1), high + 0.05 * (high - low || 1)];
  };
  const [x0, x1] = range(x.values), [y0, y1] = range(y.values);
  const px = v => left + Math.min(1, (v - x0) / (x1 - x0)) * (right - left);
  const py = v => bottom - (v - y0) / (y1 - y0) * (bottom - top);
  const plain = t => +t.toPrecision(6);
  svg.replaceChildren();
  for (const t of ticks(x0, x1))
    svg.append(element('line', { class: 'grid', x1: px(t), x2: px(t), y1: top, y2: bottom }),
      element('text', { x: px(t), y: bottom + 18, 'text-anchor': 'middle' }, (x.tick ?? plain)(t)));
  for (const t of ticks(y0, y1))
    svg.append(element('line', { class: 'grid', x1: left, x2: right, y1: py(t), y2: py(t) }),
      element('text', { x: left - 6, y: py(t) + 4, 'text-anchor': 'end' }, (y.tick ?? plain)(t)));
  svg.append(element('text', { x: (left + right) / 2, y: bottom + 40, 'text-anchor': 'middle' }, x.label),
    element('text', { x: left, y: top - 6 }, y.label));
  return { px, py, y0, y1 };
}

// Opened with #test, a page tries itself and says in data-test what came out: what a test reads.
function openPage(start, tryOut) {
  window.addEventListener('error', event => { document.documentElement.dataset.test = 'failed: ' + event.message; });
  byId('made').textContent = data.made;
  start();
  if (location.hash === '#test') document.documentElement.dataset.test = tryOut();
}
