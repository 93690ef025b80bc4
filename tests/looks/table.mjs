// node tests/looks/table.mjs PROGRAM: measures the table of docs/looks.md for a program, with seed 3. Works with every version
// of the program whose presets have these names, so that versions can be compared. Uses no code of the project.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { PNG } from 'pngjs';
import { albedo_range, area_of, box_of, coverage_by_level, each_triangle, hue_deviation, primitives_of, slopes_of, texel_densities } from './measure.mjs';

const program = process.argv[2], folder = fs.mkdtempSync(path.join(os.tmpdir(), 'looks-'));
const run = (...args) => execFileSync(program, args, { encoding: 'utf8', maxBuffer: 1 << 28 });
const made = new Map();

/** The bytes of a preset with a seed. */
function bytes_of(name, seed = 3, output = {}) {
  const preset = JSON.parse(run('presets', name)), request = path.join(folder, 'request.json'), model = path.join(folder, 'model.glb');
  fs.writeFileSync(request, JSON.stringify({ ...preset, seed, output: { ...preset.output, ...output } }));
  run('generate', request, '-o', model);
  return fs.readFileSync(model);
}
async function preset(name) {
  if (!made.has(name)) made.set(name, await primitives_of(bytes_of(name)));
  return made.get(name);
}
const is_bark = (each) => /bark/.test(each.material), is_leaf = (each) => each.is_cut;
const round = (x, digits = 2) => Number(x.toFixed(digits));
const row = (title, value) => console.log(`| ${title} | ${value} |`);
const at = (sorted, share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];

/** Ranges of real trees, 10 and 90 % quantiles: crown width by height, height by diameter, crown width by diameter. */
const real = {
  oak: [[0.51, 1.25], [14, 43], [13, 31]], birch: [[0.36, 0.9], [28, 69], [17, 39]], pine: [[0.33, 0.86], [19, 45], [11, 25]],
  spruce: [[0.27, 0.73], [30, 71], [14, 27]], maple: [[0.52, 1.12], [19, 50], [16, 34]], weeping_willow: [[0.43, 1.29], [12, 63], [10, 34]],
  cherry: [[0.59, 1.46], [12, 38], [13, 31]], poplar: [[0.09, 0.65], [21, 44], [3, 20]],
};

/** Diameter of the trunk at 1.3 m: the mean extent of the largest closed line in which the bark meets that height. */
function diameter(bark) {
  const parent = new Map(), place = new Map();
  const root = (key) => { while (parent.get(key) !== key) key = parent.get(key); return key; };
  each_triangle(bark, (corners) => {
    const p = corners.map((corner) => bark.at('POSITION', corner)), ends = [];
    for (let k = 0; k < 3; ++k) {
      const a = p[k], b = p[(k + 1) % 3], t = (1.3 - a[1]) / (b[1] - a[1]);
      if ((a[1] < 1.3) === (b[1] < 1.3)) continue;
      const at = [a[0] + t * (b[0] - a[0]), a[2] + t * (b[2] - a[2])], key = at.map((each) => Math.round(each * 1e4)).join();
      if (!parent.has(key)) parent.set(key, key);
      place.set(key, at);
      ends.push(key);
    }
    if (ends.length === 2) parent.set(root(ends[1]), root(ends[0]));
  });
  const lines = new Map();
  for (const [key, at] of place) lines.set(root(key), [...(lines.get(root(key)) ?? []), at]);
  const extent = (points, k) => Math.max(...points.map((each) => each[k])) - Math.min(...points.map((each) => each[k]));
  return Math.max(...[...lines.values()].map((points) => (extent(points, 0) + extent(points, 1)) / 2));
}

async function proportions() {
  const outside = [];
  for (const [name, ranges] of Object.entries(real)) {
    let bad = 0;
    for (let seed = 1; seed <= 20; ++seed) {
      const primitives = await primitives_of(bytes_of(name, seed, { textures: 'none' })), box = box_of(primitives);
      const height = box.high[1], width = (box.high[0] - box.low[0] + box.high[2] - box.low[2]) / 2, across = diameter(primitives.find(is_bark));
      const values = [width / height, height / across, width / across];
      if (values.some((value, i) => value < ranges[i][0] || value > ranges[i][1])) ++bad;
      if (process.env.VERBOSE) console.error(name, seed, height.toFixed(1), values.map((each) => round(each)).join(' '));
    }
    if (bad > 0) outside.push(`${name} ${bad}`);
  }
  row('proportions: trees of 20 seeds outside of the ranges', outside.join(', ') || 'none');
}

