// Crowns in the light of a high sun, as a reader of glTF without extensions draws them: their tops are not dark, although
// they are seen from below. The bounds are those of an artist's review of the models.
import assert from 'node:assert/strict';
import test from 'node:test';
import { draw_views } from '../pictures/judge.mjs';

test('the top third of a crown is at least as bright as the middle third, and hardly any of it is black', async () => {
  const measures = await draw_views(process.env.SEEDMESH_PROGRAM, ['aspen_far', 'oak_far']);
  for (const [name, most_black] of [['aspen_far', 0.05], ['oak_far', 0.2]]) {
    const [top, middle] = measures[name].thirds;
    assert.ok(top.luminance >= middle.luminance, `${name}: ${top.luminance} and ${middle.luminance}`);
    assert.ok(top.near_black <= most_black, `${name}: ${top.near_black}`);
  }
});
