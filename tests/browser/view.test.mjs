// View options: shading, light, levels, materials, motion, camera; steps; intermediate results.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { choose, difference, fragment_of, go_by, launch, leafy, open, open_menu, outline, overlap, picture, program, serve, small_tree, statistics, until_shown } from './support.mjs';

let server, browser, address;
before(async () => {
  server = await serve(program);
  browser = await launch();
  address = `${server.url}/${fragment_of(small_tree)}`;
});
after(async () => { await browser?.close(); await server?.stop(); });

const number = (text) => Number(text.replaceAll(/[^\d]/g, ''));
const switch_to = async (page, id, on) => {
  await open_menu(page);
  await page.setChecked(id, on);
  await page.keyboard.press('Escape');
};

/** Waits until at least this share of the view has changed. */
async function changes(page, words, act, least = 0.0005) {
  const earlier = await picture(page);
  await act();
  let share = 0;
  for (let tries = 0; tries < 20 && share < least; tries += 1) share = difference(earlier, await picture(page), 0.04);
  assert.ok(share >= least, `${words}: ${share}`);
  return earlier;
}

test('a model is shown shaded, flat, with normals and with a checkerboard', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of({ generator: 'terrain', seed: 1, parameters: { algorithm: 'diamond_square', iterations: 3, size: 20, amplitude: 4 } })}`, { states: ['ready', 'refused'] });
  const first = await picture(page);
  for (const mode of ['flat', 'normals', 'uv']) await changes(page, mode, () => choose(page, '#shading', mode));
  await choose(page, '#shading', 'shaded');
  let left = 1;
  for (let tries = 0; tries < 20 && left > 0.002; tries += 1) left = difference(first, await picture(page));
  assert.ok(left <= 0.002, `${left} differs from the first picture`);
  await page.focus('#picture');
  await changes(page, 'N', () => page.keyboard.press('n'));
  await changes(page, 'wires over it', () => page.keyboard.press('w'));
  assert.deepEqual(page.errors, []);
});

test('sky, shadow, and a light that can be moved and switched off', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  await changes(page, 'sky', () => switch_to(page, '#sky', true), 0.1);
  await switch_to(page, '#sky', false);
  await changes(page, 'shadow', () => switch_to(page, '#shadow', true), 0.0003);
  await open_menu(page);
  await changes(page, 'from another side', () => page.getByLabel('Light from').fill('200'));
  await changes(page, 'from above', () => page.getByLabel('Height of light').fill('88'));
  await changes(page, 'off', () => switch_to(page, '#light-on', false));
  assert.deepEqual(page.errors, []);
});

test('levels of detail are fetched, counted, selected, and change with the distance', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of({ ...small_tree, parameters: { ...small_tree.parameters, sides: 12, iterations: 2 } })}`);
  const made = number((await statistics(page)).triangles);
  await choose(page, '#detail', 'ask');
  await page.waitForFunction(() => document.querySelectorAll('#detail option').length > 3);
  const labels = await page.locator('#detail option').allTextContents();
  assert.equal(await page.inputValue('#detail'), 'auto');
  const counts = labels.filter((label) => /triangles$/.test(label)).map((label) => number(label.split('·')[1]));
  assert.equal(counts[0], made);
  assert.ok(counts.length >= 2 && counts.at(-1) < counts[0], labels.join('; '));
  await choose(page, '#detail', '0');
  await changes(page, 'the coarsest level', () => choose(page, '#detail', String(counts.length - 1)), 0.0001);
  await choose(page, '#detail', '');
  assert.equal(number((await page.locator('#detail option').first().textContent()).split('·')[1]), made);
  assert.deepEqual(page.errors, []);
});

