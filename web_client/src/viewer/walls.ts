/** Walls: bodies whose faces are seen from outside alone. Leaves, which have two sides, are no walls, and twigs are too thin. */
import { BackSide, FrontSide, MeshBasicMaterial, Raycaster, type Material, type Mesh, type Vector3 } from 'three';
import type { Model } from './model';

/** Among more triangles nothing is looked for: a turn of the wheel must not wait. */
const most_triangles = 1_000_000;
const outside = new MeshBasicMaterial({ side: FrontSide }), inside = new MeshBasicMaterial({ side: BackSide });

/** How far it is to the first wall of a certain thickness between two places; null where there is none. */
export function wall_between(model: Model, from: Vector3, to: Vector3, thick: number): number | null {
  if (model.triangles > most_triangles) return null;
  const way = to.clone().sub(from);
  const caster = new Raycaster(from, way.clone().normalize(), 0, way.length());
  const walls: Mesh[] = [];
  model.each_mesh((mesh) => {
    if (([model.own_material(mesh)].flat() as Material[]).every((material) => material.side === FrontSide && !material.transparent)) walls.push(mesh);
  });
  // Another way of shading may show both sides.
  const met = (side: Material): number[] => walls.flatMap((mesh) => {
    const worn = mesh.material;
    mesh.material = side;
    const hits = caster.intersectObject(mesh, false);
    mesh.material = worn;
    return hits.map((hit) => hit.distance);
  }).sort((a, b) => a - b);
  const ways_in = met(outside);
  if (ways_in.length === 0) return null;
  const ways_out = met(inside);
  return ways_in.find((entry) => (ways_out.find((exit) => exit > entry) ?? Infinity) - entry > thick) ?? null;
}
