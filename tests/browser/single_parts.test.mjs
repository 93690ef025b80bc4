// Single parts of a model: a shape of a building, a plant of a scene, a texture, the light; and files of proctree.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { difference, fragment_of, launch, open, open_menu, picture, program, serve, until_shown } from './support.mjs';

let server, browser;
before(async () => { server = await serve(program); browser = await launch(); });
after(async () => { await browser?.close(); await server?.stop(); });

const at = (request) => `${server.url}/${fragment_of(request)}`;
const parameters_of = (page) => page.evaluate(async () => {
  const text = location.hash.slice(1).split('.')[0].replaceAll('-', '+').replaceAll('_', '/');
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  return JSON.parse(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'))).text()).parameters;
});

/** The address follows changes after a short pause. */
async function becomes(page, member, wanted) {
  for (let tries = 0; tries < 50 && JSON.stringify((await parameters_of(page))[member]) !== JSON.stringify(wanted); tries += 1) await page.waitForTimeout(100);
  assert.deepEqual((await parameters_of(page))[member], wanted);
}

test('a selected shape can be removed, get another rule, and be restored', { timeout: 300_000 }, async () => {
  const rules = 'Lot --> split(x) { ~1: Bay | ~1: Bay }\nBay --> split(y) { ~1: Low | ~1: Low }\nLow --> Wall.\nDoor --> color("#aa3322") Leaf.';
  const page = await open(browser, at({ generator: 'building', seed: 1, parameters: { rules, size: [8, 6, 2] } }));
  await page.click('#hint-away');
  await page.click('#tab-result');
  await page.waitForSelector('#show-shapes');
  await page.selectOption('#shape-kind', '=Bay');
  await page.check('#show-shapes');
  const box = await page.locator('#picture').boundingBox();
  await page.mouse.click(box.x + box.width * 0.56, box.y + box.height * 0.5);
  await page.waitForSelector('#edit-remove');
  const path = /PathLot\/Bay\[(\d)\]/.exec(await page.textContent('.picked'));
  assert.ok(path, await page.textContent('.picked'));
  await until_shown(page, () => page.click('#edit-remove'));
  await becomes(page, 'edits', [{ shape: `Lot/Bay[${path[1]}]`, remove: true }]);
  await page.waitForSelector('#edit-undo');
  await until_shown(page, () => page.selectOption('#edit-rule', 'Low'));
  await becomes(page, 'edits', [{ shape: `Lot/Bay[${path[1]}]`, rule: 'Low' }]);
  await page.waitForSelector('#edit-undo');
  await until_shown(page, () => page.click('#edit-undo'));
  await becomes(page, 'edits', undefined);
});

test('a selected shape gets attributes, which stay when its rule changes', { timeout: 300_000 }, async () => {
  const rules = 'attr sill = 0.9\nattr tint = "#d0c0a0"\nLot --> split(x) { ~1: Bay | ~1: Bay }\nBay --> split(y) { sill: Wall. | ~1: color(tint) Glass. }';
  const page = await open(browser, at({ generator: 'building', seed: 1, parameters: { rules, size: [8, 6, 2] } }));
  await page.click('#hint-away');
  await page.click('#tab-result');
  await page.waitForSelector('#show-shapes');
  await page.selectOption('#shape-kind', '=Bay');
  await page.check('#show-shapes');
  const box = await page.locator('#picture').boundingBox();
  await page.mouse.click(box.x + box.width * 0.56, box.y + box.height * 0.5);
  const sill = page.locator('.changes [data-pointer="/edit/attributes/sill"] input[type="number"]');
  await sill.waitFor();
  assert.equal(await sill.inputValue(), '0.9');
  const shape = `Lot/Bay[${/PathLot\/Bay\[(\d)\]/.exec(await page.textContent('.picked'))[1]}]`;
  // Digit by digit: the list is drawn again between them, and the field keeps the focus and its text.
  await sill.fill('');
  await until_shown(page, () => sill.press('2'));
  await becomes(page, 'edits', [{ shape, attributes: { sill: 2 } }]);
  await page.waitForSelector('#edit-undo');
  await page.keyboard.type('.5');
  await becomes(page, 'edits', [{ shape, attributes: { sill: 2.5 } }]);
  assert.equal(await sill.inputValue(), '2.5');
  const answer = (await server.post('/v1/derive', { generator: 'building', seed: 1, parameters: await parameters_of(page) })).json;
  const wall = answer.shapes.find((each) => each.path === `${shape}/Wall[1]`);
  assert.equal(wall.scope.size[1], 2.5);
  assert.equal(answer.shapes.filter((each) => each.symbol === 'Wall' && each.scope.size[1] === 0.9).length, 1);
  await page.locator('.changes [data-pointer="/edit/attributes/tint"] input[type="text"]').fill('#204060');
  await becomes(page, 'edits', [{ shape, attributes: { sill: 2.5, tint: '#204060' } }]);
  await until_shown(page, () => page.selectOption('#edit-rule', 'Lot'));
  await becomes(page, 'edits', [{ shape, attributes: { sill: 2.5, tint: '#204060' }, rule: 'Lot' }]);
  await page.waitForSelector('#edit-undo');
  await until_shown(page, () => page.selectOption('#edit-rule', ''));
  await page.locator('.changes [data-pointer="/edit/attributes/sill"] .reset').click();
  await becomes(page, 'edits', [{ shape, attributes: { tint: '#204060' } }]);
  await page.waitForSelector('#edit-undo');
  await until_shown(page, () => page.click('#edit-undo'));
  await becomes(page, 'edits', undefined);
});

test('a click on a plant shows its word, and its request is saved', { timeout: 300_000 }, async () => {
  const request = {
    generator: 'scene', seed: 1,
    parameters: {
      ground: { size: 12 },
      layers: [{ name: 'tree', model: { generator: 'lsystem', seed: 4, parameters: { axiom: 'F', productions: ['F -> F[+F]F'], iterations: 2 } }, variants: 1, place: { method: 'positions', positions: [{ at: [0, 0] }] } }],
    },
  };
  const page = await open(browser, at(request));
  await page.click('#hint-away');
  await page.click('#tab-result');
  await page.waitForSelector('.standing');
  const box = await page.locator('#picture').boundingBox();
  await page.mouse.click(box.x + box.width * 0.5, box.y + box.height * 0.55);
  await page.waitForSelector('#save-plant');
  assert.equal(await page.textContent('.picked pre'), 'F[+F]F[+F[+F]F]F[+F]F');
  assert.match(await page.textContent('.picked'), /Branches4Depth2/);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-plant')]);
  const saved = JSON.parse(fs.readFileSync(await download.path(), 'utf8'));
  assert.equal(saved.generator, 'lsystem');
  assert.deepEqual(saved.parameters.productions, ['F -> F[+F]F']);
  assert.equal((await server.post('/v1/validate', saved)).status, 200);
});

test('the page shows how many frames a second it draws while the model turns', { timeout: 300_000 }, async () => {
  const page = await open(browser, at({ generator: 'fractal', seed: 0, parameters: { iterations: 1 } }));
  await page.click('#hint-away');
  await open_menu(page);
  await page.check('#show-drawn');
  await page.keyboard.press('Escape');
  await page.focus('#picture');
  const shown = /^([\d.]+) ms, frame ([\d.]+) ms, (\d+) a second/;
  for (let tries = 0; tries < 100 && !shown.test(await page.textContent('#drawn')); tries += 1) await page.keyboard.press('ArrowLeft');
  const [, , frame, rate] = shown.exec(await page.textContent('#drawn')) ?? [];
  assert.ok(rate, await page.textContent('#drawn'));
  assert.ok(Math.abs(Number(rate) * Number(frame) - 1000) <= 0.5 * Number(frame) + 0.5 * Number(rate) + 1, `${frame} ms, ${rate} a second`);
});

test('fog and coloured light change the view and not the request', { timeout: 300_000 }, async () => {
  const page = await open(browser, at({ generator: 'fractal', seed: 0, parameters: { iterations: 1 } }));
  await page.click('#hint-away');
  const before = await parameters_of(page);
  await open_menu(page);
  for (const act of [() => page.check('#fog'), () => page.fill('#light-color', '#ff2000')]) {
    const earlier = await picture(page);
    await act();
    let share = 0;
    for (let tries = 0; tries < 20 && share < 0.001; tries += 1) share = difference(earlier, await picture(page), 0.04);
    assert.ok(share >= 0.001, String(share));
  }
  assert.deepEqual(await parameters_of(page), before);
});

test('a tree of the model proctree is saved as a file of proctree', { timeout: 300_000 }, async () => {
  const page = await open(browser, at({ generator: 'tree', seed: 1, parameters: { model: 'proctree', mSeed: 262, mLevels: 3 } }));
  await page.click('#hint-away');
  await page.click('#download-menu > summary');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-proctree')]);
  assert.match(download.suggestedFilename(), /\.proctree\.json$/);
  const saved = JSON.parse(fs.readFileSync(await download.path(), 'utf8'));
  assert.equal(Object.keys(saved).length, 22);
  assert.equal(saved.mLevels, 3);
});

test('a bark is chosen by its picture', { timeout: 300_000 }, async () => {
  const page = await open(browser, at({ generator: 'tree', seed: 1, parameters: { model: 'proctree', mLevels: 2 } }));
  await page.click('#hint-away');
  await page.click('#tab-parameters');
  const field = page.locator('[data-pointer="/parameters/bark"]');
  await field.evaluate((element) => { for (let up = element.closest('details'); up; up = up.parentElement?.closest('details')) up.open = true; });
  await field.locator('summary', { hasText: 'Pictures' }).click();
  const birch = field.locator('button[title="birch bark"]');
  await birch.scrollIntoViewIfNeeded();
  await page.waitForFunction(() => { const image = document.querySelector('[data-pointer="/parameters/bark"] button[title="birch bark"] img'); return image?.complete && image.naturalWidth === 96; });
  await until_shown(page, () => birch.click());
  await becomes(page, 'bark', 'birch_bark');
  assert.equal(await field.locator('select').first().inputValue(), 'birch_bark');
});
