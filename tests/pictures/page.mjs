// Draws a model from a fixed camera: sun, sky, shadows, neutral tones. Runs in the browser.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const radians = (degrees) => (degrees * Math.PI) / 180;
let renderer;

function prepare([width, height]) {
  if (!renderer) {
    renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    document.body.append(renderer.domElement);
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.PCFSoftShadowMap;
  }
  renderer.setSize(width, height);
}

/** Adds the sun and the sky. With `near`, a point, there are shadows within 90 m of it alone, but sharper ones. */
function lights(scene, box, sun_of, near) {
  const { elevation, azimuth, strength, sky } = sun_of;
  const middle = near ? near.clone() : box.getCenter(new THREE.Vector3()), reach = near ? 90 : box.getSize(new THREE.Vector3()).length() / 2 || 1;
  const sun = new THREE.DirectionalLight(0xffffff, strength);
  const level = Math.cos(radians(elevation));
  const towards = new THREE.Vector3(level * Math.sin(radians(azimuth)), Math.sin(radians(elevation)), level * Math.cos(radians(azimuth)));
  sun.position.copy(middle).addScaledVector(towards, 3 * reach);
  sun.target.position.copy(middle);
  sun.castShadow = true;
  Object.assign(sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1 * reach, far: 8 * reach });
  sun.shadow.mapSize.set(4096, 4096);
  sun.shadow.bias = -0.0006;
  sun.shadow.normalBias = 0.002 * reach;
  scene.add(sun, sun.target, new THREE.HemisphereLight(0xffffff, 0x8a8a80, sky));
}

/** The height of the ground or the water at a point, below the plants. */
function ground_at(scene, x, z) {
  const hits = new THREE.Raycaster(new THREE.Vector3(x, 1e5, z), new THREE.Vector3(0, -1, 0)).intersectObject(scene, true);
  const ground = hits.find(({ object }) => /ground|terrain|water/.test(`${object.name} ${object.parent?.name}`));
  return ground?.point.y ?? 0;
}

const linear = (byte) => (byte <= 10 ? byte / 3294.6 : ((byte / 255 + 0.055) / 1.055) ** 2.4);

/** Luminance of the thirds of what is drawn, from top to bottom, without tone mapping. */
function thirds() {
  const { width, height } = renderer.domElement, gl = renderer.getContext(), data = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
  const rows = Array.from({ length: height }, (_, row) => row).filter((row) => {
    for (let x = 0; x < width; ++x) if (data[4 * (row * width + x) + 3] > 250) return true;
    return false;
  });
  const low = rows[0], high = rows.at(-1) + 1, parts = [0, 1, 2].map(() => ({ sum: 0, count: 0, black: 0 }));
  for (let row = low; row < high; ++row) {
    const part = parts[Math.min(2, Math.floor((3 * (high - 1 - row)) / (high - low)))];
    for (let x = 0; x < width; ++x) {
      const at = 4 * (row * width + x);
      if (data[at + 3] < 250) continue;
      const y = 0.2126 * linear(data[at]) + 0.7152 * linear(data[at + 1]) + 0.0722 * linear(data[at + 2]);
      part.sum += y;
      part.count += 1;
      part.black += y < 0.03 ? 1 : 0;
    }
  }
  return parts.map(({ sum, count, black }) => ({ luminance: sum / Math.max(count, 1), near_black: black / Math.max(count, 1) }));
}

