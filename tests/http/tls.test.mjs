// A service that speaks HTTPS itself, against Node's own client and against clients that misbehave before they have shaken hands.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import https from 'node:https';
import net from 'node:net';
import os from 'node:os';
import path from 'node:path';
import test, { after, before } from 'node:test';
import tls from 'node:tls';
import { program, run, serve, sleep } from './support.mjs';

const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-tls-'));
const certificate = path.join(folder, 'certificate.pem'), key = path.join(folder, 'key.pem'), stranger = path.join(folder, 'stranger.pem');
const flags = ['--tls-certificate', certificate, '--tls-key', key];
let server;

before(async () => {
  const make = (out, keyout) => execFileSync('openssl', ['req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-days', '2', '-subj', '/CN=localhost', '-addext', 'subjectAltName=DNS:localhost,IP:127.0.0.1', '-keyout', keyout, '-out', out], { stdio: 'pipe' });
  make(certificate, key);
  make(path.join(folder, 'other.pem'), stranger);
  server = await serve(program, [...flags, '--threads', '2', '--head-timeout', '1', '--connections', '8']);
});
after(async () => {
  await server?.stop();
  fs.rmSync(folder, { recursive: true });
});

/** One request by HTTPS, the certificate checked. */
const ask = (method, target, { body, agent, headers = {} } = {}) => new Promise((resolve, reject) => {
  const request = https.request({ host: '127.0.0.1', port: server.port, method, path: target, agent: agent ?? false, headers, ca: fs.readFileSync(certificate) }, (answer) => {
    const pieces = [], protocol = answer.socket.getProtocol();
    answer.on('data', (piece) => pieces.push(piece));
    answer.on('end', () => resolve({ status: answer.statusCode, headers: answer.headers, body: Buffer.concat(pieces), protocol }));
    answer.on('error', reject);
  });
  request.on('error', reject);
  request.end(body);
});

test('the reported address begins with https', () => assert.match(server.url, /^https:/));

test('a model is complete and the same as over plain HTTP', async () => {
  const plain = await serve(program, ['--threads', '2']);
  const request = { preset: 'abop_2_8b' };
  const open = await plain.generate(request);
  await plain.stop();
  const closed = await ask('POST', '/v1/generate', { body: JSON.stringify(request), headers: { 'content-type': 'application/json' } });
  assert.equal(closed.status, 200);
  assert.equal(closed.protocol, 'TLSv1.3');
  assert.ok(closed.body.length > 1e6);
  assert.ok(closed.body.equals(open.bytes));
});

test('one connection serves many requests and bodies of megabytes', async () => {
  const agent = new https.Agent({ keepAlive: true, maxSockets: 1 });
  const ports = new Set();
  agent.on('free', (socket) => ports.add(socket.localPort));
  for (let i = 0; i < 20; ++i) assert.equal((await ask('GET', '/healthz', { agent })).status, 200);
  const body = JSON.stringify({ generator: 'lsystem', parameters: { axiom: 'F'.repeat(3_000_000) } });
  const answer = await ask('POST', '/v1/validate', { body, agent, headers: { 'content-type': 'application/json' } });
  assert.ok([200, 422].includes(answer.status), String(answer.status));
  assert.equal(ports.size, 1);
  agent.destroy();
});

test('versions before 1.2 are refused', async () => {
  const error = await new Promise((resolve) => {
    const socket = tls.connect({ host: '127.0.0.1', port: server.port, rejectUnauthorized: false, minVersion: 'TLSv1', maxVersion: 'TLSv1.1', ciphers: 'DEFAULT@SECLEVEL=0' }, () => resolve(undefined));
    socket.on('error', resolve);
  });
  assert.ok(error);
});

test('clients that send nothing, plain HTTP or noise are disconnected, and others are served meanwhile', async () => {
  const ends = ['', 'GET / HTTP/1.1\r\nHost: here\r\n\r\n', '\x16\x03\x01\xff\xff' + 'x'.repeat(40_000)].map((text) => new Promise((resolve) => {
    const begun = Date.now();
    const socket = net.connect(server.port, '127.0.0.1', () => socket.write(text, 'latin1'));
    socket.on('data', () => {});
    socket.on('error', () => {});
    socket.on('close', () => resolve(Date.now() - begun));
  }));
  assert.equal((await ask('GET', '/healthz')).status, 200);
  for (const milliseconds of await Promise.all(ends)) assert.ok(milliseconds < 4000, `${milliseconds} ms`);
});

test('connections above the limit are closed, and later ones are accepted again', async () => {
  const sockets = Array.from({ length: 12 }, () => net.connect(server.port, '127.0.0.1').on('error', () => {}));
  await sleep(300);
  await assert.rejects(ask('GET', '/healthz'));
  for (const socket of sockets) socket.destroy();
  await sleep(1500);
  assert.equal((await ask('GET', '/healthz')).status, 200);
});

test('the health check of the program also uses TLS', async () => {
  assert.equal((await run(program, ['healthcheck', ...flags, '--port', String(server.port)])).status, 0);
  assert.equal((await run(program, ['healthcheck', '--port', String(server.port)])).status, 1);
});

test('a certificate without a key, a key that does not fit and an invalid file are reported at the start', async () => {
  for (const [given, expected] of [
    [['--tls-certificate', certificate], /needed together/],
    [['--tls-certificate', certificate, '--tls-key', stranger], /fits the certificate/],
    [['--tls-certificate', path.join(folder, 'none'), '--tls-key', key], /has no certificate/],
  ]) {
    const { status, err } = await run(program, ['serve', '--port', '0', ...given]);
    assert.notEqual(status, 0);
    assert.match(err, expected);
  }
});
