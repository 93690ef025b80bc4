// Shared by the peers: the browser interfaces that three.js needs to write a file, and a height field to
// simplify.

/** Before ez-tree and three.js are imported, which look for a browser then. */
export function stand_in_for_browser() {
  const silent = { addEventListener() {}, removeEventListener() {}, style: {} };
  globalThis.document = { createElementNS: () => ({ ...silent }), createElement: () => ({ ...silent }) };
  globalThis.self = globalThis;
  globalThis.FileReader = class {
    readAsArrayBuffer(blob) {
      blob.arrayBuffer().then((buffer) => { this.result = buffer; this.onloadend(); });
    }
  };
}

/** Value noise of eight octaves, each of `gain` times the height of the one before. */
export function hills(side, gain) {
  const heights = new Float32Array(side * side);
  const hash = (x, y, o) => {
    let h = Math.imul(x, 374761393) ^ Math.imul(y, 668265263) ^ Math.imul(o, 2147483647);
    h = Math.imul(h ^ (h >>> 13), 1274126177);
    return ((h ^ (h >>> 16)) >>> 0) / 4294967296;
  };
  const ease = (t) => t * t * t * (t * (t * 6 - 15) + 10);
  for (let octave = 0, cell = side / 3, weight = 1; octave < 8; octave += 1, cell /= 2, weight *= gain) {
    for (let z = 0; z < side; z += 1) {
      for (let x = 0; x < side; x += 1) {
        const fx = x / cell, fz = z / cell, i = Math.floor(fx), j = Math.floor(fz), u = ease(fx - i), v = ease(fz - j);
        const north = hash(i, j, octave) * (1 - u) + hash(i + 1, j, octave) * u;
        const south = hash(i, j + 1, octave) * (1 - u) + hash(i + 1, j + 1, octave) * u;
        heights[z * side + x] += weight * (north * (1 - v) + south * v);
      }
    }
  }
  return heights;
}

/** [lowest, highest] */
export function range_of(heights) {
  let low = Infinity, high = -Infinity;
  for (const height of heights) { low = Math.min(low, height); high = Math.max(high, height); }
  return [low, high];
}
