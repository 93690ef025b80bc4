// Checks the files of a world, wherever they come from: `get(path)` answers the bytes of a path below the world's folder.
// Faults are sentences; a sound world has none. tests/http/world_checker.test.mjs breaks worlds on purpose.

const sizes = { 5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const widths = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

/** The JSON and the binary part of a GLB. */
export function parts_of(glb) {
  const size = glb.readUInt32LE(12);
  return { json: JSON.parse(glb.subarray(20, 20 + size)), bin: glb.subarray(28 + size) };
}

function values_of(json, buffers, index) {
  const { bufferView, byteOffset = 0, componentType, count, type } = json.accessors[index];
  const view = json.bufferViews[bufferView], width = widths[type], Kind = sizes[componentType];
  const stride = view.byteStride ?? width * Kind.BYTES_PER_ELEMENT, bytes = buffers[view.buffer];
  const values = new Float64Array(count * width);
  for (let n = 0; n < count; ++n) {
    const from = (view.byteOffset ?? 0) + byteOffset + n * stride;
    const one = new Kind(Uint8Array.from(bytes.subarray(from, from + width * Kind.BYTES_PER_ELEMENT)).buffer);
    for (let k = 0; k < width; ++k) values[n * width + k] = one[k];
  }
  return values;
}

/** A tile as a client shows it: vertices of each layer as [east, north, up], and the feet of plants. */
export async function read_tile(get, level, x, y) {
  const path = `c/${level}/${x}/${y}.glb`, { json, bin } = parts_of(await get(path));
  const buffers = await Promise.all(json.buffers.map(({ uri }) => (uri ? get(new URL(uri, `http://w/${path}`).pathname.slice(1)) : bin)));
  const tile = { level, x, y, layers: new Map(), feet: [], normals: [], step: 0, terrain: [] };
  const [root] = json.nodes;
  for (const node of json.nodes.slice(1)) {
    const layer = node.name.split('_')[0], at = node.translation ?? [0, 0, 0], scale = node.scale ?? [1, 1, 1];
    const list = tile.layers.get(layer) ?? tile.layers.set(layer, []).get(layer);
    for (const { attributes, indices } of json.meshes[node.mesh].primitives) {
      const points = values_of(json, buffers, attributes.POSITION), copies = node.extensions?.EXT_mesh_gpu_instancing?.attributes;
      const moves = copies ? values_of(json, buffers, copies.TRANSLATION) : [0, 0, 0], grows = copies ? values_of(json, buffers, copies.SCALE) : [1, 1, 1];
      for (let c = 0; c < moves.length; c += 3) {
        if (layer === 'plants' && copies) tile.feet.push([root.translation[0] + moves[c], -(root.translation[2] + moves[c + 2]), moves[c + 1]]);
        if (copies?.ROTATION !== undefined) continue; // turned copies are checked by their middle alone
        for (let n = 0; n < points.length; n += 3) {
          const p = [0, 1, 2].map((k) => points[n + k] * scale[k] * grows[c + k] + moves[c + k] + at[k] + root.translation[k]);
          list.push([p[0], -p[2], p[1]]);
        }
      }
      if (layer !== 'terrain') continue;
      tile.step = scale[1];
      tile.terrain = list;
      tile.normals = values_of(json, buffers, attributes.NORMAL);
      tile.indices = values_of(json, buffers, indices);
    }
  }
  return tile;
}

/** Highest and lowest vertex of each position of the terrain, and the normal of the highest. */
function samples_of(tile) {
  const samples = new Map();
  tile.terrain.forEach(([e, n, up], k) => {
    const key = `${e} ${n}`, known = samples.get(key);
    if (!known) samples.set(key, { e, n, top: up, low: up, normal: String(tile.normals.slice(3 * k, 3 * k + 3)) });
    else if (up > known.top) Object.assign(known, { top: up, normal: String(tile.normals.slice(3 * k, 3 * k + 3)) });
    else known.low = Math.min(known.low, up);
  });
  return samples;
}

const name_of = ({ level, x, y }) => `${level}/${x}/${y}`;
const corners_of = ([x, y, z, a, , , , b, , , , c]) => ({ low: [x - a, y - b, z - c], high: [x + a, y + b, z + c] });

/** Vertices outside of the tile's box. */
export function box_faults(tile, box) {
  const { low, high } = corners_of(box);
  for (const [layer, points] of tile.layers) {
    const outside = points.find((p) => p.some((v, k) => v < low[k] - 1e-9 || v > high[k] + 1e-9));
    if (outside) return [`${name_of(tile)}: a vertex of ${layer} at ${outside} is outside of the box from ${low} to ${high}`];
  }
  return [];
}

/** Two neighbours of one level have the same border. */
export function border_faults(a, b) {
  const twins = samples_of(b), axis = b.x === a.x + 1 ? 'e' : 'n', faults = [];
  const line = Math.max(...[...samples_of(a).values()].map((s) => s[axis]));
  let count = 0;
  for (const [key, s] of samples_of(a)) {
    if (s[axis] !== line) continue;
    ++count;
    const twin = twins.get(key);
    if (!twin || twin.top !== s.top || twin.normal !== s.normal) faults.push(`${name_of(a)} and ${name_of(b)} differ at ${key}`);
  }
  if (count !== 33 && count !== 65) faults.push(`${name_of(a)} has ${count} samples at its border`);
  return faults;
}

/** Samples that a tile shares with one above have one height, but for rounding. */
export function shared_faults(coarse, fine) {
  const twins = samples_of(fine), faults = [];
  let count = 0;
  for (const [key, s] of samples_of(coarse)) {
    const twin = twins.get(key);
    if (!twin) continue;
    ++count;
    if (Math.abs(twin.top - s.top) > (coarse.step + fine.step) / 2) faults.push(`${name_of(coarse)} and ${name_of(fine)}: heights ${s.top} and ${twin.top} at ${key}`);
  }
  if (count === 0) faults.push(`${name_of(coarse)} and ${name_of(fine)} share no sample`);
  return faults;
}

/** The height of the coarse terrain below each sample of the fine one, along squares with a diagonal from south-west to north-east. */
function heights_below(coarse, fine) {
  const samples = samples_of(coarse), east = [...new Set([...samples.values()].map((s) => s.e))].sort((a, b) => a - b);
  const spacing = east[1] - east[0], north = Math.min(...[...samples.values()].map((s) => s.n)), pairs = [];
  for (const s of samples_of(fine).values()) {
    const x = east[0] + Math.floor((s.e - east[0]) / spacing) * spacing, y = north + Math.floor((s.n - north) / spacing) * spacing;
    const at = (dx, dy) => samples.get(`${x + dx} ${y + dy}`)?.top;
    const u = (s.e - x) / spacing, v = (s.n - y) / spacing, a = at(0, 0), d = at(spacing, spacing), c = u >= v ? at(spacing, 0) : at(0, spacing);
    if ([a, c, d].includes(undefined)) continue;
    const [slope_e, slope_n] = u >= v ? [c - a, d - c] : [d - c, c - a];
    pairs.push({ s, below: a + u * slope_e + v * slope_n, steepness: Math.hypot(1, slope_e / spacing, slope_n / spacing) });
  }
  return pairs;
}

/** The declared error is at least the distance of the finer terrain. */
export function error_faults(coarse, fine, declared) {
  const off = Math.max(0, ...heights_below(coarse, fine).map(({ s, below, steepness }) => Math.abs(s.top - below) / steepness));
  return off > declared + 1e-6 ? [`${name_of(coarse)} declares an error of ${declared} m and is ${off} m from ${name_of(fine)}`] : [];
}

/** Where a fine tile lies beside a coarse one, the skirt of the higher one reaches the lower one. `fine` lies east or west of `coarse`. */
export function skirt_faults(coarse, fine) {
  const own = samples_of(coarse), its = [...samples_of(fine).values()], lines = new Set([...own.values()].map((s) => s.e));
  const line = Math.max(...its.map((s) => s.e)) <= Math.min(...lines) ? Math.min(...lines) : Math.max(...lines);
  const edge = [...own.values()].filter((s) => s.e === line).sort((a, b) => a.n - b.n), faults = [];
  for (const s of its.filter((each) => each.e === line)) {
    const k = Math.max(1, edge.findIndex((each) => each.n >= s.n)), [a, b] = [edge[k - 1], edge[k]];
    if (!a || !b) continue;
    const t = (s.n - a.n) / (b.n - a.n), top = a.top + t * (b.top - a.top), low = a.low + t * (b.low - a.low);
    if (s.top > top ? s.low > top : low > s.top) faults.push(`a gap between ${name_of(coarse)} and ${name_of(fine)} at ${s.e} ${s.n}`);
  }
  return faults;
}

/** The tree of a tileset: boxes inside boxes, errors that fall to 0 at the leaves, one content each. */
export function tileset_faults(json, last_level) {
  const faults = [];
  if (json.asset?.version !== '1.1') faults.push('the version is not 1.1');
  const visit = (tile, above) => {
    const uri = tile.content?.uri ?? '', level = Number(/[ce]\/(\d+)\/\d+\/\d+\.(glb|json)$/.exec(uri)?.[1]);
    if (!Number.isInteger(level)) { faults.push(`the content ${uri} is no tile`); return; }
    if (uri.includes('?')) faults.push(`${uri} has a query`);
    if (above) {
      const outer = corners_of(above.boundingVolume.box), inner = corners_of(tile.boundingVolume.box);
      if ([0, 1, 2].some((k) => inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k])) faults.push(`the box of ${uri} leaves the box above`);
      if (tile.geometricError >= above.geometricError) faults.push(`the error of ${uri} does not fall`);
    }
    if (level === last_level && tile.geometricError !== 0) faults.push(`the leaf ${uri} has an error`);
    for (const child of tile.children ?? []) visit(child, tile);
  };
  visit(json.root, null);
  return faults;
}

