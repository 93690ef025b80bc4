// Draws a model from a fixed camera: sun, sky with its reflections, shadows, neutral tones. Runs in the browser.
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

/** The direction towards the sun. */
function towards_sun({ elevation, azimuth }) {
  const level = Math.cos(radians(elevation));
  return new THREE.Vector3(level * Math.sin(radians(azimuth)), Math.sin(radians(elevation)), level * Math.cos(radians(azimuth)));
}

/** Adds the sun. It has a shadow around the box. */
function add_sun(scene, box, sun_of) {
  const middle = box.getCenter(new THREE.Vector3()), reach = box.getSize(new THREE.Vector3()).length() / 2 || 1;
  const sun = new THREE.DirectionalLight(0xfffaf2, sun_of.strength);
  sun.position.copy(middle).addScaledVector(towards_sun(sun_of), 3 * reach);
  sun.target.position.copy(middle);
  sun.castShadow = true;
  Object.assign(sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1 * reach, far: 8 * reach });
  sun.shadow.mapSize.set(4096, 4096);
  sun.shadow.bias = -0.0006;
  sun.shadow.normalBias = 0.002 * reach;
  scene.add(sun, sun.target);
}

/** Light of sun and sky for measurements: the sky is a hemisphere of one colour, and nothing is reflected. */
function lights(scene, box, sun_of) {
  add_sun(scene, box, sun_of);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8a80, sun_of.sky));
}

/** Radiance of the sky, up to a factor: bright and pale at the horizon and around the sun, blue at the zenith (Preetham 1999, simplified). */
function sky_radiance(direction, sun) {
  const height = Math.max(direction.y, 0), pale = Math.exp(-5 * height), angle = Math.acos(Math.min(1, direction.dot(sun)));
  const glow = 1 + 0.9 * Math.exp(-3 * angle);
  return [[0.42, 0.86], [0.55, 0.9], [0.78, 0.95]].map(([zenith, horizon]) => glow * (zenith + (horizon - zenith) * pale));
}

/**
 * The surroundings as an equirectangular image of radiance: the sky lights level ground with `sky`, and sunlit ground reflects
 * a fifth of its light. The sun itself is a light of its own.
 */
function surroundings(sun_of) {
  const width = 256, height = 128, data = new Float32Array(4 * width * height), sun = towards_sun(sun_of), direction = new THREE.Vector3();
  const ground = [0.21, 0.2, 0.16].map((albedo) => (albedo * (sun_of.strength * sun.y + sun_of.sky)) / Math.PI);
  let irradiance = 0;
  const at = (x, y) => {
    const polar = (Math.PI * (y + 0.5)) / height - Math.PI / 2, turn = 2 * Math.PI * ((x + 0.5) / width - 0.5);
    return direction.set(Math.cos(polar) * Math.cos(turn), Math.sin(polar), Math.cos(polar) * Math.sin(turn));
  };
  const cell = (2 * Math.PI * Math.PI) / (width * height);
  for (let y = height / 2; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const [r, g, b] = sky_radiance(at(x, y), sun);
      irradiance += (0.2126 * r + 0.7152 * g + 0.0722 * b) * direction.y * Math.sqrt(1 - direction.y ** 2) * cell;
    }
  }
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const color = y < height / 2 ? ground : sky_radiance(at(x, y), sun).map((each) => (each * sun_of.sky) / irradiance);
      data.set([...color, 1], 4 * (y * width + x));
    }
  }
  const image = new THREE.DataTexture(data, width, height, THREE.RGBAFormat, THREE.FloatType);
  image.mapping = THREE.EquirectangularReflectionMapping;
  image.magFilter = image.minFilter = THREE.LinearFilter;
  image.needsUpdate = true;
  return image;
}

/** Lights a scene with sun and surroundings, as engines do, and shows the sky. */
function light_with_sky(scene, box, sun_of) {
  add_sun(scene, box, sun_of);
  const image = surroundings(sun_of), generator = new THREE.PMREMGenerator(renderer);
  scene.environment = generator.fromEquirectangular(image).texture;
  scene.background = image;
  generator.dispose();
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

/** Draws a view of the model at a URL. With `crown`, the thirds of the model alone are measured before. */
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
  let measured;
  if (view.crown) {
    const alone = new THREE.Scene();
    alone.add(model);
    lights(alone, box, sun);
    renderer.toneMapping = THREE.NoToneMapping;
    renderer.render(alone, camera);
    measured = thirds();
    scene.add(model);
  }
  // On land, shadows are those around the camera, which would be coarse over the whole land.
  const around = new THREE.Box3().setFromCenterAndSize(camera.position, new THREE.Vector3(100, 100, 100));
  light_with_sky(scene, view.above_ground ? around : box, sun);
  if (!view.above_ground) {
    const ground = new THREE.Mesh(new THREE.CircleGeometry(400, 64), new THREE.MeshLambertMaterial({ color: 0x8c8f74 }));
    ground.rotation.x = -Math.PI / 2;
    ground.position.y = -0.002;
    ground.receiveShadow = true;
    scene.add(ground);
  }
  renderer.toneMapping = THREE.NeutralToneMapping;
  renderer.toneMappingExposure = 1.6;
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
