// Shared by the browser tests: the real server, a browser, and the page opened in it.
import assert from 'node:assert/strict';
import zlib from 'node:zlib';
import pixelmatch from 'pixelmatch';
import { PNG } from 'pngjs';
import { program, serve } from '../http/support.mjs';
import { launch, until_shown, until_state } from './chromium.mjs';

export { launch, program, serve, until_shown, until_state };

export const fragment_of = (request, is_text = false) => `#${zlib.deflateRawSync(is_text ? request : JSON.stringify(request)).toString('base64url')}`;
export const request_of = (fragment) => JSON.parse(zlib.inflateRawSync(Buffer.from(fragment.replace('#', ''), 'base64url')));

/** A tree of a few hundred triangles, so that tests do not wait for the software renderer. */
export const small_tree = {
  generator: 'lsystem', seed: 3,
  parameters: { axiom: 'F', productions: ['F -> F[+F]', 'X -> Y'], iterations: 3, angle: 25, step: 0.4 },
};

/** A tree with leaves and seasons. */
export const leafy = { generator: 'tree', seed: 2, parameters: { model: 'weber_penn', Levels: 2, Leaves: 8, season: 'summer', sides: 4 }, output: { textures: 'none' } };

/** The page in a context of its own: nothing is shared with other tests. Whatever breaks the policy is an error. */
export async function open(browser, address, { states = ['ready'], before = async () => {}, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 800, height: 450 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(90_000);
  page.errors = [];
  page.on('pageerror', (error) => page.errors.push(error.message));
  page.on('console', (message) => { if (/Content Security Policy/.test(message.text())) page.errors.push(message.text()); });
  await before(page);
  await page.goto(address);
  await until_state(page, ...states);
  // Code that the first model does not need is loaded later.
  await page.waitForFunction(() => document.body.dataset.tools === 'ready');
  return page;
}

export const field = (page, pointer) => page.locator(`[data-pointer="${pointer}"]`);

/** Opens the form. */
export async function open_parameters(page) {
  await page.click('#tab-parameters');
  await page.waitForSelector('#parameters .form');
}

/** The code editor in a field, after it has replaced the text area. Locators look into its shadow root. */
export const code = (place) => place.locator('.cm-content');

export async function written(place) {
  await code(place).waitFor();
  return (await code(place).locator('.cm-line').allTextContents()).join('\n');
}

/** Replaces the whole text by pasting. */
export async function write(place, text) {
  await code(place).click();
  await code(place).press('Control+a');
  await code(place).evaluate((content, text) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData('text/plain', text);
    content.dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true, cancelable: true }));
  }, text);
}

/** The selection in a code editor, which is that of the shadow root. */
export const selected = (place) => code(place).evaluate((content) => content.getRootNode().getSelection().toString());

/** Opens a menu and clicks a button in it. */
export async function from_menu(page, menu, button) {
  if (!(await page.locator(`#${menu}`).evaluate((each) => each.open))) await page.click(`#${menu} > summary`);
  await page.click(button);
}

/** Drops a file onto the page as a hand would, or several of one text. */
export const drop = (page, names, text, type = '') => page.evaluate(({ names, text, type }) => {
  const dataTransfer = new DataTransfer();
  for (const name of names) dataTransfer.items.add(new File([text], name, { type }));
  for (const each of ['dragenter', 'dragover', 'drop']) document.body.dispatchEvent(new DragEvent(each, { dataTransfer, bubbles: true, cancelable: true }));
}, { names: [names].flat(), text, type });

/** The menu of the view. */
export const open_menu = (page) => page.locator('#view-menu').evaluate((menu) => { menu.open = true; });

/** Chooses in the menu, and closes it, so that it covers nothing. */
export const choose = async (page, id, value) => {
  await open_menu(page);
  await page.selectOption(id, value);
  await page.keyboard.press('Escape');
};

/** On foot or in flight the menu closes by itself, and Escape would end it. */
export const go_by = async (page, gait) => {
  await open_menu(page);
  await page.selectOption('#gait', gait);
};

export const statistics = (page) => page.evaluate(() => ({
  triangles: document.getElementById('triangles').textContent,
  bytes: Number(document.getElementById('bytes').dataset.bytes),
}));

/** The drawn model, without overlays. */
export async function picture(page) {
  // The step bar appears with the form, and the model is framed above it.
  await page.waitForSelector('#parameters .form', { state: 'attached' });
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  const flip = (hidden) => page.evaluate((hidden) => { for (const each of document.querySelectorAll('.overlay')) each.hidden = hidden; }, hidden);
  await flip(true);
  const png = await page.locator('#picture').screenshot();
  await flip(false);
  return png;
}

/** The same, after the camera has fitted the model between the overlays. */
export async function fitted_picture(page) {
  await picture(page);
  await page.click('#fit');
  return picture(page);
}

/** Share of pixels that differ visibly; a lower threshold sees faint shades too. */
export function difference(a, b, threshold = 0.2) {
  const [first, second] = [PNG.sync.read(a), PNG.sync.read(b)];
  assert.deepEqual([first.width, first.height], [second.width, second.height]);
  return pixelmatch(first.data, second.data, null, first.width, first.height, { threshold }) / (first.width * first.height);
}

/** The pixels that the model covers. The page draws on a transparent ground at `/?stage`. */
export function outline(png) {
  const { data } = PNG.sync.read(png);
  return Uint8Array.from({ length: data.length / 4 }, (_, pixel) => (data[pixel * 4 + 3] > 127 ? 1 : 0));
}

/** Pixels of both over pixels of either. */
export function overlap(a, b) {
  let both = 0, either = 0;
  a.forEach((is, pixel) => { both += is & b[pixel]; either += is | b[pixel]; });
  return both / either;
}

/** Sets a control of the menu that may be outside the window, and waits for two frames. */
export const set = (page, id, value) => page.evaluate(([id, value]) => new Promise((resolve) => {
  const control = document.getElementById(id);
  if (typeof value === 'boolean') control.checked = value;
  else control.value = value;
  control.dispatchEvent(new Event('change'));
  requestAnimationFrame(() => requestAnimationFrame(resolve));
}), [id, value]);

export const rect = (page, selector) => page.locator(selector).evaluate((each) => { const { top, bottom, left, right } = each.getBoundingClientRect(); return { top, bottom, left, right }; });

/** From where to where the model is drawn: all that changes with its shading, in the pixels of the window. */
export async function extent(page, mode = 'shaded') {
  await set(page, 'shading', 'shaded');
  const one = PNG.sync.read(await picture(page));
  await set(page, 'shading', 'normals');
  const other = PNG.sync.read(await picture(page));
  await set(page, 'shading', mode);
  const { width, height } = one;
  const found = { left: width, right: -1, top: height, bottom: -1 };
  for (let y = 0; y < height; y += 1)
    for (let x = 0; x < width; x += 1) {
      const at = (y * width + x) * 4;
      if (![0, 1, 2].some((channel) => Math.abs(one.data[at + channel] - other.data[at + channel]) > 40)) continue;
      Object.assign(found, { left: Math.min(found.left, x), right: Math.max(found.right, x), top: Math.min(found.top, y), bottom: Math.max(found.bottom, y) });
    }
  const from = await rect(page, '#picture');
  return { left: from.left + found.left, right: from.left + found.right, top: from.top + found.top, bottom: from.top + found.bottom };
}
