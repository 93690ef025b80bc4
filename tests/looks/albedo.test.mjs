// The albedo of materials: textures times colour factors times vertex colours, as linear luminance. The ranges are those of
// measured foliage, bark, paint and ground that look right in any light; see docs/looks.md. The albedo of a leaf is the
// light that it reflects and transmits; what it reflects has the range of measured foliage.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { program, serve } from '../http/support.mjs';
import { albedo_range, primitives_of, reflectance_of } from './measure.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

/** Luminance from and to, and the most saturation, by the names of materials; the first match counts. */
const leaves = [/leaf/, 0.06, 0.185, 0.86], needles = [/leaf/, 0.05, 0.155, 0.8], autumn = [/leaf/, 0.05, 0.3, 1];
const bark = [/bark/, 0.05, 0.25, 0.85], white_bark = [/bark/, 0.3, 0.55, 0.4];
const trees = {
  oak: [leaves, bark], black_oak: [leaves, bark], birch: [leaves, white_bark], quaking_aspen: [leaves, white_bark],
  poplar: [leaves, bark], weeping_willow: [leaves, bark], willow: [leaves, bark], bush: [leaves, bark], palm: [leaves, bark],
  black_tupelo: [leaves, bark], maple: [autumn, bark], pine: [needles, bark], spruce: [needles, bark], dead_tree: [bark],
};
const snow = [/snow/, 0.45, 0.9, 0.2], water = [/water/, 0.02, 0.05, 1], basalt = [/ground/, 0.02, 0.06, 0.5], ground = [/ground/, 0.08, 0.4, 0.65];
const lands = {
  alps: [snow, ground], ridges: [snow, ground], snowfield: [snow], river_valleys: [snow, ground], island: [water, ground],
  mesas: [ground], dunes: [ground], lava_plain: [basalt],
};
const glass = [/glass/, 0.02, 0.05, 1], part = [/./, 0.03, 0.75, 0.95];
const buildings = ['house', 'l_shaped_house', 'terraced_house', 'villa', 'church', 'factory', 'warehouse', 'temple', 'parisian_block', 'office_tower', 'skyscraper'];
const presets = { ...trees, ...lands, ...Object.fromEntries(buildings.map((name) => [name, [glass, part]])) };

/** No texel is darker than this, but two in a hundred, unless the whole material is dark. */
const darkest = 0.017, brightest = 0.9;

for (const [name, rules] of Object.entries(presets)) {
  test(`${name}: its materials are neither too dark, too bright nor too colourful`, async () => {
    const answer = await server.get(`/v1/presets/${name}.glb`);
    assert.equal(answer.status, 200);
    for (const primitive of await primitives_of(answer.bytes)) {
      const [, from, to, most_saturated] = rules.find(([pattern]) => pattern.test(primitive.material));
      const { mean, low, high, saturation } = albedo_range(primitive), what = `${primitive.material}: ${mean.toFixed(3)}, ${low.toFixed(3)} to ${high.toFixed(3)}`;
      assert.ok(mean >= from && mean <= to, what);
      assert.ok(low >= darkest || from < 0.03, what);
      assert.ok(high <= brightest, what);
      assert.ok(saturation <= most_saturated, `${primitive.material}: saturation ${saturation.toFixed(2)}`);
    }
  });
}

/** Reflectance of foliage in tables of materials: trees 0.09 to 0.16, conifers 0.08 to 0.12. */
const foliage = { oak: [0.09, 0.16], birch: [0.09, 0.16], quaking_aspen: [0.09, 0.16], pine: [0.08, 0.12], spruce: [0.08, 0.12] };
for (const [name, [from, to]] of Object.entries(foliage)) {
  test(`${name}: its foliage reflects as much light as real foliage`, async () => {
    const answer = await server.get(`/v1/presets/${name}.glb`);
    assert.equal(answer.status, 200);
    const [primitive] = (await primitives_of(answer.bytes)).filter((each) => each.is_cut), reflected = reflectance_of(primitive);
    assert.ok(primitive.transmission > 0, 'leaves transmit light');
    assert.ok(reflected >= from && reflected <= to, `reflectance of ${reflected.toFixed(3)}`);
  });
}
