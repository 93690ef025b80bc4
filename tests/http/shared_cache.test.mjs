// The cache that replicas share, tested with a small Redis implementation that can also hang, send wrong
// answers and disconnect.
import assert from 'node:assert/strict';
import net from 'node:net';
import { after, test } from 'node:test';
import { rehearsal, serve, sleep, until } from './support.mjs';

/** GET, SET ... EX, AUTH, SELECT and PING of Redis' protocol. `mode`: "well", "hangs", "lies", "errors". */
class SmallRedis {
  constructor() {
    this.kept = new Map();
    this.commands = [];
    this.mode = 'well';
    this.sockets = new Set();
  }
  async start(port = 0) {
    this.server = net.createServer((socket) => this.serve(socket));
    await new Promise((resolve) => { this.server.listen(port, '127.0.0.1', resolve); });
    this.port = this.server.address().port;
    return this;
  }
  serve(socket) {
    this.sockets.add(socket);
    let buffer = Buffer.alloc(0);
    socket.on('error', () => {});
    socket.on('close', () => this.sockets.delete(socket));
    socket.on('data', (bytes) => {
      buffer = Buffer.concat([buffer, bytes]);
      for (let taken; (taken = this.take(buffer)); buffer = buffer.subarray(taken.size)) this.answer(socket, taken.words);
    });
  }
  /** One array of bulk strings, where it is whole. */
  take(buffer) {
    let at = 0;
    const number = (mark) => {
      const end = buffer.indexOf('\r\n', at);
      if (end < 0) return undefined;
      assert.equal(String.fromCharCode(buffer[at]), mark);
      const value = Number(buffer.subarray(at + 1, end));
      at = end + 2;
      return value;
    };
    if (buffer.length === 0) return undefined;
    const count = number('*');
    const words = [];
    for (let i = 0; i < count; ++i) {
      const size = at < buffer.length ? number('$') : undefined;
      if (size === undefined || buffer.length < at + size + 2) return undefined;
      words.push(buffer.subarray(at, at + size));
      at += size + 2;
    }
    return count === undefined ? undefined : { words, size: at };
  }
  answer(socket, words) {
    const name = words[0].toString().toUpperCase();
    this.commands.push([name, ...words.slice(1).map((word) => word.toString('latin1').slice(0, 100))]);
    if (this.mode === 'hangs') return;
    if (this.mode === 'errors') { socket.write('-LOADING not now\r\n'); return; }
    if (name === 'SET') this.kept.set(words[1].toString(), Buffer.from(words[2]));
    if (name !== 'GET') { socket.write(name === 'PING' ? '+PONG\r\n' : '+OK\r\n'); return; }
    let value = this.kept.get(words[1].toString());
    if (this.mode === 'lies' && value) { value = Buffer.from(value); value[value.length - 1] ^= 1; }
    socket.write(value ? Buffer.concat([Buffer.from(`$${value.length}\r\n`), value, Buffer.from('\r\n')]) : '$-1\r\n');
  }
  async stop() {
    for (const socket of this.sockets) socket.destroy();
    await new Promise((resolve) => { this.server.close(resolve); });
  }
}

const request = (parameters, seed = 0) => ({ generator: 'rehearsal', seed, parameters });
const connections = (server) => server.metric('seedmesh_shared_cache_connections');
const started = [];
after(async () => { for (const each of started) await each.stop(); });

async function replica(redis, flags = []) {
  const server = await serve(rehearsal, ['--threads', '2', '--redis-url', `redis://me:secret@127.0.0.1:${redis.port}/2`, ...flags]);
  started.push(server);
  return server;
}

