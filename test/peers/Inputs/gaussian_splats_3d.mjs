// gaussian_splats_3d.mjs MODULES read FILE OUT: the Gaussians of FILE as its reader has them, 14 floats each (x, y, z, three
// scales, w, x, y, z, red, green, blue and alpha of 255).
// gaussian_splats_3d.mjs MODULES write PLY LEVEL OUT: PLY as a .ksplat of a compression level.
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

globalThis.window = globalThis; // its timers
const [modules, what, file, ...rest] = process.argv.slice(2);
const folder = path.join(modules, '@mkkellogg', 'gaussian-splats-3d');
const library = createRequire(path.join(folder, 'package.json')).resolve('@mkkellogg/gaussian-splats-3d');
const {PlyParser, PlyLoader, SplatParser} = await import(pathToFileURL(library).href);
const bytes = fs.readFileSync(file);
const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
if (what === 'read') {
  const read = file.endsWith('.splat') ? SplatParser.parseStandardSplatToUncompressedSplatArray(buffer)
                                       : PlyParser.parseToUncompressedSplatArray(buffer, 0);
  fs.writeFileSync(rest[0], new Float32Array(read.splats.map((s) => s.slice(0, 14)).flat()));
} else {
  const written = await PlyLoader.loadFromFileData(buffer, 0, Number(rest[0]), true, 2);
  fs.writeFileSync(rest[1], new Uint8Array(written.bufferData));
}
