// Visibility: the whole model between the overlays of the view, at a stable scale, and readable text.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { choose, difference, extent, fitted_picture, fragment_of, go_by, launch, leafy, open, open_menu, outline, overlap, picture, program, rect, serve, set, small_tree, statistics, until_shown, write } from './support.mjs';

let server, browser, address;
before(async () => {
  server = await serve(program);
  browser = await launch();
  address = `${server.url}/${fragment_of(small_tree)}`;
});
after(async () => { await browser?.close(); await server?.stop(); });

const tower = { generator: 'building', seed: 1, parameters: { rules: 'Lot --> extrude(20) color("#aa8866") Mass.', start: 'Lot', size: [6, 0, 6] } };
/** The rows from and to which the model is drawn. */
const rows = async (page) => {
  const { top, bottom } = await extent(page);
  return { top, bottom, height: bottom - top };
};

for (const colorScheme of ['light', 'dark']) {
  test(`the heading is readable over leaves and sky, ${colorScheme}`, { timeout: 200_000 }, async () => {
    const page = await open(browser, `${server.url}/${fragment_of(leafy)}`, { colorScheme, viewport: { width: 1000, height: 600 } });
    await set(page, 'sky', true);
    await page.focus('#picture');
    for (let step = 0; step < 14; step += 1) await page.keyboard.press('+');
    await page.waitForTimeout(300);
    const light = ([r, g, b]) => [r, g, b].map((each) => each / 255).map((each) => (each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4)).reduce((sum, each, index) => sum + each * [0.2126, 0.7152, 0.0722][index], 0);
    const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
    const ink = await page.locator('#measures').evaluate((each) => getComputedStyle(each).color.match(/\d+/g).map(Number));
    const { data, width, height } = PNG.sync.read(await page.locator('.heading').screenshot());
    let worst = 21;
    // Left of the text, inside the rounded corners.
    for (let y = 10; y < height - 10; y += 1) for (let x = 2; x < 9; x += 1) worst = Math.min(worst, contrast(ink, data.subarray((y * width + x) * 4, (y * width + x) * 4 + 3)));
    assert.ok(worst >= 4.5, `contrast ${worst}`);
  });
}

test('the scale is stable across models of a request unless the size changes', { timeout: 200_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of(tower)}`);
  await fitted_picture(page);
  const first = await rows(page);
  const rise = (metres) => until_shown(page, async () => {
    await page.click('#tab-request');
    await write(page.locator('#request'), JSON.stringify({ ...tower, parameters: { ...tower.parameters, rules: tower.parameters.rules.replace('20', String(metres)) } }));
  });
  await rise(18);
  const lower = await rows(page);
  assert.ok(lower.height < first.height * 0.95 && lower.height > first.height * 0.8, `${lower.height} of ${first.height}`);
  await rise(10);
  const framed = await rows(page);
  assert.ok(framed.height > first.height * 0.75, `${framed.height}, framed anew`);
});

test('the scale is stable even if the page notices late that the hint is closed', { timeout: 200_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of(tower)}`, {
    before: (page) => page.addInitScript(() => {
      const Own = window.ResizeObserver;
      window.late = 0;
      window.ResizeObserver = class extends Own { constructor(act) { super((...all) => setTimeout(() => act(...all), window.late)); } };
    }),
  });
  assert.ok(await page.locator('#hint').isVisible());
  await fitted_picture(page);
  const first = await rows(page);
  await page.evaluate(() => { window.late = 800; });
  await until_shown(page, () => page.click('#step-fresh'));
  await until_shown(page, () => page.click('#step-finish'));
  assert.ok(await page.locator('#hint').isHidden());
  await page.waitForTimeout(1000);
  assert.ok(Math.abs((await rows(page)).height - first.height) < 3, `${(await rows(page)).height} of ${first.height}`);
});

test('leaf cards are cut out by their texture in every shading mode', { timeout: 200_000 }, async () => {
  const request = (await server.get('/v1/presets/oak')).json;
  for (const word of ['title', 'description', 'tags']) delete request[word];
  const page = await open(browser, `${server.url}/?stage&quality=low${fragment_of(request)}`, { viewport: { width: 480, height: 360 } });
  for (let step = 0; step < 9; step += 1) await page.locator('#picture').press('+');
  await page.waitForTimeout(300);
  const seen = [];
  for (const mode of ['shaded', 'normals', 'uv']) {
    await set(page, 'shading', mode);
    seen.push(await page.screenshot({ omitBackground: true }));
  }
  const [own, normals, squares] = seen.map(outline);
  assert.ok(own.some((is) => is === 0) && own.some((is) => is === 1));
  for (const [mode, other] of [['normals', normals], ['uv', squares]]) assert.ok(overlap(own, other) > 0.98, `${mode}: ${overlap(own, other)}`);
  assert.ok(difference(seen[0], seen[1]) > 0.1 && difference(seen[1], seen[2]) > 0.1, 'the modes differ');
  assert.deepEqual(page.errors, []);
});

