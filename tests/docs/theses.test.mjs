// The page of the theses is what the program gives now, and no number differs from its thesis without a note.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { before, test } from 'node:test';
import { expected_of, measure_all, page, page_of, presets, rows, status_of } from './theses.mjs';

const root = path.resolve(import.meta.dirname, '../..');
const name_of = (row) => `${row.thesis}, ${row.where}, ${row.what}`;
let found;

before(async () => { found = await measure_all(); });

test('docs/theses.md is current; tests/docs/theses.mjs writes it', () => {
  assert.deepEqual(fs.readFileSync(path.join(root, page), 'utf8').split('\n'), page_of(found).split('\n'));
});

test('no number differs from the thesis without a note', () => {
  const unexplained = rows.flatMap((row, index) => (status_of(row, found[index]) === 'differs' && !row.note
    ? [`${name_of(row)}: expected ${JSON.stringify(expected_of(row))}, found ${JSON.stringify(found[index])}`] : []));
  assert.deepEqual(unexplained, []);
});

test('every row measures something, or states what is missing or why there is no model', () => {
  assert.deepEqual(rows.filter((row) => [row.take, row.missing, row.no_model].filter(Boolean).length !== 1).map(name_of), []);
  assert.deepEqual(rows.filter((row) => row.printed !== undefined && row.implied !== undefined).map(name_of), []);
});

test('every preset with the tag thesis has a row, and every preset of a row exists', () => {
  const named = new Set(rows.flatMap((row) => [row.preset, ...[row.request ?? []].flat().map(({ preset }) => preset)]).filter(Boolean));
  const noted = rows.map(({ note }) => note ?? '').join(' ');
  const tagged = [...presets].filter(([, file]) => JSON.parse(fs.readFileSync(path.join(root, file), 'utf8')).tags?.includes('thesis')).map(([name]) => name);
  assert.ok(tagged.length > 50);
  assert.deepEqual(tagged.filter((name) => !named.has(name) && !noted.includes(`\`${name}\``)), []);
  assert.deepEqual([...named].filter((name) => !presets.has(name)), []);
});

test('all five theses have rows', () => {
  for (const thesis of ['Kogovšek', 'Tunnel', 'Hutsko', 'Tajić', 'Sojma']) assert.ok(rows.filter((row) => row.thesis === thesis).length > 15, thesis);
});
