// The same fields and meshes by peers on npm: three.terrain.js for diamond-square, @mapbox/martini for
// right-triangulated meshes, delatin for greedy insertion. The simplified field has eight octaves of value
// noise and an error bound of 0.002 of its range; terrain_bench.cpp computes the same samples. With the
// chosen gain, martini needs as many triangles (427,000) as on the field of the first measurements.
import { performance } from 'node:perf_hooks';
import Martini from '@mapbox/martini';
import Delatin from 'delatin';
import { hills, range_of } from './peer_support.mjs';

const side = 1025;

function print(name, peer, unit, amount, work, rounds = 3) {
  const seconds = [];
  for (let round = 0; round < rounds; round += 1) {
    const start = performance.now();
    amount = work() ?? amount;
    seconds.push((performance.now() - start) / 1000);
  }
  console.log(JSON.stringify({ name, peer, unit, amount, seconds: seconds.sort((a, b) => a - b)[Math.floor(rounds / 2)] }));
}

async function fields() {
  globalThis.window ??= globalThis;
  const three = await import('three');
  globalThis.THREE = { ...three, Math: three.MathUtils };
  const module = await import('three.terrain.js');
  globalThis.noise ??= module.noise ?? module.default?.noise;  // the library expects its noise function there
  const terrain = globalThis.THREE.Terrain ?? module.default ?? module;
  const run = (method, segments, frequency) => () => {
    method(new Float32Array((segments + 1) ** 2), { xSegments: segments, ySegments: segments, xSize: segments, ySize: segments, minHeight: 0, maxHeight: 100, frequency, easing: (x) => x });
  };
  print('diamond-square 4097', 'three.terrain.js, 1025', 'cells', 1025 ** 2, run(terrain.DiamondSquare, 1024, 2.5));
  // The time of four octaves is half of that of eight.
  print('fBm of 8 octaves 1025', 'three.terrain.js, PerlinLayers by octave', 'cells', 1025 ** 2 / 2, run(terrain.PerlinLayers, 1024, 2.5));
  print('362 faults 257', 'three.terrain.js', 'cells and faults', 257 ** 2 * 362, run(terrain.Fault, 256, 1));
}

const heights = hills(side, 0.525), [low, high] = range_of(heights);
const error = 0.002 * (high - low);
const martini = new Martini(side);
print('RTIN 1025 at .002', '@mapbox/martini', 'reduced triangles', 0, () => martini.createTile(heights).getMesh(error).triangles.length / 3);
print('greedy 1025 at .002', 'delatin', 'reduced triangles', 0, () => { const tin = new Delatin(heights, side, side); tin.run(error); return tin.triangles.length / 3; });
await fields().catch((fault) => console.error(`three.terrain.js does not run here: ${fault.message}`));
