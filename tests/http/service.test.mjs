// The contract of descriptions, status routes and pages, tested with the real program.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { koch, plant, random, is_problem } from './contract.mjs';
import { ask, events_of, program, serve } from './support.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

test('the vocabulary has the ranges and values of the attributes of every blueprint', async () => {
  const folder = new URL('../../core/generators/building/blueprints/', import.meta.url);
  const files = fs.readdirSync(folder).filter((name) => name.endsWith('.cga')).sort();
  const rows = (await server.get('/v1/vocabulary')).json.building_blueprints;
  assert.deepEqual(rows.map((row) => `${row.name}.cga`), files);
  for (const { name, attributes } of rows) {
    // The annotations, read from the text of the rules by a pattern.
    const rules = fs.readFileSync(new URL(`${name}.cga`, folder), 'utf8');
    const ranges = [...rules.matchAll(/@Range\(\s*([-0-9.]+)\s*,\s*([-0-9.]+)[^)]*\)\s*attr\s+(\w+)/g)].map((m) => [m[3], Number(m[1]), Number(m[2])]);
    const values = [...rules.matchAll(/@Enum\(([^)]*)\)\s*attr\s+(\w+)/g)].map((m) => [m[2], JSON.parse(`[${m[1]}]`)]);
    assert.ok(ranges.length > 2, name);
    assert.deepEqual(attributes.filter((a) => 'minimum' in a).map((a) => [a.name, a.minimum, a.maximum]).sort(), ranges.sort(), name);
    assert.deepEqual(attributes.filter((a) => 'values' in a).map((a) => [a.name, a.values]).sort(), values.sort(), name);
  }
});

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

test('every path of the OpenAPI document is served, and no response has an undocumented status', async () => {
  const api = (await server.get('/openapi.json')).json;
  const { presets } = (await server.get('/v1/presets')).json;
  const preset = presets[0].name, world = `${presets.find(({ generator }) => generator === 'world').name}.7`;
  const token = /models\/([^.]+)/.exec((await server.generate(plant)).headers['content-location'])[1];
  const texture = `${(await server.get('/version')).json.engine}.oak_bark.17.64.color.png`;
  const values = { token, extension: 'glb', ext: 'glb', world, x: '0', y: '0', file: 'none.bin' };
  for (const [pattern, item] of Object.entries(api.paths)) {
    const name = pattern.includes('schemas') ? 'lsystem' : pattern.includes('textures') ? texture : preset;
    const level = { e: 4, s: 5 }[pattern.split('/')[4]] ?? 0, query = pattern.endsWith('/world.json') ? '?box=0,0,64,64' : '';
    const target = pattern.replace(/\{(\w+)\}/g, (_, key) => (key === 'level' ? level : values[key] ?? name)) + query;
    const method = item.post ? 'POST' : 'GET';
    const answer = pattern === '/v1/import' ? await server.post('/v1/import?format=fractint', koch, { 'content-type': 'text/plain' }) : method === 'POST' ? await server.post(target, pattern === '/mcp' ? { jsonrpc: '2.0', id: 1, method: 'tools/list' } : plant) : await server.get(target);
    const described = item[method.toLowerCase()].responses;
    // No tile of this world names a shared file of this name.
    if (pattern.endsWith('/a/{file}')) { assert.equal(answer.status, 404); assert.ok(described['404']); continue; }
    assert.equal(answer.status, 200, `${method} ${target}: ${answer.text.slice(0, 200)}`);
    assert.ok(described['200'], pattern);
  }
});

test('the docs page is self-contained and lists every route and problem type', async () => {
  const page = await server.get('/docs');
  assert.match(page.type, /^text\/html/);
  assert.doesNotMatch(page.text, /<script|https?:\/\/[^"]*\.(js|css)|src=/);
  for (const text of ['/v1/generate', '/v1/models/', '/v1/derive', 'iterations', 'id="invalid-request"', 'id="limit-exceeded"']) assert.ok(page.text.includes(text), text);
  assert.ok(page.headers['content-security-policy']);
});

test('the start page is served with a policy that forbids foreign scripts', async () => {
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

test('health, readiness, version and metrics respond', async () => {
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

test('an unknown path or schema names the nearest one', async () => {
  const detail = async (target) => {
    const answer = await server.get(target);
    is_problem(answer, 404, 'not-found');
    return answer.json.detail;
  };
  for (const [target, meant] of [['/v1/preset/oak.glb', 'GET /v1/presets/{name}'], ['/presets', 'GET /v1/presets'], ['/v1/schemas', 'GET /v1/schemas/{name}'], ['/v1/docs', 'GET /docs'], ['/v1/vocabulary/tree', 'GET /v1/vocabulary']])
    assert.ok((await detail(target)).includes(`did you mean ${meant}?`), `${target}: ${await detail(target)}`);
  for (const target of ['/v1/', '/wp-login.php', '/x']) assert.doesNotMatch(await detail(target), /did you mean/);
  assert.match(await detail('/v1/schemas/trees'), /"tree"/);
});

test('unknown paths return 404, and known ones with another method return 405 with Allow', async () => {
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

test('a body of GET or HEAD, which would have no effect, is refused', async () => {
  for (const target of ['/v1/presets/oak.glb', '/v1/presets', '/v1/schemas/tree', '/v1/models/AAAA.glb', '/version', '/docs']) {
    const answer = await ask(server, 'GET', target, { body: { seed: 3 } });
    is_problem(answer, 400, 'malformed-request');
    assert.match(answer.json.errors[0].message, /^found a body of 10 bytes, expected none for GET/);
    assert.equal((await ask(server, 'HEAD', target, { body: { seed: 3 } })).status, 400);
    const plain = await ask(server, 'GET', target, { body: '' });
    assert.ok(plain.status === 200 || target === '/v1/models/AAAA.glb', target);
  }
});

test('an event stream ends with a permalink to the cached model', async () => {
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

test('the number of threads does not change the bytes', async () => {
  const wanted = await server.generate(random(5));
  for (const threads of ['1', '8']) {
    const other = await serve(program, ['--threads', threads]);
    const answer = await other.generate(random(5));
    await other.stop();
    assert.equal(answer.headers.etag, wanted.headers.etag);
    assert.deepEqual(answer.bytes, wanted.bytes);
  }
});
