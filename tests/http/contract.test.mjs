// What a reader of the contract expects of generate, validate and derive, asked of the real program.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import Ajv from 'ajv/dist/2020.js';
import { plant, random, word, is_problem, is_glb, opened } from './contract.mjs';
import { program, serve } from './support.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

// --- POST /v1/generate ---------------------------------------------------------------------------------------------

test('generate answers a GLB with every header of a model', async () => {
  const answer = await server.generate(plant);
  assert.equal(answer.status, 200, answer.text.slice(0, 500));
  assert.equal(answer.type, 'model/gltf-binary');
  const gltf = is_glb(answer.bytes);
  assert.match(answer.headers.etag, /^"[0-9a-f]{32}"$/);
  assert.equal(answer.headers['cache-control'], 'no-cache');
  assert.match(answer.headers.vary, /Accept-Encoding/);
  assert.match(answer.headers.vary, /Accept,/);
  for (const span of ['parse', 'derive', 'mesh', 'encode']) assert.match(answer.headers['server-timing'], new RegExp(`${span};dur=[0-9.]+`));
  assert.ok(answer.headers['x-request-id']);
  assert.match(answer.headers['content-location'], /^\/v1\/models\/[A-Za-z0-9_-]+\.glb$/);
  assert.equal(answer.headers['seedmesh-warnings'], '0');
  const triangles = gltf.meshes.flatMap((mesh) => mesh.primitives).reduce((sum, each) => sum + gltf.accessors[each.indices].count / 3, 0);
  const vertices = gltf.meshes.flatMap((mesh) => mesh.primitives).reduce((sum, each) => sum + gltf.accessors[each.attributes.POSITION].count, 0);
  assert.equal(Number(answer.headers['seedmesh-triangles']), triangles);
  assert.equal(Number(answer.headers['seedmesh-vertices']), vertices);
});

test('the same request in any notation gives the same bytes and ETag', async () => {
  const first = await server.generate(plant);
  const second = await server.generate('{"parameters":{"angle":2e1,"iterations":4.0,"productions":["X -> F[+X]F[-X]+X","F -> FF"],"axiom":"X"},"output":{"format":"glb"},"seed":"3","generator":"lsystem"}');
  assert.equal(second.status, 200, second.text.slice(0, 300));
  assert.equal(second.headers.etag, first.headers.etag);
  assert.equal(second.headers['content-location'], first.headers['content-location']);
  assert.deepEqual(second.bytes, first.bytes);
});

test('another seed is another model', async () => {
  const [a, b] = [await server.generate(random(1)), await server.generate(random(2))];
  assert.notEqual(a.headers.etag, b.headers.etag);
  assert.notDeepEqual(a.bytes, b.bytes);
});

test('each format has its media type', async () => {
  const gltf = await server.generate({ ...plant, output: { format: 'gltf' } });
  assert.equal(gltf.type, 'model/gltf+json');
  assert.equal(gltf.json.asset.version, '2.0');
  assert.match(gltf.headers['content-location'], /\.gltf$/);
  const zip = await server.generate({ ...plant, output: { format: 'zip' } });
  assert.equal(zip.type, 'application/zip');
  assert.equal(zip.bytes.subarray(0, 2).toString(), 'PK');
  assert.match(zip.headers['content-location'], /\.zip$/);
});

test('Accept never chooses the format', async () => {
  const answer = await server.generate(plant, { accept: 'model/gltf+json, image/png' });
  assert.equal(answer.status, 200);
  assert.equal(answer.type, 'model/gltf-binary');
});

test('a preset is merged with the rest of the body', async () => {
  const name = (await server.get('/v1/presets')).json.presets[0].name;
  const whole = (await server.get(`/v1/presets/${name}`)).json;
  const merged = await server.generate({ preset: name, seed: 12345 });
  const written = await server.generate({ ...whole, seed: 12345 });
  assert.equal(merged.status, 200);
  assert.equal(merged.headers.etag, written.headers.etag);
});

test('a seed beyond 2^53 is exact as string and as number', async () => {
  const text = await server.generate({ ...random(0), seed: '18446744073709551615' });
  const number = await server.generate(JSON.stringify(random(0)).replace('"seed":0', '"seed":18446744073709551615'));
  assert.equal(text.status, 200);
  assert.equal(text.headers.etag, number.headers.etag);
  assert.equal(opened(text.headers['content-location']).seed, '18446744073709551615');
});

test('invalid JSON is answered 400, an invalid request 422 with every error', async () => {
  for (const body of ['', '{', 'nonsense', '{"generator":"lsystem","generator":"lsystem"}', Buffer.from([0x22, 0xff, 0x22]), '['.repeat(100000), '{"a":'.repeat(70) + '1' + '}'.repeat(70)]) {
    is_problem(await server.generate(body), 400, 'malformed-request');
  }
  const bad = await server.generate({ ...plant, seed: -1, sed: 1, parameters: { axiom: 'F', productions: ['F F', 'A(x) -> A(x+*2)'], iterations: -3 } });
  is_problem(bad, 422, 'invalid-request');
  const pointers = bad.json.errors.map((each) => each.pointer);
  for (const pointer of ['/seed', '/sed', '/parameters/iterations', '/parameters/productions/0', '/parameters/productions/1']) assert.ok(pointers.includes(pointer), `${pointer} in ${pointers}`);
  const code = (pointer) => bad.json.errors.find((each) => each.pointer === pointer)?.code;
  assert.equal(code('/seed'), 'out_of_range');
  assert.equal(code('/sed'), 'unknown_key');
  assert.equal(code('/parameters/iterations'), 'out_of_range');
  assert.equal(code('/parameters/productions/0'), 'syntax');
  for (const each of bad.json.errors) {
    assert.ok(each.message);
    if (each.pointer.includes('productions')) assert.ok(each.line === 1 && each.column >= 1);
  }
  assert.equal((await server.generate({})).json.errors[0].pointer, '');
});

