// Talks to the server. The token stands behind the # of the page's address, which browsers send to nobody.

const token = location.hash.slice(1);
// Of this page alone: its newer requests take the place of its older ones.
const page = crypto.randomUUID();

async function ask(path, options = {}) {
  let answer;
  try {
    answer = await fetch(path, { ...options, headers: { 'X-Splat-Token': token, 'X-Splat-Page': page, ...options.headers } });
  } catch (failure) {
    if (failure.name === 'AbortError') throw failure;
    throw new Error('splat view does not answer: it has ended, or the computer is busy');
  }
  if (answer.ok) return answer;
  const said = await answer.json().catch(() => ({ error: answer.status === 413 ? 'the file is too large' : `the server says ${answer.status}` }));
  const failure = new Error(said.error);
  failure.superseded = answer.status === 409;
  throw failure;
}

const post = (path, body, signal) =>
  ask(path, { method: 'POST', body: JSON.stringify(body), headers: { 'Content-Type': 'application/json' }, signal });

export const readScene = async () => (await ask('scene')).json();

const mebibytes = bytes => `${Math.ceil(bytes / 2 ** 20)} MiB`;

// `bytes`: a Blob. The server would end a larger upload in its midst, and browsers then show no answer.
export async function openScene(name, bytes, most) {
  if (bytes.size > most)
    throw new Error(`${name}: a file of ${mebibytes(bytes.size)} is too large, expected at most ${mebibytes(most)}`);
  return (await ask('scene?name=' + encodeURIComponent(name),
    { method: 'POST', body: bytes, headers: { 'Content-Type': 'application/octet-stream' } })).json();
}

export const readPixel = async request => (await post('pixel', request)).json();

// Facts, and the pixels as ImageData.
export async function readFrame(request, signal) {
  const bytes = await (await post('frame', request, signal)).arrayBuffer();
  const size = new DataView(bytes).getUint32(0, true);
  const facts = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, size)));
  const pixels = new Uint8ClampedArray(bytes, 4 + size);
  return { facts, image: new ImageData(pixels, facts.width, facts.height) };
}
