// Worlds as 3D Tiles over HTTP: addresses, caching, refusals, access and admission, with the real program.
import assert from 'node:assert/strict';
import crypto from 'node:crypto';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import zlib from 'node:zlib';
import { after, before, test } from 'node:test';
import { is_problem, token_of } from './contract.mjs';
import { ask, program, run, serve, sleep } from './support.mjs';

const world = { generator: 'world', seed: 3, parameters: { extent: 32768 } };
const levels = 10; // leaves of 64 m

let server, place, home;
before(async () => {
  server = await serve(program, ['--threads', '1']);
  const posted = await server.post('/v1/generate', world);
  assert.equal(posted.status, 200, posted.text);
  place = posted.headers['content-location'];
  home = place.replace('tileset.json', '');
});
after(async () => { await server.stop(); });

/** The path to which a URI in a file leads. */
const target_of = (uri, base) => new URL(uri, `http://x${base}`).pathname;

test('a posted world answers its tileset and where that lies', async () => {
  const posted = await server.post('/v1/generate', world);
  assert.match(place, /^\/v1\/worlds\/[\w-]{1,2000}\/tileset\.json$/);
  const root = await server.get(place);
  assert.deepEqual(posted.json, root.json);
  assert.equal(root.json.asset.version, '1.1');
  assert.equal(target_of(root.json.root.content.uri, place), `${home}c/0/0/0.glb`);
  const request = JSON.parse(zlib.inflateRawSync(Buffer.from(place.split('/')[3], 'base64url')));
  assert.equal(request.engine, (await server.get('/version')).json.engine);
});

test('options of the output that tiles do not have are refused', async () => {
  const output = { name: 'land', provenance: 'none', format: 'zip', variants: 3, max_triangles: 10, textures: 64 };
  const answer = await server.post('/v1/generate', { ...world, output });
  is_problem(answer, 422, 'invalid-request');
  assert.deepEqual(answer.json.errors.map(({ pointer }) => pointer).sort(), ['format', 'max_triangles', 'textures', 'variants'].map((name) => `/output/${name}`));
  assert.equal((await server.post('/v1/generate', { ...world, output: { name: 'land', provenance: 'none' } })).status, 200);
});

test('each link of the root leads to a tileset with the same box and error, down to the leaves', async () => {
  let url = place, json = (await server.get(url)).json, tile = json.root, level = 0, links = 0;
  for (;;) {
    const uri = target_of(tile.content.uri, url);
    if (uri.endsWith('.json')) {
      const below = await server.get(uri);
      assert.equal(below.status, 200, uri);
      assert.equal(below.json.root.geometricError, tile.geometricError);
      assert.deepEqual(below.json.root.boundingVolume, tile.boundingVolume);
      [url, tile] = [uri, below.json.root];
      links += 1;
      continue;
    }
    assert.match(uri, new RegExp(`/c/${level}/\\d+/\\d+\\.glb$`));
    if (!tile.children) break;
    tile = tile.children[level % 4];
    level += 1;
  }
  assert.equal(level, levels - 1);
  assert.equal(links, 2); // at levels 4 and 8
  assert.equal(tile.geometricError, 0);
});

test('kinds of files have their types, validators and times to live', async () => {
  const kinds = [['tileset.json', 'application/json', /no-cache/], ['implicit.json', 'application/json', /no-cache/], ['e/4/3/5.json', 'application/json'],
    ['s/5/3/5.subtree', 'application/octet-stream'], ['c/2/1/3.glb', 'model/gltf-binary'], ['world.json?box=0,0,512,512', 'application/json']];
  for (const [name, type, cache = /^public, max-age=31536000, immutable$/] of kinds) {
    const answer = await server.get(home + name);
    assert.equal(answer.status, 200, `${name}: ${answer.text.slice(0, 300)}`);
    assert.equal(answer.type, type, name);
    assert.match(answer.headers['cache-control'], cache, name);
    assert.equal(answer.headers['access-control-allow-origin'], '*', name);
    assert.match(answer.headers.vary, /Accept-Encoding/, name);
    const again = await server.get(home + name, { 'if-none-match': answer.headers.etag });
    assert.deepEqual([again.status, again.bytes.length], [304, 0], name);
    const head = await ask(server, 'HEAD', home + name);
    assert.deepEqual([head.status, head.headers.etag, head.bytes.length], [200, answer.headers.etag, 0], name);
  }
});

