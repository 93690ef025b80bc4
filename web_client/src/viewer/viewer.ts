/** The view. It renders only after changes, and holds one model at a time. */
import { Box3, Fog, NeutralToneMapping, PCFShadowMap, Scene, Vector3, WebGLRenderer, type Group, type PerspectiveCamera } from 'three';
import { measured } from '../grower';
import { Comparison } from './comparison';
import { Scopes, drop_boxes, type ScopeBox } from './boxes';
import { OrbitCamera } from './orbit_camera';
import { corners_of, type Covered } from './frame';
import { wire_ground } from './ground';
import { Levels, Model } from './model';
import { Modes, type Mode } from './modes';
import { Motion } from './motion';
import { draw_portrait } from './portrait';
import { Stage, type Sun } from './stage';
import { wait_for } from './clock';
import { on_tap, ray_of } from './tap';
import { Walker, type Gait } from './walker';
import { levels_of } from './zip';

export interface Look {
  /** low: no shadows, no antialiasing, a pixel ratio of 1; for machines without a graphics card. */
  quality: 'high' | 'low';
  dark: boolean;
  still: boolean;
  /** The overlays at the edges of the view. A fitted model is placed between them. */
  covered: Covered;
}

export class Viewer {
  /** Called when the WebGL context is lost and when it is restored. */
  on_context: (lost: boolean) => void = () => {};
  /** Called with the index of the scope box under the pointer; -1 for none. */
  on_pick: (index: number) => void = () => {};
  /**
   * Called after each frame with its rendering time and, in continuous rendering, the time since the previous frame,
   * in milliseconds.
   */
  on_drawn: (milliseconds: number, frame: number | null) => void = () => {};
  readonly motion = new Motion();
  readonly walker: Walker;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly eye: OrbitCamera;
  private readonly stage: Stage;
  private readonly canvas: HTMLCanvasElement;
  private readonly modes = new Modes();
  private model: Model | null = null;
  private levels: Levels | null = null;
  private readonly beside = new Comparison();
  private variant: string | null = null;
  private readonly scopes = new Scopes(this.scene);
  private marks: Group | null = null;
  private box = new Box3(new Vector3(-1, 0, -1), new Vector3(1, 2, 1));
  private points = corners_of(this.box);
  private has_fog = false;
  /** Keeps the camera in place for every model, so that growth is visible. */
  held = false;
  private frame = 0;
  private last_begin = 0;
  /** True until the model has been drawn for the first time. */
  private is_new = false;
  private is_timed = false;
  /** Disables all animation (prefers-reduced-motion). */
  readonly is_still: boolean;

