/** Many copies of a model in three.js, as instances. */
import { Group, InstancedMesh, Matrix4, Mesh, Quaternion, Vector3, type Object3D } from 'three';
import type { Client } from './client.js';
import { load, type LoadOptions, type SeedmeshObject } from './three.js';
import type { Request, SceneRequest } from './types.js';

/** Copies of a loaded model: one InstancedMesh for each mesh of its finest level. They share geometry, materials and wind with it. */
export function copies_of(object: SeedmeshObject, matrices: Matrix4[]): Group {
  const group = new Group();
  group.name = object.scene.name;
  object.scene.updateMatrixWorld(true);
  const coarser = new Set<Object3D>(object.levels.flatMap((lod) => lod.levels.slice(1).map((level) => level.object)));
  const visit = (each: Object3D): void => {
    if (coarser.has(each)) return;
    if (each instanceof Mesh) {
      const copies = new InstancedMesh(each.geometry, each.material, matrices.length);
      for (const [index, matrix] of matrices.entries()) copies.setMatrixAt(index, new Matrix4().multiplyMatrices(matrix, each.matrixWorld));
      copies.name = each.name;
      copies.castShadow = each.castShadow;
      copies.receiveShadow = each.receiveShadow;
      copies.computeBoundingSphere();
      group.add(copies);
    }
    each.children.forEach(visit);
  };
  visit(object.scene);
  return group;
}

/** The models of a scene request as copies. Its terrain is not part of it. */
export async function plant(client: Client, request: SceneRequest | Request, options: LoadOptions = {}): Promise<{ scene: Group; models: Map<string, SeedmeshObject> }> {
  const { models: requests, placements } = await client.derive(request as SceneRequest, options);
  const scene = new Group(), models = new Map<string, SeedmeshObject>();
  const output = (request as SceneRequest).output ?? {};
  await Promise.all(Object.entries(requests).map(async ([name, model]) => { models.set(name, await load(client, { ...model, output } as unknown as Request, options)); }));
  for (const name of Object.keys(requests)) {
    const matrices = placements.filter((each) => each.model === name).map(({ translation, rotation, scale }) =>
      new Matrix4().compose(new Vector3().fromArray(translation), new Quaternion().fromArray(rotation), new Vector3().fromArray(scale)));
    scene.add(copies_of(models.get(name)!, matrices));
  }
  return { scene, models };
}
