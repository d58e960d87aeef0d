// A foreign removal: convex hulls of consecutive cutter poses taken from a block by the library manifold-3d.
// Usage: node manifold_cut.mjs FOLDER, where FOLDER/node_modules has manifold-3d; reads JSON on stdin
//   {"block": [lo, hi], "segments": [[points of the cutter at both ends], ...]}
// and writes {"vertices": [[x, y, z], ...], "triangles": [[a, b, c], ...]} to stdout.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const library = resolve(process.argv[2], 'node_modules/manifold-3d/manifold.js');
const wasm = await (await import(pathToFileURL(library))).default();
wasm.setup();
const { Manifold } = wasm;

const { block, segments } = JSON.parse(readFileSync(0, 'utf8'));
const [lo, hi] = block;
const BATCH = 16; // hulls united before they are taken off together
let stock = Manifold.cube([hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]]).translate(lo);
for (let i = 0; i < segments.length; i += BATCH) {
  const swept = segments.slice(i, i + BATCH).map((points) => Manifold.hull(points));
  const before = stock;
  stock = Manifold.difference([before, ...swept]);
  [before, ...swept].forEach((one) => one.delete());
}
const mesh = stock.getMesh();
const rows = (flat, width) =>
  Array.from({ length: flat.length / width }, (_, i) => Array.from(flat.slice(i * width, (i + 1) * width)));
const vertices = rows(mesh.vertProperties, mesh.numProp).map((row) => row.slice(0, 3));
process.stdout.write(JSON.stringify({ vertices, triangles: rows(mesh.triVerts, 3) }));
