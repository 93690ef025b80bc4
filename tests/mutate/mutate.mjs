#!/usr/bin/env node
// Measures what the tests notice: changes one operator of core/ or server/ at a time, builds, and runs the stored hashes and the tests
// until the first one fails. A change that no test notices is printed; it is either equivalent, or a test is missing.
//
//   mutate.mjs [n] [seed] [path]    n changes (default 10) that follow from the seed (default 1), in files below a path
//
// Works on a worktree of HEAD in build/mutate/tree, with a build directory of its own that later runs use again. Changes that do not
// compile are replaced by others. The last line counts what was noticed.
import { spawn, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import readline from 'node:readline';

const root = path.resolve(import.meta.dirname, '../..');
const tree = path.join(root, 'build/mutate/tree');
const build = path.join(tree, 'build/release');
const [wanted = 10, seed = 1] = process.argv.slice(2, 4).map(Number);
const below = process.argv[4] ?? '';
const most_seconds = { compile: 3600, golden: 300, tests: 1200 };
const most_kilobytes = 8 << 20;  // of one program, so that an endless loop that allocates ends

// Binary operators have spaces around them in formatted code, template brackets and pointers have none.
const operators = [
  [/ <= /g, ' < '], [/ < /g, ' <= '], [/ >= /g, ' > '], [/ > /g, ' >= '], [/ == /g, ' != '], [/ != /g, ' == '],
  [/ \+ /g, ' - '], [/ - /g, ' + '], [/ \* /g, ' / '], [/ \/ /g, ' * '], [/ % /g, ' * '],
  [/ && /g, ' || '], [/ \|\| /g, ' && '], [/ \+= /g, ' -= '], [/ -= /g, ' += '], [/ \*= /g, ' /= '],
  [/\bmin\(/g, 'max('], [/\bmax\(/g, 'min('], [/\btrue\b/g, 'false'], [/\bfalse\b/g, 'true'],
];

function run(command, words, options = {}) {
  return spawnSync(command, words, { cwd: tree, encoding: 'utf8', maxBuffer: 1 << 28, ...options });
}

function must(command, words, options) {
  const result = run(command, words, options);
  if (result.status !== 0) throw new Error(`${command} ${words.join(' ')}\n${result.stdout}\n${result.stderr}`);
  return result.stdout;
}

// --- Candidates ------------------------------------------------------------------------------------------------------

/** The line with comments and strings blanked out, so that columns stay as they are. */
function code_of(line) {
  if (/^\s*(#|\/\/|\*|\/\*)|\bstatic_assert\b|\bassert\(|\btemplate\b|\boperator\b/.test(line)) return '';
  return line.replace(/"(\\.|[^"\\])*"|'(\\.|[^'\\])*'/g, (text) => '_'.repeat(text.length)).replace(/\/\/.*$/, '');
}

function candidates() {
  const files = must('git', ['ls-files', 'core', 'server']).split('\n').filter((file) => /\.(cpp|h)$/.test(file) && file.startsWith(below));
  const found = [];
  for (const file of files) {
    fs.readFileSync(path.join(tree, file), 'utf8').split('\n').forEach((line, index) => {
      const code = code_of(line);
      for (const [pattern, by] of operators) {
        for (const match of code.matchAll(pattern)) found.push({ file, index, column: match.index, from: match[0], by });
      }
    });
  }
  return found;
}

/** Numbers of 32 bits from a seed (mulberry32). */
function random(state) {
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return (t ^ (t >>> 14)) >>> 0;
  };
}

function apply({ file, index, column, from, by }) {
  const name = path.join(tree, file);
  const lines = fs.readFileSync(name, 'utf8').split('\n');
  lines[index] = lines[index].slice(0, column) + by + lines[index].slice(column + from.length);
  fs.writeFileSync(name, lines.join('\n'));
}

// --- Tests -----------------------------------------------------------------------------------------------------------

const compile = (...targets) => run('ninja', ['-C', build, ...targets], { timeout: most_seconds.compile * 1000 }).status === 0;

/** The first row with other bytes, "the program" where it fails, or nothing where all rows are as stored. */
async function golden() {
  const folder = path.join(tree, 'tests/golden');
  const engine = fs.readdirSync(folder).filter((name) => name.startsWith('engine-')).sort((a, b) => Number(a.slice(7)) - Number(b.slice(7))).pop();
  const rows = new Map(fs.readFileSync(path.join(folder, engine, 'hashes.txt'), 'utf8').split('\n').filter((line) => line && !line.startsWith('#')).map((line) => [line.split(' ')[0], line.split(' ')[1]]));
  const requests = fs.readdirSync(path.join(folder, 'requests')).map((file) => `tests/golden/requests/${file}`);
  const child = spawn('bash', ['-c', `ulimit -v ${most_kilobytes}; exec "$@"`, 'limited', path.join(build, 'golden_table'), ...requests], { cwd: tree, stdio: ['ignore', 'pipe', 'ignore'] });
  const timer = setTimeout(() => child.kill('SIGKILL'), most_seconds.golden * 1000);
  const ended = new Promise((resolve) => child.on('close', resolve));
  let different = '';
  for await (const line of readline.createInterface({ input: child.stdout })) {
    const [name, hash] = line.split(' ');
    if (name === '#' || rows.get(name) === hash) continue;
    different = name;
    child.kill('SIGKILL');
    break;
  }
  const status = await ended;
  clearTimeout(timer);
  return different || (status === 0 ? '' : 'a request that fails or never ends');
}

/** The name of the first test program that fails, or nothing. */
function unit_tests(server_first) {
  const ctest = (words) => {
    const result = run('bash', ['-c', `ulimit -v ${most_kilobytes}; exec ctest "$@"`, 'ctest', '--test-dir', build, '--stop-on-failure', '--timeout', '600', ...words], { timeout: most_seconds.tests * 1000, killSignal: 'SIGKILL' });
    if (result.status === 0) return '';
    return /^\s*\d+ - (\S+)/m.exec(result.stdout.split('The following tests FAILED')[1] ?? '')?.[1] ?? 'ctest';
  };
  if (!server_first) return ctest([]);
  const failed = ctest(['-R', '^server']);
  if (failed) return failed;
  for (const file of fs.readdirSync(path.join(tree, 'tests/http')).filter((name) => name.endsWith('.test.mjs'))) {
    const env = { ...process.env, SEEDMESH_BUILD: build, SEEDMESH_PROGRAM: path.join(build, 'seedmesh') };
    if (run('node', ['--test', `tests/http/${file}`], { env, timeout: most_seconds.tests * 1000, killSignal: 'SIGKILL' }).status !== 0) return `tests/http/${file}`;
  }
  return ctest(['-E', '^server']);
}

/** What notices the present state of the tree; undefined where it does not compile. */
async function noticed_by(file) {
  if (!compile('golden_table')) return undefined;
  if (file.startsWith('core/')) {
    const row = await golden();
    if (row) return `stored hashes: ${row}`;
  }
  if (!compile()) return undefined;
  return unit_tests(file.startsWith('server/'));
}

// --- The worktree ----------------------------------------------------------------------------------------------------

function prepare() {
  const head = must('git', ['rev-parse', 'HEAD'], { cwd: root }).trim();
  if (!fs.existsSync(path.join(tree, '.git'))) must('git', ['worktree', 'add', '--force', '--detach', tree, head], { cwd: root });
  must('git', ['checkout', '--force', '--detach', head]);
  for (const folder of ['web_client/node_modules', 'web_client/dist', 'tests/node_modules']) {
    if (fs.existsSync(path.join(root, folder)) && !fs.existsSync(path.join(tree, folder))) fs.symlinkSync(path.join(root, folder), path.join(tree, folder));
  }
  console.log('Building the tree as it is');
  must('cmake', ['--preset', 'release']);
  if (!compile()) throw new Error('the tree does not build as it is');
}

prepare();
const list = candidates();
const next = random(seed);
console.log(`${list.length} operators; ${wanted} changes with seed ${seed}`);
let noticed = 0;
const survivors = [];
while (noticed + survivors.length < wanted && list.length) {
  const [change] = list.splice(next() % list.length, 1);
  const start = Date.now();
  apply(change);
  const diff = must('git', ['diff', '-U1', '--', change.file]);
  const by = await noticed_by(change.file);
  must('git', ['checkout', '--', change.file]);
  const what = `${change.file}:${change.index + 1}:${change.from}->${change.by}`;
  if (by === undefined) {
    console.log(`does not compile  ${what}`);
    continue;
  }
  console.log(`${by ? 'noticed ' : 'SURVIVED'}  ${what}  ${by} (${Math.round((Date.now() - start) / 1000)} s)`);
  if (by) noticed += 1;
  else survivors.push(diff);
}
for (const diff of survivors) console.log(`\n${diff.split('\n').filter((line) => !/^(diff|index|---)/.test(line)).join('\n')}`);
console.log(`\n${noticed} noticed, ${survivors.length} survived`);
