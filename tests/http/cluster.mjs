#!/usr/bin/env node
// Three replicas behind HAProxy, nginx and Varnish, with the configuration that deploy/ ships: one is killed, all are restarted one by one,
// under load; and a Redis that dies while they share it.
// Cameras fly over a world through nginx and Varnish while a replica is killed.
//   cluster.mjs [seconds of each load] [haproxy, nginx, varnish or worlds alone]
import { execFileSync, spawn } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import zlib from 'node:zlib';
import { flights } from './flights.mjs';
import { ask, program, rehearsal, serve, sleep, until } from './support.mjs';

const seconds = Number(process.argv[2] ?? 6);
const front = Number(process.env.SEEDMESH_CLUSTER_PORT ?? 18131);
const deploy = path.resolve('deploy');
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-cluster-'));
fs.chmodSync(folder, 0o777);
const verdicts = [];
const check = (sound, sentence) => { verdicts.push(sound); console.log(`${sound ? 'ok    ' : 'BROKEN'} ${sentence}`); };
const children = new Set();

function start(command, args) {
  const log = fs.openSync(path.join(folder, `${path.basename(command)}.log`), 'a');
  const child = spawn(command, args, { stdio: ['ignore', log, log] });
  child.gone = new Promise((resolve) => { child.on('close', () => { children.delete(child); resolve(); }); });
  children.add(child);
  return child;
}
process.on('exit', () => { for (const child of children) child.kill('SIGKILL'); });

const there = (command) => { try { execFileSync('which', [command]); return true; } catch { return false; } };

/** The shipped file with our addresses in the place of its own, written where the program looks. */
function adapted(name, replicas, changes) {
  let text = fs.readFileSync(path.join(deploy, name), 'utf8');
  replicas.forEach((port, i) => { text = text.replaceAll(`seedmesh-${i + 1}:8080`, `127.0.0.1:${port}`); });
  for (const [from, to] of changes) {
    if (!text.includes(from)) throw new Error(`${name} has no ${from}`);
    text = text.replaceAll(from, to);
  }
  const file = path.join(folder, path.basename(name));
  fs.writeFileSync(file, text);
  return file;
}

const only = process.argv[3];
const balancers = {
  haproxy: (replicas) => start('haproxy', ['-db', '-f', adapted('haproxy/haproxy.cfg', replicas, [
    ['bind :8000', `bind 127.0.0.1:${front}`],
    ['default_backend seedmesh\n', 'default_backend seedmesh\n  http-response set-header X-Replica %s\n']])]),
  nginx: (replicas) => {
    fs.mkdirSync(path.join(folder, 'cache'), { recursive: true });
    return start('nginx', ['-p', folder, '-c', adapted('nginx/nginx.conf', replicas, [
      ['worker_processes auto;', `daemon off; ${process.getuid() === 0 ? 'user root;' : ''} worker_processes 2;`],
      ['/tmp/nginx.pid', path.join(folder, 'nginx.pid')],
      ['/var/cache/nginx', path.join(folder, 'cache')],
      ['listen 8000;', `listen 127.0.0.1:${front};`],
      // All clients of this test have one address.
      ['rate=200r/s', 'rate=100000r/s'],
      ['proxy_cache models;', 'proxy_cache models; proxy_cache_bypass $http_x_bypass; add_header X-Replica $upstream_addr always;'],
      ['  access_log off;', `  access_log off; client_body_temp_path ${folder}/body; proxy_temp_path ${folder}/proxy; fastcgi_temp_path ${folder}/f; uwsgi_temp_path ${folder}/u; scgi_temp_path ${folder}/s;`]])]);
  },
};

/** A replica that ends with us at the latest. */
async function replica_of(file, its_flags) {
  const server = await serve(file, its_flags);
  children.add(server.child);
  server.ended.then(() => children.delete(server.child));
  return server;
}

const flags = (port) => ['--port', String(port), '--threads', '2', '--queue', '64', '--drain-delay', '1.5', '--log-level', 'error'];
const through = { port: front };
const target = (seed, milliseconds = 5) => `/v1/presets/small.glb?seed=${seed}&milliseconds=${milliseconds}`;

