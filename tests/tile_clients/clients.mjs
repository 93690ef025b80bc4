// CesiumJS and 3d-tiles-renderer in Chromium against the real service: twenty views in each without a failed request or a message on the console,
// and the standard view within its bounds.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { program, serve } from '../http/support.mjs';
import { open_browser } from './pages.mjs';

let service, browser;
const ground = new Map();
before(async () => {
  service = await serve(program, ['--threads', '2', '--log-level', 'error']);
  browser = await open_browser(service);
});
after(async () => { await browser?.close(); await service?.stop(); });

const world = (name, file) => `${service.url}/v1/worlds/${name}/${file}`;

/** The height of the ground, or of the sea above it. */
async function ground_at(name, east, north) {
  const key = `${name} ${east} ${north}`;
  if (ground.has(key)) return ground.get(key);
  const [preset, seed] = name.split('.');
  const { json } = await service.post(`/v1/derive?box=${east - 64},${north - 64},${east + 64},${north + 64}`, { preset, seed: Number(seed) });
  const { values, columns, rows } = json.heights;
  const height = Math.max(json.sea_level ?? 0, values[Math.floor(rows / 2) * columns + Math.floor(columns / 2)]);
  ground.set(key, height);
  return height;
}

const presets = ['temperate_land.7', 'alpine.3', 'archipelago.5', 'boreal_plain.2'];
/** Five views of four worlds, from the height of eyes up to 250 km, in all directions. */
const views = presets.flatMap((name, k) => [[2, -4], [40, -10], [400, -25], [6000, -40], [250_000, -80]].map(([above, pitch], n) => (
  { name, above, pitch, heading: (k * 5 + n) * 67 % 360, east: 1792 * k - 2500 * n, north: 3328 * n - 900 * k })));

for (const client of ['three', 'cesium'])
  test(`twenty views of ${client}: nothing fails, and nothing is written to the console`, { timeout: 600_000 }, async (t) => {
    const page = await browser.open(client);
    let shown = '', tiles = 0;
    for (const { name, above, ...view } of views) {
      if (shown !== name) await page.evaluate((options) => window.client.open(options), { url: world(name, 'tileset.json'), lines: 720 });
      shown = name;
      const found = await page.evaluate((pose) => window.client.view(pose), { ...view, up: above + await ground_at(name, view.east, view.north) });
      assert.deepEqual(found.faults, [], `${name} from ${above} m`);
      assert.ok(found.tiles > 0, `${name} from ${above} m shows no tile`);
      tiles += found.tiles;
    }
    t.diagnostic(`${tiles} tiles shown, ${page.files.length} requests`);
    assert.deepEqual(page.faults, []);
    await page.context().close();
  });

test('3d-tiles-renderer finds no vertex of a tile outside the boxes above it', { timeout: 300_000 }, async () => {
  const page = await browser.open('three');
  // Its check overlooks the places of copies, so this world has no plants.
  const preset = (await service.get('/v1/presets/alpine')).json;
  const posted = await service.generate({ generator: 'world', seed: 3, parameters: { ...preset.parameters, plants: [] } });
  assert.equal(posted.status, 200, posted.text);
  await page.evaluate((options) => window.client.open(options), { url: service.url + posted.headers['content-location'], lines: 720, check_boxes: true });
  for (const { name, above, ...view } of views.filter((each) => each.name === 'alpine.3'))
    await page.evaluate((pose) => window.client.view(pose), { ...view, up: above + await ground_at(name, view.east, view.north) });
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

const bounds = { requests: 70, megabytes: 3, triangles: 500_000 };
for (const client of ['three', 'cesium'])
  test(`the standard view of ${client} is within ${bounds.requests} requests, ${bounds.megabytes} MB and ${bounds.triangles} triangles, and loads no file twice`, { timeout: 120_000 }, async (t) => {
    const page = await browser.open(client);
    await page.evaluate((options) => window.client.open(options), { url: world('temperate_land.7', 'tileset.json'), lines: 720 });
    const found = await page.evaluate((pose) => window.client.view(pose), { east: 0, north: 0, up: 1050 + await ground_at('temperate_land.7', 0, 0), heading: 0, pitch: -25 });
    const loaded = page.files.filter(({ from_memory }) => !from_memory), sum = (key) => loaded.reduce((all, each) => all + each[key], 0) / 1e6;
    t.diagnostic(`${loaded.length} requests, ${sum('bytes').toFixed(2)} MB (${sum('sent').toFixed(2)} MB with HTTP coding), ${found.triangles} triangles, ${found.tiles} tiles`);
    assert.deepEqual([page.faults, found.faults], [[], []]);
    assert.equal(new Set(loaded.map(({ url }) => url)).size, loaded.length, 'no file is loaded twice');
    assert.ok(found.tiles > 0 && sum('bytes') <= bounds.megabytes && found.triangles <= bounds.triangles);
    // The view is at the corner of four tiles of each level, so clients load eight or more tiles of each.
    assert.ok(loaded.length <= bounds.requests, `${loaded.length} requests`);
    await page.context().close();
  });

// CesiumJS reads boxes and errors from the metadata of subtrees, so that it shows the same tiles in both forms. 3d-tiles-renderer
// halves the error of the root from level to level, and shows at least as many.
test('the implicit form is read by both clients, and CesiumJS shows the tiles of the explicit form', { timeout: 240_000 }, async (t) => {
  for (const client of ['three', 'cesium']) {
    const shown = {};
    for (const form of ['implicit', 'tileset']) {
      const page = await browser.open(client);
      await page.evaluate((options) => window.client.open(options), { url: world('temperate_land.7', `${form}.json`), lines: 720 });
      const { faults, tiles, triangles } = await page.evaluate((pose) => window.client.view(pose), { east: 0, north: 0, up: 1500, heading: 0, pitch: -32 });
      assert.deepEqual([page.faults, faults], [[], []], `${client} ${form}`);
      assert.equal(page.files.filter(({ url }) => url.endsWith('.subtree')).length > 1, form === 'implicit');
      shown[form] = [tiles, triangles];
      await page.context().close();
    }
    t.diagnostic(`${client}: ${JSON.stringify(shown)}`);
    if (client === 'cesium') assert.deepEqual(shown.implicit, shown.tileset);
    assert.ok(shown.implicit[0] >= shown.tileset[0] && shown.tileset[0] > 3, JSON.stringify(shown));
  }
});