/** A subtree that is full: its bits, and no child below the last level. */
export function subtree_faults(bytes, levels, is_last) {
  if (bytes.subarray(0, 4).toString('latin1') !== 'subt' || bytes.readUInt32LE(4) !== 1) return ['no binary subtree of version 1'];
  const size = Number(bytes.readBigUInt64LE(8)), rest = Number(bytes.readBigUInt64LE(16)), faults = [];
  if (size % 8 || rest % 8 || bytes.length !== 24 + size + rest) faults.push('the chunks are not padded to 8 bytes');
  const json = JSON.parse(bytes.subarray(24, 24 + size)), chunk = bytes.subarray(24 + size), tiles = (4 ** levels - 1) / 3;
  const full = ({ constant, bitstream }) => {
    if (constant !== undefined) return constant === 1;
    const { byteOffset = 0, byteLength } = json.bufferViews[bitstream];
    const bit = (k) => chunk[byteOffset + (k >> 3)] >> (k & 7) & 1;
    return Array.from({ length: 8 * byteLength }, (_, k) => bit(k) === (k < tiles ? 1 : 0)).every(Boolean);
  };
  if (!json.tileAvailability || !full(json.tileAvailability)) faults.push('not all tiles are available, or bits after the last are set');
  if (json.contentAvailability?.length !== 1 || !full(json.contentAvailability[0])) faults.push('there is no contentAvailability for all tiles');
  if (json.childSubtreeAvailability?.constant !== (is_last ? 0 : 1)) faults.push('wrong availability of child subtrees');
  return faults;
}

