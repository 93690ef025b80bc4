// Further parts of the page: view, files, link, commands, gallery, and the size of the first load.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { validateBytes } from 'gltf-validator';
import { PNG } from 'pngjs';
import { difference, fragment_of, from_menu, launch, open, picture, program, request_of, serve, small_tree, statistics, until_shown, until_state } from './support.mjs';

let server, browser, address;
before(async () => {
  server = await serve(program);
  browser = await launch();
  address = `${server.url}/${fragment_of(small_tree)}`;
});
after(async () => { await browser?.close(); await server?.stop(); });

const with_lines = { ...small_tree, parameters: { ...small_tree.parameters, style: 'lines' } };

/** The number of colours of an image. An empty view has only few, from the shading behind the model. */
function colours(png) {
  const { data } = PNG.sync.read(png);
  const seen = new Set();
  for (let at = 0; at < data.length; at += 4) seen.add((data[at] << 16) | (data[at + 1] << 8) | data[at + 2]);
  return seen.size;
}
const differs = (a, b) => !PNG.sync.read(a).data.equals(PNG.sync.read(b).data);

test('the first load is at most 185 KB compressed, all from the same server', { timeout: 200_000 }, async () => {
  let bytes = 0;
  const hosts = new Set();
  const page = await open(browser, address, {
    before: async (page) => {
      page.on('request', (request) => { if (!request.url().startsWith('blob:')) hosts.add(new URL(request.url()).host); });
    },
  });
  const start = await server.get('/', { 'accept-encoding': 'gzip' });
  bytes += start.bytes.length;
  const html = (await server.get('/')).text;
  const files = [...html.matchAll(/(?:src|href)="\.?(\/[^"]+\.(?:js|css|svg))"/g)].map(([, file]) => file);
  assert.ok(files.some((file) => file.endsWith('.js')));
  for (const file of new Set(files)) {
    const answer = await server.get(file, { 'accept-encoding': 'gzip' });
    assert.equal(answer.status, 200, file);
    if (/assets/.test(file)) assert.match(answer.headers['cache-control'], /immutable/);
    bytes += answer.bytes.length;
  }
  assert.ok(bytes <= 185 * 1024, `${bytes} bytes`);
  assert.deepEqual([...hosts], [new URL(server.url).host]);
  assert.deepEqual(page.errors, []);
});

