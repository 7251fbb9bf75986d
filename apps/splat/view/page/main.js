// The page: keeps a picture up to date with where one looks from.
import { openScene, readFrame, readPixel, readScene } from './api.js';
import { keysHeld, takeKeys, takePointer } from './controls.js';
import { takeDrops } from './drop.js';
import { byId, element } from './element.js';
import { Eye } from './eye.js';
import { settingName, showKnobs } from './knobs.js';
import { showFacts, showLegend, showPixel } from './panels.js';

const REST = 250;            // ms without a step until a whole picture is drawn
const SLOW = 180, FAST = 70; // ms of a frame on the way: coarser above, finer below
const COARSEST = 4;
const HEATS = ['list', 'blends', 'cycles', 'saturation'];
const SIDES = ['a', 'b'];

let scene, eye;
const settings = { a: {}, b: {} };
const facts = { a: null, b: null };
let coarse = 2, version = 0, wholeVersion = -1, lastStep = -Infinity, frameTime = 0, busy = false, stop = null;

const two = () => byId('compare').checked;
const sides = () => two() ? SIDES : ['a'];
const layer = () => byId('layer').value;
const orbits = () => document.querySelector('[name=motion]:checked').value === 'orbit';
const figure = side => byId(`view-${side}`);
const canvasOf = side => figure(side).querySelector('canvas');
const status = text => { byId('status').textContent = text; };
const isMoving = () => keysHeld() || performance.now() - lastStep < REST;
const wait = ms => new Promise(done => setTimeout(done, ms));

function problem(failure) {
  byId('problem').hidden = !failure;
  byId('problem').textContent = failure ? failure.message : '';
}

function paint(side, image) {
  const canvas = canvasOf(side);
  canvas.width = image.width;
  canvas.height = image.height;
  canvas.getContext('2d').putImageData(image, 0, 0);
}

// What is on the page is not what is looked at any more.
function changed() {
  ++version;
  for (const mark of document.querySelectorAll('.mark')) mark.hidden = true;
  byId('gaussians').hidden = true;
  byId('pixel-about').textContent = 'Click into the picture, or press Enter for its middle.';
  stop?.abort();
  stop = null;
  keepUp();
}

function stepped() {
  lastStep = performance.now();
  byId('camera').value = '';
  changed();
}

const request = (side, more = {}, by = 1) => ({ camera: eye.camera(by, byId('lens').checked), setting: settingName(settings[side]), ...more });

async function drawCoarse() {
  const begun = performance.now();
  for (const side of sides()) {
    const { image } = await readFrame(request(side, {}, coarse));
    paint(side, image);
    showLegend(figure(side), null);
  }
  const took = performance.now() - begun;
  frameTime = frameTime ? 0.8 * frameTime + 0.2 * took : took;
  status(`${(1000 / frameTime).toFixed(1)} frames a second${coarse > 1 ? `, 1/${coarse} of the size` : ''}`);
  if (took > SLOW) coarse = Math.min(COARSEST, 2 * coarse);
  else if (took < FAST) coarse = Math.max(1, coarse / 2);
}

// What is asked for at rest, the quickest first.
function steps() {
  const shown = layer(), all = [{ layer: 'picture' }];
  const heat = HEATS.includes(shown);
  if (shown === 'depth') all.push({ layer: 'depth', says: 'depths' });
  if (heat || two() || byId('cycles').checked)
    all.push({ layer: heat ? shown : 'picture', clock: true, says: 'cycles of the machine' });
  if (shown === 'error' || two() || byId('errors').checked)
    all.push({ layer: shown === 'error' ? 'error' : 'picture', compare: true, says: 'the reference in fp64' });
  return all;
}

async function drawWhole(of) {
  facts.a = facts.b = null;
  for (const { says, ...step } of steps())
    for (const side of sides()) {
      if (of !== version) return;
      if (says) status(`${says} …`);
      stop = new AbortController();
      const answer = await readFrame(request(side, step), stop.signal);
      if (of !== version) return;
      facts[side] = { ...facts[side], ...answer.facts };
      if (!says || step.layer === layer()) {
        paint(side, answer.image);
        showLegend(figure(side), answer.facts.scale, scene.ramp);
      }
      show();
    }
  status(frameTime ? `whole picture; on the way ${(1000 / frameTime).toFixed(1)} frames a second` : 'whole picture');
  document.documentElement.dataset.drawn = String(of);
}

function show() {
  showFacts(sides().map(side => facts[side]));
  for (const side of sides()) {
    const f = facts[side];
    figure(side).querySelector('figcaption').textContent = !two() ? '' : [settingName(settings[side]),
      f?.cycles && `${f.cycles.toLocaleString('en')} cycles`,
      f?.error && (f.error.psnr_db === null ? 'equal to fp64' : `${f.error.psnr_db.toFixed(1)} dB`)].filter(t => t).join(' · ');
  }
}

