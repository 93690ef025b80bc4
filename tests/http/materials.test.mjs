// The members `specular` and `emission` of every generator reach the materials of its model.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { program, serve } from './support.mjs';

let server;
before(async () => { server = await serve(program); });
after(async () => { await server?.stop(); });

const specular = { color: '#ff8000', strength: 0.25 }, emission = { color: '#0080ff', strength: 3 };
const both = { specular, emission };
/** By IEC 61966-2-1: the linear value of an sRGB component. */
const linear = (byte) => { const c = byte / 255; return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; };
const near = (found, wanted) => found.forEach((value, i) => assert.ok(Math.abs(value - wanted[i]) < 1e-3, `${found} for ${wanted}`));

const square = [[0, 0], [8, 0], [8, 8], [0, 8]];
const requests = {
  'lsystem, a material': [{ generator: 'lsystem', parameters: { axiom: 'F', productions: [], iterations: 1, materials: [{ name: 'own', color: '#808080', ...both }] } }, ['own']],
  'building, a material': [{ generator: 'building', parameters: { rules: 'Lot --> extrude(3) color("#ffffff") material("own") A.', size: [8, 3, 8], materials: { own: both } } }, ['own']],
  'tree, bark and leaves': [{ preset: 'oak', parameters: { bark_specular: specular, bark_emission: emission, leaf: both } }, ['bark', 'leaf']],
  fractal: [{ preset: 'menger_sponge', parameters: both }, ['fractal']],
  'terrain, the ground': [{ generator: 'terrain', parameters: { size: 17, ...both } }, ['ground']],
  'terrain, the ground of a planet': [{ preset: 'planetoid', parameters: both }, ['ground']],
  'scene, ground, paths and areas': [{ generator: 'scene', parameters: {
    ground: { size: 40, ...both }, paths: [{ points: [[-9, -9], [9, -9]], ...both }], areas: [{ outline: [square], name: 'pond', ...both }], layers: [] } }, ['ground', 'path', 'pond']],
  'city, surfaces': [{ preset: 'grid_city', parameters: { surfaces: ['asphalt', 'junction', 'sidewalk', 'lot', 'marking'].map((name) => ({ name, ...both })) } }, ['asphalt', 'junction', 'sidewalk', 'lot', 'marking']],
};

for (const [title, [request, names]] of Object.entries(requests)) test(title, async () => {
  const reply = await server.post('/v1/generate', { ...request, output: { format: 'gltf', textures: 'none' } });
  assert.equal(reply.status, 200, reply.text.slice(0, 600));
  const { materials } = JSON.parse(reply.text);
  for (const name of names) {
    const made = materials.find((each) => each.name.includes(`_${name}_`));
    assert.ok(made, `${name} in ${materials.map((each) => each.name)}`);
    near(made.extensions.KHR_materials_specular.specularColorFactor, [1, linear(128), 0]);
    near([made.extensions.KHR_materials_specular.specularFactor, made.extensions.KHR_materials_emissive_strength.emissiveStrength * made.emissiveFactor[2]], [0.25, 3]);
  }
});

test('a surface that the city does not have is a warning, one that is given twice an error', async () => {
  const ask = (route, surfaces) => server.post(route, { preset: 'grid_city', parameters: { surfaces }, output: { format: 'gltf' } });
  const made = await ask('/v1/generate', [{ name: 'asphalt' }, { name: 'wall' }]);
  const { warnings } = JSON.parse(made.text).asset.extras;
  assert.deepEqual(warnings.map(({ pointer, message }) => [pointer, message]), [['/parameters/surfaces/1', 'this city has no surface "wall"']]);
  const { status, json } = await ask('/v1/validate', [{ name: 'asphalt' }, { name: 'lot' }, { name: 'asphalt', roughness: 0.5 }]);
  assert.deepEqual([status, json.errors.map(({ pointer, code }) => [pointer, code])], [422, [['/parameters/surfaces/2/name', 'duplicate_key']]]);
});
