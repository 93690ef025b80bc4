// The checker of worlds finds nothing in a sound world, and finds each of the faults that are made here on purpose.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { program, serve } from './support.mjs';
import { border_faults, box_faults, error_faults, map_faults, parts_of, read_tile, shared_faults, skirt_faults, subtree_faults, tileset_faults } from './world_checker.mjs';

const world = { generator: 'world', seed: 11, parameters: { extent: 32768, relief: { land: 0.9, mountains: 900 }, plants: [{ class: 'oak', moisture: [0, 1], temperature: [-30, 40] }] } };
let server, home, get;
before(async () => {
  server = await serve(program, ['--threads', '1']);
  const posted = await server.post('/v1/generate', world);
  home = posted.headers['content-location'].replace('tileset.json', '');
  const known = new Map();
  get = async (path) => {
    if (!known.has(path)) {
      const answer = await server.get(path.startsWith('v1/') ? `/${path}` : home + path);
      assert.equal(answer.status, 200, `${path}: ${answer.text.slice(0, 200)}`);
      known.set(path, answer.bytes);
    }
    return known.get(path);
  };
});
after(async () => { await server.stop(); });

/** The tiles of a tileset file and of those that it links to, by "level/x/y". */
async function tiles_of(path) {
  const all = new Map();
  const visit = (tile) => {
    const name = /c\/(\d+\/\d+\/\d+)\.glb$/.exec(tile.content.uri)?.[1];
    if (name) all.set(name, tile);
    for (const child of tile.children ?? []) visit(child);
  };
  const json = JSON.parse(await get(path));
  visit(json.root);
  return { json, all };
}

/** The same files with one tile changed: its vertices, or its JSON. */
const with_tile = (level, x, y, change) => async (path) => {
  const bytes = await get(path);
  if (path !== `c/${level}/${x}/${y}.glb`) return bytes;
  const copy = Buffer.from(bytes), { json, bin } = parts_of(copy);
  const accessor = json.accessors[json.meshes[0].primitives[0].attributes.POSITION], view = json.bufferViews[accessor.bufferView];
  change({
    count: accessor.count,
    at: (n, axis) => bin.readInt16LE((view.byteOffset ?? 0) + n * view.byteStride + 2 * axis),
    set: (n, axis, value) => bin.writeInt16LE(value, (view.byteOffset ?? 0) + n * view.byteStride + 2 * axis),
    turn: (n) => bin.writeInt8(-bin.readInt8((view.byteOffset ?? 0) + n * view.byteStride + 9), (view.byteOffset ?? 0) + n * view.byteStride + 9),
  });
  return copy;
};

test('a sound world has no faults', async () => {
  const { json, all } = await tiles_of('tileset.json'), nested = await tiles_of('e/4/5/6.json');
  assert.deepEqual(tileset_faults(json, 9), []);
  assert.deepEqual(tileset_faults(nested.json, 9), []);
  for (const [level, x, y] of [[0, 0, 0], [2, 1, 2], [3, 4, 5], [5, 11, 12], [6, 20, 27], [7, 43, 50]]) {
    const own = level < 4 ? all : nested.all, tile = await read_tile(get, level, x, y);
    assert.deepEqual(box_faults(tile, own.get(`${level}/${x}/${y}`).boundingVolume.box), []);
    const below = await read_tile(get, level + 1, 2 * x, 2 * y);
    assert.deepEqual(shared_faults(tile, below), []);
    assert.deepEqual(error_faults(tile, below, own.get(`${level}/${x}/${y}`).geometricError), []);
    if (level > 0) assert.deepEqual(border_faults(tile, await read_tile(get, level, x + 1, y)), []);
    if (level > 0) assert.deepEqual(skirt_faults(tile, await read_tile(get, level + 1, 2 * x + 2, 2 * y)), []);
  }
  assert.deepEqual(subtree_faults(await get('s/0/0/0.subtree'), 5, false), []);
  assert.deepEqual(subtree_faults(await get('s/5/3/3.subtree'), 5, true), []);
  const map = JSON.parse(await get('world.json?box=-1024,-1024,1024,1024'));
  assert.ok(map.plants[0].places.length > 0 || map.rivers.length > 0);
  assert.deepEqual(map_faults(map), []);
});

test('a border vertex that is one step higher, or a normal that is turned, is found', async () => {
  const east = await read_tile(get, 5, 12, 12);
  // vertices 32, 65, … are those of the east border
  const lifted = await read_tile(with_tile(5, 11, 12, ({ at, set }) => set(65, 1, at(65, 1) + 1)), 5, 11, 12);
  assert.equal(border_faults(lifted, east).length, 1);
  const turned = await read_tile(with_tile(5, 11, 12, ({ turn }) => turn(98)), 5, 11, 12);
  assert.equal(border_faults(turned, east).length, 1);
});

