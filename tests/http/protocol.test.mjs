// How the server reads HTTP: what it takes, what it refuses, and that one connection never mixes up two requests.
import assert from 'node:assert/strict';
import http from 'node:http';
import net from 'node:net';
import { after, before, test } from 'node:test';
import { ask, raw, rehearsal, serve, sleep, status_of } from './support.mjs';

let server;
before(async () => { server = await serve(rehearsal, ['--body-limit', '100KiB', '--connections', '40', '--head-timeout', '1', '--body-timeout', '1', '--idle-timeout', '2']); });
after(async () => { await server.stop(); });

const host = 'Host: here\r\n';
const wanted = JSON.stringify({ generator: 'rehearsal', parameters: { bytes: 10 } });
const post = (fields, body = '') => `POST /v1/generate HTTP/1.1\r\n${host}Content-Type: application/json\r\n${fields}\r\n${body}`;

async function refused(bytes, status) {
  const answer = await raw(server, bytes);
  assert.equal(status_of(answer.text), status, answer.text.slice(0, 300));
  assert.match(answer.text, /\r\nContent-Type: application\/problem\+json\r\n/);
  assert.match(answer.text, /\r\nConnection: close\r\n/);
  assert.ok(answer.closed, 'the connection ends, because the bytes that follow may not be a request');
  assert.equal(answer.text.match(/^HTTP\/1\.1 \d/gm).length, 1, 'exactly one answer');
  const body = JSON.parse(answer.text.slice(answer.text.indexOf('\r\n\r\n') + 4));
  assert.equal(body.status, status);
  assert.ok(body.instance);
}

test('two lengths are refused, and the rest is not read as a request', () =>
  refused(post('Content-Length: 2\r\nContent-Length: 40\r\n', '{}GET /healthz HTTP/1.1\r\nHost: here\r\n\r\n'), 400));
test('a length and chunks together are refused', () => refused(post('Content-Length: 5\r\nTransfer-Encoding: chunked\r\n', '0\r\n\r\n'), 400));
test('a chunked body is answered 411', () => refused(post('Transfer-Encoding: chunked\r\n', '2\r\n{}\r\n0\r\n\r\n'), 411));
test('a POST without a length is answered 411', () => refused(post(''), 411));
test('a method that the resource lacks is answered 405, with or without a length', async () => {
  for (const [method, path] of [['PUT', '/v1/presets'], ['PATCH', '/v1/generate'], ['PUT', '/docs'], ['POST', '/healthz']])
    await refused(`${method} ${path} HTTP/1.1\r\n${host}\r\n`, 405);
});
test('a path without a resource is answered 404, with or without a length', () => refused(`POST /v1/nothing HTTP/1.1\r\n${host}\r\n`, 404));
test('a negative length is refused at once', () => refused(post('Content-Length: -5\r\n'), 400));
test('a length in words is refused', () => refused(post('Content-Length: five\r\n'), 400));
test('a body over the limit is answered 413 before it is sent', () => refused(post('Content-Length: 200000\r\n'), 413));
test('a body over the limit is answered 413 although the client sends it all', () => refused(post('Content-Length: 5000000\r\n', 'x'.repeat(5000000)), 413));
test('a compressed body is answered 415', () => refused(post('Content-Length: 5\r\nContent-Encoding: gzip\r\n', 'xxxxx'), 415));
test('a request without a host is refused', () => refused('GET / HTTP/1.1\r\n\r\n', 400));
test('a request with two hosts is refused', () => refused(`GET / HTTP/1.1\r\n${host}${host}\r\n`, 400));
test('a line that ends with LF alone is refused', () => refused('GET / HTTP/1.1\nHost: here\n\r\n\r\n', 400));
test('a NUL in the path is refused', () => refused(`GET /v1/models/%00.glb HTTP/1.1\r\n${host}\r\n`, 400));
test('a path above the root is refused', () => refused(`GET /../../etc/passwd HTTP/1.1\r\n${host}\r\n`, 400));
test('an encoded path above the root is refused', () => refused(`GET /%2e%2e/%2e%2e/etc/passwd HTTP/1.1\r\n${host}\r\n`, 400));
test('a malformed escape is refused', () => refused(`GET /v1/presets/a%zz HTTP/1.1\r\n${host}\r\n`, 400));
test('another version of HTTP is answered 505', () => refused(`GET / HTTP/3.0\r\n${host}\r\n`, 505));
test('a URL over 8,000 characters is answered 414', () => refused(`GET /${'a'.repeat(8000)} HTTP/1.1\r\n${host}\r\n`, 414));
test('a URL that never ends is cut', () => refused(`GET /${'a'.repeat(200000)}`, 414));
test('more than a hundred fields are answered 431', () => refused(`GET / HTTP/1.1\r\n${host}${'a: b\r\n'.repeat(101)}\r\n`, 431));
test('fields over 32 KiB are answered 431', () => refused(`GET / HTTP/1.1\r\n${host}a: ${'b'.repeat(40000)}\r\n\r\n`, 431));
test('fields that never end are cut', () => refused(`GET / HTTP/1.1\r\n${host}${'a: bbbbbbbbbbbbbbbbbbbb\r\n'.repeat(3000)}`, 431));
test('an unknown expectation is answered 417', () => refused(post('Content-Length: 2\r\nExpect: 200-maybe\r\n', '{}'), 417));

