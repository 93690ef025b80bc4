// Keys, signatures, presets alone, allowed generators, origins: over the socket, as an operator would set them.
import assert from 'node:assert/strict';
import crypto from 'node:crypto';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { ask, events_of, raw, rehearsal, run, serve, status_of, until } from './support.mjs';

const request = (parameters = {}, seed = 0) => ({ generator: 'rehearsal', seed, parameters });
const digest = (key) => crypto.createHash('sha256').update(key).digest('hex');
const bearer = (key) => ({ authorization: `Bearer ${key}` });
const word = (answer) => answer.json.type.split('#').pop();
const secrets = { a: crypto.randomBytes(32).toString('hex'), b: crypto.randomBytes(32).toString('hex') };

/** What another program does to sign: HMAC-SHA256 over the raw target, as docs/operating.md says. */
function sign(target, id, { expires, secret = secrets[id] } = {}) {
  const joined = (text, pair) => text + (text.includes('?') ? '&' : '?') + pair;
  let covered = target;
  if (expires !== undefined) covered = joined(covered, `expires=${expires}`);
  covered = joined(covered, `key=${id}`);
  return `${covered}&signature=${crypto.createHmac('sha256', Buffer.from(secret, 'hex')).update(covered).digest('base64url')}`;
}

async function with_server(flags, body, env) {
  const server = await serve(rehearsal, flags, env);
  try { await body(server); } finally { await server.stop(); }
}

const closed_flags = ['--api-keys', `alice:${digest('alices')}, bob:${digest('bobs')}:0:1`, '--signing-keys', `a:${secrets.a},b:${secrets.b}`];

test('with API keys, models need a key, and other routes do not', () =>
  with_server(closed_flags, async (server) => {
    for (const target of ['/', '/docs', '/openapi.json', '/v1/presets', '/v1/vocabulary', '/healthz', '/readyz', '/metrics', '/version'])
      assert.equal((await server.get(target)).status, 200, target);
    for (const [method, target] of [['POST', '/v1/generate'], ['POST', '/v1/validate'], ['POST', '/v1/derive'], ['POST', '/v1/import?format=x'], ['GET', '/v1/presets/small.glb'], ['GET', '/v1/models/AAAA.glb']]) {
      const body = method === 'POST' ? request() : undefined;
      const without = await ask(server, method, target, { body });
      assert.equal(without.status, 401, target);
      assert.match(without.headers['www-authenticate'], /^Bearer/);
      assert.equal(word(without), 'unauthorized');
      const wrong = await ask(server, method, target, { body, headers: bearer('nobodys') });
      assert.equal(wrong.status, 403, target);
      assert.equal(word(wrong), 'forbidden');
    }
    const answer = await server.generate(request(), bearer('alices'));
    assert.equal(answer.status, 200);
    assert.match(answer.headers['cache-control'], /^private/);
    assert.match(answer.headers.vary, /Authorization/);
    assert.equal((await server.generate(request(), { 'x-api-key': 'alices' })).status, 200);
    assert.equal(await server.metric('seedmesh_key_requests_total{key="alice"}'), 2);
    assert.equal(await server.metric('seedmesh_denied_total{reason="key_missing"}'), 6);
    assert.equal(await server.metric('seedmesh_denied_total{reason="key_wrong"}'), 6);
    await until(() => server.log_lines().some((line) => line.key === 'alice' && line.status === 200));
    assert.ok(!server.stderr.includes('alices'));
  }));

test('every replica answers a signed permalink without a key until it expires', async () => {
  const replicas = [await serve(rehearsal, [...closed_flags, '--link-lifetime', '600']), await serve(rehearsal, closed_flags)];
  try {
    const made = await replicas[0].generate(request({ bytes: 3000 }, 8), bearer('alices'));
    const link = made.headers['content-location'];
    assert.match(link, /\?expires=\d+&key=a&signature=[\w-]{43}$/);
    for (const server of replicas) {
      const answer = await server.get(link);
      assert.equal(answer.status, 200, answer.text);
      assert.deepEqual(answer.bytes, made.bytes);
      assert.equal(answer.headers.etag, made.headers.etag);
      const [, seconds] = /^public, max-age=(\d+)/.exec(answer.headers['cache-control']);
      assert.ok(Number(seconds) > 590 && Number(seconds) <= 600);
      assert.equal(answer.headers['content-location'], undefined, 'a new signature would outlive this one');
      assert.equal((await server.get(link, { 'if-none-match': made.headers.etag })).status, 304);
    }
    const bare = link.split('?')[0], now = Math.floor(Date.now() / 1000), server = replicas[1];
    assert.equal((await server.get(bare)).status, 401);
    assert.equal((await server.get(bare, bearer('alices'))).status, 200);
    assert.equal((await server.get(sign(bare, 'b'))).status, 200, 'every key verifies');
    assert.equal((await server.get(sign(bare, 'a', { expires: now + 60 }))).status, 200);
    const late = await server.get(sign(bare, 'a', { expires: now - 1 }));
    assert.equal(late.status, 403);
    assert.match(late.json.detail, /expired/);
    for (const wrong of [sign(bare, 'a', { secret: secrets.b }), sign(bare, 'c', { secret: secrets.a }), sign(bare.replace('.glb', '.zip'), 'a').replace('.zip', '.glb'), `${sign(bare, 'a')}A`, link.replace(/expires=\d/, 'expires=9')])
      assert.equal((await server.get(wrong)).status, 403, wrong);
    assert.equal((await ask(server, 'POST', sign('/v1/generate', 'a'), { body: request() })).status, 401, 'a signature does not allow a POST');
  } finally { for (const server of replicas) await server.stop(); }
});

