// What a reader of the contract expects of presets and imports, asked of the real program.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { koch, plant, is_problem, is_glb } from './contract.mjs';
import { program, serve } from './support.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

// --- presets -------------------------------------------------------------------------------------------------------

test('presets are listed, and each is one complete request', async () => {
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

test('an unknown key of the query is 422 with its pointer', async () => {
  const { name } = (await server.get('/v1/presets')).json.presets[0];
  for (const [query, pointer] of [['sed=1', '/sed'], ['seed=-1', '/seed'], ['iterations=many', '/iterations'], ['output.colour=red', '/output.colour']]) {
    const answer = await server.get(`/v1/presets/${name}.glb?${query}`);
    is_problem(answer, 422, 'invalid-request');
    assert.ok(answer.json.errors.some((each) => each.pointer === pointer || each.pointer === pointer.replace('.', '/') || each.pointer === `/parameters${pointer}`), JSON.stringify(answer.json.errors));
  }
  is_problem(await server.get(`/v1/presets/${name}.glb?seed=%zz`), 400, 'malformed-request');
  is_problem(await server.get('/v1/presets/no-such-preset'), 404, 'not-found');
  is_problem(await server.get('/v1/presets/no-such-preset.glb'), 404, 'not-found');
  const misspelt = await server.get('/v1/presets/Oak.glb');
  is_problem(misspelt, 404, 'not-found');
  assert.match(misspelt.text, /did you mean \\"oak\\"/);
  is_problem(await server.get(`/v1/presets/${name}.obj`), 404, 'not-found');
});

// --- import --------------------------------------------------------------------------------------------------------

const import_file = (format, text, type = 'text/plain') => server.post(`/v1/import?format=${format}`, text, { 'content-type': type });

test('import returns a request that generates without changes', async () => {
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

test('import takes maps under the media types of their formats', async () => {
  const corner = (id, east, north) => `<node id="${id}" lat="${48.1 + north / 111203}" lon="${11.5 + east / 74510}"/>`;
  const osm = `<osm version="0.6">${corner(1, 0, 0)}${corner(2, 12, 0)}${corner(3, 12, 8)}${corner(4, 0, 8)}<way id="5">${[1, 2, 3, 4, 1].map((id) => `<nd ref="${id}"/>`).join('')}<tag k="building" v="house"/><tag k="height" v="7"/></way></osm>`;
  const xml = await import_file('osm', osm, 'application/xml');
  assert.equal(xml.status, 200, xml.text.slice(0, 300));
  assert.equal(xml.json.request.parameters.buildings[0].name, 'way/5');
  is_glb((await server.generate(xml.json.request)).bytes);
  const map = { type: 'Polygon', coordinates: [[[11.5, 48.1], [11.5002, 48.1], [11.5002, 48.1001], [11.5, 48.1]]] };
  const geojson = await server.post('/v1/import', JSON.stringify(map), { 'content-type': 'application/geo+json' });
  assert.equal(geojson.json.format, 'geojson');
  assert.equal(geojson.json.request.parameters.georeference.latitude, 48.10005);
});

test('import reports line and column of unsupported content', async () => {
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

test('the extension of a preset is compatible with the output in its query', async () => {
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

test('an unknown query is refused, on routes with and without a query', async () => {
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
