// _NEXT_POSITION in the profiles of engines: where each vertex is on the next level of detail. An engine that moves vertices
// there shows the next level before it swaps the meshes.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { program, serve } from '../http/support.mjs';
import { area_of, each_triangle, primitives_of } from './measure.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

const levels = 4;
async function made(preset, output) {
  const answer = await server.post('/v1/generate', { preset, seed: 3, output: { textures: 64, lods: levels, ...output } });
  assert.equal(answer.status, 200, answer.text?.slice(0, 300));
  return answer.bytes;
}

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** The primitives of a file, with the level that the name of their node says. */
async function leveled(bytes) {
  const file = Buffer.from(bytes), { nodes, meshes } = JSON.parse(file.subarray(20, 20 + file.readUInt32LE(12)));
  const levels_by_mesh = new Map(nodes.filter(({ mesh }) => mesh !== undefined).map(({ name, mesh }) => [meshes[mesh].name, Number(/_LOD(\d)/.exec(name)[1])]));
  return (await primitives_of(bytes)).map((each) => ({ ...each, level: levels_by_mesh.get(each.mesh) }));
}

/** The number of leaves, triangles with common vertices, that have an area. */
function leaves_of(primitive) {
  const parent = Array.from({ length: primitive.vertices }, (_, i) => i);
  const root = (i) => { while (parent[i] !== i) i = parent[i] = parent[parent[i]]; return i; };
  each_triangle(primitive, ([a, b, c]) => { parent[root(b)] = root(a); parent[root(c)] = root(a); });
  const found = new Set();
  each_triangle(primitive, ([a], area) => { if (area > 1e-9) found.add(root(a)); });
  return found.size;
}

for (const preset of ['oak', 'pine', 'house']) {
  test(`${preset}: vertices have a finite position on the next level, and stay on the last one`, { timeout: 120_000 }, async () => {
    const primitives = await leveled(await made(preset, { profile: 'unity' }));
    const last = Math.max(...primitives.map(({ level }) => level));
    let all = 0;
    assert.ok(last >= 2, `${last + 1} levels`);
    for (const each of primitives) {
      assert.ok(each.has('_NEXT_POSITION'), each.mesh);
      const at = each.at('_NEXT_POSITION', each.vertices - 1);
      assert.equal(at.length, 3);
      let moved = 0;
      for (let i = 0; i < each.vertices; ++i) {
        const next = each.at('_NEXT_POSITION', i), here = each.at('POSITION', i);
        assert.ok(next.every(Number.isFinite));
        if (distance(next, here) > 0) ++moved;
      }
      if (each.level === last) assert.equal(moved, 0, `${each.mesh}: ${moved} vertices`);
      all += each.level < last ? moved : 0;
    }
    assert.ok(all > 0);
  });
}

test('bark: the next position is on the surface of the next level, and not farther than its nearest vertex', { timeout: 120_000 }, async () => {
  const primitives = (await leveled(await made('oak', { profile: 'unity' }))).filter((each) => /bark/.test(each.mesh));
  for (let level = 0; level + 1 < levels; ++level) {
    const fine = primitives.find((each) => each.level === level), coarse = primitives.find((each) => each.level === level + 1);
    for (let i = 0; i < fine.vertices; i += Math.ceil(fine.vertices / 300)) {
      const here = fine.at('POSITION', i), next = fine.at('_NEXT_POSITION', i);
      let nearest = Infinity;
      for (let k = 0; k < coarse.vertices; ++k) nearest = Math.min(nearest, distance(here, coarse.at('POSITION', k)));
      assert.ok(distance(here, next) <= nearest + 1e-4, `${distance(here, next)} m, a vertex is ${nearest} m away`);
      let height = Infinity;
      each_triangle(coarse, (corners) => {
        const [a, b, c] = corners.map((corner) => coarse.at('POSITION', corner)), u = b.map((x, n) => x - a[n]), v = c.map((x, n) => x - a[n]), p = next.map((x, n) => x - a[n]);
        const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], size = Math.hypot(...normal);
        const off = Math.abs(p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2]) / size;
        if (off < height && [a, b, c].some((corner) => distance(corner, next) <= Math.max(distance(a, b), distance(b, c), distance(c, a)))) height = off;
      });
      assert.ok(height < 1e-3, `${height} m from the next level`);
    }
  }
});

for (const preset of ['oak', 'spruce']) {
  test(`${preset}: leaves that have moved have the area of those of the next level`, { timeout: 120_000 }, async () => {
    const primitives = (await leveled(await made(preset, { profile: 'unity' }))).filter((each) => each.is_cut);
    for (let level = 0; level + 1 < levels; ++level) {
      const fine = primitives.find((each) => each.level === level), coarse = primitives.find((each) => each.level === level + 1);
      const moved = { ...fine, at: (name, i) => fine.at(name === 'POSITION' ? '_NEXT_POSITION' : name, i) };
      // A triangle around a square continues its texture coordinates, so the squares of the finer level are parts of it.
      const per = (each) => { let covered = 0; each_triangle(each, (corners, area) => { const [a, b, c] = corners.map((k) => each.at('TEXCOORD_0', k)); const uv = Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2; if (area > 1e-9) covered += uv; }); return area_of(each) / covered; };
      assert.ok(Math.abs(leaves_of(moved) / leaves_of(coarse) - 1) <= 0.1, `level ${level}: ${leaves_of(moved)} leaves with an area, wanted ${leaves_of(coarse)}`);
    }
  });
}

test('only the profiles of engines with several levels have it', async () => {
  const has = (bytes) => Buffer.from(bytes).includes('_NEXT_POSITION');
  assert.ok(has(await made('oak', { profile: 'unreal', format: 'zip' })));
  for (const profile of ['core', 'godot', 'blender', 'tiles']) assert.ok(!has(await made('oak', { profile, format: 'zip' })), profile);
  assert.ok(!has(await made('oak', { profile: 'web' })), 'web');
  assert.ok(!has(await made('oak', { profile: 'unity', lods: 1 })), 'one level');
});
