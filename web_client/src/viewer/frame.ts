/** Computes the camera position from which a model is completely visible. */
import { Box3, Matrix4, Spherical, Vector3, type InstancedMesh, type Mesh, type Object3D, type PerspectiveCamera } from 'three';

/** The fraction of the view that a framed model may fill. */
const fill = 0.8;
/** The fraction of the uncovered height, if overlays cover the edges of the view: the overlays are a margin too. */
const fill_between = 0.88;
/** The number of sample points per mesh, which is enough for the outline of a plant. */
const most_points = 3000;

/**
 * The default view direction. Flat drawings are viewed from the front, bodies from a corner and slightly from above.
 * The elevation rises with the ratio of width to height, so that terrain is not seen edge-on.
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

/** Evenly sampled vertices of the model. The corners of its bounding box would leave much of the view empty. */
export function points_of(model: Object3D): Vector3[] {
  const points: Vector3[] = [];
  model.updateWorldMatrix(true, true);
  model.traverse((part) => {
    const positions = (part as Mesh).geometry?.getAttribute('position');
    if (!positions) return;
    const copies = part as InstancedMesh;
    const count = copies.isInstancedMesh ? copies.count : 1;
    const stride = Math.max(1, Math.floor(positions.count * count / most_points));
    const matrix = part.matrixWorld.clone(), of_copy = new Matrix4();
    for (let index = 0; index < positions.count * count; index += stride) {
      if (copies.isInstancedMesh) {
        copies.getMatrixAt(Math.floor(index / positions.count), of_copy);
        matrix.multiplyMatrices(part.matrixWorld, of_copy);
      }
      points.push(new Vector3().fromBufferAttribute(positions, index % positions.count).applyMatrix4(matrix));
    }
  });
  return points;
}

/** The heights, in pixels, of the overlays at the top and at the bottom of the view. */
export interface Covered { top: number; bottom: number }

/** The uncovered fraction of the height. It has a lower bound of one seventh, so that the model stays visible. */
export const free_of = (covered: Covered, height: number): number => Math.max(0.15, 1 - (covered.top + covered.bottom) / height);

/** True if all points are visible in the uncovered part of a view with this height in pixels. */
export function in_sight(camera: PerspectiveCamera, points: Vector3[], covered: Covered, height: number): boolean {
  camera.updateMatrixWorld();
  const low = -1 + 2 * covered.bottom / height, high = 1 - 2 * covered.top / height;
  return points.every((point) => {
    const { x, y, z } = point.clone().project(camera);
    return Math.abs(x) <= 1 && y >= low && y <= high && z < 1;
  });
}

/**
 * Moves the camera along `direction` (from the target to the camera) until all points are visible within the fraction
 * `free` of the height. Returns the target.
 */
export function place_camera(camera: PerspectiveCamera, points: Vector3[], direction: Vector3, free: number): Vector3 {
  const target = new Box3().setFromPoints(points).getCenter(new Vector3());
  const right = new Vector3(0, 1, 0).cross(direction).normalize();
  const up = direction.clone().cross(right);
  const tan = Math.tan((camera.fov * Math.PI) / 360) * (free < 1 ? fill_between : fill);
  const tan_up = tan * free;
  const tan_right = tan * camera.aspect;
  let distance = 0.01;
  // Perspective enlarges near points, so the centre of the box is not the centre of the image. Each iteration moves
  // the target to the centre of the image and computes the distance again.
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

/** Rotates a camera around a target, in radians, and scales its distance. `lowest` limits the polar angle. */
export function go_round(camera: PerspectiveCamera, target: Vector3, turn: number, tilt: number, distance: number, lowest: number): void {
  const offset = new Spherical().setFromVector3(camera.position.clone().sub(target));
  offset.theta += turn;
  offset.phi = Math.min(Math.max(offset.phi + tilt, 0.05), lowest);
  offset.radius *= distance;
  camera.position.copy(target).add(new Vector3().setFromSpherical(offset));
}
