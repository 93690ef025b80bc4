// The Blender add-on: versions agree, and its tests pass inside Blender where that is installed (./dev setup clients).
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { program, run, serve } from '../http/support.mjs';

const source = path.resolve(import.meta.dirname, '../../clients/blender');
const blender = process.env.SEEDMESH_BLENDER ?? '/usr/bin/blender';
const skip = fs.existsSync(blender) ? false : 'Blender is not installed: ./dev setup clients';

test('manifest and bl_info have one version and one name', () => {
  const manifest = fs.readFileSync(path.join(source, 'seedmesh/blender_manifest.toml'), 'utf8');
  const info = fs.readFileSync(path.join(source, 'seedmesh/__init__.py'), 'utf8');
  const [, major, minor, patch] = /"version": \((\d+), (\d+), (\d+)\)/.exec(info);
  assert.match(manifest, new RegExp(`^version = "${major}\\.${minor}\\.${patch}"$`, 'm'));
  assert.match(manifest, /^tagline = ".{1,63}[^."]"$/m);
  assert.equal(/^name = "(.*)"$/m.exec(manifest)[1], /"name": "(.*)"/.exec(info)[1]);
});

test('the add-on works inside Blender', { skip }, async () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-blender-'));
  const server = await serve(program);
  try {
    const archive = path.join(folder, 'seedmesh.zip');
    assert.equal((await run('python3', [path.join(source, 'build.py'), archive])).status, 0);
    const version = /Blender (\d+)\.(\d+)/.exec((await run(blender, ['--version'])).out.toString()).slice(1).map(Number);
    const has_extensions = version[0] > 4 || (version[0] === 4 && version[1] >= 2);
    if (has_extensions) {
      const validated = await run(blender, ['--command', 'extension', 'validate', archive]);
      assert.equal(validated.status, 0, `${validated.out}${validated.err}`);
    }
    const online = has_extensions ? ['--online-mode'] : [];
    const env = { HOME: folder, XDG_CONFIG_HOME: folder, BLENDER_USER_CONFIG: path.join(folder, 'config'), BLENDER_USER_SCRIPTS: path.join(folder, 'scripts') };
    const { status, out, err } = await run(blender, ['--background', '--factory-startup', ...online, '--python-exit-code', '3', '--python', path.join(source, 'tests/run.py'), '--', archive, server.url], { env });
    assert.equal(status, 0, `${out}${err}`);
    assert.match(out.toString(), /^10 tests, status 0$/m);
  } finally {
    await server.stop();
    fs.rmSync(folder, { recursive: true });
  }
});
