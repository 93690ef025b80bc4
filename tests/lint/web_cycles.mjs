#!/usr/bin/env node
// Fails where files of web_client/src import each other in a circle, types included: a reader should be able to read them in one order.
import fs from 'node:fs';
import path from 'node:path';

const root = path.join(process.argv[2] ?? '.', 'web_client/src');

function* sources(folder) {
  for (const entry of fs.readdirSync(folder, { withFileTypes: true })) {
    const name = path.join(folder, entry.name);
    if (entry.isDirectory()) yield* sources(name);
    else if (name.endsWith('.ts')) yield name;
  }
}

/** The files of the project that `file` imports, statically or on demand. */
function imports_of(file, files) {
  const text = fs.readFileSync(file, 'utf8');
  const names = [...text.matchAll(/(?:from|import\()\s*'(\.[^']+)'/g)].map((match) => path.join(path.dirname(file), match[1]));
  return names.map((name) => [`${name}.ts`, path.join(name, 'index.ts'), name].find((each) => files.has(each))).filter(Boolean);
}

const files = new Set(sources(root));
const graph = new Map([...files].map((file) => [file, imports_of(file, files)]));

/** A circle through `file` as a list of files; undefined if there is none. */
function circle_through(file) {
  const from = new Map();
  const waiting = [file];
  while (waiting.length > 0) {
    const at = waiting.pop();
    for (const next of graph.get(at)) {
      if (next === file) {
        const circle = [file];
        for (let back = at; back !== file; back = from.get(back)) circle.splice(1, 0, back);
        return [...circle, file];
      }
      if (!from.has(next)) {
        from.set(next, at);
        waiting.push(next);
      }
    }
  }
  return undefined;
}

let failed = 0;
for (const file of files) {
  const circle = circle_through(file);
  if (!circle) continue;
  failed += 1;
  console.log(`a circle of imports: ${circle.map((each) => path.relative(root, each)).join(' -> ')}`);
}
const edges = [...graph.values()].reduce((sum, list) => sum + list.length, 0);
if (edges < files.size) {
  console.log('hardly any imports were found, so nothing was checked');
  failed += 1;
}
console.log(`${files.size - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
