/** Converts nodes that share a mesh to one instanced mesh, so that they need one draw call. */
import { InstancedMesh, Matrix4, Mesh, type Material, type Object3D } from 'three';

/** With fewer copies, instancing is not faster. */
const fewest = 6;

/** Replaces the copies below `root`. Copies that are animated, mirrored, or have children stay as they are. */
export function gather_copies(root: Object3D): void {
  root.updateMatrixWorld(true);
  const groups = new Map<string, Mesh[]>();
  root.traverse((part) => {
    const mesh = part as Mesh & { isSkinnedMesh?: boolean; isInstancedMesh?: boolean };
    if (!mesh.isMesh || mesh.isSkinnedMesh || mesh.isInstancedMesh || mesh.children.length > 0 || mesh.morphTargetInfluences) return;
    // A mirrored copy reverses the winding of its triangles, which an instance cannot do.
    if (mesh.matrixWorld.determinant() <= 0) return;
    const key = `${mesh.geometry.uuid} ${[mesh.material].flat().map((each) => each.uuid).join(' ')}`;
    const group = groups.get(key);
    if (group) group.push(mesh);
    else groups.set(key, [mesh]);
  });
  const from_root = root.matrixWorld.clone().invert();
  for (const copies of groups.values()) {
    const [first] = copies;
    if (!first || copies.length < fewest) continue;
    const all = new InstancedMesh(first.geometry, first.material as Material, copies.length);
    copies.forEach((copy, index) => {
      all.setMatrixAt(index, new Matrix4().multiplyMatrices(from_root, copy.matrixWorld));
      copy.removeFromParent();
    });
    all.name = first.name;
    all.userData = first.userData;
    root.add(all);
  }
}
