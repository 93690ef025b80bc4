// three.js over GLB files, as a viewer loads them: node three.mjs <folder>
// Each file name_web.glb and name_unity.glb has to show what name.glb shows: the same boxes of all that is drawn, copies
// included. MeshoptDecoder is the one plug-in that is needed; the loader knows the other extensions by itself.
import fs from 'node:fs';
import path from 'node:path';

globalThis.self = globalThis;
globalThis.ProgressEvent ??= class {};
const { Box3, Matrix4, TextureLoader } = await import('three');
const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');
const { MeshoptDecoder } = await import('three/addons/libs/meshopt_decoder.module.js');
TextureLoader.prototype.load = (_url, done) => done({ image: {}, dispose() {} }); // no pictures without a page
globalThis.createImageBitmap = async () => ({ close() {} });
await MeshoptDecoder.ready;

async function box_of(file) {
  const bytes = fs.readFileSync(file);
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
  const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
  const { scene } = await loader.parseAsync(buffer, '');
  scene.updateMatrixWorld(true);
  const all = new Box3();
  scene.traverse((object) => {
    if (!object.geometry) return;
    if (object.isSkinnedMesh) {
      object.skeleton.update();
      object.computeBoundingBox();
      all.union(object.boundingBox.clone().applyMatrix4(object.matrixWorld));
      return;
    }
    object.geometry.computeBoundingBox();
    for (let i = 0; i < (object.isInstancedMesh ? object.count : 1); i++) {
      const matrix = new Matrix4();
      if (object.isInstancedMesh) object.getMatrixAt(i, matrix);
      all.union(object.geometry.boundingBox.clone().applyMatrix4(matrix.premultiply(object.matrixWorld)));
    }
  });
  return [...all.min.toArray(), ...all.max.toArray()];
}

const folder = process.argv[2];
const files = fs.readdirSync(folder).filter((name) => /_(web|unity)\.glb$/.test(name));
let failed = files.length === 0;
for (const name of files) {
  const plain = await box_of(path.join(folder, name.replace(/_(web|unity)\.glb$/, '.glb')));
  const box = await box_of(path.join(folder, name));
  const size = Math.hypot(...[0, 1, 2].map((axis) => plain[axis + 3] - plain[axis]));
  const off = Math.max(...plain.map((value, i) => Math.abs(value - box[i])));
  if (off <= 1e-3 * size) continue;
  console.log(`${name}: shows ${box.map((v) => v.toFixed(4))}, not ${plain.map((v) => v.toFixed(4))}`);
  failed = true;
}
if (!failed) console.log(`${files.length} files as they are without extensions`);
process.exit(failed ? 1 : 0);
