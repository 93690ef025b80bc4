#!/usr/bin/env node
// At least a thousand valid, invalid and truncated random requests in a minute against both programs of the
// build. The programs must answer, keep running, and exit with status 0; a sanitizer report changes the
// status. Usage: stress.mjs [seconds] [seed]. SEEDMESH_BUILD and SEEDMESH_PROGRAM work as in the tests.
import fs from 'node:fs';
import net from 'node:net';
import { ask, program, rehearsal, serve, sleep } from './support.mjs';

const seconds = Number(process.argv[2] ?? 60), first_seed = Number(process.argv[3] ?? 1);
const least = 1000, clients = 12;

// A reproducible random number generator (xorshift).
let state = first_seed | 1;
const draw = () => { state ^= state << 13; state ^= state >>> 17; state ^= state << 5; return (state >>> 0) / 2 ** 32; };
const below = (n) => Math.floor(draw() * n);
const one_of = (list) => list[below(list.length)];

const plant = () => ({ generator: 'lsystem', seed: below(50), parameters: { axiom: 'X', productions: ['X -> F[+X]F[-X]+X : 0.5', 'X -> F[-X]F[+X]-X : 0.5', 'F -> FF'], iterations: below(5), angle: 10 + below(60) }, output: { format: one_of(['glb', 'gltf', 'zip']) } });
const timed = () => ({ generator: 'rehearsal', seed: below(50), parameters: { milliseconds: below(30), bytes: below(100000), progress: below(4), end: one_of(['product', 'product', 'product', 'limit', 'internal', 'throw']) } });

/** A text with one place spoilt. */
function spoilt(text) {
  const at = below(text.length);
  return one_of([() => text.slice(0, at), () => text.slice(0, at) + one_of(['{', '"', '\\', '\u0000', '9', '[', ',']) + text.slice(at + 1), () => text.slice(0, at) + text.slice(at, at + 20).repeat(3) + text.slice(at)])();
}

function head(length) {
  return `POST ${one_of(['/v1/generate', '/v1/derive', '/v1/validate'])} HTTP/1.1\r\nHost: here\r\nContent-Type: application/json\r\nContent-Length: ${length}\r\n\r\n`;
}

/** Writes bytes, perhaps in two parts, perhaps not all of them, and leaves in one of several ways. */
function rudely(server, bytes) {
  return new Promise((resolve) => {
    const socket = net.connect(server.port, '127.0.0.1');
    const leave = () => { one_of([() => socket.end(), () => socket.destroy(), () => socket.resetAndDestroy()])(); };
    socket.on('error', () => {});
    socket.on('close', resolve);
    socket.on('connect', () => {
      const cut = below(bytes.length + 1);
      socket.write(bytes.slice(0, cut));
      setTimeout(() => { if (draw() < 0.5) socket.write(bytes.slice(cut)); setTimeout(leave, below(40)); }, below(20));
    });
    socket.setTimeout(5000, () => socket.destroy());
    socket.resume();
  });
}

/** One random request; the status of its answer, or 0 where none was waited for. */
async function once(server, make) {
  const body = JSON.stringify(make());
  const posted = (text, headers) => ask(server, 'POST', one_of(['/v1/generate', '/v1/generate', '/v1/validate', '/v1/derive']), { body: text, headers });
  const deeds = [
    () => posted(body),
    () => posted(body, { 'accept-encoding': 'gzip' }),
    () => ask(server, 'POST', '/v1/generate', { body, headers: { accept: 'text/event-stream' } }),
    () => posted(spoilt(body)),
    () => posted(spoilt(spoilt(body))),
    async () => {
      const made = await ask(server, 'POST', '/v1/generate', { body });
      const link = made.headers['content-location'];
      return link ? ask(server, one_of(['GET', 'HEAD']), link, { headers: one_of([{}, { 'if-none-match': made.headers.etag }, { range: `bytes=${below(2000)}-${below(4000)}` }]) }) : made;
    },
    () => ask(server, 'GET', `/v1/models/${spoilt('q1ZKzUvPzEtVslIqSs1ITSwqTszRNVTSUUpPzUstSizJL0KWAYoXp6amKFkZ1wIA').replace(/[^A-Za-z0-9_-]/g, '_')}.${one_of(['glb', 'gltf', 'json', 'exe'])}`),
    () => ask(server, one_of(['GET', 'DELETE', 'OPTIONS', 'HEAD']), one_of(['/', '/docs', '/metrics', '/healthz', '/readyz', '/openapi.json', '/v1/presets', '/v1/schemas/request', '/v1/nothing'])),
    () => rudely(server, head(body.length) + body),
    () => rudely(server, spoilt(head(body.length)) + body),
    () => rudely(server, head(body.length + below(1000)) + body),
  ];
  const answer = await one_of(deeds)();
  return answer?.status ?? 0;
}

async function stress(file, make) {
  const server = await serve(file, ['--threads', '2', '--queue', '8', '--cache-bytes', '2MiB', '--time-limit', '10', '--head-timeout', '1', '--body-timeout', '1', '--log-level', 'error', '--connections', '64']);
  const statuses = new Map();
  const end = Date.now() + (seconds * 1000) / 2;
  let count = 0, lost = 0;
  const client = async () => {
    while (Date.now() < end || (count < least / 2 && Date.now() < end + 60000)) {
      ++count;
      // A server that refuses a connection may reset it before the client reads the refusal. No accepted
      // request is lost.
      const status = await once(server, make).catch((error) => { if (error.code !== 'ECONNRESET' && error.code !== 'EPIPE') ++lost; return -1; });
      statuses.set(status, (statuses.get(status) ?? 0) + 1);
    }
  };
  await Promise.all(Array.from({ length: clients }, client));
  const alive = (await server.get('/healthz').catch(() => ({}))).status === 200;
  await sleep(200);
  const { status } = await server.stop();
  const findings = /ERROR: \w*Sanitizer|WARNING: ThreadSanitizer|runtime error:/.test(server.stderr);
  if (findings) fs.writeSync(2, server.stderr.slice(0, 20000));
  console.log(`${file}: ${count} requests; ${[...statuses].sort((a, b) => a[0] - b[0]).map(([s, n]) => `${s}: ${n}`).join(', ')}; lost ${lost}; ends with ${status}`);
  return [alive, status === 0, !findings, lost === 0, count >= least / 2];
}

const checks = [...(await stress(program, plant)), ...(await stress(rehearsal, timed))];
const failed = checks.filter((ok) => !ok).length;
console.log(`${checks.length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
