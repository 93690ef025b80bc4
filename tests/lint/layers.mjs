#!/usr/bin/env node
// Checks every #include "..." of core/, server/ and api_schema/ against the table of rooms in docs/architecture.md, so that the
// drawing of the house and the test of it are one text. A row reads: | `core/geom` | holds | `model`, `schema` |
// A room may include itself, the rooms named in its row, and whatever those may include.
// Also here, since it reads the same files: how long a file may grow, unfinished words, libraries that have one seam, and that no
// two files define types of one name in one namespace, which no compiler or linker tells and which breaks programs at random.
import fs from 'node:fs';
import path from 'node:path';

const root = process.argv[2] ?? '.';
const longest_file = 450;
const unfinished = new RegExp(['TO' + 'DO', 'FIX' + 'ME', 'X' + 'XX'].map((word) => `\\b${word}\\b`).join('|'));
// A library's header and the only paths that may include it.
const seams = [
  [/^httplib\.h$/, /^server\/http\//],
  [/^tiny_?gltf\.h$/, /^core\/gltf\//],
  [/^spdlog\//, /^server\//],
  [/^sleef\.h$/, /^core\/(base\/math|pipeline\/engine)\.cpp$/],
  [/^(oneapi\/)?tbb(\/|\.h)/, /^core\/base\/parallel\.cpp$/],
  [/^png\.h$/, /^core\/(texture\/|pipeline\/engine\.cpp)/],
  [/^random$/, /^server\//],
  [/^openssl\//, /^server\/(signature|http\/tls)\.cpp$/],
  [/^hiredis\//, /^server\/shared_cache\.cpp$/],
  [/^(brotli\/|zstd\.h$)/, /^server\/(compress|embed_assets)\.cpp$/],
];

// The room whose users may include what the host tool makes in the build tree.
const generated_code = 'core/schema';

/** The rows of the table: path prefix -> { own, may } with `own` the folder and `may` the folders it may include directly. */
function read_rooms(text) {
  const rooms = new Map();
  for (const line of text.split('\n')) {
    const cells = line.split('|').map((cell) => cell.trim());
    const name = /^`([a-z_/]+)`$/.exec(cells[1] ?? '')?.[1];
    if (cells.length !== 5 || !name) continue;
    rooms.set(name, [...cells[3].matchAll(/`([a-z_/.]+)`/g)].map((match) => match[1]));
  }
  return rooms;
}

/** Everything that `room` may include: itself and, transitively, what its row names. A file name ends the search. */
function reachable(rooms, room, seen = new Set()) {
  if (seen.has(room)) return seen;
  seen.add(room);
  for (const next of rooms.get(room) ?? []) reachable(rooms, next, seen);
  return seen;
}

/** The room with the longest name that `file` is inside of. */
function room_of(rooms, file) {
  let best;
  for (const room of rooms.keys()) {
    if ((file.startsWith(`${room}/`) || file.startsWith(`${room}.`)) && room.length > (best?.length ?? 0)) best = room;
  }
  return best;
}

function* files_below(folder) {
  for (const entry of fs.readdirSync(path.join(root, folder), { withFileTypes: true })) {
    const name = `${folder}/${entry.name}`;
    if (entry.isDirectory()) yield* files_below(name);
    else if (/\.(h|cpp)$/.test(name)) yield name;
  }
}

function faults_of(rooms, file) {
  const text = fs.readFileSync(path.join(root, file), 'utf8');
  const lines = text.split('\n');
  const faults = [];
  const room = room_of(rooms, file);
  if (!room) return [`${file}: is in no room of the table in docs/architecture.md`];
  const may = reachable(rooms, room);
  if (lines.length - 1 > longest_file) faults.push(`${file}: ${lines.length - 1} lines; at most ${longest_file}`);
  lines.forEach((line, index) => {
    const at = `${file}:${index + 1}`;
    if (unfinished.test(line)) faults.push(`${at}: an unfinished word`);
    const [, mark, include] = /^\s*#\s*include\s*(["<])([^">]+)[">]/.exec(line) ?? [];
    if (!include) return;
    const seam = seams.find(([library, place]) => library.test(include) && !place.test(file));
    if (seam) faults.push(`${at}: ${include} has one seam, and this is not it`);
    if (mark !== '"') return;
    if (!fs.existsSync(path.join(root, include)) && !include.startsWith('generated/')) {
      if (!seams.some(([library]) => library.test(include))) faults.push(`${at}: "${include}" is not a path from the top of the tree`);
      return;
    }
    const target = include.startsWith('generated/') ? generated_code : room_of(rooms, include);
    if (!may.has(target) && !may.has(include)) faults.push(`${at}: ${room} may not include ${target ?? include}`);
  });
  return faults;
}

/** Every type that is defined outside of functions, other types and unnamed namespaces: its full name and line. */
function* types_of(file) {
  const namespaces = [];
  const lines = fs.readFileSync(path.join(root, file), 'utf8').split('\n');
  for (const [index, line] of lines.entries()) {
    const opened = /^namespace( [\w:]+)? \{/.exec(line);
    if (opened && !line.includes('}')) namespaces.push(opened[1]?.trim() ?? '');
    if (/^\}\s*\/\/ namespace/.test(line)) namespaces.pop();
    const type = /^(?:class|struct|union|enum(?: class)?) (\w+)(?: final)?(?:\s*:(?!:)[^;]*)?\s*(?:\{.*)?$/.exec(line);
    if (!type || namespaces.includes('')) continue;
    yield { name: [...namespaces, type[1]].join('::'), line: index + 1 };
  }
}

/** Types that two files define. */
function repeated_types(files) {
  const places = new Map();
  const faults = [];
  for (const file of files) {
    for (const { name, line } of types_of(file)) {
      const first = places.get(name);
      if (first && first.file !== file) faults.push(`${file}:${line}: ${name} is also defined in ${first.file}:${first.line}`);
      places.set(name, first ?? { file, line });
    }
  }
  if (places.size < 100) faults.push('no types were found to compare');
  return faults;
}

const rooms = read_rooms(fs.readFileSync(path.join(root, 'docs/architecture.md'), 'utf8'));
const files = ['core', 'server', 'api_schema'].flatMap((folder) => [...files_below(folder)]);
let failed = 0;
for (const file of files) {
  const faults = faults_of(rooms, file);
  failed += faults.length ? 1 : 0;
  for (const fault of faults) console.log(fault);
}
for (const fault of repeated_types(files)) {
  console.log(fault);
  failed += 1;
}
if (rooms.size < 5) {
  console.log('docs/architecture.md: the table of rooms was not found');
  failed += 1;
}
console.log(`${files.length - Math.min(failed, files.length)} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
