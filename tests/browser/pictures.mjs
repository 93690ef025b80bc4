// ./dev pictures [preset...|page]: pictures for docs/pictures and thumbnails for the gallery, taken from the running page.
//
// The page is opened as `/?stage&quality=high`: nothing but the model, on a transparent ground, with shadows and
// smoothing. Which model is said by the fragment, as in any link. All presets get a thumbnail of 192 x 144; those
// named below get a large picture as well, and page.webp shows the page itself.
import fs from 'node:fs';
import path from 'node:path';
import zlib from 'node:zlib';
import { program, serve } from '../http/support.mjs';
import { launch, until_shown, until_state } from './chromium.mjs';

const root = path.resolve(import.meta.dirname, '../..');
const thumbnails = path.join(root, 'web_client/public/thumbnails');
const pictures = path.join(root, 'docs/pictures');
const large = ['abop_1_24f', 'abop_1_25', 'abop_1_31b', 'abop_2_6b', 'abop_2_7b', 'abop_2_8b', 'fern_5_11c', 'hilbert_3d', 'kogovsek_2_8', 'kogovsek_2_9', 'kogovsek_2_10', 'kogovsek_2_11', 'kogovsek_2_12', 'kogovsek_2_13', 'kogovsek_grm', 'saguaro', 'tajic_a', 'tunnel_natural'];

const fragment_of = (request) => `#${zlib.deflateRawSync(JSON.stringify(request)).toString('base64url')}`;

/** PNG in, WebP out, scaled down to the width and height: the browser's own encoder. */
async function to_webp(page, png, { width, height, quality }) {
  const data = await page.evaluate(async ({ png, width, height, quality }) => {
    const image = new Image();
    image.src = `data:image/png;base64,${png}`;
    await image.decode();
    const canvas = Object.assign(document.createElement('canvas'), { width, height });
    const context = canvas.getContext('2d');
    context.imageSmoothingQuality = 'high';
    context.drawImage(image, 0, 0, width, height);
    return canvas.toDataURL('image/webp', quality).split(',')[1];
  }, { png: png.toString('base64'), width, height, quality });
  return Buffer.from(data, 'base64');
}

async function take(browser, server, names, size, keep) {
  const page = await browser.newPage({ viewport: size, colorScheme: 'light' });
  await page.goto(`${server.url}/?stage&quality=high`);
  await until_state(page, 'ready');
  for (const name of names) {
    const request = (await server.get(`/v1/presets/${name}`)).json;
    await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of(request)));
    await keep(name, await page.screenshot({ omitBackground: true }));
  }
  await page.close();
}

const server = await serve(program);
const browser = await launch();
try {
  const wanted = process.argv.slice(2);
  const all = (await server.get('/v1/presets')).json.presets.map((preset) => preset.name);
  const chosen = wanted.length > 0 ? all.filter((name) => wanted.includes(name)) : all;
  const scaler = await browser.newPage();
  fs.mkdirSync(thumbnails, { recursive: true });
  fs.mkdirSync(pictures, { recursive: true });
  let bytes = 0;
  await take(browser, server, chosen, { width: 384, height: 288 }, async (name, png) => {
    const webp = await to_webp(scaler, png, { width: 192, height: 144, quality: 0.8 });
    fs.writeFileSync(path.join(thumbnails, `${name}.webp`), webp);
    bytes += webp.length;
  });
  process.stdout.write(`${chosen.length} thumbnails, ${bytes} bytes, in web_client/public/thumbnails\n`);
  const shown = large.filter((name) => chosen.includes(name));
  await take(browser, server, shown, { width: 960, height: 640 }, async (name, png) => {
    fs.writeFileSync(path.join(pictures, `${name}.webp`), await to_webp(scaler, png, { width: 960, height: 640, quality: 0.82 }));
  });
  if (wanted.length === 0 || wanted.includes('page')) {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme: 'light' });
    await page.goto(`${server.url}/?quality=high`);
    await until_state(page, 'ready');
    await page.waitForFunction(() => [...document.images].slice(0, 8).every((image) => image.complete));
    fs.writeFileSync(path.join(pictures, 'page.webp'), await to_webp(scaler, await page.screenshot(), { width: 1280, height: 800, quality: 0.85 }));
  }
  process.stdout.write(`${shown.length} pictures in docs/pictures\n`);
} finally {
  await browser.close();
  await server.stop();
}
