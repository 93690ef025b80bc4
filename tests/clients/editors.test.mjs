// Static checks of the add-ons for Godot and Unity, and the plugin for Unreal on a stand-in for its module. No editor runs here.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, run, serve } from '../http/support.mjs';

const clients = path.resolve(import.meta.dirname, '../../clients');
const read = (...names) => fs.readFileSync(path.join(clients, ...names), 'utf8');
const files_of = (name) => fs.readdirSync(path.join(clients, name), { recursive: true, withFileTypes: true }).map((each) => path.relative(path.join(clients, name), path.join(each.parentPath ?? each.path, each.name)));
let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

/** Code without comments and texts. Interpolated parts of a C# text count as text. */
const bare = (text, comment) => text.replace(/"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'/g, '""').replace(comment, '');

/** The first bracket that has no partner, or nothing. */
function unmatched(text) {
  const open = [], pairs = { ')': '(', ']': '[', '}': '{' };
  for (const [index, sign] of [...text].entries()) {
    if ('([{'.includes(sign)) open.push({ sign, index });
    else if (pairs[sign] && open.pop()?.sign !== pairs[sign]) return `${sign} in line ${text.slice(0, index).split('\n').length}`;
  }
  return open.length ? `${open[0].sign} in line ${text.slice(0, open[0].index).split('\n').length}` : '';
}

test('a bracket without a partner is found', () => {
  assert.equal(unmatched(bare('f(a[")"])\ng(', /#.*/g)), '( in line 2');
  assert.equal(unmatched(bare('f(a[")"]) # (', /#.*/g)), '');
});

test('Godot: the plug-in names its script, preloads exist, brackets match, and lines are indented by tabs', () => {
  const folder = 'godot/addons/seedmesh';
  const config = read(folder, 'plugin.cfg');
  for (const key of ['name', 'description', 'author', 'version', 'script']) assert.match(config, new RegExp(`^${key}=".+"$`, 'm'));
  assert.ok(fs.existsSync(path.join(clients, folder, /^script="(.*)"$/m.exec(config)[1])));
  const scripts = files_of(folder).filter((name) => name.endsWith('.gd'));
  assert.ok(scripts.length >= 5);
  for (const name of scripts) {
    const text = read(folder, name);
    assert.equal(unmatched(bare(text, /#.*/g)), '', name);
    assert.doesNotMatch(text, /^ +\S/m, `${name} is indented by spaces`);
    for (const [, other] of text.matchAll(/preload\("(.*?)"\)/g)) assert.ok(fs.existsSync(path.join(clients, folder, other)), `${name}: ${other}`);
    for (const line of bare(text, /#.*/g).split('\n')) if (/^\t*(if|elif|else|for|while|func|static func)\b/.test(line) && !/:\s*\S.*$|lambda/.test(line)) assert.match(line.trimEnd(), /:$/, `${name}: ${line}`);
  }
});

test('Unity: JSON is valid, every file has a .meta of its own, and brackets match', () => {
  const manifest = JSON.parse(read('unity/package.json'));
  assert.match(manifest.name, /^com\.[a-z.]+$/);
  assert.ok(manifest.dependencies['com.unity.cloud.gltfast']);
  const files = files_of('unity');
  for (const name of files.filter((each) => each.endsWith('.asmdef'))) assert.equal(`${JSON.parse(read('unity', name)).name}.asmdef`, path.basename(name));
  assert.deepEqual(JSON.parse(read('unity/Editor/Seedmesh.Editor.asmdef')).includePlatforms, ['Editor']);
  const ids = new Set();
  for (const name of files.filter((each) => !each.endsWith('.meta'))) ids.add(/^guid: ([0-9a-f]{32})$/m.exec(read('unity', `${name}.meta`))[1]);
  assert.equal(ids.size, files.length / 2, 'a .meta without a file, or two with one guid');
  for (const name of files.filter((each) => each.endsWith('.cs'))) {
    assert.equal(unmatched(bare(read('unity', name), /\/\/.*/g)), '', name);
    assert.match(read('unity', name), new RegExp(`class ${path.basename(name, '.cs')}\\b`));
  }
});

const mcs = ['/usr/bin/mcs', '/usr/local/bin/mcs'].find((file) => fs.existsSync(file));

test('Unity: a compiler accepts the C# against the signatures of Unity that it uses', { skip: mcs ? false : 'Mono is not installed: ./dev setup clients' }, async () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-unity-'));
  const scripts = (name) => files_of(name).filter((each) => each.endsWith('.cs')).map((each) => path.join(clients, name, each));
  const compile = (out, sources, ...libraries) => run(mcs, ['-langversion:7', '-warnaserror', '-target:library', `-out:${path.join(folder, out)}`, ...libraries.map((each) => `-r:${each}`), ...sources]);
  const made = (name) => path.join(folder, name);
  try {
    for (const [out, sources, ...libraries] of [
      ['api.dll', [path.join(import.meta.dirname, 'unity/unity_api.cs')]],
      ['runtime.dll', scripts('unity/Runtime'), made('api.dll')],
      ['editor.dll', scripts('unity/Editor'), made('api.dll'), made('runtime.dll'), 'System.Net.Http.dll', 'System.IO.Compression.dll'],
    ]) {
      const { status, out: text, err } = await compile(out, sources, ...libraries);
      assert.equal(status, 0, text + err);
    }
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
});

test('Unreal: the plug-in is valid JSON, the Python runs on a stand-in, and the archive is complete', async () => {
  assert.equal(JSON.parse(read('unreal/Seedmesh.uplugin')).FileVersion, 3);
  const { status, out, err } = await run('python3', [path.join(clients, 'unreal/tests/run.py')], { env: { SEEDMESH_URL: server.url, PYTHONDONTWRITEBYTECODE: '1' } });
  assert.deepEqual([status, out.toString()], [0, 'ok\n'], err);
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-unreal-'));
  try {
    const archive = path.join(folder, 'unreal.zip');
    assert.equal((await run('python3', [path.join(clients, 'unreal/build.py'), archive])).status, 0);
    assert.equal((await run('python3', ['-m', 'zipfile', '-e', archive, folder])).status, 0);
    for (const name of ['Seedmesh.uplugin', 'Content/Python/init_unreal.py', 'Content/Python/seedmesh/client.py']) assert.ok(fs.existsSync(path.join(folder, 'Seedmesh', name)), name);
    const compiled = await run('python3', ['-m', 'py_compile', path.join(folder, 'Seedmesh/Content/Python/init_unreal.py')]);
    assert.equal(compiled.status, 0, compiled.err);
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
});
