#!/usr/bin/env node
// Runs the benchmarks of build/release and their peers, most of them three times in turn, and prints a table
// of the medians. Also appends the results to build/bench.jsonl, one per line, so that two commits can be
// compared. Usage: bench.mjs [words of a name]. SEEDMESH_STORE_COLD=1 stores the table of `cold` as that of a release.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { print_cold } from './cold.mjs';

const words = process.argv[2] ?? '';
const build = 'build/release';
/** How often each program runs; seconds of work need no repetition for the sake of start-up. */
const launches = 3, launches_of = { scene: 1, city: 1 };

// Targets: the figures of the best known engine, measured on comparable hardware.
const aims = {
  'D0L bush n=7': { rate: 430e6, over_peer: 5 },
  'D0L bush n=8': { rate: 430e6, over_peer: 5 },
  'parametric tree 2.6a n=19': { rate: 25e6 },
  'context signal': { rate: 200e6 },
  'Tajic A n=14, lines': { seconds: 0.3 },
  'Tajic B n=14, lines': { seconds: 0.3 },
  // Terrain: total seconds.
  'diamond-square 4097': { seconds: 0.06 },
  'fBm of 8 octaves 1025': { seconds: 30e-9 * 1025 * 1025 },
  '65536 droplets 513': { seconds: 0.2 },
  'RTIN 1025 at .002': { seconds: 0.025 },
  'greedy 1025 at .002': { seconds: 0.35 },
  'diamond-square 4097 to GLB': { seconds: 0.3 },
  'chaos game, 1 thread': { rate: 100e6 },
  'Menger 4, 1 thread': { seconds: 0.04 },
  'Menger 5, 1 thread': { seconds: 0.4 },
  'tree to GLB: 20,000 triangles': { seconds: 0.001 },
  // Pictures of 512 pixels: seconds of one thread.
  'picture of a birch': { seconds: 0.05 },
  // Scenes: positions per second, or total seconds.
  'Poisson disk': { rate: 1e6 },
  '1 M placements as list': { seconds: 3 },
  '100,000 trees on 1025 x 1025 for the web': { seconds: 2, megabytes: 10 },
  'one growth step of 50 trees': { seconds: 0.05 },
  'memory: 100,000 trees as nodes': { ratio: 2 },
  'memory: 100,000 trees for the web': { ratio: 2 },
  'memory: 1 M placements as list': { ratio: 2 },
  // Cities: total seconds.
  'city plan of 1 km2': { seconds: 0.01 },
  'city plan of 16 km2': { seconds: 0.15 },
  'city plan of 144 km2': { seconds: 2 },
  'plan of 16 km2, recursive: growth and graph': { seconds_each: 7e-6 },
  'plan of 16 km2, recursive: blocks': { seconds_each: 20e-6 },
  'plan of 16 km2, recursive: lots and houses': { seconds_each: 2e-6 },
  'plan of 16 km2, skeleton: lots and houses': { seconds_each: 10e-6 },
  'grades of 9 km2': { seconds_each: 0.3e-6 },
  'city of 16 km2 to GLB': { seconds: 3, megabytes: 60 },
  'city of 26,000 houses to GLB': { seconds: 2, triangles: 3e6 },
  // Worlds: seconds of one thread, tiles per second.
  'tile of ground and water, p50': { seconds: 0.005 },
  'leaf with plants and houses, p50': { seconds: 0.008, megabytes: 0.04 },
  'leaf with plants and houses, p99': { seconds: 0.03 },
  'first leaf of a region': { seconds: 0.12 },
  'first picture of a replica': { seconds: 1 },
  'tiles of a flight': { rate: 150 },
  'samples of noise with gullies': { rate: 1e6 / 0.6 },
  'nested tileset of level 4, p50': { seconds: 0.008 },
  'nested tileset of level 8, p50': { seconds: 0.008 },
  'nested tileset of level 12, p50': { seconds: 0.008 },
};
/** The programs that print figures, a line each, and what runs beside them. */
const figures = { lsystem: 'lindenmayer', request: null, terrain: 'terrain', fractal: 'manifold', tree: 'ez_tree', scene: 'scene', city: null, world: null, picture: null };
const chosen = Object.keys(figures).filter((bench) => bench.includes(words));
const nanoseconds_per_triangle = 30;
const memory_ratio = 1.5;

