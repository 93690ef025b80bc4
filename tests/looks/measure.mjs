// Measures the looks of a GLB file without any code of the project: areas, textures, texture coordinates.
import { NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { PNG } from 'pngjs';

const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);

const subtract = (a, b) => a.map((each, i) => each - b[i]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (v) => Math.hypot(...v);

/** The primitives of a file, with arrays and the decoded colour and normal textures (null where there are none). */
export async function primitives_of(bytes) {
  const document = await io.readBinary(new Uint8Array(bytes)), decoded = new Map();
  const picture = (texture) => {
    if (!texture) return null;
    if (!decoded.has(texture)) decoded.set(texture, PNG.sync.read(Buffer.from(texture.getImage())));
    return decoded.get(texture);
  };
  return document.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives().map((primitive) => {
    const material = primitive.getMaterial();
    const array = (name) => primitive.getAttribute(name);
    return {
      mesh: mesh.getName(), material: material.getName(), cutoff: material.getAlphaCutoff(), is_cut: material.getAlphaMode() === 'MASK', double_sided: material.getDoubleSided(), factor: material.getBaseColorFactor(),
      transmission: material.getExtension('KHR_materials_diffuse_transmission')?.getDiffuseTransmissionFactor() ?? 0,
      color: picture(material.getBaseColorTexture()), normal: picture(material.getNormalTexture()),
      uv_set: material.getBaseColorTextureInfo()?.getTexCoord() ?? 0, index: primitive.getIndices().getArray(),
      vertices: array('POSITION').getCount(),
      at: (name, i) => array(name).getElement(i, []),
      has: (name) => array(name) !== null,
    };
  }));
}

/** Calls body(corners, area) for each triangle. */
export function each_triangle(primitive, body) {
  for (let i = 0; i < primitive.index.length; i += 3) {
    const corners = [...primitive.index.slice(i, i + 3)], [a, b, c] = corners.map((corner) => primitive.at('POSITION', corner));
    body(corners, length(cross(subtract(b, a), subtract(c, a))) / 2);
  }
}

export function area_of(primitive) {
  let sum = 0;
  each_triangle(primitive, (_, area) => { sum += area; });
  return sum;
}

export function box_of(primitives) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const primitive of primitives) {
    for (let i = 0; i < primitive.vertices; ++i) {
      primitive.at('POSITION', i).forEach((each, k) => { low[k] = Math.min(low[k], each); high[k] = Math.max(high[k], each); });
    }
  }
  return { low, high };
}

/** The share of the texels of a texture that the alpha test keeps, for each of the first mip levels: means of two by two texels. */
export function coverage_by_level(picture, cutoff, levels) {
  let { width, height } = picture, alpha = Array.from({ length: width * height }, (_, i) => picture.data[4 * i + 3] / 255);
  const shares = [];
  for (let level = 0; level < levels; ++level) {
    shares.push(alpha.filter((each) => each >= cutoff).length / alpha.length);
    const half = width / 2;
    alpha = Array.from({ length: half * (height / 2) }, (_, i) => {
      const x = 2 * (i % half), y = 2 * Math.floor(i / half);
      return (alpha[y * width + x] + alpha[y * width + x + 1] + alpha[(y + 1) * width + x] + alpha[(y + 1) * width + x + 1]) / 4;
    });
    width = half;
    height /= 2;
  }
  return shares;
}

/** The mip level of alpha that is `level` steps smaller: means of two by two texels. */
function alpha_at(picture, level) {
  let { width } = picture, alpha = Array.from({ length: width * width }, (_, i) => picture.data[4 * i + 3] / 255);
  for (let step = 0; step < level; ++step) {
    const half = width / 2, before = alpha, row = width;
    alpha = Array.from({ length: half * half }, (_, i) => {
      const at = 2 * (i % half) + 2 * Math.floor(i / half) * row;
      return (before[at] + before[at + 1] + before[at + row] + before[at + row + 1]) / 4;
    });
    width = half;
  }
  return { width, alpha };
}

/**
 * The share of a square texture that the alpha test keeps where a renderer mixes the four nearest texels of a mip level. In
 * small levels, this is less than the share of the texels, because single texels do not reach the cutoff between others.
 */
export function filtered_coverage(picture, cutoff, level) {
  const { width, alpha } = alpha_at(picture, level), samples = 256;
  const at = (x, y) => alpha[Math.min(width - 1, Math.max(0, y)) * width + Math.min(width - 1, Math.max(0, x))];
  let kept = 0;
  for (let i = 0; i < samples * samples; ++i) {
    const x = (((i % samples) + 0.5) * width) / samples - 0.5, y = ((Math.floor(i / samples) + 0.5) * width) / samples - 0.5;
    const left = Math.floor(x), top = Math.floor(y), u = x - left, v = y - top;
    const mixed = (at(left, top) * (1 - u) + at(left + 1, top) * u) * (1 - v) + (at(left, top + 1) * (1 - u) + at(left + 1, top + 1) * u) * v;
    if (mixed >= cutoff) ++kept;
  }
  return kept / (samples * samples);
}

