// Admission, request coalescing, deadlines, disconnected clients, event streams, graceful shutdown.
import assert from 'node:assert/strict';
import net from 'node:net';
import { test } from 'node:test';
import { ask, events_of, metric, rehearsal, serve, sleep, until } from './support.mjs';

const request = (parameters, seed = 0) => ({ generator: 'rehearsal', seed, parameters });

async function with_server(flags, body) {
  const server = await serve(rehearsal, flags);
  try { await body(server); } finally { await server.stop(); }
}

test('workers run one generation each, the queue waits, and further requests get 429 at once', () =>
  with_server(['--threads', '2', '--queue', '3'], async (server) => {
    const all = [];
    for (let seed = 0; seed < 5; ++seed) all.push(server.generate(request({ milliseconds: 600 }, seed)));
    await until(async () => (await server.metric('seedmesh_queue_depth')) === 3);
    assert.equal(await server.metric('seedmesh_workers_busy'), 2);
    assert.equal(await server.metric('seedmesh_in_flight'), 5);
    const begun = Date.now();
    const surplus = await server.generate(request({ milliseconds: 600 }, 99));
    assert.equal(surplus.status, 429);
    assert.ok(Number(surplus.headers['retry-after']) >= 1);
    assert.equal(surplus.json.type.split('#').pop(), 'queue-full');
    assert.ok(Date.now() - begun < 300);
    for (const answer of await Promise.all(all)) assert.equal(answer.status, 200);
    const text = (await server.get('/metrics')).text;
    assert.equal(metric(text, 'seedmesh_rejected_total{reason="queue_full"}'), 1);
    assert.equal(metric(text, 'seedmesh_requests_total{route="/v1/generate",status="200"}'), 5);
    assert.equal(metric(text, 'seedmesh_in_flight'), 0);
  }));

test('health, readiness, metrics and cached models never wait for a worker', () =>
  with_server(['--threads', '1', '--queue', '0'], async (server) => {
    const known = await server.generate(request({ bytes: 50 }));
    const slow = server.generate(request({ milliseconds: 800 }, 1));
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 1);
    for (const target of ['/healthz', '/readyz', '/metrics', '/version', '/v1/presets', '/docs', '/']) {
      const begun = Date.now();
      assert.equal((await server.get(target)).status, 200, target);
      assert.ok(Date.now() - begun < 250, target);
    }
    assert.equal((await server.generate(request({ bytes: 50 }))).status, 200);
    assert.equal((await server.get(known.headers['content-location'], { 'if-none-match': known.headers.etag })).status, 304);
    assert.equal((await slow).status, 200);
  }));

test('a deadline that expires in the queue returns 503', () =>
  with_server(['--threads', '1', '--time-limit', '0.5'], async (server) => {
    // The worker does not look at its own deadline for 2 s, so that none of the others can get it.
    const first = server.generate(request({ blocked: 2000, milliseconds: 1 }));
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 1);
    const waited = await Promise.all([1, 2, 3, 4, 5].map((seed) => server.generate(request({ milliseconds: 1 }, seed))));
    assert.deepEqual(waited.map((answer) => answer.status), [503, 503, 503, 503, 503]);
    for (const answer of waited) assert.ok(Number(answer.headers['retry-after']) >= 1);
    assert.equal((await first).status, 504);
    assert.equal(await server.metric('seedmesh_rejected_total{reason="deadline"}'), waited.length);
  }));

test('a generation over the time limit is stopped and returns 504', () =>
  with_server(['--time-limit', '0.3'], async (server) => {
    const begun = Date.now();
    const answer = await server.generate(request({ milliseconds: 10000 }));
    assert.equal(answer.status, 504);
    assert.equal(answer.json.type.split('#').pop(), 'deadline-exceeded');
    assert.ok(Date.now() - begun < 1500);
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 0);
  }));

test('identical concurrent requests are generated once', () =>
  with_server(['--threads', '1', '--queue', '0'], async (server) => {
    const answers = await Promise.all(Array.from({ length: 12 }, () => server.generate(request({ milliseconds: 300 }))));
    for (const answer of answers) assert.equal(answer.status, 200);
    assert.equal(await server.metric('seedmesh_models_total'), 1);
  }));

test('generation stops when the client disconnects', () =>
  with_server(['--threads', '1'], async (server) => {
    const leaving = new AbortController();
    const left = ask(server, 'POST', '/v1/generate', { body: request({ milliseconds: 20000 }), signal: leaving.signal }).catch((error) => error);
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 1);
    leaving.abort();
    await left;
    const begun = Date.now();
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 0);
    assert.ok(Date.now() - begun < 500);
    await until(() => server.log_lines().some((line) => line.status === 499));
  }));

test('generation continues while one of two identical clients is connected', () =>
  with_server(['--threads', '1'], async (server) => {
    const leaving = new AbortController();
    const left = ask(server, 'POST', '/v1/generate', { body: request({ milliseconds: 700 }), signal: leaving.signal }).catch((error) => error);
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 1);
    const staying = server.generate(request({ milliseconds: 700 }));
    await until(async () => (await server.metric('seedmesh_cache_joins_total')) === 1);
    leaving.abort();
    await left;
    assert.equal((await staying).status, 200);
  }));

test('the cache does not exceed its size in bytes', () =>
  with_server(['--cache-bytes', '100KiB'], async (server) => {
    for (let seed = 0; seed < 20; ++seed) assert.equal((await server.generate(request({ bytes: 30000 }, seed))).status, 200);
    assert.ok((await server.metric('seedmesh_cache_bytes')) <= 100 * 1024);
    assert.ok((await server.metric('seedmesh_cache_entries')) >= 2);
  }));

