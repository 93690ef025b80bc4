/**
 * The page of a world: streams its tiles from the service and moves a camera through them, in flight or on foot. The
 * address holds the world, a preset with a seed or the token of a request, and the camera:
 * #temperate_land.7@east,north,height,heading,pitch in metres and degrees, and ",walk" on foot.
 */
import './style/world.css';
import { MathUtils, Mesh, MeshStandardMaterial, type Object3D, PerspectiveCamera, Raycaster, Scene, Vector3, WebGLRenderer } from 'three';
import { TilesRenderer } from '3d-tiles-renderer';
import { get_preset, get_presets, get_schema, type Request } from './api';
import { fragment_of, unpack } from './link';
import { Daylight } from './world_light';
import { sliders } from './world_sliders';

interface Pose { east: number; north: number; height: number; heading: number; pitch: number; walks?: boolean }

const canvas = document.querySelector('canvas')!, form = document.querySelector('form')!, status = document.querySelector('p')!;
const presets = form.elements.namedItem('preset') as HTMLSelectElement, seed = form.elements.namedItem('seed') as HTMLInputElement;
const renderer = new WebGLRenderer({ canvas, antialias: true });

/** Whether the processor draws, because the browser uses no graphics card. */
function draws_on_processor(): boolean {
  const gl = renderer.getContext(), names = gl.getExtension('WEBGL_debug_renderer_info');
  return names !== null && /swiftshader|llvmpipe|software/i.test(String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)));
}
// Samples of a texture along the view, and metres from the camera to the middle of a tile whose tufts are shown.
const [sharpness, cover_reach] = draws_on_processor() ? [1, 70] : [8, 160];
const scene = new Scene(), camera = new PerspectiveCamera(60, 1, 2, 400_000), light = new Daylight(scene, renderer);
const held = new Set<string>();
/** The first view of a world: above its middle, towards the north. */
const start: Pose = { east: 0, north: 0, height: 2500, heading: 0, pitch: -25 };
const eyes = 1.7, pace = 6; // metres above the ground, and metres a second
const above_all = 100_000; // metres; no ground is as high
const walk_button = form.elements.namedItem('walk') as HTMLButtonElement, panel = document.querySelector<HTMLElement>('.sliders')!;
const ray = new Raycaster(), down = new Vector3(0, -1, 0);
let pose: Pose = { ...start }, tiles: TilesRenderer | null = null, name = '';

const state = (text: string, word: string): void => { status.textContent = text; document.body.dataset['state'] = word; };

function write_address(): void {
  const round = (value: number): string => String(Math.round(value * 10) / 10);
  history.replaceState(null, '', `#${name}@${[pose.east, pose.north, pose.height, pose.heading, pose.pitch].map(round).join(',')}${pose.walks ? ',walk' : ''}`);
}

/** The world and the pose of an address; null where it holds no world. */
function read_address(): { name: string; pose: Pose } | null {
  const [world = '', place = ''] = decodeURIComponent(location.hash.slice(1)).split('@');
  const [east, north, height, heading, pitch] = place.split(',').map(Number), walks = place.endsWith(',walk');
  if (!/^[\w-]+(\.\d+)?$/.test(world)) return null;
  const has_pose = place !== '' && [east, north, height, heading, pitch].every((value) => Number.isFinite(value));
  return { name: world, pose: has_pose ? { east: east!, north: north!, height: height!, heading: heading!, pitch: pitch!, walks } : { ...start } };
}

/** A rough surface without highlights: towards the sun those of leaves, bark and ground would be pale. Water keeps its own. */
function make_matte(part: Mesh): void {
  const { material } = part;
  if (!(material instanceof MeshStandardMaterial) || material.roughness < 0.8) return;
  material.onBeforeCompile = matte;
}
function matte(shader: { fragmentShader: string }): void {
  const lights = '#include <lights_physical_fragment>';
  shader.fragmentShader = shader.fragmentShader.replace(lights, `${lights}\nmaterial.specularColor = vec3(0.0);\nmaterial.specularColorBlended = vec3(0.0);\nmaterial.specularF90 = 0.0;`);
}

const cover = new Set<Mesh>(); // tufts, flowers and stones of the tiles that are loaded

/** Shows tufts, flowers and stones near the camera only: farther away they are smaller than a pixel or two, and cost most of a frame. */
function show_cover(): void {
  const at = new Vector3();
  for (const part of cover) part.visible = camera.position.distanceTo(at.setFromMatrixPosition(part.matrixWorld)) < cover_reach;
}

