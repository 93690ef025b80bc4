// Runs beside an installed package: SEEDMESH_URL names the server.
import assert from 'node:assert/strict';
import { createHmac } from 'node:crypto';
import http from 'node:http';
import { test } from 'node:test';
import { Busy, Client, Refused } from '@seedmesh/client';
import { load, plant as plant_scene, SeedmeshObject } from '@seedmesh/client/three';
import { Box3, Mesh, PerspectiveCamera, Sphere, Vector3 } from 'three';

const client = new Client(process.env.SEEDMESH_URL);
const plant = { generator: 'lsystem', seed: 3, parameters: { axiom: 'F', productions: ['F -> F[+F]F'], iterations: 3 } };

/** A server with these answers in order, the last one again and again. */
async function stub(answers, act) {
  const seen = [];
  const server = http.createServer((request, response) => {
    const [status, headers, body] = answers[Math.min(seen.length, answers.length - 1)];
    seen.push(request);
    request.resume().on('end', () => response.writeHead(status, headers).end(body));
  });
  await new Promise((resolve) => { server.listen(0, '127.0.0.1', resolve); });
  try { await act(`http://127.0.0.1:${server.address().port}`, seen); } finally { server.closeAllConnections(); server.close(); }
}
const busy = [429, { 'retry-after': '1', 'content-type': 'application/problem+json' }, '{"type":"queue-full","title":"Busy","status":429}'];
const made = [200, { 'content-type': 'model/gltf-binary', 'seedmesh-triangles': '12' }, 'glTF'];

test('a model has a picture of the wanted size', async () => {
  const data = new DataView(await client.picture(plant, { size: 64, view: 'front' }));
  assert.equal(data.getUint32(8), 0x57454250);  // WEBP
  assert.deepEqual([data.getUint16(26, true), data.getUint16(28, true)], [64, 64]);
  await assert.rejects(client.picture(plant, { view: 'inside' }), Refused);
});

test('a model, its permalink and the link of a preset have the same bytes', async () => {
  const model = await client.generate(plant);
  assert.equal(new DataView(model.data).getUint32(8, true), model.data.byteLength);
  const link = await fetch(await client.permalink(plant));
  assert.deepEqual(new Uint8Array(await link.arrayBuffer()), new Uint8Array(model.data));
  assert.equal(link.headers.get('etag'), model.etag);
  assert.equal(link.headers.get('content-location'), model.link);
  const preset = await fetch(client.preset_url('koch_island', { seed: 3, iterations: 2 }));
  const same = await client.generate({ preset: 'koch_island', seed: 3, parameters: { iterations: 2 } });
  assert.deepEqual(new Uint8Array(await preset.arrayBuffer()), new Uint8Array(same.data));
  assert.match(await client.permalink({ generator: 'terrain', output: { format: 'r16' } }), /\.r16$/);
  await assert.rejects(client.permalink({ generator: 'lsystem', parameters: { axiom: Array.from({ length: 9000 }, (_, i) => i).join('') } }), RangeError);
});

test('derive, validate, presets and engine answer', async () => {
  const fibonacci = await client.derive({ generator: 'lsystem', parameters: { axiom: 'A', productions: ['A -> AB', 'B -> A'], iterations: 5 } });
  assert.equal(fibonacci.string, 'ABAABABAABAAB');
  assert.deepEqual((await client.validate(plant)).warnings, []);
  assert.ok((await client.presets()).presets.some(({ name, generator }) => name === 'oak' && generator === 'tree'));
  assert.equal((await client.preset('oak')).generator, 'tree');
  assert.match(await client.engine(), /^\d+-[0-9a-f]{8}$/);
});

test('a refusal has every error with its pointer', async () => {
  const error = await client.generate({ generator: 'lsystem', parameters: { axiom: 'F[', iterations: -1 } }).catch((each) => each);
  assert.ok(error instanceof Refused);
  assert.equal(error.status, 422);
  assert.deepEqual(new Set(error.errors.map(({ pointer }) => pointer)), new Set(['/parameters/axiom', '/parameters/iterations']));
  assert.match(error.message, /^\/parameters\/axiom:1:2: /m);
});

test('progress events come before the model', async () => {
  const stages = [];
  const seed = Math.floor(Math.random() * 1e9);  // not cached yet
  const model = await client.generate({ preset: 'oak', seed }, { on_progress: ({ stage, share }) => { assert.ok(share >= 0 && share <= 1); stages.push(stage); } });
  assert.ok(stages.includes('mesh'), stages.join());
  assert.ok(model.triangles > 10_000);
  await assert.rejects(client.generate({ preset: 'nothing' }, { on_progress: () => {} }), Refused);
});

test('a busy server is asked again after the time that it names, as long as patience lasts', async () => {
  await stub([busy, made], async (url, seen) => {
    const begin = Date.now();
    assert.equal((await new Client(url).generate(plant)).triangles, 12);
    assert.ok(Date.now() - begin >= 990);
    assert.equal(seen.length, 2);
  });
  await stub([busy], async (url, seen) => {
    await assert.rejects(new Client(url, { patience: 0.5 }).generate(plant), Busy);
    assert.equal(seen.length, 1);
  });
  await stub([[502, {}, '<html>']], (url) => assert.rejects(new Client(url).generate(plant), /HTTP status 502/));
});

