#!/usr/bin/env node
// Requests per second and latency over loopback, compared with nginx sending the same bytes in the same run:
// a 304, cached models of 50 KB and 1 MB, a 304 and a cached leaf of a world, and small trees that are not cached. wrk shares the processor with
// both servers, so the ratios count. Rounds alternate between the servers, and the median round is shown. Models are also asked for
// with compression offered, as browsers do: from memory beside nginx with gzip level 1, and cold.
// Usage: http_bench.mjs [seconds per round] [rounds]
import { execFileSync, spawn } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import { serve } from '../http/support.mjs';

const seconds = Number(process.argv[2] ?? 3), rounds = Number(process.argv[3] ?? 3);
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-bench-'));
const nginx_port = Number(process.env.SEEDMESH_BENCH_PORT ?? 18111);

const tree = (iterations, sides, seed = 1) => ({
  generator: 'lsystem', seed,
  parameters: { axiom: 'X', productions: ['X -> F[+X][&X]-X : 0.5', 'X -> F[-X]^X : 0.5', 'F -> FF'], iterations, angle: 25, sides },
});

/** The tree whose file is nearest to a size. */
async function tree_of(server, bytes) {
  let best;
  for (let iterations = 2; iterations <= 9; ++iterations) {
    for (const sides of [4, 6, 8, 12]) {
      const answer = await server.generate(tree(iterations, sides));
      if (answer.status !== 200) continue;
      const off = Math.abs(Math.log(answer.bytes.length / bytes));
      if (!best || off < best.off) best = { off, answer, request: tree(iterations, sides) };
      if (answer.bytes.length > 3 * bytes) break;
    }
  }
  return best;
}

function start_nginx() {
  const conf = path.join(folder, 'nginx.conf');
  fs.writeFileSync(conf, `daemon off; worker_processes 2; pid ${folder}/pid; error_log /dev/null; events { worker_connections 1024; }
http { access_log off; gzip_types *; gzip_comp_level 1; gzip_min_length 1000; gzip_proxied any; sendfile on; tcp_nopush on; keepalive_requests 1000000; etag on; client_body_temp_path ${folder}; proxy_temp_path ${folder};
  fastcgi_temp_path ${folder}; uwsgi_temp_path ${folder}; scgi_temp_path ${folder}; server { listen 127.0.0.1:${nginx_port}; root ${folder}; gzip on; } }`);
  return spawn('nginx', ['-c', conf, '-p', folder], { stdio: 'ignore' });
}

/** Requests per second and latencies of one round. */
function wrk(url, { connections, headers = {}, script }) {
  const args = ['-t1', `-c${connections}`, `-d${seconds}s`, '--latency'];
  for (const [name, value] of Object.entries(headers)) args.push('-H', `${name}: ${value}`);
  if (script) args.push('-s', script);
  const text = execFileSync('wrk', [...args, url], { encoding: 'utf8' });
  const rate = Number(/Requests\/sec:\s+([\d.]+)/.exec(text)[1]);
  const [, amount, unit] = /99%\s+([\d.]+)(us|ms|s)/.exec(text);
  const bad = /Non-2xx or 3xx responses: (\d+)/.exec(text);
  if (bad) throw new Error(`${bad[1]} refusals from ${url}`);
  return { rate, p99: Number(amount) * { us: 1e-3, ms: 1, s: 1e3 }[unit] };
}

const median = (list) => list.sort((a, b) => a.rate - b.rate)[Math.floor(list.length / 2)];
const rows = [];

function compare(name, ours, theirs, aim) {
  const own = [], peer = [];
  for (let round = 0; round < rounds; ++round) {
    own.push(ours(round));
    if (theirs) peer.push(theirs());
  }
  const row = { name, ...median(own), ...(theirs && { nginx: median(peer).rate, nginx_p99: median(peer).p99 }) };
  const ratio = row.nginx && row.rate / row.nginx;
  const reached = aim ? row.rate >= aim : ratio >= 0.5;
  console.log(`${name.padEnd(34)} ${row.rate.toFixed(0).padStart(7)}/s p99 ${row.p99.toFixed(2)} ms` +
    (row.nginx ? `; nginx ${row.nginx.toFixed(0)}/s p99 ${row.nginx_p99.toFixed(2)} ms; ratio ${ratio.toFixed(2)}` : '') +
    `; aim ${aim ? `${aim}/s` : '0.50 of nginx'}: ${reached ? 'ok' : 'MISSED'}`);
  rows.push(row);
}

