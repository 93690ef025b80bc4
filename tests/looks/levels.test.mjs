// Levels of detail of trees: 40, 15 and 5 % of the triangles. An artist sees no change where an engine swaps them: the
// outlines of neighbouring levels have at least nine tenths in common, and their brightness differs by at most 5 %. At level 3,
// leaves have one face, whose normals renderers turn around; its brightness is less exact.
import assert from 'node:assert/strict';
import test from 'node:test';
import { program } from '../http/support.mjs';
import { compare_levels } from '../pictures/levels.mjs';

const shares = [1, 0.4, 0.15, 0.05], brighter = [0, 0.05, 0.05, 0.08];
/** At level 3: needles have one of two crossed cards; light petals cannot become brighter, so fewer of them keep both sides. */
const at_last = { pine: { overlap: 0.9, off: 0.06 }, spruce: { overlap: 0.9, off: 0.06 }, cherry: { overlap: 0.85, off: 0.05 } };

for (const name of ['oak', 'birch', 'quaking_aspen', 'maple', 'pine', 'spruce', 'weeping_willow', 'poplar', 'cherry']) {
  test(`${name}: its levels have 40, 15 and 5 % of the triangles, and hardly differ`, { timeout: 300_000 }, async (t) => {
    const levels = (await compare_levels(program, [name], { impostor: false })).get(name);
    assert.equal(levels.length, shares.length);
    for (const [i, { share, overlap, brightness }] of levels.entries()) {
      if (i === 0) continue;
      t.diagnostic(`${i}: ${(100 * share).toFixed(1)} %, overlap ${overlap.toFixed(3)}, brightness ${brightness.toFixed(3)}`);
      assert.ok(share <= 1.03 * shares[i], `level ${i} has ${(100 * share).toFixed(1)} % of the triangles`);
      const bounds = (i === 3 && at_last[name]) || { overlap: 0.9, off: brighter[i] };
      assert.ok(overlap >= bounds.overlap, `level ${i}: ${overlap.toFixed(3)} of the outline`);
      assert.ok(Math.abs(brightness - 1) <= bounds.off, `level ${i}: ${brightness.toFixed(3)} of the brightness`);
    }
  });
}
