// The Godot add-on in a real editor without a window, where one is installed or SEEDMESH_GODOT names it (.ci/unstable_root.sh). Imports
// end with status 0 even after errors, so the log is read.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, run, serve } from '../http/support.mjs';

const source = path.resolve(import.meta.dirname, '../../clients/godot');
const godot = process.env.SEEDMESH_GODOT ?? '/usr/bin/godot';
const skip = fs.existsSync(godot) ? false : 'Godot 4 is not installed: .ci/unstable_root.sh';
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-godot-'));
let server;
before(async () => { server = await serve(program); });
after(async () => {
  await server.stop();
  fs.rmSync(folder, { recursive: true });
});

/** A project with the add-on and some request files. */
function project(name, url, files, settings = '') {
  const place = path.join(folder, name);
  fs.cpSync(path.join(source, 'addons'), path.join(place, 'addons'), { recursive: true });
  fs.copyFileSync(path.join(source, 'tests/check.gd'), path.join(place, 'check.gd'));
  fs.writeFileSync(path.join(place, 'project.godot'), `config_version=5\n[application]\nconfig/name="${name}"\n[editor_plugins]\nenabled=PackedStringArray("res://addons/seedmesh/plugin.cfg")\n[seedmesh]\nserver="${url}"\n${settings}`);
  for (const [file, text] of Object.entries(files)) fs.writeFileSync(path.join(place, file), typeof text === 'string' ? text : JSON.stringify(text));
  return place;
}

async function call(place, ...args) {
  const env = { HOME: folder, XDG_DATA_HOME: folder, XDG_CONFIG_HOME: folder, XDG_CACHE_HOME: folder };
  const { status, out, err } = await run(godot, ['--headless', '--path', place, ...args], { env });
  assert.equal(status, 0, out + err);
  return out.toString() + err;
}

/** The longest side of the box around all meshes of a model whose nodes are not moved. */
function longest_side(glb) {
  const document = JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString());
  const boxes = document.meshes.flatMap(({ primitives }) => primitives.map((each) => document.accessors[each.attributes.POSITION]));
  return Math.max(...[0, 1, 2].map((axis) => Math.max(...boxes.map(({ max }) => max[axis])) - Math.min(...boxes.map(({ min }) => min[axis]))));
}

