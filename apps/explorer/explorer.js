// The page of `vorion-clang --explorer`: lines of source, IR and assembly that belong together, and what they cost.

let shown = data;
let pinned = 0;

const series = getComputedStyle(document.documentElement).getPropertyValue('--series').trim().split(/\s+/);
const hueOf = line => series[line % series.length];
const panes = ['source', 'ir', 'assembly'];

// Of instructions: their sum, by reason.
function sumOf(instructions) {
  const sum = { cost: 0, executed: 0, reasons: {} };
  for (const i of instructions) {
    sum.cost += i.cost || 0;
    sum.executed += i.executed || 0;
    for (const [reason, cycles] of Object.entries(i.reasons || {})) sum.reasons[reason] = (sum.reasons[reason] || 0) + cycles;
  }
  return sum;
}

const sorted = reasons => Object.entries(reasons).filter(r => r[1]).sort((a, b) => b[1] - a[1]);
const percent = part => (100 * part / Math.max(shown.profile.total, 1)).toFixed(1);

function reasonColours() {
  const all = sorted(sumOf(shown.assembly).reasons).map(r => r[0]);
  return Object.fromEntries(all.map((reason, n) => [reason, series[n % series.length]]));
}

// The cells of a cost: its number, and a bar of its reasons.
function costCells(sum, most, colours) {
  if (!shown.profile) return [];
  const bar = element('td', { class: 'bar' });
  const unit = shown.profile.unit;
  if (sum.cost) {
    const parts = sorted(sum.reasons);
    const text = parts.map(([r, c]) => `${r} ${c} (${percent(c)} %)`).join('\n');
    bar.title = `${sum.cost} ${unit}, ${percent(sum.cost)} %\nexecuted ${sum.executed}\n${text}`;
    for (const [reason, cycles] of parts.length ? parts : [['', sum.cost]]) {
      const part = element('i');
      part.style.width = `${6.5 * cycles / most}em`;
      part.style.background = colours[reason] || 'var(--mark)';
      bar.append(part);
    }
  }
  return [element('td', { class: 'n' }, sum.cost ? String(sum.cost) : ''), bar];
}

function rowFor(line, cells) {
  const row = element('tr', {}, ...cells);
  if (line) {
    row.dataset.line = line;
    row.style.setProperty('--hue', hueOf(line));
  }
  return row;
}

function draw() {
  const colours = shown.profile ? reasonColours() : {};
  const byLine = {};
  for (const i of shown.assembly) if (i.line) (byLine[i.line] = byLine[i.line] || []).push(i);
  const sums = Object.fromEntries(Object.entries(byLine).map(([line, all]) => [line, sumOf(all)]));
  const mostOfLine = Math.max(1, ...Object.values(sums).map(s => s.cost));
  const mostOfOne = Math.max(1, ...shown.assembly.map(i => i.cost || 0));
  const linked = new Set([...shown.assembly, ...shown.ir].map(i => i.line));

  const tables = {
    source: shown.source.map((text, n) => rowFor(linked.has(n + 1) ? n + 1 : 0, [
      element('td', { class: 'n' }, String(n + 1)), ...costCells(sums[n + 1] || sumOf([]), mostOfLine, colours), element('td', {}, text)])),
    ir: shown.ir.map(i => rowFor(i.line, [element('td', {}, i.text)])),
    assembly: [],
  };
  const rest = byId('with-rest').checked;
  const functions = [];
  for (const i of shown.assembly) {
    if (i.label) functions.push({ label: i.label, all: [] });
    else functions.at(-1)?.all.push(i);
  }
  for (const f of functions.filter(f => rest || f.all.some(i => i.line))) {
    const head = rowFor(0, [element('td', { class: 'n' }), ...costCells(sumOf(f.all), Infinity, {}).slice(0, 1), ...(shown.profile ? [element('td')] : []), element('td', {}, f.label)]);
    head.className = 'head';
    tables.assembly.push(head);
    for (const i of f.all)
      tables.assembly.push(rowFor(i.line, [element('td', { class: 'n' }, i.address), ...costCells(sumOf([i]), mostOfOne, colours), element('td', {}, i.text)]));
  }
  for (const pane of panes) {
    const at = byId(pane).scrollTop;
    byId(pane).replaceChildren(element('table', {}, element('tbody', {}, ...tables[pane])));
    byId(pane).scrollTop = at;
  }
  byId('ir-pane').hidden = !byId('with-ir').checked;
  byId('panes').style.setProperty('--panes', byId('with-ir').checked ? 3 : 2);
  document.querySelector('h1').textContent = shown.file;
  document.title = shown.file;
  byId('what').textContent = [shown.command, shown.profile?.machine].filter(t => t).join(' · ');
  byId('log').textContent = shown.log;
  byId('log').hidden = !shown.log;
  byId('made').textContent = shown.made;
  const legend = sorted(sumOf(shown.assembly).reasons);
  byId('reasons').replaceChildren(...legend.map(([reason, cycles]) => {
    const mark = element('b');
    mark.style.background = colours[reason];
    return element('span', {}, mark, `${reason} ${percent(cycles)} %`);
  }));
  light(pinned);
}

// Marks the rows of `line` in all panes.
function light(line) {
  for (const row of document.querySelectorAll('.code tr')) {
    row.classList.toggle('on', line > 0 && +row.dataset.line === line);
    row.classList.toggle('pinned', pinned > 0 && +row.dataset.line === pinned);
  }
}

for (const pane of panes) {
  byId(pane).addEventListener('mouseover', e => light(+(e.target.closest('tr')?.dataset.line || pinned)));
  byId(pane).addEventListener('mouseleave', () => light(pinned));
  byId(pane).addEventListener('click', e => {
    const line = +(e.target.closest('tr')?.dataset.line || 0);
    pinned = line === pinned ? 0 : line;
    light(pinned);
    for (const other of panes) {
      const row = pinned && other !== pane && byId(other).querySelector(`tr[data-line="${pinned}"]`);
      // Not scrollIntoView(), which moves the page, too.
      if (row) byId(other).scrollTop += row.getBoundingClientRect().top - byId(other).getBoundingClientRect().top - byId(other).clientHeight / 3;
    }
  });
}
for (const id of ['with-ir', 'with-rest']) byId(id).addEventListener('change', draw);

// While the tool runs, a script beside the page has the newest data: pages of files may load scripts, but nothing else.
function explorerData(next) {
  byId('state').textContent = 'follows the file';
  if (next.serial === shown.serial && next.run === shown.run) return;
  shown = next;
  draw();
}
function look() {
  const script = element('script', { src: `${location.pathname.split('/').at(-1)}.js?${Date.now()}` });
  const done = () => { script.remove(); setTimeout(look, 500); };
  script.addEventListener('load', done);
  script.addEventListener('error', () => { byId('state').textContent = ''; done(); });
  document.body.append(script);
}
draw();
if (shown.follows) look();
