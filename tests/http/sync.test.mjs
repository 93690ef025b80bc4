// `seedmesh sync`: the models of request files, here and from a server, on the lock file that the Python client shares.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { createHash } from 'node:crypto';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, rehearsal, run, serve, until } from './support.mjs';

const root = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-sync-'));
const python_path = path.resolve(import.meta.dirname, '../../clients/python/src');
const env = { SEEDMESH_KEY: '', SEEDMESH_URL: '', PYTHONPATH: python_path, PYTHONDONTWRITEBYTECODE: '1' };
const koch = { preset: 'koch_snowflake', seed: 2 };
const rehearse = (seed, parameters) => ({ generator: 'rehearsal', seed, parameters: { bytes: 500, ...parameters } });
let server;
before(async () => { server = await serve(program); });
after(async () => {
  await server.stop();
  fs.rmSync(root, { recursive: true });
});

/** A directory with files; values that are no texts are written as JSON. */
function directory(name, files) {
  const made = path.join(root, name);
  for (const [file, value] of Object.entries(files)) {
    fs.mkdirSync(path.dirname(path.join(made, file)), { recursive: true });
    fs.writeFileSync(path.join(made, file), typeof value === 'string' ? value : JSON.stringify(value));
  }
  return {
    path: made,
    file: (each) => path.join(made, each),
    read: (each) => fs.readFileSync(path.join(made, each)),
    names: () => fs.readdirSync(made, { recursive: true }).filter((each) => fs.statSync(path.join(made, each)).isFile()).sort(),
    lock: () => JSON.parse(fs.readFileSync(path.join(made, 'seedmesh.lock'))).files,
  };
}

async function sync(each, ...flags) {
  const { status, out, err } = await run(program, ['sync', each.path, ...flags], { env });
  return { status, out: out.toString(), err };
}
const python = async (each, ...flags) => run('python3', ['-m', 'seedmesh', 'sync', each.path, '--server', server.url, ...flags], { env });

test('models are made once, with the bytes of the server', async () => {
  const each = directory('once', { 'a.seedmesh': koch, 'deep/b.seedmesh': { $schema: 'request.json', preset: 'koch_snowflake', name: 'snow', output: { format: 'gltf' } }, '.hidden/c.seedmesh': koch });
  const first = await sync(each);
  assert.deepEqual([first.status, first.out], [0, 'made a.glb\nmade deep/snow.gltf\n2 made, 0 same, 0 refused\n'], first.err);
  assert.deepEqual(each.read('a.glb'), (await server.generate(koch)).bytes);
  assert.deepEqual(each.names(), ['.hidden/c.seedmesh', 'a.glb', 'a.seedmesh', 'deep/b.seedmesh', 'deep/snow.gltf', 'seedmesh.lock']);
  const written = fs.statSync(each.file('seedmesh.lock')).mtimeMs;
  assert.deepEqual(await sync(each), { status: 0, out: '0 made, 2 same, 0 refused\n', err: '' });
  assert.equal(fs.statSync(each.file('seedmesh.lock')).mtimeMs, written);
  assert.equal((await sync(each, '--list')).out, `${each.file('a.glb')}\n${each.file('deep/snow.gltf')}\n`);
});

test('a directory without request files is reported', async () => {
  const each = directory('none', { 'a.json': koch });
  const { status, out, err } = await sync(each);
  assert.deepEqual([status, out], [0, '0 made, 0 same, 0 refused\n']);
  assert.match(err, /none: found no request files; their names end in \.seedmesh/);
});

test('the program and the Python client write the same lock file and accept that of the other', async () => {
  const files = { 'ä b.seedmesh': koch, 'c.seedmesh': { ...koch, outputs: { 'c.glb': {}, 'c.zip': { format: 'zip' } } } };
  const here = directory('lock_here', files), there = directory('lock_there', files), asked = directory('lock_asked', files);
  assert.equal((await sync(here)).status, 0);
  assert.equal((await python(there)).status, 0);
  assert.equal((await sync(asked, '--server', server.url)).status, 0);
  assert.equal(there.read('seedmesh.lock').toString(), here.read('seedmesh.lock').toString());
  assert.equal(asked.read('seedmesh.lock').toString(), here.read('seedmesh.lock').toString());
  assert.equal((await python(here, '--check')).out.toString(), '0 changed, 3 same, 0 refused\n');
  assert.equal((await sync(there, '--check')).out, '0 changed, 3 same, 0 refused\n');
});

