/** The scope boxes of a derivation over the model, and picking of a box. */
import {
  BoxGeometry, BufferGeometry, DoubleSide, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, Ray, Vector3, type Material, type Scene,
} from 'three';

/** A box by its minimum corner, its unit axes in world space, and its sizes along them, in metres. */
export interface ScopeBox { origin: number[]; axes: number[][]; size: number[] }

const edges = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]] as const;
/** The palette of Okabe and Ito, which is safe for all types of colour blindness. */
export const tellable = [0xe69f00, 0x56b4e9, 0x009e73, 0xd55e00, 0xcc79a7, 0x0072b2] as const;

const vector = (numbers: number[] | undefined): Vector3 => new Vector3(numbers?.[0] ?? 0, numbers?.[1] ?? 0, numbers?.[2] ?? 0);

function corners(box: ScopeBox): Vector3[] {
  return Array.from({ length: 8 }, (_, corner) => [0, 1, 2].reduce(
    (at, axis) => at.addScaledVector(vector(box.axes[axis]), corner >> axis & 1 ? (box.size[axis] ?? 0) : 0), vector(box.origin)));
}

/** The edges of all boxes, in one colour per group of `color_of`. */
function draw_boxes(boxes: ScopeBox[], color_of: (index: number) => number): Group {
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

/** One highlighted box: filled in yellow, which the palette omits, with its edges drawn without a depth test. */
function draw_mark(box: ScopeBox): Group {
  const lines: number[] = [];
  const at = corners(box);
  for (const [from, to] of edges) lines.push(...at[from]!.toArray(), ...at[to]!.toArray());
  const edge = new LineSegments(
    new BufferGeometry().setAttribute('position', new Float32BufferAttribute(lines, 3)), new LineBasicMaterial({ color: 0x000000, toneMapped: false, depthTest: false }));
  const size = vector(box.size), largest = Math.max(size.x, size.y, size.z);
  const body = new Mesh(new BoxGeometry(), new MeshBasicMaterial({ color: 0xf0e442, toneMapped: false, transparent: true, opacity: 0.3, side: DoubleSide, depthTest: false, depthWrite: false }));
  const [x, y, z] = [vector(box.axes[0]), vector(box.axes[1]), vector(box.axes[2])];
  // A flat scope would be invisible edge-on, so it gets a minimum thickness.
  body.matrix.makeBasis(x, y, z).scale(size.clone().max(new Vector3().setScalar(largest * 0.002))).setPosition(at[0]!.clone().add(at[7]!).multiplyScalar(0.5));
  body.matrixAutoUpdate = false;
  body.renderOrder = 2;
  edge.renderOrder = 3;
  const group = new Group().add(body, edge);
  for (const each of group.children) each.userData = { helper: true };
  return group;
}

/** Removes an object from the scene and disposes of its GPU resources. */
export function drop_boxes(drawn: Group | null): void {
  drawn?.removeFromParent();
  for (const each of drawn?.children ?? []) {
    (each as LineSegments).geometry.dispose();
    ((each as LineSegments).material as Material).dispose();
  }
}

/** The boxes shown over the model, at most one of which is highlighted. */
export class Scopes {
  private readonly scene: Scene;
  private boxes: ScopeBox[] | null = null;
  private drawn: Group | null = null;
  private marked: Group | null = null;

  constructor(scene: Scene) { this.scene = scene; }

  /** null removes the boxes and the highlight. */
  set(boxes: ScopeBox[] | null, color_of: (index: number) => number): void {
    drop_boxes(this.drawn);
    this.boxes = boxes;
    this.drawn = boxes && draw_boxes(boxes, color_of);
    if (this.drawn) this.scene.add(this.drawn);
    this.mark(-1);
  }

  /** Highlights the box with this index; -1 highlights none. */
  mark(index: number): void {
    drop_boxes(this.marked);
    const box = this.boxes?.[index];
    this.marked = box ? draw_mark(box) : null;
    if (this.marked) this.scene.add(this.marked);
  }

  /** The index of the box that a ray hits, -1 for none; null if no boxes are shown. */
  at(ray: Ray): number | null { return this.boxes && box_at(this.boxes, ray); }
}

/** The index of the smallest box that a ray hits, or -1. A flat scope gets a small thickness. */
function box_at(boxes: ScopeBox[], ray: Ray): number {
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