test('a validator answers before any work', async () => {
  const made = await server.get(`${home}c/3/2/2.glb`);
  const before = await server.metric('seedmesh_cache_misses_total');
  const other = await server.get(`${home}c/3/2/2.glb`, { 'if-none-match': made.headers.etag });
  assert.equal(other.status, 304);
  assert.equal(await server.metric('seedmesh_cache_misses_total'), before);
});

test('codings give the same bytes', async () => {
  const name = `${home}e/4/0/0.json`, plain = await server.get(name);
  for (const [coding, decode] of [['gzip', zlib.gunzipSync], ['br', zlib.brotliDecompressSync]]) {
    const coded = await server.get(name, { 'accept-encoding': coding });
    assert.equal(coded.headers['content-encoding'], coding);
    assert.deepEqual(decode(coded.bytes), plain.bytes);
    assert.ok(coded.bytes.length * 3 < plain.bytes.length, `${coded.bytes.length} of ${plain.bytes.length}`);
  }
});

test('a subtree is binary, has 5 levels of bits and no child beyond the leaves', async () => {
  const { bytes } = await server.get(`${home}s/5/0/0.subtree`);
  assert.equal(bytes.subarray(0, 4).toString(), 'subt');
  const json = JSON.parse(bytes.subarray(24, 24 + Number(bytes.readBigUInt64LE(8))));
  assert.equal(json.tileAvailability.constant, 1);
  assert.equal(json.childSubtreeAvailability.constant, 0);
  assert.equal(json.propertyTables[0].count, 341);
});

test('a token without engine redirects at its roots and nowhere else', async () => {
  const loose = `/v1/worlds/${token_of(world)}/`;
  for (const name of ['tileset.json', 'implicit.json']) {
    const led = await server.get(loose + name);
    assert.deepEqual([led.status, led.headers.location, led.headers['cache-control']], [307, home + name, 'no-store']);
  }
  const foreign = await server.get(`/v1/worlds/${token_of({ engine: 'another', ...world })}/tileset.json`);
  assert.deepEqual([foreign.status, foreign.headers.location], [307, place]);
  for (const name of ['c/0/0/0.glb', 'e/4/0/0.json', 's/0/0/0.subtree', 'world.json?box=0,0,1,1']) {
    const tile = await server.get(loose + name);
    is_problem(tile, 404, 'not-found');
    assert.equal(tile.headers['cache-control'], 'no-store');
  }
});

test('a preset with a seed answers directly, and nothing of it is immutable', async () => {
  const { presets } = (await server.get('/v1/presets')).json;
  const { name } = presets.find(({ generator }) => generator === 'world');
  const root = `/v1/worlds/${name}.7/`;
  const answer = await server.get(`${root}tileset.json`);
  assert.equal(answer.status, 200);
  assert.match(answer.headers['cache-control'], /no-cache/);
  const tile = target_of(answer.json.root.content.uri, `${root}tileset.json`);
  const whole = { ...(await server.get(`/v1/presets/${name}`)).json, seed: 7 };
  const posted = await server.post('/v1/generate', whole);
  assert.equal(tile, posted.headers['content-location'].replace('tileset.json', 'c/0/0/0.glb'));
  const named = await server.get(`${root}c/0/0/0.glb`);
  assert.equal(named.status, 200);
  assert.doesNotMatch(named.headers['cache-control'], /immutable/);
  const other = presets.find(({ generator }) => generator !== 'world').name;
  for (const bad of [`${name}.-1`, `${name}.01`, `${name}.18446744073709551616`, `${name}.x`, `${name}.`, 'no_such.1', `${other}.1`])
    is_problem(await server.get(`/v1/worlds/${bad}/tileset.json`), 404, 'not-found');
});

test('the name of a preset without a seed is explained', async () => {
  for (const preset of ['alpine', 'temperate_land']) {
    const answer = await server.get(`/v1/worlds/${preset}/tileset.json`);
    is_problem(answer, 404, 'not-found');
    assert.match(answer.json.detail, new RegExp(`such as ${preset}\\.1\\.`));
  }
});

test('pages of all origins may ask with a key or a condition, and read the validators', async () => {
  const headers = { origin: 'https://a.example', 'access-control-request-method': 'GET', 'access-control-request-headers': 'x-api-key, if-none-match' };
  for (const name of ['tileset.json', 'c/2/1/3.glb', 'nothing']) {
    const preflight = await ask(server, 'OPTIONS', home + name, { headers });
    assert.deepEqual([preflight.status, preflight.headers['access-control-allow-origin']], [204, '*'], name);
    assert.equal(preflight.headers['access-control-allow-methods'], 'GET, HEAD, OPTIONS', name);
    assert.match(preflight.headers['access-control-allow-headers'], /If-None-Match.*X-Api-Key/, name);
    const answer = await server.get(home + name, { origin: 'https://a.example' });
    assert.equal(answer.headers['access-control-allow-origin'], '*', name); // once
    assert.match(answer.headers['access-control-expose-headers'], /ETag/, name);
  }
});

