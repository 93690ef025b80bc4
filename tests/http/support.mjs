// Starts the program and sends requests without any headers of a client library.
import { spawn } from 'node:child_process';
import http from 'node:http';
import net from 'node:net';
import path from 'node:path';

const build = path.resolve(process.env.SEEDMESH_BUILD ?? 'build/release');
export const program = path.resolve(process.env.SEEDMESH_PROGRAM ?? path.join(build, 'seedmesh'));
/** The same server over a pipeline that takes as long, answers as much and fails as a request says. */
export const rehearsal = path.join(build, 'seedmesh_rehearsal');

export const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Runs the program to its end. */
export function run(file, args, { input = '', env = {} } = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(file, args, { env: { ...process.env, ...env } });
    const out = [], err = [];
    child.stdout.on('data', (bytes) => out.push(bytes));
    child.stderr.on('data', (bytes) => err.push(bytes));
    child.on('error', reject);
    child.on('close', (status, signal) => resolve({ status, signal, out: Buffer.concat(out), err: Buffer.concat(err).toString() }));
    child.stdin.on('error', () => {});
    child.stdin.end(input);
  });
}

/** A server on a port of its own; ends with the test file at the latest. */
export async function serve(file, flags = [], env = {}) {
  const child = spawn(file, ['serve', ...(flags.includes('--port') ? [] : ['--port', '0']), ...flags], { env: { ...process.env, ...env } });
  const server = { child, stderr: '' };
  child.stderr.on('data', (bytes) => { server.stderr += bytes; });
  server.ended = new Promise((resolve) => child.on('close', (status, signal) => resolve({ status, signal })));
  server.url = await new Promise((resolve, reject) => {
    let out = '';
    child.stdout.on('data', (bytes) => {
      out += bytes;
      const line = /Listening on (\S+)\n/.exec(out);
      if (line) resolve(line[1]);
    });
    child.on('error', reject);
    server.ended.then(() => reject(new Error(`the server ended: ${server.stderr}`)));
  });
  server.port = Number(new URL(server.url).port);
  server.stop = async (signal = 'SIGTERM') => { child.kill(signal); return server.ended; };
  server.get = (target, headers) => ask(server, 'GET', target, { headers });
  server.post = (target, body, headers) => ask(server, 'POST', target, { body, headers });
  server.generate = (body, headers) => ask(server, 'POST', '/v1/generate', { body, headers });
  server.metric = async (name) => metric((await server.get('/metrics')).text, name);
  server.log_lines = () => server.stderr.split('\n').filter(Boolean).map((line) => JSON.parse(line));
  return server;
}

/** The value of a sample by its name with labels. */
export function metric(text, name) {
  const line = text.split('\n').find((each) => each.startsWith(`${name} `));
  return line === undefined ? undefined : Number(line.slice(name.length + 1));
}

/** One request. Bodies that are no string or bytes are sent as JSON; nothing is decoded, followed or retried. */
export function ask(server, method, target, { body, headers = {}, agent, signal } = {}) {
  const bytes = body === undefined || typeof body === 'string' || body instanceof Uint8Array ? body : JSON.stringify(body);
  const fields = { ...headers };
  if (bytes !== undefined) {
    fields['content-length'] ??= Buffer.byteLength(bytes);
    if (!('content-type' in fields)) fields['content-type'] = 'application/json';
    if (fields['content-type'] === null) delete fields['content-type'];
  }
  return new Promise((resolve, reject) => {
    const request = http.request({ host: '127.0.0.1', port: server.port, method, path: target, headers: fields, agent, signal }, (response) => {
      const pieces = [];
      response.on('data', (piece) => pieces.push(piece));
      response.on('error', reject);
      response.on('end', () => {
        const all = Buffer.concat(pieces);
        const answer = { status: response.statusCode, headers: response.headers, raw_headers: response.rawHeaders, bytes: all, text: all.toString(), type: response.headers['content-type'] ?? '' };
        if (/json/.test(answer.type) && !response.headers['content-encoding']) try { answer.json = JSON.parse(answer.text); } catch { /* left undefined */ }
        resolve(answer);
      });
    });
    request.on('error', reject);
    request.end(bytes);
  });
}

/** Sends bytes as they are and gives everything that comes back until the server closes or `wait` milliseconds pass. */
export function raw(server, bytes, { wait = 3000, half_close = false } = {}) {
  return new Promise((resolve) => {
    const pieces = [];
    const socket = net.connect(server.port, '127.0.0.1');
    let closed = false;
    const finish = () => { clearTimeout(timer); socket.destroy(); resolve({ text: Buffer.concat(pieces).toString('latin1'), closed }); };
    const timer = setTimeout(finish, wait);
    socket.on('data', (piece) => pieces.push(piece));
    socket.on('end', () => { closed = true; finish(); });
    socket.on('error', () => { closed = true; finish(); });
    socket.write(bytes);
    if (half_close) socket.end();
  });
}

export const status_of = (text) => Number(/^HTTP\/1\.1 (\d{3})/.exec(text)?.[1]);

/** Events of a text/event-stream, comments as {comment}. */
export function events_of(text) {
  return text.split('\n\n').filter(Boolean).map((block) => {
    if (block.startsWith(':')) return { comment: block.slice(1).trim() };
    const [, name, data] = /^event: (.*)\ndata: (.*)$/.exec(block);
    return { name, data: JSON.parse(data) };
  });
}

/** Waits until `condition` holds, at most ten seconds. */
export async function until(condition) {
  for (let i = 0; i < 1000; ++i) {
    if (await condition()) return;
    await sleep(10);
  }
  throw new Error(`never came true: ${condition}`);
}
