// The same tree at every level of detail from the same camera: its outline stays, its triangles fall.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { fragment_of, launch, open, outline, overlap, program, serve } from './support.mjs';

let server, browser;
before(async () => { server = await serve(program); browser = await launch(); });
after(async () => { await browser?.close(); await server?.stop(); });

const choose = (page, value) => page.evaluate((value) => new Promise((resolve) => {
  const select = document.getElementById('detail');
  select.value = value;
  select.dispatchEvent(new Event('change'));
  requestAnimationFrame(() => requestAnimationFrame(resolve));
}), value);

/** What levels 1 to 4 are to reach; twigs a pixel wide are missed or hit by chance. */
const least = { oak: [0.95, 0.92, 0.9, 0.88], poplar: [0.96, 0.94, 0.93, 0.92], dead_tree: [0.9, 0.86, 0.86, 0.84] };

for (const name of Object.keys(least)) {
  test(`${name} keeps its outline from level to level`, { timeout: 300_000 }, async (t) => {
    const request = (await server.get(`/v1/presets/${name}`)).json;
    for (const word of ['title', 'description', 'tags']) delete request[word];
    const page = await open(browser, `${server.url}/?stage&quality=low${fragment_of(request)}`, { viewport: { width: 640, height: 480 } });
    await choose(page, 'ask');
    await page.waitForFunction(() => document.querySelectorAll('#detail option').length === 7);
    const counts = (await page.locator('#detail option').allTextContents()).slice(2).map((text) => Number(/· ([\d,]+) triangles/.exec(text)[1].replaceAll(',', '')));
    const outlines = [];
    for (let level = 0; level < counts.length; level += 1) {
      await choose(page, String(level));
      outlines.push(outline(await page.screenshot({ omitBackground: true })));
    }
    const overlaps = outlines.map((each) => overlap(each, outlines[0]));
    t.diagnostic(`${counts.join(', ')} triangles; overlaps ${overlaps.map((each) => each.toFixed(3)).join(', ')}`);
    assert.ok(outlines[0].reduce((sum, each) => sum + each, 0) > 2000, 'there is a tree');
    counts.slice(1).forEach((count, index) => assert.ok(count <= counts[index] * 0.9, `level ${index + 1} has ${count} triangles, the one before ${counts[index]}`));
    least[name].forEach((share, index) => assert.ok(overlaps[index + 1] >= share, `level ${index + 1}: ${overlaps[index + 1].toFixed(3)}`));
  });
}