test('addresses outside the tree are 404, open to pages and not stored', async () => {
  for (const name of ['c/10/0/0.glb', 'c/3/8/0.glb', 'c/3/0/8.glb', 'c/-1/0/0.glb', 'c/01/0/0.glb', 'c/1/+1/0.glb', 'c/1.5/0/0.glb', 'c/3/4294967296/0.glb', 'c/18446744073709551616/0/0.glb', 'c/0/0/0', 'c/0/0/0/0.glb',
    'e/0/0/0.json', 'e/3/0/0.json', 'e/4/16/0.json', 's/4/0/0.subtree', 's/10/0/0.subtree', 's/0/0/0.json', 'a/0.bin', 'a/', 'q/0/0/0.glb', '', 'tileset']) {
    const answer = await server.get(home + name);
    is_problem(answer, 404, 'not-found');
    assert.equal(answer.headers['access-control-allow-origin'], '*', name);
    assert.equal(answer.headers['cache-control'], 'no-store', name);
  }
});

test('names of worlds and queries are refused for what is wrong with them', async () => {
  for (const name of ['tileset.json', 'c/0/0/0.glb']) is_problem(await server.get(`/v1/worlds/${'A'.repeat(2001)}/${name}`), 414, 'uri-too-long');
  is_problem(await server.get('/v1/worlds/AAAA/tileset.json'), 400, 'malformed-request');
  is_problem(await server.get(`/v1/worlds/${token_of({ generator: 'lsystem', parameters: { axiom: 'F', productions: [] } })}/tileset.json`), 404, 'not-found');
  const invalid = await server.get(`/v1/worlds/${token_of({ generator: 'world', seed: -1, parameters: { extent: 0 } })}/tileset.json`);
  is_problem(invalid, 422, 'invalid-request');
  assert.deepEqual(invalid.json.errors.map(({ pointer }) => pointer).sort(), ['/parameters/extent', '/seed']);
  for (const query of ['', '?box=1,2,3', '?box=a,b,c,d', '?box=10,0,0,10', '?box=0,0,1e300,1', '?box=nan,0,1,1', '?bux=0,0,1,1', '?box=0,0,1,1&box=0,0,2,2', '?box=0,0,99999,1'])
    is_problem(await server.get(`${home}world.json${query}`), 422, 'invalid-request');
  const wide = await server.get(`${home}world.json?box=0,0,99999,1`);
  assert.equal(wide.json.errors[0].message, 'found "0,0,99999,1", expected sides of at most 65536 m');
  is_problem(await server.get(`${home}c/0/0/0.glb?x=1`), 422, 'invalid-request');
  const posted = await server.post(`${home}c/0/0/0.glb`, {});
  is_problem(posted, 405, 'method-not-allowed');
  assert.match(posted.headers.allow, /GET/);
  assert.equal(posted.headers['access-control-allow-origin'], '*');
});

test('the map of a box is the same by GET and by derive, which has heights', async () => {
  const map = await server.get(`${home}world.json?box=-512,-512,512,512`);
  assert.deepEqual(map.json.box, [-512, -512, 512, 512]);
  const derived = await server.post('/v1/derive?box=-512,-512,512,512', world);
  assert.equal(derived.status, 200, derived.text.slice(0, 300));
  const { heights, ...rest } = derived.json;
  assert.equal(heights.values.length, heights.columns * heights.rows);
  const { heights: none, ...same } = map.json;
  assert.equal(none, undefined);
  assert.deepEqual(rest, same);
  is_problem(await server.post('/v1/derive?box=0,0,1,1', { preset: 'oak' }), 422, 'invalid-request');
});

test('many tiles at once on one worker are all answered, while an ordinary request gets its turn', async () => {
  const tiles = Array.from({ length: 120 }, (_, k) => `${home}c/${levels - 1}/${k * 3}/${(k * 17) % 512}.glb`);
  const answers = Promise.all(tiles.map((name) => server.get(name)));
  await sleep(20);
  const other = await server.post('/v1/generate', { generator: 'lsystem', parameters: { axiom: 'F', productions: [] } });
  assert.equal(other.status, 200);
  assert.deepEqual([...new Set((await answers).map(({ status }) => status))], [200]);
});