/** Which replica answers each of 300 URLs. */
async function map_of_urls() {
  const map = [];
  for (let seed = 0; seed < 300; ++seed) {
    const answer = await ask(through, 'GET', target(seed, 0), { headers: { 'x-bypass': '1' } });
    map.push(answer.status === 200 ? String(answer.headers['x-replica']).split(', ').pop() : `status ${answer.status}`);
  }
  return map;
}

/** Clients that ask until `work` has ended; what failed, at once and after one more try. */
async function under_load(work, { clients = 8 } = {}) {
  let over = false, count = 0, tried_again = 0, seed = 0;
  const failed = [];
  const agent = new http.Agent({ keepAlive: true });
  const once = (number) => (number % 3 === 0
    ? ask(through, 'POST', '/v1/generate', { body: { generator: 'rehearsal', seed: number, parameters: { milliseconds: 20, bytes: 3000 } }, agent })
    : ask(through, 'GET', target(number, 20), { agent })).then((answer) => answer.status, (error) => error.code);
  const client = async () => {
    while (!over) {
      const number = ++seed;
      ++count;
      let status = await once(number);
      if (status === 200) continue;
      ++tried_again;
      status = await once(number);
      if (status !== 200) failed.push(status);
    }
  };
  const all = Array.from({ length: clients }, client);
  await work();
  over = true;
  await Promise.all(all);
  agent.destroy();
  return { count, tried_again, failed };
}

async function with_balancer(name) {
  if (!there(name)) { console.log(`${name} is not installed: ./dev setup cluster`); verdicts.push(false); return; }
  const ports = [];
  let replicas = [];
  for (let i = 0; i < 3; ++i) {
    const replica = await replica_of(rehearsal, flags(0).slice(2));
    ports.push(replica.port);
    replicas.push(replica);
  }
  const child = balancers[name](ports);
  const ready = async () => (await ask(through, 'GET', target(1)).catch(() => ({}))).status === 200;
  await until(ready);
  await sleep(1500);

  const first = await map_of_urls();
  const shares = ports.map((_, i) => first.filter((each) => each === [...new Set(first)].sort()[i]).length);
  check(new Set(first).size === 3 && Math.min(...shares) > 30, `${name}: 300 URLs are shared by three replicas (${shares.join('/')})`);
  check((await map_of_urls()).every((each, i) => each === first[i]), `${name}: equal URLs go to the same replica`);

  const before_death = await under_load(async () => {
    await sleep(seconds * 500);
    replicas[0].child.kill('SIGKILL');
    await sleep(seconds * 500 + 1500);
  });
  check(before_death.failed.length === 0, `${name}: kill -9 of one of three under load: ${before_death.failed.length} of ${before_death.count} requests failed for clients that try twice (${before_death.tried_again} tried again)`);
  const second = await map_of_urls();
  const dead = first.filter((each, i) => second[i] !== each), gone = new Set(dead);
  check(gone.size === 1 && !second.includes([...gone][0]) && dead.length === first.filter((each) => each === dead[0]).length, `${name}: exactly the ${dead.length} URLs of the dead one have moved`);
  replicas[0] = await replica_of(rehearsal, flags(ports[0]));
  await sleep(3000);  // until it is asked again
  check((await map_of_urls()).every((each, i) => each === first[i]), `${name}: back again, it has its own URLs`);

  const rolling = await under_load(async () => {
    for (let i = 0; i < 3; ++i) {
      const { status } = await replicas[i].stop();
      if (status !== 0) check(false, `${name}: a replica ends with ${status}`);
      replicas[i] = await replica_of(rehearsal, flags(ports[i]));
      await sleep(2500);
    }
    await sleep(seconds * 200);
  });
  check(rolling.tried_again === 0 && rolling.failed.length === 0, `${name}: rolling restart with drain under load: ${rolling.tried_again} of ${rolling.count} requests failed, without a second try`);

  if (name === 'nginx') {
    const models = async () => (await Promise.all(replicas.map((each) => each.metric('seedmesh_models_total')))).reduce((a, b) => a + b, 0);
    const before = await models();
    const { engine } = (await replicas[0].get('/version')).json;
    const token = zlib.deflateRawSync(JSON.stringify({ engine, generator: 'rehearsal', parameters: { bytes: 2000, milliseconds: 300 }, seed: 777_777 })).toString('base64url');
    const link = `/v1/models/${token}.glb`;
    const same = await Promise.all(Array.from({ length: 50 }, () => ask(through, 'GET', link)));
    const made = (await models()) - before;
    check(same.every((answer) => answer.status === 200) && made === 1, `nginx: 50 equal requests at once are made ${made} time(s) (${[...new Set(same.map((answer) => `${answer.status} ${answer.headers['x-cache']}`))]})`);
    check((await ask(through, 'GET', link)).headers['x-cache'] === 'HIT', 'nginx: what it has it does not ask for again');
    const again = await ask(through, 'GET', link, { headers: { 'if-none-match': same[0].headers.etag } });
    check(again.status === 304, `nginx: a client that has the model receives 304 (${again.status})`);
  }
  child.kill('SIGTERM');
  await child.gone;
  for (const replica of replicas) await replica.stop();
}

