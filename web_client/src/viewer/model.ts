/** A loaded glTF: its meshes, its animation clips, and its material variants. */
import {
  BasicDepthPacking, Box3, Line, LineLoop, LineSegments, Material, Mesh, MeshDepthMaterial, Points, Texture, Vector3, type AnimationClip, type BufferGeometry, type Object3D,
} from 'three';
import { GLTFLoader, type GLTF } from 'three/addons/loaders/GLTFLoader.js';
import { gather_copies } from './copies';
import { corners_of, points_of } from './frame';
import { patch, whole, type Fade } from './patch';

const variants_word = 'KHR_materials_variants';

interface Mapping { material: number; variants: number[] }

/**
 * Loaded with the first compressed file. This decoder is plain JavaScript, because the content security policy
 * forbids WebAssembly.
 */
const decoder = {
  supported: true,
  ready: Promise.resolve(),
  decodeGltfBufferAsync: async (count: number, stride: number, source: Uint8Array, mode: string, filter?: string): Promise<Uint8Array> =>
    (await import('../../node_modules/meshoptimizer/meshopt_decoder_reference.js')).MeshoptDecoder.decodeGltfBufferAsync(count, stride, source, mode, filter),
};

const loader = new GLTFLoader().setMeshoptDecoder(decoder as unknown as Parameters<GLTFLoader['setMeshoptDecoder']>[0]);  // the loader calls nothing else

export class Model {
  readonly root: Object3D;
  readonly clips: AnimationClip[];
  /** The names of the material variants; empty without variants. */
  readonly variants: string[];
  /** The bounding box of the model; a default box if the model is empty. */
  readonly box: Box3;
  readonly is_empty: boolean;
  /** Sample points of the outline. */
  readonly points: Vector3[];
  /** True if the vertices carry wind weights. */
  sways = false;
  /** Set for a model that is one of several levels of detail. */
  fade: Fade | null = null;
  private readonly gltf: GLTF;
  private readonly own = new Map<Mesh, Material | Material[]>();

  private constructor(gltf: GLTF) {
    this.gltf = gltf;
    this.root = gltf.scene;
    this.clips = gltf.animations;
    const json = gltf.parser.json as { extensions?: Record<string, { variants?: { name: string }[] }> };
    this.variants = (json.extensions?.[variants_word]?.variants ?? []).map((each) => each.name);
    if (this.clips.length === 0) gather_copies(this.root);
    this.box = new Box3().setFromObject(this.root);
    this.is_empty = this.box.isEmpty();
    if (this.is_empty) this.box.set(new Vector3(-0.5, 0, -0.5), new Vector3(0.5, 1, 0.5));
    this.points = points_of(this.root);
    if (this.points.length === 0) this.points = corners_of(this.box);
    this.each_mesh((mesh) => {
      if (mesh.geometry.getAttribute('uv2') && mesh.geometry.getAttribute('uv3')) {
        this.sways = true;
        // The shadow pass needs the same wind displacement.
        mesh.customDepthMaterial = new MeshDepthMaterial({ depthPacking: BasicDepthPacking });
        patch(mesh.customDepthMaterial, true, null);
      }
      mesh.castShadow = true;
      mesh.receiveShadow = true;
      this.own.set(mesh, mesh.material);
      // A skinned mesh leaves the bounding box of its first frame, so it is not culled.
      if (this.clips.length > 0) mesh.frustumCulled = false;
    });
  }

  /** Loads a GLB, or a glTF whose URIs can be fetched. */
  static async from(data: ArrayBuffer | string): Promise<Model> {
    return new Model(await loader.parseAsync(data, ''));
  }

  each_mesh(act: (mesh: Mesh) => void): void {
    this.root.traverse((part) => { if (part instanceof Mesh && !part.userData['helper']) act(part); });
  }

  /** The material that the file assigns to a mesh, even if another is shown. */
  own_material(mesh: Mesh): Material | Material[] {
    return this.own.get(mesh) ?? mesh.material;
  }

  /** Assigns the materials of a variant; null restores those of the file. */
  async wear(name: string | null): Promise<void> {
    const wanted = name === null ? -1 : this.variants.indexOf(name);
    const changes: Promise<void>[] = [];
    this.each_mesh((mesh) => {
      const extensions = mesh.userData['gltfExtensions'] as Record<string, { mappings: Mapping[] }> | undefined;
      const mapping = extensions?.[variants_word]?.mappings.find((each) => each.variants.includes(wanted));
      const first = (mesh.userData['first'] as Material | undefined) ?? (mesh.userData['first'] = this.own.get(mesh));
      if (wanted < 0 || !mapping) {
        this.own.set(mesh, first as Material);
        return;
      }
      changes.push((async () => {
        const kept = mesh.material;
        mesh.material = (await this.gltf.parser.getDependency('material', mapping.material)) as Material;
        this.gltf.parser.assignFinalMaterial(mesh);
        this.own.set(mesh, mesh.material);
        mesh.material = kept;
      })());
    });
    await Promise.all(changes);
  }