test('a signature of the name of a world covers all its files, below the token too', async () => {
  const secret = crypto.randomBytes(32).toString('hex');
  const closed = await serve(program, ['--signing-keys', `a:${secret}`]);
  try {
    const { name } = (await server.get('/v1/presets')).json.presets.find(({ generator }) => generator === 'world');
    const covered = `/v1/worlds/${name}.7?expires=4102444800&key=a`;
    const signature = crypto.createHmac('sha256', Buffer.from(secret, 'hex')).update(covered).digest('base64url');
    const root = `/v1/worlds/${name}.7/expires=4102444800&key=a&signature=${signature}/tileset.json`;
    const answer = await closed.get(root);
    assert.equal(answer.status, 200, answer.text.slice(0, 200));
    const tile = target_of(answer.json.root.content.uri, root);
    assert.doesNotMatch(tile, /\?/);
    assert.equal((await closed.get(tile)).status, 200, tile);
    let link = answer.json.root;
    while (link.children) [link] = link.children;
    const nested = await closed.get(target_of(link.content.uri, root));
    assert.equal(nested.status, 200);
    assert.equal((await closed.get(target_of(nested.json.root.content.uri, target_of(link.content.uri, root)))).status, 200);
    assert.equal((await closed.get(tile.replace(/\/[^/]*signature=[^/]*/, ''))).status, 401);
    assert.equal((await closed.get(tile.replace('key=a', 'key=b'))).status, 403);
    assert.equal((await closed.get(root.replace('.7/', '.8/'))).status, 403);
  } finally { await closed.stop(); }
});

test('the program writes a part of a world as files, and a second run makes none', async () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'tiles-')), file = path.join(folder, 'request.json'), out = path.join(folder, 'out');
  try {
    fs.writeFileSync(file, JSON.stringify(world));
    const args = ['tiles', file, '--levels', '0-4', '--box=0,0,4096,4096', '-o', out];
    const first = await run(program, args);
    assert.equal(first.status, 0, first.err);
    const root = JSON.parse(fs.readFileSync(path.join(out, 'tileset.json')));
    const found = [];
    const visit = (json, base) => {
      const uri = json.content && path.join(path.dirname(base), json.content.uri);
      if (uri?.endsWith('.json')) visit(JSON.parse(fs.readFileSync(path.join(out, uri))).root, uri);
      else if (uri) found.push(uri);
      for (const child of json.children ?? []) visit(child, base);
    };
    visit(root.root, 'tileset.json');
    assert.deepEqual(found.length, 1 + 1 + 1 + 1 + 4); // the box covers one tile of 2^12 m at level 3, and four below
    for (const name of found) assert.deepEqual(fs.readFileSync(path.join(out, name)), (await server.get(home + name)).bytes, name);
    const second = await run(program, args);
    assert.match(second.err, /^0 made, /m);
    // what a sudden stop of the machine leaves behind
    const [short, empty] = [path.join(out, found[0]), path.join(out, 'tileset.json')];
    const whole = [short, empty].map((name) => fs.readFileSync(name));
    fs.truncateSync(short, 100);
    fs.truncateSync(empty, 0);
    const third = await run(program, args);
    assert.match(third.err, /^2 made, /m);
    assert.deepEqual([short, empty].map((name) => fs.readFileSync(name)), whole);
    const refused = async (text, ...args) => {
      const { status, err } = await run(program, ['tiles', ...args]);
      assert.equal(status, 2);
      assert.match(err, text);
    };
    await refused(/other levels; expected an empty folder/, file, '--levels', '0-3', '-o', out);
    await refused(/--levels: found "3-99", expected .*from 0 to 9/, file, '--levels', '3-99', '-o', `${out}2`);
    await refused(/--levels: found "2-1"/, file, '--levels', '2-1', '-o', `${out}2`);
    await refused(/--part: found "8\/8", expected/, file, '--part', '8/8', '-o', `${out}2`);
    await refused(/cannot be written: Not a directory/, file, '--levels', '0-1', '-o', path.join(file, 'below'));
    await refused(/absent\.json: No such file/, path.join(folder, 'absent.json'), '-o', `${out}2`);
    assert.equal(fs.existsSync(`${out}2`), false);
  } finally { fs.rmSync(folder, { recursive: true }); }
});