/** Draws a view of the model at a URL. With `crown`, the model stands alone and its thirds are measured. */
window.draw = async (url, view, { size, sun }) => {
  prepare(size);
  const { scene: model } = await new GLTFLoader().loadAsync(url), scene = new THREE.Scene();
  scene.add(model);
  const sharpness = Math.min(8, renderer.capabilities.getMaxAnisotropy());
  model.traverse((each) => {
    each.castShadow = each.receiveShadow = true;
    for (const map of ['map', 'normalMap', 'roughnessMap', 'aoMap']) if (each.material?.[map]) each.material[map].anisotropy = sharpness;
  });
  const box = new THREE.Box3().setFromObject(model);
  // Positions of views of buildings count from the middle of the foot of the front.
  const from = view.front ? [(box.min.x + box.max.x) / 2, 0, box.max.z] : [0, 0, 0];
  const [ax, ay, az] = view.at.map((each, i) => each + from[i]), [tx, ty, tz] = view.to.map((each, i) => each + from[i]);
  const foot = view.above_ground ? ground_at(model, ax, az) : 0;
  const camera = new THREE.PerspectiveCamera(view.fov, size[0] / size[1], 0.05, 20_000);
  camera.position.set(ax, ay + foot, az);
  camera.lookAt(tx, ty + (view.above_ground ? foot : 0), tz);
  lights(scene, box, sun, view.above_ground && camera.position);
  let measured;
  if (view.crown) {
    renderer.toneMapping = THREE.NoToneMapping;
    renderer.render(scene, camera);
    measured = thirds();
  }
  if (!view.above_ground) {
    const ground = new THREE.Mesh(new THREE.CircleGeometry(400, 64), new THREE.MeshLambertMaterial({ color: 0x8c8f74 }));
    ground.rotation.x = -Math.PI / 2;
    ground.position.y = -0.002;
    ground.receiveShadow = true;
    scene.add(ground);
  }
  renderer.toneMapping = THREE.NeutralToneMapping;
  renderer.render(scene, camera);
  return { triangles: renderer.info.render.triangles, thirds: measured };
};

/** What is covered, and the mean luminance of that. */
function cover() {
  const { width, height } = renderer.domElement, gl = renderer.getContext(), data = new Uint8Array(4 * width * height), mask = new Uint8Array(width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
  let sum = 0, count = 0;
  for (let i = 0; i < mask.length; ++i) {
    if (data[4 * i + 3] < 128) continue;
    mask[i] = 1;
    ++count;
    sum += 0.2126 * linear(data[4 * i]) + 0.7152 * linear(data[4 * i + 1]) + 0.0722 * linear(data[4 * i + 2]);
  }
  return { mask, luminance: sum / Math.max(count, 1) };
}

/**
 * Draws levels of detail from three directions at the height of the middle. Returns for each level the overlap of its
 * outline with that of the level before and the quotient of their luminances, means over the directions.
 */
window.draw_levels = async (urls, { sun }, rows, keep) => {
  prepare([rows, rows]);
  renderer.toneMapping = THREE.NoToneMapping;
  const results = [], before = [];
  let box;
  for (const url of urls) {
    const { scene: model } = await new GLTFLoader().loadAsync(url), scene = new THREE.Scene();
    scene.add(model);
    model.traverse((each) => { each.castShadow = each.receiveShadow = true; });
    box ??= new THREE.Box3().setFromObject(model);
    lights(scene, box, sun);
    const middle = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3()), reach = size.length();
    const result = { overlap: 0, brightness: 0, image: null };
    [0, 2.1, 4.2].forEach((turn, i) => {
      const half = 0.52 * Math.max(size.y, Math.hypot(size.x, size.z) * 0.8);
      const camera = new THREE.OrthographicCamera(-half, half, half, -half, 0, 4 * reach);
      camera.position.set(middle.x + 2 * reach * Math.sin(turn), middle.y, middle.z + 2 * reach * Math.cos(turn));
      camera.lookAt(middle);
      renderer.render(scene, camera);
      const { mask, luminance } = cover();
      if (i === 0 && keep) result.image = renderer.domElement.toDataURL();
      if (before[i]) {
        let both = 0, either = 0;
        for (let k = 0; k < mask.length; ++k) { both += mask[k] & before[i].mask[k]; either += mask[k] | before[i].mask[k]; }
        result.overlap += both / either / 3;
        result.brightness += luminance / before[i].luminance / 3;
      }
      before[i] = { mask, luminance };
    });
    results.push(result);
  }
  return results;
};
window.ready = true;
