// Content codings of models: which one, when none, while they are sent, and from the cache.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import zlib from 'node:zlib';
import { ask, raw, rehearsal, serve } from './support.mjs';

// `bits` random bits in each byte: compression can save (8 - bits) / 8.
const request = (bytes, bits, seed = 1) => ({ generator: 'rehearsal', seed, parameters: { bytes, bits } });
const large = 3_000_000, small = 30_000;
const unpack = { gzip: zlib.gunzipSync, br: zlib.brotliDecompressSync, zstd: zlib.zstdDecompressSync };

async function with_server(flags, body) {
  const server = await serve(rehearsal, flags);
  try { await body(server); } finally { await server.stop(); }
}
const coding_of = (answer) => answer.headers['content-encoding'] ?? 'identity';
const asking = (server, body, accept, headers = {}) => server.generate(body, { 'accept-encoding': accept, ...headers });

test('clients get the quickest coding that they offer', () =>
  with_server([], async (server) => {
    for (const [accept, expected] of [['gzip, deflate, br, zstd', 'zstd'], ['gzip, deflate, br', 'gzip'], ['br', 'br'], ['gzip;q=0.5, br', 'br'], ['deflate', 'identity'], ['', 'identity']]) {
      const answer = await asking(server, request(small, 4), accept);
      assert.equal(coding_of(answer), expected, accept);
      assert.match(answer.headers.etag, expected === 'identity' ? /^"\w+"$/ : new RegExp(`^W/"\\w+-${expected}"$`));
      assert.match(answer.headers.vary, /Accept-Encoding/);
    }
  }));

for (const coding of ['gzip', 'br', 'zstd']) {
  test(`a large answer is sent in ${coding} while it is compressed, and then from the cache, with the same bytes`, () =>
    with_server([], async (server) => {
      const plain = await server.generate(request(large, 4));
      const first = await asking(server, request(large, 4), coding), second = await asking(server, request(large, 4), coding);
      assert.equal(coding_of(first), coding);
      assert.equal(first.headers['transfer-encoding'], 'chunked');
      assert.equal(Number(second.headers['content-length']), second.bytes.length);
      assert.deepEqual(first.bytes, second.bytes);
      assert.ok(first.bytes.length < 0.62 * large, `${first.bytes.length}`);
      if (unpack[coding]) assert.deepEqual(unpack[coding](first.bytes), plain.bytes);  // Node supports zstd from version 22.15
      assert.equal(await server.metric('seedmesh_models_total'), 1);
      assert.ok((await server.metric('seedmesh_span_duration_seconds_count{span="compress"}')) > 0);
    }));
}

test('without a cache every answer is compressed anew', () =>
  with_server(['--cache-bytes', '0'], async (server) => {
    for (let i = 0; i < 2; ++i) {
      const answer = await asking(server, request(large, 4), 'gzip');
      assert.equal(zlib.gunzipSync(answer.bytes).length, large);
    }
  }));

test('what compression would shorten by less than 15 % is sent as it is', () =>
  with_server([], async (server) => {
    for (const bytes of [small, large]) {
      for (let round = 0; round < 2; ++round) {
        assert.equal(coding_of(await asking(server, request(bytes, 8), 'gzip, zstd')), 'identity');
        assert.equal(coding_of(await asking(server, request(bytes, 7), 'gzip, zstd')), 'identity');
        assert.equal(coding_of(await asking(server, request(bytes, 6), 'gzip, zstd')), 'zstd');
      }
      assert.equal(coding_of(await asking(server, request(bytes, 8), 'gzip, identity;q=0')), 'gzip', 'the client takes nothing else');
    }
  }));

test('ranges are those of the answer without coding', () =>
  with_server([], async (server) => {
    const link = (await server.generate(request(large, 4))).headers['content-location'];
    const answer = await server.get(link, { 'accept-encoding': 'gzip', range: 'bytes=10-19' });
    assert.equal(answer.status, 206);
    assert.equal(coding_of(answer), 'identity');
    assert.equal(answer.headers['content-range'], `bytes 10-19/${large}`);
    assert.equal((await server.get(link, { 'accept-encoding': 'gzip' })).headers['accept-ranges'], undefined);
  }));

test('HTTP/1.0 gets a length instead of chunks', () =>
  with_server([], async (server) => {
    const link = (await server.generate(request(large, 4))).headers['content-location'];
    const { text } = await raw(server, `GET ${link} HTTP/1.0\r\nAccept-Encoding: gzip\r\n\r\n`);
    const [head, body] = [text.slice(0, text.indexOf('\r\n\r\n')), Buffer.from(text.slice(text.indexOf('\r\n\r\n') + 4), 'latin1')];
    assert.match(head, /Content-Encoding: gzip/);
    assert.match(head, new RegExp(`Content-Length: ${body.length}\r\n`));
    assert.equal(zlib.gunzipSync(body).length, large);
  }));

test('HEAD has the fields of GET and no body', () =>
  with_server([], async (server) => {
    const link = (await server.generate(request(large, 4))).headers['content-location'];
    const answer = await ask(server, 'HEAD', link, { headers: { 'accept-encoding': 'gzip' } });
    assert.equal(coding_of(answer), 'gzip');
    assert.equal(answer.bytes.length, 0);
  }));

test('settings leave small answers and private addresses without coding', async () => {
  await with_server(['--compress-from', '100KiB'], async (server) => {
    assert.equal(coding_of(await asking(server, request(small, 4), 'gzip')), 'identity');
    assert.equal(coding_of(await asking(server, request(large, 4), 'gzip')), 'gzip');
  });
  await with_server(['--plain-for-private'], async (server) => {
    assert.equal(coding_of(await asking(server, request(large, 4), 'gzip')), 'identity');
    assert.equal(coding_of(await asking(server, request(large, 4), 'gzip, identity;q=0')), 'gzip');
  });
});

test('the parts of Server-Timing sum up to the total', () =>
  with_server([], async (server) => {
    for (const accept of ['', 'gzip', 'gzip', 'zstd']) {
      const timing = (await asking(server, request(200_000, 4), accept)).headers['server-timing'];
      const parts = Object.fromEntries([...timing.matchAll(/(\w+);dur=([\d.]+)/g)].map(([, name, value]) => [name, Number(value)]));
      const { total, ...rest } = parts;
      assert.ok(Object.hasOwn(rest, 'compress') && Object.hasOwn(rest, 'parse') && Object.hasOwn(rest, 'wait'), timing);
      // The rehearsal reports spans that it did not spend: 0.6 ms.
      assert.ok(Math.abs(Object.values(rest).reduce((a, b) => a + b, 0) - total) < 0.65, timing);
    }
  }));
