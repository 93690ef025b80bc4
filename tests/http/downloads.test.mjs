// Names of downloaded files: curl saves a permalink under the name of its model, and archives unpack into one folder.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, run, serve } from './support.mjs';

let server;
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-downloads-'));
before(async () => { server = await serve(program); });
after(async () => {
  await server?.stop();
  fs.rmSync(folder, { recursive: true });
});

/** The files below a folder, by their paths inside of it. */
const files_of = (here) => fs.readdirSync(here, { recursive: true }).filter((name) => fs.statSync(path.join(here, name)).isFile());

/** Runs a program inside a new folder. Resolves to the folder. */
async function inside(name, command, args) {
  const here = path.join(folder, name);
  fs.mkdirSync(here, { recursive: true });
  const { status, err } = await run('/bin/sh', ['-c', 'cd "$0" && exec "$@"', here, command, ...args]);
  assert.equal(status, 0, err.toString());
  return here;
}

test('curl -OJ saves a permalink that is too long for a file name as oak_3.glb', async () => {
  const model = await server.get('/v1/presets/oak.glb?seed=3');
  const link = model.headers['content-location'];
  assert.ok(link.length > 255, `${link.length} characters`);
  const here = await inside('curl', 'curl', ['-sSOJ', `${server.url}${link}`]);
  assert.deepEqual(fs.readdirSync(here), ['oak_3.glb']);
  assert.ok(fs.readFileSync(path.join(here, 'oak_3.glb')).equals(model.bytes));
});

test('archives of three models are unpacked into one folder without overwriting', async () => {
  let here, count = 0;
  const contents = new Map();
  for (const target of ['oak.zip?seed=3', 'oak.zip?seed=4', 'birch.zip?seed=3']) {
    const { status, bytes } = await server.get(`/v1/presets/${target}&output.lods=2&output.textures=64`);
    assert.equal(status, 200);
    const archive = path.join(folder, 'model.zip');
    fs.writeFileSync(archive, bytes);
    const single = await inside(`single${count}`, 'python3', ['-m', 'zipfile', '-e', archive, '.']);
    here = await inside('together', 'python3', ['-m', 'zipfile', '-e', archive, '.']);
    for (const name of files_of(single)) {
      const content = fs.readFileSync(path.join(single, name));
      assert.ok(!contents.has(name) || contents.get(name).equals(content), `${name} has two contents`);
      contents.set(name, content);
    }
    count += 1;
  }
  assert.equal(files_of(here).length, contents.size);
  assert.ok([...contents.keys()].filter((name) => name.endsWith('.gltf')).length >= 3, [...contents.keys()].join(' '));
});
