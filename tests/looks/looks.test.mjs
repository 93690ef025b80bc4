// What an artist measures in the files: sizes and areas of leaves, hues, coverage of mip levels, the grounds of land. The
// bounds come from field guides (lengths of blades), from the literature on leaf area (broadleaf trees 3 to 7, birch and
// aspen 2 to 5) and from what engines ask of textures.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { program, serve } from '../http/support.mjs';
import { area_of, box_of, coverage_by_level, each_triangle, filtered_coverage, hue_deviation, primitives_of, slopes_of, texel_densities } from './measure.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

const made = new Map();
/** The primitives of a preset. */
async function preset(name) {
  if (!made.has(name)) {
    const answer = await server.get(`/v1/presets/${name}.glb`);
    assert.equal(answer.status, 200, name);
    made.set(name, await primitives_of(answer.bytes));
  }
  return made.get(name);
}
const leaves_of = async (name) => (await preset(name)).filter((each) => each.is_cut);

/**
 * Length of blades in cm without petioles; leaf area by the projection of the crown. `share` is the length of a blade by that
 * of its twig, as the drawings of twigs have it (31 leaves, 91 of willows).
 */
const trees = {
  oak: { blade: [7, 14], share: 0.22, area: [3, 7] },
  birch: { blade: [4, 7], share: 0.2, area: [2, 5] },
  maple: { blade: [7, 12], share: 0.175, area: [3, 7] },
  quaking_aspen: { blade: [3, 8], share: 0.19, area: [2, 5] },
  poplar: { blade: [5, 8], share: 0.19, area: [3, 7.5] },
  weeping_willow: { blade: [8, 16], share: 0.17, area: [3, 7] },
};

/** Lengths of twigs: the extent of each along v, which the first `corners` vertices of each have. */
function twig_lengths(primitive, corners = 6) {
  const lengths = [];
  for (let first = 0; first < primitive.vertices; first += corners) {
    const points = Array.from({ length: corners }, (_, i) => ({ at: primitive.at('POSITION', first + i), v: primitive.at('TEXCOORD_0', first + i)[1] }));
    const rows = [...new Set(points.map(({ v }) => v))].sort((a, b) => a - b);
    const middle = (v) => points.filter((each) => each.v === v).map(({ at }) => at).reduce((sum, p, _, all) => sum.map((each, k) => each + p[k] / all.length), [0, 0, 0]);
    let length = 0;
    for (let row = 1; row < rows.length; ++row) length += Math.hypot(...middle(rows[row]).map((each, k) => each - middle(rows[row - 1])[k]));
    lengths.push(length);
  }
  return lengths;
}

for (const [name, { blade, share, area }] of Object.entries(trees)) {
  test(`${name}: its leaves have the size and the area of the species`, async () => {
    const [leaves] = await leaves_of(name);
    const lengths = twig_lengths(leaves).sort((a, b) => a - b), median = lengths[Math.floor(lengths.length / 2)];
    const cm = 100 * median * share;
    assert.ok(cm >= 0.75 * blade[0] && cm <= 1.25 * blade[1], `blades of ${cm.toFixed(1)} cm`);
    const { low, high } = box_of([leaves]), across = (high[0] - low[0] + high[2] - low[2]) / 2;
    const [covered] = coverage_by_level(leaves.color, leaves.cutoff, 1);
    const index = (0.5 * area_of(leaves) * covered) / ((Math.PI / 4) * across ** 2);
    assert.ok(index >= area[0] && index <= area[1], `leaf area index ${index.toFixed(2)}`);
    assert.ok(low[1] >= 0.1, `the lowest leaf is at ${low[1].toFixed(2)} m`);
  });

  test(`${name}: its leaves keep their coverage over the mip levels, and differ in hue`, async () => {
    const [leaves] = await leaves_of(name);
    const [first, ...others] = coverage_by_level(leaves.color, leaves.cutoff, 6);
    for (const [i, each] of others.entries()) assert.ok(Math.abs(each / first - 1) <= 0.12, `mip ${i + 1}: ${each.toFixed(3)}, mip 0: ${first.toFixed(3)}`);
    assert.ok(hue_deviation(leaves, [0.1, 0.2, 0.05]) >= 3);
  });
}