const broadleaf = ['oak', 'birch', 'maple', 'quaking_aspen', 'poplar', 'weeping_willow'], conifers = ['pine', 'spruce'];
async function leaves() {
  const area = [], low = [], hue = [], coverage = [];
  for (const name of [...broadleaf, ...conifers]) {
    const [leaf] = (await preset(name)).filter(is_leaf), box = box_of([leaf]), across = (box.high[0] - box.low[0] + box.high[2] - box.low[2]) / 2;
    const shares = coverage_by_level(leaf.color, leaf.cutoff, 6), sides = leaf.double_sided ? 1 : 2;
    area.push(`${name} ${round((area_of(leaf) * shares[0]) / sides / ((Math.PI / 4) * across ** 2), 1)}`);
    low.push(`${name} ${round(box.low[1])}`);
    hue.push(`${name} ${leaf.has('COLOR_0') ? round(hue_deviation(leaf, [0.1, 0.2, 0.05]), 1) : 0}`);
    coverage.push(`${name} ${Math.round(100 * Math.max(...shares.map((each) => Math.abs(each / shares[0] - 1))))}`);
  }
  row('leaf area index', area.join(', '));
  row('lowest leaf, m', low.join(', '));
  row('hue between leaves, degrees', hue.join(', '));
  row('coverage of mip levels, largest deviation in %', coverage.join(', '));
}

async function bark() {
  const ratio = [], density = [], slope = [];
  for (const name of [...broadleaf, ...conifers, 'cherry', 'palm']) {
    const [own] = (await preset(name)).filter(is_bark), list = texel_densities(own), all = list.reduce((sum, each) => sum + each.area, 0);
    const quantile = (share) => { let sum = 0; for (const each of list) if ((sum += each.area) >= share * all) return each.density; return list.at(-1).density; };
    ratio.push(`${name} ${round(quantile(0.95) / quantile(0.05), 1)}`);
    density.push(`${name} ${Math.round(quantile(0.05))}`);
    const { mean, p95 } = slopes_of(own.normal);
    slope.push(`${name} ${Math.round(mean)}/${Math.round(p95)}`);
  }
  row('bark, p95/p5 of texels a metre by area', ratio.join(', '));
  row('bark, p5 of texels a metre', density.join(', '));
  row('bark, slopes of normals: mean/p95 in degrees', slope.join(', '));
}

/** In-place fast Fourier transform of rows and columns of a square image. */
function spectrum(values, size) {
  const re = Float64Array.from(values), im = new Float64Array(size * size);
  const pass = (first, step) => {
    for (let i = 1, j = 0; i < size; ++i) {
      let bit = size >> 1;
      for (; j & bit; bit >>= 1) j ^= bit;
      j ^= bit;
      if (i < j) for (const part of [re, im]) [part[first + i * step], part[first + j * step]] = [part[first + j * step], part[first + i * step]];
    }
    for (let span = 2; span <= size; span *= 2) {
      for (let i = 0; i < size; i += span) {
        for (let k = 0; k < span / 2; ++k) {
          const turn = (-2 * Math.PI * k) / span, c = Math.cos(turn), s = Math.sin(turn), a = first + (i + k) * step, b = a + (span / 2) * step;
          const x = re[b] * c - im[b] * s, y = re[b] * s + im[b] * c;
          re[b] = re[a] - x; im[b] = im[a] - y; re[a] += x; im[a] += y;
        }
      }
    }
  };
  for (let i = 0; i < size; ++i) pass(i * size, 1);
  for (let i = 0; i < size; ++i) pass(i, size);
  return re.map((each, i) => each * each + im[i] * im[i]);
}

