// 3d-tiles-tools reads parts of a world from files, in the explicit and in the implicit form, and the Khronos validator finds no error in the tiles.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { ResourceResolvers, TilesetTraverser } from '3d-tiles-tools';
import validator from 'gltf-validator';
import { program, run, serve } from '../http/support.mjs';

const name = 'temperate_land.7';
let service;
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-slices-'));
before(async () => { service = await serve(program, ['--threads', '2', '--log-level', 'error']); });
after(async () => { await service?.stop(); fs.rmSync(folder, { recursive: true }); });

/** The tiles that 3d-tiles-tools finds below the tileset.json of a folder; `descend` says of a tile whether to go on. */
async function read(root, descend = () => true) {
  const tileset = JSON.parse(fs.readFileSync(path.join(root, 'tileset.json'))), tiles = [];
  const traverser = new TilesetTraverser(root, ResourceResolvers.createFileResourceResolver(root), { depthFirst: false, traverseExternalTilesets: true });
  await traverser.traverse(tileset, async (tile) => {
    tiles.push({ ...tile.asFinalTile(), level: tile.level, base: tile.getResourceResolver(), contents: tile.getFinalContents().map(({ uri }) => uri) });
    return descend(tile);
  });
  return tiles;
}

/** All files of a folder that end so. */
const files_of = (root, end) => fs.readdirSync(root, { recursive: true }).filter((each) => each.endsWith(end));

const presets = ['temperate_land', 'alpine', 'archipelago', 'desert_oases', 'boreal_plain', 'alien_plateaus'];
for (const preset of presets)
  test(`an explicit slice of all levels of ${preset} is read whole, and none of its tiles has an error or a warning`, { timeout: 300_000 }, async (t) => {
    const root = path.join(folder, preset);
    const made = await run(program, ['tiles', `${preset}.7`, '--box=-512,-512,512,512', '-o', root, '--quiet']);
    assert.equal(made.status, 0, made.err);
    const tiles = await read(root), linked = new Set(), glbs = files_of(root, '.glb');
    for (const { base, contents } of tiles)
      for (const uri of contents) {
        const bytes = await base.resolveData(uri);
        assert.ok(bytes, uri);
        if (uri.endsWith('.glb')) { assert.equal(bytes.toString('latin1', 0, 4), 'glTF', uri); linked.add(/\d+\/\d+\/\d+\.glb$/.exec(uri)[0]); }
      }
    assert.ok(glbs.length >= 300, `${glbs.length} tiles`);
    assert.equal(linked.size, glbs.length);
    for (const file of glbs) {
      const place = path.join(root, file);
      const { issues } = await validator.validateBytes(new Uint8Array(fs.readFileSync(place)), {
        uri: file, externalResourceFunction: async (uri) => new Uint8Array(fs.readFileSync(path.resolve(path.dirname(place), uri))),
      });
      assert.deepEqual([issues.numErrors, issues.numWarnings], [0, 0], `${file}: ${JSON.stringify(issues.messages.filter(({ severity }) => severity < 2))}`);
    }
    t.diagnostic(`${glbs.length} tiles, no error, no warning`);
    fs.rmSync(root, { recursive: true });
  });

test('an implicit slice of five levels is read, and has the boxes and errors of the explicit form', { timeout: 120_000 }, async () => {
  const home = `/v1/worlds/${name}/`, root = path.join(folder, 'implicit');
  const fetched = async (target, file) => {
    const answer = await service.get(target);
    assert.equal(answer.status, 200, target);
    fs.mkdirSync(path.dirname(path.join(root, file)), { recursive: true });
    fs.writeFileSync(path.join(root, file), answer.bytes);
    return answer.json;
  };
  const json = (await service.get(`${home}implicit.json`)).json, implicit = json.root.implicitTiling;
  const place = (uri) => new URL(uri, `http://x${home}implicit.json`).pathname.replaceAll('%7B', '{').replaceAll('%7D', '}');
  const subtree = place(implicit.subtrees.uri).replace('{level}', 0).replace('{x}', 0).replace('{y}', 0);
  const content = place(json.root.content.uri);
  json.root.content.uri = 'c/{level}/{x}/{y}.glb';
  implicit.subtrees.uri = 's/{level}/{x}/{y}.subtree';
  fs.mkdirSync(root, { recursive: true });
  fs.writeFileSync(path.join(root, 'tileset.json'), JSON.stringify(json));
  await fetched(subtree, 's/0/0/0.subtree');
  const tiles = (await read(root, ({ level }) => level < 5)).filter((tile) => tile.contents.some((uri) => /^c\/[0-4]\//.test(uri)));
  assert.equal(tiles.length, 341);
  const explicit = new Map();
  const visit = (tile) => { explicit.set(/c\/(\d+\/\d+\/\d+\.glb)$/.exec(tile.content.uri)?.[1], tile); for (const child of tile.children ?? []) visit(child); };
  visit((await service.get(`${home}tileset.json`)).json.root);
  let same = 0;
  for (const tile of tiles) {
    const other = explicit.get(tile.contents[0].slice(2));
    if (!other || tile.contents[0].startsWith('c/0/')) continue; // the root of the implicit form covers what most clients derive from it
    assert.deepEqual(tile.boundingVolume.box, other.boundingVolume.box, tile.contents[0]);
    assert.equal(tile.geometricError, other.geometricError, tile.contents[0]);
    ++same;
  }
  assert.equal(same, 84); // levels 1 to 3
  for (const tile of tiles.filter((_, k) => k % 17 === 0)) {
    const [uri] = tile.contents, [level, x, y] = uri.match(/\d+/g);
    await fetched(content.replace('{level}', level).replace('{x}', x).replace('{y}', y), uri);
    assert.equal((await tile.base.resolveData(uri)).toString('latin1', 0, 4), 'glTF', uri);
  }
});