  constructor(canvas: HTMLCanvasElement, look: Look) {
    const high = look.quality === 'high';
    this.canvas = canvas;
    this.is_still = look.still;
    this.renderer = new WebGLRenderer({ canvas, alpha: true, antialias: high, powerPreference: 'high-performance' });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1;
    this.renderer.setPixelRatio(high ? Math.min(devicePixelRatio, 2) : 1);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.stage = new Stage(high);
    this.scene.add(this.stage.group);
    this.eye = new OrbitCamera(canvas, look.covered, look.still, () => this.draw());
    this.walker = new Walker(this.camera, canvas, () => this.draw());
    canvas.addEventListener('webglcontextlost', (event) => { event.preventDefault(); this.on_context(true); });
    canvas.addEventListener('webglcontextrestored', () => { this.renderer.shadowMap.needsUpdate = true; this.on_context(false); this.draw(); });
    on_tap(canvas, (event) => { if (event.button === 0) this.pick(event); });
    wire_ground(canvas, { camera: this.camera, model: () => this.model?.root ?? null, floor: () => this.stage.floor },
      (marks) => this.set_marks(marks));
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement ?? canvas);
    this.set_theme(look.dark);
    this.resize();
    this.fit();
  }

  /** Replaces the model by a GLB. The camera stays if the user has moved it. */
  async show(bytes: ArrayBuffer, keep_camera: boolean): Promise<Model> {
    const begin = performance.now();
    const model = await Model.from(bytes);
    measured('read', begin);
    if (this.variant !== null && model.variants.includes(this.variant)) await model.wear(this.variant);
    this.let_go();
    this.model = model;
    this.is_new = true;
    this.scene.add(model.root);
    this.motion.take(model);
    this.box = model.box;
    this.points = model.points;
    this.stage.surround(model.box);
    this.place_fog();
    this.eye.stop_at(model);
    this.walker.land(model.root, this.stage.floor, model.box);
    this.dress();
    if (!this.held && (!keep_camera || !this.is_framed())) this.frame_model();
    this.canvas.dispatchEvent(new CustomEvent('ground-changed'));
    await this.drawn();
    return model;
  }

  /** Fits the model into the view, in orbit mode. */
  fit(): void { if (this.walker.gait === 'orbit') this.frame_model(); }

  /** The points that have to be visible. */
  private get sight(): Vector3[] { return [...this.points, ...(this.beside.other?.points ?? []), ...this.stage.sight(this.box)]; }

  private get camera(): PerspectiveCamera { return this.eye.camera; }

  /**
   * True if the model can be viewed from the current camera position, so that the sizes of models can be compared.
   */
  private is_framed(): boolean {
    return this.walker.gait !== 'orbit' || this.eye.suits(this.sight, this.box);
  }

  /** In the walking and flying modes, movement continues from this position. */
  private frame_model(): void {
    this.eye.touched = false;
    this.eye.put(this.sight, this.box);
    if (this.walker.gait === 'orbit') this.eye.controls.update();
    else this.walker.begin(this.walker.gait);
    this.draw();
  }

  /** Rotates around the model, in radians, and scales the distance. */
  orbit(turn: number, tilt: number, distance: number): void {
    if (distance < 1) this.eye.limit_zoom();
    this.eye.orbit(turn, tilt, distance);
    this.draw();
  }

  /** Wireframe lines over the shaded faces, so that hidden edges stay hidden. */
  set_wireframe(on: boolean): void {
    this.modes.wireframe = on;
    this.dress();
  }

  /** Lines at the edges where faces meet at an angle. */
  set_edges(on: boolean): void {
    this.modes.edges = on;
    this.dress();
  }

  set_mode(mode: Mode): void {
    this.modes.mode = mode;
    this.dress();
  }

  /** Selects the material variant by name for this model and later ones; null selects the model's own materials. */
  async set_variant(name: string | null): Promise<void> {
    this.variant = name;
    await Promise.all(this.all_models().map((model) => model.wear(name)));
    this.dress();
  }

  /**
   * Loads the levels of a zip and returns the triangle count of each, from fine to coarse; null if another model was
   * shown meanwhile.
   */
  async take_levels(bytes: ArrayBuffer): Promise<number[] | null> {
    const { model: of } = this;
    const models = await levels_of(bytes);
    if (this.variant !== null) await Promise.all(models.map((model) => model.wear(this.variant)));
    if (this.model !== of) { for (const model of models) model.dispose(); return null; }
    this.levels?.dispose();
    this.levels = new Levels(models, this.is_still);
    return models.map((model) => model.triangles);
  }

  /** Selects a level of detail, "auto" by distance, or null for the original model. */
  choose_level(level: number | 'auto' | null): void {
    if (!this.model) return;
    this.model.root.visible = level === null || !this.levels;
    if (level === null) {
      this.levels?.dispose();
      this.levels = null;
    } else {
      this.levels?.choose(level, this.scene, this.eye.framed.distance * 1.5);
    }
    this.dress();
  }

  /** The visible level; null without levels. */
  get level(): number | null { return this.levels?.in_sight ?? null; }

  /** The number of triangles of the visible level. */
  get level_triangles(): number | null { return this.levels?.triangles ?? null; }

  /** Shows or hides the person. By default the person is shown if it is a useful scale. */
  get has_figure(): boolean { return this.stage.has_figure; }

  set_grid(on: boolean): void { this.stage.grid_visible = on; this.draw(); }

  set_figure(on: boolean): void {
    this.stage.show_figure(on, this.box);
    this.cast();
    if (this.eye.touched) this.draw();
    else this.fit();
  }

  set_theme(dark: boolean): void {
    this.stage.set_theme(dark);
    this.modes.wire.color.set(dark ? 0xf2f7f4 : 0x10231a);
    this.place_fog();
    this.draw();
  }

  set_sky(on: boolean): void {
    this.scene.background = this.stage.set_sky(on);
    this.draw();
  }

  /** Fog that begins behind the nearest point of the model and hides what is far behind it. */
  set_fog(on: boolean): void {
    this.has_fog = on;
    this.place_fog();
    this.draw();
  }

  private place_fog(): void {
    const size = this.box.getSize(new Vector3()).length();
    this.scene.fog = this.has_fog ? new Fog(this.stage.haze, size * 0.6, size * 3) : null;
  }

  /** The colour of the movable light, as #rrggbb. */
  set_light_color(color: string): void {
    this.stage.set_light_color(color);
    this.draw();
  }

  set_shadow(on: boolean): void {
    this.stage.set_shadow(on);
    this.cast();
  }

  set_sun(sun: Sun): void {
    this.stage.set_sun(sun);
    this.scene.background = this.stage.sky_background;
    this.cast();
  }

  /** Switches between orbit, walking and flying. Orbit fits the model again. */
  set_gait(gait: Gait): void {
    this.eye.controls.enabled = gait === 'orbit';
    this.walker.begin(gait);
    if (gait === 'orbit') this.fit();
    this.draw();
  }

  /** Pauses the clip at a fraction of its duration, or plays it. */
  set_time(share: number): void {
    this.motion.stand(share);
    this.cast();
  }

  play(on: boolean): void {
    this.motion.run(on);
    this.draw();
  }

  /** Shows another model to the left of the divider, under the same camera; null removes it. */
  async compare(bytes: ArrayBuffer | null): Promise<void> {
    await this.beside.take(bytes);
    this.dress();
  }

  set_divider(share: number): void {
    this.beside.divider = share;
    this.draw();
  }

  /** Shows the boxes of shapes over the model; null removes them. */
  set_boxes(scopes: ScopeBox[] | null, color_of: (index: number) => number = () => 0): void {
    this.scopes.set(scopes, color_of);
    this.draw();
  }

  /** Highlights one of these boxes; -1 highlights none. */
  mark_box(index: number): void {
    this.scopes.mark(index);
    this.draw();
  }

  /** Waits for the end of every frame to measure its time, and renders a frame at once. */
  set_timed(on: boolean): void {
    this.is_timed = on;
    this.draw();
  }

  private set_marks(marks: Group | null): void {
    if (!marks && !this.marks) return;
    drop_boxes(this.marks);
    this.marks = marks;
    if (marks) this.scene.add(marks);
    this.draw();
  }

  /** Width, height and depth of the model in metres, null if it is empty, and the side of a grid cell. */
  get measures(): { size: Vector3 | null; cell: number } {
    return { size: this.model?.is_empty ? null : this.box.getSize(new Vector3()), cell: this.stage.cell };
  }

  /** The overlays at the edges of the view. With `anew`, the model is fitted into the free space. */
  set_covered(covered: Covered, anew = false): void {
    this.eye.covered = covered;
    // A change that is temporary, such as a comparison, must not change the scale.
    if (!this.eye.touched && (anew || !this.eye.sees(this.sight))) this.fit();
  }

  /** The current view as a PNG. */
  screenshot(): Promise<Blob | null> {
    this.render();
    return new Promise((resolve) => this.canvas.toBlob(resolve, 'image/png'));
  }

  /**
   * Renders a thumbnail of another model with the same renderer, between two frames. Browsers limit the number of
   * WebGL contexts.
   */
  async portrait(bytes: ArrayBuffer, width: number, height: number): Promise<HTMLCanvasElement> {
    const picture = draw_portrait(this.renderer, this.scene, this.stage, await Model.from(bytes), width, height);
    this.stage.surround(this.box);
    this.renderer.shadowMap.needsUpdate = true;
    this.render();
    return picture;
  }

  private all_models(): Model[] {
    return [this.model, this.beside.other, ...(this.levels?.models ?? [])].filter((model): model is Model => model !== null);
  }

  private dress(): void {
    this.modes.dress(this.all_models());
    this.cast();
  }

  private cast(): void { this.renderer.shadowMap.needsUpdate = true; this.draw(); }

  private pick(event: MouseEvent): void {
    const index = this.scopes.at(ray_of(this.canvas, this.camera, event).ray);
    if (index !== null) this.on_pick(index);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement ?? this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    if (this.walker.gait === 'orbit') this.eye.resize(clientWidth, clientHeight, this.sight, this.box);
    else this.eye.widen(clientWidth, clientHeight);
    this.modes.set_size(this.canvas.width, this.canvas.height);
    if (!this.eye.touched) this.fit();
    this.render();
  }

  private draw(): void { this.frame ||= requestAnimationFrame(() => this.render()); }

  private render(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    const begin = performance.now();
    // During damping, the controls request the next frame by their "change" event.
    if (this.walker.gait === 'orbit') this.eye.controls.update();
    const goes_on = [this.walker.step(), this.motion.step()].some(Boolean);
    const detail = this.levels?.at(this.camera.position.distanceTo(this.eye.controls.target));
    if (this.motion.is_running || detail?.changed) this.renderer.shadowMap.needsUpdate = true;
    if (!this.renderer.getContext().isContextLost()) {
      this.beside.render(this.renderer, this.scene, this.camera, this.stage.group);
      if (this.is_new) {
        this.is_new = false;
        measured('draw', begin);
      }
      if (this.is_timed) wait_for(this.renderer);
      this.on_drawn(performance.now() - begin, begin - this.last_begin < 1000 ? begin - this.last_begin : null);
      this.last_begin = begin;
    }
    if (goes_on || detail?.fading) this.draw();
  }

  private drawn(): Promise<void> {
    this.draw();
    // Browsers stop animation frames of background pages, so this must not wait for one.
    return new Promise((resolve) => {
      requestAnimationFrame(() => resolve());
      setTimeout(resolve, 1000);
    });
  }

  private let_go(): void {
    this.modes.forget();
    this.levels?.dispose();
    this.levels = null;
    this.model?.dispose();
    this.model = null;
    this.eye.stop_at(null);
    this.set_boxes(null);
  }
}