test('the signature of a preset is valid only with its query', () =>
  with_server(closed_flags, async (server) => {
    const link = sign('/v1/presets/small.glb?seed=3', 'a');
    assert.equal((await server.get(link)).status, 200);
    assert.equal((await server.get(link.replace('seed=3', 'seed=4'))).status, 403);
    assert.equal((await server.get(`${link}&seed=4`)).status, 401);
    assert.equal((await server.get(sign('/v1/presets/small.glb?colour=red', 'a'))).status, 422);
  }));

test('the program makes signatures and keys that the service accepts', async () => {
  const { status, out } = await run(rehearsal, ['key', 'carol']);
  assert.equal(status, 0);
  const [, key, api, signing] = /^API key {6}(\S+)\napi-keys {5}(\S+)\nsigning-keys (\S+)\n$/.exec(out.toString());
  const env = { SEEDMESH_API_KEYS: api, SEEDMESH_SIGNING_KEYS: signing };
  const signed = await run(rehearsal, ['sign', '/v1/presets/small.glb?seed=9', '--valid-for', '100'], { env });
  assert.equal(signed.status, 0);
  assert.equal((await run(rehearsal, ['sign', '/v1/presets/small.glb'])).status, 2);
  for (const time of ['-5', 'nan', '1e11']) {
    const { status, out, err } = await run(rehearsal, ['sign', '/v1/presets/small.glb', '--valid-for', time], { env });
    assert.deepEqual([status, out.length], [2, 0], time);
    assert.match(err, /--valid-for is "\S+": it must be a number from 0 to 1e10/);
  }
  for (const target of ['/v1/presets/small.glb#top', '/v1/presets/a b.glb']) assert.equal((await run(rehearsal, ['sign', target], { env })).status, 2, target);
  for (const name of ['', 'a b', 'a:b', 'a,b', 'n'.repeat(65)]) assert.equal((await run(rehearsal, ['key', name])).status, 2, name);
  await with_server([], async (server) => {
    assert.equal((await server.get(signed.out.toString().trim())).status, 200);
    assert.equal((await server.generate(request(), bearer(key))).status, 200);
  }, env);
});

test('a token of another engine redirects to a URL with a signature for the same time', () =>
  with_server(closed_flags, async (server) => {
    const zlib = await import('node:zlib');
    const token = zlib.deflateRawSync(JSON.stringify({ engine: 'old', ...request() })).toString('base64url');
    const expires = Math.floor(Date.now() / 1000) + 50;
    const answer = await server.get(sign(`/v1/models/${token}.glb`, 'b', { expires }));
    assert.equal(answer.status, 307);
    assert.match(answer.headers.location, new RegExp(`\\?expires=${expires}&key=a&`));
    assert.equal((await server.get(answer.headers.location)).status, 200);
  }));

test('an event stream of a signing service ends with a signed permalink', () =>
  with_server(closed_flags, async (server) => {
    const answer = await server.generate(request({ progress: 2 }, 5), { ...bearer('alices'), accept: 'text/event-stream' });
    assert.equal((await server.get(events_of(answer.text).at(-1).data.permalink)).status, 200);
  }));

