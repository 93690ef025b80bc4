// ./dev pictures [preset...|page]: renders images for docs/pictures in the running page. The service draws the
// thumbnails of the gallery.
//
// The page is opened as `/?stage&quality=high`, which shows only the model on a transparent background, with
// shadows and antialiasing. As in any link, the fragment selects the model. All presets get a thumbnail of
// 192 x 144 pixels; those listed below also get a large image. Row images show several models side by side, and
// page.webp shows the page itself; both are rendered in a full run or when they are named.
import fs from 'node:fs';
import path from 'node:path';
import zlib from 'node:zlib';
import sharp from 'sharp';
import { program, serve } from '../http/support.mjs';
import { launch, until_shown, until_state } from './chromium.mjs';

const root = path.resolve(import.meta.dirname, '../..');
const thumbnails = path.join(root, 'web_client/public/thumbnails');
const pictures = path.join(root, 'docs/pictures');
const large = ['abop_1_24f', 'abop_1_25', 'abop_1_31b', 'abop_2_6b', 'abop_2_7b', 'abop_2_8b', 'fern_5_11c', 'hilbert_3d', 'kogovsek_2_8', 'kogovsek_2_9', 'kogovsek_2_10', 'kogovsek_2_11', 'kogovsek_2_12', 'kogovsek_grm', 'saguaro', 'tajic_a', 'tunnel_natural'];

/** Presets, with another seed or other parameters; with its edges alone in place of its faces. */
const of = (preset, change = {}) => ({ preset, ...change });
const seeds = (preset) => [1, 2, 3].map((seed) => of(preset, { seed }));
const plan = (preset) => [of(preset, { seed: 1, edges: true }), ...seeds(preset)];
/** Pictures of several models, each in a tile of the size. */
const rows = {
  building_house: { tile: [240, 180], models: plan('house') },
  building_church: { tile: [240, 180], models: plan('church') },
  building_factory: { tile: [240, 180], models: plan('factory') },
  building_temple: { tile: [280, 210], models: seeds('temple') },
  ...Object.fromEntries(['office_tower', 'parisian_block', 'terraced_house', 'villa', 'warehouse'].map((name) => [`building_${name}`, { tile: [280, 166], models: seeds(name) }])),
  building_lods: { tile: [220, 165], columns: 3, models: ['house', 'church', 'parisian_block', 'skyscraper'].flatMap((name) => [0, 1, 2].map((lod) => of(name, { parameters: { attributes: { lod } } }))) },
  building_skyscraper: { tile: [266, 229], models: seeds('skyscraper') },
  ...Object.fromEntries(['cga_house_2006', 'cga_courtyard', 'cga_occlusion', 'cga_random_street', 'froebel_tower'].map((name) => [name, { tile: [640, 336], models: [of(name)] }])),
  cga_roofs: { tile: [640, 464], models: [of('cga_roofs')] },
  ...Object.fromEntries(['alien_field', 'kogovsek_3_13', 'mountain_forest', 'orchard', 'village_edge'].map((name) => [`scene_${name}`, { tile: [640, 341], models: [of(name)] }])),
  scene_hutsko_garden: { tile: [960, 640], models: [of('hutsko_garden')] },
  ice_ray: { tile: [600, 480], models: [of('ice_ray')] },
  gips_embedded_squares: { tile: [600, 480], models: [of('gips_embedded_squares')] },
  kogovsek_2_13: { tile: [960, 300], columns: 1, models: [1, 2, 3].map((round) => of('kogovsek_2_13', { parameters: { stages: [round] } })) },
  trees: { tile: [200, 200], columns: 5, models: ['oak', 'birch', 'pine', 'willow', 'maple', 'palm', 'cherry', 'poplar', 'bush', 'dead_tree'].map((name) => of(name)) },
  weather: { tile: [400, 360], models: [of('pipe_model_tree'), of('tree_in_wind'), of('tree_in_snow')] },
  weber_penn: { tile: [220, 300], models: ['quaking_aspen', 'black_tupelo', 'weeping_willow', 'black_oak'].map((name) => of(name)) },
};