test('a check ends with 1 on any drift and writes nothing', async () => {
  const each = directory('drift', { 'a.seedmesh': koch, 'b.seedmesh': { ...koch, seed: 3 }, 'c.seedmesh': { ...koch, seed: 4 } });
  assert.deepEqual(await sync(each, '--check'), { status: 1, out: 'changed a.glb\nchanged b.glb\nchanged c.glb\n3 changed, 0 same, 0 refused\n', err: '' });
  assert.ok(!fs.existsSync(each.file('seedmesh.lock')));
  assert.equal((await sync(each)).status, 0);
  const bytes = each.read('a.glb');
  bytes[bytes.length - 1] ^= 1;
  fs.writeFileSync(each.file('a.glb'), bytes);
  fs.rmSync(each.file('b.glb'));
  fs.rmSync(each.file('c.seedmesh'));
  assert.deepEqual(await sync(each, '--check'), { status: 1, out: 'changed a.glb\nchanged b.glb\nsurplus c.glb\n3 changed, 0 same, 0 refused\n', err: '' });
  assert.deepEqual(each.read('a.glb'), bytes);
  const lock = fs.readFileSync(each.file('seedmesh.lock'), 'utf8');
  fs.writeFileSync(each.file('seedmesh.lock'), lock.replaceAll(/"engine": "[^"]*"/g, '"engine": "2-0"'));
  assert.match((await sync(each, '--check')).out, /^changed a.glb\nchanged b.glb/);
  assert.match((await sync(each)).out, /^made b.glb\nmade a.glb\nremoved c.glb\n2 made/);
  assert.equal((await sync(each, '--check')).status, 0);
  assert.deepEqual(each.names(), ['a.glb', 'a.seedmesh', 'b.glb', 'b.seedmesh', 'seedmesh.lock']);
});

test('errors name file, line, column and pointer, and the other models are made', async () => {
  const each = directory('errors', {
    'a.seedmesh': '{\n "generator": "lsystem",\n "parameters": {\n  "axiom": "F[", "iterations": -1}}', 'b.seedmesh': '{"seed": 1,\n "seed": 2}', 'c.seedmesh': '{"seed": }',
    'd.seedmesh': '{"preset": "oak", "name": "../up"}', 'e.seedmesh': '[]', 'f.seedmesh': `${'['.repeat(100000)}`, 'g.seedmesh': koch,
    'h.seedmesh': '{"preset": "koch_snowflake",\n "outputs": {"h.glb": {},\n "i.glb": {"lods": 99}}}', 'j.seedmesh': '{"preset": "koch_snowflake", "name": "g"}',
  });
  for (const flags of [[], [], ['--server', server.url]]) {
    const { status, out } = await sync(each, ...flags);
    assert.equal(status, 1);
    for (const line of ['a.seedmesh:4:12: /parameters/axiom: found `[` without its `]` (line 1, column 2 of this text)', 'a.seedmesh:4:32: /parameters/iterations: found -1', 'b.seedmesh:2:2: the key "seed" is given twice',
      'c.seedmesh:1:10: ', 'd.seedmesh:1:27: /name: ', 'e.seedmesh:1:1: ', 'f.seedmesh:1:', 'h.seedmesh:3:20: /outputs/i.glb/lods: found 99', `j.seedmesh:1:1: makes g.glb, which ${each.file('g.seedmesh')} makes, too`]) {
      assert.ok(out.includes(`refused ${each.path}/${line}`), `${line} is not in\n${out}`);
    }
  }
  assert.ok(fs.existsSync(each.file('g.glb')) && fs.existsSync(each.file('h.glb')) && !fs.existsSync(each.file('i.glb')));
});

test('a request that is only written otherwise is neither made nor sent again', async () => {
  const each = directory('written', { 'a.seedmesh': koch });
  assert.equal((await sync(each)).status, 0);
  for (const [text, flags] of [['{"seed": 2,\n "preset": "koch_snowflake"}', []], ['{"seed": 2, "$schema": "x", "preset": "koch_snowflake"}', ['--server', server.url]]]) {
    fs.writeFileSync(each.file('a.seedmesh'), text);
    assert.deepEqual(await sync(each, ...flags), { status: 0, out: '0 made, 1 same, 0 refused\n', err: '' });
    assert.equal((await sync(each, '--check')).status, 0);
  }
});

test('an unchanged directory asks the server for its engine alone', async () => {
  const own = await serve(program);
  const each = directory('engine', { 'a.seedmesh': koch });
  assert.equal((await sync(each, '--server', `${own.url}/`)).status, 0);
  assert.equal((await sync(each, '--server', own.url)).status, 0);
  const routes = (await own.get('/metrics')).text.matchAll(/^seedmesh_requests_total\{[^}]*route="([^"]*)"[^}]*\} (\d+)/gm);
  const counts = Object.fromEntries([...routes].filter(([, , count]) => count !== '0').map(([, route, count]) => [route, Number(count)]));
  assert.equal(counts['/version'], 2, JSON.stringify(counts));
  assert.equal(Object.entries(counts).filter(([route]) => /generate|models/.test(route)).reduce((sum, [, count]) => sum + count, 0), 1, JSON.stringify(counts));
  await own.stop();
  assert.match((await sync(each, '--server', own.url)).out, /^note: the engine is not compared: no response from .*\n0 made, 1 same/);
  fs.rmSync(each.file('a.glb'));
  const gone = await sync(each, '--server', own.url);
  assert.deepEqual([gone.status, /no response from/.test(gone.err)], [2, true]);
  assert.equal((await sync(each, '--server', 'localhost')).status, 2);
  assert.equal((await sync({ path: each.file('none') })).status, 2);
});

