// The form of the request's output, which downloads, links and code examples use in full and the view only in
// part.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { field, fragment_of, from_menu, launch, open, open_parameters, program, request_of, serve, small_tree, until_shown } from './support.mjs';

let server, browser;
before(async () => { server = await serve(program); browser = await launch(); });
after(async () => { await browser?.close(); await server?.stop(); });

const open_output = async (page) => {
  await open_parameters(page);
  await page.locator('#parameters details[data-pointer="/output"] > summary').click();
  await page.locator('[data-pointer="/output"] .field').first().waitFor();
};
const output_of = (page) => page.waitForTimeout(400).then(() => request_of(new URL(page.url()).hash).output);

test('levels of detail are set in a form, downloaded and undone without a change of the view', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of(small_tree)}`, { permissions: ['clipboard-read', 'clipboard-write'] });
  await open_parameters(page);
  assert.equal(await page.locator('[data-pointer="/output"] .field').count(), 0, 'drawn when it is opened');
  await open_output(page);
  const { properties } = (await server.get('/v1/schemas/output')).json;
  for (const name of Object.keys(properties)) assert.equal(await field(page, `/output/${name}`).count(), 1, name);
  const offered = await field(page, '/output/format').locator('option').allTextContents();
  assert.deepEqual(offered, ['glb', 'gltf', 'zip'], 'what other generators alone can make is not offered');

  await until_shown(page, () => field(page, '/output/lods').locator('input[type=number]').fill('2'));
  await page.waitForFunction(() => /expected the format zip/.test(document.querySelector('[data-pointer="/output/lods"] .issue').textContent));
  assert.equal(await page.evaluate(() => document.body.dataset.state), 'ready', 'the picture shows one level');
  // A change within 0.7 s would belong to the same undo step.
  await page.waitForTimeout(800);
  await until_shown(page, () => field(page, '/output/format').locator('select').selectOption({ label: 'zip' }));
  await page.waitForFunction(() => document.querySelector('[data-pointer="/output/lods"] .issue').hidden);
  assert.deepEqual(await output_of(page), { lods: 2, format: 'zip' });

  assert.equal(await page.textContent('#download'), 'ZIP');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#download')]);
  assert.match(download.suggestedFilename(), /\.zip$/);
  const { bytes } = await server.generate({ ...small_tree, output: { lods: 2, format: 'zip' } });
  assert.ok(fs.readFileSync(await download.path()).equals(bytes));
  await from_menu(page, 'code-menu', '#copy-curl');
  const command = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(command, /-o model\.zip .*"lods":2/s);

  await until_shown(page, () => page.click('#undo'));
  await until_shown(page, () => page.click('#undo'));
  assert.equal(await output_of(page), undefined);
  assert.equal(await page.textContent('#download'), 'GLB');
  assert.equal(await field(page, '/output/format').locator('select').evaluate((select) => select.selectedOptions[0].text), 'glb', 'the form stays open and shows what counts');
});

test('reset restores the output, and an empty output is removed from the request', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of(small_tree)}`);
  await open_output(page);
  await until_shown(page, () => field(page, '/output/tangents').locator('select').selectOption({ label: 'none' }));
  assert.deepEqual(await output_of(page), { tangents: 'none' });
  await until_shown(page, () => field(page, '/output/tangents').getByRole('button', { name: 'Reset' }).click());
  assert.equal(await output_of(page), undefined);
});

test('an error in the output opens its form', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of({ ...small_tree, output: { variants: 900, unheard_of: 1 } })}`, { states: ['refused'] });
  await page.locator('#alert button').click();
  await field(page, '/output/variants').locator('.issue').waitFor();
  assert.match(await field(page, '/output/variants').locator('.issue').textContent(), /900/);
  assert.match(await page.locator('[data-pointer="/output"]').textContent(), /unheard_of/);
});

test('levels, impostors, collision bodies and GPU instances are requested for files but not for the view', { timeout: 300_000 }, async () => {
  const bodies = [];
  const output = { impostor: true, instancing: 'gpu', profile: 'unity', lods: 2, collision: 'plain', variants: 2 };
  const page = await open(browser, `${server.url}/${fragment_of({ ...small_tree, output })}`, {
    before: async (page) => page.on('request', (request) => { if (request.url().endsWith('/v1/generate')) bodies.push(JSON.parse(request.postData())); }),
  });
  assert.equal(await page.textContent('#alert'), '');
  assert.deepEqual(bodies.at(-1).output, { variants: 2, format: 'glb' });
  const fractal = { generator: 'fractal', parameters: {}, output: { collision: 'plain' } };
  const other = await open(browser, `${server.url}/${fragment_of(fractal)}`);
  await open_parameters(other);
  await other.waitForFunction(() => document.querySelector('[data-pointer="/output/collision"] .issue')?.hidden === false);
  assert.match(await field(other, '/output/collision').locator('.issue').textContent(), /fractal makes no collision/);
});
