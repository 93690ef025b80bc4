#!/usr/bin/env node
// Overload, then a long time of random requests: valid ones from the presets with drawn values, the same with something spoilt, and
// hostile ones. No crash, no hang, no growth, no 500.
//   soak.mjs [seconds of random requests] [seconds of overload] [seed]
import os from 'node:os';
import { ask, program, raw, rehearsal, serve, sleep } from './support.mjs';

const seconds = Number(process.argv[2] ?? 30), overload_seconds = Number(process.argv[3] ?? 10);
let state = Number(process.argv[4] ?? 1) | 1;
const draw = () => { state ^= state << 13; state ^= state >>> 17; state ^= state << 5; return (state >>> 0) / 2 ** 32; };
const below = (n) => Math.floor(draw() * n);
const one_of = (list) => list[below(list.length)];
const quantile = (list, share) => list.sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(list.length * share))];
const verdicts = [];
const check = (sound, sentence) => { verdicts.push(sound); console.log(`${sound ? 'ok    ' : 'BROKEN'} ${sentence}`); };

// --- Overload: ten times as many requests as the workers can do ----------------------------------------------------------------------

async function overload() {
  const work = 40, threads = 2, queue = 8, capacity = threads / (work / 1000);
  const server = await serve(rehearsal, ['--threads', String(threads), '--queue', String(queue), '--connections', '4096', '--cache-bytes', '0', '--log-level', 'error']);
  const one = async (number) => {
    const begun = performance.now();
    const answer = await ask(server, 'POST', '/v1/generate', { body: { generator: 'rehearsal', seed: number, parameters: { milliseconds: work, bytes: 20_000 } } }).catch((error) => ({ status: error.code, headers: {} }));
    return { status: answer.status, milliseconds: performance.now() - begun, retry: Number(answer.headers['retry-after']) };
  };
  const calm = [];
  for (let i = 0; i < 10; ++i) calm.push((await one(i)).milliseconds);
  // Others that want this machine's cores take their share of the time.
  const busy = Math.max(1, os.loadavg()[0] / os.cpus().length), at_once = 100 * busy, soon = 50 * busy;
  if (busy > 1.5) console.log(`this machine has ${busy.toFixed(1)} times as much to do as cores to do it: times are judged by that`);
  const before = await server.metric('process_resident_memory_bytes');
  const pending = [], health = [];
  const begun = performance.now(), every = 1000 / (10 * capacity);
  let number = 0, most_memory = before;
  const watch = setInterval(async () => {
    const asked = performance.now();
    await server.get('/healthz');
    health.push(performance.now() - asked);
    most_memory = Math.max(most_memory, await server.metric('process_resident_memory_bytes'));
  }, 200);
  while (performance.now() - begun < overload_seconds * 1000) {
    while (number < (performance.now() - begun) / every) pending.push(one(1000 + number++));
    await sleep(2);
  }
  clearInterval(watch);
  const answers = await Promise.all(pending);
  await server.stop();
  const accepted = answers.filter((answer) => answer.status === 200), refused = answers.filter((answer) => answer.status === 429);
  const late = quantile(accepted.map((answer) => answer.milliseconds), 0.99), quick = quantile(refused.map((answer) => answer.milliseconds), 0.95);
  // A request that was accepted waits for at most the whole queue before it.
  const bound = 3 * ((queue / threads + 1) * quantile(calm, 0.9)) + 50;
  console.log(`overload: ${answers.length} requests in ${overload_seconds} s at ${(10 * capacity).toFixed(0)}/s to a capacity of ${capacity.toFixed(0)}/s: ${accepted.length} accepted, 99 % within ${late.toFixed(0)} ms (alone ${quantile(calm, 0.5).toFixed(0)} ms); ${refused.length} refused, 95 % within ${quick.toFixed(0)} ms; health 95 % ${quantile(health, 0.95).toFixed(0)} ms; memory ${(before / 1e6).toFixed(0)} -> at most ${(most_memory / 1e6).toFixed(0)} MB`);
  check(accepted.length + refused.length === answers.length, `every request is answered 200 or 429 (${[...new Set(answers.map((answer) => answer.status))]})`);
  check(accepted.length > 0.6 * capacity * overload_seconds, 'the workers go on at no less than six tenths of their capacity');
  check(late < bound, `accepted requests keep their latency (below ${bound.toFixed(0)} ms)`);
  check(refused.every((answer) => answer.retry >= 1) && quick < at_once, `the rest is refused at once, with Retry-After (below ${at_once.toFixed(0)} ms)`);
  check(quantile(health, 0.95) < soon, `health answers at once (below ${soon.toFixed(0)} ms)`);
  check(most_memory < before * 1.5 + 20e6, 'memory is bounded');
}

// --- Random requests ----------------------------------------------------------------------------------------------------------------

/** A request with something drawn, or something broken, at some place. */
function changed(value, harm) {
  if (Array.isArray(value)) return value.length && draw() < 0.7 ? value.map((each, i) => (i === below(value.length) ? changed(each, harm) : each)) : harm ? one_of([[], [null], value.concat(value)]) : value;
  if (value && typeof value === 'object') {
    const key = one_of(Object.keys(value));
    if (key === undefined) return harm ? { colour: 'red' } : value;
    if (harm && draw() < 0.15) return { ...value, [one_of([`${key}x`, '', 'constructor', '__proto__'])]: 1 };
    return { ...value, [key]: changed(value[key], harm) };
  }
  if (!harm) return typeof value === 'number' && key_of_number(value) ? value * (0.8 + 0.4 * draw()) : value;
  return one_of([null, true, -1, 0, 1e308, -1e-308, 2 ** 53, 'x', '', '\u0000', 'F'.repeat(10_000), [], {}, value, '[[[[[', 'A(((', '😀']);
}
const key_of_number = (value) => Number.isFinite(value) && !Number.isInteger(value);