const run = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

/** Rivers fall and end in water, roads are not steep, plants keep their distance. */
export function map_faults({ sea_level, rivers, lakes, roads, plants }) {
  const faults = [], ids = new Set([...rivers, ...lakes].map(({ id }) => id));
  for (const { id, into, points } of rivers) {
    if (points.some((p, k) => k > 0 && p[2] > points[k - 1][2])) faults.push(`river ${id} climbs`);
    if (into === 'sea' ? sea_level === null || points.at(-1)[2] > sea_level + 0.05 : !ids.has(into)) faults.push(`river ${id} ends in no water`);
  }
  for (const { id, points } of roads) {
    let length = 0, steep = 0;
    points.forEach((p, k) => {
      if (k === 0) return;
      const part = run(p, points[k - 1]);
      length += part;
      if (Math.abs(p[2] - points[k - 1][2]) > 0.12 * part) steep += part;
    });
    if (steep > 0.01 * length) faults.push(`road ${id} is steep`);
  }
  for (const { class: kind, spacing, places = [] } of plants) {
    const cells = new Map();
    for (const p of places) {
      const [i, j] = [Math.floor(p[0] / spacing), Math.floor(p[1] / spacing)];
      for (let a = -1; a <= 1; ++a) for (let b = -1; b <= 1; ++b) if (cells.get(`${i + a} ${j + b}`)?.some((q) => run(p, q) < spacing - 1e-3)) faults.push(`two of ${kind} are too near at ${p}`);
      cells.set(`${i} ${j}`, [...(cells.get(`${i} ${j}`) ?? []), p]);
    }
  }
  return faults;
}
