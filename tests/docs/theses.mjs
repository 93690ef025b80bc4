#!/usr/bin/env node
// Writes docs/theses.md from docs/theses.json and the built program:  SEEDMESH_PROGRAM=build/release/seedmesh tests/docs/theses.mjs
// A row of docs/theses.json has these members:
//   thesis, where, what   the position in the thesis and what is compared
//   preset, request       the preset that makes it, and the request that is measured, if it is not the preset as it is; a list is a list of requests
//   take                  what is measured: source:path (see sources)
//   printed or implied    the number or word that the thesis prints, or that follows from what it prints
//   within                the largest deviation of a number, 1e-9 if absent
//   note                  why both differ, a slip of the thesis, or the reading chosen
//   missing, no_model     instead of take: what is missing, or why there is nothing to make
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { program, run } from '../http/support.mjs';

const root = path.resolve(import.meta.dirname, '../..');
const read = (file) => fs.readFileSync(path.join(root, file), 'utf8');
export const page = 'docs/theses.md';
export const rows = JSON.parse(read('docs/theses.json'));

/** Folders of presets by name, so that a preset is found without the program. */
export const presets = new Map(fs.readdirSync(path.join(root, 'api_schema/presets'), { recursive: true })
  .filter((file) => file.endsWith('.json')).map((file) => [path.basename(file, '.json'), `api_schema/presets/${file}`]));

async function answer(command, request) {
  const out = command === 'generate' ? ['-o', '-'] : [];
  const made = await run(program, [command, '-', ...out], { input: JSON.stringify(request) });
  if (made.status !== 0) throw new Error(`${command} ${JSON.stringify(request)}: ${made.err}`);
  return made.out;
}

/** Each primitive of a GLB as often as nodes draw it, with its mode and number of elements. */
function primitives_of(bytes) {
  const file = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
  return file.nodes.filter((node) => node.mesh !== undefined).flatMap((node) => {
    const gpu = node.extensions?.EXT_mesh_gpu_instancing?.attributes;
    const copies = gpu ? file.accessors[Object.values(gpu)[0]].count : 1;
    return file.meshes[node.mesh].primitives.map((primitive) => ({
      mode: primitive.mode ?? 4, count: copies * file.accessors[primitive.indices ?? primitive.attributes.POSITION].count, positions: file.accessors[primitive.attributes.POSITION].count,
      material: file.materials?.[primitive.material],
    }));
  });
}

const sum = (list) => list.reduce((total, each) => total + each, 0);
const glb = {
  triangles: (all) => sum(all.filter(({ mode }) => mode === 4).map(({ count }) => count / 3)),
  each: (all) => all.map(({ count }) => count / 3),
  facades: (all) => new Set(all.flatMap(({ material }) => (/facade/.test(material?.name) && material.pbrMetallicRoughness.baseColorTexture ? [material.name] : []))).size,
  lines: (all) => sum(all.filter(({ mode }) => mode === 1).map(({ count }) => count / 2)),
  points: (all) => all.filter(({ mode }) => mode === 0).map(({ count }) => count),
  positions: (all) => sum(all.map(({ positions }) => positions)),
  single_sided: (all) => all.every(({ material }) => !material?.doubleSided),
};
const of_lists = {
  length: (list) => list.length,
  sum,
  distinct: (list) => new Set(list).size,
  range: (list) => list.reduce((most, each) => Math.max(most, each), -Infinity) - list.reduce((least, each) => Math.min(least, each), Infinity),
};

/** The value at a path: members, indices, [member=value] and [member!=value], which filter a list. A member of a
 * list of objects, or an index into a list of lists, is that of each. */
function at(value, steps) {
  let now = value;
  for (const step of steps.match(/\[[^\]]*\]|[^.[\]]+/g)) {
    const filter = /^\[(\w+)(!?=)(.*)\]$/.exec(step);
    if (filter) now = now.filter((each) => (String(each[filter[1]]) === filter[3]) === (filter[2] === '='));
    else if (Array.isArray(now) && of_lists[step]) now = of_lists[step](now);
    else if (Array.isArray(now) && typeof now[0] === 'object' && (Array.isArray(now[0]) || !/^\d+$/.test(step))) now = now.map((each) => each[step]);
    else now = now[step];
    if (now === undefined) throw new Error(`nothing at ${step} of ${steps}`);
  }
  return now;
}

