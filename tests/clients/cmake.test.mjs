// The CMake function on its sample project, and the script of the GitHub Action.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { parse } from 'yaml';
import { program, run, serve } from '../http/support.mjs';

const clients = path.resolve(import.meta.dirname, '../../clients');
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-cmake-'));
const sample = path.join(folder, 'cmake/sample'), build = path.join(folder, 'build');
const models = ['snowflake.glb', 'tree.glb', 'tree_far.glb'];
/** PATH has no program seedmesh, so that Python is used where no PROGRAM is given. */
const env = { PYTHONDONTWRITEBYTECODE: '1', SEEDMESH_URL: '', SEEDMESH_KEY: '' };
const cmake = (...args) => run('cmake', args, { env });
let server;
before(async () => {
  server = await serve(program);
  for (const name of ['cmake', 'python/src']) fs.cpSync(path.join(clients, name), path.join(folder, name), { recursive: true });
});
after(async () => {
  await server.stop();
  fs.rmSync(folder, { recursive: true });
});

/** Requests by route since the server started: all, and those of models. */
async function requests() {
  const samples = [...(await server.get('/metrics')).text.matchAll(/^seedmesh_requests_total\{(.*)\} (\d+)/gm)];
  const sum = (pattern) => samples.filter(([, labels]) => pattern.test(labels)).reduce((total, [, , count]) => total + Number(count), 0);
  return { models: sum(/route="[^"]*(generate|models)/), version: sum(/route="[^"]*version/) };
}

test('the second build transfers no model, and runs no rule that reads them', async () => {
  const configured = await cmake('-S', sample, '-B', build, '-G', 'Ninja', `-DSEEDMESH_URL=${server.url}`);
  assert.equal(configured.status, 0, configured.err);
  const first = await cmake('--build', build);
  assert.equal(first.status, 0, first.out + first.err);
  for (const name of models) assert.equal(fs.readFileSync(path.join(sample, 'assets', name)).subarray(0, 4).toString(), 'glTF');
  const packed = fs.statSync(path.join(build, 'assets.tar')).mtimeMs;
  const before_second = await requests();
  assert.ok(before_second.models >= 3, JSON.stringify(before_second));
  const second = await cmake('--build', build);
  assert.equal(second.status, 0, second.out + second.err);
  assert.match(second.out.toString(), /0 made, 3 same, 0 refused/);
  const after_second = await requests();
  assert.equal(after_second.models, before_second.models);
  assert.ok(after_second.version > before_second.version);
  assert.equal(fs.statSync(path.join(build, 'assets.tar')).mtimeMs, packed);
});

test('a changed and a new request file are made by the next build', async () => {
  fs.writeFileSync(path.join(sample, 'assets/snowflake.seedmesh'), '{ "preset": "koch_snowflake", "seed": 8 }');
  fs.writeFileSync(path.join(sample, 'assets/island.seedmesh'), '{ "preset": "koch_island" }');
  const packed = fs.statSync(path.join(build, 'assets.tar')).mtimeMs;
  const { status, out, err } = await cmake('--build', build);
  assert.equal(status, 0, out + err);
  assert.match(out.toString(), /2 made, 2 same, 0 refused/);
  assert.ok(fs.existsSync(path.join(sample, 'assets/island.glb')));
  assert.ok(fs.statSync(path.join(build, 'assets.tar')).mtimeMs > packed);
});

test('a refused request ends the build and names its line', async () => {
  fs.writeFileSync(path.join(sample, 'assets/island.seedmesh'), '{ "preset": "koch_island",\n "parameters": { "iterations": -1 } }');
  const { status, out } = await cmake('--build', build);
  assert.notEqual(status, 0);
  assert.match(out.toString(), /island\.seedmesh:2:32: \/parameters\/iterations: found -1/);
  fs.rmSync(path.join(sample, 'assets/island.seedmesh'));
});

test('the program makes the models of a build, or asks a server, and accepts those that Python asked for', async () => {
  const there = path.join(folder, 'there');
  assert.equal((await cmake('-S', sample, '-B', there, '-G', 'Ninja', `-DSEEDMESH_PROGRAM=${program}`, `-DSEEDMESH_URL=${server.url}`)).status, 0);
  const before_build = await requests();
  assert.match((await cmake('--build', there)).out.toString(), /0 made, 3 same, 0 refused/);
  assert.equal((await requests()).models, before_build.models);
  for (const name of [...models, 'seedmesh.lock']) fs.rmSync(path.join(sample, 'assets', name));
  const here = path.join(folder, 'here');
  assert.equal((await cmake('-S', sample, '-B', here, '-G', 'Ninja', `-DSEEDMESH_PROGRAM=${program}`)).status, 0);
  for (const made of [3, 0]) {
    const { status, out, err } = await cmake('--build', here);
    assert.equal(status, 0, out + err);
    assert.match(out.toString(), new RegExp(`${made} made, ${3 - made} same, 0 refused`));
  }
});

test('the script of the GitHub Action passes on current models and fails on others', async () => {
  const action = parse(fs.readFileSync(path.join(clients, 'github_action/action.yml'), 'utf8'));
  const [step] = action.runs.steps;
  assert.deepEqual([action.runs.using, step.shell], ['composite', 'bash']);
  for (const value of Object.values(step.env)) for (const [, name] of value.matchAll(/inputs\.(\w+)/g)) assert.ok(action.inputs[name], name);
  const act = (check, more = {}) => run('bash', ['-e', '-c', step.run], { env: { ...env, PROGRAM: '', DIRECTORY: path.join(sample, 'assets'), CHECK: check, PYTHONPATH: path.join(folder, 'python/src'), ...more } });
  const good = await act('true');
  assert.equal(good.status, 0, good.out + good.err);
  fs.appendFileSync(path.join(sample, 'assets/tree.glb'), 'x');
  const bad = await act('true');
  assert.deepEqual([bad.status, bad.out.toString()], [1, 'changed tree.glb\n1 changed, 2 same, 0 refused\n']);
  assert.equal((await act('yes')).status, 2);
  assert.equal((await act('true', { PROGRAM: program })).status, 1);
  assert.match((await act('false', { PROGRAM: program, SEEDMESH_URL: server.url })).out.toString(), /^made tree.glb\n1 made, 2 same/);
  assert.equal((await act('true', { PROGRAM: program })).status, 0);
});
