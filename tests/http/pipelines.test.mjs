// The command of docs/pipelines.md, as a build script uses it.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, run, serve } from './support.mjs';

const docs = path.resolve(import.meta.dirname, '../../docs');
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-'));
const file_of = (name) => path.join(folder, name);
let server;
before(async () => { server = await serve(program); });
after(async () => {
  await server.stop();
  fs.rmSync(folder, { recursive: true });
});

test('the command of a build script saves the model, revalidates it, and ends the build on an error', async () => {
  const [, line] = /```sh\n(curl [\s\S]*?)```/.exec(fs.readFileSync(path.join(docs, 'pipelines.md'), 'utf8'));
  const shell = (change) => run('sh', ['-c', `cd ${folder}; ${change(line.replace('http://127.0.0.1:8080', server.url).replace('curl ', "curl -s -w '%{http_code}' "))}`]);
  const first = await shell((text) => text);
  assert.deepEqual([first.status, first.out.toString()], [0, '200'], first.err);
  const bytes = fs.readFileSync(file_of('oak.glb'));
  assert.deepEqual(bytes, (await server.post('/v1/generate', { preset: 'oak', seed: 7, output: { profile: 'unity', lods: 3 } })).bytes);
  const second = await shell((text) => text);
  assert.deepEqual([second.status, second.out.toString()], [0, '304'], second.err);
  assert.deepEqual(fs.readFileSync(file_of('oak.glb')), bytes);
  const refused = await shell((text) => text.replace('output.lods=3', 'output.lods=9'));
  assert.equal(refused.status, 1);
  assert.match(refused.out.toString(), /"pointer":"\/output.lods"/);
});
