// Undo, seeds, comparison, exports and imports.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { difference, drop, field, fragment_of, from_menu, launch, open, open_parameters, picture, program, request_of, serve, small_tree, statistics, until_shown } from './support.mjs';

let server, browser, address;
before(async () => {
  server = await serve(program);
  browser = await launch();
  address = `${server.url}/${fragment_of(small_tree)}`;
});
after(async () => { await browser?.close(); await server?.stop(); });

const clipboard = { permissions: ['clipboard-read', 'clipboard-write'] };
const steps_apart = (page) => page.waitForTimeout(800);

test('undo and redo step through the edits, and a moving slider is one step', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  await open_parameters(page);
  const angle = field(page, '/parameters/angle').locator('input[type=number]');
  assert.ok(await page.isDisabled('#undo'));
  await until_shown(page, () => field(page, '/parameters/angle').locator('input[type=range]').evaluate((slider) => {
    for (let value = 30; value <= 40; value += 1) { slider.value = value; slider.dispatchEvent(new Event('input')); }
  }));
  await steps_apart(page);
  await until_shown(page, () => page.fill('#seed', '8'));
  await page.focus('#picture');
  await until_shown(page, () => page.keyboard.press('Control+z'));
  assert.equal(await page.inputValue('#seed'), '3');
  assert.equal(await angle.inputValue(), '40');
  await until_shown(page, () => page.click('#undo'));
  assert.equal(await angle.inputValue(), '25');
  assert.ok(await page.isDisabled('#undo'));
  await until_shown(page, () => page.keyboard.press('Control+y'));
  assert.equal(await angle.inputValue(), '40');
  await until_shown(page, () => page.click('#redo'));
  assert.equal(await page.inputValue('#seed'), '8');
  await until_shown(page, async () => { await page.click('#tab-gallery'); await page.click('[data-preset="koch_snowflake"]'); });
  const preset_hash = new URL(page.url()).hash;
  await until_shown(page, () => page.click('#undo'));
  assert.equal(await page.inputValue('#seed'), '8', 'a preset that was opened is undone too');
  await page.waitForFunction((hash) => location.hash !== hash, preset_hash);
  assert.equal(request_of(new URL(page.url()).hash).seed, 8, 'and the address follows');
});

test('earlier seeds can be chosen again', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  await until_shown(page, () => page.fill('#seed', '11'));
  await until_shown(page, () => page.fill('#seed', '12'));
  await page.click('#seeds-menu > summary');
  assert.deepEqual(await page.locator('#seed-list button').allTextContents(), ['12', '11', '3']);
  await until_shown(page, () => page.click('#seed-list button >> text="3"'));
  assert.equal(await page.inputValue('#seed'), '3');
});

test('nine seeds are shown as thumbnails, and one is chosen', { timeout: 300_000 }, async () => {
  const chance = { generator: 'lsystem', seed: '18446744073709551614', parameters: { axiom: 'F', productions: ['F -> F[+F]F : 0.5', 'F -> F[-F]F : 0.5'], iterations: 4, step: 0.2 } };
  const page = await open(browser, `${server.url}/${fragment_of(chance)}`);
  const before = await picture(page);
  await from_menu(page, 'seeds-menu', '#nine');
  await page.waitForFunction(() => document.getElementById('nine-dialog').dataset.filled === '9');
  const seeds = await page.locator('.cell').evaluateAll((cells) => cells.map((cell) => cell.dataset.seed));
  assert.deepEqual(seeds.slice(0, 4), ['18446744073709551614', '18446744073709551615', '0', '1'], 'after the largest seed comes 0');
  assert.deepEqual(await page.locator('.cell[aria-current=true]').allTextContents(), ['18446744073709551614 · now']);
  const pictures = await page.locator('.cell canvas').evaluateAll((each) => each.map((canvas) => canvas.toDataURL()));
  assert.equal(pictures.length, 9);
  assert.ok(new Set(pictures).size >= 5, 'chance shows');
  await page.keyboard.press('Escape');
  assert.ok(difference(before, await picture(page)) < 0.002, 'the model on the page is as it was');
  await from_menu(page, 'seeds-menu', '#nine');
  await until_shown(page, () => page.click('.cell[data-seed="1"]'));
  assert.equal(await page.inputValue('#seed'), '1');
});

test('nine seeds wait for a busy server', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  let busy = 2;
  await page.route('**/v1/generate', (route) => ((busy -= 1) >= 0 ? route.fulfill({ status: 503, headers: { 'Retry-After': '1' }, json: {} }) : route.continue()));
  await from_menu(page, 'seeds-menu', '#nine');
  await page.getByText('The server is busy. Next attempt soon').waitFor();
  await page.waitForFunction(() => document.getElementById('nine-dialog').dataset.filled === '9');
  assert.equal(await page.locator('.cell canvas').count(), 9);
});