/** The errors of a log that are about a request file or a script. */
const errors_of = (log) => [...log.matchAll(/^(?:\x1b\[[\d;]*m)*(?:SCRIPT )?ERROR:?(?:\x1b\[[\d;]*m)* (.*)$/gm)].map((match) => match[1]);
const oak = { $schema: 'request.json', preset: 'oak', seed: 3, output: { collision: 'godot', lods: 3 } };

test('request files become scenes with levels, bodies and textures, and the run-time helper grows models', { skip }, async () => {
  const place = project('good', server.url, { 'oak.seedmesh': oak, 'house.seedmesh': { preset: 'house' } });
  const log = await call(place, '--import');
  assert.deepEqual(errors_of(log), [], log);
  assert.doesNotMatch(log, /WARNING/);
  const printed = await call(place, '--script', 'res://check.gd');
  const result = JSON.parse(/^RESULT (.*)$/m.exec(printed)?.[1] ?? assert.fail(printed));

  const levels = [0, 1, 2].map((level) => result.oak.meshes.filter((each) => (/level_(\d)/.exec(each.path)?.[1] ?? '0') === String(level)));
  const sums = levels.map((meshes) => meshes.reduce((sum, each) => sum + each.triangles, 0));
  const whole = await server.generate({ preset: 'oak', seed: 3, output: { profile: 'godot', format: 'glb' } });
  assert.equal(sums[0], Number(whole.headers['seedmesh-triangles']));
  for (const [level, share] of [[1, 0.4], [2, 0.15]]) assert.ok(sums[level] <= 1.02 * share * sums[0] /* the service counts collision bodies, too */ && sums[level] > 0.7 * share * sums[0], sums);
  for (const meshes of levels) assert.equal(meshes.length, 2, 'bark and leaves');
  for (const each of result.oak.meshes) assert.equal(each.texture, 'CompressedTexture2D', 'pictures are textures of the project');
  assert.equal(levels[0][0].begin, 0);
  assert.ok(levels[0][0].end > 5 && levels[0][0].end === levels[1][1].begin && levels[1][0].end === levels[2][1].begin && levels[2][0].end === 0);
  // A coarser level begins where the model is half (a quarter) as high as the picture of a camera of 75 degrees, and is left where it has
  // grown by a tenth: docs/output.md. Godot adds the margin to the range, or takes it off, by what is visible.
  const size = longest_side(whole.bytes);
  for (const [level, share] of [[0, 0.5], [1, 0.25]]) {
    const { end, margin } = levels[level][0], begins = size / (2 * share * Math.tan((37.5 * Math.PI) / 180));
    assert.ok(Math.abs(end + margin - begins) < 0.02 * begins && Math.abs((end + margin) / (end - margin) - 1.1) < 1e-3, `${end} ${margin} ${begins}`);
  }
  assert.ok(result.oak.shapes > 1 && result.oak.bodies === 1, JSON.stringify(result.oak));
  assert.ok(result.house.meshes.length > 0 && result.house.meshes.every((each) => each.end === 0));

  const birch = await server.generate({ preset: 'birch', seed: 7, output: { profile: 'godot', format: 'glb' } });
  assert.equal(result.grown.meshes.reduce((sum, each) => sum + each.triangles, 0), Number(birch.headers['seedmesh-triangles']), 'no hull is drawn');
  assert.ok(result.grown.shapes > 0);
  assert.equal(result.refused, true);
  const derived = (await server.post('/v1/derive', { preset: 'orchard' })).json;
  const expected = new Set(Object.keys(derived.models).map((model) => derived.placements.filter((each) => each.model === model).length));
  assert.deepEqual(new Set(result.planted.counts), expected);
  for (const [axis, value] of [1, 2, 1].entries()) assert.ok(Math.abs(result.moved[axis] - value) < 1e-5, result.moved);
  assert.equal(result.gallery, (await server.get('/v1/presets')).json.presets.length);
  assert.ok(result.filtered >= 1 && result.filtered < 5);
  assert.equal(result.picture, 320);
});

test('errors name request file and pointer, and other files are imported', { skip }, async () => {
  const place = project('bad', server.url, { 'bad.seedmesh': { preset: 'oakk' }, 'text.seedmesh': '{"preset": }', 'far.seedmesh': '{"preset": "oak", "seed": 18446744073709551615}', 'house.seedmesh': { preset: 'house' } });
  const errors = errors_of(await call(place, '--import'));
  for (const pattern of [/^res:\/\/bad\.seedmesh\/preset: there is no preset "oakk"; did you mean "oak"\?$/, /^res:\/\/text\.seedmesh:1: /, /^res:\/\/far\.seedmesh\/seed: /]) assert.ok(errors.some((each) => pattern.test(each)), errors.join('\n'));
  assert.ok(fs.readdirSync(path.join(place, '.godot/imported')).some((name) => /^house\.seedmesh-.*\.scn$/.test(name)));
});

test('a server that is gone or wants a key is an error, and the key is sent', { skip }, async () => {
  assert.match((await call(project('gone', 'http://127.0.0.1:9', { 'house.seedmesh': { preset: 'house' } }), '--import')), /no server at http:\/\/127\.0\.0\.1:9/);
  const closed = await serve(program, ['--api-keys', 'me:2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b']);  // SHA-256 of "secret"
  try {
    const without = errors_of(await call(project('without', closed.url, { 'house.seedmesh': { preset: 'house' } }), '--import'));
    assert.ok(without.some((each) => /^res:\/\/house\.seedmesh: .*key/i.test(each)), without.join('\n'));
    assert.deepEqual(errors_of(await call(project('with', closed.url, { 'house.seedmesh': { preset: 'house' } }, 'key="secret"\n'), '--import')), []);
  } finally {
    await closed.stop();
  }
});