test('motions are also offered in a menu that was opened before they were known', { timeout: 300_000 }, async () => {
  let release;
  const known = new Promise((resolve) => { release = resolve; });
  const page = await open(browser, `${server.url}/?quality=low${fragment_of(small_tree)}`, {
    before: (page) => page.route('**/v1/schemas/output', async (route) => { await known; await route.continue(); }),
  });
  await open_menu(page);
  const motions = () => page.waitForFunction(() => document.querySelectorAll('#motion-kind option').length > 1);
  assert.ok(await page.locator('#motion-kind option').count() < 2);
  release();
  await motions();
  await page.evaluate((fragment) => { location.hash = fragment; }, fragment_of({ ...small_tree, seed: 4 }));
  await page.waitForFunction(() => document.getElementById('seed').value === '4');
  await motions();
  assert.deepEqual(page.errors, []);
});

test('growth starts when it is selected, also after wind; with reduced motion it starts on demand', { timeout: 300_000 }, async () => {
  const both = { ...small_tree, parameters: { ...small_tree.parameters, productions: ['F -> F[+F]'] } };
  const offered = (page) => page.waitForFunction(() => document.querySelectorAll('#motion-kind option').length > 1);
  const page = await open(browser, `${server.url}/?quality=low${fragment_of(both)}`, { reducedMotion: 'no-preference' });
  await page.click('#view-menu > summary');
  await offered(page);
  const at = () => page.locator('#motion-time').evaluate((slider) => Number(slider.value));
  const growing = async () => {
    await until_shown(page, () => page.selectOption('#motion-kind', 'growth'));
    assert.equal(await page.textContent('#motion-play'), 'Stop');
    const from = await at();
    assert.ok(from < 700, `it is at ${from} of 1000`);
    await page.waitForFunction((from) => Number(document.getElementById('motion-time').value) > from, from);
    await page.waitForFunction(() => document.getElementById('motion-play').textContent === 'Play');
    assert.equal(await at(), 1000);
  };
  await growing();
  const wind = page.locator('#motion-kind option', { hasText: 'Wind' });
  if (await wind.count() > 0) {
    await until_shown(page, () => page.selectOption('#motion-kind', { label: 'Wind' }));
    await page.waitForFunction(() => document.getElementById('motion-play').textContent === 'Stop');
    await growing();
  }
  const still = await open(browser, `${server.url}/?quality=low${fragment_of(both)}`, { reducedMotion: 'reduce' });
  await still.click('#view-menu > summary');
  await offered(still);
  await until_shown(still, () => still.selectOption('#motion-kind', 'growth'));
  assert.equal(await still.textContent('#motion-play'), 'Play');
  assert.equal(await still.locator('#motion-time').inputValue(), '1000');
});