test('a comparison keeps a model to the left of a movable divider', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  await page.focus('#picture');
  await page.keyboard.press('c');
  assert.equal(await page.getAttribute('#compare', 'aria-pressed'), 'true');
  assert.match(await page.textContent('#divider-box label'), /seed 3/);
  await open_parameters(page);
  const same = await picture(page);
  await until_shown(page, () => field(page, '/parameters/angle').locator('input[type=number]').fill('70'));
  const both = await picture(page);
  await page.locator('#divider').fill('0');
  const right = await picture(page);
  await page.locator('#divider').fill('100');
  const left = await picture(page);
  assert.ok(difference(left, right) > 0.001, 'the two differ');
  for (const [name, other] of [['left', left], ['right', right], ['same', same]]) assert.ok(difference(both, other) > 0.0005, name);
  await page.click('#compare');
  assert.ok(await page.isHidden('#divider-box'));
  assert.ok(difference(right, await picture(page)) < 0.01);
});

test('the copied JavaScript and Python programs save the same model', { timeout: 300_000 }, async (t) => {
  const odd = { ...small_tree, seed: '18446744073709551615', parameters: { ...small_tree.parameters, constants: { k: '1 + 1' }, timed: false, materials: [{ name: 'Rinde ü 🌲', color: '#6b4f35' }] } };
  const page = await open(browser, `${server.url}/${fragment_of(odd)}`, clipboard);
  const expected = (await server.generate(odd)).bytes;
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-'));
  const copied = async (button, word) => {
    await from_menu(page, 'code-menu', button);
    await page.waitForFunction((word) => document.getElementById('status').textContent.includes(word), word);
    return page.evaluate(() => navigator.clipboard.readText());
  };
  fs.writeFileSync(path.join(folder, 'fetch.mjs'), await copied('#copy-javascript', 'JavaScript'));
  execFileSync(process.execPath, ['fetch.mjs'], { cwd: folder });
  assert.ok(fs.readFileSync(path.join(folder, 'model.glb')).equals(expected));
  fs.rmSync(path.join(folder, 'model.glb'));
  fs.writeFileSync(path.join(folder, 'fetch.py'), await copied('#copy-python', 'Python'));
  const run = spawnSync('python3', ['fetch.py'], { cwd: folder });
  if (run.error?.code === 'ENOENT') t.diagnostic('no python3 here: the Python program was not run');
  else {
    assert.equal(run.status, 0, String(run.stderr));
    assert.ok(fs.readFileSync(path.join(folder, 'model.glb')).equals(expected));
  }
  fs.rmSync(folder, { recursive: true });
});

test('zip, image and request are saved', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  const saved = async (button) => {
    const [download] = await Promise.all([page.waitForEvent('download'), from_menu(page, 'download-menu', button)]);
    return { name: download.suggestedFilename(), bytes: fs.readFileSync(await download.path()) };
  };
  const zip = await saved('[data-format=zip]');
  assert.equal(zip.name, 'seedmesh-3.zip');
  assert.ok(zip.bytes.equals((await server.generate({ ...small_tree, output: { format: 'zip' } })).bytes));
  const png = await saved('#save-picture');
  assert.equal(png.name, 'seedmesh-3-view.png');
  const { width, height, data } = PNG.sync.read(png.bytes);
  assert.ok(width > 300 && height > 300);
  assert.ok(new Set(new Uint32Array(data.buffer, data.byteOffset, data.length / 4)).size > 50, 'something is drawn');
  const json = await saved('#save-request');
  assert.deepEqual(JSON.parse(json.bytes), small_tree);
  const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Control+s')]);
  assert.equal(download.suggestedFilename(), 'seedmesh-3.json');
});

