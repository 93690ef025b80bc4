#!/usr/bin/env node
// Messages are for people; code decides by the kind of an issue (docs/decisions/0001-errors.md). Refuses code that
// searches or compares the text of a message:  messages.mjs [directory of the repository]
import { readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { argv, exit } from 'node:process';

const root = argv[2] ?? '.';
const folders = ['core', 'server', 'api_schema', 'web_client/src', 'clients'];
const searches = 'find|rfind|find_first_of|contains|starts_with|ends_with|compare|substr|includes|startsWith|endsWith|indexOf|match|search|slice|split';
const message = String.raw`(?:[\w\])>]\??(?:\.|->)message|\bmessage|\bwhat\(\))`;
const patterns = [
  new RegExp(String.raw`${message}\??\.(?:${searches})\(`),  // message.find("...")
  new RegExp(String.raw`${message}\s*[!=]==?\s*["'\x60]\w`),  // message == "words"
  new RegExp(String.raw`\b(?:exec|test|regex_search|regex_match)\([^;]*\bmessage\b`),  // /words/.exec(message)
  new RegExp(String.raw`\b(?:find|contains)\((?:\w+(?:\.|->))+message\b`),
];

function* files(folder) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory() && entry.name !== 'node_modules') yield* files(path);
    else if (/\.(cpp|h|ts|py)$/.test(entry.name)) yield path;
  }
}

let found = 0;
for (const folder of folders) {
  for (const path of files(join(root, folder))) {
    readFileSync(path, 'utf8').split('\n').forEach((line, index) => {
      if (!patterns.some((pattern) => pattern.test(line))) return;
      found += 1;
      console.error(`${relative(root, path)}:${index + 1}: searches a message for words: ${line.trim()}`);
    });
  }
}
if (found > 0) exit(1);
