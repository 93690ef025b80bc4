// The program from the command line: configuration, files, exit status.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, test } from 'node:test';
import { program, rehearsal, run, serve } from './support.mjs';

const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-'));
after(() => fs.rmSync(folder, { recursive: true }));

const plant = { generator: 'lsystem', seed: 3, parameters: { axiom: 'X', productions: ['X -> F[+X]F[-X]+X', 'F -> FF'], iterations: 3, angle: 20 } };
const file = path.join(folder, 'plant.json');
fs.writeFileSync(file, JSON.stringify(plant));

test('--version names program and engine', async () => {
  const { status, out } = await run(program, ['--version']);
  assert.equal(status, 0);
  assert.match(out.toString(), /^seedmesh \d+\.\d+\.\d+\nengine \S+\n$/);
});

test('generate writes the same bytes as the server', async () => {
  const out = path.join(folder, 'plant.glb');
  assert.equal((await run(program, ['generate', file, '-o', out])).status, 0);
  const server = await serve(program);
  const answer = await server.generate(plant);
  await server.stop();
  assert.deepEqual(fs.readFileSync(out), answer.bytes);
});

test('generate reads standard input and writes standard output', async () => {
  const { status, out } = await run(program, ['generate', '-', '-o', '-'], { input: JSON.stringify(plant) });
  assert.deepEqual((await run(program, ['generate'], { input: JSON.stringify(plant) })).out, out);
  assert.equal(status, 0);
  assert.equal(out.subarray(0, 4).toString(), 'glTF');
  assert.equal(out.readUInt32LE(8), out.length);
});

test('the extension of the file selects the format', async () => {
  const gltf = path.join(folder, 'plant.gltf'), zip = path.join(folder, 'plant.zip');
  assert.equal((await run(program, ['generate', file, '-o', gltf])).status, 0);
  assert.equal(JSON.parse(fs.readFileSync(gltf, 'utf8')).asset.version, '2.0');
  assert.equal((await run(program, ['generate', file, '-o', zip])).status, 0);
  assert.equal(fs.readFileSync(zip).subarray(0, 2).toString(), 'PK');
});

test('a file name against the format of the request is an error that names both', async () => {
  const request = (format) => JSON.stringify({ ...plant, output: { format } });
  for (const [format, name] of [['zip', 'x.glb'], ['glb', 'x.zip'], ['gltf', 'x.glb']]) {
    const { status, err } = await run(program, ['generate', '-', '-o', path.join(folder, name)], { input: request(format) });
    assert.equal(status, 2);
    assert.ok(err.includes(name) && err.includes(`"format": "${format}"`), err);
    assert.ok(!fs.existsSync(path.join(folder, name)));
  }
  assert.equal((await run(program, ['generate', '-', '-o', path.join(folder, 'x.zip')], { input: request('zip') })).status, 0);
});

test('threads do not change the bytes', async () => {
  const [one, eight] = await Promise.all(['1', '8'].map((n) => run(program, ['generate', file, '--threads', n])));
  assert.deepEqual(one.out, eight.out);
});

test('a refused request gives the problem as JSON on standard error and status 1', async () => {
  const bad = JSON.stringify({ ...plant, seed: -1, parameters: { ...plant.parameters, productions: ['F F'] } });
  for (const command of ['generate', 'validate', 'derive']) {
    const { status, out, err } = await run(program, [command, '-'], { input: bad });
    assert.equal(status, 1, command);
    assert.equal(out.length, 0);
    const problem = JSON.parse(err);
    assert.equal(problem.status, 422);
    assert.deepEqual(problem.errors.map((each) => each.pointer).sort(), ['/parameters/productions/0', '/seed']);
  }
  assert.equal((await run(program, ['generate', '-'], { input: '{' })).status, 1);
});

test('import prints a request, and its warnings separately', async () => {
  const foreign = path.join(folder, 'koch.l');
  fs.writeFileSync(foreign, 'Koch {\n  Angle 6\n  Axiom F--F--F\n  F=F+F--F+F\n}\n');
  const { status, out, err } = await run(program, ['import', foreign, '--format', 'fractint']);
  assert.equal(status, 0, err);
  assert.match(err, /koch\.l:1:1: warning: /);
  const made = await run(program, ['generate', '-', '-o', '-'], { input: out });
  assert.equal(made.status, 0);
  assert.equal(made.out.subarray(0, 4).toString(), 'glTF');
  assert.equal((await run(program, ['import', foreign, '--format', 'nothing'])).status, 1);
  assert.equal((await run(program, ['import', path.join(folder, 'missing.l'), '--format', 'fractint'])).status, 2);
  const unnamed = await run(program, ['import', foreign]);
  assert.equal(unnamed.status, 0, unnamed.err);
  assert.deepEqual(unnamed.out, out);
});

test('generate prints the warnings of the model separately', async () => {
  const odd = { generator: 'fractal', parameters: { iterations: 1, points: 5 } };
  const { status, out, err } = await run(program, ['generate', '-'], { input: JSON.stringify(odd) });
  assert.equal(status, 0);
  assert.equal(out.subarray(0, 4).toString(), 'glTF');
  assert.match(err, /^-:\/parameters\/points: warning: `points` has no effect unless .*\n$/);
  assert.equal((await run(program, ['generate', file])).err, '');
});

