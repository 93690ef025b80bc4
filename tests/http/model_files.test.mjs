// What every preset's file holds: equal images are stored once, also in scenes, and every surface has texture coordinates.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { after, before, test } from 'node:test';
import { program, serve } from './support.mjs';

let server, presets;
before(async () => {
  server = await serve(program);
  presets = (await server.get('/v1/presets')).json.presets.filter((preset) => preset.generator !== 'world');
});
after(async () => { await server.stop(); });

/** The document and the binary part of a GLB. */
function parts_of(bytes) {
  const size = bytes.readUInt32LE(12);
  return { document: JSON.parse(bytes.subarray(20, 20 + size).toString()), binary: bytes.subarray(28 + size) };
}

/** The hash of each image's file. */
function images_of({ document, binary }) {
  return (document.images ?? []).map((image) => {
    const view = document.bufferViews[image.bufferView];
    const begin = view.byteOffset ?? 0;
    return createHash('sha256').update(binary.subarray(begin, begin + view.byteLength)).digest('hex');
  });
}

// Profiles for engines: web and tiles leave coordinates out where no texture needs them.
test('equal images are stored once, and all surfaces have texture coordinates, in every preset', { timeout: 900_000 }, async () => {
  const doubled = [], bare = [];
  let images = 0, surfaces = 0, scenes_with_images = 0;
  for (const { name, generator } of presets) {
    const answer = await server.get(`/v1/presets/${name}.glb?output.textures=64`);
    if (answer.status === 422) continue;  // formats without meshes
    assert.equal(answer.status, 200, name);
    const parts = parts_of(answer.bytes), hashes = images_of(parts);
    images += hashes.length;
    if (generator === 'scene' && hashes.length) scenes_with_images += 1;
    if (new Set(hashes).size !== hashes.length) doubled.push(name);
    for (const { primitives } of parts.document.meshes ?? []) {
      for (const { mode = 4, attributes } of primitives) {
        if (mode !== 4) continue;
        surfaces += 1;
        if (attributes.TEXCOORD_0 === undefined) bare.push(name);
      }
    }
  }
  assert.ok(images > 300 && surfaces > 500 && scenes_with_images > 3, `${images} images, ${surfaces} surfaces, ${scenes_with_images} scenes`);
  assert.deepEqual(doubled, []);
  assert.deepEqual([...new Set(bare)], []);
});
