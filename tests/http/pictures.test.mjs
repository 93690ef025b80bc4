// Pictures of models that the service draws: by permalink and preset, their query, caching and limits, and the page that
// programs read to show a link as a card.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import sharp from 'sharp';
import { is_problem, token_of } from './contract.mjs';
import { ask, metric, program, serve } from './support.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

const pixels = async (bytes) => sharp(bytes).removeAlpha().raw().toBuffer({ resolveWithObject: true });

/** The share of pixels whose channels differ by more than `step`. */
function difference(a, b, step = 24) {
  let differing = 0;
  for (let i = 0; i < a.length; i += 3) {
    if ([0, 1, 2].some((c) => Math.abs(a[i + c] - b[i + c]) > step)) differing += 1;
  }
  return differing / (a.length / 3);
}

async function permalink_of(request) {
  const model = await server.generate(request);
  return model.headers['content-location'].replace(/\.[a-z0-9]+$/, '');
}

test('a permalink has a picture of the wanted size, whose bytes never change', async () => {
  const link = await permalink_of({ preset: 'oak', seed: 3 });
  const answer = await server.get(`${link}.webp?size=200`);
  assert.equal(answer.status, 200, answer.text);
  assert.equal(answer.type, 'image/webp');
  assert.match(answer.headers['cache-control'], /immutable/);
  assert.equal(answer.headers['content-disposition'], 'inline; filename="oak_3.webp"');
  assert.equal(answer.headers['content-encoding'], undefined);
  assert.ok(Number(answer.headers['seedmesh-triangles']) > 10000);
  const { info } = await pixels(answer.bytes);
  assert.deepEqual([info.width, info.height, info.channels], [200, 200, 3]);
  const other = await serve(program, ['--threads', '1']);
  try {
    assert.deepEqual((await other.get(`${link}.webp?size=200`)).bytes, answer.bytes);
  } finally { await other.stop(); }
});

test('a picture shows the model, from the side that the query names', async () => {
  const get = async (query) => (await pixels((await server.get(`/v1/presets/house.webp?size=128&${query}`)).bytes)).data;
  const front = await get('view=front');
  assert.ok(difference(front, await get('view=right')) > 0.02);
  assert.ok(difference(front, await get('view=top')) > 0.1);
  assert.equal(difference(front, await get('view=0,8')), 0);
  assert.ok(difference(front, await get('view=front&ground=none'), 8) > 0.02);
  assert.equal(difference(front, await get('view=front&ground=plane')), 0);
  // The middle is the house, and the upper corners are the sky.
  const at = (x, y) => [...front.subarray(3 * (128 * y + x), 3 * (128 * y + x) + 3)];
  assert.ok(at(3, 3)[2] > at(3, 3)[0], 'the sky is blue');
  assert.ok(Math.max(...at(64, 64).map((value, c) => Math.abs(value - at(3, 3)[c]))) > 20);
});

test('a picture may be wide or high', async () => {
  for (const [width, height] of [[192, 144], [90, 160], [1024, 16]]) {
    const { info } = await pixels((await server.get(`/v1/presets/house.webp?size=${width}x${height}`)).bytes);
    assert.deepEqual([info.width, info.height], [width, height]);
  }
});

test('a seed and parameters change the picture of a preset, and the format of a request does not', async () => {
  const get = async (query) => (await server.get(`/v1/presets/oak.webp?size=96${query}`)).bytes;
  assert.ok(difference((await pixels(await get(''))).data, (await pixels(await get('&seed=5'))).data) > 0.02);
  const heights = await server.get(`/v1/models/${token_of({ generator: 'terrain', output: { format: 'png16' }, parameters: { algorithm: 'fbm', resolution: 65 } })}.webp?size=64`);
  assert.equal(heights.status, 200, heights.text);
  assert.equal((await sharp(heights.bytes).metadata()).format, 'webp');
  assert.match(heights.headers['cache-control'], /no-cache/);  // the token names no engine
});

