// The Python client: its own tests, its types, and its wheel in an empty environment.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, rehearsal, run, serve, until } from '../http/support.mjs';

const root = path.resolve(import.meta.dirname, '../..');
const package_folder = path.join(root, 'clients/python');
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-python-'));
const file_of = (name) => path.join(folder, name);
/** Debian's own, which has the packages that ./dev setup installs. */
const python3 = fs.existsSync('/usr/bin/python3') ? '/usr/bin/python3' : 'python3';
let server;
before(async () => { server = await serve(program); });
after(async () => {
  await server.stop();
  fs.rmSync(folder, { recursive: true });
});

const environment = () => ({ PYTHONPATH: `${package_folder}/src:${package_folder}/tests`, PYTHONDONTWRITEBYTECODE: '1', SEEDMESH_URL: server.url, SEEDMESH_PROGRAM: program });
const mypy = (...args) => run('mypy', ['--strict', '--cache-dir', file_of('mypy'), ...args], { env: { MYPYPATH: path.join(package_folder, 'src') } });

test('the generated types of both clients are current', async () => {
  const { status, err } = await run(python3, [path.join(root, 'clients/generate_types.py'), '--check']);
  assert.equal(status, 0, err);
});

test('the tests of the package pass against a real server', async () => {
  const { status, err } = await run(python3, ['-W', 'error', '-m', 'unittest', 'discover', '-s', path.join(package_folder, 'tests')], { env: environment() });
  assert.equal(status, 0, err);
  assert.match(err, /Ran (3\d|[4-9]\d) tests/);
});

test('the package is typed without exception', async () => {
  const { status, out } = await mypy('-p', 'seedmesh');
  assert.equal(status, 0, out.toString());
});

const call = (request) => `import seedmesh\nmodel = seedmesh.Client().generate(${request})\nprint(model.triangles + 1)\n`;
for (const [request, pattern] of [
  ['{"generator": "lsystem", "seed": "3", "parameters": {"axiom": "F", "angle": 20}, "output": {"lods": 2}}', null],
  ['{"preset": "oak", "parameters": {"anything": 1}}', null],
  ['{"generator": "tree", "parameters": {"0Branches": 2, "model": "weber_penn"}}', null],
  ['{"generator": "lsystem", "parameters": {"axioms": "F"}}', /matches cleanly/],
  ['{"generator": "tree", "parameters": {"model": "weber"}}', /has incompatible type/],
  ['{"generator": "trees"}', /has incompatible type/],
  ['{"preset": "oak", "output": {"lod": 2}}', /"lod"/],
]) {
  test(`mypy ${pattern ? 'refuses' : 'accepts'} ${request}`, async () => {
    fs.writeFileSync(file_of('typed.py'), call(request));
    const { status, out } = await mypy(file_of('typed.py'));
    assert.equal(status, pattern ? 1 : 0, out.toString());
    if (pattern) assert.match(out.toString(), pattern);
  });
}

test('the built wheel runs in an empty environment', async () => {
  fs.cpSync(package_folder, file_of('source'), { recursive: true });
  const built = await run(python3, ['-m', 'build', '--wheel', '--no-isolation', '--outdir', file_of('wheels'), file_of('source')]);
  assert.equal(built.status, 0, built.err + built.out);
  const wheel = fs.readdirSync(file_of('wheels'));
  assert.equal(wheel.length, 1);
  const made = await run(python3, ['-m', 'venv', file_of('empty')]);
  assert.equal(made.status, 0, made.err + made.out);
  const python = file_of('empty/bin/python');
  const installed = await run(python, ['-m', 'pip', 'install', '--no-index', '--disable-pip-version-check', path.join(folder, 'wheels', wheel[0])]);
  assert.equal(installed.status, 0, installed.err);
  const listed = await run(python, ['-m', 'seedmesh', 'presets'], { env: { SEEDMESH_URL: server.url } });
  assert.match(listed.out.toString(), /^oak\ttree\t/m, listed.err);
  assert.ok(fs.readdirSync(file_of('empty/lib'), { recursive: true }).some((name) => name.endsWith('seedmesh/py.typed')));
  const local = await run(python, ['-m', 'seedmesh', 'presets', '--program', program], { env: { SEEDMESH_URL: '' } });
  assert.equal(local.out.toString(), listed.out.toString(), local.err);
});

test('a full queue delays the client by Retry-After', async () => {
  const busy = await serve(rehearsal, ['--threads', '1', '--queue', '1']);
  const slow = (seed, milliseconds) => ({ generator: 'rehearsal', seed, parameters: { bytes: 500, milliseconds } });
  try {
    const running = busy.generate(slow(1, 3000));
    await until(async () => (await busy.metric('seedmesh_workers_busy')) === 1);
    const waiting = busy.generate(slow(2, 0));
    await until(async () => (await busy.metric('seedmesh_queue_depth')) === 1);
    assert.equal((await busy.generate(slow(4, 0))).status, 429);
    fs.writeFileSync(file_of('late.seedmesh'), JSON.stringify(slow(3, 0)));
    const { status, err } = await run(python3, ['-m', 'seedmesh', 'generate', file_of('late.seedmesh')], { env: { ...environment(), SEEDMESH_URL: busy.url } });
    assert.equal(status, 0, err);
    assert.equal(fs.statSync(file_of('late.glb')).size, 500);
    await Promise.all([running, waiting]);
  } finally {
    await busy.stop();
  }
});
