// Phones, narrow windows and small models: nothing is truncated or covered, and the keyboard focus is not
// lost.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { difference, extent, field, fragment_of, launch, leafy, open, open_menu, open_parameters, outline, picture, program, rect, serve, set, small_tree, until_shown, until_state } from './support.mjs';

let server, browser, address;
before(async () => {
  server = await serve(program);
  browser = await launch();
  address = `${server.url}/${fragment_of(small_tree)}`;
});
after(async () => { await browser?.close(); await server?.stop(); });

const building = (rules, size) => ({ generator: 'building', seed: 1, parameters: { rules, start: 'Lot', size } });
const tower = building('Lot --> extrude(20) color("#aa8866") Mass.', [6, 0, 6]);
const phone = { hasTouch: true, isMobile: true };
const tell = (page, words) => page.evaluate((words) => document.getElementById('picture').dispatchEvent(new CustomEvent('tell', { bubbles: true, detail: words })), words);
const frames = (page) => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));

/** The elements that extend beyond a box, sideways, by more than half a pixel. */
const cut_off = (page, within, selector) => page.evaluate(([within, selector]) => {
  const { left, right } = within === '' ? { left: 0, right: innerWidth } : document.querySelector(within).getBoundingClientRect();
  return [...document.querySelectorAll(selector)].filter((each) => each.checkVisibility() && !each.closest('.menu-body')).filter((each) => {
    const box = each.getBoundingClientRect();
    return box.left < left - 0.5 || box.right > right + 0.5;
  }).map((each) => each.id || each.textContent);
}, [within, selector]);

for (const [width, height, options] of [[390, 844, phone], [844, 390, phone], [320, 640, phone], [720, 800, {}], [1000, 700, {}]]) {
  test(`at ${width} x ${height} a first visitor sees the whole model and all buttons`, { timeout: 300_000 }, async () => {
    const page = await open(browser, `${server.url}/${fragment_of(tower)}`, { viewport: { width, height }, ...options });
    await page.waitForSelector('#parameters .form', { state: 'attached' });
    assert.deepEqual(await cut_off(page, '', '.bar button, .bar summary, .bar input:not([type="file"]), .panel-head button'), []);
    assert.deepEqual(await cut_off(page, '.view', '.tools button, .tools summary, .heading, #hint, .strip button, #statistics, #statistics dd'), []);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    const heights = await page.locator('#open-file, #code-menu > summary, #seeds-menu > summary, #dice').evaluateAll((all) => all.map((each) => Math.round(each.getBoundingClientRect().height)));
    assert.equal(new Set(heights).size, 1, `heights ${heights}`);

    const model = await extent(page);
    const upper = await rect(page, '#upper'), hint = await rect(page, '#hint');
    assert.ok(model.top > upper.bottom && model.bottom < hint.top, JSON.stringify({ model, upper, hint }));

    await open_menu(page);
    const menu = await rect(page, '#view-options');
    assert.ok(menu.bottom <= height && menu.left >= 0 && menu.right <= width, JSON.stringify(menu));
    const last = page.locator('#show-drawn');
    await last.scrollIntoViewIfNeeded();
    assert.ok((await last.boundingBox()).y < height - 8, 'its last row can be reached');
    await page.keyboard.press('Escape');

    const high = model.bottom - model.top;
    await page.evaluate(() => { document.getElementById('hint-away').click(); });
    await frames(page);
    const freed = await extent(page), lower = await rect(page, '#lower');
    assert.ok(freed.bottom < lower.top && freed.bottom - freed.top > high, 'without the hint it has more room');
    if (height < 400) {
      await page.click('#compare');
      await frames(page);
      const beside = await extent(page), bars = await rect(page, '#lower');
      assert.ok(beside.top > upper.bottom && beside.bottom < bars.top, JSON.stringify({ beside, upper, bars }));
    }

    await tell(page, `a_${'very_'.repeat(60)}long.json is opened`);
    await page.waitForFunction(() => /is opened$/.test(document.getElementById('status').textContent));
    const notice = await rect(page, '#notice'), view = await rect(page, '.view');
    assert.ok(notice.left >= view.left && notice.right <= view.right && notice.bottom <= height, JSON.stringify(notice));
  });
}

