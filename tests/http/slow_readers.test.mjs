// Clients that read slowly: the memory of their answers is limited, they are ended, and others are served.
import assert from 'node:assert/strict';
import net from 'node:net';
import { test } from 'node:test';
import { metric, rehearsal, serve, sleep, until } from './support.mjs';

const megabyte = 1 << 20;
const request = (bytes, seed, parameters) => JSON.stringify({ generator: 'rehearsal', seed, parameters: { bytes, ...parameters } });

const clients = new Set();

async function with_server(flags, body) {
  const server = await serve(rehearsal, ['--cache-bytes', '0', ...flags]);
  try {
    await body(server);
  } finally {
    for (const client of clients) client.leave();
    await server.stop();
  }
}

/** A client that asks for `bytes` bytes and reads `size` of them every `pause` milliseconds. */
function slow_client(server, { bytes, parameters, seed = 1, size = 2048, pause = 10_000, fields = '' }) {
  const client = { read: 0, status: undefined };
  const body = request(bytes, seed, parameters);
  const socket = net.connect({
    port: server.port, host: '127.0.0.1',
    onread: {
      buffer: Buffer.alloc(size),
      callback: (count, buffer) => {
        client.status ??= Number(/^HTTP\/1\.1 (\d{3})/.exec(buffer.toString('latin1', 0, count))?.[1]);
        client.read += count;
        setTimeout(() => socket.resume(), pause);
        return false;
      },
    },
  });
  // A paused socket of Node notices the end of its connection only when it reads again, so the tests look at the server.
  const ended = new Promise((resolve) => {
    socket.on('error', () => {});
    socket.on('close', resolve);
  });
  client.leave = () => { clients.delete(client); socket.destroy(); return ended; };
  clients.add(client);
  socket.write(`POST /v1/generate HTTP/1.1\r\nHost: here\r\nContent-Type: application/json\r\n${fields}Content-Length: ${body.length}\r\n\r\n${body}`);
  return client;
}

test('answers in flight use at most their memory; a further request waits, then receives 503 with Retry-After', () =>
  with_server(['--memory-in-flight', '64MiB', '--threads', '4'], async (server) => {
    const slow = Array.from({ length: 3 }, (_, i) => slow_client(server, { bytes: 20 * megabyte, seed: i }));
    await until(() => slow.every((client) => client.status === 200));
    const text = (await server.get('/metrics')).text;
    assert.equal(metric(text, 'seedmesh_memory_in_flight_bytes'), 60 * megabyte);
    const refused = await server.generate(request(20 * megabyte, 9));
    assert.equal(refused.status, 503);
    assert.ok(Number(refused.headers['retry-after']) >= 1);
    assert.equal(refused.json.type.split('#').pop(), 'unavailable');
    assert.equal(await server.metric('seedmesh_rejected_total{reason="memory_in_flight"}'), 1);
    assert.equal((await server.generate(request(1000, 9))).status, 200, 'small answers are not counted');
    await slow[0].leave();
    await until(async () => (await server.metric('seedmesh_memory_in_flight_bytes')) === 40 * megabyte);
    assert.equal((await server.generate(request(20 * megabyte, 9))).status, 200);
    for (const client of slow) await client.leave();
    await until(async () => (await server.metric('seedmesh_memory_in_flight_bytes')) === 0);
  }));

test('a request that finds the memory in use waits without a model, and is served when a client has read its answer', () =>
  with_server(['--memory-in-flight', '16MiB'], async (server) => {
    const slow = slow_client(server, { bytes: 17 * megabyte });
    await until(() => slow.status === 200);
    const begun = performance.now();
    const waiting = server.generate(request(megabyte, 2));
    await sleep(300);
    assert.equal(await server.metric('seedmesh_models_total'), 1);
    await slow.leave();
    assert.equal((await waiting).status, 200);
    assert.ok(performance.now() - begun < 1900);
  }));

test('clients that read one answer count it once', () =>
  with_server(['--memory-in-flight', '32MiB'], async (server) => {
    // The model takes long enough for all to join one generation.
    const slow = Array.from({ length: 6 }, () => slow_client(server, { bytes: 20 * megabyte, parameters: { milliseconds: 300 } }));
    await until(() => slow.every((client) => client.status === 200));
    assert.equal(await server.metric('seedmesh_memory_in_flight_bytes'), 20 * megabyte);
    for (const client of slow) await client.leave();
  }));

const ended = (server) => server.metric('seedmesh_cancelled_total{reason="slow_client"}');

test('a client that reads 2 KB every 10 s is ended after the write timeout, and so is one that reads a little more', () =>
  with_server(['--write-timeout', '1', '--min-rate', '0'], async (server) => {
    const slow = [slow_client(server, { bytes: 40 * megabyte }), slow_client(server, { bytes: 40 * megabyte, seed: 2, pause: 300 })];
    await until(() => slow.every((client) => client.status === 200));
    const begun = performance.now();
    await until(async () => (await ended(server)) === 2);
    assert.ok(performance.now() - begun < 6000);
    assert.ok(slow.every((client) => client.read < 100_000));
    await until(async () => (await server.metric('seedmesh_memory_in_flight_bytes')) === 0);
    await until(() => server.log_lines().filter((line) => line.reason === 'the client read too slowly' && line.complete === false).length === 2);
  }));

test('a client below the least rate is ended after the grace period, one above it is served', () =>
  with_server(['--min-rate', '4000000', '--min-rate-grace', '1'], async (server) => {
    const slow = slow_client(server, { bytes: 60 * megabyte, size: 65_536, pause: 60 });  // about 1 MB/s
    const quick = slow_client(server, { bytes: 30 * megabyte, seed: 2, size: megabyte, pause: 20 });  // about 40 MB/s
    await until(() => slow.status === 200 && quick.status === 200);
    await sleep(700);
    assert.equal(await ended(server), 0, 'the grace period is not over');
    await until(() => quick.read > 30 * megabyte);
    await until(async () => (await ended(server)) === 1);
    assert.ok(slow.read < 30 * megabyte);
  }));

test('an answer that is compressed while it is sent counts with its encoder', () =>
  with_server([], async (server) => {
    const slow = slow_client(server, { bytes: 60 * megabyte, parameters: { bits: 4 }, fields: 'Accept-Encoding: zstd\r\n' });
    await until(() => slow.status === 200);
    assert.ok((await server.metric('seedmesh_memory_in_flight_bytes')) > 60 * megabyte);
    await slow.leave();
    await until(async () => (await server.metric('seedmesh_memory_in_flight_bytes')) === 0);
  }));
