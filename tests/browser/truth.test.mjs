// Consistency: titles, figures, seeds and questions belong to the model in the view.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { choose, code, difference, drop, field, fragment_of, from_menu, go_by, launch, open, open_parameters, picture, program, request_of, serve, small_tree, statistics, until_shown, until_state, write } from './support.mjs';

let server, browser, address;
before(async () => {
  server = await serve(program);
  browser = await launch();
  address = `${server.url}/${fragment_of(small_tree)}`;
});
after(async () => { await browser?.close(); await server?.stop(); });

const title = (page) => page.textContent('#title');
const alert_says = (page, words) => page.waitForFunction((words) => document.getElementById('alert').textContent.includes(words), words);
const status_says = (page, words) => page.waitForFunction((words) => document.getElementById('status').textContent.includes(words), words);

async function write_json(page, text) {
  await page.click('#tab-request');
  await code(page.locator('#request')).waitFor();
  await write(page.locator('#request'), text);
}

/** Delays the responses of a route until they are released. */
async function hold(page, route, applies = () => true) {
  let let_go, came;
  const gate = new Promise((resolve) => { let_go = resolve; });
  const asked = new Promise((resolve) => { came = resolve; });
  await page.route(route, async (each) => {
    if (!applies(each.request())) return each.fallback();
    came();
    await gate;
    return each.continue().catch(() => {});
  });
  return { asked, let_go };
}

test('a comparison that is switched off at once leaves nothing behind', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  // The second click precedes the end of the first model load.
  await page.evaluate(() => { const button = document.getElementById('compare'); button.click(); button.click(); });
  assert.equal(await page.getAttribute('#compare', 'aria-pressed'), 'false');
  await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of({ ...small_tree, parameters: { ...small_tree.parameters, angle: 70 } })));
  const divide = (share) => page.locator('#divider').evaluate((slider, share) => { slider.value = share; slider.dispatchEvent(new Event('input')); }, share);
  await divide(0);
  const right = await picture(page);
  await divide(100);
  assert.equal(difference(right, await picture(page)), 0);
});

test('a 64-bit seed is exact from JSON, files and links, and an invalid seed is marked', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  const sent = [];
  page.on('request', (request) => { if (request.url().endsWith('/v1/generate')) sent.push(JSON.parse(request.postData()).seed); });
  const text = (seed) => JSON.stringify({ ...small_tree, seed: 'SEED' }).replace('"SEED"', seed);
  await until_shown(page, () => write_json(page, text('12345678901234567890')));
  assert.equal(await page.inputValue('#seed'), '12345678901234567890');
  assert.match((await code(page.locator('#request')).locator('.cm-line').allTextContents()).join('\n'), /"seed":\s*12345678901234567890,/, 'the text stays as it was written');
  await until_shown(page, () => drop(page, 'big.json', text('18446744073709551615')));
  assert.equal(await page.inputValue('#seed'), '18446744073709551615');
  await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of(text('9007199254740993'), true)));
  assert.equal(await page.inputValue('#seed'), '9007199254740993');
  assert.deepEqual([...new Set(sent)], ['12345678901234567890', '18446744073709551615', '9007199254740993']);
  await page.evaluate((hash) => { location.hash = hash; }, fragment_of({ ...small_tree, seed: 'hello' }));
  await until_state(page, 'refused');
  assert.deepEqual([await page.inputValue('#seed'), await page.getAttribute('#seed', 'aria-invalid')], ['hello', 'true']);
  assert.deepEqual(page.errors, []);
});