test('a rotated model and a compared model stay fully visible in a narrower window', { timeout: 300_000 }, async () => {
  const wide = building('Lot --> extrude(4) color("#aa8866") Mass.', [24, 0, 6]);
  const page = await open(browser, `${server.url}/${fragment_of(wide)}`, { viewport: { width: 1300, height: 600 } });
  await page.click('#hint-away');
  await page.focus('#picture');
  await page.keyboard.press('ArrowLeft');
  await page.setViewportSize({ width: 740, height: 600 });
  await frames(page);
  const model = await extent(page), view = await rect(page, '.view');
  assert.ok(model.left > view.left + 2 && model.right < view.right - 2, JSON.stringify({ model, view }));
  await page.click('#compare');
  await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of(building('Lot --> extrude(3) color("#8866aa") Mass.', [3, 0, 3]))));
  await page.click('#fit');
  await page.locator('#divider').evaluate((slider) => { slider.value = 100; slider.dispatchEvent(new Event('input')); });
  const left = await extent(page);
  assert.ok(left.left > view.left + 2 && left.right < view.right - 2, JSON.stringify({ left, view }));
  assert.deepEqual(page.errors, []);
});

test('the person is shown beside models of similar or larger size, and elsewhere on demand', { timeout: 300_000 }, async () => {
  const shrub = building('Lot --> extrude(0.9) color("#557744") Mass.', [1.2, 0, 1.2]);
  const page = await open(browser, `${server.url}/${fragment_of(shrub)}`);
  await page.click('#hint-away');
  const pressed = (id) => page.getAttribute(id, 'aria-pressed');
  await page.waitForFunction(() => document.getElementById('figure').getAttribute('aria-pressed') === 'false');
  const alone = await extent(page);
  await page.click('#figure');
  await page.waitForFunction(() => document.getElementById('figure').getAttribute('aria-pressed') === 'true');
  const beside = await extent(page);
  assert.ok(beside.bottom - beside.top < (alone.bottom - alone.top) * 0.8, 'the person needs room');
  await page.click('#figure');
  await page.waitForFunction(() => document.getElementById('figure').getAttribute('aria-pressed') === 'false');
  // A hovered button must not look like a pressed one.
  const ground = (id) => page.locator(id).evaluate((button) => getComputedStyle(button).backgroundColor);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const on = await ground('#grid');
  await page.click('#grid');
  assert.equal(await pressed('#grid'), 'false');
  await page.hover('#grid');
  assert.notEqual(await ground('#grid'), on);
});

test('level terrain hides the grid at its height, and the grid is not drawn over the model from below', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of(building('Lot --> color("#7d9650") Mass.', [40, 0, 40]))}`, { viewport: { width: 1000, height: 600 } });
  await page.click('#hint-away');
  const { left, right, top, bottom } = await extent(page);
  const area = await rect(page, '#picture');
  /** The share of pixels in the middle of the model that the grid changes. */
  const share = async () => {
    const clip = (png) => {
      const whole = PNG.sync.read(png);
      const part = new PNG({ width: Math.floor((right - left) / 3), height: Math.floor((bottom - top) / 3) });
      PNG.bitblt(whole, part, Math.floor((left + right) / 2 - area.left - part.width / 2), Math.floor((top + bottom) / 2 - area.top - part.height / 2), part.width, part.height, 0, 0);
      return PNG.sync.write(part);
    };
    const before = clip(await picture(page));
    await page.click('#grid');
    const after = clip(await picture(page));
    await page.click('#grid');
    return difference(before, after, 0.02);
  };
  assert.equal(await share(), 0);
  await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of(tower)));
  await page.focus('#picture');
  for (let step = 0; step < 12; step += 1) await page.keyboard.press('ArrowDown');
  await frames(page);
  assert.equal(await share(), 0, 'from below');
});

test('zooming by wheel and by keys stops in front of a wall', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/?stage&quality=low${fragment_of(tower)}`, { viewport: { width: 480, height: 360 } });
  const in_the_middle = async () => { const seen = outline(await page.screenshot({ omitBackground: true })); return seen[180 * 480 + 240]; };
  for (let step = 0; step < 60; step += 1) await page.locator('#picture').press('+');
  await frames(page);
  assert.equal(await in_the_middle(), 1, 'by keys');
  await page.locator('#picture').press('f');
  await page.mouse.move(240, 180);
  for (let step = 0; step < 25; step += 1) {
    await page.mouse.wheel(0, -300);
    await frames(page);
  }
  assert.equal(await in_the_middle(), 1, 'by wheel');
});