test('the editor is at most 112 KB compressed, and the whole client with its worlds 320 KB', async () => {
  const seen = new Map();
  /** A file with all that it names: chunks name each other by their file. */
  const fetch_all = async (file) => {
    if (seen.has(file)) return;
    const answer = await server.get(file, { 'accept-encoding': 'gzip' });
    assert.equal(answer.status, 200, file);
    seen.set(file, answer.bytes.length);
    const { text } = await server.get(file);
    for (const [, name] of text.matchAll(/["'`](?:\.?\/)?(?:assets\/)?([\w-]+-[\w-]{8}\.(?:js|css))["'`]/g)) await fetch_all(`/assets/${name}`);
  };
  await fetch_all('/');
  const sizes = [...seen];
  const editor = sizes.find(([file]) => /\/editor-/.test(file));
  assert.ok(editor && editor[1] <= 112 * 1024, String(editor));
  const all = sizes.reduce((sum, [, bytes]) => sum + bytes, 0);
  assert.ok(sizes.length >= 5 && all <= 320 * 1024, `${all} bytes in ${sizes.length} files`);
});

test('the content security policy forbids inline code and foreign origins', async () => {
  const policy = (await server.get('/')).headers['content-security-policy'];
  assert.match(policy, /default-src 'none'/);
  assert.doesNotMatch(policy, /unsafe|https?:|\*/);
});

test('triangles, bytes and milliseconds match the response', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  const answer = await server.generate({ ...small_tree, output: { format: 'glb' } });
  const shown = await statistics(page);
  assert.equal(Number(shown.triangles.replaceAll(',', '')), Number(answer.headers['seedmesh-triangles']));
  assert.equal(shown.bytes, answer.bytes.length);
  assert.match(await page.textContent('#milliseconds'), /^([\d.,]+ ms|from memory)$/);
});

test('the view rotates, fits, and shows wireframes, grid and a person', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  const first = await picture(page);
  assert.ok(colours(first) > 100, `${colours(first)} colours`);
  const changes = async (words, act) => {
    const before = await picture(page);
    await act();
    assert.ok(differs(before, await picture(page)), words);
  };
  await changes('wireframe', () => page.click('#wireframe'));
  assert.equal(await page.getAttribute('#wireframe', 'aria-pressed'), 'true');
  await changes('no wireframe', () => page.click('#wireframe'));
  await changes('grid', () => page.click('#grid'));
  assert.doesNotMatch(await page.textContent('#measures'), /grid/);
  await changes('grid back', () => page.click('#grid'));
  assert.match(await page.textContent('#measures'), /grid of [\d.]+ m/);
  await changes('no figure', () => page.click('#figure'));
  await changes('figure back', () => page.click('#figure'));
  await page.focus('#picture');
  await changes('arrow keys', () => page.keyboard.press('ArrowLeft'));
  await changes('zoom', () => page.keyboard.press('+'));
  const box = await page.locator('#picture').boundingBox();
  await changes('dragging', async () => {
    await page.mouse.move(box.x + box.width / 2, box.y + 60);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 80, box.y + 70, { steps: 4 });
    await page.mouse.up();
  });
  await page.click('#fit');
  // The view is rendered one or two frames later.
  let left = 1;
  for (let tries = 0; tries < 20 && left > 0.002; tries += 1) left = difference(first, await picture(page));
  assert.ok(left <= 0.002, `after fit ${left} of the picture differs from the first view`);
  assert.deepEqual(page.errors, []);
});

test('a model of lines is drawn', { timeout: 200_000 }, async () => {
  const empty = { ...small_tree, parameters: { axiom: 'X' } };
  const page = await open(browser, `${server.url}/?stage${fragment_of(empty)}`);
  const blank = await picture(page);
  await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of(with_lines)));
  assert.ok(differs(blank, await picture(page)));
});

test('nothing is rendered while nothing changes', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  const frames = () => page.evaluate(() => new Promise((resolve) => {
    let count = 0;
    const draw = WebGL2RenderingContext.prototype.drawElements;
    WebGL2RenderingContext.prototype.drawElements = function (...args) { count += 1; return draw.apply(this, args); };
    setTimeout(() => { WebGL2RenderingContext.prototype.drawElements = draw; resolve(count); }, 1000);
  }));
  await page.waitForTimeout(500);
  assert.equal(await frames(), 0);
});

test('a lost WebGL context is reported and restored', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  const before = await picture(page);
  const lose = await page.evaluateHandle(() => {
    const extension = document.getElementById('picture').getContext('webgl2').getExtension('WEBGL_lose_context');
    extension.loseContext();
    return extension;
  });
  await page.waitForFunction(() => document.getElementById('status').textContent.includes('lost the view'));
  await lose.evaluate((extension) => extension.restoreContext());
  await page.waitForFunction(() => document.getElementById('status').textContent.includes('The view is available again'));
  let left = 1;
  for (let tries = 0; tries < 20 && left > 0.002; tries += 1) left = difference(before, await picture(page));
  assert.ok(left <= 0.002, `${left} of the picture differs`);
});

test('downloaded GLB and glTF files are complete and valid', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  for (const format of ['glb', 'gltf']) {
    const [download] = await Promise.all([page.waitForEvent('download'), format === 'glb' ? page.click('[data-format=glb]') : from_menu(page, 'download-menu', `[data-format=${format}]`)]);
    assert.equal(download.suggestedFilename(), `seedmesh-${small_tree.seed}.${format}`);
    const bytes = fs.readFileSync(await download.path());
    const answer = await server.generate({ ...small_tree, output: { format } });
    assert.ok(bytes.equals(answer.bytes), format);
    const report = await validateBytes(new Uint8Array(bytes));
    assert.equal(report.issues.numErrors, 0, format);
  }
});