test('levels fade by dithering when they change with the distance, and the frame time is shown', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of({ ...small_tree, parameters: { ...small_tree.parameters, sides: 12, iterations: 2 } })}`, { reducedMotion: 'no-preference' });
  await choose(page, '#detail', 'ask');
  await page.waitForFunction(() => document.querySelector('#detail').value === 'auto');
  const level = () => page.evaluate(() => Number(/level (\d)$/.exec(document.getElementById('drawn').textContent)?.[1] ?? -1));
  assert.match(await page.textContent('#drawn'), /^[\d.]+ ms(, frame [\d.]+ ms, [\d.]+ a second)?, level 0$/);
  // Every shader program used during a fade contains the dithering.
  await page.evaluate(() => {
    window.fades = [];
    const { uniform2fv, uniform2f } = WebGL2RenderingContext.prototype;
    WebGL2RenderingContext.prototype.uniform2f = function (place, x, y) { window.fades.push([x, y]); return uniform2f.call(this, place, x, y); };
    WebGL2RenderingContext.prototype.uniform2fv = function (place, value) { window.fades.push([...value]); return uniform2fv.call(this, place, value); };
  });
  await page.focus('#picture');
  for (let step = 0; step < 9; step += 1) await page.keyboard.press('-');
  await page.waitForFunction(() => / level 1$/.test(document.getElementById('drawn').textContent));
  await page.waitForFunction(() => window.fades.some(([from, to]) => from === 0 && to > 0 && to < 1) && window.fades.some(([from, to]) => from > 0 && from < 1 && to === 2));
  assert.match(await page.textContent('#drawn'), /frame [\d.]+ ms/);
  for (let step = 0; step < 9; step += 1) await page.keyboard.press('+');
  await page.waitForFunction(() => / level 0$/.test(document.getElementById('drawn').textContent));
  assert.equal(await level(), 0);
  // The fade ends.
  await page.waitForFunction(() => new Promise((resolve) => {
    const text = document.getElementById('drawn').textContent;
    setTimeout(() => resolve(text === document.getElementById('drawn').textContent), 700);
  }));
  assert.deepEqual(page.errors, []);
});

test('with reduced motion, levels change without a fade and wind is optional', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of(leafy)}`, { reducedMotion: 'reduce' });
  await page.click('#view-menu > summary');
  await page.waitForFunction(() => [...document.querySelectorAll('#motion-kind option')].some((option) => option.textContent === 'Wind'));
  await until_shown(page, () => page.selectOption('#motion-kind', { label: 'Wind' }));
  await page.keyboard.press('Escape');
  assert.equal(await page.textContent('#motion-play'), 'Play');
  await page.click('#motion-play');
  await page.waitForFunction((first) => document.getElementById('motion-now').textContent !== first, await page.textContent('#motion-now'));
  await page.click('#motion-play');
  assert.equal(await page.textContent('#motion-play'), 'Play');
});

test('a tree sways by the wind weights of its file, as do its wireframe and normals', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/?quality=low${fragment_of(leafy)}`, { reducedMotion: 'no-preference' });
  const asked = [];
  page.on('request', (request) => { if (request.url().endsWith('/v1/generate')) asked.push(JSON.parse(request.postData()).output); });
  await page.click('#view-menu > summary');
  await page.waitForFunction(() => [...document.querySelectorAll('#motion-kind option')].some((option) => option.textContent === 'Wind'));
  await until_shown(page, () => page.selectOption('#motion-kind', { label: 'Wind' }));
  await page.keyboard.press('Escape');
  assert.equal(asked.at(-1).wind, 'weights');
  await page.waitForFunction(() => document.getElementById('motion-play').textContent === 'Stop');
  const first = await page.textContent('#motion-now');
  await page.waitForFunction((first) => document.getElementById('motion-now').textContent !== first, first);
  await page.click('#motion-play');
  await page.click('#grid');
  await page.click('#figure');
  await page.locator('#motion-time').fill('0');
  await changes(page, 'another moment', () => page.locator('#motion-time').fill('330'), 0.002);
  await page.locator('#motion-time').fill('0');
  const start = await picture(page);
  await page.locator('#motion-time').fill('1000');
  assert.ok(difference(start, await picture(page), 0.04) < 0.002, 'the loop has no seam');
  for (const mode of ['normals', 'uv']) {
    await choose(page, '#shading', mode);
    await page.locator('#motion-time').fill('0');
    await changes(page, `another moment, ${mode}`, () => page.locator('#motion-time').fill('330'), 0.002);
  }
  await until_shown(page, () => page.fill('#seed', '5'));
  assert.equal(asked.at(-1).wind, 'weights', 'the wind stays');
  assert.ok(await page.isVisible('#motion'));
  assert.deepEqual(page.errors, []);
});

test('a season variant is shown without a request to the server', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of(leafy)}`);
  const asked = [];
  page.on('request', (request) => { if (request.url().endsWith('/v1/generate')) asked.push(request.url()); });
  await open_menu(page);
  const names = await page.locator('#material-set option').allTextContents();
  assert.deepEqual(names, ['As requested', 'spring', 'summer', 'autumn']);
  await changes(page, 'autumn', () => choose(page, '#material-set', 'autumn'), 0.001);
  assert.deepEqual(asked, []);
  await until_shown(page, () => page.fill('#seed', '3'));
  assert.equal(await page.inputValue('#material-set'), 'autumn', 'the choice stays');
  assert.deepEqual(page.errors, []);
});