/** A wrk script that posts the same tree with a seed that was never asked for. */
function cold_script(round) {
  const file = path.join(folder, `cold-${round}.lua`);
  const body = JSON.stringify(tree(3, 6, 123456789)).replaceAll('\\', '\\\\').replaceAll("'", "\\'");
  fs.writeFileSync(file, `local seed = ${(round + 1) * 10000000}
local body = '${body}'
wrk.method = 'POST'
wrk.headers['Content-Type'] = 'application/json'
request = function() seed = seed + 1; return wrk.format(nil, nil, nil, (body:gsub('123456789', tostring(seed)))) end`);
  return file;
}

const server = await serve(process.env.SEEDMESH_PROGRAM ?? 'build/release/seedmesh', ['--log-level', 'warn']);
const nginx = start_nginx();
try {
  const small = await tree_of(server, 50e3), large = await tree_of(server, 1e6);
  fs.writeFileSync(path.join(folder, 'small.glb'), small.answer.bytes);
  fs.writeFileSync(path.join(folder, 'large.glb'), large.answer.bytes);
  const link = small.answer.headers['content-location'];
  const near = `http://127.0.0.1:${nginx_port}`;
  const tag = await new Promise((resolve, reject) => {
    http.get(`${near}/small.glb`, (response) => { response.resume(); resolve(response.headers.etag); }).on('error', reject);
  });
  const size = (each) => `${(each.answer.bytes.length / 1e3).toFixed(0)} KB`;
  console.log(`one run, ${os.cpus().length} cores shared with wrk, load ${os.loadavg()[0].toFixed(1)} at the start`);
  compare('304 of a permalink, c=8', () => wrk(server.url + link, { connections: 8, headers: { 'If-None-Match': small.answer.headers.etag } }),
    () => wrk(`${near}/small.glb`, { connections: 8, headers: { 'If-None-Match': tag } }), 30000);
  for (const [each, file] of [[small, 'small.glb'], [large, 'large.glb']]) {
    for (const connections of [2, 32]) {
      compare(`${size(each)} from memory, c=${connections}`, () => wrk(server.url + each.answer.headers['content-location'], { connections }), () => wrk(`${near}/${file}`, { connections }));
    }
  }
  const offered = { 'Accept-Encoding': 'gzip, deflate, br, zstd' };
  for (const [each, file] of [[small, 'small.glb'], [large, 'large.glb']]) {
    compare(`${size(each)} compressed, c=32`, () => wrk(server.url + each.answer.headers['content-location'], { connections: 32, headers: offered }), () => wrk(`${near}/${file}`, { connections: 32, headers: offered }));
  }
  // A leaf of a world, beside the models: the token of the world is parsed for each request.
  const world = await server.generate({ generator: 'world', seed: 7 });
  const tile = world.headers['content-location'].replace(/[^/]*$/, 'c/14/8192/8192.glb'), leaf = await server.get(tile);
  if (leaf.status !== 200) throw new Error(`${tile}: ${leaf.status}`);
  fs.writeFileSync(path.join(folder, 'leaf.glb'), leaf.bytes);
  compare('304 of a tile, c=8', () => wrk(server.url + tile, { connections: 8, headers: { 'If-None-Match': leaf.headers.etag } }),
    () => wrk(`${near}/small.glb`, { connections: 8, headers: { 'If-None-Match': tag } }), 30000);
  compare(`tile of ${(leaf.bytes.length / 1e3).toFixed(0)} KB from memory, c=8`, () => wrk(server.url + tile, { connections: 8 }), () => wrk(`${near}/leaf.glb`, { connections: 8 }));
  await new Promise((resolve) => { setTimeout(resolve, 100); });  // lets the server notice the connections that wrk has closed
  const cold = await server.generate(tree(3, 6, 1));
  compare(`cold trees of ${(cold.bytes.length / 1e3).toFixed(0)} KB, c=8`, (round) => wrk(`${server.url}/v1/generate`, { connections: 8, script: cold_script(round) }), undefined, 1000);
  compare('the same, compression offered', (round) => wrk(`${server.url}/v1/generate`, { connections: 8, headers: offered, script: cold_script(round + rounds) }), undefined, 800);
} finally {
  nginx.kill();
  await server.stop();
  fs.rmSync(folder, { recursive: true, force: true });
}
fs.mkdirSync('build', { recursive: true });
fs.appendFileSync('build/bench.jsonl', rows.map((row) => `${JSON.stringify({ at: new Date().toISOString(), ...row })}\n`).join(''));
