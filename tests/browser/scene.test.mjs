// Positions of a scene: added, listed, selected, moved, removed, aged and grown, one or all.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { difference, field, fragment_of, launch, open, open_parameters, picture, program, serve, statistics, until_shown } from './support.mjs';

let server, browser;
before(async () => { server = await serve(program); browser = await launch(); });
after(async () => { await browser?.close(); await server?.stop(); });

const bush = { generator: 'tree', parameters: { model: 'weber_penn', Levels: 2, Leaves: 0, sides: 4, mature_age: 12 } };
const garden = {
  generator: 'scene', seed: 5, output: { textures: 'none' },
  parameters: {
    ground: { size: 40 },
    layers: [
      { name: 'bush', model: bush, variants: 1, place: { method: 'positions', positions: [{ at: [-8, 0], age: 12 }, { at: [8, 0], age: 6 }] } },
      { name: 'stone', model: { generator: 'fractal', parameters: { iterations: 1 } }, place: { method: 'positions', positions: [{ at: [0, 12] }] } },
    ],
  },
};
const beds = [0, 1].map((layer) => `/parameters/layers/${layer}/place/positions`);

async function open_garden(options) {
  const asked = [];
  const page = await open(browser, `${server.url}/${fragment_of(garden)}`, { ...options, before: async (page) => {
    page.on('request', (request) => { if (request.url().endsWith('/v1/generate') && !/event-stream/.test(request.headers().accept)) asked.push(JSON.parse(request.postData())); });
  } });
  await page.click('#hint-away');
  await open_parameters(page);
  for (const layer of await page.locator('details.entry > summary').all()) await layer.click();
  const sends = async (act) => { await until_shown(page, act); return asked.at(-1).parameters.layers.map((layer) => layer.place.positions); };
  return { page, sends, asked, bed: (layer) => field(page, beds[layer]), canvas: page.locator('#picture') };
}

/** Where on the picture a place on the ground is, found by planting: not asked of the page. */
const near = (spot, other, reach) => Math.hypot(spot[0] - other[0], spot[1] - other[1]) <= reach;

test('a right click adds to the list used last, with a copy of the selected entry', { timeout: 300_000 }, async () => {
  const { page, sends, bed, canvas } = await open_garden();
  assert.equal(await bed(0).locator('.placed').count(), 2);
  assert.equal(await bed(1).locator('.placed').count(), 1);
  await bed(0).locator('.placed button').first().click();
  const before = await statistics(page);
  const [bushes, stones] = await sends(() => canvas.click({ button: 'right', position: { x: 120, y: 210 } }));
  assert.equal(stones.length, 1);
  assert.equal(bushes.length, 3);
  assert.equal(bushes[2].age, 12, 'like the one that was chosen');
  assert.ok(bushes[2].at.every((value) => Math.abs(value) < 60));
  assert.notDeepEqual(await statistics(page), before, 'it stands in the model');
  assert.match(await bed(0).locator('.chosen').textContent(), /^Position 3/);
  await bed(1).locator('.placed button').first().click();
  assert.equal(await bed(0).locator('.chosen').count(), 0, 'one is chosen in all lists');
  const [, more] = await sends(() => canvas.click({ button: 'right', position: { x: 300, y: 210 } }));
  assert.equal(more.length, 2);
  assert.ok(more[1].at[0] > bushes[2].at[0], 'further to the right');
  assert.deepEqual(page.errors, []);
});

test('with planting switched on every click adds a position, until it is switched off', { timeout: 300_000 }, async () => {
  const { page, sends, bed, canvas } = await open_garden();
  const plant = bed(0).getByRole('button', { name: 'Plant by click' });
  await plant.click();
  assert.equal((await sends(() => canvas.click({ position: { x: 120, y: 210 } })))[0].length, 3);
  assert.equal((await sends(() => canvas.click({ position: { x: 240, y: 222 } })))[0].length, 4);
  await plant.click();
  assert.equal(await plant.getAttribute('aria-pressed'), 'false');
  await canvas.click({ position: { x: 120, y: 210 } });
  assert.match(await bed(0).locator('.chosen').textContent(), /^Position 3/, 'now a click chooses');
  await until_shown(page, () => page.click('#undo'));
  await page.waitForFunction((pointer) => document.querySelectorAll(`[data-pointer="${pointer}"] .placed`).length < 4, beds[0]);
});

