// Bark: about the same scale on trunk and branches, relief and gloss of real bark. An artist sees textures that shrink on
// thin limbs, and smooth ones, from three metres.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { program, serve } from '../http/support.mjs';
import { primitives_of, slopes_of, texel_densities } from './measure.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server.stop(); });

/** Many twigs of these trees are thinner than the narrowest strip of the texture. */
const most = { maple: 4.5, poplar: 4.7, quaking_aspen: 4.8, birch: 5 };
const rough = ['oak', 'pine', 'spruce', 'weeping_willow', 'poplar'], smooth = ['birch', 'quaking_aspen', 'maple', 'cherry'];

for (const name of [...rough, ...smooth, 'palm']) {
  test(`${name}: bark has nearly the same scale on trunk and branches, and the relief of its kind`, { timeout: 60_000 }, async () => {
    const [bark] = (await primitives_of((await server.get(`/v1/presets/${name}.glb?seed=3`)).bytes)).filter(({ material }) => /bark/.test(material));
    const densities = texel_densities(bark), all = densities.reduce((sum, { area }) => sum + area, 0);
    const quantile = (share) => { let sum = 0; return densities.find(({ area }) => (sum += area) >= share * all).density; };
    assert.ok(quantile(0.05) >= 500, `${quantile(0.05).toFixed(0)} texels a metre`);
    assert.ok(quantile(0.95) / quantile(0.05) <= (most[name] ?? 4), `${quantile(0.05).toFixed(0)} to ${quantile(0.95).toFixed(0)} texels a metre`);
    const { mean, p95 } = slopes_of(bark.normal);
    assert.ok(p95 <= 66, `slopes of ${p95.toFixed(1)} degrees`);
    assert.ok(rough.includes(name) ? mean >= 15 && mean <= 35 : mean >= 4, `a mean slope of ${mean.toFixed(1)} degrees`);
  });
}
