#!/usr/bin/env node
// Messages are for people; code decides by the kind of an issue (docs/decisions/0001-errors.md). Refuses code that
// searches, cuts or compares the text of a message, or passes it to a function that is not known to store or show it
// whole. Tests may match messages, but not search them by hand:  messages.mjs [directory of the repository]
import { readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { argv, exit } from 'node:process';

const root = argv[2] ?? '.';
const folders = ['core', 'server', 'api_schema', 'web_client/src', 'clients'];
const searches = 'find|rfind|find_first_of|contains|starts_with|ends_with|compare|substr|includes|startsWith|endsWith|indexOf|lastIndexOf|match|matchAll|search|slice|substring|split|replace|replaceAll|remove_prefix|partition|removeprefix|removesuffix|startswith|endswith';
const message = String.raw`(?:[\w\])>]\??(?:\.|->)message|\bmessage|\bwhat\(\))`;
const patterns = [
  new RegExp(String.raw`${message}\??\.(?:${searches})\(`),  // message.find("...")
  new RegExp(String.raw`${message}\s*[!=]==?\s*["'\x60]\w`),  // message == "words"
  new RegExp(String.raw`\b(?:exec|test|regex_search|regex_match)\([^;]*\bmessage\b`),  // /words/.exec(message)
  new RegExp(String.raw`\b(?:find|contains)\((?:\w+(?:\.|->))+message\b`),
  /(?<!return \{)IssueKind::conflict\s*,/,  // conflict_with({...}) also says which members are in conflict
];

/** The functions that may receive a message. They store it or show it, where `brief` of the
 * page shortens lists of names for the eye. Add a name only if that is true of it. */
const receivers = new Set(('if while filter move tie stringify ' +  // no function, or one that changes no text
  'Error SchemaError super Busy Refusal push_back emplace_back append add insert set member ' +
  'issue_at invalid_input report abandon refuse refused error_if add_missing warn add_warning print_warning ' +
  'problem internal_error fail fprintf text line_of with_hint ' +
  'el map issues brief say sentence with_groups state spot print').split(' '));

/** The name of the function in whose arguments the position lies; undefined outside of calls. */
function receiver(text, position) {
  let depth = 0;
  for (let i = position - 1; i > 0 && position - i < 1000; --i) {
    if (text[i] === ')') depth += 1;
    if (text[i] === '(' && --depth < 0) return /(\w*)\s*$/.exec(text.slice(Math.max(0, i - 80), i))[1];
    if (depth === 0 && ';{}'.includes(text[i])) return undefined;
  }
  return undefined;
}

const passed = /(?:\.|->)message\b|\["message"\]|\['message'\]|\bwhat\(\)/g;

function* files(folder) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory() && entry.name !== 'node_modules') yield* files(path);
    else if (/\.(cpp|h|ts|py)$/.test(entry.name)) yield path;
  }
}

let found = 0;
function refuse(path, line, text, reason) {
  found += 1;
  console.error(`${relative(root, path)}:${line}: ${reason}: ${text.trim()}`);
}

for (const folder of folders) {
  for (const path of files(join(root, folder))) {
    const text = readFileSync(path, 'utf8'), lines = text.split('\n');
    lines.forEach((line, index) => {
      if (patterns.some((pattern) => pattern.test(line))) refuse(path, index + 1, line, 'decides by the words of a message');
    });
    for (const match of text.matchAll(passed)) {
      const name = receiver(text, match.index);
      if (!name || receivers.has(name)) continue;
      const index = text.slice(0, match.index).split('\n').length - 1;
      refuse(path, index + 1, lines[index], `passes a message to ${name}, which is not known to keep it whole`);
    }
  }
}
for (const path of files(join(root, 'tests'))) {
  readFileSync(path, 'utf8').split('\n').forEach((line, index) => {
    if (path.endsWith('.cpp') && patterns[0].test(line)) refuse(path, index + 1, line, 'searches the words of a message; compare kinds, or the whole message');
  });
}
if (found > 0) exit(1);
