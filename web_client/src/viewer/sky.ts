/** A clear sky with the sun, as an equirectangular environment texture. */
import { DataTexture, EquirectangularReflectionMapping, LinearFilter, SRGBColorSpace, Vector3 } from 'three';

const width = 256, height = 128;
type Rgb = readonly [number, number, number];
const zenith: Rgb = [74, 129, 199], horizon: Rgb = [206, 223, 236], haze: Rgb = [176, 182, 174], earth: Rgb = [128, 130, 118];

const mix = (a: Rgb, b: Rgb, share: number): Rgb => [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share, a[2] + (b[2] - a[2]) * share];

export function sky_texture(to_sun: Vector3, shines: boolean): DataTexture {
  const data = new Uint8Array(width * height * 4);
  const dim = shines ? 1 : 0.55;
  for (let y = 0; y < height; y += 1) {
    const up = Math.sin(((y + 0.5) / height - 0.5) * Math.PI);
    const base = up >= 0 ? mix(horizon, zenith, Math.sqrt(up)) : mix(haze, earth, Math.min(-up * 6, 1));
    const level = Math.sqrt(1 - up * up);
    for (let x = 0; x < width; x += 1) {
      // The equirectangular mapping of three.js: u = atan2(z, x) / 2 pi + 1/2.
      const around = ((x + 0.5) / width - 0.5) * 2 * Math.PI;
      const toward = Math.max(0, to_sun.x * level * Math.cos(around) + to_sun.y * up + to_sun.z * level * Math.sin(around));
      const glow = shines && up > 0 ? 0.45 * toward ** 24 + (toward > 0.999 ? 1 : 0) : 0;
      const color = mix(base, [255, 248, 230], Math.min(glow, 1));
      data.set([color[0] * dim, color[1] * dim, color[2] * dim, 255], (y * width + x) * 4);
    }
  }
  const texture = new DataTexture(data, width, height);
  texture.mapping = EquirectangularReflectionMapping;
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