// Draws until what is shown is what is looked at.
async function keepUp() {
  if (busy) return;
  busy = true;
  let drawn = -1;
  while (drawn !== version || wholeVersion !== version) {
    const now = version;
    try {
      if (isMoving()) {
        if (drawn === now) await wait(20);
        else await drawCoarse();
        drawn = now;
        problem(null);
      } else {
        await drawWhole(now);
        drawn = wholeVersion = now;
        problem(null);
      }
    } catch (failure) {
      if (failure.name === 'AbortError') continue;
      if (failure.superseded) {
        await wait(100);
        continue;
      }
      problem(failure);
      status('');
      drawn = wholeVersion = now;
    }
  }
  busy = false;
}

function choose(camera) {
  eye = new Eye(camera, scene.box, { width: scene.width, height: scene.height }, scene.up);
  byId('lens').disabled = !eye.isChoice;
  changed();
}

function setUp(described) {
  scene = described;
  if (!scene.cameras.length) scene.cameras = [Eye.ahead(scene.box, scene, scene.up)];
  byId('name').textContent = document.title = scene.name;
  byId('about').textContent = `${scene.gaussians.toLocaleString('en')} Gaussians, SH degree ${scene.sh_degree}, ${scene.format}; ${scene.width}x${scene.height} on ${scene.device}`;
  byId('camera').replaceChildren(...scene.cameras.map((c, n) => element('option', { value: n }, c.name)),
    element('option', { value: '', disabled: '' }, 'free'));
  byId('camera').selectedIndex = 0;
  byId('lens').checked = scene.through_lens;
  byId('lens').parentElement.hidden = !scene.cameras.some(c => c.lens_is_a_choice);
  const kept = layer();
  byId('layer').replaceChildren(...scene.layers.map(l => element('option', { value: l }, l)));
  if (kept) byId('layer').value = kept;
  arrange();
  choose(scene.cameras[0]);
}

function arrange() {
  byId('view-b').hidden = !two();
  byId('views').classList.toggle('two', two());
  for (const side of SIDES) figure(side).querySelector('canvas').style.aspectRatio = `${scene.width} / ${scene.height}`;
  showKnobs(byId('knobs'), scene.knobs, settings, two(), changed);
}

async function open(name, bytes) {
  status(`opening ${name} …`);
  try {
    const described = await openScene(name, bytes, scene.most_bytes);
    problem(null);
    setUp(described);
  } catch (failure) {
    problem(failure);
    status('the scene before stays');
  }
}

async function pick(x, y) {
  const at = { x: Math.min(Math.floor(x * scene.width), scene.width - 1), y: Math.min(Math.floor(y * scene.height), scene.height - 1) };
  for (const side of sides()) {
    const mark = figure(side).querySelector('.mark');
    mark.style.left = `${100 * (at.x + 0.5) / scene.width}%`;
    mark.style.top = `${100 * (at.y + 0.5) / scene.height}%`;
    mark.hidden = false;
  }
  byId('pixel-about').textContent = 'Asking the reference …';
  try {
    const of = version, pixel = await readPixel(request('a', at));
    if (of !== version) return;
    showPixel(pixel);
    problem(null);
  } catch (failure) {
    byId('pixel-about').textContent = '';
    problem(failure);
  }
}

function next(select) {
  select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
  select.dispatchEvent(new Event('change'));
}

const KEYS = {
  f: () => document.querySelector('[name=motion]:not(:checked)').click(),
  l: () => next(byId('layer')),
  c: () => byId('compare').click(),
  t: () => byId('lens').click(),
  r: () => {
    byId('camera').value ||= '0';
    byId('camera').dispatchEvent(new Event('change'));
  },
  Enter: () => pick(0.5, 0.5)
};

function key(name) {
  const camera = /^[1-9]$/.test(name) && scene.cameras[name - 1];
  if (camera) {
    byId('camera').value = String(name - 1);
    choose(camera);
  } else if (name in KEYS) KEYS[name]();
  else return false;
  return true;
}

function listen() {
  const hands = { eye: () => eye, orbits, moved: stepped, clicked: pick, key };
  takeKeys(hands);
  for (const side of SIDES) takePointer(canvasOf(side), hands);
  takeDrops(open, problem);
  byId('file').addEventListener('change', () => {
    const [file] = byId('file').files;
    byId('file').value = '';
    if (file) open(file.name, file);
  });
  byId('camera').addEventListener('change', () => choose(scene.cameras[byId('camera').value]));
  for (const id of ['layer', 'lens', 'cycles', 'errors']) byId(id).addEventListener('change', changed);
  byId('compare').addEventListener('change', () => { arrange(); changed(); });
  byId('reset').addEventListener('click', () => {
    settings.a = {};
    settings.b = {};
    arrange();
    changed();
  });
}

try {
  setUp(await readScene());
  listen();
} catch (failure) {
  problem(failure);
  status('');
}
