/** Models in three.js: loading with the decoder, levels of detail, growth, wind, copies. */
import { AnimationMixer, Box3, LOD, LoopOnce, Mesh, Sphere, Vector3, type AnimationAction, type Group, type Material, type Object3D, type WebGLProgramParametersWithUniforms } from 'three';
import { GLTFLoader, type GLTF } from 'three/addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import type { Client, GenerateOptions } from './client.js';
import type { Request } from './types.js';

export { copies_of, plant } from './copies.js';

/** Seconds of one loop of the wind. */
const wind_loop = 10;

// Trunk, branches and leaves move separately (Sousa, GPU Gems 3, chapter 16), by the weights of output.wind. Each frequency is a
// whole number of periods per loop. The displacement is in metres, and vertices of the profile web are in steps of the node's scale.
const sway_head = `
#ifndef USE_UV2
attribute vec2 uv2;
#endif
#ifndef USE_UV3
attribute vec2 uv3;
#endif
uniform vec3 seedmesh_wind;
vec3 seedmesh_sway(vec3 at) {
  float phase = uv3.x * 6.2832;
#ifdef USE_INSTANCING
  phase += dot(instanceMatrix[3].xz, vec2(0.7, 1.3));
#endif
  float lean = uv2.x * (0.65 + 0.25 * sin(seedmesh_wind.x) + 0.1 * sin(seedmesh_wind.x * 3.0));
  float swing = uv2.y * (0.5 * sin(seedmesh_wind.x * 3.0 + phase) + 0.3 * sin(seedmesh_wind.x * 5.0 + phase * 2.0));
  float flutter = uv3.y * sin(seedmesh_wind.x * 23.0 + phase * 5.0 + dot(at, vec3(2.1, 1.7, 2.9)));
  return seedmesh_wind.y * (lean * vec3(0.8, -0.12 * uv2.x, 0.5) + swing * vec3(0.3, 0.18, -0.25)) + seedmesh_wind.z * flutter * vec3(0.5, 0.9, -0.5);
}
`;
const sway_body = `
  float seedmesh_step = length(modelMatrix[0].xyz);
  transformed += seedmesh_sway(transformed * seedmesh_step) / seedmesh_step;
`;
const before_sway = '#include <project_vertex>';

export interface LoadOptions extends GenerateOptions {
  /** Vertical field of view of the camera in degrees, for the distances of levels of detail; 50 unless given. */
  field_of_view?: number;
}

/** A loaded model. Add `scene` to a scene and call `update` before each frame. */
export class SeedmeshObject {
  readonly scene: Group;
  readonly gltf: GLTF;
  /** One object for each mesh with levels of detail; three.js selects the level by distance. */
  readonly levels: LOD[] = [];
  /** True if the model has the weights of `output.wind`. */
  readonly has_wind: boolean;
  private readonly mixer: AnimationMixer;
  private action: AnimationAction | undefined;
  private readonly wind = { value: new Vector3() };

  private constructor(gltf: GLTF) {
    this.gltf = gltf;
    this.scene = gltf.scene;
    this.mixer = new AnimationMixer(gltf.scene);
    let has_wind = false;
    gltf.scene.traverse((each) => { has_wind ||= sways(each); });
    this.has_wind = has_wind;
    if (gltf.animations.length) gltf.scene.traverse((each) => { each.frustumCulled = false; });  // a skin leaves the bounds of its first frame
  }

  /** Reads a GLB. The loader is given only if it has further plug-ins. */
  static async parse(data: ArrayBuffer, field_of_view = 50, loader = new GLTFLoader()): Promise<SeedmeshObject> {
    const object = new SeedmeshObject(await loader.setMeshoptDecoder(MeshoptDecoder).parseAsync(data, ''));
    await object.make_levels(field_of_view);
    object.scene.traverse((each) => { if (sways(each)) for (const material of materials_of(each as Mesh)) object.patch(material); });
    return object;
  }

  /** Plays `output.animation: "growth"` from the beginning and stays at the full size. Returns false without an animation. */
  play_growth(speed = 1): boolean {
    const clip = this.gltf.animations[0];
    if (!clip) return false;
    this.action = this.mixer.clipAction(clip).reset().setLoop(LoopOnce, 1).setEffectiveTimeScale(speed);
    this.action.clampWhenFinished = true;
    this.action.play();
    this.mixer.update(0);
    return true;
  }