test('a model without UVs is drawn without squares, with a message', { timeout: 300_000 }, async () => {
  // Only quantized files have no box projection.
  const sponge = { generator: 'fractal', seed: 0, parameters: (await server.get('/v1/presets/menger_sponge')).json.parameters, output: { profile: 'web' } };
  const page = await open(browser, `${server.url}/${fragment_of(sponge)}`);
  await page.click('#hint-away');
  assert.match(await page.locator('#shading option[value="uv"]').textContent(), /none here/);
  await set(page, 'shading', 'uv');
  await page.waitForFunction(() => /no UVs/.test(document.getElementById('status').textContent));
  const { left, right, top, bottom } = await extent(page, 'uv');
  const area = await rect(page, '#picture');
  const seen = PNG.sync.read(await picture(page));
  const shades = new Set();
  for (let y = Math.ceil(top - area.top); y < bottom - area.top; y += 5)
    for (let x = Math.ceil(left - area.left); x < right - area.left; x += 5) {
      const [r, g, b] = seen.data.subarray((y * seen.width + x) * 4);
      shades.add(Math.round((r + g + b) / 24));
      assert.ok(b < 1.4 * r + 20, `${r} ${g} ${b} is blue`);
    }
  assert.ok(shades.size > 3, 'faces have different shades');
  await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of(leafy)));
  assert.equal(await page.locator('#shading option[value="uv"]').textContent(), 'UV squares');
});

test('the frame time includes the GPU work, and the timer that levels switch on is switched off with them', { timeout: 300_000 }, async () => {
  const page = await open(browser, address, {
    before: (page) => page.addInitScript(() => {
      window.waits = 0;
      const read = WebGL2RenderingContext.prototype.readPixels;
      WebGL2RenderingContext.prototype.readPixels = function (...args) { window.waits += 1; return read.apply(this, args); };
    }),
  });
  await page.focus('#picture');
  await page.keyboard.press('ArrowLeft');
  await frames(page);
  assert.equal(await page.evaluate(() => window.waits), 0, 'who does not ask does not wait');
  await open_menu(page);
  await page.check('#show-drawn');
  await page.waitForFunction(() => window.waits > 0 && /^[\d.]+ ms/.test(document.getElementById('drawn').textContent));
  await page.uncheck('#show-drawn');
  await page.selectOption('#detail', 'ask');
  await page.waitForFunction(() => document.getElementById('show-drawn').checked);
  await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of({ ...small_tree, seed: 8, parameters: { ...small_tree.parameters, angle: 30 } })));
  assert.equal(await page.isChecked('#show-drawn'), false);
  assert.ok(await page.isHidden('#drawn-box'));
});

test('the keyboard focus stays near its previous position', { timeout: 300_000 }, async () => {
  let hold = false, release = () => {};
  const page = await open(browser, address, {
    before: (page) => page.route('**/v1/generate*', async (route) => { if (hold) await new Promise((resolve) => { release = resolve; }); await route.continue().catch(() => {}); }),
  });
  await page.click('#hint-away');
  await page.waitForSelector('#parameters .form', { state: 'attached' });
  const is_at = (selector) => page.waitForFunction((selector) => document.activeElement?.matches(selector), selector);
  const press = async (selector, key = 'Enter') => { await page.focus(selector); await page.keyboard.press(key); };
  await until_shown(page, () => press('#dice'));
  await until_shown(page, () => press('#undo'));
  await is_at('#redo');
  await until_shown(page, () => press('#step-back'));
  await until_shown(page, () => press('#step-finish'));
  await is_at('#step-bar button:not(#step-finish)');
  await press('#seeds-menu > summary');
  await press('#nine');
  await page.waitForSelector('#nine-dialog[open]');
  await page.keyboard.press('Escape');
  await is_at('#seeds-menu > summary');
  hold = true;
  await press('#dice');
  await page.waitForSelector('#cancel');
  await press('#cancel');
  await until_state(page, 'stopped');
  await is_at('#again');
  hold = false;
  release();
  await until_shown(page, () => page.keyboard.press('Enter'));
  await is_at('#picture');
});

test('growth shows its unit, and a long list of names in an error is shortened', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/?quality=low${fragment_of(leafy)}`);
  await open_parameters(page);
  await field(page, '/parameters/age').getByRole('button', { name: /^Grow by/ }).click();
  await page.waitForFunction(() => / of [\d.]+ years$/.test(document.getElementById('growth-now').textContent));
  await page.click('#growth-away');
  await until_state(page, 'ready');
  await page.evaluate((hash) => { location.hash = hash; }, fragment_of({ ...leafy, parameters: { zqzqz: 3 } }));
  await page.waitForFunction(() => /zqzqz/.test(document.getElementById('alert').textContent));
  const words = await page.textContent('#alert');
  assert.match(words, /known are (\w+, ){4,}and \d+ more/);
  assert.ok(words.length < 260, words);
});