test('growth can be played and paused anywhere, and is offered only by generators that have it', { timeout: 300_000 }, async () => {
  const page = await open(browser, address, { reducedMotion: 'reduce' });
  await page.click('#view-menu > summary');
  await page.waitForFunction(() => [...document.querySelectorAll('#motion-kind option')].some((option) => option.value === 'growth'));
  await until_shown(page, () => page.selectOption('#motion-kind', 'growth'));
  await page.keyboard.press('Escape');
  assert.ok(await page.isVisible('#motion'));
  const grown = await changes(page, 'the beginning', () => page.locator('#motion-time').fill('200'), 0.001);
  await page.locator('#motion-time').fill('1000');
  let left = 1;
  for (let tries = 0; tries < 20 && left > 0.003; tries += 1) left = difference(grown, await picture(page));
  assert.ok(left <= 0.003, `at its end it is the model: ${left}`);
  await page.focus('#picture');
  await page.keyboard.press(' ');
  await page.waitForFunction(() => { const at = Number(document.getElementById('motion-time').value); return at > 20 && at < 990; });
  assert.equal(await page.textContent('#motion-play'), 'Stop');
  await page.click('#motion-play');
  assert.equal(await page.textContent('#motion-play'), 'Play');
  await until_shown(page, () => page.click('[data-preset="menger_sponge"]'));
  await page.click('#view-menu > summary');
  await page.waitForTimeout(500);
  assert.ok(await page.isHidden('#motion-kind'));
  assert.ok(await page.isHidden('#motion'));
  assert.deepEqual(page.errors, []);
});

test('walking and flying show the position', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  const place = async () => (await page.textContent('#whereabouts')).match(/-?[\d.]+/g).map(Number);
  await go_by(page, 'walk');
  await page.focus('#picture');
  assert.equal((await place())[1], 1.7, 'eyes at 1.7 m');
  const hold = async (key) => {
    const from = await place();
    await page.keyboard.down(key);
    await page.waitForFunction((text) => document.getElementById('whereabouts').textContent !== text, await page.textContent('#whereabouts'));
    await page.waitForTimeout(250);
    await page.keyboard.up(key);
    return (await place()).map((value, index) => value - from[index]);
  };
  const ahead = await hold('w');
  assert.ok(Math.hypot(ahead[0], ahead[2]) > 0.05 && ahead[1] === 0, String(ahead));
  assert.equal(await page.getAttribute('#wireframe', 'aria-pressed'), 'false', 'W goes, and is no command');
  const turned = await hold('ArrowRight');
  assert.ok(turned[3] !== 0 && turned[0] === 0);
  await go_by(page, 'fly');
  await page.focus('#picture');
  assert.ok((await hold('q'))[1] > 0.05);
  assert.ok((await hold('PageDown'))[1] < 0);
  await page.keyboard.press('Escape');
  assert.ok(await page.isHidden('#whereabouts'));
  assert.equal(await page.inputValue('#gait'), 'orbit');
});

test('steps: first, forward, back, play all, and last', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  const now = () => page.textContent('#step-now');
  assert.equal(await now(), 'step 3 of 3');
  const whole = (await statistics(page)).bytes;
  await until_shown(page, () => page.click('#step-fresh'));
  assert.equal(await now(), 'step 0 of 3');
  assert.ok(await page.isDisabled('#step-back'));
  await until_shown(page, () => page.click('#step-next'));
  await until_shown(page, () => page.click('#step-next'));
  await until_shown(page, () => page.click('#step-back'));
  assert.equal(await now(), 'step 1 of 3');
  const seen = [];
  page.on('request', (request) => { if (request.url().endsWith('/v1/generate') && !/event-stream/.test(request.headers().accept)) seen.push(JSON.parse(request.postData()).parameters.iterations); });
  await page.click('#step-play');
  assert.equal(await page.textContent('#step-play'), 'Stop');
  await page.waitForFunction(() => document.getElementById('step-play').textContent === 'Play' && document.body.dataset.state === 'ready');
  assert.deepEqual(seen, [2, 3]);
  await until_shown(page, () => page.click('#step-fresh'));
  await until_shown(page, () => page.click('#step-finish'));
  assert.equal((await statistics(page)).bytes, whole);
  await page.focus('#picture');
  await until_shown(page, () => page.keyboard.press('['));
  assert.equal(await now(), 'step 2 of 3');
});