test('a request that is too long for a link is reported', { timeout: 200_000 }, async () => {
  const page = await open(browser, address, clipboard);
  let text = '';
  for (let value = 1; text.length < 60_000; value = (value * 48271) % 2147483647) text += value.toString(36);
  const long = { ...small_tree, parameters: { ...small_tree.parameters, materials: [{ name: 'bark', images: { color: `data:image/png;base64,${text}` } }] } };
  await page.setInputFiles('#file', { name: 'long.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(long)) });
  await page.waitForFunction(() => location.hash === '');
  await page.click('#copy-link');
  await page.waitForFunction(() => /too long for a link/.test(document.getElementById('alert').textContent));
});

test('a dropped or chosen request is opened', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  await until_shown(page, () => drop(page, 'mine.json', JSON.stringify({ ...small_tree, seed: 77 })));
  assert.equal(await page.inputValue('#seed'), '77');
  assert.equal(await page.textContent('#title'), 'mine');
  assert.ok(await page.isHidden('#drop-sign'));
  // The listener is registered permanently, because a listener added with the key press might be too late.
  page.on('filechooser', () => {});
  const choose = async (act, file) => {
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'), act()]);
    await chooser.setFiles(file);
  };
  await until_shown(page, async () => {
    await choose(() => page.click('#open-file'), { name: 'other.json', mimeType: 'application/json', buffer: Buffer.from('{"preset": "koch_snowflake", "seed": 5}') });
  });
  assert.equal(await page.inputValue('#seed'), '5');
  await until_shown(page, async () => {
    await choose(() => page.keyboard.press('Control+o'), { name: 'third.json', mimeType: 'application/json', buffer: Buffer.from('{"preset": "koch_snowflake", "seed": 6}') });
  });
  assert.equal(await page.inputValue('#seed'), '6');
  await page.waitForFunction(() => location.hash.length > 50);
  assert.equal(request_of(new URL(page.url()).hash).generator, 'lsystem');
});

test('a file of another program is imported, and an unknown format is explained', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  const koch = 'Koch1 {\n  Angle 6\n  Axiom F--F--F\n  F=F+F--F+F\n}\n';
  await until_shown(page, () => drop(page, 'koch.l', koch));
  await page.waitForFunction(() => document.getElementById('status').textContent.includes('koch.l is imported from fractint'));
  assert.match(await page.textContent('#alert'), /These parts of koch\.l cannot be imported: Line 1, column 1: an entry has no number of steps/);
  assert.ok((await statistics(page)).bytes > 0);
  await page.waitForFunction(() => location.hash.length > 50);
  assert.match(JSON.stringify(request_of(new URL(page.url()).hash)), /F\+F--F\+F/);
  await drop(page, 'two.l', `${koch}Koch2 {\n  Angle 4\n  Axiom F\n  F=F+F-F\n}\n`);
  await page.waitForSelector('#import-dialog[open]');
  assert.equal(await page.textContent('#import-title'), 'Which entry of two.l?');
  assert.match(await page.textContent('#import-dialog'), /Koch1, Koch2/);
  assert.equal(await page.inputValue('#import-format'), 'fractint');
  await page.fill('#import-entry', 'Koch2');
  await until_shown(page, () => page.click('#import-dialog button.first'));
  assert.ok(await page.isHidden('#import-dialog'));
  assert.equal(await page.textContent('#title'), 'Koch2');
  await drop(page, 'photo.png', '\u0089PNG\0\0', 'image/png');
  await page.waitForFunction(() => document.getElementById('alert').textContent.includes('photo.png is an image'));
  await drop(page, 'letter.txt', 'Dear all,\nthis is a letter.\n');
  await page.waitForSelector('#import-dialog[open]');
  assert.match(await page.textContent('#import-dialog'), /Line \d+, column 1/);
  await page.getByRole('button', { name: 'Close' }).click();
});

test('the first visit shows a one-line hint, later visits do not', { timeout: 200_000 }, async () => {
  const page = await open(browser, server.url);
  assert.match(await page.textContent('#hint'), /Select a model/);
  assert.ok(await page.isVisible('#hint'));
  await page.click('#hint-away');
  assert.ok(await page.isHidden('#hint'));
  await page.reload();
  await page.waitForFunction(() => document.body.dataset.state === 'ready');
  assert.ok(await page.isHidden('#hint'));
});

test('the question mark lists the shortcuts, and the form links to the page of its generator', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  await page.focus('#picture');
  await page.keyboard.press('?');
  assert.ok(await page.isVisible('#keys-dialog'));
  assert.match(await page.textContent('#keys-dialog'), /Wireframe.*pinch/s);
  assert.equal(await page.locator('#keys-dialog').evaluate((dialog) => dialog.scrollTop), 0);
  assert.equal(await page.evaluate(() => document.activeElement.id), 'keys-title');
  const caps = await page.locator('#keys-dialog kbd').evaluateAll((all) => all.map((cap) => cap.getClientRects().length));
  assert.ok(caps.every((lines) => lines === 1), 'no key is split over two lines');
  await page.keyboard.press('Escape');
  assert.ok(await page.isHidden('#keys-dialog'));
  await page.fill('#seed', '1');
  await page.focus('#seed');
  await page.keyboard.press('?');
  assert.ok(await page.isHidden('#keys-dialog'), 'in a field it is a character');
  await open_parameters(page);
  const link = await page.getAttribute('#parameters .about a', 'href');
  assert.match(link, /docs#schema-lsystem$/);
  assert.match((await server.get('/docs')).text, /id="schema-lsystem"/);
});

test('the gallery works by keyboard: slash, words, arrows, Enter', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  await page.focus('#picture');
  await page.keyboard.press('/');
  await page.keyboard.type('dragon');
  await page.keyboard.press('ArrowDown');
  const first = await page.evaluate(() => document.activeElement.dataset.preset);
  await page.keyboard.press('ArrowRight');
  const second = await page.evaluate(() => document.activeElement.dataset.preset);
  assert.ok(first && second && first !== second);
  await until_shown(page, () => page.keyboard.press('Enter'));
  assert.equal(await page.getAttribute(`[data-preset="${second}"]`, 'aria-pressed'), 'true');
  await page.keyboard.press('ArrowUp');
  assert.ok(await page.evaluate(() => document.activeElement.type === 'search' || document.activeElement.dataset.preset));
  const headings = await page.locator('.family-head').allTextContents();
  const { presets } = (await server.get('/v1/presets')).json;
  assert.equal(headings.length, new Set(presets.map((preset) => preset.generator)).size);
});
