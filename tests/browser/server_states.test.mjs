// The server is slow, busy, unreachable and back: the page reports it, keeps the last model, and continues
// automatically.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { field, fragment_of, launch, open, open_parameters, program, serve, small_tree, until_shown, until_state } from './support.mjs';

let server, browser, address;
before(async () => {
  server = await serve(program);
  browser = await launch();
  address = `${server.url}/${fragment_of(small_tree)}`;
});
after(async () => { await browser?.close(); await server?.stop(); });

const says = (page, words) =>
  page.waitForFunction((words) => document.getElementById('status').textContent.includes(words), words);
const set_seed = (page, seed) => page.fill('#seed', String(seed));

test('a busy server is asked again after the time that it requested', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  const asked = [];
  await page.route('**/v1/generate', async (route) => {
    asked.push(Date.now());
    if (asked.length > 2) return route.continue();
    return route.fulfill({
      status: asked.length === 1 ? 429 : 503, headers: { 'Retry-After': '2' },
      contentType: 'application/problem+json', body: '{"title":"The queue is full"}',
    });
  });
  await until_shown(page, async () => {
    await set_seed(page, 4);
    await until_state(page, 'full');
    await says(page, 'The server is busy');
    assert.ok(await page.isVisible('#statistics'), 'the last model stays');
  });
  assert.ok(asked.length >= 3);
  assert.ok(asked[1] - asked[0] >= 2000, `${asked[1] - asked[0]} ms`);
  await says(page, 'The server is available again');
});

test('an unreachable server is reported, and the page continues when it is back', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  await until_shown(page, async () => {
    await page.context().setOffline(true);
    await set_seed(page, 5);
    await until_state(page, 'gone');
    await says(page, 'cannot be reached');
    assert.ok(await page.isVisible('#again'));
    await page.context().setOffline(false);
  });
  assert.match(await page.getAttribute('#picture', 'aria-label'), /seed 5/);
});

test('cancel stops waiting for a preset from a busy server', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  let is_full = true;
  await page.route('**/v1/presets/koch_island*', (route) =>
    (is_full ? route.fulfill({ status: 429, headers: { 'Retry-After': '1' }, contentType: 'application/problem+json', body: '{}' }) : route.continue()));
  await page.click('[data-preset="koch_island"]');
  await until_state(page, 'full');
  await page.click('#cancel');
  await until_state(page, 'stopped');
  is_full = false;
  await page.waitForTimeout(2500);
  assert.equal(await page.evaluate(() => document.body.dataset.state), 'stopped');
  assert.notEqual(await page.textContent('#title'), 'Koch island');
});

test('a thumbnail that failed during an outage is requested again', { timeout: 200_000 }, async () => {
  const page = await open(browser, address, { before: (page) => page.route('**/thumbnails/*', (route) => route.abort(), { times: 1 }) });
  const missing = page.locator('.card img.missing');
  await page.waitForFunction(() => [...document.querySelectorAll('.card img')].filter((each) => each.complete && each.naturalWidth > 0).length > 3);
  await page.waitForFunction(() => document.querySelectorAll('.card img.missing').length === 0, null, { timeout: 30_000 });
  assert.equal(await missing.count(), 0);
});

test('a stopped server is asked again on demand', { timeout: 200_000 }, async () => {
  const mortal = await serve(program);
  const page = await open(browser, `${mortal.url}/${fragment_of(small_tree)}`);
  await mortal.stop('SIGKILL');
  await set_seed(page, 6);
  await until_state(page, 'gone');
  const asked = page.waitForEvent('request', (request) => request.url().endsWith('/v1/generate'));
  await page.click('#again');
  await asked;
  await until_state(page, 'gone');
});

test('a slow server shows a progress bar after 300 ms, and cancel aborts the request', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  let held;
  await page.route('**/v1/generate', (route) => { held = route; });
  assert.ok(await page.isHidden('#progress'));
  await set_seed(page, 7);
  await page.waitForSelector('#progress:not([hidden])');
  await says(page, 'Still waiting');
  const failed = page.waitForEvent('requestfailed');
  await page.click('#cancel');
  assert.match((await failed).failure().errorText, /ABORTED/);
  await until_state(page, 'stopped');
  await says(page, 'Stopped');
  assert.ok(held);
  await page.unroute('**/v1/generate');
  await until_shown(page, () => page.click('#again'));
  assert.match(await page.getAttribute('#picture', 'aria-label'), /seed 7/);
});

test('after a slow model the next one uses the event stream', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  const accepted = [];
  await page.route('**/v1/generate', async (route) => {
    accepted.push(await route.request().headerValue('accept'));
    if (accepted.length === 1) await new Promise((resolve) => setTimeout(resolve, 800));
    await route.continue();
  });
  await until_shown(page, () => set_seed(page, 8));
  await until_shown(page, () => set_seed(page, 9));
  assert.deepEqual(accepted.slice(-2), ['text/event-stream', '*/*']);
});

test('progress events move the bar, and an error event is shown', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  let is_second = false;
  await page.route('**/v1/generate', async (route) => {
    if (!is_second) {
      await new Promise((resolve) => setTimeout(resolve, 800));
      return route.continue();
    }
    assert.equal(await route.request().headerValue('accept'), 'text/event-stream');
    return route.fulfill({
      contentType: 'text/event-stream',
      body: 'event: progress\ndata: {"stage":"derive","share":1.0}\n\nevent: error\ndata: {"detail":"The time limit is reached."}\n\n',
    });
  });
  await until_shown(page, () => set_seed(page, 10));
  is_second = true;
  await set_seed(page, 11);
  await until_state(page, 'refused');
  assert.match(await page.textContent('#alert'), /The time limit is reached/);
  assert.equal(await page.evaluate(() => document.getElementById('progress').value), 0.5);
});

test('a moving slider sends one request after it stops, and only the last response counts', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  await open_parameters(page);
  const bodies = [];
  await page.route('**/v1/generate', async (route) => {
    // After a slow response the page first opens an event stream. The model itself is still requested once.
    if (await route.request().headerValue('accept') === '*/*') bodies.push(JSON.parse(route.request().postData()));
    await route.continue();
  });
  await until_shown(page, () => field(page, '/parameters/angle').locator('input[type=range]').evaluate((slider) => {
    for (let value = 30; value <= 60; value += 1) {
      slider.value = value;
      slider.dispatchEvent(new Event('input'));
    }
  }));
  assert.equal(bodies.length, 1);
  assert.equal(bodies[0].parameters.angle, 60);
});

test('a response that a later request supersedes is dropped', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  const aborted = page.waitForEvent('requestfailed');
  let count = 0;
  await page.route('**/v1/generate', async (route) => {
    count += 1;
    if (count > 1) await route.continue();
  });
  await until_shown(page, async () => {
    const first = page.waitForRequest('**/v1/generate');
    await set_seed(page, 20);
    await first;
    await set_seed(page, 21);
  });
  await aborted;
  assert.match(await page.getAttribute('#picture', 'aria-label'), /seed 21/);
});