test('a URL of 8,000 characters is read', async () => {
  assert.equal((await server.get(`/${'a'.repeat(7999)}`)).status, 404);
});

test('bytes that are not HTTP are refused', async () => {
  const answer = await raw(server, '\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n');
  assert.equal(status_of(answer.text), 400);
});

test('a request in single bytes is read', async () => {
  const socket = net.connect(server.port, '127.0.0.1').setNoDelay(true);
  for (const c of `GET /healthz HTTP/1.1\r\n${host}Connection: close\r\n\r\n`) { socket.write(c); await sleep(1); }
  let text = '';
  for await (const piece of socket) text += piece;
  assert.equal(status_of(text), 200);
});

test('requests in one packet are answered in order', async () => {
  const one = (id) => post(`Content-Length: ${wanted.length}\r\nX-Request-Id: ${id}\r\n`, wanted);
  const answer = await raw(server, one('first') + one('second') + `GET /healthz HTTP/1.1\r\n${host}X-Request-Id: third\r\nConnection: close\r\n\r\n`);
  assert.deepEqual([...answer.text.matchAll(/X-Request-Id: (\w+)/g)].map((m) => m[1]), ['first', 'second', 'third']);
  assert.ok(answer.closed);
});

test('a connection is kept for the next request', async () => {
  const agent = new http.Agent({ keepAlive: true, maxSockets: 1 });
  for (let i = 0; i < 20; ++i) assert.equal((await ask(server, 'GET', '/healthz', { agent })).status, 200);
  assert.equal(Object.values(agent.freeSockets).flat().length, 1);
  agent.destroy();
});

test('HTTP/1.0 is answered and closed', async () => {
  const answer = await raw(server, 'GET /healthz HTTP/1.0\r\n\r\n');
  assert.equal(status_of(answer.text), 200);
  assert.ok(answer.closed);
});

test('HTTP/1.0 with keep-alive is answered, and the response says that the connection stays open', async () => {
  const answer = await raw(server, 'GET /healthz HTTP/1.0\r\nConnection: keep-alive\r\n\r\n', { wait: 500 });
  assert.equal(status_of(answer.text), 200);
  assert.match(answer.text, /\r\nConnection: keep-alive\r\n/);
  assert.ok(!answer.closed);
});

test('one empty line before a request is overlooked, two are not', async () => {
  const get = 'GET /healthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n';
  assert.equal(status_of((await raw(server, `\r\n${get}`)).text), 200);
  assert.equal(status_of((await raw(server, `\r\n\r\n${get}`)).text), 400);
});

test('a client with Expect: 100-continue receives 100', async () => {
  const answer = await raw(server, post(`Content-Length: ${wanted.length}\r\nExpect: 100-continue\r\nConnection: close\r\n`), { wait: 700 });
  assert.match(answer.text, /^HTTP\/1\.1 100 Continue\r\n\r\n$/);
});

test('a client with Expect: 100-continue and too large a body receives 413 at once', () =>
  refused(post('Content-Length: 999999\r\nExpect: 100-continue\r\n'), 413));

