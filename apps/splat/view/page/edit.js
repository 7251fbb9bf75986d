// Edits of the scene: what is selected, shown over the picture, and what happens with it.
import { readBytes, readPlaces, tell } from './api.js';
import { byId, element } from './element.js';
import { saveBlob } from './save.js';

const MOST_PLACES = 400; // of a stroke, which a request holds
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

// Inputs of each tool: [name, how much a step is of the scene's radius, or a step itself].
const TOOLS = {
  box: [['from x', 0.02], ['y', 0.02], ['z', 0.02], ['to x', 0.02], ['y', 0.02], ['z', 0.02]],
  sphere: [['centre x', 0.02], ['y', 0.02], ['z', 0.02], ['radius', 0.02]],
  brush: [['radius, px', null, 2]],
  fainter: [['opacity below', null, 0.01]],
  larger: [['standard deviation above', 0.005]],
};

export class Editor {
  // `page`: scene(), eye(), camera(), figure(), pixelPoint(x, y), replaced(described), problem(failure), status(text).
  constructor(page) {
    this.page = page;
    this.parts = [];
    this.places = null;
    this.stroke = null;
    for (const tool of ['', ...Object.keys(TOOLS)]) byId('tool').append(element('option', { value: tool }, tool || 'nothing'));
    byId('tool').addEventListener('change', () => { this.showInputs(); this.changed(); });
    byId('here').addEventListener('click', () => this.moveHere());
    for (const op of ['add', 'remove'])
      byId(`part-${op}`).addEventListener('click', () => {
        const part = this.current();
        if (part) this.parts.push({ op, ...part });
        this.choose('');
      });
    byId('clear').addEventListener('click', () => { this.parts = []; this.choose(''); });
    for (const what of ['delete', 'crop', 'undo']) byId(what).addEventListener('click', () => this.edit(what));
    byId('save-scene').addEventListener('click', () => this.save());
    this.canvas = element('canvas', { class: 'overlay', 'aria-hidden': 'true' });
    page.figure().querySelector('.frame').append(this.canvas);
  }

  tool() { return byId('tool').value; }
  paints() { return this.tool() === 'brush'; }

  choose(tool) {
    byId('tool').value = tool;
    this.showInputs();
    this.changed();
  }

  // Another scene, or the same after an edit.
  began() {
    const { endings } = this.page.scene();
    const format = byId('format'), chosen = format.value;
    format.replaceChildren(...endings.map(e => element('option', { value: e }, e)));
    if (endings.includes(chosen)) format.value = chosen;
    this.parts = [];
    this.choose('');
  }

  // None while an edit is on its way.
  showButtons(busy = false) {
    byId('undo').disabled = busy || this.page.scene().edits === 0;
    for (const id of ['delete', 'crop']) byId(id).disabled = busy || this.all().length === 0;
  }

  values() { return [...byId('shape').querySelectorAll('input')].map(input => Number(input.value)); }

  showInputs() {
    const tool = this.tool(), { box } = this.page.scene(), { radius } = this.page.eye();
    const round = v => Number(v.toPrecision(4)), target = this.page.eye().target();
    const first = {
      box: (box.length ? box : [target.map(v => v - radius), target.map(v => v + radius)]).flat().map(round),
      sphere: [...target.map(round), round(radius / 2)], brush: [12], fainter: [0.05], larger: [round(radius / 20)]
    }[tool] ?? [];
    byId('shape').replaceChildren(...(TOOLS[tool] ?? []).map(([name, share, step]) => {
      const input = element('input', { type: 'number', step: step ?? Number((share * radius).toPrecision(1)), value: 0 });
      input.addEventListener('input', () => this.changed());
      return element('label', {}, `${name} `, input);
    }));
    [...byId('shape').querySelectorAll('input')].forEach((input, n) => { input.value = first[n]; });
    byId('here').hidden = tool !== 'box' && tool !== 'sphere';
    byId('brush-about').hidden = tool !== 'brush';
  }

  // Puts the middle of a box or sphere to what the middle of the picture shows.
  async moveHere() {
    try {
      const point = await this.page.pixelPoint(0.5, 0.5);
      if (!point) return;
      const inputs = [...byId('shape').querySelectorAll('input')], old = this.values();
      const middle = this.tool() === 'box' ? [0, 1, 2].map(k => (old[k] + old[k + 3]) / 2) : old.slice(0, 3);
      inputs.slice(0, this.tool() === 'box' ? 6 : 3).forEach((input, n) => {
        input.value = Number((old[n] + point[n % 3] - middle[n % 3]).toPrecision(4));
      });
      this.changed();
    } catch (failure) {
      this.page.problem(failure);
    }
  }

  // What the tool selects, as a part of a request.
  current() {
    const v = this.values();
    switch (this.tool()) {
      case 'box': return { box: v };
      case 'sphere': return { sphere: v };
      case 'fainter': return { fainter: v[0] };
      case 'larger': return { larger: v[0] };
      default: return null;
    }
  }

