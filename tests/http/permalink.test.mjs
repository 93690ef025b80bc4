// The contract of permalinks, ETags, ranges and encodings, tested with the real program.
import assert from 'node:assert/strict';
import zlib from 'node:zlib';
import { after, before, test } from 'node:test';
import { plant, random, is_problem, token_of, opened } from './contract.mjs';
import { ask, program, serve } from './support.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

// --- permalinks ----------------------------------------------------------------------------------------------------

test('a permalink always returns the same bytes', async () => {
  const made = await server.generate(plant);
  const link = made.headers['content-location'];
  const linked = await server.get(link);
  assert.equal(linked.status, 200);
  assert.deepEqual(linked.bytes, made.bytes);
  assert.equal(linked.headers.etag, made.headers.etag);
  assert.match(linked.headers['cache-control'], /\bimmutable\b/);
  assert.match(linked.headers['cache-control'], /max-age=31536000/);
  assert.equal(linked.headers['content-location'], link);
});

test('the token is raw deflate of canonical JSON with the engine number', async () => {
  const request = opened((await server.generate(plant)).headers['content-location']);
  assert.equal(request.engine, (await server.get('/version')).json.engine);
  assert.deepEqual(Object.keys(request), Object.keys(request).sort());
  delete request.engine;
  assert.deepEqual(request, plant);
});

test('the extension overrides the format, and .json returns the request', async () => {
  const link = (await server.generate(plant)).headers['content-location'];
  const gltf = await server.get(link.replace('.glb', '.gltf'));
  assert.equal(gltf.type, 'model/gltf+json');
  assert.notEqual(gltf.headers.etag, (await server.get(link)).headers.etag);
  assert.equal((await server.get(link.replace('.glb', '.zip'))).type, 'application/zip');
  const request = await server.get(link.replace('.glb', '.json'));
  assert.match(request.type, /^application\/json/);
  assert.match(request.headers['cache-control'], /immutable/);
  assert.deepEqual(request.json, plant);
  is_problem(await server.get(link.replace('.glb', '.r16')), 422, 'invalid-request');
  is_problem(await server.get(link.replace('.glb', '.obj')), 404, 'not-found');
  is_problem(await server.get(link.replace('.glb', '')), 404, 'not-found');
});

test('a token of another engine redirects to the current engine without caching', async () => {
  const foreign = await server.get(`/v1/models/${token_of({ engine: 'another', ...plant })}.gltf`);
  assert.equal(foreign.status, 307);
  assert.equal(foreign.headers['cache-control'], 'no-store');
  assert.match(foreign.headers.location, /^\/v1\/models\/[A-Za-z0-9_-]+\.gltf$/);
  const own = await server.get(foreign.headers.location);
  assert.equal(own.status, 200);
  assert.equal(own.type, 'model/gltf+json');
  const last = await server.get(`/v1/models/${token_of({ ...plant, engine: 'another' })}.glb`);
  assert.equal(last.status, 307);
});

test('any decodable token is accepted, but only one with the engine number is immutable', async () => {
  const answer = await server.get(`/v1/models/${token_of({ seed: '3', ...plant, output: {} })}.glb`);
  assert.equal(answer.status, 200);
  assert.equal(answer.headers['cache-control'], 'no-cache');
  assert.equal(answer.headers.etag, (await server.generate(plant)).headers.etag);
});

test('invalid tokens return 400, and tokens of invalid requests return 422', async () => {
  for (const token of ['AAAA', '!', '%2b%2b', 'a=b', token_of([1]), token_of('x'), zlib.deflateRawSync('{').toString('base64url'), zlib.deflateSync('{}').toString('base64url'),
    `${token_of(plant)}A`, zlib.deflateRawSync('['.repeat(100000)).toString('base64url'), zlib.deflateRawSync(Buffer.alloc(5_000_000)).toString('base64url')]) {
    is_problem(await server.get(`/v1/models/${token}.glb`), 400, 'malformed-request');
  }
  is_problem(await server.get(`/v1/models/${token_of({ ...plant, sed: 1 })}.glb`), 422, 'invalid-request');
});

test('a long request has no Content-Location, but its URL works up to 8,000 characters', async () => {
  let state = 1;
  const noise = Array.from({ length: 3600 }, () => '+-F&^'[(state = (state * 48271) % 2147483647) % 5]).join('');
  const long = { generator: 'lsystem', parameters: { axiom: noise, iterations: 0 } };
  const answer = await server.generate(long);
  assert.equal(answer.status, 200, answer.text.slice(0, 300));
  if (answer.headers['content-location']) assert.ok(answer.headers['content-location'].length <= 2048);
  const target = `/v1/models/${token_of({ ...long, parameters: { ...long.parameters, axiom: noise.repeat(1) } })}.glb`;
  assert.ok(target.length < 8000);
  assert.equal((await server.get(target)).status, 200);
  is_problem(await server.get(`/v1/models/${'A'.repeat(8000)}.glb`), 414, 'uri-too-long');
});

// --- validators, ranges, encodings ---------------------------------------------------------------------------------

