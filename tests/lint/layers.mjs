#!/usr/bin/env node
// Checks every #include "..." of core/, server/ and api_schema/ against the table of directories in docs/architecture.md, so that the
// page and the check use the same text. A row reads: | `core/geom` | holds | `model`, `schema` |
// A directory may include itself, the directories named in its row, and whatever those may include.
// The libraries that CMake links are checked against the same table, and neither table nor libraries may depend in a circle.
// Also checked: the length of files, unfinished words, libraries that only certain files may include, and that no
// two files define types of one name in one namespace, which compilers and linkers do not report and which leads to undefined behaviour.
import fs from 'node:fs';
import path from 'node:path';

const root = process.argv[2] ?? '.';
const longest_file = 400;
const unfinished = new RegExp(['TO' + 'DO', 'FIX' + 'ME', 'X' + 'XX'].map((word) => `\\b${word}\\b`).join('|'));
// The headers of a library, and the only paths that may include them.
const seams = [
  [/^httplib\.h$/, /^server\/(healthcheck|remote_source)\.cpp$/],
  [/^tiny_?gltf\.h$/, /^core\/gltf\//],
  [/^spdlog\//, /^server\//],
  [/^sleef\.h$/, /^core\/(base\/math|pipeline\/engine)\.cpp$/],
  [/^(oneapi\/)?tbb(\/|\.h)/, /^core\/base\/parallel\.cpp$/],
  [/^png\.h$/, /^core\/(texture\/|pipeline\/engine\.cpp)/],
  [/^libdeflate\.h$/, /^(core\/(texture\/|pipeline\/engine\.cpp)|server\/compress\.cpp$)/],
  [/^(jpeglib|tiffio)\.h$|^webp\//, /^core\/texture\//],
  [/^zlib\.h$/, /^(core\/(base\/deflate|gltf\/write\/zip|pipeline\/engine)|server\/compress)\.cpp$/],
  [/^meshoptimizer\.h$/, /^core\/(geom\/|gltf\/compress\/|generators\/terrain\/cache_order\.cpp|pipeline\/engine\.cpp)/],
  [/^pugixml\.hpp$/, /^core\/import\//],
  [/^random$/, /^server\//],
  [/^openssl\//, /^server\/(signature|http\/tls)\.cpp$/],
  [/^openssl\/ssl\.h$/, /^server\/http\/tls\.cpp$/],
  [/^CLI\//, /^server\/main\.cpp$/],
  [/^prometheus\//, /^server\/metrics\.cpp$/],
  [/^xxhash\.h$/, /^(core\/gltf\/content_names\.cpp$|server\/)/],
  [/^hiredis\//, /^server\/shared_cache\.cpp$/],
  [/^(brotli\/|isa-l\/|zstd\.h$)/, /^server\/(compress|embed_assets)\.cpp$/],
];

// The directory whose users may include generated code.
const generated_code = 'core/schema';

/** The rows of the table: path prefix -> { own, may } with `own` the folder and `may` the folders it may include directly. */
function read_directories(text) {
  const directories = new Map();
  for (const line of text.split('\n')) {
    const cells = line.split('|').map((cell) => cell.trim());
    const name = /^`([a-z_/]+)`$/.exec(cells[1] ?? '')?.[1];
    if (cells.length !== 5 || !name) continue;
    directories.set(name, [...cells[3].matchAll(/`([a-z_/.]+)`/g)].map((match) => match[1]));
  }
  return directories;
}

/** Everything that `directory` may include: itself and, transitively, what its row names. A file name ends the search. */
function reachable(directories, directory, seen = new Set()) {
  if (seen.has(directory)) return seen;
  seen.add(directory);
  for (const next of directories.get(directory) ?? []) reachable(directories, next, seen);
  return seen;
}

/** The directory with the longest name that `file` is inside of. */
function directory_of(directories, file) {
  let best;
  for (const directory of directories.keys()) {
    if ((file.startsWith(`${directory}/`) || file.startsWith(`${directory}.`)) && directory.length > (best?.length ?? 0)) best = directory;
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

function errors_of(directories, file) {
  const text = fs.readFileSync(path.join(root, file), 'utf8');
  const lines = text.split('\n');
  const errors = [];
  const directory = directory_of(directories, file);
  if (!directory) return [`${file}: is in no directory of the table in docs/architecture.md`];
  const may = reachable(directories, directory);
  if (lines.length - 1 > longest_file) errors.push(`${file}: ${lines.length - 1} lines; at most ${longest_file}`);
  lines.forEach((line, index) => {
    const at = `${file}:${index + 1}`;
    if (unfinished.test(line)) errors.push(`${at}: an unfinished word`);
    const [, mark, include] = /^\s*#\s*include\s*(["<])([^">]+)[">]/.exec(line) ?? [];
    if (!include) return;
    const seam = seams.find(([library, users]) => library.test(include) && !users.test(file));
    if (seam) errors.push(`${at}: ${include} may not be included here: docs/architecture.md lists the files that may`);
    if (mark !== '"') return;
    if (!fs.existsSync(path.join(root, include)) && !include.startsWith('generated/')) {
      if (!seams.some(([library]) => library.test(include))) errors.push(`${at}: "${include}" is not a path from the top of the tree`);
      return;
    }
    const target = include.startsWith('generated/') ? generated_code : directory_of(directories, include);
    if (!may.has(target) && !may.has(include)) errors.push(`${at}: ${directory} may not include ${target ?? include}`);
  });
  return errors;
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
  const locations = new Map();
  const errors = [];
  for (const file of files) {
    for (const { name, line } of types_of(file)) {
      const first = locations.get(name);
      if (first && first.file !== file) errors.push(`${file}:${line}: ${name} is also defined in ${first.file}:${first.line}`);
      locations.set(name, first ?? { file, line });
    }
  }
  if (locations.size < 100) errors.push('no types were found to compare');
  return errors;
}

/** The static libraries of the tree: target -> { folder, links } with the targets of ours that it links. */
function read_libraries(folders) {
  const libraries = new Map();
  const add = (folder, target, list) => {
    const library = libraries.get(target) ?? { folder, links: [] };
    library.links.push(...(list.match(/\bseedmesh_\w+/g) ?? []));
    libraries.set(target, library);
  };
  for (const folder of folders) {
    const file = path.join(root, folder, 'CMakeLists.txt');
    if (!fs.existsSync(file)) continue;
    const text = fs.readFileSync(file, 'utf8').replace(/#.*$/gm, '');
    for (const [, name, list] of text.matchAll(/seedmesh_library\((\w+)([^)]*)\)/g)) add(folder, `seedmesh_${name}`, list);
    for (const [, target] of text.matchAll(/add_library\((seedmesh_\w+) STATIC/g)) add(folder, target, '');
    for (const [, target, list] of text.matchAll(/target_link_libraries\((seedmesh_\w+)([^)]*)\)/g)) {
      if (libraries.has(target)) add(folder, target, list);
    }
  }
  return libraries;
}

/** Links that the table does not allow, and words that hide a circle from the linker. */
function link_errors(directories, libraries) {
  const errors = [];
  for (const [target, { folder, links }] of libraries) {
    const may = [...reachable(directories, directory_of(directories, `${folder}/`))];
    for (const link of links) {
      const linked = libraries.get(link);
      if (!linked) continue;
      const directory = directory_of(directories, `${linked.folder}/`);
      const is_allowed = may.some((name) => name === directory || name.startsWith(`${directory}/`) || name === `${directory}.h`);
      if (!is_allowed) errors.push(`${folder}/CMakeLists.txt: ${target} may not link ${link} of ${directory}`);
    }
  }
  if (libraries.size < 10) errors.push('no libraries were found in the CMakeLists.txt files');
  return errors;
}

/** One circle of a graph as names joined by arrows; undefined where there is none. `next`: name -> names. */
function circle_of(names, next) {
  const done = new Set();
  const visit = (name, trail) => {
    if (trail.includes(name)) return [...trail.slice(trail.indexOf(name)), name].join(' -> ');
    if (done.has(name)) return undefined;
    for (const other of next(name)) {
      const found = visit(other, [...trail, name]);
      if (found) return found;
    }
    done.add(name);
    return undefined;
  };
  for (const name of names) {
    const found = visit(name, []);
    if (found) return found;
  }
  return undefined;
}

function* folders_below(folder) {
  yield folder;
  for (const entry of fs.readdirSync(path.join(root, folder), { withFileTypes: true })) {
    if (entry.isDirectory()) yield* folders_below(`${folder}/${entry.name}`);
  }
}

function library_errors(directories) {
  const libraries = read_libraries(['core', 'server', 'api_schema'].flatMap((folder) => [...folders_below(folder)]));
  const errors = link_errors(directories, libraries);
  const circles = [
    ['docs/architecture.md: the table has a circle', circle_of(directories.keys(), (directory) => directories.get(directory) ?? [])],
    ['the libraries link in a circle', circle_of(libraries.keys(), (target) => libraries.get(target)?.links ?? [])],
  ];
  for (const [what, circle] of circles) if (circle) errors.push(`${what}: ${circle}`);
  return errors;
}

const directories = read_directories(fs.readFileSync(path.join(root, 'docs/architecture.md'), 'utf8'));
const files = ['core', 'server', 'api_schema'].flatMap((folder) => [...files_below(folder)]);
let failed = 0;
for (const file of files) {
  const errors = errors_of(directories, file);
  failed += errors.length ? 1 : 0;
  for (const error of errors) console.log(error);
}
for (const error of [...repeated_types(files), ...library_errors(directories)]) {
  console.log(error);
  failed += 1;
}
if (directories.size < 5) {
  console.log('docs/architecture.md: the table of directories was not found');
  failed += 1;
}
console.log(`${files.length - Math.min(failed, files.length)} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