test('a command accepts only the settings that it reads', async () => {
  for (const [command, flag] of [['generate', '--max-triangles'], ['derive', '--time-limit'], ['manifest', '--texture-bytes'], ['sign', '--signing-keys'], ['healthcheck', '--port'], ['serve', '--queue']]) {
    assert.match((await run(program, [command, '--help'])).out.toString(), new RegExp(` ${flag} `), command);
  }
  for (const args of [['generate', file, '--port', '1'], ['validate', file, '--redis-url', 'redis://x'], ['sign', '/x', '--queue', '1'], ['healthcheck', '--max-triangles', '1']]) {
    assert.equal((await run(program, args)).status, 2, args.join(' '));
  }
});

test('validate and derive print JSON', async () => {
  const valid = await run(program, ['validate', file]);
  assert.equal(valid.status, 0);
  assert.equal(JSON.parse(valid.out).valid, true);
  const derived = await run(program, ['derive', file]);
  assert.equal(derived.status, 0);
  assert.equal(JSON.parse(derived.out).iterations, 3);
});

test('a full disk is an error of every command that prints', { skip: !fs.existsSync('/dev/full') }, () => {
  for (const args of [['validate', file], ['derive', file], ['presets'], ['--version'], ['generate', file]]) {
    const full = fs.openSync('/dev/full', 'w');
    const { status, stderr } = spawnSync(program, args, { stdio: ['ignore', full, 'pipe'] });
    fs.closeSync(full);
    assert.equal(status, 2, args.join(' '));
    assert.match(stderr.toString(), /^seedmesh: .*(standard output|-: )/);
  }
});

test('presets lists names, and prints a request that generate accepts', async () => {
  const list = await run(program, ['presets']);
  assert.equal(list.status, 0);
  const name = list.out.toString().split(/\s/)[0];
  const preset = await run(program, ['presets', name]);
  assert.equal(preset.status, 0);
  assert.equal((await run(program, ['generate', '-'], { input: preset.out })).status, 0);
  assert.equal((await run(program, ['presets', 'no-such-preset'])).status, 1);
});

test('wrong usage gives status 2', async () => {
  for (const args of [[], ['grow'], ['sign'], ['serve', '--colour', 'red'], ['serve', '--port'], ['generate', path.join(folder, 'missing.json')],
    ['generate', folder], ['generate', file, '-o', path.join(folder, 'a.foo')], ['generate', file, '-o', path.join(folder, 'missing', 'a.glb')]]) {
    const { status, err } = await run(program, args);
    assert.equal(status, 2, args.join(' '));
    assert.ok(err.length > 0, args.join(' '));
  }
  assert.match((await run(program, ['generat'])).err, /"generat" is not a command; the commands are serve, generate/);
  assert.equal((await run(program, ['--help'])).status, 0);
});

test('all errors of the configuration are reported together', async () => {
  const { status, err } = await run(rehearsal, ['serve', '--port', '99999', '--queue', 'many'], { env: { SEEDMESH_TIME_LIMIT: '-1', SEEDMESH_LOG_LEVEL: 'loud' } });
  assert.equal(status, 2);
  for (const name of ['--port', '--queue', 'SEEDMESH_TIME_LIMIT', 'SEEDMESH_LOG_LEVEL']) assert.match(err, new RegExp(name));
});

test('--print-config shows the effective settings', async () => {
  const { status, out } = await run(rehearsal, ['serve', '--print-config', '--queue', '7'], { env: { SEEDMESH_CACHE_BYTES: '1MiB', SEEDMESH_QUEUE: '9' } });
  assert.equal(status, 0);
  const config = JSON.parse(out);
  assert.equal(config.queue, 7);
  assert.equal(config['cache-bytes'], 1 << 20);
  assert.equal(config['body-limit'], 16 << 20);
  assert.equal(config['time-limit'], 30);
});

test('healthcheck reports whether a service responds', async () => {
  const server = await serve(rehearsal);
  assert.equal((await run(rehearsal, ['healthcheck', '--port', String(server.port)])).status, 0);
  await server.stop();
  assert.equal((await run(rehearsal, ['healthcheck', '--port', String(server.port)])).status, 1);
});

test('a port in use ends the program with status 1 and a reason', async () => {
  const server = await serve(rehearsal);
  const second = await run(rehearsal, ['serve', '--port', String(server.port)]);
  await server.stop();
  assert.equal(second.status, 1);
  assert.match(second.err, /cannot listen/);
});

test('each request is one line of JSON in the log', async () => {
  const server = await serve(rehearsal, ['--log-level', 'debug']);
  await server.get('/v1/presets/small.glb', { 'x-request-id': 'seen' });
  await server.get('/healthz', { 'x-request-id': 'probe' });
  await server.stop();
  const lines = server.log_lines();
  const line = lines.find((each) => each.request_id === 'seen');
  assert.equal(line.status, 200);
  assert.equal(line.route, '/v1/presets/{name}');
  assert.equal(line.cache, 'miss');
  assert.ok(line.duration_ms >= 0 && line.bytes > 2000 && Date.parse(line.time) > 0);
  assert.equal(lines.find((each) => each.request_id === 'probe').level, 'debug');
  assert.ok(lines.some((each) => each.message === 'ended'));
});
