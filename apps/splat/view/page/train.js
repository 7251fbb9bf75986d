// The page of a training: what the scene looks like after the last iteration, and the run's curves.
/* global drawCurves */
import { readAddress, writeAddress } from './address.js';
import { read, readFrame, tell, token } from './api.js';
import { takeKeys, takePointer } from './controls.js';
import { byId, element } from './element.js';
import { Eye } from './eye.js';
import { fileName, savePng } from './save.js';
import { announce, remember, waitForServer } from './reconnect.js';
import { pictureSize } from './size.js';

const LOOKS = 500;   // ms between two looks at the run
const REDRAWS = 1000; // ms from a picture at rest to the next, which the training waits for

let described, eye, chosen = 0, run = { losses: [], gaussian_counts: [], scores: [], machine_ms: [] }, drawnAfter = -1, moved = 0, drawn = 0;
const canvas = document.querySelector('#view-a canvas');
const status = text => { byId('status').textContent = text; };
const wait = ms => new Promise(done => setTimeout(done, ms));

function problem(failure) {
  if (failure?.lost && !run.ended) waitForServer(text => problem(new Error(text)));
  byId('problem').hidden = !failure;
  byId('problem').textContent = failure ? failure.message : '';
}

function keepAddress() {
  const state = { ...(chosen ? { camera: described.cameras[chosen].name } : {}), ...(byId('camera').value === '' ? { eye: eye.values().join(',') } : {}) };
  remember(state);
  writeAddress(token, state);
}

function arrange() {
  const camera = described.cameras[chosen];
  pictureSize(byId('views'), { width: camera.width, height: camera.height }, Infinity, 1);
  canvas.style.aspectRatio = `${camera.width} / ${camera.height}`;
}

function choose(n) {
  chosen = n;
  const camera = described.cameras[n];
  eye = new Eye(camera, described.looked_at ? [described.looked_at, described.looked_at] : [], { width: camera.width, height: camera.height }, described.up);
  byId('camera').value = String(n);
  ++moved;
  arrange();
  keepAddress();
}

const whole = n => Math.round(n).toLocaleString('en');

function clockText(seconds) {
  const s = Math.round(seconds);
  return s < 60 ? `${s} s` : s < 3600 ? `${Math.floor(s / 60)} min ${s % 60} s` : `${Math.floor(s / 3600)} h ${Math.floor(s / 60) % 60} min`;
}

function show() {
  const { iteration = 0, first = 0, last = 0, gaussians, seconds = 0, scores, machine_ms: machine, losses } = run;
  const rate = (iteration - first) / seconds, latest = losses.slice(-100);
  const psnr = run.psnr8_db ?? scores.at(-1)?.[1];
  const rows = [
    ['iteration', last ? `${whole(iteration)} of ${whole(last)}` : ''], ['loss, mean of the last 100', latest.length ? (latest.reduce((s, v) => s + v, 0) / latest.length).toFixed(5) : ''],
    ['Gaussians', gaussians === undefined ? '' : whole(gaussians)],
    ['PSNR of held-out views', psnr === undefined ? '' : `${psnr.toFixed(2)} dB${run.psnr8_db === undefined ? `, after ${whole(scores.at(-1)[0])}` : ''}`],
    ['time on the machine', machine.length ? `${(machine.reduce((s, [, ms]) => s + ms, 0) / machine.length).toFixed(2)} ms an iteration` : ''],
    ['time of the simulation', seconds ? `${clockText(seconds)}, ${rate.toFixed(2)} iterations a second` : ''],
    ['left', seconds && rate > 0 && !run.ended ? clockText((last - iteration) / rate) : '']
  ].filter(([, text]) => text);
  byId('facts').tBodies[0].replaceChildren(...rows.map(([name, text]) => element('tr', {}, element('th', { scope: 'row' }, name), element('td', {}, text))));
  byId('progress').value = last ? iteration / last : 0;
  byId('pause').textContent = run.paused ? 'continue' : 'pause';
  for (const id of ['pause', 'stop']) byId(id).disabled = run.ended || run.stopped;
  status(run.ended ? 'the run has ended' : run.stopped ? 'stops …' : run.paused ? 'paused' : iteration ? 'trains' : 'begins …');
  drawCurves([{ name: described.name, ...run }]);
  document.documentElement.dataset.iteration = String(iteration);
}

async function look() {
  const news = await tell('state', { since: run.losses.length });
  const losses = [...run.losses.slice(0, news.since), ...news.losses];
  const isOther = losses.length !== run.losses.length || news.paused !== run.paused || news.ended !== run.ended || news.stopped !== run.stopped || run.paused === undefined;
  run = { ...news, losses };
  if (isOther) show();
}

async function draw() {
  const begun = moved, { position, rotation } = eye.camera();
  const { facts, image } = await readFrame({ view: chosen, position, rotation }, undefined, 'picture');
  canvas.width = image.width;
  canvas.height = image.height;
  canvas.getContext('2d').putImageData(image, 0, 0);
  byId('about').textContent = `${described.cameras[chosen].name}${byId('camera').value === '' ? ', moved' : ''}, after iteration ${whole(facts.iteration)}`;
  drawnAfter = facts.iteration;
  drawn = begun;
}

async function keepDrawn() {
  for (let last = -Infinity; !run.ended; await wait(30)) {
    const isNew = drawn !== moved || drawnAfter !== run.iteration && byId('follow').checked && performance.now() - last > REDRAWS;
    if (!isNew) continue;
    try {
      await draw();
    } catch (failure) {
      if (!run.ended) await wait(LOOKS);
    }
    last = performance.now();
  }
}

async function keepLooking() {
  for (; !run.ended; await wait(LOOKS))
    try {
      await look();
      problem(null);
    } catch (failure) {
      if (failure.lost && run.stopped) status('the run has stopped, and its checkpoint is kept');
      else problem(failure);
      if (failure.lost) return;
    }
}

function stepped() {
  ++moved;
  byId('camera').value = '';
  keepAddress();
}

async function control(what) {
  try {
    await tell('control', { do: what });
    await look();
  } catch (failure) {
    problem(failure);
  }
}

try {
  described = await read('training');
  announce();
  byId('name').textContent = document.title = described.name;
  byId('camera').replaceChildren(...described.cameras.map((c, n) => element('option', { value: n }, c.held_out ? `${c.name} (held out)` : c.name)),
    element('option', { value: '', disabled: '' }, 'free'));
  const { state } = readAddress();
  choose(Math.max(0, described.cameras.findIndex(c => c.name === state.camera)));
  if (state.eye) {
    eye.restore(state.eye.split(',').map(Number));
    stepped();
  }
  const hands = { eye: () => eye, orbits: () => true, moved: stepped, key: name => name === 'r' && (choose(chosen), true) };
  takeKeys(hands);
  takePointer(canvas, hands);
  byId('camera').addEventListener('change', () => choose(Number(byId('camera').value)));
  byId('pause').addEventListener('click', () => control(run.paused ? 'continue' : 'pause'));
  byId('stop').addEventListener('click', () => control('stop'));
  byId('save').addEventListener('click', () => savePng(canvas, fileName(described.name, described.cameras[chosen].name, String(drawnAfter))));
  window.addEventListener('resize', arrange);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', show);
  keepLooking();
  keepDrawn();
} catch (failure) {
  problem(failure);
  status('');
}
