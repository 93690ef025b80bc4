/** The picture. Draws when something changed, never otherwise; keeps one model and lets go of the one before. */
import { Box3, NeutralToneMapping, PCFShadowMap, PerspectiveCamera, Raycaster, Scene, Spherical, Vector2, Vector3, WebGLRenderer, type Group } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { box_at, draw_boxes, drop_boxes, type ScopeBox } from './boxes';
import { corners_of, stand_back, usual_direction } from './frame';
import { wire_ground } from './ground';
import { Levels, Model } from './model';
import { Modes, type Mode } from './modes';
import { Motion } from './motion';
import { draw_portrait } from './portrait';
import { Stage, type Sun } from './stage';
import { Walker, type Gait } from './walker';
import { levels_of } from './zip';

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
  /** Called with the scope box that was pointed at; -1 for none. */
  on_pick: (index: number) => void = () => {};
  /** Called after each picture with the time that its drawing took, and the time since the one before while pictures follow each other, in milliseconds. */
  on_drawn: (milliseconds: number, frame: number | null) => void = () => {};
  readonly motion = new Motion();
  readonly walker: Walker;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(32, 1, 0.01, 1000);
  private readonly controls: OrbitControls;
  private readonly stage: Stage;
  private readonly canvas: HTMLCanvasElement;
  private readonly modes = new Modes();
  private model: Model | null = null;
  private levels: Levels | null = null;
  private other: Model | null = null;
  private divider = 0.5;
  private variant: string | null = null;
  private boxes: { scopes: ScopeBox[]; drawn: Group } | null = null;
  private marks: Group | null = null;
  private box = new Box3(new Vector3(-1, 0, -1), new Vector3(1, 2, 1));
  private points = corners_of(this.box);
  /** The camera stays where it is, whatever is shown: a model that grows shall be seen to grow. */
  held = false;
  private touched = false;
  private covered: number;
  private frame = 0;
  private last_begin = 0;
  /** The model was not drawn yet. */
  private is_new = false;
  /** Nothing shall move by itself. */
  readonly is_still: boolean;
  /** Part of the height that nothing covers. */
  private free = 1;

  constructor(canvas: HTMLCanvasElement, look: Look) {
    const high = look.quality === 'high';
    this.canvas = canvas;
    this.covered = look.covered;
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
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !look.still;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = Math.PI * 0.6;
    this.controls.addEventListener('change', () => this.draw());
    this.controls.addEventListener('start', () => { this.touched = true; });
    this.walker = new Walker(this.camera, canvas, () => this.draw());
    canvas.addEventListener('webglcontextlost', (event) => { event.preventDefault(); this.on_context(true); });
    canvas.addEventListener('webglcontextrestored', () => { this.renderer.shadowMap.needsUpdate = true; this.on_context(false); this.draw(); });
    canvas.addEventListener('click', (event) => this.pick(event));
    wire_ground(canvas, { camera: this.camera, model: () => this.model?.root ?? null, floor: () => this.stage.floor },
      (places, chosen) => this.set_marks(places.length > 0 ? draw_boxes(places, (index) => (index === chosen ? 3 : 1)) : null));
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement ?? canvas);
    this.set_theme(look.dark);
    this.resize();
    this.fit();
  }

  /** Takes a GLB in place of the model that is shown. The camera stays where a hand has put it. */
  async show(bytes: ArrayBuffer, keep_camera: boolean): Promise<Model> {
    const begin = performance.now();
    const model = await Model.from(bytes);
    performance.clearMeasures('seedmesh-read');
    performance.measure('seedmesh-read', { start: begin });
    if (this.variant !== null && model.variants.includes(this.variant)) await model.wear(this.variant);
    this.let_go();
    this.model = model;
    this.is_new = true;
    this.scene.add(model.root);
    this.motion.take(model);
    const grown = model.box.getSize(new Vector3()).length() / this.box.getSize(new Vector3()).length();
    this.box = model.box;
    this.points = model.points;
    this.stage.surround(model.box);
    this.walker.land(model.root, this.stage.floor, model.box.getSize(new Vector3()).length() / 2);
    this.dress();
    if (!this.held && (!keep_camera || !this.touched || grown > 2 || grown < 0.5)) this.fit();
    this.canvas.dispatchEvent(new CustomEvent('ground-changed'));
    await this.drawn();
    return model;
  }

  fit(): void {
    if (this.walker.gait !== 'orbit') return;
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
    this.modes.wireframe = on;
    this.dress();
  }

  /** Lines where faces meet at an angle. */
  set_edges(on: boolean): void {
    this.modes.edges = on;
    this.dress();
  }

  set_mode(mode: Mode): void {
    this.modes.mode = mode;
    this.dress();
  }

  /** The set of materials by name, for this model and those that follow; null for their own. */
  async set_variant(name: string | null): Promise<void> {
    this.variant = name;
    await Promise.all(this.all_models().map((model) => model.wear(name)));
    this.dress();
  }

  /** Takes the levels out of a zip, from fine to coarse, and says how many triangles each has. */
  async take_levels(bytes: ArrayBuffer): Promise<number[]> {
    const models = await levels_of(bytes);
    if (this.variant !== null) await Promise.all(models.map((model) => model.wear(this.variant)));
    this.levels?.dispose();
    this.levels = new Levels(models, this.is_still);
    return models.map((model) => model.triangles);
  }

  /** A level of detail, "auto" by distance, or null for the model as it was shown. */
  choose_level(level: number | 'auto' | null): void {
    if (!this.model) return;
    this.model.root.visible = level === null || !this.levels;
    if (level === null) {
      this.levels?.dispose();
      this.levels = null;
    } else {
      this.levels?.choose(level, this.scene, this.camera.position.distanceTo(this.controls.target) * 1.5);
    }
    this.dress();
  }

  /** The level that is in sight; null where there are no levels. */
  get level(): number | null { return this.levels?.in_sight ?? null; }

  set_grid(on: boolean): void {
    this.stage.grid_visible = on;
    this.draw();
  }

  set_figure(on: boolean): void {
    this.stage.show_figure(on, this.box);
    this.cast();
    if (this.touched) this.draw();
    else this.fit();
  }

  set_theme(dark: boolean): void {
    this.stage.set_theme(dark);
    this.modes.wire.color.set(dark ? 0xf2f7f4 : 0x10231a);
    this.draw();
  }

  set_sky(on: boolean): void {
    this.scene.background = this.stage.set_sky(on);
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

  /** Orbit, on foot or in flight. Back in orbit the model is fitted. */
  set_gait(gait: Gait): void {
    this.controls.enabled = gait === 'orbit';
    this.walker.begin(gait);
    if (gait === 'orbit') this.fit();
    this.draw();
  }

  /** Stands the clip at a share of its length, or lets it run. */
  set_time(share: number): void {
    this.motion.stand(share);
    this.cast();
  }

  play(on: boolean): void {
    this.motion.run(on);
    this.draw();
  }

  /** Another model to the left of the divider, under the same camera; null takes it away. */
  async compare(bytes: ArrayBuffer | null): Promise<void> {
    this.other?.dispose();
    this.other = bytes ? await Model.from(bytes) : null;
    this.dress();
  }

  set_divider(share: number): void {
    this.divider = share;
    this.draw();
  }

  /** Boxes of shapes over the model; null takes them away. */
  set_boxes(scopes: ScopeBox[] | null, color_of: (index: number) => number = () => 0): void {
    drop_boxes(this.boxes?.drawn ?? null);
    this.boxes = scopes ? { scopes, drawn: draw_boxes(scopes, color_of) } : null;
    if (this.boxes) this.scene.add(this.boxes.drawn);
    this.draw();
  }

  private set_marks(marks: Group | null): void {
    if (!marks && !this.marks) return;
    drop_boxes(this.marks);
    this.marks = marks;
    if (marks) this.scene.add(marks);
    this.draw();
  }

  /** Width, height and depth of the model in metres, and the side of a cell of the grid. */
  get measures(): { size: Vector3; cell: number } {
    return { size: this.box.getSize(new Vector3()), cell: this.stage.cell };
  }

  /** How many pixels at the lower rim something else covers. */
  set_covered(pixels: number): void {
    if (pixels === this.covered) return;
    this.covered = pixels;
    this.resize();
  }

  /** What is seen now, as a PNG. */
  screenshot(): Promise<Blob | null> {
    this.render();
    return new Promise((resolve) => this.canvas.toBlob(resolve, 'image/png'));
  }

  /**
   * A small picture of another model, drawn by the same renderer between two pictures of the page: a browser allows
   * only few of them.
   */
  async portrait(bytes: ArrayBuffer, width: number, height: number): Promise<HTMLCanvasElement> {
    const picture = draw_portrait(this.renderer, this.scene, this.stage, await Model.from(bytes), width, height);
    this.stage.surround(this.box);
    this.renderer.shadowMap.needsUpdate = true;
    this.render();
    return picture;
  }

  private all_models(): Model[] {
    return [this.model, this.other, ...(this.levels?.models ?? [])].filter((model): model is Model => model !== null);
  }

  private dress(): void {
    this.modes.dress(this.all_models());
    this.cast();
  }

  private cast(): void {
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
  }

  private pick(event: MouseEvent): void {
    if (!this.boxes) return;
    const area = this.canvas.getBoundingClientRect();
    const at = new Vector2((event.clientX - area.left) / area.width * 2 - 1, 1 - (event.clientY - area.top) / area.height * 2);
    const caster = new Raycaster();
    caster.setFromCamera(at, this.camera);
    this.on_pick(box_at(this.boxes.scopes, caster.ray));
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
    const begin = performance.now();
    // While the motion dies down this asks for the next picture by the event "change".
    if (this.walker.gait === 'orbit') this.controls.update();
    const goes_on = [this.walker.step(), this.motion.step()].some(Boolean);
    const detail = this.levels?.at(this.camera.position.distanceTo(this.controls.target));
    if (this.motion.is_running || detail?.changed) this.renderer.shadowMap.needsUpdate = true;
    if (!this.renderer.getContext().isContextLost()) {
      if (this.other) this.render_both(this.other);
      else this.renderer.render(this.scene, this.camera);
      if (this.is_new) {
        this.is_new = false;
        performance.clearMeasures('seedmesh-draw');
        performance.measure('seedmesh-draw', { start: begin });
      }
      this.on_drawn(performance.now() - begin, begin - this.last_begin < 1000 ? begin - this.last_begin : null);
      this.last_begin = begin;
    }
    if (goes_on || detail?.fading) this.draw();
  }

  /** The other model left of the divider, the model right of it. */
  private render_both(other: Model): void {
    const size = this.renderer.getSize(new Vector2());
    const shown = this.scene.children.filter((child) => child !== this.stage.group && child.visible);
    this.renderer.setScissorTest(true);
    for (const side of ['other', 'own'] as const) {
      for (const child of shown) child.visible = side === 'own';
      if (side === 'other') this.scene.add(other.root);
      else other.root.removeFromParent();
      const from = side === 'other' ? 0 : this.divider * size.x;
      this.renderer.setScissor(from, 0, side === 'other' ? this.divider * size.x : size.x - from, size.y);
      this.renderer.shadowMap.needsUpdate = true;
      this.renderer.render(this.scene, this.camera);
    }
    this.renderer.setScissorTest(false);
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
    this.modes.forget();
    this.levels?.dispose();
    this.levels = null;
    this.model?.dispose();
    this.model = null;
    this.set_boxes(null);
  }
}