test('the triangle count is that of the drawn level, and another seed keeps the level', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of({ ...small_tree, parameters: { ...small_tree.parameters, productions: ['F -> F[+F] : 0.5', 'F -> F[-F] : 0.5'], sides: 12, iterations: 2 } })}`);
  const made = (await statistics(page)).triangles;
  await choose(page, '#detail', 'ask');
  await page.waitForFunction(() => document.getElementById('detail').value === 'auto');
  assert.equal((await statistics(page)).triangles, made, 'the finest is all');
  const count = async () => /· ([\d,]+) triangles/.exec(await page.locator('#detail option[value="1"]').textContent())[1];
  await choose(page, '#detail', '1');
  await page.waitForFunction((text) => document.getElementById('triangles').textContent === text, `${await count()} of ${made}`);
  const asked = [];
  page.on('request', (request) => { if (request.url().endsWith('/v1/generate')) asked.push(JSON.parse(request.postData())); });
  await until_shown(page, () => page.fill('#seed', '8'));
  await page.waitForFunction(() => !document.getElementById('detail').disabled && / of /.test(document.getElementById('triangles').textContent));
  assert.equal(await page.inputValue('#detail'), '1');
  assert.deepEqual(asked.filter((each) => each.output.format === 'zip').map((each) => each.seed), [8]);
  assert.equal((await statistics(page)).triangles.split(' of ')[0], await count());
  await until_shown(page, () => page.click('[data-preset="koch_snowflake"]'));
  assert.equal(await page.inputValue('#detail'), '');
  assert.doesNotMatch((await statistics(page)).triangles, / of /);
});

test('flight shows only the position, another preset is framed, and Fit returns to orbit', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  await go_by(page, 'fly');
  assert.match(await page.textContent('#whereabouts'), /^x -?[\d.]+, y -?[\d.]+, z -?[\d.]+ m · \d+°$|^$/);
  await page.focus('#picture');
  await page.keyboard.down('s');
  await page.waitForTimeout(300);
  await page.keyboard.up('s');
  assert.match(await page.textContent('#whereabouts'), /^x -?[\d.]+, y -?[\d.]+, z -?[\d.]+ m · \d+°$/);
  await until_shown(page, () => page.click('[data-preset="menger_sponge"]'));
  const model = await rows(page);
  assert.equal(await page.inputValue('#gait'), 'fly');
  await page.click('#fit');
  assert.equal(await page.inputValue('#gait'), 'orbit');
  assert.ok(await page.isHidden('#whereabouts'));
  const fitted = await rows(page);
  // Fitting leaves space for the step bar that has appeared since.
  assert.ok(Math.abs(model.height - fitted.height) < fitted.height * 0.3, `${model.height} rows in flight, ${fitted.height} fitted`);
  await go_by(page, 'walk');
  await page.focus('#picture');
  await page.keyboard.press('f');
  assert.equal(await page.inputValue('#gait'), 'orbit');
  assert.ok(Math.abs((await rows(page)).height - fitted.height) < 6);
});

test('touch buttons walk and fly', { timeout: 200_000 }, async () => {
  const page = await open(browser, address, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  await page.evaluate(() => document.getElementById('hint-away').click());
  assert.ok(await page.isHidden('#pad'));
  await go_by(page, 'walk');
  const place = async () => (await page.textContent('#whereabouts')).match(/-?[\d.]+/g).map(Number);
  const hold = async (name) => {
    const from = await place();
    const { top, bottom, left, right } = await rect(page, `#pad [aria-label="${name}"]`);
    await page.mouse.move((left + right) / 2, (top + bottom) / 2);
    await page.mouse.down();
    await page.waitForTimeout(400);
    await page.mouse.up();
    return (await place()).map((value, index) => value - from[index]);
  };
  const ahead = await hold('Go ahead');
  assert.ok(Math.hypot(ahead[0], ahead[2]) > 0.05, String(ahead));
  const there = await place();
  await page.waitForTimeout(300);
  assert.deepEqual(await place(), there, 'it stands when the finger is lifted');
  assert.equal(await page.locator('#pad button').count(), 4);
  await go_by(page, 'fly');
  assert.ok((await hold('Rise'))[1] > 0.02);
  const { right } = await rect(page, '#pad');
  assert.ok(right <= 390);
  await page.click('#fit');
  assert.ok(await page.isHidden('#pad'));
  assert.deepEqual(page.errors, []);
});

test('the seed of the left side is readable and does not overlap the slider', { timeout: 200_000 }, async () => {
  for (const width of [390, 900]) {
    const page = await open(browser, `${server.url}/${fragment_of({ ...small_tree, seed: 4294967295 })}`, { viewport: { width, height: 844 } });
    await page.evaluate(() => { document.getElementById('hint-away').click(); document.getElementById('compare').click(); });
    const seed = page.locator('#divider-box label b');
    assert.equal(await seed.textContent(), 'Left: seed 4294967295');
    const words = await rect(page, '#divider-box label b'), label = await rect(page, '#divider-box label'), slider = await rect(page, '#divider');
    assert.ok(words.right <= label.right + 0.5 && slider.left - label.right >= 6, JSON.stringify({ words, label, slider }));
    assert.ok((await rect(page, '#divider-box')).right <= width);
  }
});

test('a cached model is reported as such', { timeout: 200_000 }, async () => {
  const request = { ...small_tree, seed: 918273 };
  const page = await open(browser, `${server.url}/${fragment_of(request)}`);
  assert.equal(await page.textContent('#made'), 'Made in');
  assert.match(await page.textContent('#milliseconds'), /^[\d.,]+ ms$/);
  await page.reload();
  await page.waitForFunction(() => document.body.dataset.state === 'ready');
  assert.equal(`${await page.textContent('#made')} ${await page.textContent('#milliseconds')}`, 'Taken from memory');
});

