// A scene that is dropped on the page. A folder (SOG) is sent as the zip that .sog is.
import { byId } from './element.js';

const CRC = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let bit = 0; bit < 8; ++bit) n = n & 1 ? 0xedb88320 ^ n >>> 1 : n >>> 1;
  return n;
});
const crc32 = bytes => {
  let c = ~0;
  for (const b of bytes) c = CRC[(c ^ b) & 255] ^ c >>> 8;
  return ~c >>> 0;
};

// `files`: [name, Uint8Array]; stored, not compressed.
export function zip(files) {
  const parts = [], central = [];
  let at = 0, centralSize = 0;
  for (const [name, bytes] of files) {
    const text = new TextEncoder().encode(name), crc = crc32(bytes);
    // Version 2.0, names in UTF-8, method 0, 1980-01-01, then sums and sizes.
    const common = [20, 0, 0, 8, 0, 0, 0, 0, 0x21, 0];
    const sizes = new Uint8Array(12), view = new DataView(sizes.buffer);
    view.setUint32(0, crc, true);
    view.setUint32(4, bytes.length, true);
    view.setUint32(8, bytes.length, true);
    const local = [0x50, 0x4b, 3, 4, ...common, ...sizes, text.length & 255, text.length >> 8, 0, 0];
    const offset = [at & 255, at >> 8 & 255, at >> 16 & 255, at >>> 24];
    const entry = [0x50, 0x4b, 1, 2, 20, 0, ...common, ...sizes, text.length & 255, text.length >> 8,
      0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, ...offset];
    parts.push(Uint8Array.from(local), text, bytes);
    central.push(Uint8Array.from(entry), text);
    at += local.length + text.length + bytes.length;
    centralSize += entry.length + text.length;
  }
  const end = new DataView(new ArrayBuffer(22));
  end.setUint32(0, 0x06054b50, true);
  end.setUint16(8, files.length, true);
  end.setUint16(10, files.length, true);
  end.setUint32(12, centralSize, true);
  end.setUint32(16, at, true);
  return new Blob([...parts, ...central, end.buffer]);
}

const fileOf = entry => new Promise((done, failed) => entry.file(done, failed));
const listOf = reader => new Promise((done, failed) => reader.readEntries(done, failed));

async function filesIn(folder, prefix = '') {
  const all = [], reader = folder.createReader();
  for (let some = await listOf(reader); some.length; some = await listOf(reader))
    for (const entry of some)
      if (entry.isDirectory) all.push(...await filesIn(entry, `${prefix}${entry.name}/`));
      else all.push([prefix + entry.name, new Uint8Array(await (await fileOf(entry)).arrayBuffer())]);
  return all;
}

// `open(name, bytes)` gets what is dropped; `failed` is told of an error.
export function takeDrops(open, failed) {
  let depth = 0;
  const show = by => { depth = by; byId('drop').hidden = depth <= 0; };
  const holdsFiles = event => event.dataTransfer?.types.includes('Files');
  document.addEventListener('dragenter', event => { if (holdsFiles(event)) show(depth + 1); });
  document.addEventListener('dragleave', event => { if (holdsFiles(event)) show(depth - 1); });
  document.addEventListener('dragover', event => event.preventDefault());
  document.addEventListener('drop', async event => {
    event.preventDefault();
    show(0);
    const entry = event.dataTransfer.items[0]?.webkitGetAsEntry?.();
    const file = event.dataTransfer.files[0];
    try {
      if (entry?.isDirectory) await open(entry.name, zip(await filesIn(entry)));
      else if (file) await open(file.name, file);
    } catch (failure) {
      failed(failure);
    }
  });
}
