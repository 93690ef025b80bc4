/** What one can stand on: the faces of a model that look up. */
import { Box3, Matrix4, Raycaster, Vector3, type InstancedMesh, type Intersection, type Mesh, type Object3D } from 'three';

const down = new Vector3(0, -1, 0);
/** What the files of the service call land and what lies level on it. */
const land_name = /^(ground|water)(_|$)/;

/** Whether the model lies under the middles of all four sides of its outline, as ground does; a lone tree stands on any. */
export function is_ground(model: Object3D): boolean {
  const box = new Box3().setFromObject(model), middle = box.getCenter(new Vector3()), size = box.getSize(new Vector3());
  if (Math.min(size.x, size.z) < size.y / 2) return false;
  return [[0.47, 0], [-0.47, 0], [0, 0.47], [0, -0.47]].every(([east = 0, south = 0]) =>
    new Raycaster(new Vector3(middle.x + east * size.x, box.max.y + 1, middle.z + south * size.z), down).intersectObject(model, true).length > 0);
}

/** The land of a model, and its outline. */
export class Land {
  readonly box = new Box3();
  private readonly meshes: Object3D[] = [];
  private readonly model: Object3D;

  constructor(model: Object3D) {
    this.model = model;
    // A mesh of several materials is a group of that name.
    model.traverse((part) => {
      if ((part as Mesh).isMesh && (land_name.test(part.name) || land_name.test(part.parent?.name ?? ''))) this.meshes.push(part);
    });
    for (const mesh of this.meshes) this.box.expandByObject(mesh);
  }

  get is_there(): boolean { return this.meshes.length > 0; }

  /** The height at a place; undefined beside the land. */
  height(place: Vector3): number | undefined { return footings(this.meshes, place, this.box.max.y + 1)[0]; }

  /** Where one comes onto it from outside: on the way from there to its middle, not far from its rim, where it can be seen into. */
  way_in(from: Vector3, eye: number): Vector3 | null {
    const middle = this.box.getCenter(new Vector3()), size = this.box.getSize(new Vector3());
    const out = from.clone().sub(middle).setY(0);
    if (out.lengthSq() === 0) out.z = 1;
    out.normalize();
    const rim = Math.min(size.x / 2 / Math.max(Math.abs(out.x), 1e-6), size.z / 2 / Math.max(Math.abs(out.z), 1e-6));
    let best: Vector3 | null = null, longest = -1;
    for (const share of [0.8, 0.65, 0.5, 0.35]) {
      const place = middle.clone().addScaledVector(out, rim * share);
      const height = this.height(place);
      if (height === undefined) continue;
      const ahead = new Raycaster(place.setY(height).clone().setY(height + eye), out.clone().negate());
      const free = ahead.intersectObject(this.model, true)[0]?.distance ?? Infinity;
      if (free > longest) { best = place; longest = free; }
      if (free > rim * 0.2) break;
    }
    return best;
  }
}

/** Heights of the faces that look up at a place, from the highest to the lowest. */
export function footings(models: Object3D[], { x, z }: Vector3, from: number): number[] {
  return new Raycaster(new Vector3(x, from, z), down).intersectObjects(models, true).filter(looks_up).map((hit) => hit.point.y);
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
