// The table of attributes in docs/buildings.md against the declarations of the blueprints.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';

const root = path.resolve(import.meta.dirname, '../..');
const folder = path.join(root, 'core/generators/building/blueprints');

/** "`floors` 1 to 4; `roof` gable, hip" of a file of rules; levels of detail are chosen by the output. */
function attributes_of(rules) {
  return [...rules.matchAll(/^@(Range|Enum)\(([^)]*)\)\s+attr (\w+)/gm)].filter(([, , , name]) => name !== 'lod').map(([, kind, values, name]) => {
    const list = values.split(',').map((value) => value.trim().replaceAll('"', ''));
    return `\`${name}\` ${kind === 'Range' ? list.join(' to ') : list.join(', ')}`;
  }).join('; ');
}

test('docs/buildings.md has the ranges of all attributes of all blueprints', () => {
  const page = fs.readFileSync(path.join(root, 'docs/buildings.md'), 'utf8');
  const files = fs.readdirSync(folder).filter((name) => name.endsWith('.cga'));
  assert.ok(files.length >= 10);
  for (const name of files) {
    const row = `| \`${name.slice(0, -4)}\` | ${attributes_of(fs.readFileSync(path.join(folder, name), 'utf8'))} |`;
    assert.ok(page.includes(row), `expected this row:\n${row}`);
  }
});