/** Pictures that are made by seed, as they are. */
const barks = ['oak', 'pine', 'spruce', 'willow', 'birch', 'beech', 'cherry', 'palm', 'cedar'];
const leaves = ['simple', 'willow', 'birch', 'cordate', 'lobed', 'maple', 'ginkgo', 'compound', 'palmate', 'palm', 'kite'];
const twigs = ['needles', 'birch', 'maple', 'willow', 'lobed', 'petal'];
const sheets = {
  barks: { tile: [128, 128], columns: 5, textures: barks.map((name) => `${name}_bark`) },
  leaves: { tile: [107, 107], columns: 6, textures: [...leaves.map((name) => `${name}_leaf`), 'petal', ...twigs.map((name) => `${name}_twig`)] },
};

const walls = ['brick', 'plaster', 'roof_tile', 'slate', 'planks', 'ashlar', 'concrete', 'sheet', 'panels', 'dressed_stone', 'paint'];
/** What the form shows beside the names of textures. */
const choices = path.join(root, 'web_client/public/textures');

/** Maps of tests/browser/pictures, drawn flat and beside it as the imported scene. */
const maps = { import_town: { tile: [480, 400], file: 'town.geojson' } };

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

/** The tiles of a row, one after the other from the left. */
async function take_row(browser, server, { tile: [width, height], models }) {
  const page = await browser.newPage({ viewport: { width: width * 2, height: height * 2 }, colorScheme: 'light' });
  await page.goto(`${server.url}/?stage&quality=high`);
  await until_state(page, 'ready');
  await page.waitForFunction(() => document.body.dataset.tools === 'ready');
  // The stage mode hides the controls over the view, but they still work.
  const wireframe = () => page.evaluate(() => document.getElementById('wireframe').click());
  const pngs = [];
  for (const { preset, seed, parameters, edges } of models) {
    const request = (await server.get(`/v1/presets/${preset}`)).json;
    const changed = { ...request, ...(seed === undefined ? {} : { seed }), parameters: { ...request.parameters, ...parameters } };
    if (edges) await wireframe();
    // The model is shown already.
    if (new URL(page.url()).hash !== fragment_of(changed))
      await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of(changed)));
    await page.waitForTimeout(300);
    pngs.push((await page.screenshot({ omitBackground: true })).toString('base64'));
    if (edges) await wireframe();
  }
  await page.close();
  return pngs;
}

/** The map with its tags as colours, north up, as a PNG. */
async function draw_map(page, map, [width, height]) {
  return page.evaluate(({ map, width, height }) => {
    const canvas = Object.assign(document.createElement('canvas'), { width: 2 * width, height: 2 * height });
    const context = canvas.getContext('2d');
    const points = map.features.flatMap(({ geometry: { coordinates } }) => coordinates.flat(Infinity));
    const axis = (first) => points.filter((_, index) => index % 2 === first);
    const [west, east, south, north] = [Math.min(...axis(0)), Math.max(...axis(0)), Math.min(...axis(1)), Math.max(...axis(1))];
    const squeeze = Math.cos((south + north) * Math.PI / 360);
    const scale = 0.96 * Math.min(canvas.width / ((east - west) * squeeze), canvas.height / (north - south));
    const at = ([x, y]) => [canvas.width / 2 + (x - (west + east) / 2) * squeeze * scale, canvas.height / 2 - (y - (south + north) / 2) * scale];
    const trace = (lines) => { context.beginPath(); for (const line of lines) line.forEach((point, index) => context[index === 0 ? 'moveTo' : 'lineTo'](...at(point))); };
    context.fillStyle = '#f2efe9';
    context.fillRect(0, 0, canvas.width, canvas.height);
    const metre = scale / 111320;
    const rank = ({ properties: p }) => (p.building || p['building:part'] ? 3 : p.highway || p.waterway ? 2 : p.natural === 'tree' ? 4 : p.natural ? 1 : 0);
    for (const { properties: p, geometry: { type, coordinates } } of map.features.toSorted((a, b) => rank(a) - rank(b))) {
      if (type === 'Point') {
        context.fillStyle = '#7fb069';
        context.beginPath();
        context.arc(...at(coordinates), 2.5 * metre, 0, 7);
        context.fill();
      } else if (type === 'LineString') {
        trace([coordinates]);
        context.lineWidth = Number(p.width ?? 5) * metre;
        context.strokeStyle = p.waterway ? '#9cc4dd' : '#ffffff';
        context.stroke();
      } else {
        trace(coordinates);
        context.fillStyle = p.building || p['building:part'] ? '#cdbfb2' : p.natural === 'water' ? '#9cc4dd' : p.leisure ? '#c4dfb0' : '#e3e0da';
        context.fill('evenodd');
        context.lineWidth = 1;
        context.strokeStyle = '#a3968a';
        if (rank({ properties: p }) === 3) context.stroke();
      }
    }
    return canvas.toDataURL('image/png').split(',')[1];
  }, { map, width, height });
}

