/** Walls: faces that are seen from one side alone. Leaves, which have two, are no walls. */
import { FrontSide, Raycaster, type Material, type Vector3 } from 'three';
import type { Model } from './model';

/** Among more triangles nothing is looked for: a turn of the wheel must not wait. */
const most_triangles = 1_000_000;

/** How far it is to the first wall between two places; null where there is none. */
export function wall_between(model: Model, from: Vector3, to: Vector3): number | null {
  if (model.triangles > most_triangles) return null;
  const way = to.clone().sub(from);
  const caster = new Raycaster(from, way.clone().normalize(), 0, way.length());
  let nearest: number | null = null;
  model.each_mesh((mesh) => {
    const own = [model.own_material(mesh)].flat() as Material[];
    if (!own.every((material) => material.side === FrontSide && !material.transparent)) return;
    // Another way of shading may show both sides.
    const worn = mesh.material;
    mesh.material = own[0]!;
    const met = caster.intersectObject(mesh, false)[0];
    mesh.material = worn;
    if (met && (nearest === null || met.distance < nearest)) nearest = met.distance;
  });
  return nearest;
}
