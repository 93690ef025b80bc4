// Models that name their generated textures by URL, and the route that answers with these textures.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { validateBytes } from 'gltf-validator';
import sharp from 'sharp';
import { is_problem } from './contract.mjs';
import { program, serve } from './support.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

const oak = (textures) => ({ preset: 'oak', output: { format: 'gltf', textures } });

test('a model with links holds no image, and each link has the bytes that the model would hold', async () => {
  const linked = JSON.parse((await server.generate(oak('links'))).bytes);
  const embedded = JSON.parse((await server.generate(oak(512))).bytes);
  assert.equal(linked.images.length, embedded.images.length);
  assert.ok(linked.images.length >= 5);
  for (const [i, image] of linked.images.entries()) {
    assert.equal(image.bufferView, undefined);
    const answer = await server.get(image.uri);
    assert.equal(answer.status, 200);
    assert.equal(answer.type, 'image/png');
    assert.match(answer.headers['cache-control'], /immutable/);
    const view = embedded.bufferViews[embedded.images[i].bufferView];
    const buffer = Buffer.from(embedded.buffers[view.buffer].uri.split(',')[1], 'base64');
    assert.deepEqual(answer.bytes, buffer.subarray(view.byteOffset ?? 0, (view.byteOffset ?? 0) + view.byteLength));
    const again = await server.get(image.uri, { 'If-None-Match': answer.headers.etag });
    assert.equal(again.status, 304);
  }
});

test('a texture of another engine is redirected to that of this one', async () => {
  const { engine } = (await server.get('/version')).json;
  const answer = await server.get('/v1/textures/1-abc.oak_bark.17.64.color.png');
  assert.equal(answer.status, 307);
  assert.equal(answer.headers.location, `/v1/textures/${engine}.oak_bark.17.64.color.png`);
  assert.equal((await server.get(answer.headers.location)).status, 200);
});

test('names of no texture are not found', async () => {
  const { engine } = (await server.get('/version')).json;
  for (const name of ['x', `${engine}.png`, `${engine}.oak.17.64.color.png`, `${engine}.oak_bark.17.99999.color.png`, `${engine}.oak_bark.17.64.color.jpg`]) {
    is_problem(await server.get(`/v1/textures/${name}`), 404);
  }
});

test('links are refused in files that stand alone, and beside impostors', async () => {
  const zip = await server.generate({ preset: 'oak', output: { format: 'zip', textures: 'links' } });
  is_problem(zip, 422);
  assert.equal(zip.json.errors[0].pointer, '/output/textures');
  const impostor = await server.generate({ preset: 'oak', output: { profile: 'web', impostor: true, textures: 'links' } });
  is_problem(impostor, 422);
  assert.equal(impostor.json.errors[0].pointer, '/output/textures');
});

test('images as WebP are far smaller, and hold the same pictures', async () => {
  const images = async (image_format) => {
    const file = JSON.parse((await server.generate({ preset: 'oak', output: { format: 'gltf', image_format } })).bytes);
    const buffer = Buffer.from(file.buffers[0].uri.split(',')[1], 'base64');
    return file.images.map(({ bufferView, mimeType }) => {
      const { byteOffset = 0, byteLength } = file.bufferViews[bufferView];
      return { mimeType, bytes: buffer.subarray(byteOffset, byteOffset + byteLength) };
    });
  };
  const [before_it, after_it] = [await images('png'), await images('webp')];
  assert.equal(after_it.length, before_it.length);
  const [png, webp] = [before_it, after_it].map((files) => files.reduce((sum, { bytes }) => sum + bytes.length, 0));
  assert.ok(webp < 0.35 * png, `${webp} bytes of images instead of ${png}`);
  console.log(`oak: ${png} bytes of PNG, ${webp} of WebP`);
  for (const [i, { mimeType, bytes }] of after_it.entries()) {
    assert.equal(mimeType, 'image/webp');
    const [a, b] = await Promise.all([before_it[i].bytes, bytes].map((file) => sharp(file).ensureAlpha().raw().toBuffer()));
    assert.equal(a.length, b.length);
    let sum = 0;
    for (let k = 0; k < a.length; k += 1) {
      if (k % 4 === 3) assert.equal(a[k], b[k], 'alpha');
      sum += Math.abs(a[k] - b[k]);
    }
    // the fissures of bark are the finest detail
    assert.ok(sum / a.length < 8, `image ${i} differs by ${sum / a.length} on average`);
  }
});

test('the validator of Khronos accepts every form of images, bodies for Godot, and levels', async () => {
  for (const output of [{ image_format: 'webp' }, { image_format: 'both' }, { profile: 'web' }, { profile: 'web', impostor: true }, { profile: 'godot', collision: 'godot' }, { profile: 'unity', lods: [1, 0.2, 0.03] }]) {
    const model = await server.generate({ preset: 'bush', output: { textures: 64, ...output } });
    assert.equal(model.status, 200, model.text);
    const { issues } = await validateBytes(new Uint8Array(model.bytes), { maxIssues: 0 });
    assert.deepEqual([issues.numErrors, issues.numWarnings], [0, 0], JSON.stringify({ output, messages: issues.messages.slice(0, 3) }));
  }
});
