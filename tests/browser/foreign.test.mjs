// Files of other programs on the page: maps, and rule files of CityEngine with their annotations as fields.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { drop, field, launch, open, open_parameters, program, request_of, serve, small_tree, fragment_of, until_shown } from './support.mjs';

let server, browser;
before(async () => { server = await serve(program); browser = await launch(); });
after(async () => { await browser?.close(); await server?.stop(); });

const now = (page) => request_of(new URL(page.url()).hash);
const says = (page, text) => page.waitForFunction((text) => document.getElementById('status').textContent.includes(text), text);

// Two houses of 20 m by 10 m near 11.5 degrees east, 48.1 degrees north.
const corners = [[11.5, 48.1], [11.50027, 48.1], [11.50027, 48.10009], [11.5, 48.10009]];
const geojson = JSON.stringify({ type: 'FeatureCollection', features: [0, 0.0005].map((shift) => ({
  type: 'Feature', properties: { building: 'house', height: 7, 'roof:shape': 'gabled' },
  geometry: { type: 'Polygon', coordinates: [[...corners, corners[0]].map(([east, north]) => [east + shift, north])] } })) });
const osm = `<?xml version="1.0"?><osm version="0.6">${corners.map(([east, north], i) => `<node id="${i + 1}" lon="${east}" lat="${north}"/>`).join('')}
<way id="9">${[1, 2, 3, 4, 1].map((id) => `<nd ref="${id}"/>`).join('')}<tag k="building" v="yes"/><tag k="building:levels" v="3"/></way></osm>`;

test('maps are opened as scenes', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of(small_tree)}`);
  for (const [name, text, format, count] of [['town.geojson', geojson, 'geojson', 2], ['town.osm', osm, 'osm', 1]]) {
    await until_shown(page, () => drop(page, name, text));
    await says(page, `${name} is imported from ${format}`);
    const request = now(page);
    assert.equal(request.generator, 'scene');
    assert.equal(request.parameters.buildings.length, count);
    assert.match(request.parameters.georeference.projection, /\+proj=tmerc/);
  }
  assert.deepEqual(page.errors, []);
});

const rules = `version "2019.0"
@Group("Mass", 1) @Order(2) @Range(min=3, max=30, stepsize=0.5) @Description("Up to the eaves.")
attr height = 9
@Order(1) @Enum("flat", "hip")
attr roof = "hip"
@Group("Look", 2) @Color
attr wall = "#ddccaa"
@Color
attr tiles = "DarkOrange"
@Hidden
attr secret = 4
attr lit = false
attr free = height / 3
Lot --> extrude(height) comp(f){ side : color(wall) Wall. | top : Top }
Top --> case roof == "hip" : roofHip(30) Roof. else : Roof.
`;

test('annotations of a rule file become fields', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/${fragment_of(small_tree)}`);
  await until_shown(page, () => drop(page, 'house.cga', rules));
  assert.equal(now(page).parameters.rules, rules);
  await open_parameters(page);
  const attribute = (name) => field(page, `/parameters/attributes/${name}`);
  await attribute('height').waitFor();
  const names = await page.locator('[data-pointer^="/parameters/attributes/"]').evaluateAll((all) => all.map((each) => each.dataset.pointer.split('/').at(-1)));
  assert.deepEqual(names, ['roof', 'height', 'wall', 'tiles', 'lit', 'free'], 'in the order of groups and @Order, without the hidden one');
  const number = attribute('height').locator('input[type=number], input[inputmode=decimal], input[type=text]').first();
  assert.equal(await number.inputValue(), '9');
  const slider = attribute('height').locator('input[type=range]');
  assert.deepEqual(await slider.evaluate((each) => [each.min, each.max, each.step]), ['3', '30', '0.5']);
  assert.deepEqual(await attribute('roof').locator('option').allTextContents(), ['flat', 'hip']);
  assert.equal(await attribute('wall').locator('input[type=color]').inputValue(), '#ddccaa');
  assert.equal(await attribute('tiles').locator('input[type=color]').inputValue(), '#ff8c00', 'the name of a colour of CSS');
  assert.equal(await attribute('tiles').locator('input[type=text]').inputValue(), 'DarkOrange');
  await number.fill('12');
  for (let turn = 0; turn < 200 && now(page).parameters.attributes === undefined; turn += 1) await page.waitForTimeout(50);
  assert.deepEqual(now(page).parameters.attributes, { height: 12 });
  assert.deepEqual(page.errors, []);
});
