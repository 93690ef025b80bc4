/**
 * Walking and flying: W A S D move, Q and Z or the page keys rise and sink, arrow keys and drags turn the view. Touch
 * buttons press the same keys.
 */
import { MathUtils, Vector3, type Box3, type Object3D, type PerspectiveCamera } from 'three';
import { Land, surface_heights } from './land';

export type Gait = 'orbit' | 'walk' | 'fly';

const eye = 1.7;
/** Walking speed in metres per second; Shift multiplies it by four. */
const pace = 1.8;
const turn_speed = 1.4;
const going = ['w', 'a', 's', 'd', 'q', 'z', 'pageup', 'pagedown', 'arrowleft', 'arrowright', 'arrowup', 'arrowdown', 'shift'];

export class Walker {
  gait: Gait = 'orbit';
  on_move: (position: Vector3, heading: number) => void = () => {};
  private readonly camera: PerspectiveCamera;
  private readonly wake: () => void;
  private readonly pressed = new Set<string>();
  private yaw = 0;
  private pitch = 0;
  private last = 0;
  /** Half the size of the model, in metres, which sets the flying speed. */
  private reach = 5;
  private floor = 0;
  private ground: Object3D | null = null;
  private land_there: Land | null = null;
  private dragged: { id: number; x: number; y: number } | null = null;

  constructor(camera: PerspectiveCamera, canvas: HTMLCanvasElement, wake: () => void) {
    this.camera = camera;
    this.wake = wake;
    canvas.addEventListener('keydown', (event) => {
      const key = event.key.toLowerCase();
      if (this.gait === 'orbit' || !going.includes(key) || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      this.press(key);
    });
    canvas.addEventListener('keyup', (event) => this.release(event.key.toLowerCase()));
    canvas.addEventListener('blur', () => this.pressed.clear());
    canvas.addEventListener('pointerdown', (event) => {
      if (this.gait !== 'orbit') this.dragged = { id: event.pointerId, x: event.clientX, y: event.clientY };
    });
    canvas.addEventListener('pointermove', (event) => {
      if (this.dragged?.id !== event.pointerId || this.gait === 'orbit') return;
      this.look((this.dragged.x - event.clientX) * 0.004, (this.dragged.y - event.clientY) * 0.004);
      this.dragged = { id: event.pointerId, x: event.clientX, y: event.clientY };
      this.aim();
      wake();
    });
    addEventListener('pointerup', (event) => { if (event.pointerId === this.dragged?.id) this.dragged = null; });
  }

  /** Moves until the key is released. */
  press(key: string): void {
    if (this.pressed.size === 0) this.last = performance.now();
    this.pressed.add(key);
    this.wake();
  }

  release(key: string): void { this.pressed.delete(key); }

  /** Sets the model to walk on, and its size. */
  land(model: Object3D, floor: number, box: Box3): void {
    this.ground = model;
    this.floor = floor;
    this.reach = box.getSize(new Vector3()).length() / 2;
    this.land_there = null;
  }

  /**
   * Starts at the current camera position. In walking mode, the camera drops to the ground, or enters the terrain
   * from outside.
   */
  begin(gait: Gait): void {
    this.gait = gait;
    this.pressed.clear();
    if (gait === 'orbit') return;
    const ahead = this.camera.getWorldDirection(new Vector3());
    this.yaw = Math.atan2(-ahead.x, -ahead.z);
    this.pitch = gait === 'walk' ? 0 : Math.asin(MathUtils.clamp(ahead.y, -1, 1));
    this.camera.near = Math.min(this.camera.near, 0.1);
    this.camera.updateProjectionMatrix();
    if (gait === 'walk') this.set_foot();
    this.aim();
  }

  /** Advances by the time since the last call; returns true while a key is held. */
  step(): boolean {
    if (this.gait === 'orbit' || this.pressed.size === 0) return false;
    const now = performance.now();
    const seconds = Math.min((now - this.last) / 1000, 0.1);
    this.last = now;
    const has = (...keys: string[]): number => (keys.some((key) => this.pressed.has(key)) ? 1 : 0);
    this.look((has('arrowleft') - has('arrowright')) * turn_speed * seconds, (has('arrowup') - has('arrowdown')) * turn_speed * seconds);
    const speed = Math.max(pace, this.reach * (this.gait === 'fly' ? 0.4 : 0.08)) * (has('shift') ? 4 : 1) * seconds;
    const along = (has('w') - has('s')) * speed, across = (has('d') - has('a')) * speed;
    const up = (has('q', 'pageup') - has('z', 'pagedown')) * speed;
    const level = this.gait === 'walk' ? 0 : this.pitch;
    const before = this.camera.position.clone();
    this.camera.position.add(new Vector3(
      -Math.sin(this.yaw) * Math.cos(level) * along + Math.cos(this.yaw) * across,
      Math.sin(level) * along + (this.gait === 'fly' ? up : 0),
      -Math.cos(this.yaw) * Math.cos(level) * along - Math.sin(this.yaw) * across));
    // Outside the terrain there is nothing to walk on. The position may be outside after a change of the model.
    if (this.gait === 'walk' && !this.come_down() && this.land_here?.height(before) !== undefined) this.camera.position.copy(before);
    this.aim();
    return true;
  }

  private look(turn: number, tilt: number): void {
    this.yaw += turn;
    this.pitch = MathUtils.clamp(this.pitch + tilt, -1.5, 1.5);
  }

  private aim(): void {
    this.camera.rotation.set(this.pitch, this.yaw, 0, 'YXZ');
    // 0 is towards -z and angles are clockwise, as on a map with north at the top.
    const heading = ((-this.yaw * 180 / Math.PI) % 360 + 360) % 360;
    this.on_move(this.camera.position, heading);
  }

  private set_foot(): void {
    const { position } = this.camera;
    const land = this.land_here;
    if (!land) { this.come_down(); return; }
    const beneath = land.height(position);
    if (beneath !== undefined) { position.y = beneath + eye; return; }
    const entry = land.entry_position(position, eye);
    if (!entry) return;
    position.copy(entry).setY(entry.y + eye);
    const ahead = land.box.getCenter(new Vector3()).sub(position);
    this.yaw = Math.atan2(-ahead.x, -ahead.z);
  }

  /** The terrain; null if the model has none. It is searched on first use. */
  private get land_here(): Land | null {
    if (this.ground) this.land_there ??= new Land(this.ground);
    return this.land_there?.is_there ? this.land_there : null;
  }

  /**
   * Moves onto the terrain, or onto the surface below: steps of half a metre are climbed, tree crowns overhead are
   * ignored. Returns false at the end of the terrain.
   */
  private come_down(): boolean {
    const { position } = this.camera;
    const land = this.land_here;
    if (land) {
      const height = land.height(position);
      if (height === undefined) return false;
      position.y = height + eye;
      return true;
    }
    const foot = position.y - eye + Math.max(0.5, this.reach * 0.02);
    const below = this.ground ? surface_heights([this.ground], position, foot)[0] : undefined;
    position.y = Math.max(below ?? this.floor, this.floor) + eye;
    return true;
  }
}
