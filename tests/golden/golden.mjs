#!/usr/bin/env node
// The promise "same request, same bytes" as stored hashes: tests/golden/engine-<n>/hashes.txt has one row for each preset (with its
// own seed and with seed 3) and for each request of tests/golden/requests/, and summaries.txt says what each preset's model is, so
// that a person can judge a change.
//
//   golden.mjs check <preset of CMakePresets.json>...   compares what these builds make, on 1 and on 8 threads, with the table
//   golden.mjs write [--new-libraries]                  stores what build/release makes, where that is allowed; with the flag also
//                                                       where other libraries touch bytes than those of the stored table
//
// A row is never rewritten under the same engine number once a release has it. `write` stores:
// - the first table of an engine, when the changelog has a line that names it ("Engine 4");
// - rows for new presets and requests, at any time;
// - changed rows, while the changelog names the engine under "Unreleased" and therefore no release has it.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

const root = path.resolve(import.meta.dirname, '../..');
process.chdir(root);
const requests = fs.readdirSync('tests/golden/requests').sort().map((file) => `tests/golden/requests/${file}`);
const made = 'build/golden';
fs.mkdirSync(made, { recursive: true });

// Shared libraries whose version can change bytes. Each row lists those that were called while it was made.
const libraries = { sleef: /libsleef\.so/, meshoptimizer: /libmeshoptimizer\.so/, png: /libpng16\.so/, deflate: /libdeflate\.so/, zlib: /libz\.so/, webp: /libwebp\.so/ };

/** Runs the program of one build; fails loudly, because a table with missing rows compares to nothing. */
function run_table(preset, arguments_, environment = {}) {
  const program = `build/${preset}/golden_table`;
  const emulator = ['qemu-aarch64-static', 'qemu-aarch64'].find((name) => spawnSync(name, ['--version']).status === 0);
  const command = preset === 'aarch64' ? [emulator, '-L', 'build/aarch64-sysroot', program] : [program];
  const result = spawnSync(command[0], [...command.slice(1), ...arguments_, ...requests], {
    env: { ...process.env, ...environment }, encoding: 'utf8', maxBuffer: 1 << 26, timeout: 3_600_000,
  });
  if (result.stderr) console.log(result.stderr.trimEnd());
  return { text: result.stdout ?? '', is_complete: result.status === 0 };
}

