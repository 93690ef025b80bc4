#!/usr/bin/env node
// CPU time of the server for all presets, each once, for clients that offer no coding, zstd, gzip or br. One worker, no cache of
// models, textures warm. The CPU time counts, so other work on the machine disturbs little. Usage: compression_bench.mjs [rounds]
import { serve } from '../http/support.mjs';

const rounds = Number(process.argv[2] ?? 1);
const aims = { identity: 1, zstd: 1.2, br: 1.4, gzip: 1.5 };
const offers = { identity: '', zstd: 'zstd', br: 'br', gzip: 'gzip', 'gzip, deflate, br': 'gzip, deflate, br', 'gzip, deflate, br, zstd': 'gzip, deflate, br, zstd' };

const server = await serve(process.env.SEEDMESH_PROGRAM ?? 'build/release/seedmesh', ['--threads', '1', '--cache-bytes', '0', '--texture-bytes', '1GiB', '--log-level', 'warn']);
try {
  let presets = (await server.get('/v1/presets')).json.presets.map((each) => each.name);
  const cpu = () => server.metric('process_cpu_seconds_total');
  const made = new Set();
  for (const name of presets) if ((await server.get(`/v1/presets/${name}.glb`)).status === 200) made.add(name);
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
} finally {
  await server.stop();
}