function output_of(command, ...args) {
  if (!fs.existsSync(command) && command !== process.execPath) return '';
  const result = spawnSync(command, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'], maxBuffer: 1 << 26 });
  if (result.status !== 0) throw new Error(`${command} ended with ${result.status ?? result.signal}`);
  return result.stdout;
}

const lines_of = (text) => text.split('\n').filter((line) => line.startsWith('{')).map((line) => JSON.parse(line));

function median(values) {
  return values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
}

/** name -> one row whose seconds are the median of all launches. */
function gathered(rows) {
  const by_name = new Map();
  for (const row of rows) by_name.set(row.name, [...(by_name.get(row.name) ?? []), row]);
  return new Map([...by_name].map(([name, all]) => [name, { ...all[0], seconds: median(all.map((row) => row.seconds ?? 0)) }]));
}

function verdict(reached) {
  return reached ? 'ok' : 'MISSED';
}

/** `copying`: bytes a second that memcpy moves. */
function print_rate(row, peer, copying) {
  const rate = row.amount / row.seconds;
  const aim = aims[row.name];
  const cells = [row.name.padEnd(44), rate < 1e5 ? `${rate.toPrecision(3).padStart(9)} ${row.unit}/s` : `${(rate / 1e6).toFixed(1).padStart(9)} M ${row.unit}/s`];
  if (row.unit === 'triangles') {
    const each = (row.seconds / row.amount) * 1e9;
    cells.push(`${each.toFixed(1)} ns a triangle (aim ${nanoseconds_per_triangle}): ${verdict(each <= nanoseconds_per_triangle)}`);
  }
  if (aim?.rate) cells.push(`aim ${aim.rate < 1e5 ? aim.rate : `${aim.rate / 1e6} M`}: ${verdict(rate >= aim.rate)}`);
  if (!aim?.seconds && rate < 1e5) cells.push(`${(row.seconds * 1e3).toFixed(1)} ms`);
  if (aim?.seconds) cells.push(`${(row.seconds * 1e3).toFixed(1)} ms (aim ${(aim.seconds * 1e3).toFixed(0)}): ${verdict(row.seconds <= aim.seconds)}`);
  if (aim?.seconds_each) {
    const each = row.seconds / row.amount;
    cells.push(`${(each * 1e6).toFixed(2)} us each (aim ${aim.seconds_each * 1e6}): ${verdict(each <= aim.seconds_each)}`);
  }
  if (row.cores) cells.push(`${(row.cores * 1e3).toFixed(1)} ms of all cores`);
  if (aim?.megabytes) cells.push(`${(row.bytes / 1e6).toFixed(1)} MB (aim ${aim.megabytes}): ${verdict(row.bytes <= aim.megabytes * 1e6)}`);
  if (aim?.triangles) cells.push(`${(row.triangles / 1e6).toFixed(2)} M triangles (aim ${aim.triangles / 1e6}): ${verdict(row.triangles <= aim.triangles)}`);
  if (row.bytes && copying) cells.push(`${(row.seconds / (row.bytes / copying)).toFixed(1)} times copying`);
  if (peer) {
    const ratio = rate / (peer.amount / peer.seconds);
    const its = peer.amount / peer.seconds;
    cells.push(`npm ${peer.peer ?? peer.package ?? 'lindenmayer'} ${its < 1e5 ? its.toPrecision(3) : `${(its / 1e6).toFixed(1)} M`}, ratio ${ratio.toFixed(1)}: ${verdict(ratio >= (aim?.over_peer ?? 0))}`);
  }
  console.log(cells.join('  '));
  return { ...row, rate, peer_rate: peer && peer.amount / peer.seconds };
}

function print_memory(row) {
  const ratio = row.peak_less_idle / row.amount, most = aims[row.name]?.ratio ?? memory_ratio;
  console.log(`${row.name.padEnd(44)}  ${(row.amount / 1e6).toFixed(1)} MB out, peak less idle ${(row.peak_less_idle / 1e6).toFixed(1)} MB, ` +
    `ratio ${ratio.toFixed(2)} (aim ${most}): ${verdict(ratio <= most)}`);
  return { ...row, ratio };
}

/** A peer that does not run here does not keep our own figures back. */
function peer_figures(peer) {
  try {
    return lines_of(output_of(process.execPath, `tests/bench/peer_${peer}.mjs`));
  } catch (fault) {
    console.error(`no figures of ${peer}: ${fault.message}`);
    return [];
  }
}

function run_own() {
  const own = [];
  const peers = [];
  for (let launch = 0; launch < launches; launch += 1) {
    for (const bench of chosen.filter((each) => launch < (launches_of[each] ?? launches))) {
      own.push(...lines_of(output_of(`${build}/bench/${bench}_bench`)));
      if (figures[bench]) peers.push(...peer_figures(figures[bench]));
    }
  }
  const peer_of = gathered(peers), rows = gathered(own);
  const copy = rows.get('copying'), copying = copy && copy.bytes / copy.seconds;
  return [...rows.values()].map((row) => (row.peak_less_idle === undefined ? print_rate(row, peer_of.get(row.name), copying) : print_memory(row)));
}

/** The programs over Google Benchmark print tables of their own. */
function run_library_benches() {
  const own = new Set([...Object.keys(figures), 'cold'].map((bench) => `${bench}_bench`));
  const folder = `${build}/bench`;
  for (const name of fs.readdirSync(folder).filter((file) => file.endsWith('_bench') && !own.has(file) && file.includes(words)).sort()) {
    console.log(`\n--- ${name}`);
    process.stdout.write(output_of(path.join(folder, name), '--benchmark_min_time=0.2'));
  }
}

console.log(`${new Date().toISOString()}, ${process.platform} ${process.arch}`);
const rows = chosen.length > 0 ? run_own() : [];
fs.mkdirSync('build', { recursive: true });
fs.appendFileSync('build/bench.jsonl', rows.map((row) => `${JSON.stringify({ at: new Date().toISOString(), ...row })}\n`).join(''));
run_library_benches();
if (words === '' || 'cold'.includes(words)) {
  console.log('\n--- cold: one thread, no cache, a new seed');
  print_cold(lines_of(output_of(`${build}/bench/cold_bench`)), process.env.SEEDMESH_STORE_COLD);
}
const http = ['tests/bench/http_bench.mjs', 'tests/bench/http_bench.sh'].find((file) => fs.existsSync(file));
if (http && (words === '' || 'http'.includes(words))) {
  console.log(`\n--- ${http}`);
  process.stdout.write(http.endsWith('.mjs') ? output_of(process.execPath, http) : output_of('/bin/bash', http));
  console.log('\n--- compression: all presets, CPU time of the server');
  process.stdout.write(output_of(process.execPath, 'tests/bench/compression_bench.mjs'));
}