const start_varnish = (ports) => start('varnishd', ['-F', '-a', `127.0.0.1:${front}`, '-f',
  adapted('varnish/default.vcl', [], ports.map((port, i) => [`.host = "seedmesh-${i + 1}"; .port = "8080";`, `.host = "127.0.0.1"; .port = "${port}";`])),
  '-n', path.join(folder, 'varnish'), '-s', 'malloc,64m', '-T', 'none', '-p', 'timeout_idle=75']);

async function with_varnish() {
  if (!there('varnishd')) { console.log('varnish is not installed: ./dev setup cluster'); verdicts.push(false); return; }
  const replicas = [];
  for (let i = 0; i < 3; ++i) replicas.push(await replica_of(rehearsal, flags(0).slice(2)));
  const child = start_varnish(replicas.map(({ port }) => port));
  await until(async () => (await ask(through, 'GET', target(1)).catch(() => ({}))).status === 200);
  const models = async () => (await Promise.all(replicas.map((each) => each.metric('seedmesh_models_total')))).reduce((a, b) => a + b, 0);
  const before = await models();
  const { engine } = (await replicas[0].get('/version')).json;
  const link = `/v1/models/${zlib.deflateRawSync(JSON.stringify({ engine, generator: 'rehearsal', parameters: { bytes: 2000, milliseconds: 300 }, seed: 888_888 })).toString('base64url')}.glb`;
  const same = await Promise.all(Array.from({ length: 50 }, () => ask(through, 'GET', link)));
  const made = (await models()) - before;
  check(same.every((answer) => answer.status === 200) && made === 1, `varnish: 50 equal requests at once are made ${made} time(s)`);
  const again = await ask(through, 'GET', link, { headers: { 'if-none-match': same[0].headers.etag } });
  check(again.status === 304 && (await ask(through, 'GET', link)).headers['x-cache'] === 'HIT', 'varnish: a cached model is not requested again, and a client that has it receives 304');
  const posted = await ask(through, 'POST', '/v1/generate', { body: { generator: 'rehearsal', seed: 5 } });
  check(posted.status === 200 && (await ask(through, 'GET', '/metrics')).status === 404, 'varnish: what is posted passes, metrics do not');
  replicas[0].child.kill('SIGKILL');
  await sleep(2500);  // three probes
  let failed = 0;
  for (let seed = 0; seed < 60; ++seed) if ((await ask(through, 'GET', target(seed, 0))).status !== 200) ++failed;
  check(failed === 0, `varnish: with one of three dead ${failed} of 60 requests fail`);
  child.kill('SIGTERM');
  await child.gone;
  for (const replica of replicas.slice(1)) await replica.stop();
}

/** Fifty cameras over three replicas of the real program: one is killed while they fly. A client never asks again for a tile that failed. */
async function worlds_through(name, command, start_balancer) {
  if (!there(command)) { console.log(`${name} is not installed: ./dev setup cluster`); verdicts.push(false); return; }
  const replicas = [];
  for (let i = 0; i < 3; ++i) replicas.push(await replica_of(program, ['--threads', '1', '--log-level', 'error']));
  const child = start_balancer(replicas.map(({ port }) => port)), home = '/v1/worlds/temperate_land.7/';
  await until(async () => (await ask(through, 'GET', `${home}tileset.json`).catch(() => ({}))).status === 200);
  await sleep(1500);
  const { answers, times } = await flights(through, home, 50, async () => {
    await sleep(seconds * 1000);
    replicas[0].child.kill('SIGKILL');
    await sleep(seconds * 1000);
  });
  const others = [...answers].filter(([status]) => status !== 200 && status !== 304);
  const at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(0);
  check(others.length === 0 && answers.get(200) > 1000 && answers.get(304) > 0,
    `${name}: 50 cameras fly over a world while one of three replicas is killed: ${[...answers].map(([status, n]) => `${n} of ${status}`).join(', ')}; p50 ${at(0.5)} ms, p95 ${at(0.95)} ms`);
  child.kill('SIGTERM');
  await child.gone;
  for (const replica of replicas.slice(1)) await replica.stop();
}