test('without a cache every response is generated again with the same bytes', () =>
  with_server(['--cache-bytes', '0'], async (server) => {
    const a = await server.generate(request({})), b = await server.generate(request({}));
    assert.deepEqual(a.bytes, b.bytes);
    assert.equal(await server.metric('seedmesh_models_total'), 2);
  }));

test('a large response arrives complete', () =>
  with_server([], async (server) => {
    const answer = await server.generate(request({ bytes: 50_000_000 }));
    assert.equal(answer.bytes.length, 50_000_000);
    assert.equal(Number(answer.headers['content-length']), 50_000_000);
  }));

test('an internal error is logged and returns 500 with only the request id', () =>
  with_server([], async (server) => {
    for (const end of ['internal', 'throw']) {
      const answer = await server.generate(request({ end }), { 'x-request-id': `fail-${end}` });
      assert.equal(answer.status, 500);
      assert.doesNotMatch(answer.text + JSON.stringify(answer.headers), /secret/);
      assert.equal(answer.json.instance, `fail-${end}`);
      await until(() => server.log_lines().some((line) => line.request_id === `fail-${end}` && /secret/.test(line.reason) && line.level === 'error'));
    }
    assert.equal((await server.generate(request({ end: 'limit' }))).json.type.split('#').pop(), 'limit-exceeded');
  }));

const stream = (server, body, headers) => server.generate(body, { accept: 'text/event-stream', ...headers });

test('an event stream reports progress and ends with a permalink to the cached model', () =>
  with_server([], async (server) => {
    const answer = await stream(server, request({ milliseconds: 400, progress: 4 }));
    assert.equal(answer.status, 200);
    assert.match(answer.type, /^text\/event-stream/);
    assert.equal(answer.headers['cache-control'], 'no-store');
    const events = events_of(answer.text);
    const progress = events.filter((event) => event.name === 'progress');
    assert.ok(progress.length >= 2);
    for (const { data } of progress) assert.ok(data.stage === 'mesh' && data.share >= 0 && data.share <= 1);
    const done = events.at(-1);
    assert.equal(done.name, 'done');
    assert.deepEqual(done.data.statistics, { triangles: 12, vertices: 24, warnings: 0, bytes: 1000 });
    const linked = await server.get(done.data.permalink);
    assert.equal(linked.status, 200);
    assert.equal(linked.headers.etag, done.data.etag);
    assert.equal(await server.metric('seedmesh_models_total'), 1);
    const again = events_of((await stream(server, request({ milliseconds: 400, progress: 4 }))).text);
    assert.deepEqual(again.map((event) => event.name), ['done']);
  }));

test('a refusal before the first event is a normal response', () =>
  with_server(['--threads', '1', '--queue', '0'], async (server) => {
    assert.equal((await stream(server, { generator: 'nothing' })).status, 422);
    assert.equal((await stream(server, request({ end: 'limit' }))).status, 422);
    const slow = server.generate(request({ milliseconds: 500 }));
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 1);
    assert.equal((await stream(server, request({}, 1))).status, 429);
    await slow;
  }));

test('a refusal after the first event is an error event', () =>
  with_server([], async (server) => {
    const answer = await stream(server, request({ milliseconds: 300, progress: 3, end: 'limit' }));
    assert.equal(answer.status, 200);
    const last = events_of(answer.text).at(-1);
    assert.equal(last.name, 'error');
    assert.equal(last.data.status, 422);
    assert.equal(last.data.errors[0].pointer, '/parameters/bytes');
  }));

test('an idle event stream sends a comment every ten seconds', () =>
  with_server([], async (server) => {
    const events = events_of((await stream(server, request({ milliseconds: 10700 }))).text);
    assert.ok(events[0].comment);
    assert.equal(events.at(-1).name, 'done');
  }));

test('generation stops when the client of an event stream disconnects', () =>
  with_server(['--threads', '1'], async (server) => {
    const leaving = new AbortController();
    const left = ask(server, 'POST', '/v1/generate', { body: request({ milliseconds: 20000, progress: 200 }), headers: { accept: 'text/event-stream' }, signal: leaving.signal }).catch((error) => error);
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 1);
    await sleep(250);
    leaving.abort();
    await left;
    await until(async () => (await server.metric('seedmesh_workers_busy')) === 0);
  }));

for (const signal of ['SIGTERM', 'SIGINT']) {
  test(`${signal} shuts down gracefully: not ready, requests in progress are finished, status 0`, async () => {
    const server = await serve(rehearsal, ['--threads', '1', '--drain-delay', '0.5', '--idle-timeout', '60']);
    const idle = net.connect(server.port, '127.0.0.1');
    const running = server.generate(request({ milliseconds: 1200, bytes: 3_000_000 }, 1));
    const waiting = server.generate(request({ milliseconds: 300 }, 2));
    await until(async () => (await server.metric('seedmesh_queue_depth')) === 1);
    server.child.kill(signal);
    await sleep(100);
    const ready = await server.get('/readyz');
    assert.equal(ready.status, 503);
    assert.ok(ready.headers['retry-after']);
    assert.equal((await server.get('/healthz')).status, 200);
    const answer = await running;
    assert.equal(answer.status, 200);
    assert.equal(answer.bytes.length, 3_000_000);
    assert.equal((await waiting).status, 200);
    assert.deepEqual(await server.ended, { status: 0, signal: null });
    idle.destroy();
    await assert.rejects(server.get('/healthz'));
  });
}
