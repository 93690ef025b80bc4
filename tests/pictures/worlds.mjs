// Draws the twelve pictures of docs/worlds.md from the page of a world: worlds.mjs [name...]. SEEDMESH_PROGRAM is the program that serves it.
// A height is above the ground at the place. Pictures are looked at by a person beside pictures of real landscapes.
import fs from 'node:fs';
import path from 'node:path';
import sharp from 'sharp';
import { launch, until_state } from '../browser/chromium.mjs';
import { serve } from '../http/support.mjs';

const folder = path.join(import.meta.dirname, '../../docs/pictures/worlds');
/** name: world, east, north, metres above the ground, heading, pitch */
export const views = {
  temperate_ground: ['temperate_land.7', 120, 60, 2, 40, 0],
  temperate_hill: ['temperate_land.7', -800, 400, 160, 300, -12],
  temperate_plane: ['temperate_land.7', 0, 0, 2500, 0, -25],
  temperate_orbit: ['temperate_land.7', 0, -20_000, 60_000, 0, -60],
  alpine_hill: ['alpine.3', 2000, 1000, 220, 120, -8],
  alpine_plane: ['alpine.3', 0, -4000, 3500, 20, -22],
  archipelago_plane: ['archipelago.5', 0, 0, 3000, 45, -25],
  archipelago_orbit: ['archipelago.5', 0, -20_000, 70_000, 0, -65],
  desert_plane: ['desert_oases.4', 0, 0, 900, 200, -15],
  boreal_hill: ['boreal_plain.2', 500, 500, 90, 70, -10],
  boreal_plane: ['boreal_plain.2', 0, 0, 2200, 160, -22],
  alien_plane: ['alien_plateaus.6', 0, 0, 1200, 330, -14],
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
    const page = await browser.newPage({ viewport: { width: 800, height: 450 } });
    await page.goto(`${server.url}/world.html#${world}@${[east, north, up, heading, pitch]}`);
    await until_state(page, 'ready', 'failed');
    await page.evaluate(() => { for (const each of document.querySelectorAll('form, p, details, .sliders')) each.remove(); });
    const png = await page.screenshot({ timeout: 120_000 });
    let quality = 80, bytes;
    do bytes = await sharp(png).webp({ quality }).toBuffer(); while (bytes.length > 60_000 && (quality -= 8) > 20);
    fs.writeFileSync(path.join(folder, `${name}.webp`), bytes);
    if (process.env.SEEDMESH_PNG) fs.writeFileSync(path.join(process.env.SEEDMESH_PNG, `${name}.png`), png);
    console.log(`${name}: ${bytes.length} bytes, world.html#${world}@${[east, north, Math.round(up), heading, pitch]}`);
    await page.close();
  }
} finally {
  await browser.close();
  await server.stop();
}
