// Spectral and Redocly have nothing to say about the OpenAPI document, and two generators make clients of it that compile strictly and work.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, run, serve } from '../http/support.mjs';

const here = import.meta.dirname;
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-openapi-'));
const document = path.join(folder, 'openapi.json');
const tool = (name, ...args) => run(path.join(here, 'node_modules/.bin', name), args);
let server;
before(async () => {
  server = await serve(program);
  fs.writeFileSync(document, process.env.SEEDMESH_OPENAPI ? fs.readFileSync(process.env.SEEDMESH_OPENAPI) : (await server.get('/openapi.json')).text);
  fs.symlinkSync(path.join(here, 'node_modules'), path.join(folder, 'node_modules'));
  fs.copyFileSync(path.join(here, 'use.ts'), path.join(folder, 'use.ts'));
  fs.writeFileSync(path.join(folder, 'package.json'), '{"type": "commonjs"}');
  fs.writeFileSync(path.join(folder, '.spectral.yaml'), 'extends: ["spectral:oas"]\n');
});
after(async () => {
  await server?.stop();
  fs.rmSync(folder, { recursive: true });
});

test('spectral reports nothing', async () => {
  const { status, out } = await tool('spectral', 'lint', document, '--ruleset', path.join(folder, '.spectral.yaml'), '--fail-severity', 'hint');
  assert.equal(status, 0, out.toString());
});

test('Redocly reports nothing', async () => {
  const { status, out, err } = await tool('redocly', 'lint', document, '--extends=recommended', '--format=json');
  assert.equal(status, 0, out + err);
  assert.deepEqual(JSON.parse(out.toString()).totals, { errors: 0, warnings: 0, ignored: 0 });
});

test('clients of openapi-typescript and hey-api compile and work', async () => {
  const types = await tool('openapi-typescript', document, '--default-non-nullable=false', '-o', path.join(folder, 'made/api.d.ts'));
  assert.equal(types.status, 0, types.err);
  const hey = await tool('openapi-ts', '-i', document, '-o', path.join(folder, 'made/hey'), '-c', '@hey-api/client-fetch');
  assert.equal(hey.status, 0, hey.err + hey.out);
  const options = ['--strict', '--skipLibCheck', '--target', 'es2022', '--module', 'commonjs', '--moduleResolution', 'node10', '--esModuleInterop', '--outDir', path.join(folder, 'out')];
  const compiled = await tool('tsc', ...options, path.join(folder, 'use.ts'));
  assert.equal(compiled.status, 0, compiled.out.toString());
  const { status, out, err } = await run(process.execPath, [path.join(folder, 'out/use.js')], { env: { SEEDMESH_URL: server.url } });
  assert.equal(status, 0, err);
  const expected = {
    model: (await server.generate({ generator: 'lsystem', parameters: { axiom: 'FFF' } })).bytes.length,
    preset: (await server.get('/v1/presets/oak.glb?seed=3&output.textures=64')).bytes.length,
    pointer: '/preset',
  };
  const presets = (await server.get('/v1/presets')).json.presets.length;
  assert.deepEqual(JSON.parse(out.toString()), { openapi_fetch: expected, hey_api: expected, presets, generator: 'tree' });
});
