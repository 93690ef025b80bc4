// The OpenAPI document lints clean, with every schema inside.
import { test } from 'node:test';
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

const root = path.resolve(import.meta.dirname, '../..');
const build = process.env.SEEDMESH_BUILD ?? path.join(root, 'build/release');

test('openapi.json has neither errors nor warnings', () => {
  const run = spawnSync(path.join(root, 'tests/node_modules/.bin/redocly'), ['lint', '--format', 'json', path.join(build, 'generated/openapi.json')],
    { encoding: 'utf8', cwd: path.join(root, 'tests'), env: { ...process.env, REDOCLY_TELEMETRY: 'off', REDOCLY_SUPPRESS_UPDATE_NOTICE: 'true' } });
  const { totals, problems } = JSON.parse(run.stdout);
  assert.deepEqual([totals.errors, totals.warnings, run.status], [0, 0, 0], JSON.stringify(problems, null, 1));
});

// What generators of clients need, and redocly does not report.
test('every array names its items, every body has a schema, and no header is a parameter that tools ignore', () => {
  const document = JSON.parse(fs.readFileSync(path.join(build, 'generated/openapi.json'), 'utf8'));
  const found = { arrays: 0, bodies: 0, parameters: 0 }, errors = [];
  const visit = (node, pointer) => {
    if (node === null || typeof node !== 'object' || /\/(examples?|default|enum|value)$/.test(pointer)) return;
    if ([node.type].flat().includes('array') && ++found.arrays && !node.items) errors.push(`${pointer}: no items`);
    if (node.in === 'header' && ++found.parameters && /^(accept|content-type|authorization)$/i.test(node.name)) errors.push(`${pointer}: ${node.name}`);
    for (const [type, body] of Object.entries(node.content ?? {})) if (type.includes('/') && ++found.bodies && !body.schema) errors.push(`${pointer}: ${type} has no schema`);
    for (const [key, child] of Object.entries(node)) visit(child, `${pointer}/${key}`);
  };
  visit(document, '');
  assert.deepEqual(errors, []);
  assert.ok(found.arrays > 50 && found.bodies > 20 && found.parameters > 0, JSON.stringify(found));
});

test('each generator has a request of its own', () => {
  const { schemas } = JSON.parse(fs.readFileSync(path.join(build, 'generated/openapi.json'), 'utf8')).components;
  const named = schemas.typed_request.oneOf.map(({ $ref }) => $ref.split('/').pop().replace('_request', ''));
  const files = fs.readdirSync(path.join(root, 'api_schema')).map((file) => /^(\w+)\.schema\.json$/.exec(file)?.[1]);
  const generators = files.filter((name) => name && !['common', 'output', 'problem', 'request'].includes(name));
  assert.deepEqual(named.sort(), [...generators, 'preset'].sort());
});