/** Where numbers come from. */
const sources = {
  derive: async (request, steps) => at(JSON.parse(await answer('derive', request)), steps),
  glb: async (request, steps) => glb[steps](primitives_of(await answer('generate', request))),
  preset: async (request, steps, row) => at(JSON.parse(read(presets.get(row.preset))), steps),
  saved: async (request, steps) => {
    const { status, out, err } = await run(program, ['import', '-', '--to', 'proctree'], { input: JSON.stringify(request) });
    if (status !== 0) throw new Error(err);
    const file = JSON.parse(out);
    return steps === 'length' ? Object.keys(file).length : at(file, steps);
  },
  schema: async (request, steps) => at(JSON.parse(read(`api_schema/${steps.split('.')[0]}.schema.json`)), steps.slice(steps.indexOf('.') + 1)),
  accepted: async (requests) => {
    const all = await Promise.all(requests.map((request) => run(program, ['validate', '-'], { input: JSON.stringify(request) })));
    return all.filter(({ status, out }) => status === 0 && JSON.parse(out).valid).length;
  },
};

const rounded = (value) => {
  if (typeof value === 'number') return Number(value.toPrecision(9)) === 0 || Math.abs(value) < 1e-9 ? 0 : Number(value.toPrecision(9));
  return Array.isArray(value) ? value.map(rounded) : value;
};

/** What the program gives for a row. */
export async function measure(row) {
  const [source, ...rest] = row.take.split(':');
  return rounded(await sources[source](row.request ?? { preset: row.preset }, rest.join(':'), row));
}

export const expected_of = (row) => row.printed ?? row.implied;

export function is_equal(one, other, within = 1e-9) {
  if (Array.isArray(one)) return Array.isArray(other) && one.length === other.length && one.every((each, index) => is_equal(each, other[index], within));
  return typeof one === 'number' ? typeof other === 'number' && Math.abs(one - other) <= within : one === other;
}

/** equal, differs, shown (no number to compare), missing, or none (no model). */
export function status_of(row, found) {
  if (row.missing) return 'missing';
  if (row.no_model) return 'none';
  if (expected_of(row) === undefined) return 'shown';
  return is_equal(expected_of(row), found, row.within) ? 'equal' : 'differs';
}

const words = { equal: 'equal', differs: 'differs', shown: 'no number', missing: 'missing', none: 'no model' };
const titles = {
  Kogovšek: 'Kogovšek 2014: fractals, L-systems, shape grammars, height maps', Tunnel: 'Tunnel 2012: stochastic trees and levels of detail',
  Hutsko: 'Hutsko 2022: growth of plants', Tajić: 'Tajić 2009: models of trees', Sojma: 'Sojma: stochastic 0L-systems and leaves',
};

const longest_cell = 80;  // characters of a request or a list in a table cell; docs/theses.json has longer ones
const code = (text) => `\`${text.replaceAll('|', '\\|').replaceAll('\n', ' ').trim()}\``;
function value_text(value) {
  if (value === undefined) return '';
  const text = typeof value === 'string' ? value : Array.isArray(value) ? value.map((each) => (Array.isArray(each) ? `(${each.join(', ')})` : each)).join(', ') : value.toLocaleString('en-US', { maximumFractionDigits: 6 });
  if (Array.isArray(value) && text.length > longest_cell) return `${value_text(value.slice(0, 2))} … (${value.length} entries)`;
  if (typeof value !== 'string') return text;
  return text.length <= 36 ? code(text) : `${code(text.slice(0, 24))} … (${text.length} letters)`;
}

/** The preset of a row and its changed members; requests that are too long for a cell are in docs/theses.json. */
function made_by(row) {
  const request = Array.isArray(row.request) ? row.request[0] : row.request;
  const more = Array.isArray(row.request) && row.request.length > 1 ? `, and ${row.request.length - 1} more` : '';
  if (!request) return row.preset ? code(row.preset) : '';
  const changed = Object.entries({ ...request.parameters, ...request.output }).map(([name, value]) => `${name}: ${JSON.stringify(value)}`).join(', ');
  const is_long = changed.length > longest_cell;
  if (request.preset) return `${code(request.preset)}${changed ? ` with ${is_long ? 'the members in `theses.json`' : code(changed)}` : ''}${more}`;
  const text = is_long ? 'the request in `theses.json`' : code(changed);
  const seed = request.seed === undefined ? '' : `, seed ${request.seed}`;
  return `${row.preset ? `${code(row.preset)}; ` : ''}${request.generator}, ${text}${seed}${more}`;
}