test('a head that never arrives ends the connection', async () => {
  const begun = Date.now();
  const answer = await raw(server, 'GET / HTTP/1.1\r\nHost: he', { wait: 5000 });
  assert.ok(answer.closed && Date.now() - begun < 3000);
  assert.equal(answer.text, '');
});

test('a body that never arrives ends the connection', async () => {
  const begun = Date.now();
  const answer = await raw(server, post('Content-Length: 100\r\n', '{'), { wait: 5000 });
  assert.ok(answer.closed && Date.now() - begun < 3000);
});

test('an idle connection is closed', async () => {
  const begun = Date.now();
  const answer = await raw(server, '', { wait: 6000 });
  assert.ok(answer.closed && Date.now() - begun >= 1500 && Date.now() - begun < 5000);
});

test('bodies that together need too much memory are answered 503', async () => {
  const small = await serve(rehearsal, ['--body-memory', '50KiB', '--body-limit', '40KiB']);
  const first = raw(small, post('Content-Length: 30000\r\n', '{'), { wait: 1000 });
  await sleep(200);
  const second = await raw(small, post('Content-Length: 30000\r\n'));
  assert.equal(status_of(second.text), 503);
  assert.match(second.text, /Retry-After: /);
  await first;
  await sleep(100);
  assert.equal((await small.generate(wanted)).status, 200);
  assert.equal(await small.metric('seedmesh_rejected_total{reason="bodies"}'), 1);
  await small.stop();
});

test('HEAD is answered like GET without the body', async () => {
  for (const target of ['/healthz', '/v1/presets/small.glb', '/', '/v1/presets']) {
    const get = await server.get(target), head = await ask(server, 'HEAD', target);
    assert.equal(head.bytes.length, 0);
    assert.equal(head.status, get.status);
    for (const name of ['content-length', 'content-type', 'etag', 'cache-control', 'vary']) assert.equal(head.headers[name], get.headers[name], `${target} ${name}`);
  }
});

test('every response has a date and a request id; a valid id of the client is kept', async () => {
  const own = await server.get('/healthz');
  assert.ok(Math.abs(Date.parse(own.headers.date) - Date.now()) < 5000);
  assert.match(own.headers['x-request-id'], /^[0-9a-f]{16}$/);
  assert.equal((await server.get('/healthz', { 'x-request-id': 'abc-1.2_3' })).headers['x-request-id'], 'abc-1.2_3');
  assert.match((await server.get('/healthz', { 'x-request-id': 'a b"c' })).headers['x-request-id'], /^[0-9a-f]{16}$/);
});

test('a field occurs once in a response', async () => {
  const names = (await server.generate(wanted)).raw_headers.filter((_, i) => i % 2 === 0).map((name) => name.toLowerCase());
  assert.equal(new Set(names).size, names.length, names.join(' '));
});

test('OPTIONS lists the allowed methods', async () => {
  const answer = await ask(server, 'OPTIONS', '/v1/generate');
  assert.equal(answer.status, 204);
  assert.equal(answer.headers.allow, 'POST, OPTIONS');
});

test('OPTIONS * asks about the server as a whole', async () => {
  const answer = await raw(server, `OPTIONS * HTTP/1.1\r\n${host}Connection: close\r\n\r\n`);
  assert.equal(status_of(answer.text), 204);
  assert.match(answer.text, /\r\nAllow: GET, HEAD, POST, OPTIONS\r\n/);
  await refused(`GET * HTTP/1.1\r\n${host}\r\n`, 400);
});

test('a connection beyond the limit receives 503 at once', async () => {
  const held = [];
  for (let i = 0; i < 40; ++i) {
    const socket = net.connect(server.port, '127.0.0.1');
    socket.on('error', () => {});
    held.push(socket);
  }
  await sleep(200);
  const answer = await raw(server, `GET /healthz HTTP/1.1\r\n${host}\r\n`);
  for (const socket of held) socket.destroy();
  assert.equal(status_of(answer.text), 503);
  assert.match(answer.text, /Retry-After: /);
  assert.ok(answer.closed);
  await sleep(300);
  assert.equal((await server.get('/healthz')).status, 200);
});