test('downloads have the name of their request, distinguish formats, and arrive once', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/`);
  await until_shown(page, () => page.click('[data-preset="menger_sponge"]'));
  await page.waitForSelector('#parameters .form', { state: 'attached' });
  assert.equal(await page.locator('[data-format=ply], [data-format=png16]').count(), 0, 'a sponge that is no cloud of points has no file of points');
  let fetched = 0;
  const { asked, let_go } = await hold(page, '**/v1/generate', (request) => request.postData().includes('"gltf"') && (fetched += 1) > 0);
  await page.click('#download-menu > summary');
  const gltf = page.locator('[data-format=gltf]');
  await gltf.click();
  await asked;
  assert.equal(await gltf.getAttribute('aria-busy'), 'true');
  await gltf.evaluate((button) => button.click());
  await status_says(page, 'menger_sponge-0.gltf is being fetched');
  await until_shown(page, () => page.click('[data-preset="kogovsek_grm"]'));
  const [download] = await Promise.all([page.waitForEvent('download'), let_go()]);
  assert.equal(download.suggestedFilename(), 'menger_sponge-0.gltf');
  await status_says(page, 'menger_sponge-0.gltf is downloaded');
  assert.equal(fetched, 1);
  assert.equal(await page.getAttribute('[data-format=gltf]', 'aria-busy'), 'false');

  await page.route('**/v1/generate', (route) => (route.request().postData().includes('"zip"') ? route.fulfill({ status: 422, json: { detail: 'found no room' } }) : route.fallback()));
  await from_menu(page, 'download-menu', '[data-format=zip]');
  await alert_says(page, 'Found no room');
  const [other] = await Promise.all([page.waitForEvent('download'), page.click('#download')]);
  assert.match(other.suggestedFilename(), /^kogovsek_grm-\d+\.glb$/);
  assert.equal(await page.textContent('#alert'), '', 'what failed before is no news any more');

  await until_shown(page, () => page.click('[data-preset="island"]'));
  await page.waitForSelector('[data-format=png16]', { state: 'attached' });
  const tips = await page.locator('#downloads [data-format]').evaluateAll((all) => all.map((each) => each.title));
  assert.equal(new Set(tips).size, tips.length, tips.join());
  const [map] = await Promise.all([page.waitForEvent('download'), from_menu(page, 'download-menu', '[data-format=png16]')]);
  assert.match(map.suggestedFilename(), /^island-\d+-png16\.png$/);
  await until_shown(page, () => page.click('[data-preset="small_planet"]'));
  await page.waitForFunction(() => document.querySelectorAll('[data-format=png16]').length === 0);
  assert.deepEqual(page.errors, []);
});

test('points and lines are counted, an empty model has no size, and warnings lead to their field', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of({ ...small_tree, parameters: { axiom: 'X' } })}`);
  assert.equal(await page.textContent('#measures').then((text) => text.split(' · ')[0]), 'Nothing to show');
  assert.doesNotMatch(await page.getAttribute('#picture', 'aria-label'), / m wide/);
  const warned = Number(await page.textContent('#warnings'));
  assert.ok(warned > 0);
  await page.waitForSelector('#parameters .form', { state: 'attached' });
  await page.click('#warnings');
  const mild = page.locator('.issue.mild:visible, .spot.mild:visible');
  await mild.first().waitFor();
  assert.ok((await mild.first().textContent()).length > 10);
  const lines = { ...small_tree, parameters: { ...small_tree.parameters, style: 'lines' } };
  await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of(lines)));
  assert.equal(await page.textContent('#pieces'), 'Lines');
  assert.ok(Number((await statistics(page)).triangles) > 4);
  assert.match(await page.textContent('#measures'), / × 0 m/, 'a drawing has no depth');
  assert.match(await page.getAttribute('#picture', 'aria-label'), /: \d+ lines, /);
  assert.ok(await page.isHidden('#warnings-box'));
});