test('mountain_forest: its birches have blades of 3 to 7 cm', async () => {
  const answer = await server.get('/v1/presets/mountain_forest');
  assert.equal(answer.status, 200);
  const layer = answer.json.parameters.layers.find((each) => each.name === 'birch');
  const model = await server.generate({ ...layer.model, seed: 1 });
  assert.equal(model.status, 200, model.text);
  const [leaves] = (await primitives_of(model.bytes)).filter((each) => each.is_cut);
  const lengths = twig_lengths(leaves, 4).sort((a, b) => a - b), cm = 100 * trees.birch.share * lengths[Math.floor(lengths.length / 2)];
  const smallest = cm * layer.scale[0], largest = cm * layer.scale[1];
  assert.ok(smallest >= 3 && largest <= 1.25 * 7, `blades of ${smallest.toFixed(1)} to ${largest.toFixed(1)} cm`);
});

for (const name of ['spruce', 'pine']) {
  test(`${name}: needles keep their coverage over the mip levels`, async () => {
    const [needles] = await leaves_of(name);
    const [first, ...others] = coverage_by_level(needles.color, needles.cutoff, 6);
    for (const [i, each] of others.entries()) assert.ok(Math.abs(each / first - 1) <= 0.12, `mip ${i + 1}: ${each.toFixed(3)}, mip 0: ${first.toFixed(3)}`);
  });

  test(`${name}: needles do not vanish where plain mip levels are a few texels wide`, async () => {
    const [needles] = await leaves_of(name), first = filtered_coverage(needles.color, needles.cutoff, 0);
    for (const [level, least, most] of [[4, 0.85, 1.15], [5, 0.85, 1.15], [6, 0.85, 1.15], [7, 0.55, 1.15]]) {
      const share = filtered_coverage(needles.color, needles.cutoff, level) / first;
      assert.ok(share >= least && share <= most, `mip ${level}: ${share.toFixed(2)} of the coverage of mip 0`);
    }
  });
}

test('leaves are thin: both sides have faces of their own, and no normal is behind its face', async () => {
  for (const name of ['oak', 'quaking_aspen', 'weeping_willow']) {
    const [leaves] = await leaves_of(name);
    let behind = 0;
    each_triangle(leaves, (corners) => {
      const [a, b, c] = corners.map((corner) => leaves.at('POSITION', corner));
      const u = b.map((each, k) => each - a[k]), v = c.map((each, k) => each - a[k]);
      const face = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      for (const corner of corners) if (leaves.at('NORMAL', corner).reduce((sum, each, k) => sum + each * face[k], 0) < 0) ++behind;
    });
    assert.ok(behind <= 0.001 * leaves.index.length, `${name}: ${behind} of ${leaves.index.length}`);
  }
});

const lands = ['alps', 'ridges', 'island', 'mesas', 'dunes', 'snowfield', 'river_valleys', 'lava_plain'];
for (const name of lands) {
  test(`${name}: its ground has textures of 256 texels a metre that are hardly stretched, and normals that are rough`, async () => {
    const grounds = (await preset(name)).filter((each) => /ground/.test(each.material));
    let area = 0, bare = 0;
    const densities = [];
    for (const ground of grounds) {
      const own = area_of(ground);
      area += own;
      if (!ground.color) { bare += own; continue; }
      const { mean, p95 } = slopes_of(ground.normal);
      assert.ok(mean >= 6 && p95 <= 66, `${ground.material}: slopes of ${mean.toFixed(1)} and ${p95.toFixed(1)} degrees`);
      densities.push(...texel_densities(ground));
    }
    assert.ok(bare <= 0.05 * area);
    densities.sort((a, b) => a.density - b.density);
    const at = (share) => densities[Math.floor(share * (densities.length - 1))].density;
    assert.ok(at(1) >= 255.9, `${at(1).toFixed(0)} texels a metre on level ground`);
    assert.ok(at(0.5) >= 200 && at(0.95) / at(0.05) <= 1.5, `${at(0.05).toFixed(0)} to ${at(0.95).toFixed(0)} texels a metre`);
  });
}

