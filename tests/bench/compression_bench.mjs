#!/usr/bin/env node
// CPU time of the server for all presets, each once, for clients that offer no coding, zstd, gzip or br. One worker, no cache of
// models, textures warm. Beside it, nginx sends the same files with gzip of level 1. The CPU time counts, so other work on the machine
// disturbs little. Usage: compression_bench.mjs [rounds]
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import { serve, sleep } from '../http/support.mjs';

const rounds = Number(process.argv[2] ?? 1);
const aims = { identity: 1, zstd: 1.2, br: 1.4, gzip: 1.5 };
const offers = { identity: '', zstd: 'zstd', br: 'br', gzip: 'gzip', 'gzip, deflate, br': 'gzip, deflate, br', 'gzip, deflate, br, zstd': 'gzip, deflate, br, zstd' };

/** The seconds of CPU time of a process and its children. */
function cpu_of_tree(pid) {
  const ticks = (id) => fs.readFileSync(`/proc/${id}/stat`, 'latin1').replace(/^.*\) /s, '').split(' ').slice(11, 13).reduce((sum, each) => sum + Number(each), 0);
  const children = fs.readFileSync(`/proc/${pid}/task/${pid}/children`, 'utf8').trim().split(' ').filter(Boolean);
  return [pid, ...children].reduce((sum, id) => sum + ticks(id), 0) / 100;
}

/** The bytes of an answer as they are sent. */
function fetched(port, file, accept) {
  return new Promise((resolve, reject) => {
    http.get({ port, path: file, headers: accept ? { 'accept-encoding': accept } : {} }, (response) => {
      let bytes = 0;
      response.on('data', (piece) => { bytes += piece.length; });
      response.on('end', () => resolve({ status: response.statusCode, bytes }));
    }).on('error', reject);
  });
}

/** CPU time of nginx for the files of a folder, without coding and with gzip. */
async function nginx_times(folder, files) {
  const port = Number(process.env.SEEDMESH_BENCH_PORT ?? 18112);
  fs.writeFileSync(path.join(folder, 'nginx.conf'), `daemon off; worker_processes 1; pid ${folder}/pid; error_log /dev/null; events { worker_connections 64; }
http { access_log off; gzip on; gzip_types *; gzip_comp_level 1; gzip_min_length 1000; sendfile on; keepalive_requests 100000; client_body_temp_path ${folder}; proxy_temp_path ${folder};
  fastcgi_temp_path ${folder}; uwsgi_temp_path ${folder}; scgi_temp_path ${folder}; server { listen 127.0.0.1:${port}; root ${folder}; } }`);
  const nginx = spawn('nginx', ['-c', path.join(folder, 'nginx.conf'), '-p', folder], { stdio: 'ignore' });
  let failed = false;
  nginx.on('error', () => { failed = true; });
  try {
    await sleep(500);
    if (failed) return console.log('nginx: not installed, left out');
    for (const accept of ['', 'gzip']) {
      const before = cpu_of_tree(nginx.pid);
      let bytes = 0;
      for (const file of files) bytes += (await fetched(port, `/${file}`, accept)).bytes;
      console.log(`nginx, ${(accept || 'identity').padEnd(17)} ${(cpu_of_tree(nginx.pid) - before).toFixed(2)} s of CPU time for the same files, ${(bytes / 1e6).toFixed(0)} MB sent`);
    }
  } finally {
    nginx.kill();
  }
}

const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-compression-'));
const server = await serve(process.env.SEEDMESH_PROGRAM ?? 'build/release/seedmesh', ['--threads', '1', '--cache-bytes', '0', '--texture-bytes', '1GiB', '--log-level', 'warn']);
try {
  let presets = (await server.get('/v1/presets')).json.presets.map((each) => each.name);
  const cpu = () => server.metric('process_cpu_seconds_total');
  const made = new Set();
  for (const name of presets) {
    const answer = await server.get(`/v1/presets/${name}.glb`);
    if (answer.status !== 200) continue;
    made.add(name);
    fs.writeFileSync(path.join(folder, `${name}.glb`), answer.bytes);
  }
  for (const name of presets) if (!made.has(name)) console.log(`left out, because it cannot be made: ${name}`);
  presets = presets.filter((name) => made.has(name));
  const sums = new Map();
  for (let round = 0; round < rounds; ++round) {
    for (const [name, accept] of Object.entries(offers)) {
      const sum = sums.get(name) ?? { seconds: 0, bytes: 0, coded: 0 };
      const before = await cpu();
      for (const preset of presets) {
        const answer = await server.get(`/v1/presets/${preset}.glb`, accept ? { 'accept-encoding': accept } : {});
        if (answer.status !== 200) throw new Error(`${preset}: ${answer.status}`);
        sum.bytes += answer.bytes.length;
        sum.coded += answer.headers['content-encoding'] ? 1 : 0;
      }
      sum.seconds += (await cpu()) - before;
      sums.set(name, sum);
    }
  }
  const base = sums.get('identity');
  for (const [name, { seconds, bytes, coded }] of sums) {
    const ratio = seconds / base.seconds, aim = aims[name];
    console.log(`${name.padEnd(24)} ${(seconds / rounds).toFixed(2)} s of CPU time, ${ratio.toFixed(2)} of identity, ${(bytes / rounds / 1e6).toFixed(0)} MB sent, ${coded / rounds} of ${presets.length} compressed` +
      (aim && aim > 1 ? `; aim ${aim}: ${ratio <= aim ? 'ok' : 'MISSED'}` : ''));
  }
  await nginx_times(folder, presets.map((name) => `${name}.glb`));
} finally {
  await server.stop();
  fs.rmSync(folder, { recursive: true, force: true });
}
