/** Ground detection: the upward-facing surfaces of a model. */
import { Box3, Matrix4, Raycaster, Vector3, type InstancedMesh, type Intersection, type Mesh, type Object3D } from 'three';

const down = new Vector3(0, -1, 0);
/** Names that the service gives to nodes, meshes and materials of terrain and of level surfaces on it. */
const land_name = /^(ground|water)(_|$)|_(ground|water)(_\d+)*_[0-9a-f]{8}(_\d+)?$/;

const is_land = (mesh: Mesh): boolean =>
  [mesh.name, mesh.parent?.name ?? '', ...[mesh.material].flat().map((material) => material.name)].some((name) => land_name.test(name));

/**
 * True if the model extends below points near all four sides of its bounding box, as ground does. A single tree does
 * not.
 */
export function is_ground(model: Object3D): boolean {
  const box = new Box3().setFromObject(model), middle = box.getCenter(new Vector3()), size = box.getSize(new Vector3());
  if (Math.min(size.x, size.z) < size.y / 2) return false;
  return [[0.47, 0], [-0.47, 0], [0, 0.47], [0, -0.47]].every(([east = 0, south = 0]) =>
    new Raycaster(new Vector3(middle.x + east * size.x, box.max.y + 1, middle.z + south * size.z), down).intersectObject(model, true).length > 0);
}

/** The terrain meshes of a model, and their bounding box. */
export class Land {
  readonly box = new Box3();
  private readonly meshes: Object3D[] = [];
  private readonly model: Object3D;

  constructor(model: Object3D) {
    this.model = model;
    // A mesh with several materials is loaded as a group with that name.
    model.traverse((part) => {
      if ((part as Mesh).isMesh && is_land(part as Mesh)) this.meshes.push(part);
    });
    for (const mesh of this.meshes) this.box.expandByObject(mesh);
  }

  get is_there(): boolean { return this.meshes.length > 0; }

  /** The terrain height at a position; undefined outside the terrain. */
  height(position: Vector3): number | undefined { return surface_heights(this.meshes, position, this.box.max.y + 1)[0]; }

  /**
   * The entry position from outside the terrain: on the line to its centre, near the edge, and with a clear view
   * inwards.
   */
  entry_position(from: Vector3, eye: number): Vector3 | null {
    const middle = this.box.getCenter(new Vector3()), size = this.box.getSize(new Vector3());
    const out = from.clone().sub(middle).setY(0);
    if (out.lengthSq() === 0) out.z = 1;
    out.normalize();
    const rim = Math.min(size.x / 2 / Math.max(Math.abs(out.x), 1e-6), size.z / 2 / Math.max(Math.abs(out.z), 1e-6));
    let best: Vector3 | null = null, longest = -1;
    for (const share of [0.8, 0.65, 0.5, 0.35]) {
      const position = middle.clone().addScaledVector(out, rim * share);
      const height = this.height(position);
      if (height === undefined) continue;
      const ahead = new Raycaster(position.setY(height).clone().setY(height + eye), out.clone().negate());
      const free = ahead.intersectObject(this.model, true)[0]?.distance ?? Infinity;
      if (free > longest) { best = position; longest = free; }
      if (free > rim * 0.2) break;
    }
    return best;
  }
}

/** The heights of all upward-facing surfaces at a position, in descending order. */
export function surface_heights(models: Object3D[], { x, z }: Vector3, from: number): number[] {
  return new Raycaster(new Vector3(x, from, z), down).intersectObjects(models, true).filter(faces_up).map((hit) => hit.point.y);
}

function faces_up({ face, object, instanceId }: Intersection): boolean {
  if (!face) return false;
  const matrix = object.matrixWorld.clone();
  if (instanceId !== undefined) {
    const of_copy = new Matrix4();
    (object as InstancedMesh).getMatrixAt(instanceId, of_copy);
    matrix.multiply(of_copy);
  }
  return face.normal.clone().transformDirection(matrix).y > 0.05;
}