test('an unrelated request in the JSON is a new model with its own title, link and form', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/`);
  await until_shown(page, () => page.click('[data-preset="koch_snowflake"]'));
  const snowflake = await title(page);
  const { title: _, description: __, tags: ___, ...request } = (await server.get('/v1/presets/koch_snowflake')).json;
  await until_shown(page, () => write_json(page, JSON.stringify({ ...request, seed: 5 })));
  assert.equal(await title(page), snowflake, 'what is changed keeps its name');
  await until_shown(page, () => write_json(page, '{"generator": "fractal", "seed": 3, "parameters": {"iterations": 2}}'));
  assert.match(await title(page), /from JSON$/);
  assert.equal(await page.locator('[data-preset][aria-pressed=true]').count(), 0);
  await page.waitForFunction(() => location.hash.length > 20 && !location.hash.includes('.'));
  await until_shown(page, () => write_json(page, '{"preset": "koch_island", "seed": 6}'));
  assert.equal(await page.getAttribute('[data-preset="koch_island"]', 'aria-pressed'), 'true');
  assert.match(new URL(page.url()).hash, /\.koch_island$/);
  await until_shown(page, () => write_json(page, '{"generator": "lsystem", "parameters": {"axiom": "FF"}}'));
  assert.equal(await title(page), 'L-system from JSON', 'nothing of the island is left');
  await until_shown(page, () => page.click('#undo'));
  assert.equal(await page.getAttribute('[data-preset="koch_island"]', 'aria-pressed'), 'true');
  await page.click('#undo');
  await page.waitForFunction(() => document.getElementById('title').textContent.endsWith('from JSON'));
  assert.deepEqual(page.errors, []);
});

test('unreadable, empty, multiple and unknown files are reported', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  const noise = [];
  page.on('console', (message) => { if (message.type() === 'error') noise.push(message.text()); });
  // Browsers reject with this error when a folder is read as a file.
  await page.evaluate(() => { File.prototype.text = function () { return this.name === 'folder' ? Promise.reject(new DOMException('gone', 'NotFoundError')) : Blob.prototype.text.call(this); }; });
  await drop(page, 'folder', 'x');
  await alert_says(page, 'folder cannot be read. Folders cannot be opened');
  await drop(page, 'nothing.json', ' \n');
  await alert_says(page, 'nothing.json is empty.');
  await drop(page, 'p.json', '{"preset": "no_such_preset"}');
  await alert_says(page, 'p.json: There is no preset');
  assert.ok(await page.locator('#import-dialog').evaluate((dialog) => !dialog.open));
  assert.ok(noise.length <= 1, noise.join('\n'));
  await until_shown(page, () => drop(page, ['one.json', 'two.json'], JSON.stringify({ ...small_tree, seed: 21 })));
  await status_says(page, 'one.json is opened. It is one of 2 files');

  // After a refusal, the previous model must not appear as the new one, and the form must not write into the
  // new request.
  await open_parameters(page);
  await drop(page, 'strange.json', '{"generator": "nope", "parameters": {}}');
  await until_state(page, 'refused');
  await alert_says(page, 'There is no generator "nope"');
  assert.equal(await title(page), 'strange');
  assert.equal(await page.textContent('#measures'), 'The view still shows one');
  assert.ok(await page.isHidden('#statistics'));
  assert.match(await page.getAttribute('#picture', 'aria-label'), /^one, seed 21/);
  assert.match(await page.textContent('#parameters'), /no generator “nope”/);
  assert.equal(await page.locator('#parameters .form').count(), 0);
  await until_shown(page, () => page.click('#undo'));
  assert.match(await page.textContent('#measures'), / × /);
  assert.ok(await page.isVisible('#statistics'));
  await page.waitForSelector('#parameters .form');
  const linked = await open(browser, `${server.url}/${fragment_of({ generator: 'nope', parameters: {} })}`, { states: ['refused'] });
  assert.equal(await title(linked), 'Unknown generator');
  await alert_says(linked, 'There is no generator "nope"');
  assert.deepEqual([...page.errors, ...linked.errors], []);
});

test('cancel also stops an opening that was started while another model was loading', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/`);
  const shown = await title(page);
  const card = await page.getAttribute('[data-preset][aria-pressed=true]', 'data-preset');
  let is_gone = true, asked_again = 0;
  await page.route('**/v1/generate', (route) => (is_gone ? route.abort() : route.continue()));
  await page.route('**/v1/presets/koch_island', (route) => { asked_again += is_gone ? 0 : 1; return is_gone ? route.abort() : route.continue(); });
  await page.click('#dice');
  await until_state(page, 'gone');
  await page.click('[data-preset="koch_island"]');
  await page.click('#cancel');
  await until_state(page, 'stopped');
  assert.equal(await page.getAttribute('[data-preset][aria-pressed=true]', 'data-preset'), card);
  is_gone = false;
  await until_shown(page, () => page.click('#again'));
  assert.equal(await title(page), shown);
  assert.equal(asked_again, 0);
});

