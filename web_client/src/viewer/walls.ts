/** Finds walls: solid bodies with single-sided faces. Double-sided leaves and thin twigs do not count. */
import { BackSide, FrontSide, MeshBasicMaterial, Raycaster, type Material, type Mesh, type Vector3 } from 'three';
import type { Model } from './model';

/** Larger models are not searched, because a zoom must not wait. */
const most_triangles = 1_000_000;
const outside = new MeshBasicMaterial({ side: FrontSide }), inside = new MeshBasicMaterial({ side: BackSide });

/** The distance to the first wall of at least this thickness between two positions; null if there is none. */
export function wall_between(model: Model, from: Vector3, to: Vector3, thick: number): number | null {
  if (model.triangles > most_triangles) return null;
  const way = to.clone().sub(from);
  const caster = new Raycaster(from, way.clone().normalize(), 0, way.length());
  const walls: Mesh[] = [];
  model.each_mesh((mesh) => {
    if (([model.own_material(mesh)].flat() as Material[]).every((material) => material.side === FrontSide && !material.transparent)) walls.push(mesh);
  });
  // The current shading mode may draw both sides, so the materials are replaced for the search.
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
