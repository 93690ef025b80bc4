// The page of a world: a place in the address, flight, walking, and sliders that make another world.
import assert from 'node:assert/strict';
import zlib from 'node:zlib';
import { after, before, test } from 'node:test';
import { launch, program, serve, until_state } from './support.mjs';

let server, browser;
before(async () => {
  server = await serve(program, ['--threads', '2']);
  browser = await launch();
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

/** The page at a place, after its tiles have come. */
async function at(hash) {
  const page = await (await browser.newContext({ viewport: { width: 480, height: 270 } })).newPage();
  page.setDefaultTimeout(90_000);
  page.errors = [];
  page.on('pageerror', (error) => page.errors.push(error.message));
  page.on('console', (message) => { if (message.type() === 'error') page.errors.push(message.text()); });
  await page.goto(`${server.url}/world.html${hash}`);
  await until_state(page, 'ready');
  return page;
}

const place_of = (page) => page.evaluate(() => location.hash.slice(1).split('@'));

test('the address holds the world and the place, and keys move the camera', async () => {
  const page = await at('#temperate_land.7@100,200,900,90,-30');
  assert.deepEqual(await place_of(page), ['temperate_land.7', '100,200,900,90,-30']);
  assert.equal(await page.inputValue('[name=seed]'), '7');
  await page.locator('canvas').focus();
  await page.keyboard.down('w');
  await page.waitForFunction(() => Number(location.hash.split('@')[1].split(',')[0]) > 120);
  await page.keyboard.up('w');
  const [, place] = await place_of(page), [east, north, , heading] = place.split(',').map(Number);
  assert.ok(east > 120 && Math.abs(north - 200) < 1 && heading === 90, place); // it looks to the east
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test('on foot the camera stays at the height of eyes above the ground', async () => {
  const page = await at('#temperate_land.7@0,0,400,0,-10');
  await page.click('[name=walk]');
  await page.locator('canvas').focus();
  await page.keyboard.down('w');
  await page.waitForFunction(() => Number(location.hash.split('@')[1].split(',')[1]) > 4);
  await page.keyboard.up('w');
  await until_state(page, 'ready');
  await page.keyboard.press('w', { delay: 300 });
  const [, place] = await place_of(page), [east, north, height] = place.split(',').map(Number);
  assert.match(place, /,walk$/);
  const { heights: { columns, rows, values } } = (await server.post(`/v1/derive?box=${Math.floor(east) - 16},${Math.floor(north) - 16},${Math.floor(east) + 16},${Math.floor(north) + 16}`, { preset: 'temperate_land', seed: 7 })).json;
  const middle = values[Math.floor(rows / 2) * columns + Math.floor(columns / 2)];
  assert.ok(Math.abs(height - middle - 1.7) < 3, `${height} above ${middle}`);
  await page.context().close();
});

test('a slider of the schema makes another world at the same place, and its address opens it again', async () => {
  const page = await at('#temperate_land.7@0,0,2000,0,-30');
  const { properties } = (await server.get('/v1/schemas/world')).json.properties.relief;
  await page.click('summary');
  const slider = page.locator('[name="relief/mountains"]');
  assert.deepEqual([await slider.getAttribute('max'), await slider.inputValue()], [String(properties.mountains.maximum), '420']);
  await slider.evaluate((input) => { input.value = '1700'; input.dispatchEvent(new Event('change')); });
  await page.waitForFunction(() => !location.hash.startsWith('#temperate_land'));
  const [token, place] = await place_of(page);
  assert.equal(place, '0,0,2000,0,-30');
  const request = JSON.parse(zlib.inflateRawSync(Buffer.from(token, 'base64url')));
  const value = Number(await slider.inputValue());
  assert.ok(value > 1600 && request.parameters.relief.mountains === value && request.parameters.relief.hills === 110, JSON.stringify(request.parameters.relief));
  assert.equal(String(request.seed), '7');
  await until_state(page, 'ready');
  const again = await at(`#${token}@${place}`);
  await again.waitForSelector('[name="relief/mountains"]', { state: 'attached' });
  assert.deepEqual([await again.inputValue('[name="relief/mountains"]'), await again.inputValue('[name=seed]')], [String(value), '7']);
  assert.deepEqual([page.errors, again.errors], [[], []]);
  await page.context().close();
  await again.context().close();
});