test('the copied curl command saves the same model', { timeout: 200_000 }, async () => {
  const quoted = { ...small_tree, parameters: { ...small_tree.parameters, interpretation: ["F -> 'F"] } };
  const page = await open(browser, `${server.url}/${fragment_of(quoted)}`, { permissions: ['clipboard-read', 'clipboard-write'] });
  await from_menu(page, 'code-menu', '#copy-curl');
  await page.waitForFunction(() => document.getElementById('status').textContent === 'The command is copied');
  const command = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(command, /^curl .*-o model\.glb /);
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-'));
  // The test needs no curl: a shell splits the command into the arguments that curl would receive.
  const words = execFileSync('sh', ['-c', command.replace(/^curl/, "printf '%s\\n'")], { cwd: folder }).toString().split('\n');
  const body = JSON.parse(words[words.indexOf('-d') + 1]);
  assert.deepEqual(body.parameters, quoted.parameters);
  assert.ok(words.includes(`${server.url}/v1/generate`));
  assert.equal((await server.generate(body)).bytes.length, (await statistics(page)).bytes);
  fs.rmSync(folder, { recursive: true });
});

test('the text is shown for manual copying if the page has no clipboard access', { timeout: 200_000 }, async () => {
  const page = await open(browser, address, {
    before: (page) => page.addInitScript(() => { Object.defineProperty(navigator, 'clipboard', { value: undefined }); }),
  });
  await page.click('#copy-link');
  await page.waitForFunction(() => document.querySelector('#by-hand-text')?.value);  // the link is compressed first
  const text = await page.inputValue('#by-hand-text');
  assert.deepEqual(request_of(new URL(text).hash), small_tree);
});

test('a damaged link is reported, and a model is shown nevertheless', { timeout: 200_000 }, async () => {
  const page = await open(browser, `${server.url}/#not-a-request`);
  assert.match(await page.textContent('#alert'), /link is damaged/);
  assert.ok((await statistics(page)).bytes > 0);
  await until_shown(page, () => page.click('#dice'));
  assert.equal(await page.textContent('#alert'), '');
});

test('another link in the same tab is opened', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of({ ...small_tree, seed: '18446744073709551615' })));
  assert.equal(await page.inputValue('#seed'), '18446744073709551615');
});

test('a link includes its title, and one without a preset gets a descriptive title', { timeout: 200_000 }, async () => {
  const page = await open(browser, `${server.url}/`);
  await until_shown(page, () => page.click('[data-preset="koch_snowflake"]'));
  await until_shown(page, () => page.fill('#seed', '77'));
  await page.waitForTimeout(500);
  const title = await page.textContent('#title');
  const fresh = await open(browser, page.url());
  assert.equal(await fresh.textContent('#title'), title);
  assert.equal(await fresh.inputValue('#seed'), '77');
  assert.equal(await fresh.getAttribute('[data-preset="koch_snowflake"]', 'aria-pressed'), 'true');
  const nameless = await open(browser, address);
  assert.match(await nameless.textContent('#title'), /^L-system/);
  const other = await open(browser, `${address}.oak`);
  assert.match(await other.textContent('#title'), /^L-system/, 'the name belongs to another generator');
});

test('a 64-bit seed is kept exactly, and an invalid seed is reported', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  const bodies = [];
  page.on('request', (request) => { if (request.url().endsWith('/v1/generate')) bodies.push(JSON.parse(request.postData())); });
  await until_shown(page, () => page.fill('#seed', '18446744073709551615'));
  assert.equal(bodies.at(-1).seed, '18446744073709551615');
  for (const wrong of ['18446744073709551616', 'abc', '-1', '1.5', '']) {
    await page.fill('#seed', wrong);
    assert.equal(await page.getAttribute('#seed', 'aria-invalid'), 'true');
    assert.match(await page.textContent('#seed-error'), /whole number from 0 to/);
    await page.locator('#seed').blur();
    assert.equal(await page.inputValue('#seed'), '18446744073709551615', 'what is shown is what is shared');
    assert.equal(await page.textContent('#seed-error'), '');
  }
  await until_shown(page, () => page.fill('#seed', '12'));
  assert.equal(bodies.at(-1).seed, 12);
  assert.ok(bodies.every((body) => [12, '18446744073709551615'].includes(body.seed)));
});