/** Feet stand on the ground, on roads and on water, and not on plants and roofs, which cast shadows. */
function prepare(model: Object3D): void {
  model.traverse((part) => {
    if (!(part instanceof Mesh)) return;
    part.receiveShadow = true;
    make_matte(part);
    for (const { map } of [part.material].flat() as MeshStandardMaterial[]) if (map) map.anisotropy = sharpness; // grounds are seen at low angles
    for (let above: Object3D | null = part; above; above = above.parent)
      if (/^terrain_(tufts|straw|flowers|stones)/.test(above.name)) { part.raycast = () => undefined; cover.add(part); return; }
      else if (/^(plants|buildings)/.test(above.name)) { part.raycast = () => undefined; part.castShadow = true; return; }
  });
}

/** Errors of tiles are of heights. Woods, fields and villages need finer tiles where the ground is flat. */
function add_detail(tile: { geometricError: number; boundingVolume: { box?: number[] } }): void {
  const half = tile.boundingVolume.box?.[3] ?? 0;
  if (tile.geometricError > 0 && half < 20_000) tile.geometricError = Math.max(tile.geometricError, half / 55);
}

/** The height of the ground below the camera; null while no tile is there. */
function ground(): number | null {
  if (!tiles) return null;
  ray.set(new Vector3(pose.east, above_all, -pose.north), down);
  return ray.intersectObject(tiles.group, true)[0]?.point.y ?? null;
}

/** The request behind a world's name. */
async function request_of(world: string): Promise<Request> {
  const [preset = '', number] = world.split('.');
  return number === undefined ? unpack(world) : { ...await get_preset(preset), seed: number };
}

/** Fills the panel for the world; a slider that is let go shows another world from the same place. */
async function show_sliders(world: string): Promise<void> {
  const [request, schema] = await Promise.all([request_of(world), get_schema('world')]);
  if (world !== name) return;
  seed.value = String(request.seed);
  panel.replaceChildren(...sliders(schema, request.parameters, (parameters) => {
    void fragment_of({ ...request, seed: seed.value, parameters }, null).then(show);
  }));
}

/** On foot or in flight. */
function set_walk(walks: boolean): void {
  pose.walks = walks;
  walk_button.setAttribute('aria-pressed', String(walks));
  write_address();
}

/** Streams the world of this name, `preset.seed` or a token. */
function show(world: string): void {
  name = world;
  if (tiles) { scene.remove(tiles.group); tiles.dispose(); }
  tiles = new TilesRenderer(`v1/worlds/${world}/tileset.json`);
  tiles.registerPlugin({ name: 'WORLD_DETAIL', preprocessNode: add_detail });
  tiles.setCamera(camera);
  tiles.group.rotation.x = -Math.PI / 2; // z up becomes y up
  tiles.addEventListener('load-error', ({ error }: { error: Error }) => state(`A file of the world cannot be loaded: ${error.message}`, 'failed'));
  tiles.addEventListener('load-model', ({ scene: model }) => { prepare(model); ground_age = Infinity; });
  tiles.addEventListener('dispose-model', ({ scene: model }) => model.traverse((part) => { if (part instanceof Mesh) cover.delete(part); }));
  scene.add(tiles.group);
  const [preset = '', number = ''] = world.split('.');
  presets.value = number ? preset : '';
  seed.value = number;
  void show_sliders(world).catch(() => panel.replaceChildren());
  state('Loading …', 'loading');
  resize();
  write_address();
}

function resize(): void {
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setSize(innerWidth, innerHeight, false);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
  tiles?.setResolutionFromRenderer(camera, renderer);
}

/** Moves the camera by the keys that are held. The speed grows with the height. */
function move(seconds: number): void {
  const below = pose.walks ? ground() : null;
  if (below !== null) pose.height = below + eyes;
  const axis = (plus: string, minus: string): number => Number(held.has(plus)) - Number(held.has(minus));
  const forward = axis('KeyW', 'KeyS') + axis('ArrowUp', 'ArrowDown'), right = axis('KeyD', 'KeyA') + axis('ArrowRight', 'ArrowLeft'), up = axis('KeyE', 'KeyQ');
  if (!forward && !right && !up) return;
  const step = seconds * (pose.walks ? pace : Math.max(20, Math.abs(pose.height))) * (held.has('ShiftLeft') ? 4 : 1), turn = MathUtils.degToRad(pose.heading);
  pose.east += step * (Math.sin(turn) * forward + Math.cos(turn) * right);
  pose.north += step * (Math.cos(turn) * forward - Math.sin(turn) * right);
  if (!pose.walks) pose.height += step * (up + (forward ? Math.tan(MathUtils.degToRad(pose.pitch)) * forward * 0.5 : 0));
  write_address();
}

