// The page: keeps a picture up to date with where one looks from.
import { readAddress, writeAddress } from './address.js';
import { openScene, read, readFrame, tell, token } from './api.js';
import { keysHeld, takeKeys, takePointer } from './controls.js';
import { takeDrops } from './drop.js';
import { byId, element } from './element.js';
import { Editor } from './edit.js';
import { Eye } from './eye.js';
import { chosenBy, settingName, showKnobs } from './knobs.js';
import { showFacts, showLegend, showPixel } from './panels.js';
import { announce, remember, waitForServer } from './reconnect.js';
import { fileName, savePng } from './save.js';
import { pictureSize } from './size.js';

const REST = 250;            // ms without a step until a whole picture is drawn
const SLOW = 180, FAST = 70; // ms of a frame on the way: coarser above, finer below
const COARSEST = 8;
const LOOKS = 2000;          // ms between two looks at whether the server is there and shows the same scene
const HEATS = ['list', 'blends', 'cycles', 'saturation'];
const SIDES = ['a', 'b'];

let scene, eye, base, size, editor;
const settings = { a: {}, b: {} };
const facts = { a: null, b: null };
let coarse = 2, version = 0, wholeVersion = -1, lastStep = -Infinity, frameTime = 0, busy = false, stop = null;
// Wall seconds of a measurement of cycles for each second of the picture's simulation, as the last one took.
let clockFactor = 15;

const two = () => byId('compare').checked;
const sides = () => two() ? SIDES : ['a'];
const layer = () => byId('layer').value;
const motion = () => document.querySelector('[name=motion]:checked').value;
const orbits = () => motion() === 'orbit';
const figure = side => byId(`view-${side}`);
const canvasOf = side => figure(side).querySelector('canvas');
const status = text => { byId('status').textContent = text; };
const isMoving = () => keysHeld() || performance.now() - lastStep < REST;
const wait = ms => new Promise(done => setTimeout(done, ms));
const cameraName = () => byId('camera').value === '' ? 'free' : scene.cameras[byId('camera').value].name;

function problem(failure) {
  if (failure?.lost) {
    status('');
    waitForServer(text => problem(new Error(text)));
    return;
  }
  byId('problem').hidden = !failure;
  byId('problem').textContent = failure ? failure.message : '';
}

// The state of the page that differs from that of a new one.
function state() {
  const all = {
    motion: orbits() ? '' : 'fly', layer: layer() === 'picture' ? '' : layer(),
    lens: byId('lens').checked === scene.through_lens ? '' : byId('lens').checked ? 'on' : 'off',
    cycles: byId('cycles').checked ? '' : 'off', errors: byId('errors').checked ? 'on' : '', two: two() ? 'on' : ''
  };
  for (const [side, name] of [['a', 'left'], ['b', 'right']])
    if (Object.keys(settings[side]).length) all[name] = settingName(settings[side]);
  const free = byId('camera').value === '';
  if (free || scene.cameras[0] !== base) Object.assign(all, { scene: scene.name, camera: base.name });
  if (free) all.eye = eye.values().join(',');
  return Object.fromEntries(Object.entries(all).filter(([, text]) => text));
}

function keepAddress() {
  const now = state();
  remember(now);
  writeAddress(token, now);
}

// What the address says, before the first picture.
function takeState(kept) {
  const check = (id, name, otherwise) => { byId(id).checked = kept[name] ? kept[name] === 'on' : otherwise; };
  check('lens', 'lens', scene.through_lens);
  check('cycles', 'cycles', true);
  check('errors', 'errors', false);
  check('compare', 'two', false);
  document.querySelector(`[name=motion][value=${kept.motion === 'fly' ? 'fly' : 'orbit'}]`).checked = true;
  if (scene.layers.includes(kept.layer)) byId('layer').value = kept.layer;
  settings.a = chosenBy(kept.left, scene.knobs);
  settings.b = chosenBy(kept.right, scene.knobs);
}

