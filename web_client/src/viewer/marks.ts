/** Markers of positions on the ground. */
import { BufferGeometry, DataTexture, Group, LinearFilter, Points, PointsMaterial, SRGBColorSpace, type Vector3 } from 'three';
import { tellable } from './boxes';

/** A dot with a white and a dark ring, which is visible on grass, snow and bark. */
let dot: DataTexture | null = null;
function dot_texture(): DataTexture {
  if (dot) return dot;
  const side = 32, data = new Uint8Array(side * side * 4);
  for (let at = 0; at < side * side; at += 1) {
    const away = Math.hypot(at % side - 15.5, Math.floor(at / side) - 15.5);
    // The white pixels are multiplied by the colour of the marker.
    const light = away > 13 ? 40 : 255;
    data.set([light, light, light, 255 * Math.min(Math.max(15 - away, 0), 1)], at * 4);
  }
  dot = new DataTexture(data, side, side);
  dot.colorSpace = SRGBColorSpace;
  dot.magFilter = dot.minFilter = LinearFilter;
  dot.needsUpdate = true;
  return dot;
}

/** Dots with a constant size in pixels. The selected one is larger and has another colour. */
export function draw_marks(positions: Vector3[], chosen: number): Group {
  const dots = (at: Vector3[], color: number, size: number, order: number): Points => {
    const drawn = new Points(new BufferGeometry().setFromPoints(at), new PointsMaterial({ map: dot_texture(), color, size, sizeAttenuation: false, transparent: true, depthTest: false, depthWrite: false, toneMapped: false }));
    drawn.userData = { helper: true };
    drawn.renderOrder = order;
    return drawn;
  };
  const others = positions.filter((_, index) => index !== chosen), own = positions[chosen];
  const few = positions.length <= 60;
  return new Group().add(...[
    ...(few ? [dots(others, 0xffffff, 13, 2), dots(others, tellable[5], 8, 3)] : [dots(others, tellable[5], 7, 3)]),
    ...(own ? [dots([own], 0xffffff, 20, 4), dots([own], tellable[3], 14, 5)] : []),
  ]);
}
