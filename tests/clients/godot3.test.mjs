// The importer of Godot 3.2, which Debian 12 has, keeps materials as files of the project, by their names. So models in one project must
// not have equal names for different materials. The add-on needs Godot 4 (godot.test.mjs).
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, run, serve, sleep } from '../http/support.mjs';

const godot = '/usr/bin/godot3-server';
const skip = fs.existsSync(godot) ? false : 'Godot 3 is not installed: ./dev setup clients (Debian 12)';
const place = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-godot3-'));
const env = { HOME: place, XDG_DATA_HOME: place, XDG_CONFIG_HOME: place, XDG_CACHE_HOME: place };
const presets = ['abop_2_6b', 'oak', 'birch', 'weeping_willow', 'house', 'menger_sponge'];
let server;
before(async () => { server = await serve(program); });
after(async () => {
  await server.stop();
  fs.rmSync(place, { recursive: true });
});

const document_of = (glb) => JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString());

/** Imports all files of the project. The editor of 3.2 does not end by itself. */
async function import_all(count) {
  const editor = spawn(godot, ['-e', '--path', place], { env: { ...process.env, ...env } });
  let log = '';
  for (const stream of [editor.stdout, editor.stderr]) stream.on('data', (bytes) => { log += bytes; });
  const ended = new Promise((resolve) => { editor.on('close', resolve); });
  const imported = () => (fs.existsSync(path.join(place, '.import')) ? fs.readdirSync(path.join(place, '.import')).filter((name) => /\.glb-.*\.md5$/.test(name)) : []);
  for (let tries = 0; tries < 1200 && imported().length < count && editor.exitCode === null; ++tries) await sleep(100);
  await sleep(500);
  editor.kill('SIGKILL');
  await ended;
  assert.equal(imported().length, count, log);
  return log;
}

// Prints the materials of each scene: file, colour, and the texture as the hash of its texels.
const script = `extends SceneTree
func _init():
	var result = {}
	for name in ${JSON.stringify(presets)}:
		var scene = load("res://" + name + ".glb").instance()
		var found = {}
		_add(scene, found)
		result[name] = found
		scene.free()
	print("RESULT " + to_json(result))
	quit()

func _add(node, found):
	if node is MeshInstance:
		for surface in node.mesh.get_surface_count():
			var material = node.mesh.surface_get_material(surface)
			if material:
				found[material.resource_path.get_file()] = [material.albedo_color.to_html(), material.albedo_texture.get_data().get_data().get_string_from_ascii().md5_text() if material.albedo_texture else ""]
	for child in node.get_children():
		_add(child, found)
`;

test('models of one project keep their materials, and nothing is reported', { skip }, async () => {
  fs.writeFileSync(path.join(place, 'project.godot'), 'config_version=4\n[application]\nconfig/name="models"\n');
  fs.writeFileSync(path.join(place, 'check.gd'), script);
  const names = new Set(), wanted = {};
  for (const preset of presets) {
    const { bytes } = await server.get(`/v1/presets/${preset}.glb?seed=3`);
    fs.writeFileSync(path.join(place, `${preset}.glb`), bytes);
    const { materials, meshes } = document_of(bytes);  // those of seasons that the scene does not show have no file
    const used = new Set(meshes.flatMap(({ primitives }) => primitives.map(({ material }) => materials[material].name)));
    wanted[preset] = [...used].map((name) => `${name}.material`).sort();
    for (const name of wanted[preset]) names.add(name);
  }
  const log = await import_all(presets.length);
  // Of its own, it reports the locale C and its memory.
  const reports = [...log.matchAll(/(?:ERROR|WARNING): (.*)\n +At: (\S+)/g)].filter(([, , place]) => !/^core\/(translation|os\/memory)\.cpp/.test(place));
  assert.deepEqual(reports.map(([report]) => report), []);
  assert.deepEqual(fs.readdirSync(place).filter((name) => name.endsWith('.material')).sort(), [...names].sort());
  const { out, err } = await run(godot, ['--path', place, '--script', 'res://check.gd'], { env });
  const result = JSON.parse(/^RESULT (.*)$/m.exec(out.toString())?.[1] ?? assert.fail(`${out}${err}`));
  for (const preset of presets) assert.deepEqual(Object.keys(result[preset]).sort(), wanted[preset], preset);
  // The reproduction of the fault: three trees with the flat bark of the first model.
  const bark = (preset) => JSON.stringify(Object.entries(result[preset]).find(([name]) => /bark|twig|branch|trunk|stem/.test(name)) ?? assert.fail(`${preset}: ${Object.keys(result[preset])}`));
  assert.equal(new Set(['abop_2_6b', 'oak', 'birch', 'weeping_willow'].map(bark)).size, 4);
});
