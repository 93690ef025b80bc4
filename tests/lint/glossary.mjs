#!/usr/bin/env node
// Refuses words that the glossary of docs/style.md replaces: those in backticks in the first column of its table, as whole words, in
// any case and inside snake_case and CamelCase names.
//   glossary.mjs [root]
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

const root = process.argv[2] ?? '.';
const checked = /^(core|server|api_schema|tests|docs|deploy|clients|web_client\/(src|tests)|\.ci)\/.*\.(h|cpp|md|mjs|ts|js|json|sh|txt|css|html|py|gd|cs|cmake|toml|yml)$|^(README|CONTRIBUTING|CHANGELOG)\.md$|^dev$|CMakeLists\.txt$/;
// The table itself, texts that are not ours, and stored bytes.
const unchecked = /^(docs\/style\.md|tests\/lint\/glossary|tests\/corpus\/|tests\/fuzz\/seeds\/|tests\/golden\/engine-|LICENSE)|package-lock\.json$/;

/** The words in backticks of the first column below the heading "Glossary". */
function refused_words(text) {
  const section = /^## Glossary\n([\s\S]*?)(?=^## |(?![\s\S]))/m.exec(text)?.[1] ?? '';
  const rows = section.split('\n').filter((line) => line.startsWith('| ')).slice(2);
  return rows.flatMap((row) => [...row.split('|')[1].matchAll(/`([^`]+)`/g)].map((match) => match[1]));
}

const words = refused_words(fs.readFileSync(path.join(root, 'docs/style.md'), 'utf8'));
const pattern = new RegExp(`(?<![A-Za-z])(${words.join('|')})(?![A-Za-z])`, 'i');

/** Lines of a file that have a refused word. */
function hits_of(file) {
  return fs.readFileSync(path.join(root, file), 'utf8').split('\n').flatMap((line, index) => {
    const word = pattern.exec(line.replace(/([a-z0-9])([A-Z])/g, '$1 $2'))?.[1];
    return word ? [`${file}:${index + 1}: "${word}"`] : [];
  });
}

const tracked = spawnSync('git', ['ls-files', '-co', '--exclude-standard'], { cwd: root, encoding: 'utf8', maxBuffer: 1 << 26 }).stdout.split('\n');
const files = tracked.filter((file) => checked.test(file) && !unchecked.test(file) && fs.existsSync(path.join(root, file)));
let failed = 0;
for (const file of files) {
  const hits = hits_of(file);
  failed += hits.length ? 1 : 0;
  for (const hit of hits) console.log(`${hit} is replaced by another term: docs/style.md, Glossary`);
}
if (words.length < 20) {
  failed += 1;
  console.log('docs/style.md: the table of the glossary was not found');
}
console.log(`${files.length - Math.min(failed, files.length)} passed, ${failed} failed`);
process.exitCode = failed ? 1 : 0;