/** Mean and 95 % quantile of the slopes of a normal map, in degrees. */
export function slopes_of(picture) {
  const slopes = [];
  for (let i = 0; i < picture.data.length; i += 4) {
    const n = [0, 1, 2].map((c) => picture.data[i + c] / 127.5 - 1);
    slopes.push((Math.acos(Math.min(1, n[2] / length(n))) * 180) / Math.PI);
  }
  slopes.sort((a, b) => a - b);
  return { mean: slopes.reduce((a, b) => a + b, 0) / slopes.length, p95: slopes[Math.floor(0.95 * slopes.length)] };
}

/** Texels a metre of each triangle: the root of its area in texels by its area in square metres, with that area. */
export function texel_densities(primitive) {
  const densities = [];
  each_triangle(primitive, (corners, area) => {
    const [a, b, c] = corners.map((corner) => primitive.at(`TEXCOORD_${primitive.uv_set}`, corner));
    const texels = Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2 * primitive.color.width * primitive.color.height;
    if (area > 0) densities.push({ density: Math.sqrt(texels / area), area });
  });
  return densities.sort((a, b) => a.density - b.density);
}

const linear = (byte) => (byte <= 10 ? byte / 3294.6 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** The mean linear colour of the texels of a texture that the alpha test keeps. */
export function mean_color(picture, cutoff = 0) {
  const sum = [0, 0, 0];
  let count = 0;
  for (let i = 0; i < picture.data.length; i += 4) {
    if (picture.data[i + 3] / 255 < cutoff) continue;
    for (let c = 0; c < 3; ++c) sum[c] += linear(picture.data[i + c]);
    ++count;
  }
  return sum.map((each) => each / count);
}

/** The mean of the vertex colours of a primitive, times its colour factor. */
function factor_of(primitive) {
  const sum = [0, 0, 0], step = Math.max(1, Math.floor(primitive.vertices / 10_000));
  if (!primitive.has('COLOR_0')) return primitive.factor.slice(0, 3);
  let count = 0;
  for (let i = 0; i < primitive.vertices; i += step, ++count) primitive.at('COLOR_0', i).slice(0, 3).forEach((each, c) => { sum[c] += each; });
  return sum.map((each, c) => (each / count) * primitive.factor[c]);
}

/** Luminance of the texels of a primitive times its factor and its mean vertex colour: mean, 2 % and 98 % quantiles; saturation of the mean. */
export function albedo_range(primitive) {
  const factor = factor_of(primitive), cutoff = primitive.is_cut ? primitive.cutoff : 0, { color } = primitive;
  const values = [], mean = color ? mean_color(color, cutoff).map((each, c) => each * factor[c]) : factor;
  for (let i = 0; color && i < color.data.length; i += 4) {
    if (color.data[i + 3] / 255 >= cutoff) values.push(luminance(factor.map((each, c) => each * linear(color.data[i + c]))));
  }
  values.sort((a, b) => a - b);
  const at = (share) => (color ? values[Math.floor(share * (values.length - 1))] : luminance(factor));
  return { mean: luminance(mean), low: at(0.02), high: at(0.98), saturation: (Math.max(...mean) - Math.min(...mean)) / Math.max(...mean, 1e-9) };
}

/**
 * The share of light that a thin surface reflects diffusely: KHR_materials_diffuse_transmission mixes reflection and
 * transmission by its factor.
 */
export const reflectance_of = (primitive) => (1 - primitive.transmission) * albedo_range(primitive).mean;

/** Mean luminance of a primitive: its texture times its factor and its vertex colours. */
export const albedo_of = (primitive) => albedo_range(primitive).mean;

/** Standard deviation of the hue of the vertices, in degrees, with a base colour. */
export function hue_deviation(primitive, base) {
  let sum = 0, squares = 0;
  for (let i = 0; i < primitive.vertices; ++i) {
    const [r, g, b] = primitive.at('COLOR_0', i).map((each, c) => each * (base[c] ?? 1));
    const hue = (Math.atan2(Math.sqrt(3) * (g - b), 2 * r - g - b) * 180) / Math.PI;
    sum += hue;
    squares += hue * hue;
  }
  const mean = sum / primitive.vertices;
  return Math.sqrt(squares / primitive.vertices - mean * mean);
}
