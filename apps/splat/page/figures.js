// Figures of a page as files for papers: what the menu beside each chart and table saves, and what splat-figures writes. A chart is
// drawn again, in light colours and as wide as a column, on a context that writes SVG. Nothing here needs a browser but the menu.

// Of one column of a page with two, and of both, in CSS pixels (84 and 178 mm); a text of 8 points.
const MILLIMETRE = 96 / 25.4, COLUMN = 84 * MILLIMETRE, PAGE = 178 * MILLIMETRE, TEXT = 8 * 96 / 72;
const DOTS_PER_INCH = 300; // of PNG
const FONT = 'Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif';

// Widths of the letters from space to ~ in thousandths of a text's size, of the widest of these fonts, DejaVu Sans: a figure is the same
// on all computers, and its texts fit with the others. Other letters count as digits do.
const WIDTHS = [
  318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337, 636, 636, 636, 636, 636, 636, 636, 636, 636, 636, 337,
  337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635, 611, 732,
  684, 989, 685, 611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612, 635,
  635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838,
];
const textWidth = (text, size) => [...text].reduce((sum, letter) => sum + (WIDTHS[letter.charCodeAt(0) - 32] ?? 636), 0) * size / 1000;

const forXml = text => text.replace(/[&<>"]/g, c => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);
const rounded = value => String(+value.toFixed(2));

// The part of CanvasRenderingContext2D that charts use. Paths are kept in the picture's own pixels, as a canvas does.
class SvgContext {
  #parts = [];
  #clips = 0;
  #path = [];
  #kept = [];
  #own = {
    fillStyle: '#000', strokeStyle: '#000', lineWidth: 1, lineCap: 'butt', lineJoin: 'miter', lineDashOffset: 0, font: `${TEXT}px ${FONT}`,
    textAlign: 'start', textBaseline: 'alphabetic', globalAlpha: 1, dash: [], clip: '', matrix: [1, 0, 0, 1, 0, 0],
  };

  constructor(width, height) {
    this.canvas = { width, height, getContext: () => this };
    for (const name of Object.keys(this.#own).filter(n => !['dash', 'clip', 'matrix'].includes(n)))
      Object.defineProperty(this, name, { get: () => this.#own[name], set: value => { this.#own[name] = value; } });
  }

  save() { this.#kept.push({ ...this.#own }); }
  restore() { this.#own = this.#kept.pop() ?? this.#own; }
  setTransform(...matrix) { this.#own.matrix = matrix; }
  resetTransform() { this.setTransform(1, 0, 0, 1, 0, 0); }
  #multiply([a, b, c, d, e, f]) {
    const [A, B, C, D, E, F] = this.#own.matrix;
    this.#own.matrix = [A * a + C * b, B * a + D * b, A * c + C * d, B * c + D * d, A * e + C * f + E, B * e + D * f + F];
  }
  translate(x, y) { this.#multiply([1, 0, 0, 1, x, y]); }
  scale(x, y) { this.#multiply([x, 0, 0, y, 0, 0]); }
  rotate(by) { this.#multiply([Math.cos(by), Math.sin(by), -Math.sin(by), Math.cos(by), 0, 0]); }
  #at(x, y) {
    const [a, b, c, d, e, f] = this.#own.matrix;
    return `${rounded(a * x + c * y + e)} ${rounded(b * x + d * y + f)}`;
  }
  get #scale() { return Math.hypot(this.#own.matrix[0], this.#own.matrix[1]); }

  setLineDash(dash) { this.#own.dash = [...dash]; }
  getLineDash() { return this.#own.dash; }
  beginPath() { this.#path = []; }
  closePath() { this.#path.push('Z'); }
  moveTo(x, y) { this.#path.push(`M${this.#at(x, y)}`); }
  lineTo(x, y) { this.#path.push(`${this.#path.length ? 'L' : 'M'}${this.#at(x, y)}`); }
  bezierCurveTo(...c) { this.#path.push(`C${this.#at(c[0], c[1])} ${this.#at(c[2], c[3])} ${this.#at(c[4], c[5])}`); }
  rect(x, y, w, h) { this.#path.push(`M${this.#at(x, y)}L${this.#at(x + w, y)}L${this.#at(x + w, y + h)}L${this.#at(x, y + h)}Z`); }
  // Half a circle at most to a command, since the ends of a whole one are the same point.
  arc(x, y, r, from, to, backwards = false) {
    const whole = 2 * Math.PI;
    let turn = to - from;
    if (backwards ? turn <= -whole : turn >= whole) turn = backwards ? -whole : whole;
    else turn = backwards ? -(((-turn % whole) + whole) % whole) : ((turn % whole) + whole) % whole;
    const place = angle => this.#at(x + r * Math.cos(angle), y + r * Math.sin(angle)), size = rounded(r * this.#scale);
    this.#path.push(`${this.#path.length ? 'L' : 'M'}${place(from)}`);
    for (const half of [from + turn / 2, from + turn]) this.#path.push(`A${size} ${size} 0 0 ${turn < 0 ? 0 : 1} ${place(half)}`);
  }

  #add(name, attributes, content) {
    const text = Object.entries(attributes).filter(([, value]) => value !== '').map(([key, value]) => ` ${key}="${forXml(String(value))}"`).join('');
    this.#parts.push(`<${name}${text}${this.#own.clip}${content === undefined ? '/>' : `>${forXml(content)}</${name}>`}`);
  }
  // Attributes of a colour; SVG 1.1 has the opacity apart.
  #paint(name, colour) {
    const hex = /^#([0-9a-f]{6})([0-9a-f]{2})$/i.exec(colour), rgba = /^rgba\(([^,]+),([^,]+),([^,]+),([^)]+)\)$/.exec(colour);
    const opacity = this.#own.globalAlpha * (hex ? parseInt(hex[2], 16) / 255 : rgba ? +rgba[4] : 1);
    const plain = hex ? `#${hex[1]}` : rgba ? `rgb(${rgba[1]},${rgba[2]},${rgba[3]})` : colour;
    return colour === 'transparent' || opacity === 0 ? null : { [name]: plain, [`${name}-opacity`]: opacity === 1 ? '' : rounded(opacity) };
  }
  #paths(...attributes) {
    if (this.#path.length && attributes[0]) this.#add('path', Object.assign({ d: this.#path.join('') }, ...attributes));
  }
  fill(rule) { this.#paths(this.#paint('fill', this.fillStyle), { 'fill-rule': rule === 'evenodd' ? rule : '' }); }
  stroke() {
    if (this.lineWidth > 0)
      this.#paths(this.#paint('stroke', this.strokeStyle), {
        fill: 'none', 'stroke-width': rounded(this.lineWidth * this.#scale), 'stroke-dasharray': this.#own.dash.join(' '),
        'stroke-linecap': this.lineCap === 'butt' ? '' : this.lineCap, 'stroke-linejoin': this.lineJoin === 'miter' ? '' : this.lineJoin,
      });
  }
  clip() {
    const id = `clip${this.#clips++}`;
    this.#parts.push(`<clipPath id="${id}"><path d="${this.#path.join('')}"/></clipPath>`);
    this.#own.clip = ` clip-path="url(#${id})"`;
  }
  #rectangle(x, y, w, h, paint) {
    const before = this.#path;
    this.#path = [];
    this.rect(x, y, w, h);
    this[paint]();
    this.#path = before;
  }
  fillRect(x, y, w, h) { this.#rectangle(x, y, w, h, 'fill'); }
  strokeRect(x, y, w, h) { this.#rectangle(x, y, w, h, 'stroke'); }
  clearRect() {} // the paper is white

  get #size() { return +/([\d.]+)px/.exec(this.font)[1]; }
  get #bold() { return /\b(bold|[6-9]00)\b/.test(this.font); }
  measureText(text) { return { width: textWidth(String(text), this.#size) * (this.#bold ? 1.07 : 1) }; }
  fillText(text, x, y) {
    const size = this.#size, [a, b] = this.#own.matrix, paint = this.#paint('fill', this.fillStyle);
    if (!paint || text === '') return;
    // As tall as the letters of these fonts are above and below the line.
    const down = { middle: 0.35, top: 0.9, hanging: 0.75, bottom: -0.21, ideographic: -0.21 }[this.textBaseline] ?? 0;
    const turn = Math.atan2(b, a), [px, py] = this.#at(x, y + down * size).split(' ');
    this.#add('text', {
      x: px, y: py, 'font-size': rounded(size * this.#scale), 'font-weight': this.#bold ? 'bold' : '', ...paint,
      'text-anchor': { center: 'middle', right: 'end', end: 'end' }[this.textAlign] ?? '',
      transform: Math.abs(turn) > 1e-6 ? `rotate(${rounded(turn * 180 / Math.PI)} ${px} ${py})` : '',
    }, String(text));
  }
  strokeText() {}

  // The document, so wide and high; `made`: lines that say what made it.
  document(title, made) {
    const { width, height } = this.canvas;
    // A chart's size is in whole pixels.
    const mm = pixels => rounded(pixels / (Math.abs(width - COLUMN) < 1 ? width / 84 : MILLIMETRE));
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${mm(width)}mm" height="${mm(height)}mm" viewBox="0 0 ${rounded(width)} ${rounded(height)}" ` + // whose paper is white where the page around it is dark
      `font-family="${forXml(FONT)}">\n<title>${forXml(title)}</title>\n<desc>${forXml(made.join('\n'))}</desc>\n<rect width="100%" height="100%" fill="#fff"/>\n${this.#parts.join('\n')}\n</svg>\n`;
  }
}

// What drawChart() and drawCells() are asked for while the page draws for paper, by name; null while it draws for the screen.
let onPaper = null;

// The height of a plot without its axes and legend, for papers.
const plotHeight = ({ data: { labels = [], datasets }, options: { indexAxis, scales } }) => (indexAxis !== 'y' ? 0.55 * COLUMN :
  Math.min(200 * MILLIMETRE, labels.length * TEXT * (1 + 0.6 * (scales.y.stacked ? 1 : datasets.length))));

// A chart on paper. What surrounds the plot takes as much as it needs.
function chartOnPaper(config) {
  const drawn = height => {
    const context = new SvgContext(COLUMN, height);
    return new Chart(context.canvas, { ...config, platform: Chart.platforms.BasicPlatform, options: {
      ...config.options, responsive: false, devicePixelRatio: 1, plugins: { ...config.options.plugins, title: { display: false } } } });
  };
  const wanted = plotHeight(config), { chartArea, height } = drawn(2 * COLUMN);
  return drawn(height - chartArea.height + wanted).ctx;
}

// Cells on paper, with the scale of their colours below.
function cellsOnPaper({ width, height, paint, colour: colourOf, end }) {
  const tall = COLUMN * height / width, context = new SvgContext(COLUMN, tall + 2.5 * TEXT), steps = 64;
  context.save();
  context.scale(COLUMN / width, COLUMN / width);
  paint(context);
  context.restore();
  context.font = `${TEXT}px ${FONT}`;
  const from = 2 * TEXT, to = COLUMN - textWidth(end, TEXT) - TEXT, y = tall + TEXT, step = (to - from) / steps;
  for (let n = 0; n < steps; ++n) {
    context.fillStyle = colourOf((n + 0.5) / steps);
    context.fillRect(from + n * step, y, Math.min(2 * step, to - from - n * step), TEXT); // no gaps between steps
  }
  context.fillStyle = colour('ink');
  context.textBaseline = 'middle';
  context.textAlign = 'right';
  context.fillText('0', from - TEXT / 2, y + TEXT / 2);
  context.textAlign = 'left';
  context.fillText(end, to + TEXT / 2, y + TEXT / 2);
  return context;
}

// The numbers of a chart: a column for a series of bars, a row for a point of others.
function rowsOfChart({ data: { labels, datasets }, options: { scales, indexAxis } }) {
  const title = which => scales[which].title?.text ?? '';
  if (!labels)
    return [['series', 'point', title('x'), title('y')],
      ...datasets.flatMap(({ label = '', data: points }) => points.map(({ x, y, name = '' }) => [label, name, x, y]))];
  const [of, unit] = indexAxis === 'y' ? ['y', 'x'] : ['x', 'y'];
  return [[title(of) || 'name', ...datasets.map(({ label }) => [label, title(unit).split(', ').at(-1)].filter(t => t).join(', '))],
    ...labels.map((label, n) => [label, ...datasets.map(({ data: values }) => (Array.isArray(values[n]) ? values[n][1] - values[n][0] : values[n] ?? ''))])];
}

const rowsOfTable = table => [...table.querySelectorAll('tr')].map(row => [...row.children].map(cell => cell.textContent.trim()));

// A number as it is shown: separators of thousands, a sign, a factor's or a share's mark.
const SHOWN = /^(?:× )?([+−-]?\d[\d,]*(?:\.\d+)?(?:e[+-]?\d+)?)( %| dB| MB| M| mJ)?$/;

// As numbers, where all cells of a column are or say nothing; a unit that they share goes into the heading.
function plainRows([head, ...rows]) {
  const isEmpty = text => text === '' || text === '—' || text === '–';
  const columns = head.map((label, n) => {
    const found = rows.map(row => row[n] ?? '').filter(text => !isEmpty(text)).map(text => SHOWN.exec(text));
    const unit = found[0]?.[2] ?? '';
    return found.length && found.every(f => f && (f[2] ?? '') === unit) ? { unit, isNumber: true } : { unit: '', isNumber: false };
  });
  const plain = (text, { isNumber }) => (typeof text !== 'string' || !isNumber ? text : isEmpty(text) ? '' : SHOWN.exec(text)[1].replaceAll(',', '').replace('−', '-'));
  return [head.map((label, n) => `${label}${columns[n].unit && !label.includes(columns[n].unit.trim()) ? `,${columns[n].unit}` : ''}`),
    ...rows.map(row => row.map((text, n) => plain(text, columns[n])))];
}

// Whether a column of a table has texts, which stand at its left; numbers are at its right.
const isText = (rows, n) => n === 0 || rows.some(row => row[n] && !/^([×+−-] ?)?[\d.,]+( .*)?$|^[—–]$/.test(row[n]));

function csvOf(rows, title, made) {
  const cell = value => (/[",\n\r]/.test(String(value)) ? `"${String(value).replaceAll('"', '""')}"` : String(value));
  return [title, ...made].map(line => `# ${line.replaceAll(/[\n\r]/g, ' ')}\n`).join('') + rows.map(row => row.map(cell).join(',') + '\n').join('');
}

const LATEX = {
  '\\': '\\textbackslash{}', '{': '\\{', '}': '\\}', $: '\\$', '&': '\\&', '#': '\\#', '%': '\\%', _: '\\_', '~': '\\textasciitilde{}',
  '^': '\\textasciicircum{}', '<': '\\textless{}', '>': '\\textgreater{}', '|': '\\textbar{}', '−': '$-$', '×': '$\\times$', '±': '$\\pm$',
  µ: '\\textmu{}', '²': '\\textsuperscript{2}', '—': '---', '–': '--', '“': '``', '”': "''", '→': '$\\rightarrow$',
};

const forLatex = text => [...text].map(c => LATEX[c] ?? c).join('');

// The sizes of a table, from the first in which it fits into a column: command, points of a letter of WIDTHS that is as wide as
// LaTeX's, points between columns.
const LATEX_SIZES = [['', 9, 12], ['\\footnotesize', 7.6, 6], ['\\scriptsize', 7, 4]];
const LATEX_COLUMN = 84 / 25.4 * 72.27; // points

// Texts that wrap may do so behind these letters of settings, too.
const pieces = text => text.split(/(?<=[ ,=_.:])/);
const widest = (texts, points) => Math.max(...texts.map(text => textWidth(text.trim(), points)));

// The least and the greatest width of a column in points.
function latexWidths(head, rows, n, points) {
  const most = widest(rows.map(row => row[n] ?? ''), points), heading = widest(head[n].split(' '), points);
  const least = isText(rows, n) ? Math.min(most, Math.max(5.5 * points, widest(rows.flatMap(row => pieces(row[n] ?? '')), points))) : most;
  return { least: Math.max(heading, least), most: Math.max(heading, most) };
}

// The columns `shown` as a tabular; texts take what numbers leave of the column.
function tabularOf(head, rows, shown, points, gap) {
  const widths = shown.map(n => latexWidths(head, rows, n, points)), sum = of => widths.reduce((total, w) => total + of(w), 0);
  const room = LATEX_COLUMN - gap * (shown.length - 1), spread = Math.min(1, Math.max(0, room - sum(w => w.least)) / Math.max(1e-9, sum(w => w.most - w.least)));
  const columns = shown.map((n, k) => {
    const { least, most } = widths[k];
    return { n, width: least + spread * (most - least), isWrapped: spread < 1 && most > least, side: isText(rows, n) ? 'l' : 'r' };
  });
  const heading = ({ n, width, side }) => {
    const lines = head[n].split(' ').reduce((all, word) => {
      const longer = all.length ? `${all.at(-1)} ${word}` : word;
      return all.length && widest([longer], points) > width ? [...all, word] : [...all.slice(0, -1), longer];
    }, []).map(forLatex);
    return lines.length > 1 ? `\\begin{tabular}[b]{@{}${side}@{}}${lines.join('\\\\')}\\end{tabular}` : lines[0];
  };
  const cell = (text, { width, isWrapped }) => (!isWrapped ? forLatex(text) :
    `\\parbox[t]{${rounded(width)}pt}{\\raggedright\\strut ${pieces(text).map(forLatex).join('\\allowbreak{}').replaceAll(' \\allowbreak{}', ' ')}\\strut}`);
  const line = cells => cells.join(' & ') + ' \\\\\n';
  return `\\begin{tabular}{@{}${columns.map(c => c.side).join('')}@{}}\n\\toprule\n${line(columns.map(heading))}\\midrule\n` +
    `${rows.map(row => line(columns.map(c => cell(row[c.n] ?? '', c)))).join('')}\\bottomrule\n\\end{tabular}\n`;
}

// With the rules of the package booktabs, and as wide as a column at most; of too many columns, in parts that all have the
// first one, and of two runs no part both.
function latexOf([head, ...rows], title, made) {
  const all = head.map((_, n) => n);
  const fits = (shown, [, points, gap]) => shown.reduce((sum, n) => sum + gap + latexWidths(head, rows, n, points).least, -gap) <= LATEX_COLUMN;
  const size = LATEX_SIZES.find(s => fits(all, s)) ?? LATEX_SIZES.at(-1), [command, points, gap] = size;
  const parts = [[0]];
  for (const n of all.slice(1)) {
    const last = parts.at(-1), isOther = head[n - 1].endsWith(' A') && head[n].endsWith(' B');
    if (last.length === 1 || fits(all, size) || (fits([...last, n], size) && !isOther)) last.push(n);
    else parts.push([0, n]);
  }
  const body = parts.map(shown => tabularOf(head, rows, shown, points, gap)).join('\\par\\medskip\n');
  return [title, ...made].map(text => `% ${text.replaceAll(/[\n\r]/g, ' ')}\n`).join('') +
    (command ? `\\begingroup${command}\\setlength{\\tabcolsep}{${gap / 2}pt}\n${body}\\par\\endgroup\n` : body);
}

// A table on paper: as wide as a column, or up to a page's width; what is wider yet is set smaller.
function tableOnPaper([head, ...rows]) {
  const gap = 1.2 * TEXT, lineHeight = 1.45 * TEXT, letters = 24; // of a heading's line
  const headings = head.map(text => text.split(' ').reduce((lines, word) => {
    const last = lines.at(-1);
    if (last !== '' && last.length + word.length >= Math.min(letters, 14)) return [...lines, word];
    return [...lines.slice(0, -1), last === '' ? word : `${last} ${word}`];
  }, ['']));
  const widths = head.map((_, n) => Math.max(...[...headings[n], ...rows.map(row => row[n] ?? '')].map(text => textWidth(text, TEXT))));
  const all = widths.reduce((sum, w) => sum + w + gap, gap), tall = Math.max(...headings.map(h => h.length));
  const fit = Math.min(1, PAGE / all), width = all <= COLUMN ? COLUMN : all * fit, spare = Math.max(0, COLUMN - all) / head.length;
  const context = new SvgContext(width, fit * ((tall + rows.length) * lineHeight + 2 * gap));
  context.scale(fit, fit);
  context.font = `${TEXT}px ${FONT}`;
  context.fillStyle = context.strokeStyle = colour('ink');
  let y = gap / 2;
  const rule = thick => {
    context.lineWidth = thick;
    context.beginPath();
    context.moveTo(0, y);
    context.lineTo(width / fit, y);
    context.stroke();
  };
  const texts = head.map((_, n) => isText(rows, n));
  const line = cells => {
    let x = gap;
    y += lineHeight;
    cells.forEach((text, n) => {
      const room = widths[n] + spare;
      context.textAlign = texts[n] ? 'left' : 'right';
      context.fillText(text ?? '', texts[n] ? x : x + room, y - 0.4 * TEXT);
      x += room + gap;
    });
  };
  rule(1);
  for (let n = 0; n < tall; ++n) line(headings.map(h => h[n - tall + h.length] ?? ''));
  rule(0.6);
  rows.forEach(line);
  rule(1);
  return context;
}

const slug = text => text.toLowerCase().replaceAll(/[^a-z0-9]+/g, '-').replaceAll(/^-|-$/g, '');

function isShown(e) {
  for (; e; e = e.parentElement) if (e.hidden) return false;
  return true;
}

// The figures as they are shown: { name, title, box, svg, csv } and of tables latex. `wants` is asked about each by its name, its
// numbers as CSV, and the element around it.
function figures(wants = () => true) {
  const screen = { ...Chart.defaults.font }, found = [];
  onPaper = {};
  page.redraw();
  let heading = '';
  for (const box of document.querySelectorAll('h2, .chart, .wide, .map')) {
    const canvas = box.querySelector('canvas'), table = box.querySelector('table');
    if (box.tagName === 'H2') heading = box.textContent;
    const asked = canvas && onPaper[canvas.id];
    if (!isShown(box) || !(asked || table?.querySelector('td'))) continue;
    const title = asked ? canvas.getAttribute('aria-label') : heading, shown = !asked && rowsOfTable(table);
    const name = slug(asked ? canvas.id : table.id || heading);
    const csv = csvOf(!asked ? plainRows(shown) : asked.rows ?? rowsOfChart(asked), title, data.made);
    if (!wants(name, csv, box)) continue;
    const context = !asked ? tableOnPaper(shown) : asked.paint ? cellsOnPaper(asked) : chartOnPaper(asked);
    found.push({ name, title, box, svg: context.document(title, data.made), csv, ...(!asked && { latex: latexOf(shown, title, data.made) }) });
  }
  onPaper = null;
  Object.assign(Chart.defaults.font, screen);
  return found;
}

// The same with each choice of the page's controls; what a choice does not change is left out.
function figuresOfAllChoices() {
  const found = [], seen = new Set();
  const collect = suffix => {
    const isNew = (name, csv) => !seen.has(name + csv) && seen.add(name + csv);
    for (const { box, ...figure } of figures(isNew)) found.push({ ...figure, name: figure.name + suffix });
  };
  collect('');
  for (const select of document.querySelectorAll('.controls select')) {
    const before = select.value;
    const choose = value => {
      select.value = value;
      select.dispatchEvent(new Event('change'));
    };
    for (const { value } of select.classList.contains('picks') ? [] : [...select.options])
      if (value !== before) {
        choose(value);
        collect(`-${select.id}-${slug(value)}`);
      }
    choose(before);
  }
  return found;
}

// A chunk of a PNG file.
function pngChunk(kind, bytes) {
  const all = new Uint8Array(12 + bytes.length), view = new DataView(all.buffer);
  view.setUint32(0, bytes.length);
  all.set([...kind].map(c => c.charCodeAt(0)), 4);
  all.set(bytes, 8);
  let crc = ~0;
  for (const byte of all.subarray(4, 8 + bytes.length)) {
    crc ^= byte;
    for (let k = 0; k < 8; ++k) crc = crc & 1 ? crc >>> 1 ^ 0xedb88320 : crc >>> 1;
  }
  view.setUint32(8 + bytes.length, ~crc);
  return all;
}

// The PNG file `file` with its resolution and what made it inside.
function describedPng(file, made) {
  const size = new Uint8Array(9), view = new DataView(size.buffer), header = 8 + 25; // the signature and IHDR
  [0, 4].forEach(at => view.setUint32(at, Math.round(DOTS_PER_INCH / 0.0254)));
  size[8] = 1; // per metre
  const text = Uint8Array.from(unescape(encodeURIComponent(`Description\0\0\0\0\0${made.join('\n')}`)), c => c.charCodeAt(0));
  const parts = [file.subarray(0, header), pngChunk('pHYs', size), pngChunk('iTXt', text), file.subarray(header)];
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((at, part) => { all.set(part, at); return at + part.length; }, 0);
  return all;
}

async function pngOf(svg) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = element('canvas', { width: Math.round(image.width * DOTS_PER_INCH / 96), height: Math.round(image.height * DOTS_PER_INCH / 96) });
  const context = canvas.getContext('2d');
  context.fillStyle = '#fff';
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  const blob = await new Promise(done => { canvas.toBlob(done); });
  return describedPng(new Uint8Array(await blob.arrayBuffer()), data.made);
}

async function save(box, kind) {
  const [figure] = figures((name, csv, of) => of === box);
  page.redraw();
  const text = figure[kind === 'tex' ? 'latex' : kind], name = `${figure.name}.${kind}`;
  const blob = new Blob([kind === 'png' ? await pngOf(figure.svg) : text]);
  const link = element('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// Below each chart and table, in the same tile.
function addMenus() {
  for (const box of document.querySelectorAll('.chart, .wide, .map')) {
    const kinds = ['svg', 'png', 'csv', ...(box.classList.contains('wide') ? ['tex'] : [])];
    const menu = element('p', { class: 'save' }, 'save as ', ...kinds.map(kind => {
      const button = element('button', { type: 'button' }, kind === 'tex' ? 'LaTeX' : kind.toUpperCase());
      button.addEventListener('click', () => save(box, kind));
      return button;
    }));
    if (box.classList.contains('map')) box.append(menu);
    else if (box.parentElement.classList.contains('tiles')) {
      const tile = element('div', { class: 'tile' });
      box.replaceWith(tile);
      tile.append(box, menu);
    } else box.after(menu);
  }
}