/** {engine, rows: name -> {hash, bytes, libraries}} of a table's text. */
function parsed(text) {
  const table = { engine: /^# engine ([\w-]+)/im.exec(text)?.[1] ?? '', rows: new Map() };
  for (const line of text.split('\n')) {
    if (!line || line.startsWith('#')) continue;
    const [name, hash, bytes, uses] = line.split(' ');
    table.rows.set(name, { hash, bytes, uses });
  }
  return table;
}

const number_of = (engine) => engine.split('-')[0];
const folder_of = (engine) => `tests/golden/engine-${number_of(engine)}`;
const read_if_there = (file) => (fs.existsSync(file) ? fs.readFileSync(file, 'utf8') : '');

/** Names of rows that are in one table alone, or have other bytes. With other libraries only rows that call none are compared. */
function compared(stored, today) {
  const has_other_libraries = stored.engine !== today.engine;
  const outcome = { same: [], changed: [], missing: [], added: [], skipped: [] };
  for (const [name, row] of stored.rows) {
    const now = today.rows.get(name);
    if (!now) outcome.missing.push(name);
    else if (has_other_libraries && row.uses !== '-') outcome.skipped.push(name);
    else (now.hash === row.hash && now.bytes === row.bytes ? outcome.same : outcome.changed).push(name);
  }
  for (const name of today.rows.keys()) if (!stored.rows.has(name)) outcome.added.push(name);
  return outcome;
}

// --- check ---------------------------------------------------------------------------------------------------------

function shown(heading, names) {
  if (!names.length) return;
  console.log(`  ${heading}:`);
  for (const name of names.slice(0, 20)) console.log(`    ${name}`);
  if (names.length > 20) console.log(`    and ${names.length - 20} more`);
}

function check_build(preset, threads, stored, totals) {
  // Fresh memory is filled with other bytes in each run, so that a read of unset memory shows.
  const environment = { MALLOC_PERTURB_: String((threads * 21 + 1) % 256) };
  const summaries = `${made}/summaries-${preset}-${threads}.txt`;
  const { text, is_complete } = run_table(
    preset, ['--threads', String(threads), '--engine', stored.engine, '--summaries', summaries], environment);
  fs.writeFileSync(`${made}/hashes-${preset}-${threads}.txt`, text);
  const today = parsed(text);
  const outcome = compared(stored, today);
  console.log(`${preset}, ${threads} threads, engine ${today.engine}: ${outcome.same.length} rows agree, ` +
    `${outcome.changed.length} changed, ${outcome.missing.length} missing, ${outcome.added.length} not stored, ${outcome.skipped.length} skipped`);
  shown('other bytes under the same engine number', outcome.changed);
  shown('stored, but not made', outcome.missing);
  shown('made, but not stored (./dev golden stores them)', outcome.added);
  totals.passed += outcome.same.length;
  totals.failed += outcome.changed.length + outcome.missing.length + outcome.added.length + (is_complete ? 0 : 1);
  totals.skipped += outcome.skipped.length;
  const expected = `${folder_of(stored.engine)}/summaries.txt`;
  if (stored.has_summaries && today.engine === stored.engine && fs.readFileSync(summaries, 'utf8') !== read_if_there(expected)) {
    totals.failed += 1;
    console.log(`  summaries differ; what the change looks like: git diff --no-index ${expected} ${summaries}`);
  }
  return today;
}

const today_text = (preset, threads) => fs.readFileSync(`${made}/hashes-${preset}-${threads}.txt`, 'utf8');

function check(presets) {
  const totals = { passed: 0, failed: 0, skipped: 0 };
  // One small row, to learn the engine of the first build.
  const engine = parsed(run_table(presets[0], ['--only', 'fractal/element_tetrahedron']).text).engine;
  let stored = { ...parsed(read_if_there(`${folder_of(engine)}/hashes.txt`)), has_summaries: true };
  if (!stored.rows.size) {
    console.log(`${folder_of(engine)}/hashes.txt is not there: ./dev golden writes the first table of an engine`);
    totals.failed += 1;
  } else {
    for (const preset of presets) {
      for (const threads of [1, 8]) {
        const today = check_build(preset, threads, stored, totals);
        // With other libraries than those of the stored table, builds are at least compared with the first one.
        if (today.engine !== stored.engine) stored = parsed(today_text(preset, threads));
      }
    }
  }
  console.log(`${totals.passed} passed, ${totals.failed} failed, ${totals.skipped} skipped`);
  return totals.failed ? 1 : 0;
}

// --- write ---------------------------------------------------------------------------------------------------------

/** The libraries that a row calls: the dynamic linker binds a function at its first call and reports it. */
function libraries_of(name) {
  const log = `${made}/bindings`;
  for (const file of fs.readdirSync(made)) if (file.startsWith('bindings.')) fs.rmSync(`${made}/${file}`);
  const { is_complete } = run_table('release', ['--only', name], { LD_DEBUG: 'bindings', LD_DEBUG_OUTPUT: log, LD_BIND_NOW: '' });
  if (!is_complete) throw new Error(`${name} could not be made`);
  const bindings = fs.readdirSync(made).filter((file) => file.startsWith('bindings.'))
    .map((file) => fs.readFileSync(`${made}/${file}`, 'utf8')).join('').split('\n');
  // Bindings between libraries are made at start already; only those of the program count.
  const own = bindings.filter((line) => /binding file \S*golden_table \[0\] to /.test(line)).join('\n');
  return Object.keys(libraries).filter((library) => libraries[library].test(own)).join('+') || '-';
}

/** "released", "unreleased", or "" where the changelog has no line that names the engine. */
function standing_of(engine_number) {
  const line = new RegExp(`\\bEngine ${engine_number}\\b`, 'i');
  const sections = read_if_there('CHANGELOG.md').split(/^## /m).slice(1);
  const section = sections.find((text) => line.test(text));
  if (!section) return '';
  return /^\[?unreleased/i.test(section) ? 'unreleased' : 'released';
}

/** Why the table may not be written, or nothing. */
function refusal(engine, outcome, is_first) {
  const standing = standing_of(number_of(engine));
  if (is_first) return standing ? '' : `CHANGELOG.md has no line that names "Engine ${number_of(engine)}"; say there what changes for users`;
  const altered = [...outcome.changed, ...outcome.missing];
  if (!altered.length || standing === 'unreleased') return '';
  return `${altered.length} stored rows would change or go, as ${altered[0]}. If that is meant, raise engine_number in ` +
    `core/pipeline/engine.cpp and name the new engine in CHANGELOG.md`;
}

function write(takes_new_libraries) {
  const { text, is_complete } = run_table('release', ['--summaries', `${made}/summaries.txt`]);
  if (!is_complete) return 1;
  const today = parsed(text);
  const folder = folder_of(today.engine);
  const stored = parsed(read_if_there(`${folder}/hashes.txt`));
  if (takes_new_libraries && standing_of(number_of(today.engine)) === 'unreleased') stored.engine = today.engine;
  const is_first = !stored.rows.size;
  if (!is_first && stored.engine !== today.engine) {
    console.log(`The table belongs to engine ${stored.engine}, and this machine has the libraries of ${today.engine}: write it on Debian 12, ` +
      'or with --new-libraries while no release has the engine');
    return 1;
  }
  const outcome = compared(stored, today);
  const reason = refusal(today.engine, outcome, is_first);
  if (reason) {
    console.log(`Not written: ${reason}`);
    return 1;
  }
  const lines = [...today.rows].map(([name, row]) => {
    const old = stored.rows.get(name);
    const uses = old && old.hash === row.hash ? old.uses : libraries_of(name);
    return `${name} ${row.hash} ${row.bytes} ${uses}`;
  });
  fs.mkdirSync(folder, { recursive: true });
  fs.writeFileSync(`${folder}/hashes.txt`, `# Engine ${today.engine}. Each row: request, XXH3-128 of its bytes, their number, and the ` +
    `libraries that are called to make them.\n${lines.sort().join('\n')}\n`);
  fs.copyFileSync(`${made}/summaries.txt`, `${folder}/summaries.txt`);
  console.log(`${folder}: ${lines.length} rows, ${outcome.added.length} new, ${outcome.changed.length} changed, ${outcome.missing.length} removed`);
  return 0;
}

const [command, ...words] = process.argv.slice(2);
if (command === 'check' && words.length) process.exitCode = check(words);
else if (command === 'write') process.exitCode = write(words.includes('--new-libraries'));
else {
  console.error('golden.mjs check <preset>... | write [--new-libraries]');
  process.exitCode = 2;
}
