/** The picture. Draws when something changed, never otherwise; keeps one model and lets go of the one before. */
import {
  Box3, Material, Mesh, MeshBasicMaterial, NeutralToneMapping, Object3D, PCFShadowMap, PerspectiveCamera, Scene,
  Spherical, Texture, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { corners_of, points_of, stand_back, usual_direction } from './frame';
import { Stage } from './stage';

export interface Look {
  /** low: no shadows, no smoothing, one pixel a pixel; for machines that draw without a graphics card. */
  quality: 'high' | 'low';
  dark: boolean;
  still: boolean;
  /** Pixels at the lower rim that something else covers: a model that is fitted stays above. */
  covered: number;
}

export class Viewer {
  /** Called when the picture is lost and when it is back. */
  on_context: (lost: boolean) => void = () => {};
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(32, 1, 0.01, 1000);
  private readonly controls: OrbitControls;
  private readonly loader = new GLTFLoader();
  private readonly stage: Stage;
  private readonly canvas: HTMLCanvasElement;
  private readonly wire = new MeshBasicMaterial({ wireframe: true, transparent: true, opacity: 0.55 });
  private model: Object3D | null = null;
  private wires: Object3D[] = [];
  private box = new Box3(new Vector3(-1, 0, -1), new Vector3(1, 2, 1));
  private points = corners_of(this.box);
  private wireframe = false;
  private touched = false;
  private readonly covered: number;
  private frame = 0;
  /** Part of the height that nothing covers. */
  private free = 1;

  constructor(canvas: HTMLCanvasElement, look: Look) {
    const high = look.quality === 'high';
    this.canvas = canvas;
    this.covered = look.covered;
    this.renderer = new WebGLRenderer({ canvas, alpha: true, antialias: high, powerPreference: 'high-performance' });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1;
    this.renderer.setPixelRatio(high ? Math.min(devicePixelRatio, 2) : 1);
    this.renderer.shadowMap.enabled = high;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.stage = new Stage(high);
    this.scene.add(this.stage.group);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !look.still;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = Math.PI * 0.6;
    this.controls.addEventListener('change', () => this.draw());
    this.controls.addEventListener('start', () => { this.touched = true; });
    canvas.addEventListener('webglcontextlost', (event) => { event.preventDefault(); this.on_context(true); });
    canvas.addEventListener('webglcontextrestored', () => { this.renderer.shadowMap.needsUpdate = true; this.on_context(false); this.draw(); });
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement ?? canvas);
    this.set_theme(look.dark);
    this.resize();
    this.fit();
  }

  /** Takes a GLB in place of the model that is shown. The camera stays where a hand has put it. */
  async show(bytes: ArrayBuffer, keep_camera: boolean): Promise<void> {
    const model = (await this.loader.parseAsync(bytes, '')).scene;
    this.let_go();
    this.model = model;
    const high = this.renderer.shadowMap.enabled;
    model.traverse((part) => {
      if (!(part instanceof Mesh)) return;
      part.castShadow = high;
      part.receiveShadow = high;
    });
    this.scene.add(model);
    const box = new Box3().setFromObject(model);
    if (box.isEmpty()) box.set(new Vector3(-0.5, 0, -0.5), new Vector3(0.5, 1, 0.5));
    const grown = box.getSize(new Vector3()).length() / this.box.getSize(new Vector3()).length();
    this.box = box;
    this.points = points_of(model);
    if (this.points.length === 0) this.points = corners_of(box);
    this.stage.surround(box);
    this.set_wireframe(this.wireframe);
    this.renderer.shadowMap.needsUpdate = true;
    if (!keep_camera || !this.touched || grown > 2 || grown < 0.5) this.fit();
    await this.drawn();
  }

  fit(): void {
    this.touched = false;
    // What is left of a hand's motion would carry the camera on.
    const damping = this.controls.enableDamping;
    this.controls.enableDamping = false;
    this.controls.update();
    this.controls.enableDamping = damping;
    this.controls.target.copy(stand_back(this.camera, [...this.points, ...this.stage.sight(this.box)], usual_direction(this.box), this.free));
    this.controls.minDistance = this.camera.near * 4;
    this.controls.maxDistance = this.camera.far / 4;
    this.controls.update();
    this.draw();
  }

  /** Turns round the model, by radians, and scales the distance. */
  orbit(turn: number, tilt: number, distance: number): void {
    this.touched = true;
    const offset = new Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    offset.theta += turn;
    offset.phi = Math.min(Math.max(offset.phi + tilt, 0.05), this.controls.maxPolarAngle);
    offset.radius *= distance;
    this.camera.position.copy(this.controls.target).add(new Vector3().setFromSpherical(offset));
    this.controls.update();
    this.draw();
  }

  /** Lines over the shaded faces, so that hidden edges stay hidden. */
  set_wireframe(on: boolean): void {
    this.wireframe = on;
    for (const wires of this.wires) wires.removeFromParent();
    this.wires = [];
    this.model?.traverse((part) => {
      if (!(part instanceof Mesh)) return;
      for (const material of [part.material].flat() as Material[]) {
        material.polygonOffset = on;
        material.polygonOffsetFactor = 1;
        material.polygonOffsetUnits = 1;
      }
      if (on) this.wires.push(part);
    });
    this.wires = this.wires.map((part) => {
      const wires = (part as Mesh).clone(false);
      wires.material = this.wire;
      wires.castShadow = false;
      part.parent?.add(wires);
      return wires;
    });
    this.draw();
  }

  set_grid(on: boolean): void {
    this.stage.grid_visible = on;
    this.draw();
  }

  set_figure(on: boolean): void {
    this.stage.show_figure(on, this.box);
    this.renderer.shadowMap.needsUpdate = true;
    if (this.touched) this.draw();
    else this.fit();
  }

  set_theme(dark: boolean): void {
    this.stage.set_theme(dark);
    this.wire.color.set(dark ? 0xf2f7f4 : 0x10231a);
    this.draw();
  }

  /** Width, height and depth of the model in metres, and the side of a cell of the grid. */
  get measures(): { size: Vector3; cell: number } {
    return { size: this.box.getSize(new Vector3()), cell: this.stage.cell };
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement ?? this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.setViewOffset(clientWidth, clientHeight, 0, this.covered / 2, clientWidth, clientHeight);
    this.free = Math.max(0.3, 1 - this.covered / clientHeight);
    if (this.touched) this.render();
    else { this.fit(); this.render(); }
  }

  private draw(): void {
    this.frame ||= requestAnimationFrame(() => this.render());
  }

  private render(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    // While the motion dies down this asks for the next picture by the event "change".
    this.controls.update();
    if (!this.renderer.getContext().isContextLost()) this.renderer.render(this.scene, this.camera);
  }

  private drawn(): Promise<void> {
    this.draw();
    // A page in the background draws nothing; it is not waited for.
    return new Promise((resolve) => {
      requestAnimationFrame(() => resolve());
      setTimeout(resolve, 1000);
    });
  }

  private let_go(): void {
    if (!this.model) return;
    for (const wires of this.wires) wires.removeFromParent();
    this.wires = [];
    this.model.removeFromParent();
    this.model.traverse((part) => {
      const { geometry, material } = part as Mesh;
      geometry?.dispose();
      for (const each of material ? ([material].flat() as Material[]) : []) {
        for (const value of Object.values(each)) if (value instanceof Texture) value.dispose();
        each.dispose();
      }
    });
    this.model = null;
  }
}
