/** Scope boxes over the model: the shapes of a derivation, apart from its triangles, and which of them was pointed at. */
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments, Matrix4, Ray, Vector3, Group } from 'three';

/** A box by its lower corner, its axes (unit, in the world) and its size along them, in metres. */
export interface ScopeBox { origin: number[]; axes: number[][]; size: number[] }

const edges = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]] as const;
/** The palette of Okabe and Ito, which people with any kind of colour vision tell apart. */
export const tellable = [0xe69f00, 0x56b4e9, 0x009e73, 0xd55e00, 0xcc79a7, 0x0072b2] as const;

const vector = (numbers: number[] | undefined): Vector3 => new Vector3(numbers?.[0] ?? 0, numbers?.[1] ?? 0, numbers?.[2] ?? 0);

function corners(box: ScopeBox): Vector3[] {
  return Array.from({ length: 8 }, (_, corner) => [0, 1, 2].reduce(
    (at, axis) => at.addScaledVector(vector(box.axes[axis]), corner >> axis & 1 ? (box.size[axis] ?? 0) : 0), vector(box.origin)));
}

/** Lines of all boxes, one colour for each group of `color_of`. */
export function draw_boxes(boxes: ScopeBox[], color_of: (index: number) => number): Group {
  const by_color = new Map<number, number[]>();
  boxes.forEach((box, index) => {
    const color = color_of(index) % tellable.length;
    const lines = by_color.get(color) ?? [];
    by_color.set(color, lines);
    const at = corners(box);
    for (const [from, to] of edges) lines.push(...at[from]!.toArray(), ...at[to]!.toArray());
  });
  const group = new Group();
  for (const [color, lines] of by_color) {
    const geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(lines, 3));
    const drawn = new LineSegments(geometry, new LineBasicMaterial({ color: tellable[color] ?? 0xffffff, toneMapped: false, depthTest: true }));
    drawn.userData = { helper: true };
    group.add(drawn);
  }
  return group;
}

/** Takes lines away and gives their memory back. */
export function drop_boxes(drawn: Group | null): void {
  drawn?.removeFromParent();
  for (const each of drawn?.children ?? []) {
    (each as LineSegments).geometry.dispose();
    ((each as LineSegments).material as LineBasicMaterial).dispose();
  }
}

/** The smallest box that a ray meets; -1 where it meets none. A flat scope is given a little depth. */
export function box_at(boxes: ScopeBox[], ray: Ray): number {
  let found = -1, least = Infinity;
  boxes.forEach((box, index) => {
    const [x, y, z] = [vector(box.axes[0]), vector(box.axes[1]), vector(box.axes[2])];
    const into = new Matrix4().makeBasis(x, y, z).setPosition(vector(box.origin)).invert();
    const local = ray.clone().applyMatrix4(into);
    const size = vector(box.size), thin = Math.max(size.x, size.y, size.z) * 0.005;
    let near = 0, far = Infinity;
    for (const axis of ['x', 'y', 'z'] as const) {
      const low = (-thin - local.origin[axis]) / local.direction[axis], high = (size[axis] + thin - local.origin[axis]) / local.direction[axis];
      near = Math.max(near, Math.min(low, high));
      far = Math.min(far, Math.max(low, high));
    }
    const volume = (size.x + thin) * (size.y + thin) * (size.z + thin);
    if (near <= far && volume < least) { least = volume; found = index; }
  });
  return found;
}
