#!/usr/bin/env node
// Refuses sentences of more than 25 words in README.md, CONTRIBUTING.md, CHANGELOG.md, docs/ and the pages of deploy/ and clients/. Code blocks, tables and inline code are not counted:
// they contain lists and names. A sentence ends at . ! ? : or ; and white space.
//   sentences.mjs [root]
import fs from 'node:fs';
import path from 'node:path';

const root = process.argv[2] ?? '.';
const most_words = 25;

/** The paragraphs and list items of a page with the number of the line where each begins. */
function* texts_of(page) {
  const lines = page.replace(/^```[\s\S]*?^```$/gm, (block) => '\n'.repeat(block.split('\n').length - 1)).split('\n');
  let text = '', start = 0;
  for (const [index, line] of [...lines, ''].entries()) {
    const is_row = line.startsWith('|');
    if (text && (is_row || line.trim() === '' || /^\s*([-*] |\d+\. |#)/.test(line))) {
      yield { text, line: start };
      text = '';
    }
    if (!is_row && line.trim() && !line.startsWith('    ')) {
      if (!text) start = index + 1;
      text += ` ${line.trim()}`;
    }
  }
}

const sentences_of = (text) => text
  .replace(/!?\[([^\]]*)\]\([^)]*\)/g, '$1')
  .replace(/`[^`]*`/g, '')
  .split(/(?<=[.!?:;])\s+/);
const words_in = (sentence) => sentence.split(/\s+/).filter((word) => /[\p{L}\p{N}]/u.test(word)).length;

const pages = ['README.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'deploy/README.md',
  ...fs.readdirSync(path.join(root, 'clients')).map((name) => `clients/${name}/README.md`).filter((file) => fs.existsSync(path.join(root, file))),
  ...fs.readdirSync(path.join(root, 'docs'), { recursive: true }).filter((file) => file.endsWith('.md')).map((file) => `docs/${file}`)];
let failed = 0, sentences = 0;
for (const page of pages) {
  let is_clean = true;
  for (const { text, line } of texts_of(fs.readFileSync(path.join(root, page), 'utf8'))) {
    for (const sentence of sentences_of(text)) {
      sentences += 1;
      if (words_in(sentence) <= most_words) continue;
      console.log(`${page}:${line}: ${words_in(sentence)} words: ${sentence.trim()}`);
      is_clean = false;
    }
  }
  failed += is_clean ? 0 : 1;
}
if (sentences < 1000) {
  console.log('no sentences were found');
  failed += 1;
}
console.log(`${pages.length - Math.min(failed, pages.length)} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
