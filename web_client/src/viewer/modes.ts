/** The shading modes of the view other than the model's own materials, and the lines over it. */
import {
  DataTexture, DoubleSide, EdgesGeometry, InstancedMesh, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshNormalMaterial, MeshStandardMaterial, NearestFilter, LinearMipmapLinearFilter, RepeatWrapping, SRGBColorSpace,
  type BufferGeometry, type Material, type Object3D,
} from 'three';
import type { Model } from './model';
import { aside, patch, shift, type Cut } from './patch';

export type Mode = 'shaded' | 'flat' | 'normals' | 'uv';

/** 8 x 8 squares per UV unit. Hue depends on u and brightness on v, so that rotated or mirrored UVs are visible. */
function checker(): DataTexture {
  const side = 256, squares = 8;
  const data = new Uint8Array(side * side * 4);
  for (let y = 0; y < side; y += 1) {
    for (let x = 0; x < side; x += 1) {
      const light = ((x * squares / side | 0) + (y * squares / side | 0)) % 2 === 0;
      const rim = x * squares % side < squares || y * squares % side < squares;
      const at = (y * side + x) * 4;
      const [u, v] = [x / side, y / side];
      const shade = rim ? 0.25 : light ? 1 : 0.55;
      // From blue to orange along u, which colour-blind readers can distinguish.
      data[at] = 255 * shade * (0.1 + 0.8 * u);
      data[at + 1] = 255 * shade * (0.35 + 0.3 * v + 0.1 * u);
      data[at + 2] = 255 * shade * (0.85 - 0.75 * u);
      data[at + 3] = 255;
    }
  }
  const texture = new DataTexture(data, side, side);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = NearestFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}

/** True if any mesh of the model has UVs. */
export function has_uvs(model: Model): boolean {
  let has = false;
  model.each_mesh((mesh) => { has ||= Boolean(mesh.geometry.getAttribute('uv')); });
  return has;
}

/** Edges between faces with a smaller angle, in degrees, are not drawn. */
const least_angle = 25;
/** Limits of the edge display: faces per mesh, and copies per mesh. */
const most_faces = 200_000, most_copies = 2000;

export class Modes {
  mode: Mode = 'shaded';
  wireframe = false;
  /** Draws the edges where faces meet at an angle, without the other edges of the triangles. */
  edges = false;
  /** Nearly black lines with a white halo, one of which contrasts with any background. */
  private readonly line = new LineBasicMaterial({ color: 0x0b1020, toneMapped: false, transparent: true });
  private readonly halo = new LineBasicMaterial({ color: 0xffffff, toneMapped: false, transparent: true, opacity: 0.65 });
  readonly wire = new MeshBasicMaterial({ wireframe: true, transparent: true, opacity: 0.55 });
  private readonly normals = new MeshNormalMaterial({ side: DoubleSide });
  private squares: MeshBasicMaterial | null = null;
  /** The material of meshes without UVs in the UV mode, with a medium brightness so that wireframes are visible. */
  private readonly plain = new MeshStandardMaterial({ color: 0x9a958f, roughness: 1, side: DoubleSide });
  /** Replacements of alpha-tested materials, for the normals and UV modes. */
  private readonly cut = new WeakMap<Material, Map<Mode, Material>>();
  private wires: Object3D[] = [];
  private readonly edges_of = new WeakMap<BufferGeometry, EdgesGeometry>();

  constructor() { shift(this.halo); }

  /** The size of the view, in device pixels. */
  set_size(width: number, height: number): void { aside.value.set(2 / width, -2 / height); }

  /** Applies the current mode. Called whenever the model, its materials or a setting changes. */
  dress(models: Model[]): void {
    for (const wires of this.wires) wires.removeFromParent();
    this.wires = [];
    for (const model of models) model.each_mesh((mesh) => this.dress_mesh(model, mesh));
  }