test('HEAD and If-None-Match are answered as for models', async () => {
  const answer = await server.get('/v1/presets/menger_sponge.webp?size=64');
  const head = await ask(server, 'HEAD', '/v1/presets/menger_sponge.webp?size=64');
  assert.equal(head.status, 200);
  assert.equal(head.bytes.length, 0);
  assert.equal(head.headers.etag, answer.headers.etag);
  assert.equal(Number(head.headers['content-length']), answer.bytes.length);
  const again = await server.get('/v1/presets/menger_sponge.webp?size=64', { 'If-None-Match': answer.headers.etag });
  assert.equal(again.status, 304);
  const other = await server.get('/v1/presets/menger_sponge.webp?size=65', { 'If-None-Match': answer.headers.etag });
  assert.equal(other.status, 200);
  assert.notEqual(other.headers.etag, answer.headers.etag);
});

test('errors of the query name the key, what was found and what is expected, all at once', async () => {
  for (const path of ['/v1/presets/oak.webp', `${await permalink_of({ preset: 'menger_sponge' })}.webp`]) {
    const refused = await server.get(`${path}?size=9999&view=sideways&ground=grass`);
    is_problem(refused, 422, 'invalid-request');
    assert.deepEqual(refused.json.errors.map((error) => error.pointer), ['/size', '/view', '/ground']);
    for (const error of refused.json.errors) assert.match(error.message, /^found .*expected /);
    for (const query of ['size=1.5', 'size=64x', 'size=x64', 'size=64x2000', 'size=64x64x64', 'size=', 'size=15', 'view=1', 'view=10,95', 'view=a,b', 'size=64&size=65'])
      is_problem(await server.get(`${path}?${query}`), 422, 'invalid-request');
    is_problem(await server.get(`${path}?size=%zz`), 400);
  }
  const permalink = `${await permalink_of({ preset: 'menger_sponge' })}.webp`;
  const unknown = await server.get(`${permalink}?colour=red`);
  is_problem(unknown, 422, 'invalid-request');
  assert.equal(unknown.json.errors[0].pointer, '/colour');
  is_problem(await server.get('/v1/presets/oak.webp?colour=red'), 422, 'invalid-request');
  is_problem(await server.get('/v1/presets/oakk.webp'), 404);
  is_problem(await server.get('/v1/models/nonsense.webp'), 400);
  is_problem(await ask(server, 'POST', '/v1/presets/oak.webp', { body: '{}' }), 405);
});

test('a picture of another engine is redirected with its query', async () => {
  const token = token_of({ engine: '1-abc', generator: 'lsystem', parameters: { axiom: 'F' } });
  const answer = await server.get(`/v1/models/${token}.webp?size=64`);
  assert.equal(answer.status, 307);
  assert.match(answer.headers.location, /^\/v1\/models\/[A-Za-z0-9_-]+\.webp\?size=64$/);
  assert.equal((await server.get(answer.headers.location)).status, 200);
});

test('limits hold, and the pictures are counted', async () => {
  const small = await serve(program, ['--max-triangles', '100']);
  try {
    is_problem(await small.get('/v1/presets/menger_sponge.webp'), 422, 'limit-exceeded');
  } finally { await small.stop(); }
  const before_it = metric((await server.get('/metrics')).text, 'seedmesh_pictures_total');
  await server.get('/v1/presets/menger_sponge.webp?size=71');
  await server.get('/v1/presets/menger_sponge.webp?size=71');
  assert.equal(metric((await server.get('/metrics')).text, 'seedmesh_pictures_total'), before_it + 1);
});

test('the address for people has a card with a picture, and leads to the page', async () => {
  const link = await permalink_of({ preset: 'oak', seed: 3 });
  const token = link.split('/').at(-1);
  const page = await server.get(`/m/${token}`);
  assert.equal(page.status, 200);
  assert.match(page.type, /^text\/html/);
  const content = (name) => new RegExp(`<meta property="${name}" content="([^"]*)">`).exec(page.text)?.[1].replaceAll('&amp;', '&');
  assert.equal(content('og:title'), (await server.get('/v1/presets')).json.presets.find(({ name }) => name === 'oak').title);
  const picture = await server.get(content('og:image').slice(server.url.length));
  assert.equal(picture.type, 'image/webp');
  const { info } = await pixels(picture.bytes);
  assert.equal(String(info.width), content('og:image:width'));
  assert.equal(String(info.height), content('og:image:height'));
  assert.ok(page.text.includes(`0;url=../#${token}.oak`));
  is_problem(await server.get('/m/nonsense'), 400);
});