async function same_bytes_everywhere() {
  const replicas = [];
  for (const threads of ['1', '2', '4']) replicas.push(await replica_of(program, ['--threads', threads, '--log-level', 'error']));
  const names = (await replicas[0].get('/v1/presets')).json.presets.map((each) => each.name).filter((_, i) => i % 15 === 0);
  let links = 0, unequal = 0;
  for (const name of names) {
    const made = await replicas[links % 3].get(`/v1/presets/${name}.glb?seed=5`);
    if (!made.headers['content-location']) continue;
    ++links;
    for (const replica of replicas) {
      const answer = await replica.get(made.headers['content-location']);
      if (!answer.bytes.equals(made.bytes) || answer.headers.etag !== made.headers.etag) ++unequal;
    }
  }
  for (const replica of replicas) await replica.stop();
  check(links > 3 && unequal === 0, `permalinks of one replica are answered by all with the same bytes (${links} links, ${unequal} differences)`);
}

async function shared_cache() {
  if (!there('redis-server')) { console.log('redis-server is not installed: ./dev setup cluster'); verdicts.push(false); return; }
  const socket = path.join(folder, 'redis.sock');
  const redis = start('redis-server', ['--port', '0', '--unixsocket', socket, '--save', '', '--appendonly', 'no', '--maxmemory', '64mb', '--maxmemory-policy', 'allkeys-lru', '--dir', folder]);
  await until(() => fs.existsSync(socket));
  const replicas = [];
  for (let i = 0; i < 2; ++i) replicas.push(await replica_of(rehearsal, ['--threads', '2', '--redis-url', `unix://${socket}`, '--log-level', 'error']));
  for (const replica of replicas) await until(async () => (await replica.metric('seedmesh_shared_cache_connections')) === 4);
  for (let seed = 0; seed < 200; ++seed) await replicas[0].get(target(seed, 0));
  await until(async () => (await replicas[0].metric('seedmesh_shared_cache_writes_total')) === 200);
  const made = await replicas[0].get(target(3, 0));
  const begun = performance.now();
  for (let seed = 0; seed < 200; ++seed) await replicas[1].get(target(seed, 0));
  const each = (performance.now() - begun) / 200;
  const found = await replicas[1].get(target(3, 0));
  check((await replicas[1].metric('seedmesh_models_total')) === 0 && found.bytes.equals(made.bytes), `redis: 200 models of one replica are found by another, ${each.toFixed(2)} ms each`);
  let failed = 0, count = 0, longest = 0;
  const end = Date.now() + 3000;
  setTimeout(() => redis.kill('SIGKILL'), 1000);
  while (Date.now() < end) {
    const asked = performance.now();
    if ((await replicas[count % 2].get(target(10_000 + count++, 0))).status !== 200) ++failed;
    longest = Math.max(longest, performance.now() - asked);
  }
  check(failed === 0 && longest < 500, `redis: kill -9 under load: ${failed} of ${count} requests failed, the longest took ${longest.toFixed(0)} ms`);
  for (const replica of replicas) await replica.stop();
}

try {
  await same_bytes_everywhere();
  for (const name of Object.keys(balancers)) if (!only || only === name) await with_balancer(name);
  if (!only || only === 'varnish') await with_varnish();
  if (!only || only === 'worlds') {
    await worlds_through('nginx', 'nginx', balancers.nginx);
    await worlds_through('varnish', 'varnishd', start_varnish);
  }
  if (only !== 'worlds') await shared_cache();
} catch (error) {
  check(false, `nothing unforeseen: ${error.stack}`);
} finally {
  for (const child of children) child.kill('SIGKILL');
  if (verdicts.every(Boolean)) fs.rmSync(folder, { recursive: true, force: true }); else console.log(`logs are in ${folder}`);
}
const failed = verdicts.filter((sound) => !sound).length;
console.log(`${verdicts.length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