test('If-None-Match returns 304 before any generation, on GET and HEAD, for lists, weak tags, encoded tags and *', async () => {
  const link = `/v1/models/${token_of({ engine: (await server.get('/version')).json.engine, ...random(777) })}.glb`;
  const models = await server.metric('seedmesh_models_total');
  const star = await server.get(link, { 'if-none-match': '*' });
  assert.equal(star.status, 304);
  const tag = star.headers.etag;
  assert.match(star.headers['cache-control'], /immutable/);
  assert.match(star.headers.vary, /Accept-Encoding/);
  for (const match of [tag, `W/${tag}`, `"other", ${tag}`, tag.replace(/"$/, '-gzip"')]) {
    for (const method of ['GET', 'HEAD']) {
      const answer = await ask(server, method, link, { headers: { 'if-none-match': match } });
      assert.deepEqual([answer.status, answer.bytes.length, answer.headers['content-length'], answer.headers['content-type']], [304, 0, undefined, undefined]);
    }
  }
  assert.equal(await server.metric('seedmesh_models_total'), models);
  assert.equal((await server.get(link, { 'if-none-match': '"other"' })).status, 200);
});

test('a 304 has the same Content-Location as the 200', async () => {
  const link = (await server.generate(plant)).headers['content-location'];
  const heights = '/v1/presets/figure_5_5.r16?seed=3';
  for (const target of [link, link.replace('.glb', '.gltf'), '/v1/presets/koch_island.glb?seed=5', heights]) {
    const whole = await server.get(target);
    assert.equal(whole.status, 200, target);
    const kept = await server.get(target, { 'if-none-match': whole.headers.etag });
    assert.equal(kept.status, 304);
    assert.ok(kept.headers['content-location']);
    assert.equal(kept.headers['content-location'], whole.headers['content-location'], target);
  }
});

test('gzip, br and zstd are sent if accepted, with their own ETags, and decode to the same bytes', async () => {
  const link = (await server.generate(plant)).headers['content-location'];
  const plain = await server.get(link);
  const codings = { gzip: ['br;q=0.9, gzip', zlib.gunzipSync], br: ['gzip;q=0.9, br', zlib.brotliDecompressSync], zstd: ['zstd, gzip;q=0.5', zlib.zstdDecompressSync] };
  for (const [coding, [asked, unpack]] of Object.entries(codings)) {
    for (const target of [link, '/v1/schemas/lsystem', '/openapi.json', '/docs']) {
      const bare = await server.get(target), packed = await server.get(target, { 'accept-encoding': asked });
      assert.equal(bare.headers['content-encoding'], undefined);
      assert.equal(packed.headers['content-encoding'], coding, target);
      assert.match(packed.headers.vary, /Accept-Encoding/);
      assert.equal(packed.headers.etag, `W/${bare.headers.etag.replace(/"$/, `-${coding}"`)}`);
      if (unpack) assert.deepEqual(unpack(packed.bytes), bare.bytes);  // Node supports zstd from version 22.15
      else assert.equal(packed.bytes.readUInt32LE(0), 0xfd2fb528);
      assert.ok(packed.bytes.length < bare.bytes.length);
      assert.equal((await server.get(target, { 'if-none-match': packed.headers.etag })).status, 304);
    }
  }
  assert.equal((await server.get('/', { 'accept-encoding': 'gzip, br, zstd' })).headers['content-encoding'], 'br');
  for (const refused of ['gzip;q=0', 'identity', 'deflate', 'gzip;q=0, *;q=0.1']) {
    assert.equal((await server.get(link, { 'accept-encoding': refused })).headers['content-encoding'], undefined, refused);
  }
  is_problem(await server.get(link, { 'accept-encoding': 'identity;q=0' }), 406, 'not-acceptable');
  assert.equal(plain.headers['content-length'], String(plain.bytes.length));
});

test('a single range is served, several ranges are ignored, and one beyond the end returns 416', async () => {
  const link = (await server.generate(plant)).headers['content-location'];
  const whole = await server.get(link);
  const size = whole.bytes.length;
  const part = await server.get(link, { range: 'bytes=4-11' });
  assert.equal(part.status, 206);
  assert.deepEqual(part.bytes, whole.bytes.subarray(4, 12));
  assert.equal(part.headers['content-range'], `bytes 4-11/${size}`);
  assert.deepEqual((await server.get(link, { range: 'bytes=-10' })).bytes, whole.bytes.subarray(size - 10));
  assert.equal((await server.get(link, { range: 'bytes=4-', 'if-range': '"other"' })).status, 200);
  assert.equal((await server.get(link, { range: 'bytes=4-', 'if-range': whole.headers.etag })).status, 206);
  const many = await server.get(link, { range: `bytes=${'0-,'.repeat(500)}0-` });
  assert.deepEqual([many.status, many.bytes.length], [200, size]);
  const beyond = await server.get(link, { range: `bytes=${size}-` });
  is_problem(beyond, 416, 'range-not-satisfiable');
  assert.equal(beyond.headers['content-range'], `bytes */${size}`);
});