test('a signal ends a call, also while it waits', async () => {
  await stub([[429, { ...busy[1], 'retry-after': '30' }, busy[2]]], async (url) => {
    const begin = Date.now();
    await assert.rejects(new Client(url).generate(plant, { signal: AbortSignal.timeout(100) }), { name: 'TimeoutError' });
    assert.ok(Date.now() - begin < 5000);
  });
});

test('the key is sent, and a signature is that of node:crypto', async () => {
  await stub([made], async (url, seen) => {
    await new Client(`${url}/`, { key: 'secret' }).generate(plant);
    assert.equal(seen[0].headers.authorization, 'Bearer secret');
  });
  const covered = '/v1/presets/oak.glb?seed=3&expires=5&key=a';
  const expected = createHmac('sha256', 'secret').update(covered).digest('base64url');
  assert.equal(await client.sign(client.preset_url('oak', { seed: 3 }), 'a', new TextEncoder().encode('secret'), 5), `${client.url}${covered}&signature=${expected}`);
});

const bare = (request) => ({ ...request, output: { textures: 'none', ...request.output } });  // Node decodes no images

test('three.js: levels of detail replace each other by distance', async () => {
  const object = await load(client, bare({ preset: 'oak', seed: 3, output: { lods: 3, wind: 'weights' } }));
  assert.ok(object.has_wind);
  assert.equal(object.levels.length, 1, 'bark and leaves change together');
  const triangles_at = (distance) => {
    const camera = new PerspectiveCamera();
    camera.position.set(0, 0, distance);
    camera.updateMatrixWorld();
    object.scene.updateMatrixWorld(true);
    let count = 0;
    for (const level of object.levels) level.update(camera);
    object.scene.traverseVisible((each) => { if (each instanceof Mesh) count += each.geometry.index.count / 3; });
    return count;
  };
  // Levels begin where the model is half (a quarter) as high as the picture, and are left where it has grown by a tenth.
  const { radius } = new Box3().setFromObject(object.levels[0].levels[0].object).getBoundingSphere(new Sphere());
  for (const share of [0.5, 0.25]) {
    const begins = radius / (share * Math.tan((new PerspectiveCamera().fov * Math.PI) / 360));
    const finer = triangles_at(0.99 * begins), coarser = triangles_at(1.01 * begins);
    assert.ok(coarser < finer);
    assert.equal(triangles_at(begins / 1.09), coarser);
    assert.equal(triangles_at(begins / 1.11), finer);
  }
  const counts = [1, 70, 200].map(triangles_at);
  const finest = (await client.generate(bare({ preset: 'oak', seed: 3 }))).triangles;
  assert.equal(counts[0], finest);
  assert.ok(counts[0] > counts[1] && counts[1] > counts[2], counts.join());
});

test('three.js: growth begins small and ends at the full size', async () => {
  const object = await load(client, bare({ preset: 'growing_tree', output: { animation: 'growth' } }));
  const height = () => { object.scene.updateMatrixWorld(true); return new Box3().setFromObject(object.scene, true).getSize(new Vector3()).y; };
  const full = height();
  assert.ok(object.play_growth());
  const first = height();
  assert.ok(first < full / 10, `${first} of ${full}`);
  object.update(4);
  assert.ok(object.is_growing && height() > first);
  object.update(100);
  assert.ok(!object.is_growing);
  assert.ok(Math.abs(height() - full) < full / 100);
  assert.equal((await SeedmeshObject.parse((await client.generate(bare({ preset: 'koch_island' }))).data)).play_growth(), false);
  object.dispose();
});

test('three.js: copies of a scene stand where the service puts them', async () => {
  const request = bare({ preset: 'orchard', output: { profile: 'web', lods: 1 } });
  const { scene, models } = await plant_scene(client, request);
  const { placements, models: requests } = await client.derive(request);
  const boxes_of = (root) => {
    const boxes = {};
    root.updateMatrixWorld(true);
    root.traverse((each) => {
      if (!each.isInstancedMesh) return;
      each.computeBoundingBox();
      boxes[each.geometry.index.count] = (boxes[each.geometry.index.count] ?? new Box3()).union(each.boundingBox.clone().applyMatrix4(each.matrixWorld));
    });
    return boxes;
  };
  assert.deepEqual([...models.keys()].sort(), Object.keys(requests).sort());
  for (const [index, name] of Object.keys(requests).entries()) {
    for (const each of scene.children[index].children) assert.equal(each.count, placements.filter((place) => place.model === name).length, name);
  }
  const expected = boxes_of((await load(client, request)).scene), found = boxes_of(scene);
  const compared = Object.keys(expected).filter((triangles) => found[triangles]);
  assert.ok(compared.length >= 5, `${Object.keys(expected)} and ${Object.keys(found)}`);
  for (const triangles of compared) {
    for (const end of ['min', 'max']) assert.ok(expected[triangles][end].distanceTo(found[triangles][end]) < 0.05, `${triangles}: ${JSON.stringify([expected[triangles], found[triangles]])}`);
  }
});