const linear = (byte) => (byte <= 10 ? byte / 3294.6 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
/** Shares of the variance of luminance at up to 4 cycles and from 64 cycles an image. */
function variance_shares(picture) {
  const size = picture.width, power = spectrum(Array.from({ length: size * size }, (_, i) => 0.2126 * linear(picture.data[4 * i]) + 0.7152 * linear(picture.data[4 * i + 1]) + 0.0722 * linear(picture.data[4 * i + 2])), size);
  let low = 0, high = 0, all = 0;
  for (let y = 0; y < size; ++y) for (let x = 0; x < size; ++x) {
    const cycles = Math.hypot(Math.min(x, size - x), Math.min(y, size - y));
    if (cycles === 0) continue;
    all += power[y * size + x];
    if (cycles <= 4) low += power[y * size + x];
    if (cycles >= 64) high += power[y * size + x];
  }
  return { low: low / all, high: high / all };
}

async function pictures() {
  const low = [], high = [], rough = [], seen = new Set();
  const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);
  for (const name of ['oak', 'maple', 'pine', 'spruce', 'weeping_willow', 'birch', 'cherry', 'house', 'terraced_house', 'warehouse', 'villa']) {
    const document = await io.readBinary(new Uint8Array(bytes_of(name)));
    for (const material of document.getRoot().listMaterials()) {
      const title = material.getName().replace(/^.*?_(?=bark|plaster|slate|roof|brick|stone|cladding)/, '').replace(/_[a-f][0-9a-f]{7}$/, '');
      const label = /bark/.test(title) ? `${name} bark` : title, image = material.getBaseColorTexture()?.getImage();
      if (!image || !/bark|plaster|slate|roof|brick/.test(title) || seen.has(label)) continue;
      seen.add(label);
      const shares = variance_shares(PNG.sync.read(Buffer.from(image)));
      low.push(`${label} ${round(shares.low)}`);
      high.push(`${label} ${round(shares.high)}`);
      const surface = material.getMetallicRoughnessTexture()?.getImage();
      if (!surface) continue;
      const picture = PNG.sync.read(Buffer.from(surface)), values = [];
      for (let i = 1; i < picture.data.length; i += 4) values.push(picture.data[i] / 255);
      values.sort((a, b) => a - b);
      rough.push(`${label} ${round((at(values, 0.99) - at(values, 0.01)) * material.getRoughnessFactor())}`);
    }
  }
  row('low share of variance', low.join(', '));
  row('high share of variance', high.join(', '));
  row('span of roughness, p1 to p99', rough.join(', '));
}

async function albedo() {
  const list = [];
  for (const name of [...broadleaf, ...conifers]) for (const each of await preset(name)) list.push(`${name} ${is_bark(each) ? 'bark' : 'leaf'} ${round(albedo_range(each).mean)}`);
  for (const name of ['alps', 'snowfield', 'island', 'house']) for (const each of await preset(name)) if (/snow|water|frame|wall|plaster/.test(each.material)) list.push(`${each.material.replace(/_[a-f][0-9a-f]{7}$/, '')} ${round(albedo_range(each).mean)}`);
  row('albedo', list.join(', '));
}

async function buildings() {
  const bare = [], density = [];
  for (const name of ['house', 'terraced_house', 'villa', 'church', 'factory', 'warehouse', 'temple', 'parisian_block', 'office_tower', 'skyscraper']) {
    let all = 0, without = 0;
    const list = [];
    for (const each of (await preset(name)).filter(({ material }) => !/glass|metal|steel|door|joinery|grime/.test(material))) {
      const area = area_of(each);
      all += area;
      if (each.color) list.push(...texel_densities(each));
      else without += area;
    }
    list.sort((a, b) => a.density - b.density);
    bare.push(`${name} ${round((100 * without) / all, 0)}`);
    density.push(`${name} ${list.length > 0 ? Math.round(at(list, 0.05).density) : 0}`);
  }
  row('area without a texture, %', bare.join(', '));
  row('walls, p5 of texels a metre', density.join(', '));
  const block = new Set((await preset('parisian_block')).map(({ material }) => material));
  row('different glasses, frames, doors of parisian_block', ['glass', 'frame', 'door'].map((part) => [...block].filter((each) => new RegExp(`(^|_)${part}(_|$)`).test(each)).length).join(', '));
}