test('the camera is higher above wide and flat terrain', { timeout: 200_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of({ generator: 'terrain', seed: 1, parameters: { algorithm: 'midpoint', iterations: 3 } })}`, { states: ['ready', 'refused'], viewport: { width: 1280, height: 720 } });
  await until_shown(page, () => page.click('[data-preset="midpoint_hills"]'));
  await page.click('#grid');
  const { width, height, data } = PNG.sync.read(await picture(page));
  // Rows with pixels that differ from the pale background.
  let rows = 0;
  for (let y = 0; y < height; y += 1) {
    let ink = 0;
    for (let x = 0; x < width; x += 1) if (Math.max(data[(y * width + x) * 4], data[(y * width + x) * 4 + 1]) - data[(y * width + x) * 4 + 2] > 30) ink += 1;
    if (ink > width * 0.1) rows += 1;
  }
  assert.ok(rows > height * 0.25, `${rows} of ${height} rows`);
});

test('heights are shown as a map with its size, beside figures and words', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  await page.click('#tab-result');
  await page.waitForSelector('#result .figures');
  assert.match(await page.textContent('#result'), /Length/);
  await until_shown(page, async () => { await page.click('#tab-gallery'); await page.click('[data-preset="midpoint_hills"]'); });
  await page.click('#tab-result');
  await page.waitForSelector('.height-map');
  const { json } = await server.post('/v1/derive', (await server.get('/v1/presets/midpoint_hills')).json);
  assert.deepEqual(await page.locator('.height-map').evaluate((map) => [map.width, map.height]), [json.width, json.height]);
  await page.locator('.height-map').hover({ position: { x: 100, y: 60 } });
  await page.waitForFunction(() => /Sample \d/.test(document.querySelector('.map-of-heights output').textContent));
  const [, x, y, shown] = /Sample (\d+), (\d+): (-?[\d.]+) m/.exec(await page.textContent('.map-of-heights output')).map(Number);
  const height = json.heights[y * json.width + x];
  assert.ok(x > 10 && y > 5 && Math.abs(shown - height) <= Math.abs(height) * 0.01 + 0.01, `${shown} for ${height} at ${x}, ${y}`);
});

test('shapes are drawn as boxes over the model, and the selected one is described', { timeout: 300_000 }, async () => {
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const shapes = [
    { id: 0, parent: null, symbol: 'Lot', parameters: {}, active: false, rule: 'Lot --> Wall', line: 2, choice: 3, scope: { origin: [-1, -0.2, -0.5], axes, size: [1.2, 0, 1] } },
    { id: 1, parent: 0, symbol: 'Wall', parameters: { bays: 3 }, active: true, scope: { origin: [-1, -0.2, -0.5], axes, size: [1.2, 1, 1] } },
  ];
  const page = await open(browser, address, { before: (page) => page.route('**/v1/derive', (route) => route.fulfill({ json: { shapes, warnings: [], reports: { area: 12.5 } } })) });
  await page.click('#hint-away');
  await page.click('#tab-result');
  await page.waitForSelector('#show-shapes');
  await changes(page, 'boxes', () => page.check('#show-shapes'));
  await page.locator('#picture').click({ position: { x: 200, y: 200 } });
  await page.waitForSelector('.picked h4');
  const picked = await page.textContent('.picked');
  for (const words of ['Wall', 'Lot', 'Made byLot --> Wall (choice 3)', '1.2 × 1 × 1 m', '"bays":3']) assert.ok(picked.includes(words), `${words} in ${picked}`);
  await changes(page, 'no boxes', () => page.uncheck('#show-shapes'));
});

test('a selected part of a building leads to its rule, and shape edges differ from triangle edges', { timeout: 300_000 }, async () => {
  const rules = 'Lot --> extrude(6) Mass\n\nMass --> comp(f) { side : Wall | top : Lid. }\nWall --> color("#aa8866") Face.';
  const page = await open(browser, `${server.url}/${fragment_of({ generator: 'building', seed: 1, parameters: { rules, start: 'Lot', size: [8, 0, 6] } })}`);
  await page.click('#hint-away');
  await open_menu(page);
  await changes(page, 'edges', () => switch_to(page, '#edges', true));
  await switch_to(page, '#edges', false);
  await page.click('#tab-result');
  await page.waitForSelector('#show-shapes');
  await page.check('#show-shapes');
  await page.selectOption('#shape-kind', '=Mass');
  await page.locator('#picture').click({ position: { x: 180, y: 130 } });
  await page.waitForSelector('.picked h4');
  assert.equal(await page.textContent('.picked h4'), 'Mass');
  const picked = await page.textContent('.picked');
  for (const words of ['Made byLot --> extrude(6) Mass', 'Replaced byMass --> comp(f)', '8 × 6 × 6 m']) assert.ok(picked.includes(words), `${words} in ${picked}`);
  await page.getByRole('button', { name: '3', exact: true }).click();
  assert.ok(await page.isVisible('#parameters'));
  assert.deepEqual(page.errors, []);
});

test('repeated meshes are drawn with instancing', { timeout: 300_000 }, async () => {
  const stone = { generator: 'fractal', parameters: { iterations: 1 } };
  const field_of = (count) => ({ generator: 'scene', seed: 3, parameters: { ground: { size: 60 }, layers: [{ name: 'stone', model: stone, variants: 2, place: { method: 'scatter', count } }] } });
  const page = await open(browser, `${server.url}/?quality=low${fragment_of(field_of(300))}`);
  const calls = await page.evaluate(() => new Promise((resolve) => {
    let count = 0;
    for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced']) {
      const draw = WebGL2RenderingContext.prototype[name];
      WebGL2RenderingContext.prototype[name] = function (...args) { count += 1; return draw.apply(this, args); };
    }
    document.getElementById('fit').click();
    requestAnimationFrame(() => requestAnimationFrame(() => resolve(count)));
  }));
  assert.ok(calls > 0 && calls < 60, `${calls} calls for 300 stones`);
  await open_menu(page);
  const made = number((await page.locator('#detail option').first().textContent()).split('·')[1]);
  assert.equal(made, number((await statistics(page)).triangles));
  await changes(page, 'wires', () => page.click('#wireframe'));
  assert.deepEqual(page.errors, []);
});

test('a heavy model is drawn only after confirmation', { timeout: 200_000 }, async () => {
  const page = await open(browser, address, { before: (page) => page.route('**/v1/generate', async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, headers: { ...response.headers(), 'seedmesh-triangles': JSON.parse(route.request().postData()).seed === 4 ? '5000000' : '100' } });
  }) });
  await page.fill('#seed', '4');
  await page.waitForFunction(() => document.body.dataset.state === 'asking');
  assert.match(await page.textContent('#alert'), /5,000,000 triangles/);
  await until_shown(page, () => page.getByRole('button', { name: 'Draw it' }).click());
  assert.equal(await page.textContent('#alert'), '');
});

// Reference images in the repository. `SEEDMESH_NEW_PICTURES=1` renders them again.
const kept = path.join(import.meta.dirname, 'pictures');
for (const name of ['koch_snowflake', 'menger_sponge', 'abop_1_24f']) {
  test(`${name} matches its reference image`, { timeout: 200_000 }, async () => {
    const page = await open(browser, `${server.url}/?stage&quality=low${fragment_of((await server.get(`/v1/presets/${name}`)).json)}`, { viewport: { width: 320, height: 180 }, colorScheme: 'light' });
    const png = await page.screenshot();
    const file = path.join(kept, `${name}.png`);
    if (process.env.SEEDMESH_NEW_PICTURES) { fs.mkdirSync(kept, { recursive: true }); fs.writeFileSync(file, png); }
    const share = difference(fs.readFileSync(file), png);
    assert.ok(share < 0.02, `${share} of the picture differs`);
  });
}

for (const name of ['oak', 'orchard', 'alps']) {
  test(`${name} in compressed web glTF looks the same as in core glTF`, { timeout: 120_000 }, async () => {
    const request = (await server.get(`/v1/presets/${name}`)).json;
    for (const word of ['title', 'description', 'tags']) delete request[word];
    const pictures = [], compressed = [];
    for (const profile of ['core', 'web']) {
      const asked = { ...request, output: { ...request.output, profile } };
      const kinds = [];
      const before = async (opened) => opened.on('response', (answer) => {
        kinds.push(answer.body().then((bytes) => bytes.subarray(0, 4).equals(Buffer.from('glTF')) && bytes.includes('EXT_meshopt_compression'), () => false));
      });
      const page = await open(browser, `${server.url}/?stage&quality=low${fragment_of(asked)}`, { before, viewport: { width: 480, height: 360 } });
      pictures.push(outline(await page.screenshot({ omitBackground: true })));
      compressed.push((await Promise.all(kinds)).includes(true));
      assert.deepEqual(page.errors, []);
      await page.context().close();
    }
    assert.deepEqual(compressed, [false, true]);
    assert.ok(pictures[0].reduce((sum, each) => sum + each, 0) > 2000, 'there is a model');
    const share = overlap(pictures[0], pictures[1]);
    assert.ok(share > 0.97, `overlap ${share.toFixed(3)}`);
  });
}
