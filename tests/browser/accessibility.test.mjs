// Runs axe-core on every panel and state in both themes, and uses the page with the keyboard only.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import { code, field, fragment_of, from_menu, launch, open, open_parameters, program, serve, small_tree, until_shown, until_state, write } from './support.mjs';

const axe = fs.readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const tags = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];

let server, browser, address;
before(async () => {
  server = await serve(program);
  browser = await launch();
  address = `${server.url}/${fragment_of(small_tree)}`;
});
after(async () => { await browser?.close(); await server?.stop(); });

/** Evaluated by the debugger, which the page's policy does not bind. */
async function passes(page, words, within = 'html') {
  await page.evaluate(axe);
  const { violations, passes } = await page.evaluate(({ tags, within }) => axe.run(document.querySelector(within), { runOnly: tags }), { tags, within });
  const summary = violations.map((each) => `${each.id}: ${each.nodes.map((node) => `${node.html} ${node.failureSummary}`).join('; ')}`);
  assert.deepEqual(summary, [], words);
  // An open dialog or menu covers most of the page, so fewer elements can be checked.
  assert.ok(passes.length >= 5, `${words}: ${passes.length} rules`);
}

for (const colorScheme of ['light', 'dark']) {
  test(`axe reports no violation in any panel or state, ${colorScheme}`, { timeout: 600_000 }, async () => {
    const page = await open(browser, address, { colorScheme, viewport: { width: 1000, height: 600 } });
    await page.click('.more-tags > summary');
    await passes(page, 'gallery');
    for (const menu of ['seeds-menu', 'code-menu', 'download-menu', 'view-menu']) {
      await page.click(`#${menu} > summary`);
      // Targets that an open menu partly covers cannot be reached until it is closed, so they are not
      // checked.
      await passes(page, menu, `#${menu}`);
    }
    await page.keyboard.press('Escape');
    await page.click('#compare');
    await passes(page, 'a comparison');
    await page.click('#compare');
    await page.click('#help');
    await passes(page, 'the keys');
    await page.keyboard.press('Escape');
    await from_menu(page, 'seeds-menu', '#nine');
    await page.waitForFunction(() => document.getElementById('nine-dialog').dataset.filled === '9');
    await passes(page, 'nine seeds');
    await page.keyboard.press('Escape');
    await page.setInputFiles('#file', { name: 'letter.txt', mimeType: 'text/plain', buffer: Buffer.from('Dear all,\nthis is a letter.\n') });
    await page.waitForSelector('#import-dialog[open]');
    await passes(page, 'a file of an unknown format');
    await page.keyboard.press('Escape');
    await page.click('#tab-request');
    await code(page.locator('#request')).waitFor();
    await passes(page, 'the JSON');
    await page.click('#tab-result');
    await page.waitForSelector('#result .figures');
    await passes(page, 'the result');
    await open_parameters(page);
    await code(field(page, '/parameters/axiom')).waitFor();
    for (const more of await page.locator('#parameters details.more > summary').all()) await more.click();
    await page.click('details[data-pointer="/output"] > summary');
    await field(page, '/parameters/axiom').getByRole('button', { name: 'About' }).click();
    for (const add of await page.locator('.add').all()) await add.click();
    await until_state(page, 'ready', 'refused');
    await passes(page, 'parameters');
    await write(field(page, '/parameters/productions'), 'F -> [');
    await until_state(page, 'refused');
    await passes(page, 'a refusal');
    await page.route('**/v1/generate', (route) => route.fulfill({ status: 503, headers: { 'Retry-After': '60' }, json: {} }));
    await page.fill('#seed', '2');
    await until_state(page, 'full');
    await passes(page, 'a full server');
    await page.click('#cancel');
    await until_state(page, 'stopped');
    await passes(page, 'stopped');
  });
}

const garden = {
  generator: 'scene', seed: 5, parameters: { ground: { size: 30 }, layers: [
    { name: 'stone', model: { generator: 'fractal', parameters: { iterations: 1 } }, place: { method: 'positions', positions: [{ at: [-4, 0] }, { at: [4, 2] }] } }] },
};
const house = { generator: 'building', seed: 1, parameters: { rules: 'Lot --> extrude(6) Mass\nMass --> comp(f) { side : Wall. | top : Lid. }', start: 'Lot', size: [8, 0, 6] } };
const leafy = { generator: 'tree', seed: 2, parameters: { model: 'weber_penn', Levels: 2, Leaves: 8, sides: 4 }, output: { textures: 'none' } };

for (const colorScheme of ['light', 'dark']) {
  test(`axe reports no violation in scenes, buildings, maps and animations, ${colorScheme}`, { timeout: 600_000 }, async () => {
    const page = await open(browser, `${server.url}/${fragment_of(garden)}`, { colorScheme, viewport: { width: 1000, height: 600 } });
    const show = (request) => until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of(request)));
    await open_parameters(page);
    await page.locator('details.entry > summary').first().click();
    await page.locator('.placed button').first().click();
    await page.getByRole('button', { name: 'Plant by click' }).click();
    await passes(page, 'a list of places');
    await field(page, '/parameters/age').getByRole('button', { name: 'Grow by Age' }).click();
    await page.click('#growth-play');
    await passes(page, 'growth');
    await show(house);
    await page.click('#tab-result');
    await page.check('#show-shapes');
    await page.locator('#picture').click({ position: { x: 320, y: 250 } });
    await page.waitForSelector('.picked h4');
    await passes(page, 'shapes');
    await show({ generator: 'terrain', seed: 1, parameters: { algorithm: 'diamond_square', iterations: 3 } });
    await page.waitForSelector('.height-map');
    await passes(page, 'a map of heights');
    await show(leafy);
    await page.click('#view-menu > summary');
    await page.waitForFunction(() => [...document.querySelectorAll('#motion-kind option')].some((option) => option.textContent === 'Wind'));
    await until_shown(page, () => page.selectOption('#motion-kind', { label: 'Wind' }));
    await page.selectOption('#detail', 'ask');
    await page.waitForFunction(() => document.getElementById('detail').value === 'auto');
    await passes(page, 'the menu of the view', '#view-menu');
    await page.keyboard.press('Escape');
    await page.click('#motion-play');
    await passes(page, 'motion and levels');
    await page.route('**/v1/generate', async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, headers: { ...response.headers(), 'seedmesh-triangles': '5000000' } });
    });
    await page.fill('#seed', '4');
    await until_state(page, 'asking');
    await passes(page, 'a question');
    assert.deepEqual(page.errors, []);
  });
}

