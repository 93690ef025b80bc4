// A service with access control: the page asks for the key, sends it where it is required, and stores it only
// with consent.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import { fragment_of, from_menu, launch, open, program, serve, small_tree, statistics, until_shown, until_state } from './support.mjs';

const axe = fs.readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const digest = (key) => createHash('sha256').update(key).digest('hex');

let server, browser, address;
before(async () => {
  server = await serve(program, ['--api-keys', `gallery:${digest('open sesame')}, guest:${digest('another')}`]);
  browser = await launch();
  address = `${server.url}/${fragment_of(small_tree)}`;
});
after(async () => { await browser?.close(); await server?.stop(); });

const give = async (page, key) => { await page.fill('#key', key); await page.click('#key-dialog button.first'); };
const stored = (page) => page.evaluate(() => JSON.stringify([{ ...sessionStorage }, { ...localStorage }, document.cookie, location.href]));

test('the page asks for the key, reports a wrong one, and continues with the right one', { timeout: 200_000 }, async () => {
  const page = await open(browser, address, { states: ['locked'], permissions: ['clipboard-read', 'clipboard-write'] });
  assert.ok(await page.isVisible('#key-dialog'));
  assert.equal(await page.getAttribute('#key', 'type'), 'password');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'key');
  await give(page, 'guess');
  await page.waitForFunction(() => /does not accept/.test(document.getElementById('key-error').textContent));
  assert.equal(await page.getAttribute('#key', 'aria-invalid'), 'true');
  await until_shown(page, () => give(page, 'open sesame'));
  assert.ok(await page.isHidden('#key-dialog'));
  const { headers } = await server.generate(small_tree, { authorization: 'Bearer open sesame' });
  assert.equal(Number((await statistics(page)).triangles.replaceAll(',', '')), Number(headers['seedmesh-triangles']));
  // Every request that requires the key sends it.
  await until_shown(page, () => page.click('#dice'));
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('[data-format=glb]')]);
  assert.ok(fs.statSync(await download.path()).size > 1000);
  await page.click('#tab-result');
  await page.waitForSelector('#result .figures');
  for (const [button, words] of [['#copy-curl', 'Bearer $SEEDMESH_KEY'], ['#copy-python', 'os.environ["SEEDMESH_KEY"]'], ['#copy-javascript', 'process.env.SEEDMESH_KEY']]) {
    await from_menu(page, 'code-menu', button);
    await page.waitForFunction(async (words) => (await navigator.clipboard.readText()).includes(words), words);
    assert.doesNotMatch(await page.evaluate(() => navigator.clipboard.readText()), /sesame/, 'programs name a variable and no key');
  }
  assert.doesNotMatch(await stored(page), /sesame/, 'unasked it is kept nowhere');
  await page.reload();
  await until_state(page, 'locked');
  assert.deepEqual(page.errors, []);
});

test('the tab remembers the key if the box is ticked, other tabs do not', { timeout: 200_000 }, async () => {
  const page = await open(browser, address, { states: ['locked'] });
  await page.check('#key-in-tab');
  await until_shown(page, () => give(page, 'another'));
  await page.reload();
  await until_state(page, 'ready');
  assert.doesNotMatch(await page.evaluate(() => JSON.stringify({ ...localStorage }) + document.cookie), /another/);
  const other = await page.context().newPage();
  await other.goto(address);
  await until_state(other, 'locked');
});

test('a visitor without a key can browse and enter one later', { timeout: 200_000 }, async () => {
  const page = await open(browser, server.url, { states: ['locked'] });
  await page.keyboard.press('Escape');
  await until_state(page, 'refused');
  assert.match(await page.textContent('#alert'), /key is required/);
  assert.ok(await page.locator('.card').count() > 100, 'the gallery is open');
  await page.click('[data-preset="koch_snowflake"]');
  await until_state(page, 'refused');
  assert.ok(await page.isHidden('#key-dialog'), 'it is not asked again and again');
  await page.getByRole('button', { name: 'Enter a key' }).click();
  await until_state(page, 'locked');
  await until_shown(page, () => give(page, 'open sesame'));
  assert.equal(await page.textContent('#alert'), '');
  assert.equal(await page.textContent('#title'), await page.locator('[data-preset="koch_snowflake"] span').textContent(), 'what was asked for last');
});

test('a revoked key is asked for again, and missing permissions are reported', { timeout: 200_000 }, async () => {
  const page = await open(browser, address, { states: ['locked'] });
  await until_shown(page, () => give(page, 'open sesame'));
  const denied = { status: 403, contentType: 'application/problem+json', body: '{"detail":"The generator is not allowed here."}' };
  await page.route('**/v1/generate', (route) => route.fulfill(denied));
  await page.fill('#seed', '8');
  await until_state(page, 'refused');
  assert.match(await page.textContent('#alert'), /not allowed here/);
  await page.route('**/v1/validate', (route) => route.fulfill(denied));
  await page.fill('#seed', '9');
  await until_state(page, 'locked');
  assert.match(await page.textContent('#key-dialog'), /does not accept the key/);
});

for (const colorScheme of ['light', 'dark']) {
  test(`axe reports no violation in the key dialog, ${colorScheme}`, { timeout: 200_000 }, async () => {
    const page = await open(browser, address, { states: ['locked'], colorScheme });
    await give(page, 'guess');
    await page.waitForFunction(() => document.getElementById('key-error').textContent !== '');
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }));
    assert.deepEqual(violations.map((each) => `${each.id}: ${each.nodes.map((node) => node.html).join('; ')}`), []);
  });
}
