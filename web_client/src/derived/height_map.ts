/**
 * Draws a height map from above with north at the top, as shaded relief in colours that colour-blind readers can
 * distinguish.
 */
import { el, grouped, rounded } from '../dom';

export interface Heights { width: number; height: number; min: number; max: number; heights: number[] }

export const is_heights = (answer: object): answer is Heights => {
  const { width, height, heights } = answer as Partial<Heights>;
  return typeof width === 'number' && typeof height === 'number' && Array.isArray(heights) && heights.length === width * height;
};

/** Dark blue through green to pale yellow, with brightness rising with height (after the colour map "viridis"). */
const tints: readonly [number, number, number][] = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

function tint(share: number): [number, number, number] {
  const at = Math.min(Math.max(share, 0), 1) * (tints.length - 1);
  const low = tints[Math.floor(at)] ?? [0, 0, 0], high = tints[Math.ceil(at)] ?? low;
  return [0, 1, 2].map((index) => low[index]! + (high[index]! - low[index]!) * (at % 1)) as [number, number, number];
}

/** The heights of one line as a graph from west to east. */
export function draw_profile({ width, min, max, heights }: Heights): HTMLElement {
  const span = max - min || 1, wide = 640, high = 200;
  const points = heights.map((height, index) => `${rounded(index / (width - 1) * wide)},${rounded((max - height) / span * high)}`).join(' ');
  const graph = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  graph.setAttribute('viewBox', `-4 -4 ${wide + 8} ${high + 8}`);
  graph.setAttribute('role', 'img');
  graph.setAttribute('class', 'profile');
  graph.setAttribute('aria-label', `Profile of ${width} samples, from ${rounded(min)} to ${rounded(max)} m`);
  const line = document.createElementNS('http://www.w3.org/2000/svg', 'polyline');
  for (const [name, value] of [['points', points], ['fill', 'none'], ['stroke', 'currentColor'], ['stroke-width', '1.5'], ['vector-effect', 'non-scaling-stroke']] as const) line.setAttribute(name, value);
  graph.append(line);
  return el('figure', {}, graph, el('figcaption', {}, `${grouped(width)} samples from west to east, ${rounded(min)} to ${rounded(max)} m`));
}

export function draw_map(map: Heights): HTMLElement {
  const { width, height, heights } = map;
  const span = map.max - map.min || 1;
  const canvas = el('canvas', { width, height, role: 'img', class: 'height-map', 'aria-label': `Height map, ${width} by ${height} samples, from ${rounded(map.min)} to ${rounded(map.max)} m` });
  const context = canvas.getContext('2d');
  const image = context?.createImageData(width, height);
  if (context && image) {
    const at = (x: number, y: number): number => heights[Math.min(Math.max(y, 0), height - 1) * width + Math.min(Math.max(x, 0), width - 1)] ?? 0;
    // Light from the north-west, as on printed maps. The slope is relative to the height span, so the relief does not
    // depend on the size in metres.
    const relief = width / span * 0.12;
    for (let y = 0; y < height; y += 1) {
      for (let x = 0; x < width; x += 1) {
        const slope = (at(x + 1, y) - at(x - 1, y) + at(x, y + 1) - at(x, y - 1)) * relief;
        const shade = 0.85 + 0.35 * (-slope / Math.hypot(1, slope));
        const color = tint((at(x, y) - map.min) / span);
        image.data.set([color[0] * shade, color[1] * shade, color[2] * shade, 255], (y * width + x) * 4);
      }
    }
    context.putImageData(image, 0, 0);
  }
  const here = el('output', { class: 'soft' }, 'Move the pointer over the map to read a height');
  canvas.addEventListener('pointermove', (event) => {
    const area = canvas.getBoundingClientRect();
    const x = Math.floor((event.clientX - area.left) / area.width * width), y = Math.floor((event.clientY - area.top) / area.height * height);
    here.textContent = `Sample ${x}, ${y}: ${rounded(heights[y * width + x] ?? 0)} m`;
  });
  return el('figure', { class: 'map-of-heights' }, canvas,
    el('figcaption', {}, `${grouped(width)} × ${grouped(height)} samples, north at the top, ${rounded(map.min)} to ${rounded(map.max)} m. `, here));
}