/** A map, and the scene that it becomes. */
async function take_map(browser, server, { tile: [width, height], file }) {
  const text = fs.readFileSync(path.join(import.meta.dirname, 'pictures', file), 'utf8');
  const { request } = (await server.post('/v1/import?format=geojson', JSON.parse(text))).json;
  const page = await browser.newPage({ viewport: { width: width * 2, height: height * 2 }, colorScheme: 'light' });
  const flat = await draw_map(page, JSON.parse(text), [width, height]);
  await page.goto(`${server.url}/?stage&quality=high`);
  await until_state(page, 'ready');
  await until_shown(page, () => page.evaluate((hash) => { location.hash = hash; }, fragment_of(request)));
  await page.waitForTimeout(300);
  const shown = (await page.screenshot({ omitBackground: true })).toString('base64');
  await page.close();
  return [flat, shown];
}

/** A request that shows a texture: a tube with bark or leaves, or a wall. */
const wearing = (texture) => (walls.includes(texture)
  ? { generator: 'building', parameters: { rules: 'Lot --> material("wall") Wall.', size: [3, 3, 0.3], materials: { wall: { color: '#b8a58c', texture } } } }
  : { generator: 'lsystem', parameters: { axiom: 'F', productions: [], iterations: 0, materials: [{ texture }] } });

/** Each on a model, since a material that nothing wears is left out. */
async function take_sheet(server, { textures }) {
  const pngs = [];
  for (const texture of textures) {
    const answer = await server.post('/v1/generate', { ...wearing(texture), output: { format: 'gltf', textures: 256 } });
    const { buffers, bufferViews, images, materials, textures: made } = answer.json;
    const picture = images[made[materials[0].pbrMetallicRoughness.baseColorTexture.index].source];
    const { byteOffset = 0, byteLength } = bufferViews[picture.bufferView];
    pngs.push(Buffer.from(buffers[0].uri.split(',')[1], 'base64').subarray(byteOffset, byteOffset + byteLength).toString('base64'));
  }
  return pngs;
}