  /** Removes the line objects, which are not part of the model. */
  forget(): void {
    for (const wires of this.wires) {
      wires.removeFromParent();
      if (wires instanceof LineSegments) wires.geometry.dispose();
    }
    this.wires = [];
  }

  private dress_mesh(model: Model, mesh: Mesh): void {
    const own = model.own_material(mesh);
    const worn = this.worn(own, mesh.geometry);
    mesh.material = worn;
    for (const material of [own].flat()) model.prepare(material);
    // Materials that all models share do not take part in a fade.
    if (model.sways) for (const material of [this.normals, this.squares, this.plain, this.wire]) if (material) patch(material, true, null);
    if (worn !== own && ![this.normals, this.squares, this.plain].includes(worn as MeshBasicMaterial)) patch(worn as Material, model.sways, model.fade, this.cut_of_mode());
    for (const material of [own, mesh.material].flat() as MeshStandardMaterial[]) {
      const flat = this.mode === 'flat';
      if ('flatShading' in material && material.flatShading !== flat && this.mode !== 'normals') {
        material.flatShading = flat;
        material.needsUpdate = true;
      }
      material.polygonOffset = this.wireframe || this.edges;
      material.polygonOffsetFactor = 1;
      material.polygonOffsetUnits = 1;
    }
    if (this.edges) this.draw_edges(mesh);
    if (!this.wireframe) return;
    const wires = mesh.clone(false);
    wires.material = this.wire;
    wires.castShadow = false;
    wires.userData = { helper: true };
    mesh.parent?.add(wires);
    this.wires.push(wires);
  }

  private draw_edges(mesh: Mesh): void {
    const { geometry } = mesh;
    if ((geometry.index?.count ?? geometry.getAttribute('position').count) / 3 > most_faces) return;
    const edges = this.edges_of.get(geometry) ?? new EdgesGeometry(geometry, least_angle);
    this.edges_of.set(geometry, edges);
    const copies = mesh instanceof InstancedMesh ? Math.min(mesh.count, most_copies) : 1;
    for (let index = 0; index < copies; index += 1) {
      for (const material of [this.halo, this.line]) {
        const lines = new LineSegments(edges, material);
        lines.matrix.copy(mesh.matrix);
        if (mesh instanceof InstancedMesh) {
          mesh.getMatrixAt(index, lines.matrix);
          lines.matrix.premultiply(mesh.matrix);
        }
        lines.matrixAutoUpdate = false;
        lines.renderOrder = material === this.line ? 1 : 0;
        lines.userData = { helper: true };
        mesh.parent?.add(lines);
        this.wires.push(lines);
      }
    }
  }

  /** The material that replaces a mesh's own material in the current mode. */
  private worn(own: Material | Material[], geometry: BufferGeometry): Material | Material[] {
    const { mode } = this;
    if (mode !== 'normals' && mode !== 'uv') return own;
    if (mode === 'uv' && !geometry.getAttribute('uv')) return this.plain;
    const shared = mode === 'normals' ? this.normals : this.unwrapped();
    const first = [own].flat()[0] as MeshStandardMaterial | undefined;
    if (!first?.map || !(first.alphaTest > 0)) return shared;
    const { map, alphaTest } = first;
    const known = this.cut.get(first) ?? new Map<Mode, Material>();
    this.cut.set(first, known);
    const worn = known.get(mode) ?? Object.assign(mode === 'normals' ? new MeshNormalMaterial() : new MeshBasicMaterial({ toneMapped: false }), { side: DoubleSide, map, alphaTest });
    if (!known.has(mode)) first.addEventListener('dispose', () => worn.dispose());
    known.set(mode, worn);
    return worn;
  }

  private cut_of_mode(): Cut { return this.mode === 'normals' ? 'normals' : { squares: this.unwrapped().map! }; }

  private unwrapped(): MeshBasicMaterial {
    this.squares ??= new MeshBasicMaterial({ map: checker(), side: DoubleSide, toneMapped: false });
    return this.squares;
  }
}
