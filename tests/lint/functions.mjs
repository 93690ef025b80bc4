#!/usr/bin/env node
// No function of core/, server/, api_schema/ or tests/ has more lines between its braces than this. clang-tidy counts the same
// (readability-function-size), but only in files that changed. The search relies on clang-format: a body ends with a brace at the
// indentation of the function, which is 0, or 2 inside a class.
import fs from 'node:fs';
import path from 'node:path';

const root = process.argv[2] ?? '.';
const longest_function = 80;
const no_function = /^\s*(namespace|struct|class|union|enum|extern|if|for|while|switch|else|do|try|return|case|default)\b|=\s*\{$|\]\s*\{$/;

function* files_below(folder) {
  for (const entry of fs.readdirSync(path.join(root, folder), { withFileTypes: true })) {
    const name = `${folder}/${entry.name}`;
    if (entry.isDirectory() && entry.name !== 'node_modules') yield* files_below(name);
    else if (/\.(h|cpp)$/.test(name)) yield name;
  }
}

/** {name, line, length} of every function body whose brace closes at `indent` spaces. */
function* bodies(lines, indent) {
  const margin = ' '.repeat(indent);
  const starts = new RegExp(`^${margin}[A-Za-z~_\\[]`);
  let head = -1, open = -1;
  for (const [index, line] of lines.entries()) {
    if (line === `${margin}}` && open >= 0) {
      if (!no_function.test(lines[head]) && !no_function.test(lines[open])) yield { name: lines[head].trim(), line: head + 1, length: index - open - 1 };
      open = -1;
    } else if (starts.test(line)) {
      head = index;
      open = -1;
    }
    if (open < 0 && head >= 0 && line.endsWith('{') && !/^\s*(namespace|extern)\b/.test(line)) open = index;
  }
}

let passed = 0, failed = 0;
for (const file of ['core', 'server', 'api_schema', 'tests'].flatMap((folder) => [...files_below(folder)])) {
  const lines = fs.readFileSync(path.join(root, file), 'utf8').split('\n');
  for (const { name, line, length } of [...bodies(lines, 0), ...bodies(lines, 2)]) {
    if (length <= longest_function) {
      passed += 1;
    } else {
      failed += 1;
      console.log(`${file}:${line}: ${length} lines, at most ${longest_function}: ${name}`);
    }
  }
}
if (passed < 1000) {
  console.log(`only ${passed} functions were found`);
  failed += 1;
}
console.log(`${passed} passed, ${failed} failed`);
process.exitCode = failed ? 1 : 0;
