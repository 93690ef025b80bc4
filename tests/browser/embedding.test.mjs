// The examples of docs/embedding.md, in a page of another origin: model-viewer and the growth animation in three.js.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { launch, program, serve } from './support.mjs';

const root = path.resolve(import.meta.dirname, '../..');
const types = { '.html': 'text/html', '.js': 'text/javascript' };
let server, pages, browser, origin;

/** The examples, with the address of the service, and the modules that they import. */
function answer(request, response) {
  const target = new URL(request.url, 'http://here').pathname;
  const file = target.startsWith('/node_modules/') ? path.join(root, 'tests', target) : path.join(root, 'docs/examples', path.basename(target));
  if (!types[path.extname(file)] || !fs.existsSync(file)) { response.writeHead(404).end(); return; }
  response.writeHead(200, { 'content-type': types[path.extname(file)] });
  response.end(target.endsWith('.html') ? fs.readFileSync(file, 'utf8').replaceAll('http://127.0.0.1:8080', server.url) : fs.readFileSync(file));
}

before(async () => {
  pages = http.createServer(answer);
  await new Promise((resolve) => { pages.listen(0, '127.0.0.1', resolve); });
  origin = `http://127.0.0.1:${pages.address().port}`;
  server = await serve(program, ['--cors-origins', origin]);
  browser = await launch();
});
after(async () => {
  await browser?.close();
  await server?.stop();
  pages?.close();
});

async function open(name, errors) {
  const page = await browser.newPage({ viewport: { width: 440, height: 400 } });
  page.setDefaultTimeout(90_000);
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => { if (message.type() === 'error' && !/favicon/.test(message.location().url)) errors.push(message.text()); });
  await page.goto(`${origin}/${name}`);
  return page;
}

/** The share of pixels of an element that are not white. */
async function drawn(locator) {
  const { data } = PNG.sync.read(await locator.screenshot());
  let dark = 0;
  for (let i = 0; i < data.length; i += 4) dark += data[i] + data[i + 1] + data[i + 2] < 600 ? 1 : 0;
  return dark / (data.length / 4);
}

test('model-viewer shows a compressed model of another origin', async () => {
  const errors = [];
  const page = await open('model_viewer.html', errors);
  await page.waitForFunction(() => document.querySelector('model-viewer').loaded === true);
  const size = await page.evaluate(() => document.querySelector('model-viewer').getDimensions().y);
  assert.ok(size > 3 && size < 60, `an oak of ${size} m`);
  assert.deepEqual(errors, []);
  await page.close();
});

test('a page of an origin that is not listed cannot read a model', async () => {
  const other = await browser.newPage();
  await other.goto(`${server.url}/healthz`);
  const read = (from) => from.evaluate((address) => fetch(address).then((each) => each.status, () => 'refused'), `${server.url}/v1/presets/oak.json`);
  assert.equal(await read(other), 200, 'the same origin');
  await other.goto(`${origin.replace('127.0.0.1', 'localhost')}/growth.html`).catch(() => {});
  assert.equal(await read(other), 'refused');
  await other.close();
});

test('three.js plays the growth of a tree', async () => {
  const errors = [];
  const page = await open('growth.html', errors);
  const canvas = page.locator('canvas'), slider = page.locator('input');
  const at = async (time) => {
    await slider.evaluate((input, value) => { input.value = value; input.dispatchEvent(new Event('input')); }, String(time));
    await page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
    return drawn(canvas);
  };
  await page.waitForFunction(() => performance.getEntriesByType('resource').some((each) => each.name.includes('growing_tree') && each.responseEnd > 0));
  let full = 0;
  for (let i = 0; i < 100 && full === 0; ++i) full = await at(1);
  const [seed, half] = [await at(0), await at(0.5)];
  assert.ok(full > 0.01 && half < full && seed < half && seed < 0.3 * full, `${seed} ${half} ${full}`);
  assert.equal(await at(1), full);
  await page.locator('button').click();
  await page.waitForFunction(() => document.querySelector('input').value === '1');
  assert.deepEqual(errors, []);
  await page.close();
});
