/** Where the camera has to stand to see a model whole. */
import { Box3, Matrix4, Spherical, Vector3, type InstancedMesh, type Mesh, type Object3D, type PerspectiveCamera } from 'three';

/** Part of the picture that the model may fill. */
const fill = 0.8;
/** And where something lies over the rims of the picture, of what is left between: that is a margin too. */
const fill_between = 0.88;
/** So many points stand for a mesh; the outline of a plant needs no more. */
const most_points = 3000;

/**
 * Flat drawings are looked at from the front, bodies from a corner and a little above. The wider and lower a body is,
 * the higher the camera rises: land lies under the eye, and is not seen along its edge.
 */
export function usual_direction(box: Box3): Vector3 {
  const size = box.getSize(new Vector3());
  if (size.z < 0.12 * Math.max(size.x, size.y)) return new Vector3(0.16, 0.06, 1).normalize();
  const lowness = 1 - Math.min(size.y / (0.7 * Math.max(size.x, size.z)), 1);
  return new Vector3(0.55, 0.22 + 0.62 * lowness, 1).normalize();
}

export function corners_of(box: Box3): Vector3[] {
  return Array.from({ length: 8 }, (_, corner) => new Vector3(
    corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z));
}

/** Vertices of the model, evenly taken: the corners of its box would leave much of the picture empty. */
export function points_of(model: Object3D): Vector3[] {
  const points: Vector3[] = [];
  model.updateWorldMatrix(true, true);
  model.traverse((part) => {
    const positions = (part as Mesh).geometry?.getAttribute('position');
    if (!positions) return;
    const copies = part as InstancedMesh;
    const count = copies.isInstancedMesh ? copies.count : 1;
    const stride = Math.max(1, Math.floor(positions.count * count / most_points));
    const place = part.matrixWorld.clone(), of_copy = new Matrix4();
    for (let index = 0; index < positions.count * count; index += stride) {
      if (copies.isInstancedMesh) {
        copies.getMatrixAt(Math.floor(index / positions.count), of_copy);
        place.multiplyMatrices(part.matrixWorld, of_copy);
      }
      points.push(new Vector3().fromBufferAttribute(positions, index % positions.count).applyMatrix4(place));
    }
  });
  return points;
}

/** Pixels at the upper and at the lower rim of the picture that something else covers. */
export interface Covered { top: number; bottom: number }

/** Part of a height that nothing covers. A model is never made smaller than a seventh of the picture. */
export const free_of = (covered: Covered, height: number): number => Math.max(0.15, 1 - (covered.top + covered.bottom) / height);

/** Whether all points are seen, between what covers the rims of a picture that is so many pixels high. */
export function in_sight(camera: PerspectiveCamera, points: Vector3[], covered: Covered, height: number): boolean {
  camera.updateMatrixWorld();
  const low = -1 + 2 * covered.bottom / height, high = 1 - 2 * covered.top / height;
  return points.every((point) => {
    const { x, y, z } = point.clone().project(camera);
    return Math.abs(x) <= 1 && y >= low && y <= high && z < 1;
  });
}

/**
 * Moves the camera along `direction` (from the target to it) until all points are in sight, within the part `free` of
 * the height. Returns the target.
 */
export function stand_back(camera: PerspectiveCamera, points: Vector3[], direction: Vector3, free: number): Vector3 {
  const target = new Box3().setFromPoints(points).getCenter(new Vector3());
  const right = new Vector3(0, 1, 0).cross(direction).normalize();
  const up = direction.clone().cross(right);
  const tan = Math.tan((camera.fov * Math.PI) / 360) * (free < 1 ? fill_between : fill);
  const tan_up = tan * free;
  const tan_right = tan * camera.aspect;
  let distance = 0.01;
  // What is near looks larger, so that the middle of the box is not the middle of the picture: each round moves
  // the target into the middle and asks again for the distance.
  for (let round = 0; round < 4; round += 1) {
    distance = 0.01;
    let left = 0, rightmost = 0, low = 0, high = 0;
    for (const point of points) {
      const seen = point.clone().sub(target);
      const near = seen.dot(direction);
      distance = Math.max(distance, near + Math.max(Math.abs(seen.dot(right)) / tan_right, Math.abs(seen.dot(up)) / tan_up));
    }
    for (const point of points) {
      const seen = point.clone().sub(target);
      const scale = distance / (distance - seen.dot(direction));
      left = Math.min(left, seen.dot(right) * scale);
      rightmost = Math.max(rightmost, seen.dot(right) * scale);
      low = Math.min(low, seen.dot(up) * scale);
      high = Math.max(high, seen.dot(up) * scale);
    }
    if (round < 3) target.addScaledVector(right, (left + rightmost) / 2).addScaledVector(up, (low + high) / 2);
  }
  camera.position.copy(target).addScaledVector(direction, distance);
  camera.near = distance / 200;
  camera.far = distance * 50;
  camera.updateProjectionMatrix();
  camera.lookAt(target);
  return target;
}

/** Turns a camera round a target, by radians, and scales its distance; `lowest` bounds the angle from upright. */
export function go_round(camera: PerspectiveCamera, target: Vector3, turn: number, tilt: number, distance: number, lowest: number): void {
  const offset = new Spherical().setFromVector3(camera.position.clone().sub(target));
  offset.theta += turn;
  offset.phi = Math.min(Math.max(offset.phi + tilt, 0.05), lowest);
  offset.radius *= distance;
  camera.position.copy(target).add(new Vector3().setFromSpherical(offset));
}
