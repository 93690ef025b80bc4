/** What one can stand on: the faces of a model that look up. */
import { Box3, Matrix4, Raycaster, Vector3, type InstancedMesh, type Intersection, type Object3D } from 'three';

const down = new Vector3(0, -1, 0);

/** Whether the model lies under the middles of all four sides of its outline, as ground does; a lone tree stands on any. */
export function is_ground(model: Object3D): boolean {
  const box = new Box3().setFromObject(model), middle = box.getCenter(new Vector3()), size = box.getSize(new Vector3());
  if (Math.min(size.x, size.z) < size.y / 2) return false;
  return [[0.47, 0], [-0.47, 0], [0, 0.47], [0, -0.47]].every(([east = 0, south = 0]) =>
    new Raycaster(new Vector3(middle.x + east * size.x, box.max.y + 1, middle.z + south * size.z), down).intersectObject(model, true).length > 0);
}

/** Land is ground to walk on: wide and low, and not the roof of a house. */
export function is_land(model: Object3D, box: Box3): boolean {
  const { x, y, z } = box.getSize(new Vector3());
  const least = Math.min(x, z);
  return least > 20 && least > y && is_ground(model);
}

/** Heights of the faces that look up at a place, from the highest to the lowest. */
export function footings(model: Object3D, { x, z }: Vector3, from: number): number[] {
  return new Raycaster(new Vector3(x, from, z), down).intersectObject(model, true).filter(looks_up).map((hit) => hit.point.y);
}

function looks_up({ face, object, instanceId }: Intersection): boolean {
  if (!face) return false;
  const place = object.matrixWorld.clone();
  if (instanceId !== undefined) {
    const of_copy = new Matrix4();
    (object as InstancedMesh).getMatrixAt(instanceId, of_copy);
    place.multiply(of_copy);
  }
  return face.normal.clone().transformDirection(place).y > 0.05;
}

/**
 * Where one comes onto land from outside: on the way from `from` to its middle, not far from its rim, where it can be
 * seen into; the height is that of the ground. null where there is none on that way.
 */
export function way_in(model: Object3D, box: Box3, from: Vector3, eye: number): Vector3 | null {
  const middle = box.getCenter(new Vector3()), size = box.getSize(new Vector3());
  const out = from.clone().sub(middle).setY(0);
  if (out.lengthSq() === 0) out.z = 1;
  out.normalize();
  const rim = Math.min(size.x / 2 / Math.max(Math.abs(out.x), 1e-6), size.z / 2 / Math.max(Math.abs(out.z), 1e-6));
  let best: Vector3 | null = null, longest = -1;
  for (const share of [0.75, 0.6, 0.45, 0.3]) {
    const place = middle.clone().addScaledVector(out, rim * share);
    const height = footings(model, place, box.max.y + 1).at(-1);
    if (height === undefined) continue;
    place.y = height;
    const ahead = new Raycaster(place.clone().setY(height + eye), out.clone().negate());
    const free = ahead.intersectObject(model, true)[0]?.distance ?? Infinity;
    if (free > longest) { best = place; longest = free; }
    if (free > rim * 0.25) break;
  }
  return best;
}
