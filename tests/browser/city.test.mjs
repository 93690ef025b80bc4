// The plan of a city on the page: steps, picking, and the request of a building.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { fragment_of, launch, open, program, request_of, serve, until_state } from './support.mjs';

let server, browser;
const town = { generator: 'city', seed: 4, parameters: { area: { size: [300, 260] } }, output: { textures: 'none' } };
before(async () => { server = await serve(program); browser = await launch(); });
after(async () => { await browser?.close(); await server?.stop(); });

const plan_of = async (request) => (await server.post('/v1/derive', request)).json.plan.features;

/** The page with the plan in sight. */
async function with_plan(request) {
  const page = await open(browser, `${server.url}/${fragment_of(request)}`, { viewport: { width: 1000, height: 800 } });
  await page.click('#tab-result');
  await page.waitForSelector('.city-plan');
  return page;
}

/** Clicks a position of the plan, in metres, while the whole plan is shown. */
async function click_at(page, [x, y], [width, depth]) {
  const canvas = page.locator('.city-plan');
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  const scale = 0.96 * Math.min(box.width / width, box.height / depth);
  await canvas.click({ position: { x: box.width / 2 + x * scale, y: box.height / 2 - y * scale } });
}

const set_step = (page, step) => page.locator('#plan-step').evaluate((input, value) => { input.value = String(value); input.dispatchEvent(new Event('input')); }, step);
const shown_kind = (page) => page.locator('.picked h4').textContent();

/** Pixels of the plan that differ between two steps. */
const pixels = (page) => page.locator('.city-plan').evaluate((canvas) => Array.from(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data));

test('the plan is drawn in five steps that differ', { timeout: 300_000 }, async () => {
  const page = await with_plan(town);
  const names = [], drawn = [];
  for (const step of [1, 2, 3, 4, 5]) {
    await set_step(page, step);
    names.push(await page.locator('output[for="plan-step"]').textContent());
    drawn.push(await pixels(page));
  }
  assert.deepEqual(names, ['Highways', 'Streets', 'Blocks', 'Lots', 'Buildings']);
  for (let k = 1; k < drawn.length; k += 1) {
    const changed = drawn[k].filter((value, i) => value !== drawn[k - 1][i]).length;
    assert.ok(changed > 2000, `step ${k + 1} changes ${changed} values`);
  }
  assert.deepEqual(page.errors, []);
});

test('a click selects the lot, the street or the block at a position, and opens the request of its building', { timeout: 300_000 }, async () => {
  const features = await plan_of(town), page = await with_plan(town), size = town.parameters.area.size;
  const lot = features.find(({ properties }) => properties.kind === 'lot' && properties.building);
  await click_at(page, lot.properties.position, size);
  assert.equal(await shown_kind(page), 'Lot');
  assert.ok((await page.locator('.picked').textContent()).includes(lot.properties.id));
  await set_step(page, 3);
  await click_at(page, lot.properties.position, size);
  assert.equal(await shown_kind(page), 'Block');
  assert.ok((await page.locator('.picked').textContent()).includes(lot.properties.block));
  const street = features.find(({ properties }) => properties.kind === 'street' && properties.level === 0);
  const [[ax, ay], [bx, by]] = street.geometry.coordinates;
  await set_step(page, 5);
  await click_at(page, [(ax + bx) / 2, (ay + by) / 2], size);
  assert.equal(await shown_kind(page), 'Street');
  assert.ok((await page.locator('.picked').textContent()).includes(street.properties.id));
  await click_at(page, lot.properties.position, size);
  await page.click('#open-building');
  await page.waitForFunction(() => location.hash.length > 1 && document.getElementById('title').textContent === 'Building of a lot');
  await until_state(page, 'ready');
  const opened = request_of(await page.evaluate(() => location.hash));
  assert.deepEqual([opened.generator, opened.seed, opened.parameters], ['building', lot.properties.building.seed, lot.properties.building.parameters]);
  assert.deepEqual(page.errors, []);
});

test('the plan is read by keyboard, and keeps its step when the request changes', { timeout: 300_000 }, async () => {
  const page = await with_plan(town);
  await set_step(page, 4);
  await page.getByRole('button', { name: 'Next of these' }).focus();
  await page.keyboard.press('Enter');
  const first = await page.locator('.picked').textContent();
  await page.keyboard.press('Enter');
  assert.notEqual(await page.locator('.picked').textContent(), first);
  const before = await pixels(page);
  await page.getByRole('button', { name: 'Zoom in' }).click();
  assert.notDeepEqual(await pixels(page), before);
  await page.fill('#seed', '5');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => document.getElementById('result').dataset.for === '5');
  assert.equal(await page.locator('output[for="plan-step"]').textContent(), 'Lots');
  assert.deepEqual(page.errors, []);
});