test('axe reports no violation on a narrow screen', { timeout: 300_000 }, async () => {
  const page = await open(browser, address, { viewport: { width: 360, height: 640 }, hasTouch: true, isMobile: true });
  await passes(page, 'gallery');
  await page.click('#fold');
  assert.equal(await page.getAttribute('#fold', 'aria-expanded'), 'false');
  assert.ok(await page.isHidden('#gallery'));
  await passes(page, 'folded');
  await open_parameters(page);
  await passes(page, 'parameters');
  await page.click('#tab-request');
  await code(page.locator('#request')).waitFor();
  await passes(page, 'the JSON');
  assert.ok(await page.evaluate(() => [...document.querySelectorAll('.tools, .bar, .panel')].every((each) => each.getBoundingClientRect().right <= innerWidth)));
  for (const menu of ['seeds-menu', 'code-menu', 'download-menu', 'view-menu']) {
    await page.click(`#${menu} > summary`);
    const body = await page.locator(`#${menu} .menu-body`).boundingBox();
    assert.ok(body.x >= 0 && body.x + body.width <= 360, `${menu} lies in the window`);
    await page.keyboard.press('Escape');
  }
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 360, `the page is ${wide} px wide`);
});

test('the page can be used with the keyboard only', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  const focused = () => page.evaluate(() => document.activeElement.id);
  await page.keyboard.press('Tab');
  await page.keyboard.press('Enter');
  assert.equal(await focused(), 'picture');
  await until_shown(page, () => page.keyboard.press('r'));
  assert.notEqual(await page.inputValue('#seed'), '3');
  await page.keyboard.press('w');
  assert.equal(await page.getAttribute('#wireframe', 'aria-pressed'), 'true');
  await page.focus('#tab-gallery');
  await page.keyboard.press('ArrowRight');
  assert.equal(await focused(), 'tab-parameters');
  assert.ok(await page.isVisible('#parameters'));
  await page.keyboard.press('Tab');
  assert.notEqual(await focused(), 'tab-gallery');
  await page.focus('#seed');
  await page.keyboard.press('w');
  assert.equal(await page.getAttribute('#wireframe', 'aria-pressed'), 'true', 'letters typed into a field are no commands');
});

test('changes are announced to assistive technology', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  assert.equal(await page.getByRole('img', { name: /seed 3: [\d,]+ triangles, .* m high/ }).count(), 1);
  await until_shown(page, () => page.click('#dice'));
  assert.equal(await page.getByRole('img', { name: new RegExp(`seed ${await page.inputValue('#seed')}:`) }).count(), 1);
  assert.equal(await page.locator('#status[role=status]').count(), 1);
  assert.equal(await page.locator('#alert[role=alert]').count(), 1);
  // A finished model is announced only if no other follows shortly, so a moving slider causes one
  // announcement.
  const summary = () => page.textContent('#announcement');
  await page.waitForFunction(() => /, seed \d+: [\d,]+ triangles$/.test(document.getElementById('announcement').textContent));
  await page.evaluate(() => {
    window.changes = 0;
    new MutationObserver(() => { window.changes += 1; }).observe(document.getElementById('announcement'), { childList: true, characterData: true, subtree: true });
  });
  for (const seed of ['21', '22', '23']) await until_shown(page, () => page.fill('#seed', seed));
  await page.waitForFunction(() => /seed 23:/.test(document.getElementById('announcement').textContent));
  assert.match(await summary(), /^L-system.*, seed 23: [\d,]+ triangles$/);
  assert.ok(await page.evaluate(() => window.changes) < 3);
});

test('the gallery has few tab stops, and the arrow keys reach every card', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  const stops = await page.locator('#gallery').evaluate((gallery) => [...gallery.querySelectorAll('button, input, summary')]
    .filter((each) => each.checkVisibility() && each.tabIndex >= 0).length);
  assert.equal(stops, 4, 'search, generators, more tags, cards');
  const focused = () => page.evaluate(() => document.activeElement.dataset.preset ?? document.activeElement.textContent);
  const first = await page.locator('.kinds .chip').first().textContent();
  const last = await page.locator('.kinds .chip').last().textContent();
  await page.locator('.kinds .chip').first().focus();
  await page.keyboard.press('End');
  assert.equal(await focused(), last);
  await page.keyboard.press('Home');
  assert.equal(await focused(), first);
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  assert.equal(await page.locator('.family:visible').count(), 1);
  await page.keyboard.press('Tab');
  await page.keyboard.press('Tab');
  const card = await focused();
  assert.equal(card, await page.locator('.card:visible').first().getAttribute('data-preset'));
  await page.keyboard.press('End');
  const at_end = await focused();
  assert.equal(at_end, await page.locator('.card:visible').last().getAttribute('data-preset'));
  await page.keyboard.press('Shift+Tab');
  await page.keyboard.press('Tab');
  assert.equal(await focused(), at_end, 'the stop is where the focus was');
});