test('each key has its own limits of rate and concurrency', () =>
  with_server([...closed_flags, '--key-rate', '3', '--threads', '2'], async (server) => {
    const slow = server.generate(request({ milliseconds: 600 }, 1), bearer('bobs'));
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 1);
    const second = await server.generate(request({}, 2), bearer('bobs'));
    assert.equal(second.status, 429);
    assert.equal(word(second), 'rate-limited');
    assert.ok(Number(second.headers['retry-after']) >= 1);
    const alices = await Promise.all([1, 2, 3, 4, 5, 6].map((seed) => server.generate(request({}, 10 + seed), bearer('alices'))));
    const statuses = alices.map((answer) => answer.status).sort();
    assert.deepEqual(statuses, [200, 200, 200, 429, 429, 429]);
    assert.equal((await slow).status, 200);
    assert.equal(await server.metric('seedmesh_rejected_total{reason="key_concurrency"}'), 1);
    assert.equal(await server.metric('seedmesh_rejected_total{reason="key_rate"}'), 3);
  }));

test('a stream counts against the concurrency until it ends', () =>
  with_server(closed_flags, async (server) => {
    const stream = server.generate(request({ milliseconds: 700, progress: 7 }, 1), { ...bearer('bobs'), accept: 'text/event-stream' });
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 1);
    assert.equal((await server.generate(request({}, 2), bearer('bobs'))).status, 429);
    assert.equal((await stream).status, 200);
    await until(async () => (await server.generate(request({}, 2), bearer('bobs'))).status === 200);
  }));

test('with only-presets, only permalinks of presets work', () =>
  with_server(['--only-presets'], async (server) => {
    const preset = await server.get('/v1/presets/small.glb?seed=7');
    assert.equal(preset.status, 200);
    assert.equal((await server.get(preset.headers['content-location'])).status, 200);
    assert.equal((await server.generate({ generator: 'rehearsal', seed: 1, parameters: { bytes: 2000 }, output: { format: 'zip' } })).status, 200);
    for (const answer of [await server.generate(request({ bytes: 5 })), await server.post('/v1/derive', request({ bytes: 5 })), await server.post('/v1/validate', request()), await server.get('/v1/presets/small.glb?bytes=5'), await server.post('/v1/import?format=x', 'x', { 'content-type': 'text/plain' })])
      assert.equal(answer.status, 403);
    assert.equal(await server.metric('seedmesh_denied_total{reason="only_presets"}'), 5);
  }));

test('pages of allowed origins can read responses and send the fields that they need', () =>
  with_server(['--cors-origins', 'https://a.example'], async (server) => {
    const origin = 'https://a.example';
    const answer = await server.generate(request(), { origin });
    assert.equal(answer.headers['access-control-allow-origin'], origin);
    assert.match(answer.headers.vary, /Accept-Encoding, Origin$/);
    assert.match(answer.headers['access-control-expose-headers'], /Content-Location/);
    const refusal = await server.generate('{', { origin });
    assert.equal(refusal.status, 400);
    assert.equal(refusal.headers['access-control-allow-origin'], origin);
    const other = await server.generate(request(), { origin: 'https://b.example' });
    assert.equal(other.headers['access-control-allow-origin'], undefined);
    assert.match(other.headers.vary, /Origin/);
    const preflight = await ask(server, 'OPTIONS', '/v1/generate', { headers: { origin, 'access-control-request-method': 'POST', 'access-control-request-headers': 'content-type' } });
    assert.equal(preflight.status, 204);
    assert.equal(preflight.headers['access-control-allow-methods'], 'POST, OPTIONS');
    assert.match(preflight.headers['access-control-allow-headers'], /Content-Type/);
  }));

test('pages of allowed origins can read why a request was refused before it was routed', () =>
  with_server(['--cors-origins', 'https://a.example', '--body-limit', '100KiB'], async (server) => {
    const fields = (origin) => `Origin: ${origin}\r\nX-Request-Id: mine\r\n`;
    const refused = (origin) => ({
      400: `GET / HTTP/1.1\r\nHost: a b\r\n${fields(origin)}\r\n`,
      411: `POST /v1/generate HTTP/1.1\r\nHost: here\r\n${fields(origin)}\r\n`,
      413: `POST /v1/generate HTTP/1.1\r\nHost: here\r\nContent-Length: 200000\r\n${fields(origin)}\r\n`,
      '400 ': `GET /%2e%2e/x HTTP/1.1\r\nHost: here\r\n${fields(origin)}\r\n`,
      414: `GET /${'a'.repeat(20000)} HTTP/1.1\r\nHost: here\r\n${fields(origin)}\r\n`,
      431: `GET / HTTP/1.1\r\nHost: here\r\n${fields(origin)}a: ${'b'.repeat(40000)}\r\n\r\n`,
      505: `GET / HTTP/3.0\r\nHost: here\r\n${fields(origin)}\r\n`,
    });
    for (const [status, bytes] of Object.entries(refused('https://a.example'))) {
      const { text } = await raw(server, bytes);
      assert.equal(status_of(text), Number(status));
      assert.match(text, /\r\nAccess-Control-Allow-Origin: https:\/\/a\.example\r\n/, status);
      assert.match(text, /\r\nVary: [^\r]*Origin\r\n/, status);
      assert.match(text, /\r\nX-Request-Id: mine\r\n/, status);
    }
    for (const [status, bytes] of Object.entries(refused('https://b.example'))) {
      const { text } = await raw(server, bytes);
      assert.equal(status_of(text), Number(status));
      assert.doesNotMatch(text, /Access-Control-Allow-Origin/, status);
    }
    const { text } = await raw(server, 'HEAD / HTTP/1.1\r\nHost: a b\r\n\r\n');
    assert.match(text, /\r\n\r\n$/, 'a response to HEAD has no body');
  }));

