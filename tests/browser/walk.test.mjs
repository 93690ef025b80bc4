// A first visit to the page, from the first model to a link that another browser opens.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { code, difference, field, fitted_picture, launch, open, open_parameters, program, selected, serve, statistics, until_shown, until_state, write, written } from './support.mjs';

let server, browser;
before(async () => { server = await serve(program); browser = await launch(); });
after(async () => { await browser?.close(); await server?.stop(); });

test('a new visitor grows a tree, corrects a production and shares the result', { timeout: 600_000 }, async (t) => {
  const page = await open(browser, server.url, { permissions: ['clipboard-read', 'clipboard-write'] });
  const productions = field(page, '/parameters/productions');
  let whole, link, shown, drawing;

  await t.test('the page shows a model without a click', async () => {
    assert.match(await page.getAttribute('#picture', 'aria-label'), /[1-9][\d,]* triangles/);
    assert.ok((await statistics(page)).bytes > 1000);
  });
  await t.test('a preset is chosen from the gallery', async () => {
    await until_shown(page, () => page.click('[data-preset="kogovsek_willow_random"]'));
    assert.equal(await page.getAttribute('[data-preset="kogovsek_willow_random"]', 'aria-pressed'), 'true');
    assert.match(new URL(page.url()).hash, /^#[\w-]{50,}\.kogovsek_willow_random$/);
  });
  await t.test('a number is changed, and the view follows', async () => {
    await open_parameters(page);
    const before = await statistics(page);
    const box = field(page, '/parameters/iterations').locator('input[type=number]');
    const value = Number(await box.inputValue());
    await until_shown(page, () => box.fill(String(value - 1)));
    assert.notDeepEqual(await statistics(page), before);
  });
  await t.test('an invalid production is reported at its line and column', async () => {
    whole = await written(productions);
    const lines = whole.split('\n');
    const last = lines.length - 1;
    await write(productions, [...lines.slice(0, last), `${lines[last]}[`].join('\n'));
    await until_state(page, 'refused');
    const spot = field(page, '/parameters/productions').locator('.spot');
    const column = lines[last].length + 1;
    assert.match(await spot.first().textContent(), new RegExp(`^Line ${last + 1}, column ${column}: .*\\[`));
    await spot.first().click();
    assert.equal(await selected(productions), '[');
    assert.equal(await productions.locator('.cm-lintRange-error').textContent(), '[');
    assert.equal(await code(productions).getAttribute('aria-invalid'), 'true');
    assert.ok((await page.textContent('#alert')).length > 0);
  });
  await t.test('it is corrected, and the error disappears', async () => {
    await until_shown(page, () => write(productions, whole));
    assert.equal(await field(page, '/parameters/productions').locator('.spot').count(), 0);
    assert.equal(await page.textContent('#alert'), '');
  });
  await t.test('a random seed is chosen', async () => {
    const seed = await page.inputValue('#seed');
    const before = await statistics(page);
    await until_shown(page, () => page.click('#dice'));
    assert.notEqual(await page.inputValue('#seed'), seed);
    assert.notDeepEqual(await statistics(page), before);
  });
  await t.test('the link is copied', async () => {
    await page.click('#copy-link');
    await page.waitForFunction(() => document.getElementById('status').textContent === 'The link is copied');
    link = await page.evaluate(() => navigator.clipboard.readText());
    assert.ok(link.startsWith(`${server.url}/#`), link);
    shown = await statistics(page);
    // The camera keeps its position when the seed changes, so that seeds can be compared, and the statistics
    // under the model show the generation time. A newly opened page has neither.
    drawing = await fitted_picture(await open(browser, link));
  });
  await t.test('a new browser opens it with the same view, statistics and fields', async () => {
    const other_browser = await launch();
    try {
      const other = await open(other_browser, link);
      assert.deepEqual(await statistics(other), shown);
      assert.equal(await other.inputValue('#seed'), await page.inputValue('#seed'));
      await open_parameters(other);
      assert.equal(await written(field(other, '/parameters/productions')), whole);
      const differs = difference(drawing, await fitted_picture(other));
      assert.ok(differs < 0.002, `${differs} of the picture differs`);
      // The comparison itself can distinguish images.
      await until_shown(other, () => other.fill('#seed', '12345'));
      assert.ok(difference(drawing, await fitted_picture(other)) > 0.002);
    } finally {
      await other_browser.close();
    }
  });
  assert.deepEqual(page.errors, []);
});

test('a visitor opens the oak, changes its age and season, breaks and corrects a grammar, undoes and shares', { timeout: 600_000 }, async (t) => {
  const page = await open(browser, server.url, { permissions: ['clipboard-read', 'clipboard-write'] });
  const triangles = async () => Number((await statistics(page)).triangles.replaceAll(',', ''));
  const choose = async (name) => {
    await page.click('#tab-gallery');
    await until_shown(page, () => page.click(`[data-preset="${name}"]`));
    await open_parameters(page);
  };

  await t.test('the oak in winter has no leaves', async () => {
    await choose('oak');
    const summer = await triangles();
    await until_shown(page, () => field(page, '/parameters/season').locator('select').selectOption({ label: 'winter' }));
    assert.ok(await triangles() < summer);
  });
  await t.test('undo restores the summer', async () => {
    await until_shown(page, () => page.click('#undo'));
    assert.equal(await field(page, '/parameters/season').locator('select option:checked').textContent(), 'summer');
  });
  await t.test('the oak at six years is smaller', async () => {
    const grown = await triangles();
    const height = async () => Number(/([\d.]+) × [\d.]+ m/.exec(await page.textContent('#measures'))[1]);
    const tall = await height();
    const age = field(page, '/parameters/age').locator('input[type=number]');
    await until_shown(page, () => age.fill('6'));
    assert.ok(await triangles() < grown && await height() < tall);
  });
  await t.test('a plant is made younger', async () => {
    await choose('growing_tree');
    const grown = await triangles();
    const age = field(page, '/parameters/age').locator('input[type=number]');
    await until_shown(page, () => age.fill('4'));
    assert.ok(await triangles() < grown);
  });
  await t.test('an invalid grammar is reported at its position and restored by undo', async () => {
    const productions = field(page, '/parameters/productions');
    await productions.scrollIntoViewIfNeeded();
    const whole = await written(productions);
    await page.waitForTimeout(800);
    await write(productions, `${whole}(`);
    await until_state(page, 'refused');
    assert.match(await productions.locator('.spot').first().textContent(), /^Line \d+, column \d+: /);
    await until_shown(page, () => page.click('#undo'));
    assert.equal(await written(productions), whole);
    assert.equal(await page.textContent('#alert'), '');
  });
  await t.test('and corrected in the editor', async () => {
    const productions = field(page, '/parameters/productions');
    await productions.scrollIntoViewIfNeeded();
    const whole = await written(productions);
    await page.waitForTimeout(800);
    await write(productions, `${whole}[`);
    await until_state(page, 'refused');
    await until_shown(page, () => write(productions, whole));
    assert.equal(await productions.locator('.spot').count(), 0);
  });
  await t.test('a new browser shows the same from the link', async () => {
    await page.click('#copy-link');
    await page.waitForFunction(() => document.getElementById('status').textContent.startsWith('The link is copied'));
    const link = await page.evaluate(() => navigator.clipboard.readText());
    const other_browser = await launch();
    try {
      const other = await open(other_browser, link);
      assert.deepEqual(await statistics(other), await statistics(page));
      assert.ok(difference(await fitted_picture(await open(browser, link)), await fitted_picture(other)) < 0.002);
    } finally {
      await other_browser.close();
    }
  });
  assert.deepEqual(page.errors, []);
});