test('the gallery shows all presets with thumbnails, and filters by words and tags', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  const { presets } = (await server.get('/v1/presets')).json;
  assert.equal(await page.locator('.card').count(), presets.length);
  for (const preset of presets) {
    const thumbnail = await server.get(`/thumbnails/${preset.name}.webp`);
    assert.equal(thumbnail.status, 200, `${preset.name} has no thumbnail: ./dev pictures ${preset.name}`);
    assert.ok(thumbnail.bytes.length < 20_000, preset.name);
  }
  await page.fill('#gallery input[type=search]', 'koch');
  const found = presets.filter((preset) => JSON.stringify(preset).toLowerCase().includes('koch'));
  assert.equal(await page.locator('.card:visible').count(), found.length);
  await page.fill('#gallery input[type=search]', '');
  await page.click('.more-tags > summary');
  const tag = await page.locator('.more-tags .chip').first().textContent();
  await page.locator('.more-tags .chip').first().click();
  assert.equal(await page.locator('.card:visible').count(), presets.filter((preset) => preset.tags.includes(tag)).length);
  await page.fill('#gallery input[type=search]', 'no such words');
  assert.ok(await page.getByText('No preset has').isVisible());
  assert.ok(await page.locator('.more-tags .chip').first().isHidden(), 'who searches sees what is found');
  await page.getByRole('button', { name: 'Show all presets' }).click();
  assert.equal(await page.locator('.card:visible').count(), presets.length);
});

test('gallery search accepts whole words, prefixes and several words, and groups results by generator', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  const { generators } = (await server.get('/v1/presets')).json;
  const headings = await page.locator('.family-head').allTextContents();
  assert.deepEqual(headings.map((heading) => heading.replace(/ \d+$/, '')), generators.map(({ title }) => title));
  assert.deepEqual(await page.locator('.kinds .chip').allTextContents(), generators.map(({ title }) => title));
  const find = async (words) => {
    await page.fill('#gallery input[type=search]', words);
    return page.locator('.card:visible').evaluateAll((cards) => cards.map((card) => card.dataset.preset));
  };
  const oaks = await find('oaks');
  assert.ok(oaks.includes('oak') && oaks.includes('black_oak'));
  assert.deepEqual(await find('OAK'), oaks);
  assert.ok((await find('game tree')).length > 0);
  assert.deepEqual(await find('conifers'), ['pine', 'spruce', 'boreal_plain']);
  assert.deepEqual(await find('aspen wind'), ['aspen_in_wind']);
  assert.ok(!(await find('oak')).includes('kogovsek_2_8'), 'no word begins with it');
});

test('cards throughout the gallery open their presets', { timeout: 600_000 }, async () => {
  const page = await open(browser, address);
  const { presets } = (await server.get('/v1/presets')).json;
  const models = presets.filter(({ generator }) => generator !== 'world'); // worlds have a page of their own
  for (const preset of models.filter((_, index) => index % 6 === 0)) {
    const before = await page.evaluate(() => Number(document.body.dataset.shown));
    await page.click(`[data-preset="${preset.name}"]`);
    // The page asks before it draws a large model without a graphics card. The title tells its question from that of the card before.
    await page.waitForFunction(({ count, title }) => document.querySelector('#title').textContent === title && (document.body.dataset.state === 'asking' ||
      (document.body.dataset.state === 'ready' && Number(document.body.dataset.shown) > count)), { count: before, title: preset.title }, { timeout: 90_000, polling: 100 });
  }
  assert.deepEqual(page.errors, []);
});