  /** Patches a material for the wind and the fade of this model. */
  prepare(material: Material): void {
    patch(material, this.sways, this.fade);
  }

  get triangles(): number {
    let count = 0;
    this.each_mesh((mesh) => {
      const instances = (mesh as Mesh & { count?: number }).count ?? 1;
      count += triangles_of(mesh.geometry) * instances;
    });
    return count;
  }

  /** The kind and the number of the primitives. */
  get pieces(): { name: string; count: number } {
    const { triangles } = this;
    let lines = 0, points = 0;
    this.root.traverse((part) => {
      const { geometry } = part as Mesh;
      const count = geometry?.index?.count ?? geometry?.getAttribute('position')?.count ?? 0;
      if (part instanceof Points) points += count;
      else if (part instanceof LineSegments) lines += count / 2;
      else if (part instanceof Line) lines += part instanceof LineLoop ? count : Math.max(0, count - 1);
    });
    return triangles === 0 && lines > 0 ? { name: 'Lines', count: lines } : triangles === 0 && points > 0 ? { name: 'Points', count: points } : { name: 'Triangles', count: triangles };
  }

  dispose(): void {
    this.root.removeFromParent();
    this.root.traverse((part) => {
      const { geometry, material } = part as Mesh;
      geometry?.dispose();
      part.customDepthMaterial?.dispose();
      // Temporary materials (normals, checkerboard) belong to the viewer and are not disposed of here.
      for (const each of [this.own.get(part as Mesh) ?? material ?? []].flat() as Material[]) {
        for (const value of Object.values(each)) if (value instanceof Texture) value.dispose();
        each.dispose();
      }
    });
  }
}

const triangles_of = (geometry: BufferGeometry): number =>
  Math.floor((geometry.index?.count ?? geometry.getAttribute('position')?.count ?? 0) / 3);

/** The duration of the fade between two levels, in milliseconds. */
const fade_time = 400;

/** The levels of one model, from fine to coarse. One is visible, or two during a fade. */
export class Levels {
  readonly models: Model[];
  private readonly still: boolean;
  private readonly counts: number[];
  private near = 0;
  private now = 0;
  private before = -1;
  private began = 0;

  /** `still` disables the fade. */
  constructor(models: Model[], still: boolean) {
    this.models = models;
    this.counts = models.map((model) => model.triangles);
    this.still = still;
    for (const model of models) model.fade = whole();
  }

  /**
   * Selects a level by number, or "auto": level 0 up to the distance `near`, and one level more for each doubling.
   */
  choose(level: number | 'auto', parent: Object3D, near: number): void {
    for (const model of this.models) parent.add(model.root);
    this.near = level === 'auto' ? near : 0;
    this.show(level === 'auto' ? 0 : level, false);
  }

  /** Called before each frame. `changed` reports a new level, `fading` whether more frames are needed. */
  at(distance: number): { changed: boolean; fading: boolean } {
    const ended = this.go_on();
    if (this.near === 0) return { changed: ended, fading: this.before >= 0 };
    const wanted = Math.max(0, Math.ceil(Math.log2(distance / this.near)));
    // Hysteresis of a tenth prevents flickering between two levels at their border.
    const closer = Math.max(0, Math.ceil(Math.log2((distance * 1.1) / this.near)));
    const next = Math.min(wanted < this.now ? closer : wanted, this.models.length - 1);
    if (next !== this.now) this.show(next, !this.still);
    return { changed: ended || next !== this.now, fading: this.before >= 0 };
  }

  get in_sight(): number { return this.now; }
  get triangles(): number { return this.counts[this.now] ?? 0; }
  get is_fading(): boolean { return this.before >= 0; }

  dispose(): void {
    for (const model of this.models) model.dispose();
  }

  private show(level: number, fades: boolean): void {
    const next = Math.min(level, this.models.length - 1);
    this.before = fades && next !== this.now ? this.now : -1;
    this.began = performance.now();
    this.now = next;
    this.models.forEach((model, index) => {
      model.root.visible = index === next || index === this.before;
      model.fade?.value.set(0, 2);
    });
    this.go_on();
  }

  /** Updates the fade; returns true when it ends. */
  private go_on(): boolean {
    const from = this.models[this.before], to = this.models[this.now];
    if (!from || !to) return false;
    const share = (performance.now() - this.began) / fade_time;
    to.fade?.value.set(0, share < 1 ? share : 2);
    from.fade?.value.set(share, 2);
    if (share < 1) return false;
    from.root.visible = false;
    this.before = -1;
    return true;
  }
}
