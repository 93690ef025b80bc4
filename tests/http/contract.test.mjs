// What a reader of the contract expects of every route, status and header, asked of the real program.
import assert from 'node:assert/strict';
import zlib from 'node:zlib';
import { after, before, test } from 'node:test';
import { ask, events_of, program, serve } from './support.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

const plant = { generator: 'lsystem', seed: 3, parameters: { axiom: 'X', productions: ['X -> F[+X]F[-X]+X', 'F -> FF'], iterations: 4, angle: 20 } };
const random = (seed) => ({ ...plant, seed, parameters: { ...plant.parameters, productions: ['X -> F[+X]F[-X]+X : 0.5', 'X -> F[-X]F[+X]-X : 0.5', 'F -> FF'] } });
const word = (answer) => answer.json?.type?.split(/[#/]/).pop();

function is_problem(answer, status, kind) {
  assert.equal(answer.status, status, answer.text.slice(0, 300));
  assert.match(answer.type, /^application\/problem\+json/);
  assert.equal(answer.json.status, status);
  assert.ok(answer.json.title && answer.json.detail);
  assert.equal(answer.json.instance, answer.headers['x-request-id']);
  assert.equal(answer.headers['cache-control'], 'no-store');
  if (kind) assert.equal(word(answer), kind);
}

function is_glb(bytes) {
  assert.equal(bytes.subarray(0, 4).toString(), 'glTF');
  assert.equal(bytes.readUInt32LE(8), bytes.length);
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
}

/** A token as anybody can make one. */
const token_of = (object) => zlib.deflateRawSync(Buffer.from(JSON.stringify(object))).toString('base64url');
const opened = (link) => JSON.parse(zlib.inflateRawSync(Buffer.from(/models\/([^.]+)\./.exec(link)[1], 'base64url')).toString());

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

test('the same request gives the same bytes and tag however it is written', async () => {
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

test('formats have their types', async () => {
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

test('bodies that are no JSON are 400, bodies that say nonsense 422, with every fault', async () => {
  for (const body of ['', '{', 'nonsense', '{"generator":"lsystem","generator":"lsystem"}', Buffer.from([0x22, 0xff, 0x22]), '['.repeat(100000), '{"a":'.repeat(70) + '1' + '}'.repeat(70)]) {
    is_problem(await server.generate(body), 400, 'malformed-request');
  }
  const bad = await server.generate({ ...plant, seed: -1, sed: 1, parameters: { axiom: 'F', productions: ['F F', 'A(x) -> A(x+*2)'], iterations: -3 } });
  is_problem(bad, 422, 'invalid-request');
  const pointers = bad.json.errors.map((each) => each.pointer);
  for (const pointer of ['/seed', '/sed', '/parameters/iterations', '/parameters/productions/0', '/parameters/productions/1']) assert.ok(pointers.includes(pointer), `${pointer} in ${pointers}`);
  for (const each of bad.json.errors) {
    assert.ok(each.message);
    if (each.pointer.includes('productions')) assert.ok(each.line === 1 && each.column >= 1);
  }
  assert.equal((await server.generate({})).json.errors[0].pointer, '');
});

test('what would pass a limit is 422 and says which', async () => {
  const answer = await server.generate({ ...plant, parameters: { axiom: 'F', productions: ['F -> FFFFFFFFFF'], iterations: 30 } });
  is_problem(answer, 422, 'limit-exceeded');
  assert.match(answer.json.detail, /64000000|64,000,000|64 million|modules/i);
});

test('a wrong Content-Type is 415, an absent one is JSON', async () => {
  for (const type of ['text/plain', 'application/x-www-form-urlencoded', 'application/json; charset=iso-8859-1']) {
    const answer = await server.generate(plant, { 'content-type': type });
    is_problem(answer, 415, 'unsupported-media-type');
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

// --- permalinks ----------------------------------------------------------------------------------------------------

test('a permalink gives the same bytes for ever', async () => {
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

test('the token is raw deflate of canonical JSON with the engine', async () => {
  const request = opened((await server.generate(plant)).headers['content-location']);
  assert.equal(request.engine, (await server.get('/version')).json.engine);
  assert.deepEqual(Object.keys(request), Object.keys(request).sort());
  delete request.engine;
  assert.deepEqual(request, plant);
});

test('the extension wins over the format; .json gives the request', async () => {
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

test('a token of another engine leads to our own, uncached', async () => {
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

test('any token that decodes is taken, but only one that names the engine is immutable', async () => {
  const answer = await server.get(`/v1/models/${token_of({ seed: '3', ...plant, output: {} })}.glb`);
  assert.equal(answer.status, 200);
  assert.equal(answer.headers['cache-control'], 'no-cache');
  assert.equal(answer.headers.etag, (await server.generate(plant)).headers.etag);
});

test('bad tokens are 400, tokens with bad requests 422', async () => {
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

test('If-None-Match gives 304 before any work, on GET and HEAD, by list, weak, coded or star', async () => {
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

test('a 304 has the Content-Location of the 200', async () => {
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

test('gzip, br and zstd are sent where they are liked, with their own tags, and open to the same bytes', async () => {
  const link = (await server.generate(plant)).headers['content-location'];
  const plain = await server.get(link);
  const codings = { gzip: ['br;q=0.9, gzip', zlib.gunzipSync], br: ['gzip;q=0.9, br', zlib.brotliDecompressSync], zstd: ['zstd, gzip;q=0.5', zlib.zstdDecompressSync] };
  for (const [coding, [asked, unpack]] of Object.entries(codings)) {
    for (const target of [link, '/v1/schemas/lsystem', '/openapi.json', '/docs']) {
      const bare = await server.get(target), packed = await server.get(target, { 'accept-encoding': asked });
      assert.equal(bare.headers['content-encoding'], undefined);
      assert.equal(packed.headers['content-encoding'], coding, target);
      assert.match(packed.headers.vary, /Accept-Encoding/);
      assert.equal(packed.headers.etag, bare.headers.etag.replace(/"$/, `-${coding}"`));
      if (unpack) assert.deepEqual(unpack(packed.bytes), bare.bytes);  // Node knows zstd from 22.15 on
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

test('one range of a model can be had, several cannot, one beyond the end is 416', async () => {
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

// --- presets -------------------------------------------------------------------------------------------------------

test('presets are listed, and each is one whole request', async () => {
  const { presets, generators } = (await server.get('/v1/presets')).json;
  assert.ok(presets.length > 0);
  assert.deepEqual(new Set(generators.map(({ name }) => name)), new Set(presets.map(({ generator }) => generator)));
  for (const { name, title } of generators) assert.equal(title, (await server.get(`/v1/schemas/${name}`)).json.title);
  for (const preset of presets) {
    assert.match(preset.name, /^[a-z0-9_-]+$/);
    assert.ok(preset.generator && preset.title && typeof preset.description === 'string' && Array.isArray(preset.tags));
  }
  const one = await server.get(`/v1/presets/${presets[0].name}`);
  assert.equal(one.status, 200);
  assert.equal(one.json.generator, presets[0].generator);
  assert.deepEqual((await server.get(`/v1/presets/${presets[0].name}.json`)).json, one.json);
});

test('a preset is a model, changed by its query', async () => {
  const { name } = (await server.get('/v1/presets')).json.presets.find((preset) => preset.generator === 'lsystem');
  const request = (await server.get(`/v1/presets/${name}`)).json;
  const plain = await server.get(`/v1/presets/${name}.glb`);
  assert.equal(plain.status, 200, plain.text.slice(0, 300));
  is_glb(plain.bytes);
  assert.equal(plain.headers['cache-control'], 'no-cache');
  assert.equal(plain.headers.etag, (await server.generate(request)).headers.etag);
  assert.equal((await server.get(`/v1/presets/${name}.glb`, { 'if-none-match': plain.headers.etag })).status, 304);
  const changed = await server.get(`/v1/presets/${name}.glb?seed=99&iterations=1`);
  const written = await server.generate({ ...request, seed: 99, parameters: { ...request.parameters, iterations: 1 } });
  assert.equal(changed.status, 200);
  assert.equal(changed.headers.etag, written.headers.etag);
  assert.equal((await server.get(`/v1/presets/${name}.gltf?iterations=1`)).type, 'model/gltf+json');
  assert.equal((await server.get(`/v1/presets/${name}?seed=99`)).json.seed, 99);
});

test('a query that is no setting of the preset is 422 at its place', async () => {
  const { name } = (await server.get('/v1/presets')).json.presets[0];
  for (const [query, pointer] of [['sed=1', '/sed'], ['seed=-1', '/seed'], ['iterations=many', '/iterations'], ['output.colour=red', '/output.colour']]) {
    const answer = await server.get(`/v1/presets/${name}.glb?${query}`);
    is_problem(answer, 422, 'invalid-request');
    assert.ok(answer.json.errors.some((each) => each.pointer === pointer || each.pointer === pointer.replace('.', '/') || each.pointer === `/parameters${pointer}`), JSON.stringify(answer.json.errors));
  }
  is_problem(await server.get(`/v1/presets/${name}.glb?seed=%zz`), 400, 'malformed-request');
  is_problem(await server.get('/v1/presets/no-such-preset'), 404, 'not-found');
  is_problem(await server.get('/v1/presets/no-such-preset.glb'), 404, 'not-found');
  is_problem(await server.get(`/v1/presets/${name}.obj`), 404, 'not-found');
});

// --- import --------------------------------------------------------------------------------------------------------

const koch = 'Koch {\n  Angle 6\n  Axiom F--F--F\n  F=F+F--F+F\n}\n';
const import_file = (format, text, type = 'text/plain') => server.post(`/v1/import?format=${format}`, text, { 'content-type': type });

test('import answers a request that generates as it is', async () => {
  const answer = await import_file('fractint', koch);
  assert.equal(answer.status, 200, answer.text.slice(0, 300));
  assert.equal(answer.json.request.generator, 'lsystem');
  assert.ok(Array.isArray(answer.json.warnings));
  assert.equal((await server.generate(answer.json.request)).status, 200);
  assert.equal((await import_file('fractint', koch, null)).status, 200);
  const unnamed = await server.post('/v1/import', koch, { 'content-type': 'text/plain' });
  assert.equal(unnamed.json.format, 'fractint');
  assert.deepEqual(unnamed.json.request, answer.json.request);
});

test('import tells line and column of what it does not understand', async () => {
  const answer = await import_file('fractint', koch.replace('F=F+F', 'F=F@F'));
  is_problem(answer, 422, 'invalid-request');
  assert.deepEqual({ pointer: answer.json.errors[0].pointer, line: answer.json.errors[0].line, column: answer.json.errors[0].column }, { pointer: '', line: 4, column: 6 });
  const unknown = await import_file('fractin', koch);
  is_problem(unknown, 422, 'invalid-request');
  assert.equal(unknown.json.errors[0].pointer, '/format');
  is_problem(await server.post('/v1/import', 'dear all', { 'content-type': 'text/plain' }), 422, 'invalid-request');
  is_problem(await server.post('/v1/import?format=fractint&colour=red', koch, { 'content-type': 'text/plain' }), 422, 'invalid-request');
  is_problem(await server.post('/v1/import?format=%zz', koch, { 'content-type': 'text/plain' }), 400, 'malformed-request');
  is_problem(await import_file('fractint', koch, 'text/html'), 415);
  is_problem(await import_file('fractint', Buffer.from([0xff, 0xfe])), 400, 'malformed-request');
});

test('the extension of a preset goes with what its query asks of the output', async () => {
  const zip = await server.get('/v1/presets/house.zip?output.lods=2');
  assert.equal(zip.status, 200, zip.text?.slice(0, 300));
  assert.equal(zip.type, 'application/zip');
  const lods = await server.get('/v1/presets/house.glb?output.lods=2');
  is_problem(lods, 422, 'invalid-request');
  assert.equal(lods.json.errors[0].pointer, '/output.lods');
  const budget = await server.get('/v1/presets/house.glb?output.max_triangles=1');
  is_problem(budget, 422, 'limit-exceeded');
  assert.equal(budget.json.errors[0].pointer, '/output.max_triangles');
});

test('a query that nobody reads is refused, where a route has one and where it has none', async () => {
  for (const route of ['/v1/generate?foo=3', '/v1/validate?foo=3', '/v1/derive?foo=3']) {
    const answer = await server.post(route, plant);
    is_problem(answer, 422, 'invalid-request');
    assert.equal(answer.json.errors[0].pointer, '/foo');
  }
  for (const route of ['/v1/presets?foo=3', '/v1/presets/koch_island?foo=3', '/v1/schemas/lsystem?foo=3', '/v1/vocabulary?foo=3', '/openapi.json?foo=3'])
    is_problem(await server.get(route), 422, 'invalid-request');
  is_problem(await server.get('/v1/vocabulary?%zz'), 400, 'malformed-request');
  for (const route of ['/healthz?probe=1', '/metrics?x=1', '/?preset=fern', '/v1/vocabulary?']) assert.equal((await server.get(route)).status, 200, route);
});

// --- validate, derive ----------------------------------------------------------------------------------------------

test('validate estimates without making anything, and lists every fault', async () => {
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

test('derive gives the word before geometry', async () => {
  const answer = await server.post('/v1/derive', { generator: 'lsystem', parameters: { axiom: 'A', productions: ['A -> AB', 'B -> A'], iterations: 5 } });
  assert.equal(answer.status, 200, answer.text.slice(0, 300));
  assert.equal(answer.json.string, 'ABAABABAABAAB');
  assert.equal(answer.json.length, 13);
  assert.deepEqual(answer.json.counts, { A: 8, B: 5 });
  assert.ok(Array.isArray(answer.json.warnings));
  is_problem(await server.post('/v1/derive', { generator: 'nope' }), 422);
});

// --- descriptions, status, pages -----------------------------------------------------------------------------------

test('schemas, vocabulary and OpenAPI describe the service', async () => {
  const schema = await server.get('/v1/schemas/lsystem');
  assert.match(schema.type, /json/);
  assert.ok(schema.json.properties.axiom && schema.json.properties.productions);
  assert.ok((await server.get('/v1/schemas/request')).json.properties.generator);
  is_problem(await server.get('/v1/schemas/nothing'), 404);
  const vocabulary = await server.get('/v1/vocabulary');
  assert.equal(vocabulary.status, 200);
  assert.match(vocabulary.text, /"ran"/);
  const api = await server.get('/openapi.json');
  assert.match(api.json.openapi, /^3\.1/);
  for (const target of ['/v1/schemas/lsystem', '/v1/vocabulary', '/openapi.json', '/v1/presets', '/docs', '/']) {
    const first = await server.get(target);
    assert.ok(first.headers.etag && first.headers['cache-control'], target);
    assert.equal((await server.get(target, { 'if-none-match': first.headers.etag })).status, 304, target);
  }
});

test('every path of the OpenAPI document is served, and nothing answers with a status that it does not name', async () => {
  const api = (await server.get('/openapi.json')).json;
  const preset = (await server.get('/v1/presets')).json.presets[0].name;
  const token = /models\/([^.]+)/.exec((await server.generate(plant)).headers['content-location'])[1];
  const values = { token, extension: 'glb', ext: 'glb' };
  for (const [pattern, item] of Object.entries(api.paths)) {
    const name = pattern.includes('schemas') ? 'lsystem' : preset;
    const target = pattern.replace(/\{(\w+)\}/g, (_, key) => values[key] ?? name);
    const method = item.post ? 'POST' : 'GET';
    const answer = pattern === '/v1/import' ? await import_file('fractint', koch) : method === 'POST' ? await server.post(target, plant) : await server.get(target);
    assert.equal(answer.status, 200, `${method} ${target}: ${answer.text.slice(0, 200)}`);
    const described = item[method.toLowerCase()].responses;
    assert.ok(described['200'], pattern);
  }
});

test('the docs page stands alone and names every route and problem', async () => {
  const page = await server.get('/docs');
  assert.match(page.type, /^text\/html/);
  assert.doesNotMatch(page.text, /<script|https?:\/\/[^"]*\.(js|css)|src=/);
  for (const text of ['/v1/generate', '/v1/models/', '/v1/derive', 'iterations', 'id="invalid-request"', 'id="limit-exceeded"']) assert.ok(page.text.includes(text), text);
  assert.ok(page.headers['content-security-policy']);
});

test('the start page is served with a policy that allows no foreign script', async () => {
  const page = await server.get('/');
  assert.match(page.type, /^text\/html/);
  assert.match(page.headers['content-security-policy'], /default-src 'none'/);
  assert.doesNotMatch(page.headers['content-security-policy'], /unsafe/);
  assert.equal(page.headers['cache-control'], 'no-cache');
  for (const [, file] of page.text.matchAll(/(?:src|href)="(\/assets\/[^"]+)"/g)) {
    const asset = await server.get(file);
    assert.equal(asset.status, 200, file);
    assert.match(asset.headers['cache-control'], /immutable/, file);
  }
});

test('health, readiness, version and metrics answer', async () => {
  assert.equal((await server.get('/healthz')).status, 200);
  assert.equal((await server.get('/readyz')).status, 200);
  const version = (await server.get('/version')).json;
  assert.ok(version.version && version.engine);
  const metrics = await server.get('/metrics');
  assert.match(metrics.type, /^text\/plain; version=0\.0\.4/);
  for (const name of ['seedmesh_requests_total', 'seedmesh_request_duration_seconds_bucket', 'seedmesh_in_flight', 'seedmesh_queue_depth', 'seedmesh_workers_busy', 'seedmesh_cache_hits_total',
    'seedmesh_cache_misses_total', 'seedmesh_cache_bytes', 'seedmesh_rejected_total', 'seedmesh_build_info', 'process_resident_memory_bytes', 'process_cpu_seconds_total', 'process_open_fds', 'process_start_time_seconds']) {
    assert.match(metrics.text, new RegExp(`^${name}[ {]`, 'm'), name);
  }
  assert.ok((await server.metric('process_resident_memory_bytes')) > 1e6);
  assert.ok(Math.abs((await server.metric('process_start_time_seconds')) - Date.now() / 1000) < 3600);
});

test('unknown paths are 404, known ones with another method 405 with Allow', async () => {
  for (const target of ['/nothing', '/v1', '/v1/', '/v1/nowhere', '/v1/generate/', '/v1/models', '/v1/models/', '/v1/models/a/b.glb', '/v1/presets/', '/v1/import/x', '/healthz/x', '/index.htm', '//']) {
    is_problem(await server.get(target), 404, 'not-found');
  }
  for (const [method, target, allow] of [['GET', '/v1/generate', 'POST'], ['GET', '/v1/validate', 'POST'], ['GET', '/v1/derive', 'POST'], ['GET', '/v1/import', 'POST'], ['DELETE', '/v1/models/AAAA.glb', 'GET'],
    ['PUT', '/v1/presets/x', 'GET'], ['PATCH', '/', 'GET'], ['DELETE', '/healthz', 'GET'], ['BREW', '/v1/generate', 'POST']]) {
    const answer = await ask(server, method, target, { body: method === 'GET' || method === 'DELETE' || method === 'BREW' ? undefined : '' });
    is_problem(answer, 405, 'method-not-allowed');
    assert.match(answer.headers.allow, new RegExp(allow));
  }
});

test('an event stream ends with a permalink that answers from memory', async () => {
  const answer = await server.generate(random(4242), { accept: 'text/event-stream' });
  assert.equal(answer.status, 200);
  assert.match(answer.type, /^text\/event-stream/);
  const done = events_of(answer.text).at(-1);
  assert.equal(done.name, 'done');
  assert.ok(done.data.statistics.triangles > 0);
  const models = await server.metric('seedmesh_models_total');
  assert.equal((await server.get(done.data.permalink)).headers.etag, done.data.etag);
  assert.equal((await server.generate(random(4242))).headers.etag, done.data.etag);
  assert.equal(await server.metric('seedmesh_models_total'), models);
  is_problem(await server.generate({ ...plant, seed: -1 }, { accept: 'text/event-stream' }), 422, 'invalid-request');
});

test('any number of threads gives the same bytes', async () => {
  const wanted = await server.generate(random(5));
  for (const threads of ['1', '8']) {
    const other = await serve(program, ['--threads', threads]);
    const answer = await other.generate(random(5));
    await other.stop();
    assert.equal(answer.headers.etag, wanted.headers.etag);
    assert.deepEqual(answer.bytes, wanted.bytes);
  }
});