test('pages of all origins can read every response, also one from a cache that asked without an origin', () =>
  with_server(['--cors-origins', '*'], async (server) => {
    for (const target of ['/healthz', '/readyz', '/metrics', '/v1/presets', '/nowhere', '/v1/presets/small.glb']) {
      for (const headers of [{}, { origin: 'https://a.example' }]) {
        const answer = await ask(server, 'GET', target, { headers });
        assert.equal(answer.headers['access-control-allow-origin'], '*', target);
        assert.doesNotMatch(answer.headers.vary ?? '', /Origin/, target);
      }
    }
    const { text } = await raw(server, 'GET /%2e%2e/x HTTP/1.1\r\nHost: here\r\n\r\n');
    assert.match(text, /\r\nAccess-Control-Allow-Origin: \*\r\n/);
  }));

test('without origins, responses have no CORS fields', () =>
  with_server([], async (server) => {
    const answer = await server.generate(request(), { origin: 'https://a.example' });
    assert.ok(!Object.keys(answer.headers).some((name) => name.startsWith('access-control')));
    assert.ok(!/Origin/.test(answer.headers.vary));
  }));

test('a preflight needs no key', () =>
  with_server([...closed_flags, '--cors-origins', '*'], async (server) => {
    const preflight = await ask(server, 'OPTIONS', '/v1/generate', { headers: { origin: 'https://a.example', 'access-control-request-method': 'POST' } });
    assert.equal(preflight.status, 204);
    assert.equal(preflight.headers['access-control-allow-origin'], '*');
  }));

test('settings come from a file, secrets from files that it names, and all errors are reported together', async () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-'));
  try {
    const keys = path.join(folder, 'keys'), config = path.join(folder, 'config.json');
    fs.writeFileSync(keys, `# those of the gallery\nalice:${digest('alices')}\nbob:${digest('bobs')}\n`);
    fs.writeFileSync(config, `{"api-keys": "@${keys}", "queue": 5, "max-memory": "1GiB" /* enough */}`);
    const printed = await run(rehearsal, ['serve', '--print-config', '--config', config], { env: { SEEDMESH_QUEUE: '6' } });
    assert.equal(printed.status, 0, printed.err);
    const shown = JSON.parse(printed.out);
    assert.deepEqual([shown.queue, shown['max-memory'], shown['api-keys']], [6, 2 ** 30, ['alice:(hidden)', 'bob:(hidden)']]);
    assert.ok(!printed.out.includes(digest('bobs')));
    await with_server([], async (server) => assert.equal((await server.generate(request(), bearer('bobs'))).status, 200), { SEEDMESH_CONFIG: config });
    fs.writeFileSync(config, '{"queue": -1, "colour": "red", "only-presets": "perhaps"}');
    const { status, err } = await run(rehearsal, ['serve', '--config', config, '--redis-url', 'http://x'], { env: { SEEDMESH_CORS_ORIGINS: 'a' } });
    assert.equal(status, 2);
    for (const name of ['queue', 'colour', 'only-presets', '--redis-url', 'SEEDMESH_CORS_ORIGINS']) assert.match(err, new RegExp(name));
  } finally { fs.rmSync(folder, { recursive: true }); }
});

test('log and response contain the trace; a malformed one is ignored', () =>
  with_server([], async (server) => {
    const trace = '4bf92f3577b34da6a3ce929d0e0e4736';
    const answer = await server.generate(request(), { traceparent: `00-${trace}-00f067aa0ba902b7-01` });
    const [, ours] = new RegExp(`^00-${trace}-([0-9a-f]{16})-01$`).exec(answer.headers.traceparent);
    assert.notEqual(ours, '00f067aa0ba902b7');
    assert.equal((await server.generate(request(), { traceparent: 'nonsense' })).headers.traceparent, undefined);
    await until(() => server.log_lines().some((line) => line.trace_id === trace && line.span_id === ours && line.parent_span_id === '00f067aa0ba902b7'));
  }));