test('the position selected in the view is moved, aged and removed', { timeout: 300_000 }, async () => {
  const { page, sends, bed, canvas } = await open_garden();
  const [planted] = await sends(() => canvas.click({ button: 'right', position: { x: 150, y: 205 } }));
  const spot = planted.at(-1).at;
  await canvas.click({ position: { x: 20, y: 112 } });
  assert.equal(await page.locator('.placed .chosen').count(), 0, 'a click on nothing lets go');
  await canvas.click({ position: { x: 150, y: 205 } });
  assert.match(await bed(0).locator('.chosen').textContent(), /^Position 3/);
  const age = field(page, `${beds[0]}/2/age`).locator('input[type=number]');
  const [aged] = await sends(() => age.fill('9'));
  assert.deepEqual(aged[2], { at: spot, age: 9 });
  await bed(0).getByRole('button', { name: 'Move by click' }).click();
  const [moved] = await sends(() => canvas.click({ position: { x: 250, y: 215 } }));
  assert.ok(moved[2].at[0] > spot[0] && moved[2].age === 9 && !near(moved[2].at, spot, 0.5), JSON.stringify(moved[2]));
  await page.focus('#picture');
  const [left] = await sends(() => page.keyboard.press('Delete'));
  assert.deepEqual(left, garden.parameters.layers[0].place.positions);
  const [one] = await sends(() => bed(0).getByRole('button', { name: 'Remove Position 2' }).click());
  assert.deepEqual(one, [{ at: [-8, 0], age: 12 }]);
  const [two] = await sends(() => bed(0).getByRole('button', { name: 'Add position' }).click());
  assert.deepEqual(two[1], { at: [0, 0] }, 'by keyboard too');
  assert.deepEqual(page.errors, []);
});

test('growth plays for one plant and for all, without a change of the request', { timeout: 300_000 }, async () => {
  const { page, bed, asked } = await open_garden();
  const whole = await statistics(page);
  const hash = new URL(page.url()).hash;
  const over = () => page.waitForFunction(() => document.getElementById('growth-play').textContent === 'Play' && document.body.dataset.state === 'ready');
  await bed(0).locator('.placed button').first().click();
  asked.length = 0;
  await field(page, `${beds[0]}/0/age`).getByRole('button', { name: 'Grow by Age' }).click();
  assert.ok(await page.isVisible('#growth'));
  await over();
  const ages = asked.map((request) => request.parameters.layers[0].place.positions[0].age);
  assert.ok(ages.length > 10 && ages.at(-1) === 12 && ages.every((age, index) => index === 0 || age > ages[index - 1]), String(ages));
  assert.ok(asked.every((request) => request.parameters.layers[0].place.positions[1].age === 6), 'the others stay');
  assert.deepEqual(await statistics(page), whole);
  assert.equal(new URL(page.url()).hash, hash);
  await until_shown(page, () => page.locator('#growth-value').fill('8'));
  assert.match(await page.textContent('#growth-now'), /^Age 4 of 12$/);
  assert.notDeepEqual(await statistics(page), whole);
  await until_shown(page, () => page.click('#growth-away'));
  assert.deepEqual(await statistics(page), whole);
  assert.ok(await page.isHidden('#growth'));
  asked.length = 0;
  await field(page, '/parameters/age').getByRole('button', { name: 'Grow by Age' }).click();
  await page.waitForFunction(() => document.getElementById('growth-value').valueAsNumber > 3);
  await page.click('#growth-play');
  assert.equal(await page.textContent('#growth-play'), 'Play');
  assert.ok(asked.length > 1 && asked.every((request) => request.parameters.age > 0 && request.parameters.age <= 20));
  // A change of the request ends the growth.
  await until_shown(page, () => page.fill('#seed', '9'));
  assert.ok(await page.isHidden('#growth'));
  assert.deepEqual(page.errors, []);
});

test('markers are shown while the form is visible', { timeout: 300_000 }, async () => {
  const { page } = await open_garden();
  const marked = await picture(page);
  await page.click('#tab-gallery');
  let share = 0;
  for (let tries = 0; tries < 20 && share < 0.0003; tries += 1) share = difference(marked, await picture(page), 0.04);
  assert.ok(share >= 0.0003, `${share} of the picture`);
});

test('a position added from the gallery tab is confirmed, and outside the ground none is added', { timeout: 300_000 }, async () => {
  const { page, sends, canvas } = await open_garden();
  await page.click('#tab-gallery');
  assert.equal((await sends(() => canvas.click({ button: 'right', position: { x: 200, y: 215 } }))).flat().length, 4);
  await page.waitForFunction(() => /^Planted at -?[\d.]+, -?[\d.]+ m/.test(document.getElementById('status').textContent));
  await canvas.click({ button: 'right', position: { x: 30, y: 280 } });
  await page.waitForFunction(() => document.getElementById('status').textContent.includes('no ground at this position'));
});

test('a tap adds a position, and a long press does so without the switch', { timeout: 300_000 }, async () => {
  const { page, sends, bed, canvas } = await open_garden({ hasTouch: true });
  await bed(0).getByRole('button', { name: 'Plant by click' }).click();
  assert.equal((await sends(() => canvas.tap({ position: { x: 120, y: 210 } })))[0].length, 3);
  await bed(0).getByRole('button', { name: 'Plant by click' }).click();
  const box = await canvas.boundingBox();
  const touch = { x: box.x + 260, y: box.y + 215 };
  const session = await page.context().newCDPSession(page);
  const [bushes] = await sends(async () => {
    await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [touch] });
    await page.waitForTimeout(700);
    await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  });
  assert.equal(bushes.length, 4);
  assert.deepEqual(page.errors, []);
});
