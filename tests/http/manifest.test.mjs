// `seedmesh manifest`: thousands of requests from one file, with resume and parts.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, test } from 'node:test';
import { rehearsal, run, serve, sleep } from './support.mjs';

const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-'));
after(() => fs.rmSync(folder, { recursive: true }));

const request = (seed, parameters = {}, output) => ({ generator: 'rehearsal', seed, parameters: { bytes: 500, ...parameters }, ...(output && { output }) });
const lines_of = (...objects) => objects.map((object) => JSON.stringify(object)).join('\n') + '\n';
const results = (name, file = 'results.jsonl') => fs.readFileSync(path.join(folder, name, file), 'utf8').trim().split('\n').map((line) => JSON.parse(line));
const manifest = (name, input, ...flags) => run(rehearsal, ['manifest', '-', '-o', path.join(folder, name), ...flags], { input });

test('every line becomes a file, with the bytes that the server answers', async () => {
  const input = lines_of(request(1), { name: 'oaks/two', request: request(2) }, { name: 'third', request: request(3, {}, { format: 'zip' }) });
  const { status, err } = await manifest('all', input);
  assert.equal(status, 0, err);
  assert.match(err, /^3 made, 0 unchanged, 0 refused, 0 not done, in /m);
  const server = await serve(rehearsal);
  const expected = await server.generate(request(2));
  await server.stop();
  assert.deepEqual(fs.readFileSync(path.join(folder, 'all/oaks/two.glb')), expected.bytes);
  assert.ok(fs.existsSync(path.join(folder, 'all/000001.glb')) && fs.existsSync(path.join(folder, 'all/third.zip')));
  const result = results('all').find((each) => each.name === 'oaks/two');
  assert.equal(`"${result.tag}"`, expected.headers.etag);
  assert.deepEqual([result.line, result.bytes, result.triangles, result.file], [2, 500, 12, 'oaks/two.glb']);
});

test('a second run makes only missing or changed models', async () => {
  const many = Array.from({ length: 20 }, (_, seed) => request(seed));
  assert.equal((await manifest('again', lines_of(...many))).status, 0);
  fs.rmSync(path.join(folder, 'again/000003.glb'));
  many[6] = request(1000);
  fs.appendFileSync(path.join(folder, 'again/results.jsonl'), '{"file": "0000');  // as a kill leaves it
  const { status, err } = await manifest('again', lines_of(...many));
  assert.equal(status, 0);
  assert.match(err, /^2 made, 18 unchanged, 0 refused/m);
});

test('results are in the order of the input, and equal for equal input on any number of threads', async () => {
  const many = Array.from({ length: 30 }, (_, seed) => (seed === 7 ? { generator: 'oak' } : request(seed, { milliseconds: (seed * 37) % 50 })));
  const text = (name) => fs.readFileSync(path.join(folder, name, 'results.jsonl'), 'utf8');
  assert.equal((await manifest('ordered', lines_of(...many), '--threads', '8')).status, 1);
  assert.deepEqual(results('ordered').map((each) => each.line), many.map((_, index) => index + 1));
  assert.equal((await manifest('once_more', lines_of(...many), '--threads', '1')).status, 1);
  assert.equal(text('once_more'), text('ordered'));
  assert.doesNotMatch(text('ordered'), /milliseconds/);
  const turned = [...many].reverse().slice(0, 10).map((each, index) => ({ name: String(index), request: each }));
  assert.equal((await manifest('ordered', lines_of(...turned), '--threads', '3', '--times')).status, 0);
  const after = results('ordered');
  assert.deepEqual(after.slice(0, 10).map((each) => [each.line, each.name]), turned.map((each, index) => [index + 1, each.name]));
  assert.ok(after.slice(0, 10).every((each) => each.milliseconds > 0));
  assert.equal(after.length, 10 + 29, 'results of models that are not in the input are kept');
});

test('a refused request is a result, and the others are made', async () => {
  const { status, err } = await manifest('refused', lines_of(request(1), { generator: 'oak' }, request(2, { end: 'limit' }), request(3, { end: 'throw' }), request(4)));
  assert.equal(status, 1);
  assert.match(err, /^2 made, 0 unchanged, 3 refused/m);
  const refused = results('refused').filter((each) => each.problem);
  assert.deepEqual(refused.map((each) => [each.line, each.problem.status]).sort(), [[2, 422], [3, 422], [4, 500]]);
  assert.ok(!JSON.stringify(refused).includes('secret'));
});

test('all errors of the file are reported before a model is made', async () => {
  const { status, err } = await manifest('errors', `${lines_of(request(1), { name: '../x', request: request(2) })}nonsense\n`);
  assert.equal(status, 1);
  assert.match(err, /^-:2: \/name: /m);
  assert.match(err, /^-:3: /m);
  assert.ok(!fs.existsSync(path.join(folder, 'errors')));
  assert.equal((await manifest('errors', '', '--part', '8/8')).status, 2);
  assert.equal((await run(rehearsal, ['manifest', path.join(folder, 'none.jsonl'), '-o', folder])).status, 2);
});

test('parts share the lines without a gap or an overlap', async () => {
  const input = lines_of(...Array.from({ length: 11 }, (_, seed) => request(seed)));
  const made = [];
  for (let part = 0; part < 3; ++part) {
    assert.equal((await manifest('parts', input, '--part', `${part}/3`)).status, 0);
    made.push(...results('parts', `results-${part}-of-3.jsonl`).map((each) => each.line));
  }
  assert.deepEqual(made.sort((a, b) => a - b), Array.from({ length: 11 }, (_, i) => i + 1));
  assert.match((await manifest('parts', input)).err, /^0 made, 11 unchanged/m);
});

for (const signal of ['SIGINT', 'SIGTERM', 'SIGKILL']) {
  test(`after ${signal} no half file is left, and the next run goes on`, async () => {
    const name = `stopped-${signal}`, file = path.join(folder, `${name}.jsonl`);
    fs.writeFileSync(file, lines_of(...Array.from({ length: 30 }, (_, seed) => request(seed, { milliseconds: 40, bytes: 100_000 }))));
    const child = spawn(rehearsal, ['manifest', file, '-o', path.join(folder, name), '--threads', '2'], { stdio: 'ignore' });
    const ended = new Promise((resolve) => { child.on('close', (status, by) => resolve({ status, by })); });
    await sleep(300);
    child.kill(signal);
    const { status, by } = await ended;
    if (signal === 'SIGKILL') assert.equal(by, 'SIGKILL'); else assert.equal(status, 1);
    const files = fs.readdirSync(path.join(folder, name)).filter((each) => each.endsWith('.glb'));
    assert.ok(files.length > 2 && files.length < 30, `${files.length} files`);
    for (const each of files) assert.equal(fs.statSync(path.join(folder, name, each)).size, 100_000);
    const next = await run(rehearsal, ['manifest', file, '-o', path.join(folder, name)]);
    assert.equal(next.status, 0);
    const [, made, there] = /^(\d+) made, (\d+) unchanged, 0 refused, 0 not done/m.exec(next.err);
    assert.equal(Number(made) + Number(there), 30);
    assert.ok(Number(there) >= files.length - 2, 'except those that were written but not yet reported');
  });
}