test('shape edges are visible on any background', { timeout: 200_000 }, async () => {
  for (const [colorScheme, wall] of [['light', '#f4f4f4'], ['dark', '#151515'], ['light', '#d55e00']]) {
    const rules = tower.parameters.rules.replace('#aa8866', wall);
    const page = await open(browser, `${server.url}/${fragment_of({ ...tower, parameters: { ...tower.parameters, rules } })}`, { colorScheme });
    const before = await picture(page);
    await set(page, 'edges', true);
    const changed = difference(before, await picture(page), 0.3);
    assert.ok(changed > 0.001, `${wall}: ${changed}`);
  }
});

test('a click selects a shape, a drag only rotates the view', { timeout: 200_000 }, async () => {
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const shapes = [
    { id: 0, parent: null, symbol: 'Lot', active: false, scope: { origin: [-5, 0, -5], axes, size: [10, 0, 10] } },
    { id: 1, parent: 0, symbol: 'Wall', active: true, scope: { origin: [-5, -5, -5], axes, size: [10, 20, 10] } },
  ];
  const page = await open(browser, address, { before: (page) => page.route('**/v1/derive', (route) => route.fulfill({ json: { shapes, warnings: [] } })) });
  await page.click('#hint-away');
  await page.click('#tab-result');
  await page.waitForSelector('#show-shapes');
  await page.check('#show-shapes');
  const { left, top } = await rect(page, '#picture');
  const drag = async (by) => {
    await page.mouse.move(left + 200, top + 200);
    await page.mouse.down();
    await page.mouse.move(left + 200 + by, top + 200 + by / 4, { steps: 5 });
    await page.mouse.up();
    await page.waitForTimeout(300);
  };
  await drag(70);
  assert.equal(await page.locator('.picked h4').count(), 0, 'a drag picks nothing');
  await page.waitForTimeout(600);
  const before = await picture(page);
  await drag(2);
  assert.equal(await page.textContent('.picked h4'), 'Wall');
  assert.ok(difference(before, await picture(page)) > 0.02, 'it is marked');
});

test('the first click selects the line of a rule and scrolls to its start', { timeout: 200_000 }, async () => {
  const tail = ` color("#aa8866") ${'t("0 0 0") '.repeat(30)}`;
  const rules = `${Array.from({ length: 30 }, (_, index) => `Idle${index} --> color("#ffffff") Idle.`).join('\n')}\nLot --> extrude(6)${tail}Mass\nMass --> color("#ff0000")${tail}Face.`;
  const page = await open(browser, `${server.url}/${fragment_of({ generator: 'building', seed: 1, parameters: { rules: rules.replaceAll(/t\("0 0 0"\)/g, 't(0, 0, 0)'), start: 'Lot', size: [8, 0, 6] } })}`);
  await page.click('#hint-away');
  await page.click('#tab-result');
  await page.waitForSelector('#show-shapes');
  await page.check('#show-shapes');
  await page.selectOption('#shape-kind', '=Mass');
  await page.locator('#picture').click({ position: { x: 180, y: 190 } });
  await page.waitForSelector('.picked h4');
  for (const turn of ['first', 'second']) {
    await page.click('#tab-result');
    await page.getByRole('button', { name: '32', exact: true }).click();
    await page.waitForFunction(() => {
      const root = [...document.querySelectorAll('.code-editor')].find((each) => /Idle/.test(each.shadowRoot.textContent))?.shadowRoot;
      return root?.getSelection().toString().startsWith('Mass --> color');
    }, null, { timeout: 20_000 });
    const seen = await page.evaluate(() => {
      const root = [...document.querySelectorAll('.code-editor')].find((each) => /Idle/.test(each.shadowRoot.textContent)).shadowRoot;
      const range = root.getSelection().getRangeAt(0);
      const start = range.getClientRects()[0], frame = root.querySelector('.cm-scroller').getBoundingClientRect(), page = document.getElementById('parameters').getBoundingClientRect();
      return { left: start.left, top: start.top, bottom: start.bottom, frame: frame.left, from: page.top, to: page.bottom };
    });
    assert.ok(seen.left >= seen.frame && seen.top >= seen.from && seen.bottom <= seen.to, `${turn}: ${JSON.stringify(seen)}`);
  }
});
