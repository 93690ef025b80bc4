// The same scenes by a combination of npm packages: fast-2d-poisson-disk-sampling for positions, delatin for
// the terrain, ez-tree for the trees, and three.js with its GLTFExporter for the file, as nodes that share
// meshes and as InstancedMesh (EXT_mesh_gpu_instancing). 16 trees at 100,000 positions on 1025 x 1025
// samples, as in scene_bench.cpp; without textures and compression, which the packages do not support.
import { performance } from 'node:perf_hooks';
import Delatin from 'delatin';
import FastPoissonDiskSampling from 'fast-2d-poisson-disk-sampling';
import { hills, range_of, stand_in_for_browser } from './peer_support.mjs';

stand_in_for_browser();
const { Tree } = await import('@dgreenheck/ez-tree');
const three = await import('three');
const { GLTFExporter } = await import('three/examples/jsm/exporters/GLTFExporter.js');

const side = 1025, size = 2000, trees = 100_000, variants = 16;

/** Numbers from 0 to 1, the same each time (mulberry32). */
function numbers(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

function print(name, peer, unit, amount, seconds, bytes) {
  console.log(JSON.stringify({ name, peer, unit, amount, seconds, bytes }));
}

function poisson_disk() {
  const start = performance.now();
  const places = new FastPoissonDiskSampling({ shape: [1000, 1000], radius: 0.82, tries: 20 }, numbers(1)).fill();
  print('Poisson disk', 'fast-2d-poisson-disk-sampling', 'places', places.length, (performance.now() - start) / 1000);
}

/** Smooth hills, 206 m from the lowest to the highest sample. */
function heights() {
  const field = hills(side, 0.5), [low, high] = range_of(field);
  return field.map((height) => ((height - low) / (high - low)) * 206);
}

function ground(field) {
  const tin = new Delatin(field, side, side);
  tin.run(0.41);
  const cell = size / (side - 1), position = new Float32Array(tin.coords.length / 2 * 3);
  for (let i = 0; i < tin.coords.length / 2; i += 1) {
    const x = tin.coords[2 * i], z = tin.coords[2 * i + 1];
    position.set([x * cell - size / 2, field[z * side + x], z * cell - size / 2], 3 * i);
  }
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.BufferAttribute(position, 3));
  geometry.setIndex(new three.BufferAttribute(new Uint32Array(tin.triangles), 1));
  geometry.computeVertexNormals();
  return new three.Mesh(geometry, new three.MeshStandardMaterial());
}

/** [bark, leaves] of each variant, of about as many triangles as ours. */
function models() {
  return Array.from({ length: variants }, (_, seed) => {
    const tree = new Tree();
    tree.loadPreset('Ash Small');
    tree.options.seed = seed;
    tree.generate();
    const parts = [];
    tree.traverse((part) => { if (part.isMesh) parts.push([part.geometry, new three.MeshStandardMaterial()]); });
    return parts;
  });
}

/** A matrix for each tree, by variant. */
function places(field) {
  const random = numbers(7), all = Array.from({ length: variants }, () => []);
  const turn = new three.Quaternion(), up = new three.Vector3(0, 1, 0);
  for (let i = 0; i < trees; i += 1) {
    const x = random(), z = random(), scale = 0.7 + 0.6 * random();
    const height = field[Math.round(z * (side - 1)) * side + Math.round(x * (side - 1))];
    const at = new three.Vector3((x - 0.5) * size, height, (z - 0.5) * size);
    all[Math.floor(random() * variants)].push(new three.Matrix4().compose(at, turn.setFromAxisAngle(up, 6.2832 * random()), new three.Vector3(scale, scale, scale)));
  }
  return all;
}

function instanced(parts, matrices) {
  return parts.map(([geometry, material]) => {
    const mesh = new three.InstancedMesh(geometry, material, matrices.length);
    matrices.forEach((matrix, i) => mesh.setMatrixAt(i, matrix));
    return mesh;
  });
}

function nodes(parts, matrices) {
  return parts.flatMap(([geometry, material]) => matrices.map((matrix) => {
    const mesh = new three.Mesh(geometry, material);
    matrix.decompose(mesh.position, mesh.quaternion, mesh.scale);
    return mesh;
  }));
}

async function forest(name, write) {
  const start = performance.now();
  const scene = new three.Scene(), field = heights();
  scene.add(ground(field));
  const stands = places(field);
  models().forEach((parts, i) => scene.add(...write(parts, stands[i])));
  const file = await new GLTFExporter().parseAsync(scene, { binary: true });
  print(name, `three GLTFExporter, ez-tree, delatin (${(file.byteLength / 1e6).toFixed(1)} MB)`, 'trees', trees, (performance.now() - start) / 1000, file.byteLength);
}

poisson_disk();
await forest('100,000 trees on 1025 x 1025 for the web', instanced);
await forest('100,000 trees on 1025 x 1025 as nodes', nodes);
