#!/usr/bin/env node
// Runs known attacks on HTTP servers against the program, one after another. During each, a well-behaved
// client requests a cached model and /healthz. Afterwards the process must have released the memory.
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import crypto from 'node:crypto';
import path from 'node:path';
import { ask, program, serve, sleep } from './support.mjs';

const seconds = Number(process.argv[2] ?? 5), only = process.argv[3] ?? '';
const attackers = path.join(path.dirname(new URL(import.meta.url).pathname), 'attackers.mjs');
const most_milliseconds = 50;
/** After an attack, the heap may keep free pages of the threads that served it: measured 12 MB, the same after one attack as after twelve. */
const most_kept = 20 * 2 ** 20;
const preset = 'abop_1_24a';

const quantile = (list, share) => list.sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(list.length * share))];

/** What the good client sees until `ended`; each request on a connection of its own. */
async function good_client(server, ended) {
  const times = [], statuses = new Map();
  let over = false, turn = 0;
  ended.then(() => { over = true; });
  while (!over) {
    const target = ['/healthz', `/v1/presets/${preset}.glb`][turn++ % 2];
    const begun = performance.now();
    const status = await ask(server, 'GET', target, { headers: { connection: 'close', 'x-api-key': key } }).then((answer) => answer.status, (error) => error.code);
    times.push(performance.now() - begun);
    statuses.set(status, (statuses.get(status) ?? 0) + 1);
    await sleep(10);
  }
  return { times, statuses };
}

const resident = (server) => server.metric('process_resident_memory_bytes');

/** The least that is seen within twelve seconds, or what is `enough`: what the process needs, not what it was about to give back. */
async function settled(server, enough = 0) {
  let least = Infinity;
  for (let i = 0; i < 48 && least > enough; ++i) {
    least = Math.min(least, await resident(server));
    await sleep(250);
  }
  return least;
}

/** The formula of docs/operating.md: bytes beside the program itself. */
const mebibyte = 2 ** 20, most_memory = (2 * 256 + 128 + 16 + 8 + 256) * mebibyte;

// Guessing is tested against a service that requires signatures; its well-behaved client has a key.
const key = 'the key of the good client', guessing = 'guesses at signatures';
const closed = ['--api-keys', `good:${crypto.createHash('sha256').update(key).digest('hex')}`, '--signing-keys', `a:${crypto.randomBytes(32).toString('hex')}`];
const server = await serve(program, ['--threads', '2', '--connections', '512', '--head-timeout', '2', '--body-timeout', '2', '--idle-timeout', '3', '--write-timeout', '2', '--min-rate-grace', '2', '--memory-in-flight', '128MiB', '--max-output', '128MiB', '--cache-bytes', '16MiB', '--texture-bytes', '8MiB', '--time-limit', '5', '--max-memory', '256MiB', '--log-level', 'error', ...(only === guessing ? closed : [])]);
const own = { 'x-api-key': key };
const presets = (await server.get('/v1/presets')).json.presets;
// The memory at the start is that of a server that has run the code of every generator and filled its cache.
for (const each of presets) await server.get(`/v1/presets/${each.name}.glb`, own);
const made = await server.get(`/v1/presets/${preset}.glb`, own);
const permalink = made.headers['content-location'].split('?')[0];

const start = await settled(server);
console.log(`at the start ${(start / 1e6).toFixed(0)} MB are resident`);

const verdicts = [];
const names = JSON.parse(execFileSync(process.execPath, [attackers, '--list'])).filter((name) => (only ? name.includes(only) : name !== guessing));
for (const name of names) {
  const { times: calm } = await good_client(server, sleep(1000));
  // On a machine too busy to answer quickly even without an attack, the median counts. It may be three times
  // the value measured just before.
  const busy = quantile(calm, 0.95) > most_milliseconds / 2;
  const allowed = busy ? Math.max(most_milliseconds, 3 * quantile(calm, 0.5)) : most_milliseconds;
  const child = spawn(process.execPath, [attackers, name, String(server.port), String(seconds), preset, permalink], { stdio: ['ignore', 'pipe', 'inherit'] });
  let out = '';
  child.stdout.on('data', (bytes) => { out += bytes; });
  const ended = new Promise((resolve) => { child.on('close', resolve); });
  await sleep(300);
  let peak = 0;
  const watching = setInterval(() => { resident(server).then((bytes) => { peak = Math.max(peak, bytes); }, () => {}); }, 250);
  const { times, statuses } = await good_client(server, ended);
  clearInterval(watching);
  const after = await settled(server, start + most_kept);
  const late = quantile(times, busy ? 0.5 : 0.95), bad = [...statuses].filter(([status]) => status !== 200);
  const growth = after / start, got = out ? JSON.parse(out) : { connections: 0, sent: 0, statuses: {} };
  const sound = out && late <= allowed && bad.length === 0 && after <= start + most_kept && peak <= start + most_memory;
  verdicts.push(sound);
  console.log(`${sound ? 'ok    ' : 'BROKEN'} ${name}: good client median ${quantile(times, 0.5).toFixed(1)} ms, 95 % ${quantile(times, 0.95).toFixed(1)} ms, worst ${Math.max(...times).toFixed(0)} ms, ${times.length} asked ${busy ? ` (busy machine: median judged, ${allowed.toFixed(0)} ms allowed; calm median ${quantile(calm, 0.5).toFixed(1)}, 95 % ${quantile(calm, 0.95).toFixed(1)})` : ''}` +
    `${bad.length ? `, ${bad.map(([status, count]) => `${count} x ${status}`).join(', ')}` : ''}; memory at most ${(peak / 1e6).toFixed(0)} MB, then ${growth.toFixed(2)} of the start;` +
    ` attackers: ${got.connections} connections, ${(got.sent / 1e6).toFixed(1)} MB, answers ${JSON.stringify(got.statuses)}`);
}
const alive = (await server.get('/healthz')).status === 200;
const { status } = await server.stop();
verdicts.push(alive && status === 0);
if (!alive || status !== 0) console.log(`BROKEN the service lives on and ends with 0: it ended with ${status}\n${server.stderr.slice(-2000)}`);
if (!only) {  // runs separately, because it needs keys
  const { status: guessed, stdout } = spawnSync(process.execPath, [process.argv[1], String(seconds), guessing], { encoding: 'utf8' });
  verdicts.push(guessed === 0);
  console.log(stdout.split('\n').filter((line) => line.includes(guessing)).join('\n'));
}
const failed = verdicts.filter((sound) => !sound).length;
console.log(`${verdicts.length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