  all() {
    const part = this.current();
    return part ? [...this.parts, part] : this.parts;
  }

  painted(x, y, begins) {
    const { width, height } = this.page.eye().size;
    if (begins) this.stroke = { camera: this.page.camera(), radius: Math.max(1, this.values()[0]), points: [], op: 'add' };
    this.stroke.points.push([Math.round(x * width), Math.round(y * height)]);
    this.drawOver();
  }

  paintedAll(isRemoved) {
    const { op, ...stroke } = this.stroke;
    // Of a long stroke, every n-th place.
    const step = Math.ceil(stroke.points.length / MOST_PLACES);
    stroke.points = stroke.points.filter((_, n) => n % step === 0);
    this.stroke = null;
    this.parts.push({ op: isRemoved ? 'remove' : op, stroke });
    this.changed();
  }

  // The selection, or where one looks from.
  async changed() {
    this.places = null;
    this.drawOver();
    const parts = this.all(), of = this.version = (this.version ?? 0) + 1;
    byId('selected').textContent = parts.length ? '…' : 'Nothing is selected.';
    this.showButtons();
    if (parts.length === 0) return;
    try {
      const { facts, places } = await readPlaces({ parts, camera: this.page.camera() });
      if (of !== this.version) return;
      byId('selected').textContent = `${facts.selected.toLocaleString('en')} of ${facts.gaussians.toLocaleString('en')} Gaussians are selected.`;
      this.places = places;
      this.drawOver();
    } catch (failure) {
      if (of === this.version) this.page.problem(failure);
    }
  }

  // While one moves, shapes alone.
  moved() {
    this.places = null;
    this.drawOver();
  }

  // A point of the scene in pixels of the picture; nothing behind the camera. A lens's distortion is left out.
  project(point) {
    const { position, right, down, forward, lens } = this.page.eye();
    const from = point.map((v, i) => v - position[i]), z = dot(from, forward);
    return z > 1e-6 ? [lens.cx + lens.fx * dot(from, right) / z, lens.cy + lens.fy * dot(from, down) / z] : null;
  }

  lines() {
    const v = this.values();
    if (this.tool() === 'box') {
      const corner = n => [0, 1, 2].map(k => v[k + (n >> k & 1) * 3]);
      return [...Array(8).keys()].flatMap(n => [1, 2, 4].filter(bit => !(n & bit)).map(bit => [corner(n), corner(n | bit)]));
    }
    if (this.tool() !== 'sphere') return [];
    const circle = ([a, b]) => Array.from({ length: 49 }, (_, n) => {
      const at = v.slice(0, 3), angle = 2 * Math.PI * n / 48;
      at[a] += v[3] * Math.cos(angle);
      at[b] += v[3] * Math.sin(angle);
      return at;
    });
    return [[0, 1], [1, 2], [0, 2]].map(circle);
  }

  drawOver() {
    const { width, height } = this.page.eye().size, context = this.canvas.getContext('2d');
    this.canvas.width = width;
    this.canvas.height = height;
    context.fillStyle = '#ff2fd0';
    for (let n = 0; this.places && n < this.places.length; n += 2)
      context.fillRect(this.places[n] * width - 0.75, this.places[n + 1] * height - 0.75, 1.5, 1.5);
    context.lineWidth = 1.5;
    context.strokeStyle = '#ffe14d';
    for (const line of this.lines()) {
      context.beginPath();
      line.map(p => this.project(p)).forEach((at, n, all) => {
        if (!at) return;
        if (n && all[n - 1]) context.lineTo(...at);
        else context.moveTo(...at);
      });
      context.stroke();
    }
    if (!this.stroke) return;
    context.fillStyle = 'rgb(255 47 208 / 0.35)';
    context.beginPath();
    for (const [x, y] of this.stroke.points) {
      context.moveTo(x + this.stroke.radius, y);
      context.arc(x, y, this.stroke.radius, 0, 2 * Math.PI);
    }
    context.fill();
  }

  async edit(what) {
    this.showButtons(true);
    try {
      this.page.status(`${what} …`);
      this.page.replaced(await tell('edit', { do: what, scene: this.page.scene().number, parts: what === 'undo' ? [] : this.all() }));
      this.page.problem(null);
    } catch (failure) {
      this.page.status('');
      this.page.problem(failure);
      this.showButtons();
    }
  }

  async save() {
    const ending = byId('format').value, name = this.page.scene().name.replace(/\.[^.]*$/, '') + (this.page.scene().edits ? '-edited' : '') + ending;
    try {
      this.page.status(`writing ${name} …`);
      saveBlob(await readBytes('saved?name=' + encodeURIComponent(name)), name);
      this.page.status(`${name} is saved`);
    } catch (failure) {
      this.page.problem(failure);
    }
  }
}