// Of another scene, a camera says nothing.
function takeCamera(kept) {
  const found = kept.scene === scene.name ? scene.cameras.findIndex(c => c.name === kept.camera) : -1;
  byId('camera').value = String(Math.max(found, 0));
  choose(scene.cameras[Math.max(found, 0)]);
  if (found < 0 || !kept.eye) return;
  eye.restore(kept.eye.split(',').map(Number));
  byId('camera').value = '';
  changed();
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
  byId('triangles').replaceChildren();
  byId('pixel-about').textContent = 'Click into the picture, or press Enter for its middle. A double click turns to what is there.';
  byId('command').hidden = true;
  byId('facts').classList.add('past');
  editor?.moved();
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

// Says `what` with the seconds that it takes, of about `expected`, until the promise `work` is done.
async function timed(what, expected, work) {
  const begun = performance.now(), bar = byId('progress');
  const say = () => {
    const passed = (performance.now() - begun) / 1000;
    status(`${what} … ${passed.toFixed(0)} s${expected > 1 ? ` of about ${Math.ceil(Math.max(expected, passed))} s` : ''}`);
    bar.value = Math.min(0.99, passed / Math.max(expected, 0.1));
  };
  const ticks = setInterval(say, 250);
  say();
  bar.hidden = false;
  try {
    return await work;
  } finally {
    clearInterval(ticks);
    bar.hidden = true;
  }
}

async function drawWhole(of) {
  keepAddress();
  editor?.changed();
  facts.a = facts.b = null;
  for (const { says, ...step } of steps())
    for (const side of sides()) {
      if (of !== version) return;
      stop = new AbortController();
      const begun = performance.now(), expected = step.clock ? clockFactor * (facts[side]?.seconds ?? 0) : 0;
      const answered = readFrame(request(side, step), stop.signal);
      const answer = await (says ? timed(says, expected, answered) : answered);
      if (of !== version) return;
      facts[side] = { ...facts[side], ...answer.facts };
      // A kept answer comes at once, and says nothing of the next.
      const took = (performance.now() - begun) / 1000;
      if (step.clock && took > 0.3) clockFactor = took / answer.facts.seconds;
      facts[side].from = `${cameraName()}, ${answer.facts.width}x${answer.facts.height}`;
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
  byId('facts').classList.remove('past');
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
  if (busy || document.documentElement.dataset.away) return;
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
  base = camera;
  eye = new Eye(camera, scene.box, size, scene.up);
  byId('lens').disabled = !eye.isChoice;
  changed();
}

// Fits the pictures to the page; they are drawn again where that changes their size.
function arrange() {
  byId('view-b').hidden = !two();
  byId('views').classList.toggle('two', two());
  const fixed = scene.width && { width: scene.width, height: scene.height };
  const next = pictureSize(byId('views'), fixed, scene.most_pixels, sides().length);
  for (const side of SIDES) canvasOf(side).style.aspectRatio = `${next.width} / ${next.height}`;
  const isOther = size?.width !== next.width || size?.height !== next.height;
  size = next;
  if (!isOther || !eye) return;
  eye.fit(size);
  // Of a window that is being resized, coarse pictures until it rests.
  lastStep = performance.now();
  changed();
}

const showSettings = () => showKnobs(byId('knobs'), scene.knobs, settings, two(), changed);

// `kept`: what the page was before, as its address has it.
function setUp(described, kept) {
  scene = described;
  byId('name').textContent = document.title = scene.name;
  byId('about').textContent = `${scene.gaussians.toLocaleString('en')} Gaussians, SH degree ${scene.sh_degree}, ${scene.format}` +
    `${scene.triangles ? `; ${scene.triangles.toLocaleString('en')} triangles` : ''}; on ${scene.device}`;
  byId('warnings').textContent = scene.warnings.join('; ');
  byId('camera').replaceChildren(...scene.cameras.map((c, n) => element('option', { value: n }, c.name)),
    element('option', { value: '', disabled: '' }, 'free'));
  byId('lens').parentElement.hidden = !scene.cameras.some(c => c.lens_is_a_choice);
  byId('layer').replaceChildren(...scene.layers.map(l => element('option', { value: l }, l)));
  takeState(kept);
  showSettings();
  arrange();
  takeCamera(kept);
  editor ??= new Editor({
    scene: () => scene, eye: () => eye, camera: () => request('a').camera, figure: () => figure('a'), pixelPoint: pointAt,
    replaced: next => setUp(next, state()), problem, status
  });
  editor.began();
}

// Another page may have opened or edited a scene.
async function look() {
  if (document.hidden || document.documentElement.dataset.away) return;
  try {
    if ((await read('number')).scene !== scene.number) setUp(await read('scene'), state());
  } catch (failure) {
    if (failure.lost) problem(failure);
  }
}

async function open(name, bytes) {
  status(`opening ${name} …`);
  try {
    const described = await openScene(name, bytes, scene.most_bytes);
    problem(null);
    setUp(described, state());
  } catch (failure) {
    problem(failure);
    status('the scene before stays');
  }
}

const pixelAt = (x, y) => ({ x: Math.min(Math.floor(x * size.width), size.width - 1), y: Math.min(Math.floor(y * size.height), size.height - 1) });

// Without depths of all pixels, the reference has those of one.
const pointAt = async (x, y) => scene.layers.includes('depth')
  ? (await readFrame(request('a', { layer: 'depth', ...pixelAt(x, y) }))).facts.point
  : (await tell('pixel', request('a', pixelAt(x, y)))).point;

// Turns to what is shown at these shares of the picture, which is then what an orbit goes about.
async function turnTo(x, y) {
  try {
    const of = version, point = await pointAt(x, y);
    if (of !== version) return;
    if (!point) {
      status('nothing is shown there to turn to');
      return;
    }
    eye.lookAt(point);
    stepped();
  } catch (failure) {
    problem(failure);
  }
}

async function pick(x, y) {
  const at = pixelAt(x, y);
  for (const side of sides()) {
    const mark = figure(side).querySelector('.mark');
    mark.style.left = `${100 * (at.x + 0.5) / size.width}%`;
    mark.style.top = `${100 * (at.y + 0.5) / size.height}%`;
    mark.hidden = false;
  }
  byId('pixel-about').textContent = 'Asking the reference …';
  try {
    const of = version, pixel = await tell('pixel', request('a', at));
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

function savePicture() {
  for (const side of sides())
    savePng(canvasOf(side), fileName(scene.name.replace(/\.[^.]*$/, ''), cameraName(), layer() === 'picture' ? '' : layer(), two() ? settingName(settings[side]) : ''));
}

// The commands that draw what is shown, a line each, on the page and in the clipboard.
async function copyCommand() {
  try {
    const lines = await Promise.all(sides().map(async side => (await tell('command', request(side, { layer: layer() }))).command));
    byId('command').value = lines.join('\n');
    byId('command').hidden = false;
    byId('command').select();
    await navigator.clipboard.writeText(lines.join('\n'));
    // Keys move the camera again.
    byId('command').blur();
    status(`the command is in the clipboard${scene.edits ? '; it draws the scene as it is saved' : ''}`);
  } catch (failure) {
    // Without the clipboard it can be copied by hand.
    if (byId('command').hidden) problem(failure);
  }
}

function fillScreen() {
  if (document.fullscreenElement) document.exitFullscreen();
  else byId('views').requestFullscreen().catch(problem);
}

const KEYS = {
  f: () => document.querySelector('[name=motion]:not(:checked)').click(),
  l: () => next(byId('layer')),
  c: () => byId('compare').click(),
  t: () => byId('lens').click(),
  p: savePicture,
  x: copyCommand,
  z: fillScreen,
  r: () => {
    if (byId('camera').value === '') byId('camera').value = String(scene.cameras.indexOf(base));
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
  const hands = { eye: () => eye, orbits, moved: stepped, clicked: pick, clickedTwice: turnTo, key,
    paints: () => editor.paints(), painted: (x, y, begins) => editor.painted(x, y, begins), paintedAll: event => editor.paintedAll(event.shiftKey) };
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
  for (const radio of document.querySelectorAll('[name=motion]')) radio.addEventListener('change', keepAddress);
  byId('compare').addEventListener('change', () => { showSettings(); arrange(); changed(); });
  byId('reset').addEventListener('click', () => {
    settings.a = {};
    settings.b = {};
    showSettings();
    changed();
  });
  byId('save').addEventListener('click', savePicture);
  byId('copy').addEventListener('click', copyCommand);
  byId('full').addEventListener('click', fillScreen);
  for (const event of ['resize', 'fullscreenchange']) window.addEventListener(event, arrange);
  setInterval(look, LOOKS);
}

try {
  setUp(await read('scene'), readAddress().state);
  announce();
  listen();
} catch (failure) {
  problem(failure);
  status('');
}
