/** The orbit camera: its framing of a model, whether the user has moved it, and when it is framed anew. */
import { Box3, PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { free_of, go_round, in_sight, place_camera, usual_direction, type Covered } from './frame';
import type { Model } from './model';
import { wall_between } from './walls';

/**
 * The camera is kept if the new model differs in size by at most this factor; the second applies after the user has
 * moved it.
 */
const size_tolerance = 1.25, moved_size_tolerance = 2;

export class OrbitCamera {
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 1000);
  readonly controls: OrbitControls;
  /** True if the user has moved the camera since it was framed. */
  touched = false;
  /** The heights of the overlays at the edges of the view. */
  covered: Covered;
  /**
   * The size of the framed model, the camera distance, the vertical offset of the image in pixels, and the minimum
   * distance.
   */
  readonly framed = { size: 1, distance: 1, raised: 0, nearest: 0.01 };
  private readonly canvas: HTMLCanvasElement;
  /** The model that blocks the camera, and the direction of the last search for walls. */
  private solid: Model | null = null;
  private way = new Vector3();

  constructor(canvas: HTMLCanvasElement, covered: Covered, still: boolean, draw: () => void) {
    this.canvas = canvas;
    this.covered = covered;
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !still;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = Math.PI * 0.6;
    this.controls.addEventListener('change', draw);
    this.controls.addEventListener('start', () => { this.touched = true; });
    // Runs in the capture phase, before the controls handle the event as a zoom.
    canvas.addEventListener('wheel', () => this.limit_zoom(), { capture: true, passive: true });
    canvas.addEventListener('pointerdown', (event) => { if (!event.isPrimary) this.limit_zoom(); }, { capture: true });
  }

  /** Places the camera so that all points are visible, from the default direction of the box or from another. */
  put(points: Vector3[], box: Box3, direction = usual_direction(box)): void {
    const { camera, controls } = this;
    // Remaining damping of the controls would move the camera after the framing.
    const damping = controls.enableDamping;
    controls.enableDamping = false;
    controls.update();
    controls.enableDamping = damping;
    this.framed.raised = (this.covered.bottom - this.covered.top) / 2;
    this.raise();
    controls.target.copy(place_camera(camera, points, direction, free_of(this.covered, this.canvas.clientHeight || 1)));
    controls.minDistance = camera.near * 4;
    controls.maxDistance = camera.far / 4;
    Object.assign(this.framed, { size: box.getSize(new Vector3()).length(), distance: camera.position.distanceTo(controls.target), nearest: controls.minDistance });
    this.way.setScalar(0);
  }

  sees(points: Vector3[]): boolean { return in_sight(this.camera, points, this.covered, this.canvas.clientHeight); }

  /**
   * True if a model can be viewed from the current position, so that the sizes of successive models can be compared.
   */
  suits(points: Vector3[], box: Box3): boolean {
    const grown = box.getSize(new Vector3()).length() / this.framed.size;
    const most = this.touched ? moved_size_tolerance : size_tolerance;
    return grown < most && grown > 1 / most && (this.touched || this.sees(points));
  }

  /** Rotates around the model, in radians, and scales the distance. */
  orbit(turn: number, tilt: number, distance: number): void {
    this.touched = true;
    go_round(this.camera, this.controls.target, turn, tilt, distance, this.controls.maxPolarAngle);
    this.controls.update();
  }

  /** Sets the model whose walls stop the zoom. Walls are single-sided, so that they are invisible from inside. */
  stop_at(solid: Model | null): void {
    this.solid = solid;
    this.way.setScalar(0);
    this.controls.minDistance = this.framed.nearest;
  }

  /**
   * Adapts to a new size of the view. A model that was completely visible stays so from the same direction; a view
   * that the user has cropped stays cropped.
   */
  resize(width: number, height: number, points: Vector3[], box: Box3): void {
    const whole = { top: 0, bottom: 0 };
    const was_whole = in_sight(this.camera, points, whole, height);
    this.widen(width, height);
    if (!this.touched || !was_whole || in_sight(this.camera, points, whole, height)) return;
    this.put(points, box, this.camera.position.clone().sub(this.controls.target).normalize());
    this.controls.update();
  }

  /** Adopts the aspect ratio of the view without moving. */
  widen(width: number, height: number): void {
    this.camera.aspect = width / height;
    this.raise();
  }

  private raise(): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.camera.setViewOffset(clientWidth, clientHeight, 0, this.framed.raised, clientWidth, clientHeight);
  }

  /** Searched once per viewing direction, because ray casting through a large model is slow. */
  limit_zoom(): void {
    const { camera, controls, framed } = this;
    const way = controls.target.clone().sub(camera.position);
    const distance = way.length();
    const from = way.normalize();
    if (!this.solid || this.way.distanceToSquared(from) < 1e-8) return;
    this.way = from;
    const wall = wall_between(this.solid, camera.position, controls.target, framed.nearest / 4);
    controls.minDistance = wall === null ? framed.nearest : Math.max(framed.nearest, Math.min(distance, distance - wall + framed.nearest));
  }
}