  get is_growing(): boolean { return this.action?.isRunning() ?? false; }

  /** The strength of the wind: 1 is a breeze, 0 calm. */
  set_wind(strength: number): void {
    const height = new Box3().setFromObject(this.scene).getSize(new Vector3()).y;
    this.wind.value.y = 0.07 * height * strength;
    this.wind.value.z = 0.006 * height * strength;
  }

  /** Advances growth and wind by seconds. */
  update(seconds: number): void {
    this.mixer.update(seconds);
    this.wind.value.x = (this.wind.value.x + (2 * Math.PI * seconds) / wind_loop) % (2 * Math.PI);
  }

  /** Frees what the graphics card holds of this model. */
  dispose(): void {
    this.scene.traverse((each) => {
      if (!(each instanceof Mesh)) return;
      each.geometry.dispose();
      for (const material of materials_of(each)) {
        for (const value of Object.values(material)) if (value && typeof value === 'object' && 'isTexture' in value) (value as { dispose(): void }).dispose();
        material.dispose();
      }
    });
  }

  /** Replaces each node that names levels (MSFT_lod) by a LOD with the distances of its screen coverage. */
  private async make_levels(field_of_view: number): Promise<void> {
    const { parser } = this.gltf;
    const json = parser.json as { nodes?: { extensions?: { MSFT_lod?: { ids: number[] } }; extras?: { MSFT_screencoverage?: number[]; levels?: { hysteresis: number } } }[] };
    // A coarser level is left where the model has grown by the factor 1 + hysteresis. Three wants the part of the distance.
    const grown = json.nodes?.find((node) => node.extras?.levels)?.extras?.levels?.hysteresis ?? 0;
    const hysteresis = grown / (1 + grown);
    const radius = new Box3().setFromObject(this.scene).getBoundingSphere(new Sphere()).radius;
    const nodes = new Map<number, Object3D>();
    for (const [object, place] of parser.associations) {
      const index = (place as { nodes?: number } | undefined)?.nodes;
      if (index !== undefined && 'isObject3D' in object) nodes.set(index, object as Object3D);
    }
    for (const [index, node] of (json.nodes ?? []).entries()) {
      const ids = node.extensions?.MSFT_lod?.ids, finest = nodes.get(index), parent = finest?.parent;
      if (!ids || !finest || !parent) continue;
      const lod = new LOD();
      lod.name = finest.name;
      const coverage = node.extras?.MSFT_screencoverage ?? [];
      parent.add(lod);
      lod.addLevel(finest, 0);
      for (const [level, id] of ids.entries()) {
        // A level covers less of the screen's height than its threshold: twice the radius, seen from this distance.
        const share = coverage[level] ?? 0.5 ** (level + 1);
        const coarser = await parser.getDependency('node', id) as Object3D;
        coarser.visible = false;  // until the first update, so that hysteresis does not hold it
        lod.addLevel(coarser, radius / (share * Math.tan((field_of_view * Math.PI) / 360)), hysteresis);
      }
      this.levels.push(lod);
    }
  }

  private patch(material: Material): void {
    material.onBeforeCompile = (program: WebGLProgramParametersWithUniforms) => {
      program.uniforms['seedmesh_wind'] = this.wind;
      program.vertexShader = sway_head + program.vertexShader.replace(before_sway, sway_body + before_sway);
    };
    material.customProgramCacheKey = () => 'seedmesh_wind';
  }
}

function sways(object: Object3D): boolean {
  return object instanceof Mesh && object.geometry.getAttribute('uv2') !== undefined && object.geometry.getAttribute('uv3') !== undefined;
}

const materials_of = (mesh: Mesh): Material[] => (Array.isArray(mesh.material) ? mesh.material : [mesh.material]);

/** Makes and loads a model in the profile web, unless the request names another. */
export async function load(client: Client, request: Request, options: LoadOptions = {}): Promise<SeedmeshObject> {
  const { data } = await client.generate({ ...request, output: { profile: 'web', ...request.output } } as Request, options);
  return SeedmeshObject.parse(data, options.field_of_view);
}
