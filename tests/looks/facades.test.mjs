// Facades from three metres: every surface has a texture of at least 512 texels a metre, and windows and doors are not all
// alike.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { program, serve } from '../http/support.mjs';
import { area_of, each_triangle, primitives_of, texel_densities } from './measure.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

const buildings = ['house', 'l_shaped_house', 'terraced_house', 'villa', 'church', 'factory', 'warehouse', 'temple', 'parisian_block', 'office_tower', 'skyscraper'];

for (const name of buildings) {
  test(`${name}: it has textures of 512 texels a metre nearly everywhere`, async () => {
    const primitives = await primitives_of((await server.get(`/v1/presets/${name}.glb`)).bytes);
    let all = 0, bare = 0;
    const densities = [];
    // Leaves of doors and shutters, and dirt, show a part of a texture each, whatever their size.
    for (const primitive of primitives.filter(({ material }) => !/glass|metal|steel|door|joinery|grime/.test(material))) {
      const area = area_of(primitive);
      all += area;
      if (!primitive.color) bare += area;
      else densities.push(...texel_densities(primitive));
    }
    assert.ok(bare <= 0.05 * all, `${((100 * bare) / all).toFixed(1)} % without a texture`);
    densities.sort((a, b) => a.density - b.density);
    const at = (share) => densities[Math.floor(share * (densities.length - 1))].density;
    assert.ok(at(0.05) >= 505, `${at(0.05).toFixed(0)} texels a metre`);
    assert.ok(at(0.95) / at(0.05) <= 4);
  });
}

test('a block has at least three glasses, frames and doors', async () => {
  const primitives = await primitives_of((await server.get('/v1/presets/parisian_block.glb')).bytes);
  for (const part of ['glass', 'frame', 'door']) {
    const looks = new Set(primitives.map(({ material }) => material).filter((each) => new RegExp(`_${part}(_|$)`).test(each)));
    assert.ok(looks.size >= 3, `${part}: ${[...looks]}`);
  }
});

for (const name of ['house', 'terraced_house', 'villa', 'office_tower']) {
  test(`${name}: rooms show in its windows, not all the same`, async () => {
    const primitives = await primitives_of((await server.get(`/v1/presets/${name}.glb?seed=3`)).bytes);
    const cells = new Set();
    for (const primitive of primitives.filter(({ material }) => /glass/.test(material) && !/#/.test(material))) {
      if (!primitive.color || !primitive.has('TEXCOORD_0')) continue;
      each_triangle(primitive, (corners, area) => {
        const middle = [0, 1].map((k) => corners.reduce((sum, corner) => sum + primitive.at('TEXCOORD_0', corner)[k], 0) / 3);
        if (area > 0.05) cells.add(middle.map((each) => Math.floor(4 * (each - Math.floor(each)))).join());
      });
    }
    assert.ok(cells.size >= 4, `${cells.size} rooms`);
  });
}