function table_row(row, found, status) {
  const printed = row.implied !== undefined ? `(${value_text(row.implied)})` : value_text(row.printed);
  const note = [row.missing ?? row.no_model, row.note].filter(Boolean).join('. ');
  return `| ${[row.where, row.what.replaceAll('|', '\\|'), made_by(row), printed, value_text(found), words[status], note.replaceAll('|', '\\|')].join(' | ')} |`;
}

const intro = `# The five theses

![Menger sponge of Kogovšek, in three rounds](pictures/kogovsek_2_10.webp)

\`\`\`json
{ "preset": "kogovsek_2_10" }
\`\`\`

Use this page when you have one of the five theses beside you and look for the preset that makes its figure.

Seedmesh began with five theses. This page lists their systems, tables and figures, and compares each number with what the program gives.

- *Printed* is the number or word in the thesis. One in parentheses follows from what is printed.
- *We get* is computed by the program for the preset or request of the row.
- *Missing* rows are things that Seedmesh cannot make yet.
- *No number* rows have a model, but the thesis prints nothing to compare with.
- A note that begins with *slip* describes a misprint of the thesis.

The table is generated from \`docs/theses.json\` by \`tests/docs/theses.mjs\`. A test computes every row again. It fails if a number differs without a note.
`;

/** What stands below the table of a thesis. Sizes are of the files, times are processor times of the whole program. */
const notes = {
  Tunnel: `Table 4 of the thesis has frame rates, which depend on the computer and the viewer. Beside them are the sizes of the files here, and the processor time of the whole program, measured
once.

| scene | truncated cones | frame rate printed | triangles | bytes | time |
| --- | --- | --- | --- | --- | --- |
| \`tunnel_symmetric\` with \`iterations: 4, weld: false\` | 2,401 | 35, 36, 60 | 24,896 | 651,456 | 20 ms |
| \`tunnel_six_trees\` | 2,058 | 41, 42, 49, 55, 60 | 49,730 | 222,252 | 25 ms |
`,
  'Tajić': `Table 2 of the thesis has times to draw, on an Athlon64 3500+ with a GeForce 6600 GT. Beside them are the sizes of the files here, and the processor time of the whole program, measured once.
*Shared* files hold each part once and show it as copies ([shared parts](lsystem.md#shared-parts)). Segments that have become too thin for a tube by \`width_decrement\` are left out of tubes.

| system | depth | time printed | lines shown | file, time | triangles shown | file, time |
| --- | --- | --- | --- | --- | --- | --- |
| A | 6 | 0 s | 1,098 | 0.02 MB, 18 ms | 35,020 | 0.87 MB, 19 ms |
| A | 7 |  | 3,285 | 0.05 MB, 18 ms | 102,940 | 2.56 MB, 21 ms |
| A | 8 |  | 9,846 | 0.15 MB, 20 ms | 302,540 | 9.34 MB, 27 ms |
| A | 9 | 1 s | 29,529 | 0.43 MB, 22 ms | 889,420 | 27.46 MB, 38 ms |
| A | 10 | 1 s | 88,578 | 1.61 MB, 31 ms | 2,614,300 | 80.71 MB, 137 ms |
| A | 11 |  | 265,725 | 4.75 MB, 32 ms | 7,684,580 | 237.25 MB, 398 ms |
| A | 12 | 2 s | 797,166 | 14.07 MB, 74 ms | 22,586,820 | 697.32 MB, 1196 ms |
| A | 13 |  | 2,391,489 | 47.83 MB, 49 ms | 76,405,180 | 2.93 MB, 24 ms (shared) |
| A | 14 | 7 s | 7,174,458 | 143.49 MB, 109 ms | 26,016,700 | 1.78 MB, 23 ms (shared) |
| A | 15 | 13 s | 21,523,365 | 0.62 MB, 23 ms (shared) | 26,016,700 | 1.78 MB, 26 ms (shared) |
| B | 6 | 0 s | 1,460 | 0.03 MB, 18 ms | 43,780 | 1.08 MB, 19 ms |
| B | 7 |  | 4,376 | 0.07 MB, 18 ms | 131,260 | 4.03 MB, 22 ms |
| B | 8 |  | 13,124 | 0.21 MB, 21 ms | 393,700 | 12.08 MB, 26 ms |
| B | 9 | 1.5 s | 39,368 | 0.63 MB, 24 ms | 1,181,020 | 36.22 MB, 43 ms |
| B | 10 | 2 s | 118,100 | 2.35 MB, 34 ms | 3,542,980 | 108.66 MB, 155 ms |
| B | 11 |  | 354,296 | 7.05 MB, 41 ms | 10,628,860 | 325.96 MB, 410 ms |
| B | 12 | 3 s | 1,062,884 | 21.26 MB, 33 ms | 31,886,500 | 977.86 MB, 1226 ms |
| B | 13 |  | 3,188,648 | 63.78 MB, 60 ms | 14,186,380 | 2.06 MB, 23 ms (shared) |
| B | 14 | 10 s | 9,565,940 | 191.32 MB, 140 ms | 14,186,380 | 2.06 MB, 24 ms (shared) |
| B | 15 | 25 s | 28,697,816 | 0.77 MB, 24 ms (shared) | 14,186,380 | 2.06 MB, 26 ms (shared) |
| C | 6 | 0 s | 119 | 0.01 MB, 18 ms | 3,180 | 0.08 MB, 17 ms |
| C | 7 |  | 200 | 0.01 MB, 18 ms | 4,800 | 0.12 MB, 18 ms |
| C | 8 |  | 362 | 0.01 MB, 17 ms | 9,660 | 0.24 MB, 17 ms |
| C | 9 | 0 s | 605 | 0.01 MB, 18 ms | 14,520 | 0.35 MB, 17 ms |
| C | 10 | 0 s | 1,091 | 0.02 MB, 19 ms | 29,100 | 0.71 MB, 19 ms |
| C | 11 |  | 1,820 | 0.03 MB, 19 ms | 43,680 | 1.06 MB, 20 ms |
| C | 12 | 0 s | 3,278 | 0.06 MB, 18 ms | 87,420 | 2.14 MB, 20 ms |
| C | 13 |  | 5,465 | 0.09 MB, 18 ms | 131,160 | 3.96 MB, 21 ms |
| C | 14 | 1 s | 9,839 | 0.16 MB, 19 ms | 87,420 | 2.14 MB, 22 ms |
| C | 15 | 1 s | 16,400 | 0.27 MB, 19 ms | 87,420 | 2.14 MB, 22 ms |
`,
};

