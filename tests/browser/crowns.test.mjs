// Crowns in the light of a high sun, as a reader of glTF without extensions draws them: their tops are not dark, although
// they are seen from below. With leaves in a double-sided material, 43 and 65 % of the upper thirds were nearly black. Such
// a reader lets no light through leaves, so the shaded parts of a crown with real leaf area stay dark.
import assert from 'node:assert/strict';
import test from 'node:test';
import { draw_views } from '../pictures/judge.mjs';

test('the top third of a crown is brighter than the middle third, and most of it is not black', async () => {
  const measures = await draw_views(process.env.SEEDMESH_PROGRAM, ['aspen_far', 'oak_far']);
  for (const [name, most_black] of [['aspen_far', 0.2], ['oak_far', 0.26]]) {
    const [top, middle] = measures[name].thirds;
    assert.ok(top.luminance >= middle.luminance, `${name}: ${top.luminance} and ${middle.luminance}`);
    assert.ok(top.near_black <= most_black, `${name}: ${top.near_black}`);
  }
});
