/** Where the camera has to stand to see a box whole. */
import { Box3, Vector3, type PerspectiveCamera } from 'three';

/** Part of the picture that the box may fill. */
const fill = 0.86;

/** Flat drawings are looked at from the front, bodies from a corner, both from a little above. */
export function usual_direction(box: Box3): Vector3 {
  const size = box.getSize(new Vector3());
  const flat = size.z < 0.12 * Math.max(size.x, size.y);
  return (flat ? new Vector3(0.16, 0.06, 1) : new Vector3(0.55, 0.22, 1)).normalize();
}

/** Moves the camera along `direction` (from the target to it) until all corners are in sight. Returns the target. */
export function stand_back(camera: PerspectiveCamera, box: Box3, direction: Vector3): Vector3 {
  const target = box.getCenter(new Vector3());
  const right = new Vector3(0, 1, 0).cross(direction).normalize();
  const up = direction.clone().cross(right);
  const tan_up = Math.tan((camera.fov * Math.PI) / 360) * fill;
  const tan_right = tan_up * camera.aspect;
  let distance = 0.01;
  for (let corner = 0; corner < 8; corner += 1) {
    const point = new Vector3(
      corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z,
    ).sub(target);
    const needed = Math.max(Math.abs(point.dot(right)) / tan_right, Math.abs(point.dot(up)) / tan_up);
    distance = Math.max(distance, point.dot(direction) + needed);
  }
  camera.position.copy(target).addScaledVector(direction, distance);
  camera.near = distance / 200;
  camera.far = distance * 50;
  camera.updateProjectionMatrix();
  camera.lookAt(target);
  return target;
}
