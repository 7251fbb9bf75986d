// What is known of a picture, as tables.
import { byId, element } from './element.js';

const whole = n => Math.round(n).toLocaleString('en');
const milli = seconds => `${(1000 * seconds).toFixed(1)} ms`;
const short = n => n === 0 ? '0' : Math.abs(n) >= 0.001 && Math.abs(n) < 1e5 ? String(+n.toPrecision(4)) : n.toExponential(2);

// Name, text, and whether a text that two pictures share stands there once.
const FACTS = [
  ['measured for', f => f.from ?? '', true],
  ['cycles of the machine', f => f.cycles === undefined ? '' : whole(f.cycles)],
  ['time on the machine', f => f.machine_ms === undefined ? '' : `${f.machine_ms.toFixed(2)} ms`],
  ['machine', f => f.clocked_machine ?? '', true],
  ['PSNR against fp64', f => !f.error ? '' : f.error.psnr_db === null ? 'equal' : `${f.error.psnr_db.toFixed(1)} dB`],
  ['largest error', f => !f.error ? '' : short(f.error.max_abs)],
  ['pixels off by 1/255', f => !f.error ? '' : `${(100 * f.error.off_share).toFixed(2)} %`],
  ['Gaussians seen', f => whole(f.visible)],
  ['pairs with tiles', f => whole(f.pairs)],
  ['time of the simulation', f => milli(f.seconds)]
];

const head = () => element('tr', {}, element('th', {}, ''), element('th', { scope: 'col' }, 'left'), element('th', { scope: 'col' }, 'right'));

// `all`: the facts of one picture, or of two.
export function showFacts(all) {
  const once = (texts, isShared) => (isShared && texts.every(t => t === texts[0]) ? texts.slice(0, 1) : texts);
  const rows = FACTS.map(([name, of, isShared]) => [name, once(all.map(f => f ? of(f) : ''), isShared)]).filter(([, texts]) => texts.some(t => t));
  byId('facts').tBodies[0].replaceChildren(...(all.length > 1 ? [head()] : []),
    ...rows.map(([name, texts]) => element('tr', {}, element('th', { scope: 'row' }, name), ...texts.map(t => element('td', { colspan: 1 + all.length - texts.length }, t)))));
  const first = all.find(f => f);
  if (!first) return;
  byId('stages').tBodies[0].replaceChildren(...first.stages.map(s => element('tr', {}, element('th', { scope: 'row' }, s.name),
    element('td', {}, milli(s.seconds)), element('td', {}, first.stage_cycles?.[s.name] === undefined ? '' : `${whole(first.stage_cycles[s.name])} cycles`))));
  byId('effects').replaceChildren(...first.effects.map(e => element('li', { class: e.on ? 'on' : 'off' },
    element('b', {}, e.name), ` ${e.on ? 'on' : 'off'}: ${e.figure}`, element('small', {}, e.what))));
}

// Below the picture `figure`, what its colours stand for; nothing where they are its own.
export function showLegend(figure, scale, ramp) {
  const legend = figure.querySelector('.legend'), [low, colors, high, unit] = legend.children;
  legend.hidden = !scale?.unit;
  if (legend.hidden) return;
  // A logarithmic scale has its powers of ten below it, and no values beside it.
  const decades = scale.logarithmic ? Math.round(Math.log10(scale.high / scale.low)) : 0;
  colors.replaceChildren(...Array.from({ length: decades ? decades + 1 : 0 }, (_, n) => element('span', {}, scale.high === 1 && n === decades ? '1'
    : `1e${Math.round(Math.log10(scale.low)) + n}`)));
  low.textContent = decades ? '' : short(scale.low);
  high.textContent = decades ? '' : short(scale.high);
  unit.textContent = scale.unit;
  colors.style.background = `linear-gradient(to right, ${ramp.join(', ')})`;
}

const MOST_ROWS = 40;
const color = c => `rgb(${c.map(v => Math.round(255 * Math.max(0, Math.min(1, v)))).join(' ')})`;
const percent = share => `${(100 * share).toFixed(2)} %`;
const sumOf = parts => parts.reduce((s, part) => s + part.weight, 0);

// "triangle 3 of wall.obj, door"
const nameOf = t => `triangle ${t.number} of ${[t.file, t.part].filter(n => n).join(', ')}`;

function row(name, part, ...cells) {
  const swatch = element('span', { class: 'swatch' });
  swatch.style.background = color(part.color);
  return element('tr', {}, element('th', { scope: 'row' }, swatch, ` ${name}`),
    ...[percent(part.weight), part.alpha.toFixed(3), short(part.depth), ...cells].map(t => element('td', {}, t)));
}

// The rows of `gaussians` with a weight of at least `least`, with the triangles between them.
function rows({ gaussians, triangles }, least) {
  const all = [], add = n => all.push(...triangles.filter(t => t.in_front === n).map(t => row(nameOf(t), t, '', '', '')));
  gaussians.forEach((g, n) => {
    add(n);
    if (g.weight >= least) all.push(row(g.index, g, whole(g.tiles), whole(g.pixels), g.error.toExponential(1)));
  });
  add(gaussians.length);
  return all;
}

export function showPixel(pixel) {
  const table = byId('gaussians'), { gaussians, triangles } = pixel;
  const triple = c => c.map(v => v.toFixed(4)).join(', ');
  byId('pixel-about').textContent = `(${pixel.x}, ${pixel.y}): ${gaussians.length} Gaussians, together ${(100 * sumOf(gaussians)).toFixed(1)} % of it` +
    (triangles.length ? `, triangles ${(100 * sumOf(triangles)).toFixed(1)} %` : '') +
    `. Reference in fp64: ${triple(pixel.reference)}.` + (pixel.machine ? ` Machine: ${triple(pixel.machine)}.` : '') +
    (gaussians.length > MOST_ROWS ? ` The ${MOST_ROWS} of the most weight, front to back:` : ' Front to back:');
  byId('triangles').replaceChildren(...triangles.map(t => element('li', {},
    `${nameOf(t)}: corners ${t.corners.map(c => `(${c.map(short).join(', ')})`).join(', ')}`)));
  table.hidden = gaussians.length + triangles.length === 0;
  const least = gaussians.map(g => g.weight).sort((a, b) => b - a)[MOST_ROWS - 1] ?? 0;
  table.tHead.replaceChildren(element('tr', {}, ...['Gaussian', 'weight', 'alpha', 'depth', 'tiles', 'pixels', 'error in fp32']
    .map(n => element('th', { scope: 'col' }, n))));
  table.tBodies[0].replaceChildren(...rows(pixel, least));
}
