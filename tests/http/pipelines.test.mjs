// docs/pipelines.md and the client beside it, as a build script uses them.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, rehearsal, run, serve, until } from './support.mjs';

const docs = path.resolve(import.meta.dirname, '../../docs');
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-'));
const file_of = (name) => path.join(folder, name);
let server;
before(async () => { server = await serve(program); });
after(async () => {
  await server.stop();
  fs.rmSync(folder, { recursive: true });
});

const fetched = (request, name, env = {}) => {
  fs.writeFileSync(file_of('request.json'), JSON.stringify(request));
  return run('python3', [path.join(docs, 'examples/seedmesh.py'), file_of('request.json'), file_of(name)], { env: { SEEDMESH_URL: server.url, ...env } });
};

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

test('the Python client stores a model and receives it again only after a change of the request', async () => {
  const request = { preset: 'proctree_0', seed: 7 };
  const times = () => fs.statSync(file_of('tree.glb')).mtimeMs;
  assert.equal((await fetched(request, 'tree.glb')).status, 0);
  assert.deepEqual(fs.readFileSync(file_of('tree.glb')), (await server.post('/v1/generate', request)).bytes);
  const then = times();
  assert.equal((await fetched(request, 'tree.glb')).status, 0);
  assert.equal(times(), then);
  assert.equal((await fetched({ ...request, seed: 8 }, 'tree.glb')).status, 0);
  assert.ok(times() > then);
  assert.deepEqual(fs.readFileSync(file_of('tree.glb')), (await server.post('/v1/generate', { ...request, seed: 8 })).bytes);
});

test('the Python client reports every error with its pointer', async () => {
  const { status, err } = await fetched({ generator: 'lsystem', parameters: { axiom: 'F[', iterations: -1 } }, 'none.glb');
  assert.equal(status, 1);
  assert.match(err, /^\/parameters\/iterations: found -1/m);
  assert.match(err, /^\/parameters\/axiom:1:2: found `\[`/m);
  assert.ok(!fs.existsSync(file_of('none.glb')));
});

test('the Python client waits for a busy server as long as Retry-After requires', async () => {
  const busy = await serve(rehearsal, ['--threads', '1', '--queue', '1']);
  const slow = (seed, milliseconds) => ({ generator: 'rehearsal', seed, parameters: { bytes: 500, milliseconds } });
  try {
    const running = busy.generate(slow(1, 3000));
    await until(async () => (await busy.metric('seedmesh_workers_busy')) === 1);
    const waiting = busy.generate(slow(2, 0));
    await until(async () => (await busy.metric('seedmesh_queue_depth')) === 1);
    assert.equal((await busy.generate(slow(4, 0))).status, 429);
    const { status, err } = await fetched(slow(3, 0), 'late.glb', { SEEDMESH_URL: busy.url });
    assert.equal(status, 0, err);
    assert.equal(fs.statSync(file_of('late.glb')).size, 500);
    await Promise.all([running, waiting]);
  } finally {
    await busy.stop();
  }
});
