#!/usr/bin/env node
// C++ evaluates the arguments of a call in any order, and compilers differ. Refuses calls and constructors in round
// brackets with two arguments that draw random numbers, because their bytes would depend on the compiler. Braces have an
// order:  draws.mjs [directory of the repository]
import { readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { argv, exit } from 'node:process';

const root = argv[2] ?? '.';
const draw = /[\w\])](?:\.|->)(?:unit|uniform|below|next)\(|\b\w+\((?:[^()]*,\s*)?\w*(?:rng|random|draw)_?\s*[,)]/;

/** The arguments of the call whose bracket opens at `open`, without what is in braces; undefined where it does not end. */
function arguments_of(text, open) {
  const list = [''];
  let round = 0, braces = 0;
  for (let i = open; i < text.length; ++i) {
    const c = text[i];
    if (c === '{') braces += 1;
    else if (c === '}') braces -= 1;
    else if (braces === 0) {
      if (c === ';' && round === 1) return [];  // the head of a loop, whose parts have an order
      if (c === '(' && ++round === 1) continue;
      if (c === ')' && --round === 0) return list;
      if (c === ',' && round === 1) list.push('');
      else list[list.length - 1] += c;
    }
  }
  return undefined;
}

function* files(folder) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) yield* files(path);
    else if (/\.(cpp|h)$/.test(entry.name)) yield path;
  }
}

/** The lines of calls whose result depends on the order of their arguments. */
function unordered(source) {
  const text = source.replace(/\/\/[^\n]*|"(?:[^"\\\n]|\\.)*"/g, (match) => ' '.repeat(match.length));
  const lines = [];
  for (let open = text.indexOf('('); open >= 0; open = text.indexOf('(', open + 1)) {
    const own = arguments_of(text, open) ?? [];
    if (own.filter((each) => draw.test(each)).length >= 2) lines.push(text.slice(0, open).split('\n').length);
  }
  return lines;
}

const wrong = ['f(rng.unit(), rng.unit());', 'dvec2 p((x + draw.uniform(0, 1)) * s,\n (y + draw.uniform(0, 1)) * s);', 'put(tint(rng), size(rng));'];
const right = ['f({rng.unit(), rng.unit()});', 'const double x = rng.unit(), y = rng.unit();', 'f(rng.at(1), rng.at(2));'];
let passed = 0, failed = 0;
for (const each of wrong) unordered(each).length === 1 ? ++passed : (++failed, console.error(`not found: ${each}`));
for (const each of right) unordered(each).length === 0 ? ++passed : (++failed, console.error(`refused: ${each}`));
for (const path of files(join(root, 'core'))) {
  const lines = unordered(readFileSync(path, 'utf8'));
  lines.length === 0 ? ++passed : ++failed;
  for (const line of lines) console.error(`${relative(root, path)}:${line}: two arguments draw random numbers; their order is undefined`);
}
console.log(`${passed} passed, ${failed} failed`);
if (failed > 0) exit(1);