/** The foremost depth along z, in mm, with much of the area of faces to the front, for the materials of a pattern. */
function front_plane(primitives, pattern) {
  const area_at = new Map();
  for (const each of primitives.filter(({ material }) => pattern.test(material))) {
    each_triangle(each, (corners, area) => {
      const [a, b, c] = corners.map((corner) => each.at('POSITION', corner)), u = b.map((x, k) => x - a[k]), v = c.map((x, k) => x - a[k]);
      if ((u[0] * v[1] - u[1] * v[0]) / (2 * area) < 0.99) return;
      const depth = Math.round(1000 * a[2]);
      area_at.set(depth, (area_at.get(depth) ?? 0) + area);
    });
  }
  const most = Math.max(...area_at.values());
  return Math.max(...[...area_at].filter(([, area]) => area >= 0.2 * most).map(([depth]) => depth));
}

async function windows() {
  const frames = [], glasses = [];
  for (const name of ['house', 'villa', 'factory', 'warehouse', 'parisian_block']) {
    const all = await preset(name), wall = front_plane(all, /plaster|wall|brick|stone|cladding/);
    frames.push(`${name} ${wall - front_plane(all, /(^|_)frame/)}`);
    glasses.push(`${name} ${wall - front_plane(all, /(^|_)glass/)}`);
  }
  row('plane of the wall minus that of frames, mm', frames.join(', '));
  row('plane of the wall minus that of glass, mm', glasses.join(', '));
}

/** The heights of a terrain as a grid: vertices of all grounds by their position. */
async function grid_of(name) {
  const grounds = (await preset(name)).filter(({ material }) => !/water/.test(material)), box = box_of(grounds);
  const xs = new Set();
  for (const each of grounds) for (let i = 0; i < each.vertices; ++i) xs.add(Math.round(each.at('POSITION', i)[0] * 100));
  const size = xs.size, step = (box.high[0] - box.low[0]) / (size - 1), height = new Float64Array(size * size).fill(NaN);
  for (const each of grounds) for (let i = 0; i < each.vertices; ++i) {
    const [x, y, z] = each.at('POSITION', i), column = Math.round((x - box.low[0]) / step), line = Math.round((z - box.low[2]) / step);
    const cell = line * size + column;
    height[cell] = Number.isNaN(height[cell]) ? y : Math.max(height[cell], y);
  }
  return { size, step, height };
}

async function lands() {
  const steep = [], pits = [], dunes = [], textured = [];
  for (const name of ['alps', 'island', 'river_valleys', 'mesas', 'ridges', 'dunes']) {
    const { size, step, height } = await grid_of(name), h = (x, y) => height[y * size + x], slopes = [];
    let pit = 0;
    for (let y = 1; y < size - 1; ++y) for (let x = 1; x < size - 1; ++x) {
      slopes.push((Math.atan(Math.hypot(h(x + 1, y) - h(x - 1, y), h(x, y + 1) - h(x, y - 1)) / (2 * step)) * 180) / Math.PI);
      let is_pit = true;
      for (let dy = -1; dy <= 1; ++dy) for (let dx = -1; dx <= 1; ++dx) if ((dx || dy) && h(x + dx, y + dy) <= h(x, y)) is_pit = false;
      pit += is_pit ? 1 : 0;
    }
    steep.push(`${name} ${round(slopes.filter((each) => each > 35).length / slopes.length)}`);
    pits.push(`${name} ${round((100 * pit) / slopes.length, 1)}`);
    if (name === 'dunes') dunes.push(round((100 * slopes.filter((each) => each >= 30 && each <= 34).length) / slopes.length, 1));
    const own = (await preset(name)).filter(({ material }) => !/water/.test(material)), textures = own.filter((each) => each.color && each.normal);
    textured.push(`${name} ${textures.length === 0 ? 'no textures' : `${Math.round(at(textures.flatMap(texel_densities).sort((a, b) => a.density - b.density), 0.5).density)} texels/m`} (step ${round(step, 1)} m)`);
  }
  row('land steeper than 35 degrees, share', steep.join(', '));
  row('land, local minima in %', pits.join(', '));
  row('dunes: cells at 30 to 34 degrees, %', dunes.join(', '));
  row('ground at eye level', textured.join(', '));
}

for (const part of process.argv.length > 3 ? process.argv.slice(3) : ['proportions', 'leaves', 'bark', 'pictures', 'albedo', 'buildings', 'windows', 'lands'])
  await { proportions, leaves, bark, pictures, albedo, buildings, windows, lands }[part]();
fs.rmSync(folder, { recursive: true });