/** Tiles beside each other and in lines. */
async function join_tiles(page, pngs, { tile: [width, height], columns = pngs.length }) {
  const data = await page.evaluate(async ({ pngs, width, height, columns }) => {
    const canvas = Object.assign(document.createElement('canvas'), { width: width * columns, height: height * Math.ceil(pngs.length / columns) });
    const context = canvas.getContext('2d');
    context.imageSmoothingQuality = 'high';
    for (const [index, png] of pngs.entries()) {
      const image = new Image();
      image.src = `data:image/png;base64,${png}`;
      await image.decode();
      context.drawImage(image, (index % columns) * width, Math.floor(index / columns) * height, width, height);
    }
    return canvas.toDataURL('image/webp', 0.82).split(',')[1];
  }, { pngs, width, height, columns });
  return Buffer.from(data, 'base64');
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
  // Those of worlds are cut from the pictures of docs/worlds.md (tests/pictures/worlds.mjs).
  const worlds = { alien_plateaus: 'alien_plane', alpine: 'alpine_hill', archipelago: 'archipelago_plane', boreal_plain: 'boreal_hill', desert_oases: 'desert_plane', temperate_land: 'temperate_hill' };
  for (const [name, view] of Object.entries(worlds).filter(([name]) => chosen.includes(name)))
    fs.writeFileSync(path.join(thumbnails, `${name}.webp`), await sharp(path.join(pictures, `worlds/${view}.webp`)).resize(192, 144).webp({ quality: 80 }).toBuffer());
  for (const name of chosen.filter((each) => !(each in worlds))) {
    const { status, bytes: webp } = await server.get(`/v1/presets/${name}.webp?size=192x144`);
    if (status !== 200) throw new Error(`${name}: ${status}`);
    fs.writeFileSync(path.join(thumbnails, `${name}.webp`), webp);
    bytes += webp.length;
  }
  process.stdout.write(`${chosen.length} thumbnails, ${bytes} bytes, in web_client/public/thumbnails\n`);
  const shown = large.filter((name) => chosen.includes(name));
  await take(browser, server, shown, { width: 960, height: 640 }, async (name, png) => {
    fs.writeFileSync(path.join(pictures, `${name}.webp`), await to_webp(scaler, png, { width: 960, height: 640, quality: 0.82 }));
  });
  for (const [name, row] of Object.entries(rows)) {
    if (wanted.length > 0 && !wanted.includes(name)) continue;
    fs.writeFileSync(path.join(pictures, `${name}.webp`), await join_tiles(scaler, await take_row(browser, server, row), row));
    process.stdout.write(`${name} in docs/pictures\n`);
  }
  for (const [name, map] of Object.entries(maps)) {
    if (wanted.length > 0 && !wanted.includes(name)) continue;
    fs.writeFileSync(path.join(pictures, `${name}.webp`), await join_tiles(scaler, await take_map(browser, server, map), map));
    process.stdout.write(`${name} in docs/pictures\n`);
  }
  for (const [name, sheet] of Object.entries(sheets)) {
    if (wanted.length > 0 && !wanted.includes(name)) continue;
    fs.writeFileSync(path.join(pictures, `${name}.webp`), await join_tiles(scaler, await take_sheet(server, sheet), sheet));
    process.stdout.write(`${name} in docs/pictures\n`);
  }
  if (wanted.length === 0 || wanted.includes('textures')) {
    const { $defs } = JSON.parse(fs.readFileSync(path.join(root, 'api_schema/common.schema.json'), 'utf8'));
    const textures = [...$defs.texture.enum.filter((name) => name !== 'none'), ...walls];
    fs.mkdirSync(choices, { recursive: true });
    for (const [index, png] of (await take_sheet(server, { textures })).entries())
      fs.writeFileSync(path.join(choices, `${textures[index]}.webp`), await to_webp(scaler, Buffer.from(png, 'base64'), { width: 96, height: 96, quality: 0.7 }));
    process.stdout.write(`${textures.length} textures in web_client/public/textures\n`);
  }
  if (wanted.length === 0 || wanted.includes('page')) {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme: 'light' });
    const oak = (await server.get('/v1/presets/oak')).json;
    await page.goto(`${server.url}/?quality=high${fragment_of(oak)}.oak`);
    await until_state(page, 'ready');
    await page.click('#hint-away');
    await page.waitForTimeout(500);
    await page.waitForFunction(() => [...document.images].slice(0, 8).every((image) => image.complete));
    fs.writeFileSync(path.join(pictures, 'page.webp'), await to_webp(scaler, await page.screenshot(), { width: 1280, height: 800, quality: 0.85 }));
  }
  process.stdout.write(`${shown.length} pictures in docs/pictures\n`);
} finally {
  await browser.close();
  await server.stop();
}