test('a server with keys gets the key, and a busy one is asked again after Retry-After', async () => {
  const busy = await serve(rehearsal, ['--threads', '1', '--queue', '1', '--api-keys', `me:${createHash('sha256').update('secret').digest('hex')}`]);
  const each = directory('busy', Object.fromEntries([1, 2, 3, 4, 5, 6].map((seed) => [`${seed}.seedmesh`, rehearse(seed, { milliseconds: 200 })])));
  const refused = await sync(each, '--server', busy.url);
  assert.deepEqual([refused.status, refused.out.match(/refused/g).length], [1, 7], refused.out);
  const { status, out } = await sync(each, '--server', busy.url, '--key', 'secret');
  assert.deepEqual([status, /6 made, 0 same, 0 refused/.test(out)], [0, true], out);
  assert.ok(busy.log_lines().some((line) => line.status === 429), 'the queue was never full');
  await busy.stop();
});

test('a killed run leaves no half file, and its models are not made again', async () => {
  const each = directory('killed', Object.fromEntries(Array.from({ length: 60 }, (_, seed) => [`${seed}.seedmesh`, rehearse(seed, { milliseconds: 60, bytes: 300_000 })])));
  const child = spawn(rehearsal, ['sync', each.path, '--threads', '2'], { stdio: 'ignore' });
  await until(() => fs.existsSync(each.file('seedmesh.lock')));
  child.kill('SIGKILL');
  await new Promise((resolve) => child.on('close', resolve));
  const models = each.names().filter((name) => name.endsWith('.glb')), locked = Object.keys(each.lock()).length;
  assert.ok(models.length < 60 && locked > 5, `${models.length} of 60, ${locked} locked`);
  for (const name of models) assert.equal(fs.statSync(each.file(name)).size, 300_000);
  fs.writeFileSync(each.file('7.glb.1.seedmesh-part'), 'half');
  const second = spawn(rehearsal, ['sync', each.path, '--threads', '2'], { stdio: ['ignore', 'pipe', 'inherit'] });
  let out = '';
  second.stdout.on('data', (bytes) => { out += bytes; if (/made/.test(out)) second.kill('SIGINT'); });
  const status = await new Promise((resolve) => second.on('close', resolve));
  const [, made, same] = /(\d+) made, (\d+) same, 0 refused, interrupted\n$/.exec(out);
  assert.deepEqual([status, Number(same)], [1, locked]);
  assert.ok(Number(made) > 0 && Number(made) + locked < 60);
  const last = await run(rehearsal, ['sync', each.path]);
  assert.deepEqual([last.status, each.names().filter((name) => name.includes('part'))], [0, []]);
  assert.equal(Object.keys(each.lock()).length, 60);
});

test('models that were changed by hand stay, and a broken lock file is named', async () => {
  const each = directory('mine', { 'a.seedmesh': koch, 'b.seedmesh': { ...koch, outputs: { 'b.glb': {}, 'c.glb': { profile: 'web' } } } });
  assert.equal((await sync(each)).status, 0);
  fs.rmSync(each.file('a.seedmesh'));
  fs.writeFileSync(each.file('a.glb'), 'mine');
  fs.writeFileSync(each.file('b.seedmesh'), JSON.stringify({ ...koch, outputs: { 'b.glb': {} } }));
  assert.equal((await sync(each)).out, 'removed c.glb\n0 made, 1 same, 0 refused\n');
  assert.deepEqual([each.read('a.glb').toString(), Object.keys(each.lock())], ['mine', ['b.seedmesh']]);
  fs.writeFileSync(each.file('seedmesh.lock'), '{"files": {"a": 1}}');
  const broken = await sync(each);
  assert.deepEqual([broken.status, /seedmesh\.lock: is no lock file/.test(broken.err)], [2, true]);
});

const is_instrumented = /asan|tsan/.test(rehearsal);

test('10,000 unchanged files take less than a second of one processor', { skip: is_instrumented && 'a sanitizer takes several times as long' }, async () => {
  const each = directory('many', Object.fromEntries(Array.from({ length: 10_000 }, (_, seed) => [`${seed % 100}/${seed}.seedmesh`, rehearse(seed)])));
  assert.equal((await run(rehearsal, ['sync', each.path])).status, 0);
  const times = [];
  for (let i = 0; i < 3; ++i) {
    const { out, err } = await run('bash', ['-c', 'TIMEFORMAT="%U %S"; time "$0" sync "$1"', rehearsal, each.path]);
    assert.match(out.toString(), /^0 made, 10000 same, 0 refused\n$/);
    times.push(err.trim().split(' ').reduce((sum, seconds) => sum + Number(seconds), 0));
  }
  assert.ok(Math.min(...times) < 1, `${times} s`);
});
