// The OpenAPI document lints clean, with every schema inside.
import { test } from 'node:test';
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import path from 'node:path';

const root = path.resolve(import.meta.dirname, '../..');
const build = process.env.SEEDMESH_BUILD ?? path.join(root, 'build/release');

test('openapi.json has neither errors nor warnings', () => {
  const run = spawnSync(path.join(root, 'tests/node_modules/.bin/redocly'), ['lint', '--format', 'json', path.join(build, 'generated/openapi.json')],
    { encoding: 'utf8', cwd: path.join(root, 'tests'), env: { ...process.env, REDOCLY_TELEMETRY: 'off', REDOCLY_SUPPRESS_UPDATE_NOTICE: 'true' } });
  const { totals, problems } = JSON.parse(run.stdout);
  assert.deepEqual([totals.errors, totals.warnings, run.status], [0, 0, 0], JSON.stringify(problems, null, 1));
});