/**
 * A near plane that grows with the height keeps water and land apart in the depth buffer. It stays before the ground, also where
 * that is high. Errors of tiles are of heights; from far above, coasts are seen instead, and they need finer tiles.
 */
function set_view(below: number): void {
  if (tiles) tiles.errorTarget = pose.walks ? 14 : 12 / (1 + Math.abs(pose.height) / 6000);
  const most = Math.max(0.3, (pose.height - below) / 6);
  const near = pose.walks ? 0.3 : Math.min(most, MathUtils.clamp(Math.abs(pose.height) / 100, 1, 1000));
  if (Math.abs(near / camera.near - 1) < 0.1) return;
  camera.near = near;
  camera.far = Math.max(400_000, 20 * Math.abs(pose.height));
  camera.updateProjectionMatrix();
}

let last = performance.now(), calm = 0, ground_below = 0, ground_age = Infinity; // frames since the ground was looked for

/** The ground below the camera, looked for again when tiles have come and from time to time. */
function ground_near(): number {
  if (++ground_age > 60) { ground_below = ground() ?? ground_below; ground_age = 0; }
  return ground_below;
}

function draw(now: number): void {
  move(Math.min(0.1, (now - last) / 1000));
  last = now;
  const below = ground_near();
  set_view(below);
  camera.position.set(pose.east, pose.height, -pose.north);
  camera.rotation.set(MathUtils.degToRad(pose.pitch), MathUtils.degToRad(-pose.heading), 0, 'YXZ');
  camera.updateMatrixWorld();
  tiles?.update();
  show_cover();
  light.follow(camera, below);
  renderer.render(scene, camera);
  const share = tiles?.root ? tiles.loadProgress : 0;
  calm = share === 1 ? calm + 1 : 0;
  if (document.body.dataset['state'] === 'failed' || !tiles) return;
  if (calm > 20) state(`${Math.round(pose.height)} m · ${tiles.visibleTiles.size} tiles · W A S D, Q E and dragging move the camera`, 'ready');
  else if (share < 1) state(`Loading … ${Math.round(100 * share)} %`, 'loading');
}

canvas.addEventListener('pointerdown', (event) => canvas.setPointerCapture(event.pointerId));
canvas.addEventListener('pointermove', (event) => {
  if (!canvas.hasPointerCapture(event.pointerId)) return;
  pose.heading = (pose.heading - event.movementX * 0.15 + 360) % 360;
  pose.pitch = MathUtils.clamp(pose.pitch + event.movementY * 0.15, -89, 89);
  write_address();
});
canvas.addEventListener('wheel', (event) => { if (!pose.walks) pose.height *= Math.exp(event.deltaY * 0.001); write_address(); }, { passive: true });
addEventListener('keydown', (event) => { if (!(event.target instanceof HTMLInputElement)) held.add(event.code); });
addEventListener('keyup', (event) => held.delete(event.code));
addEventListener('blur', () => held.clear());
addEventListener('resize', resize);
addEventListener('hashchange', () => { const at = read_address(); if (at) { pose = at.pose; set_walk(at.pose.walks === true); show(at.name); } });
walk_button.addEventListener('click', () => set_walk(!pose.walks));
form.addEventListener('submit', (event) => { event.preventDefault(); submit().catch((error: unknown) => state(String(error), 'failed')); });

/** Shows the chosen preset, or the world of the sliders, with the seed of the field. */
async function submit(): Promise<void> {
  show(presets.value ? `${presets.value}.${seed.value}` : await fragment_of({ ...await request_of(name), seed: seed.value }, null));
}

async function open(): Promise<void> {
  for (const { name: value, generator, title } of await get_presets()) if (generator === 'world') presets.add(new Option(title, value));
  const at = read_address() ?? { name: `${presets.options[0]?.value ?? ''}.7`, pose: { ...start } };
  pose = at.pose;
  show(at.name);
  set_walk(pose.walks === true);
  renderer.setAnimationLoop(draw);
}
void open().catch((error: unknown) => state(String(error), 'failed'));
