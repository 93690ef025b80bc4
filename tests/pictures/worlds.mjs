// Draws the pictures of docs/worlds.md from the page of a world: worlds.mjs [name...]. SEEDMESH_PROGRAM is the program that serves it.
// A height is above the ground at the place. Pictures are looked at by a person beside pictures of real landscapes.
import fs from 'node:fs';
import path from 'node:path';
import sharp from 'sharp';
import { launch } from '../browser/chromium.mjs';
import { serve } from '../http/support.mjs';

const folder = path.join(import.meta.dirname, '../../docs/pictures/worlds');
/** The camera that sees a point of the ground in its middle column, from `back` metres before it. */
const before = (world, [east, north], heading, back, above, pitch) => {
  const turn = heading * Math.PI / 180;
  return [world, Math.round(east - back * Math.sin(turn)), Math.round(north - back * Math.cos(turn)), above, heading, pitch];
};
/** name: world, east, north, metres above the ground, heading, pitch. Villages are those of the map. */
export const views = {
  temperate_ground: before('temperate_land.7', [10816, -4672], 60, 175, 5, 0),
  temperate_hill: before('temperate_land.7', [9152, 3904], 300, 620, 120, -9),
  temperate_plane: before('temperate_land.7', [9152, 3904], 330, 2600, 900, -17),
  temperate_orbit: ['temperate_land.7', 0, -20_000, 60_000, 0, -60],
  alpine_hill: before('alpine.3', [-3776, 4800], 120, 750, 160, -6),
  alpine_plane: before('alpine.3', [13312, 17408], 35, 7500, 500, -2),
  archipelago_plane: before('archipelago.5', [2752, -3520], 240, 2000, 600, -14),
  archipelago_orbit: ['archipelago.5', 0, -20_000, 70_000, 0, -65],
  desert_plane: before('desert_oases.4', [-9536, 4416], 110, 800, 240, -12),
  boreal_hill: before('boreal_plain.2', [-7872, -4928], 70, 520, 95, -8),
  boreal_plane: before('boreal_plain.2', [-7872, -4928], 160, 2400, 800, -16),
  town_ground: before('temperate_land.7', [-2240, -2624], 310, 300, 5, 0),
  town_hill: before('temperate_land.7', [-2240, -2624], 40, 520, 110, -10),
  town_plane: before('temperate_land.7', [-2240, -2624], 250, 1100, 500, -22),
  town_coast: before('archipelago.5', [-1472, -7872], 200, 650, 160, -11),
  town_desert: before('desert_oases.4', [8256, 9024], 60, 600, 180, -14),
  alien_plane: before('alien_plateaus.6', [10304, 2496], 330, 1800, 500, -13),
};

const wanted = process.argv.slice(2);
const server = await serve(process.env.SEEDMESH_PROGRAM, ['--threads', '2', '--log-level', 'error']), browser = await launch();
fs.mkdirSync(folder, { recursive: true });
try {
  for (const [name, [world, east, north, above, heading, pitch]] of Object.entries(views)) {
    if (wanted.length > 0 && !wanted.includes(name)) continue;
    const [preset, seed] = world.split('.');
    const { heights, sea_level = 0 } = (await server.post(`/v1/derive?box=${east - 16},${north - 16},${east + 16},${north + 16}`, { preset, seed: Number(seed) })).json;
    const up = Math.max(heights.values[Math.floor(heights.values.length / 2)], sea_level) + above;
    const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
    await page.goto(`${server.url}/world.html#${world}@${[east, north, up, heading, pitch]}`);
    await page.waitForFunction(() => ['ready', 'failed'].includes(document.body.dataset.state), null, { timeout: 400_000, polling: 500 });
    await page.evaluate(() => { for (const each of document.querySelectorAll('form, p, details, .sliders')) each.remove(); });
    const whole = await page.screenshot({ timeout: 120_000 });
    const png = await sharp(whole).resize(800, 450).png().toBuffer();
    let quality = 80, bytes;
    do bytes = await sharp(png).webp({ quality }).toBuffer(); while (bytes.length > 60_000 && (quality -= 8) > 20);
    fs.writeFileSync(path.join(folder, `${name}.webp`), bytes);
    if (process.env.SEEDMESH_PNG) fs.writeFileSync(path.join(process.env.SEEDMESH_PNG, `${name}.png`), whole);
    console.log(`${name}: ${bytes.length} bytes, world.html#${world}@${[east, north, Math.round(up), heading, pitch]}`);
    await page.close();
  }
} finally {
  await browser.close();
  await server.stop();
}