test('a sample that differs between two levels is found', async () => {
  const fine = await read_tile(get, 6, 22, 24);
  const moved = await read_tile(with_tile(5, 11, 12, ({ at, set }) => set(0, 1, at(0, 1) + 3)), 5, 11, 12);
  assert.equal(shared_faults(moved, fine).length, 1);
});

test('a vertex above its box, and a plant outside of it, are found', async () => {
  const { box } = (await tiles_of('e/4/5/6.json')).all.get('5/11/12').boundingVolume;
  const high = await read_tile(with_tile(5, 11, 12, ({ set }) => set(500, 1, 32767)), 5, 11, 12);
  assert.match(box_faults(high, box)[0], /a vertex of terrain/);
  const tile = await read_tile(get, 5, 11, 12);
  tile.layers.set('plants', [[box[0] + box[3] + 1, box[1], box[2]]]);
  assert.match(box_faults(tile, box)[0], /a vertex of plants/);
});

test('an error that is too small is found', async () => {
  const coarse = await read_tile(get, 5, 11, 12), fine = await read_tile(get, 6, 22, 24);
  assert.equal(error_faults(coarse, fine, 0).length, 1);
});

test('a skirt that is cut off is found', async () => {
  // the skirt follows the vertices of the terrain, in turn from the south-west corner
  const along = Array.from({ length: 32 }, (_, k) => k), border = [...along, ...along.map((k) => 33 * k + 32), ...along.map((k) => 33 * 32 + 32 - k), ...along.map((k) => 33 * (32 - k))];
  const cut = ({ set, at }) => border.forEach((top, k) => set(33 * 33 + k, 1, at(top, 1)));
  const fine = await read_tile(get, 8, 96, 96);
  const coarse = await read_tile(with_tile(5, 11, 12, cut), 5, 11, 12);
  const bare = await read_tile(with_tile(8, 96, 96, cut), 8, 96, 96);
  assert.ok(skirt_faults(coarse, bare).length > 0);
  assert.deepEqual(skirt_faults(await read_tile(get, 5, 11, 12), fine), []);
});

test('broken tilesets are found', async () => {
  const { json } = await tiles_of('e/4/5/6.json'), broken = (change) => { const copy = structuredClone(json); change(copy); return tileset_faults(copy, 9).join(); };
  assert.match(broken((t) => { t.asset.version = '1.0'; }), /version/);
  assert.match(broken((t) => { t.root.children[0].boundingVolume.box[11] *= 3; }), /leaves the box above/);
  assert.match(broken((t) => { t.root.children[1].geometricError = t.root.geometricError; }), /does not fall/);
  assert.match(broken((t) => { delete t.root.children[2].content; }), /is no tile/);
  assert.match(broken((t) => { t.root.children[3].content.uri += '?v=1'; }), /is no tile|has a query/);
});

test('broken subtrees are found', async () => {
  const sound = await get('s/5/3/3.subtree'), size = Number(sound.readBigUInt64LE(8));
  const with_json = (change) => {
    const json = JSON.parse(sound.subarray(24, 24 + size));
    change(json);
    const text = Buffer.from(JSON.stringify(json)), padded = Buffer.concat([text, Buffer.alloc((8 - (text.length % 8)) % 8, ' ')]), head = Buffer.from(sound.subarray(0, 24));
    head.writeBigUInt64LE(BigInt(padded.length), 8);
    return Buffer.concat([head, padded, sound.subarray(24 + size)]);
  };
  assert.match(subtree_faults(with_json((j) => { delete j.contentAvailability; }), 5, true).join(), /contentAvailability/);
  assert.match(subtree_faults(with_json((j) => { j.childSubtreeAvailability = { constant: 1 }; }), 5, true).join(), /child subtrees/);
  assert.match(subtree_faults(with_json((j) => { j.tileAvailability = { constant: 0 }; }), 5, true).join(), /not all tiles/);
  assert.match(subtree_faults(sound.subarray(0, sound.length - 4), 5, true).join(), /padded/);
  assert.match(subtree_faults(Buffer.from('{}'.padEnd(32)), 5, true).join(), /no binary subtree/);
});

test('water that climbs, steep roads and crowded plants are found', () => {
  const empty = { sea_level: 0, rivers: [], lakes: [], roads: [], plants: [] };
  const river = { id: 'r', into: 'sea', points: [[0, 0, 5], [10, 0, 6], [20, 0, 0]] };
  assert.deepEqual(map_faults({ ...empty, rivers: [river] }), ['river r climbs']);
  assert.deepEqual(map_faults({ ...empty, rivers: [{ ...river, into: 'nowhere', points: [[0, 0, 5], [9, 0, 0]] }] }), ['river r ends in no water']);
  assert.deepEqual(map_faults({ ...empty, roads: [{ id: 'w', points: [[0, 0, 0], [100, 0, 13]] }] }), ['road w is steep']);
  assert.match(map_faults({ ...empty, plants: [{ class: 'oak', spacing: 5, places: [[4.9, 0, 0], [9.8, 0, 0]] }] })[0], /too near/);
});