test('an empty generator name is refused wherever a request stands inside another', async () => {
  const inner = { generator: '' };
  const requests = {
    '/parameters/terrain/generator': { generator: 'scene', parameters: { terrain: inner, layers: [] } },
    '/parameters/layers/0/model/generator': { generator: 'scene', parameters: { layers: [{ model: inner, place: { method: 'positions', positions: [{ at: [0, 0] }] } }] } },
    '/parameters/layers/0/place/positions/0/model/generator': { generator: 'scene', parameters: { layers: [{ model: { preset: 'koch_snowflake' }, place: { method: 'positions', positions: [{ at: [0, 0], model: inner }] } }] } },
    '/parameters/surfaces/A/model/generator': { generator: 'lsystem', parameters: { axiom: '~A', surfaces: { A: { model: inner } } } },
    '/generator': inner,
  };
  for (const [pointer, request] of Object.entries(requests)) {
    for (const path of ['/v1/generate', '/v1/derive', '/v1/validate']) {
      const answer = await server.post(path, request);
      is_problem(answer, 422);
      assert.ok(answer.json.errors.some((each) => each.pointer === pointer), `${path} ${pointer}: ${answer.text}`);
    }
  }
});

test('a request above a limit is 422 and names the limit', async () => {
  const answer = await server.generate({ ...plant, parameters: { axiom: 'F', productions: ['F -> FFFFFFFFFF'], iterations: 30 } });
  is_problem(answer, 422, 'limit-exceeded');
  assert.match(answer.json.detail, /64000000|64,000,000|64 million|modules/i);
  const [error] = answer.json.errors;
  assert.deepEqual([error.code, error.resource, error.limit, error.needed > error.limit], ['limit', 'modules', 64_000_000, true]);
});

test('a wrong Content-Type is 415, an absent one is JSON', async () => {
  for (const type of ['text/plain', 'application/x-www-form-urlencoded', 'application/json; charset=iso-8859-1']) {
    const answer = await server.generate(plant, { 'content-type': type });
    is_problem(answer, 415, 'unsupported-media-type');
    assert.match(answer.json.detail, /found the Content-Type ".+"; expected application\/json/);
    assert.equal(answer.headers.accept, 'application/json');
  }
  for (const type of ['application/json; charset=utf-8', 'application/vnd.any+json', null]) {
    assert.equal((await server.generate(plant, { 'content-type': type })).status, 200);
  }
});

test('If-None-Match does not make a POST conditional', async () => {
  const { etag } = (await server.generate(plant)).headers;
  assert.equal((await server.generate(plant, { 'if-none-match': etag })).status, 200);
});

// --- validate, derive ----------------------------------------------------------------------------------------------

test('validate estimates without generating, and lists every error', async () => {
  const models = await server.metric('seedmesh_models_total');
  const answer = await server.post('/v1/validate', plant);
  assert.equal(answer.status, 200, answer.text.slice(0, 300));
  assert.equal(answer.json.valid, true);
  assert.deepEqual(answer.json.warnings, []);
  assert.ok(answer.json.estimate.triangles > 0 && answer.json.estimate.bytes > 0);
  assert.equal(typeof answer.json.estimate.exact, 'boolean');
  assert.equal(await server.metric('seedmesh_models_total'), models);
  is_problem(await server.post('/v1/validate', { ...plant, seed: -1 }), 422, 'invalid-request');
  is_problem(await server.post('/v1/validate', '{'), 400, 'malformed-request');
  is_problem(await server.post('/v1/validate', plant, { 'content-type': 'text/plain' }), 415);
});

test('derive responds as OpenAPI describes for each generator', async () => {
  const { components } = (await server.get('/openapi.json')).json;
  const asked = {
    lsystem: plant.parameters, tree: { model: 'proctree' }, building: { blueprint: 'house' }, terrain: { iterations: 3 }, fractal: {},
    scene: { layers: [{ model: { generator: 'fractal', parameters: { iterations: 0 } }, place: { method: 'scatter', count: 3 } }] },
  };
  for (const [generator, parameters] of Object.entries(asked)) {
    const answer = await server.post('/v1/derive', { generator, parameters });
    assert.equal(answer.status, 200, answer.text.slice(0, 300));
    const check = new Ajv({ strict: false }).compile({ components, $ref: `#/components/schemas/${generator}_derivation` });
    assert.ok(check(answer.json), `${generator}: ${JSON.stringify(check.errors)}`);
    const known = Object.keys(components.schemas[`${generator}_derivation`].properties);
    assert.deepEqual(Object.keys(answer.json).filter((name) => !known.includes(name)), [], generator);
  }
  const sphere = await server.post('/v1/derive', { generator: 'terrain', parameters: { algorithm: 'poisson_faulting', shape: 'sphere', iterations: 5 } });
  assert.ok(new Ajv({ strict: false }).compile({ components, $ref: '#/components/schemas/terrain_derivation' })(sphere.json), sphere.text.slice(0, 300));
});

test('derive gives the word before geometry', async () => {
  const answer = await server.post('/v1/derive', { generator: 'lsystem', parameters: { axiom: 'A', productions: ['A -> AB', 'B -> A'], iterations: 5 } });
  assert.equal(answer.status, 200, answer.text.slice(0, 300));
  assert.equal(answer.json.string, 'ABAABABAABAAB');
  assert.equal(answer.json.length, 13);
  assert.deepEqual(answer.json.counts, { A: 8, B: 5 });
  assert.ok(Array.isArray(answer.json.warnings));
  is_problem(await server.post('/v1/derive', { generator: 'nope' }), 422);
});