/** The page for the values that were found, in the order of the rows. */
export function page_of(found) {
  const statuses = rows.map((row, index) => status_of(row, found[index]));
  const theses = Object.keys(titles);
  const count = (thesis, status) => rows.filter((row, index) => (!thesis || row.thesis === thesis) && (!status || statuses[index] === status)).length;
  const kinds = Object.keys(words);
  const summary = [`| thesis | rows | ${kinds.map((kind) => words[kind]).join(' | ')} |`, `| --- | --- | ${kinds.map(() => '---').join(' | ')} |`,
    ...theses.map((thesis) => `| ${thesis} | ${count(thesis)} | ${kinds.map((kind) => count(thesis, kind)).join(' | ')} |`),
    `| all | ${count()} | ${kinds.map((kind) => count('', kind)).join(' | ')} |`];
  const tables = theses.map((thesis) => [`## ${titles[thesis]}`, '', '| where | what | made by | printed | we get | result | note |', '| --- | --- | --- | --- | --- | --- | --- |',
    ...rows.flatMap((row, index) => (row.thesis === thesis ? [table_row(row, found[index], statuses[index])] : [])), '', ...(notes[thesis] ? [notes[thesis]] : [])].join('\n'));
  return `${intro}\n${summary.join('\n')}\n\n${tables.join('\n')}`;
}

/** Every row measured, as many at once as there are processors. */
export async function measure_all(each = measure) {
  const found = new Array(rows.length);
  let next = 0;
  const work = async () => {
    while (next < rows.length) {
      const index = next++;
      if (rows[index].take) found[index] = await each(rows[index]);
    }
  };
  await Promise.all(Array.from({ length: Math.min(4, os.availableParallelism()) }, work));
  return found;
}

if (process.argv[1] === import.meta.filename) {
  const found = await measure_all(async (row) => {
    try { return await measure(row); } catch (error) { console.error(`${row.thesis}, ${row.where}, ${row.what}: ${error.message.slice(0, 600)}`); process.exitCode = 1; return undefined; }
  });
  for (const [index, row] of rows.entries()) {
    if (status_of(row, found[index]) === 'differs' && !row.note) { console.error(`${row.thesis}, ${row.where}, ${row.what}: expected ${JSON.stringify(expected_of(row))}, found ${JSON.stringify(found[index])}`); process.exitCode = 1; }
  }
  if (!process.exitCode) fs.writeFileSync(path.join(root, page), page_of(found));
}