test('a model that one replica generated is found by another', async () => {
  const redis = await new SmallRedis().start();
  started.push(redis);
  const [first, second] = [await replica(redis), await replica(redis)];
  for (const server of [first, second]) await until(async () => (await connections(server)) === 4);
  assert.deepEqual(redis.commands.filter(([name]) => name === 'AUTH')[0], ['AUTH', 'me', 'secret']);
  assert.deepEqual(redis.commands.filter(([name]) => name === 'SELECT')[0], ['SELECT', '2']);
  const made = await first.generate(request({ bytes: 300_000 }));
  assert.equal(made.status, 200);
  await until(async () => (await first.metric('seedmesh_shared_cache_writes_total')) === 1);
  assert.equal(redis.commands.find(([name]) => name === 'SET').at(-1), '604800');
  const found = await second.generate(request({ bytes: 300_000 }));
  assert.deepEqual(found.bytes, made.bytes);
  for (const name of ['etag', 'content-type', 'content-location', 'seedmesh-triangles', 'seedmesh-vertices', 'seedmesh-warnings'])
    assert.equal(found.headers[name], made.headers[name], name);
  assert.doesNotMatch(made.headers['server-timing'], /cache/);
  assert.match(found.headers['server-timing'], /, cache;desc="shared", wait/);
  assert.equal(await second.metric('seedmesh_models_total'), 0);
  assert.equal(await second.metric('seedmesh_shared_cache_hits_total'), 1);
  await until(() => second.log_lines().some((line) => line.cache === 'shared'));
  assert.equal((await second.generate(request({ bytes: 300_000 }))).status, 200);
  assert.equal(await second.metric('seedmesh_shared_cache_hits_total'), 1, 'it is in memory from then on');
});

test('a corrupt entry is generated again', async () => {
  const redis = await new SmallRedis().start();
  started.push(redis);
  const first = await replica(redis);
  await until(async () => (await connections(first)) === 4);
  const made = await first.generate(request({ bytes: 5000 }));
  await until(() => redis.kept.size === 1);
  redis.mode = 'lies';
  const second = await replica(redis);
  await until(async () => (await connections(second)) === 4);
  assert.deepEqual((await second.generate(request({ bytes: 5000 }))).bytes, made.bytes);
  assert.equal(await second.metric('seedmesh_shared_cache_misses_total'), 1);
  assert.equal(await second.metric('seedmesh_models_total'), 1);
});

test('models over the size limit are not stored', async () => {
  const redis = await new SmallRedis().start();
  started.push(redis);
  const server = await replica(redis, ['--redis-value', '4KiB']);
  await until(async () => (await connections(server)) === 4);
  await server.generate(request({ bytes: 5000 }));
  await server.generate(request({ bytes: 3000 }));
  await until(() => redis.kept.size === 1);
  await sleep(50);
  assert.equal(redis.kept.size, 1);
});

for (const [name, harm] of [
  ['is not there', async (redis) => redis.stop()],
  ['hangs', async (redis) => { redis.mode = 'hangs'; }],
  ['answers with errors', async (redis) => { redis.mode = 'errors'; }],
]) {
  test(`a Redis that ${name} neither fails nor delays a request`, async () => {
    const redis = await new SmallRedis().start();
    const server = await replica(redis, ['--redis-timeout', '0.1']);
    await until(async () => (await connections(server)) === 4);
    await harm(redis);
    const times = [];
    for (let seed = 0; seed < 40; ++seed) {
      const begun = performance.now();
      assert.equal((await server.generate(request({ bytes: 2000 }, seed))).status, 200);
      times.push(performance.now() - begun);
    }
    assert.ok(Math.max(...times) < 400, `the longest took ${Math.max(...times)} ms`);
    assert.ok(times.filter((time) => time > 60).length <= 3, `${times.map(Math.round)}`);
    assert.equal((await server.get('/readyz')).status, 200);
    await redis.stop().catch(() => {});
  });
}

test('a Redis that is available again is used again', async () => {
  const redis = await new SmallRedis().start();
  const { port } = redis;
  const server = await replica(redis);
  await until(async () => (await connections(server)) === 4);
  await redis.stop();
  for (let seed = 0; seed < 5; ++seed) assert.equal((await server.generate(request({}, seed))).status, 200);
  const again = await new SmallRedis().start(port);
  started.push(again);
  await until(async () => (await connections(server)) === 4);
  await server.generate(request({ bytes: 99 }, 77));
  await until(() => again.kept.size === 1);
  assert.ok(server.log_lines().some((line) => line.message === 'the shared cache does not respond'));
  assert.ok(!server.stderr.includes('secret'));
});
