// Talks to the server.
import { readAddress } from './address.js';

export const { token } = readAddress();
// Of this page alone: its newer requests take the place of its older ones.
const page = crypto.randomUUID();

async function ask(path, options = {}) {
  let answer;
  try {
    answer = await fetch(path, { ...options, headers: { 'X-Splat-Token': token, 'X-Splat-Page': page, ...options.headers } });
  } catch (failure) {
    if (failure.name === 'AbortError') throw failure;
    const silence = new Error('splat does not answer: it has ended, or the computer is busy');
    silence.lost = true;
    throw silence;
  }
  if (answer.ok) return answer;
  const said = await answer.json().catch(() => ({ error: answer.status === 413 ? 'the file is too large' : `the server says ${answer.status}` }));
  const failure = new Error(said.error);
  failure.superseded = answer.status === 409;
  failure.lost = answer.status === 403;
  throw failure;
}

const post = (path, body, signal) =>
  ask(path, { method: 'POST', body: JSON.stringify(body), headers: { 'Content-Type': 'application/json' }, signal });

export const read = async path => (await ask(path)).json();
export const tell = async (path, body, signal) => (await post(path, body, signal)).json();
export const readBytes = async path => (await ask(path)).blob();

const mebibytes = bytes => `${Math.ceil(bytes / 2 ** 20)} MiB`;

// `bytes`: a Blob. The server would end a larger upload in its midst, and browsers then show no answer.
export async function openScene(name, bytes, most) {
  if (bytes.size > most)
    throw new Error(`${name}: a file of ${mebibytes(bytes.size)} is too large, expected at most ${mebibytes(most)}`);
  return (await ask('scene?name=' + encodeURIComponent(name),
    { method: 'POST', body: bytes, headers: { 'Content-Type': 'application/octet-stream' } })).json();
}

// Facts as JSON, and bytes.
async function parts(answer) {
  const bytes = await answer.arrayBuffer();
  const size = new DataView(bytes).getUint32(0, true);
  return { facts: JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, size))), bytes, at: 4 + size };
}

// Facts, and the pixels as ImageData.
export async function readFrame(request, signal, path = 'frame') {
  const { facts, bytes, at } = await parts(await post(path, request, signal));
  return { facts, image: new ImageData(new Uint8ClampedArray(bytes, at), facts.width, facts.height) };
}

// Facts, and pairs of numbers.
export async function readPlaces(request, signal) {
  const { facts, bytes, at } = await parts(await post('selection', request, signal));
  return { facts, places: new Float32Array(bytes.slice(at)) };
}