test('a huge model needs confirmation before the download, and declining changes nothing', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  const before = await statistics(page);
  const label = await page.getAttribute('#picture', 'aria-label');
  let fetched = 0;
  const huge = (request) => JSON.parse(request.postData()).seed === 4;
  await page.route('**/v1/validate', (route) => (huge(route.request()) ? route.fulfill({ json: { valid: true, warnings: [], estimate: { triangles: 13_062_144, bytes: 4e8, exact: true } } }) : route.continue()));
  const { let_go } = await hold(page, '**/v1/generate', (request) => huge(request) && (fetched += 1) === 1);
  await page.fill('#seed', '4');
  await until_state(page, 'asking');
  assert.match(await page.textContent('#alert'), /13,062,144 triangles/);
  await page.getByRole('button', { name: 'Leave it' }).click();
  await until_state(page, 'stopped');
  let_go();
  assert.equal(fetched, 1);
  assert.deepEqual(await statistics(page), before);
  assert.equal(await page.getAttribute('#picture', 'aria-label'), label);
  await page.click('#again');
  await until_state(page, 'asking');
  await until_shown(page, () => page.getByRole('button', { name: 'Draw it' }).click());
  assert.match(await page.getAttribute('#picture', 'aria-label'), /seed 4/);
});

test('levels of detail belong to the model that grows', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  await open_parameters(page);
  await field(page, '/parameters/age').getByRole('button', { name: /^Grow/ }).click();
  await page.waitForFunction(() => document.getElementById('growth-play').textContent === 'Play' && document.body.dataset.state === 'ready');
  await until_shown(page, () => page.locator('#growth-value').fill('12'));
  const made = (await statistics(page)).triangles;
  const zips = [];
  page.on('request', (request) => { if (/"zip"/.test(request.postData() ?? '')) zips.push(JSON.parse(request.postData())); });
  await choose(page, '#detail', 'ask');
  await page.waitForFunction(() => document.querySelectorAll('#detail option').length > 3);
  const young = request_of(new URL(page.url()).hash).parameters.age;
  assert.ok(zips.length > 0 && zips.every((zip) => zip.parameters.age > 0 && zip.parameters.age !== young));
  await choose(page, '#detail', '0');
  await page.waitForFunction((made) => document.getElementById('triangles').textContent === made, made);
});

test('walking begins on the terrain, stays on it, and stops at its end', { timeout: 300_000 }, async () => {
  const land = { generator: 'terrain', seed: 3, parameters: { algorithm: 'fbm', resolution: 33, size: 400, amplitude: 60, base: 30 }, output: { textures: 'none' } };
  const page = await open(browser, `${server.url}/${fragment_of(land)}`);
  const place = async () => (await page.textContent('#whereabouts')).match(/-?[\d.]+/g).map(Number);
  await go_by(page, 'walk');
  await page.focus('#picture');
  const begin = await place();
  assert.ok(Math.abs(begin[0]) < 200 && Math.abs(begin[2]) < 200, `begins on the land: ${begin}`);
  const heights = [];
  await page.exposeFunction('seen', (text) => heights.push(Number(/y (-?[\d.]+)/.exec(text)[1])));
  await page.evaluate(() => new MutationObserver(() => window.seen(document.getElementById('whereabouts').textContent)).observe(document.getElementById('whereabouts'), { childList: true, characterData: true, subtree: true }));
  // Walking backwards ends at the edge of the terrain.
  await page.keyboard.down('Shift');
  await page.keyboard.down('s');
  await page.waitForFunction(() => { const [x, , z] = document.getElementById('whereabouts').textContent.match(/-?[\d.]+/g).map(Number); return Math.max(Math.abs(x), Math.abs(z)) > 185; });
  await page.evaluate(() => new Promise((resolve) => { let left = 12; const next = () => ((left -= 1) > 0 ? requestAnimationFrame(next) : resolve()); next(); }));
  await page.keyboard.up('s');
  await page.keyboard.up('Shift');
  const end = await place();
  assert.ok(Math.abs(end[0]) <= 200.1 && Math.abs(end[2]) <= 200.1, `stays on the land: ${end}`);
  assert.ok(heights.length > 2 && new Set(heights).size > 2, 'the way goes up and down');
});