function hostile(server, text) {
  const head = (length) => `POST ${one_of(['/v1/generate', '/v1/derive', '/v1/validate'])} HTTP/1.1\r\nHost: here\r\nContent-Length: ${length}\r\n\r\n`;
  return one_of([
    () => raw(server, head(text.length) + text.slice(0, below(text.length)), { wait: 500, half_close: true }),
    () => raw(server, `GET /${'a'.repeat(below(9000))} HTTP/1.1\r\nHost: here\r\n\r\n`, { wait: 500, half_close: true }),
    () => raw(server, Buffer.from(Array.from({ length: below(2000) }, () => below(256))), { wait: 500, half_close: true }),
    () => raw(server, `${head(4)}{}\r\n${head(2)}{}`, { wait: 500, half_close: true }),
    () => ask(server, 'GET', `/v1/models/${Buffer.from(Array.from({ length: 1 + below(300) }, () => below(256))).toString('base64url')}.glb`),
    () => ask(server, 'POST', '/v1/generate', { body: '['.repeat(below(100_000)) }),
    () => ask(server, 'POST', '/v1/generate', { body: { generator: 'lsystem', seed: below(1e6), parameters: { axiom: 'A', productions: ['A -> AAAAAAAA'], iterations: 100 } } }),
    () => ask(server, 'POST', '/v1/generate', { body: { generator: 'terrain', parameters: { resolution: 1e9 } } }),
    () => ask(server, 'GET', `/v1/presets/${encodeURIComponent(text.slice(0, 50))}.glb?seed=${encodeURIComponent(text.slice(0, 20))}`),
  ])();
}

async function random_requests() {
  const server = await serve(program, ['--threads', '2', '--queue', '16', '--cache-bytes', '32MiB', '--texture-bytes', '16MiB', '--time-limit', '5', '--max-memory', '256MiB', '--head-timeout', '1', '--body-timeout', '1', '--log-level', 'error']);
  const presets = (await server.get('/v1/presets')).json.presets.map((each) => each.name);
  const wholes = [];
  for (const name of presets) wholes.push((await server.get(`/v1/presets/${name}`)).json);
  const statuses = new Map(), memory = [], ages = [];
  const end = Date.now() + seconds * 1000, begun = Date.now();
  let count = 0, open = 0, longest = 0;
  const once = async () => {
    const request = { ...one_of(wholes), seed: below(1000) };
    const kind = draw();
    const route = one_of(['/v1/generate', '/v1/generate', '/v1/generate', '/v1/derive', '/v1/validate']);
    if (kind < 0.4) return ask(server, 'POST', route, { body: changed(request, false), headers: one_of([{}, { 'accept-encoding': one_of(['gzip', 'br', 'zstd', '*']) }, { accept: 'text/event-stream' }]) });
    if (kind < 0.75) return ask(server, 'POST', route, { body: changed(changed(request, true), draw() < 0.5) });
    return hostile(server, JSON.stringify(request));
  };
  const client = async () => {
    while (Date.now() < end) {
      ++count;
      ++open;
      const started = Date.now();
      const answer = await once().catch((error) => ({ status: error.code ?? String(error) }));
      longest = Math.max(longest, Date.now() - started);
      --open;
      const status = answer.status ?? 'raw';
      statuses.set(status, (statuses.get(status) ?? 0) + 1);
    }
  };
  const watch = setInterval(async () => {
    const bytes = await server.metric('process_resident_memory_bytes').catch(() => 0);
    if (bytes) { memory.push(bytes); ages.push((Date.now() - begun) / 1000); }
  }, 500);
  await Promise.all(Array.from({ length: 8 }, client));
  clearInterval(watch);
  await sleep(3000);
  const final = await server.metric('process_resident_memory_bytes').catch(() => 0);
  const files = await server.metric('process_open_fds').catch(() => 0), busy = await server.metric('seedmesh_workers_busy').catch(() => -1);
  const { status } = await server.stop();
  // What was reached in the first third is what the service needs; from then on it must not grow.
  const settled = memory.filter((_, i) => ages[i] < seconds / 3 || i < 4), later = memory.filter((_, i) => ages[i] > (2 * seconds) / 3);
  const ratio = quantile(later, 0.5) / quantile(settled, 0.9);
  console.log(`soak: ${count} requests in ${seconds} s; ${[...statuses].sort().map(([key, n]) => `${key}: ${n}`).join(', ')}; the longest took ${(longest / 1000).toFixed(1)} s; memory first third 90 % ${(quantile(settled, 0.9) / 1e6).toFixed(0)} MB, last third median ${(quantile(later, 0.5) / 1e6).toFixed(0)} MB, at most ${(Math.max(...memory) / 1e6).toFixed(0)} MB, at the end ${(final / 1e6).toFixed(0)} MB; ${files} descriptors`);
  check(final > 0 && status === 0, `the service lives on, and ends with 0 (${status})`);
  check(!statuses.has(500), 'no request is answered 500');
  check(![...statuses.keys()].some((key) => ['ECONNREFUSED', 'ECONNRESET', 'EPIPE'].includes(key)), 'no accepted request is lost');
  check(open === 0 && longest < 30_000 && busy === 0, 'nothing hangs, which would be six times the time limit');
  // In less than a minute caches are still being filled.
  check(ratio < (seconds >= 60 ? 1.25 : 2), `memory does not grow (${ratio.toFixed(2)})`);
  check(files < 40, 'no descriptor is left open');
  if (server.stderr) console.log(server.stderr.slice(-3000));
}

await overload();
await random_requests();
const failed = verdicts.filter((sound) => !sound).length;
console.log(`${verdicts.length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
