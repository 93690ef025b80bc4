/** The camera that goes round a model: where it was put, whether by a hand, and when it has to be put anew. */
import { Box3, PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { free_of, go_round, in_sight, stand_back, usual_direction, type Covered } from './frame';
import type { Model } from './model';
import { wall_between } from './walls';

/** The camera stays for a model that is at most so many times as large as the one it was put there for; by a hand: the second. */
const alike = 1.25, alike_by_hand = 2;

export class Eye {
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 1000);
  readonly controls: OrbitControls;
  /** A hand has moved it since it was put. */
  touched = false;
  /** What lies over the rims of the picture. */
  covered: Covered;
  /** The size of the model that it was put there for, how far from it, and by how many pixels the picture is raised. */
  readonly framed = { size: 1, distance: 1, raised: 0, nearest: 0.01 };
  private readonly canvas: HTMLCanvasElement;
  /** What stands in its way, and from which side the way to it was looked at. */
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
    // Before the controls take it for a way to come nearer.
    canvas.addEventListener('wheel', () => this.keep_out(), { capture: true, passive: true });
    canvas.addEventListener('pointerdown', (event) => { if (!event.isPrimary) this.keep_out(); }, { capture: true });
  }

  /** Puts it where all points are seen, from the usual side of the box or from another. */
  put(points: Vector3[], box: Box3, direction = usual_direction(box)): void {
    const { camera, controls } = this;
    // What is left of a hand's motion would carry the camera on.
    const damping = controls.enableDamping;
    controls.enableDamping = false;
    controls.update();
    controls.enableDamping = damping;
    this.framed.raised = (this.covered.bottom - this.covered.top) / 2;
    this.raise();
    controls.target.copy(stand_back(camera, points, direction, free_of(this.covered, this.canvas.clientHeight || 1)));
    controls.minDistance = camera.near * 4;
    controls.maxDistance = camera.far / 4;
    Object.assign(this.framed, { size: box.getSize(new Vector3()).length(), distance: camera.position.distanceTo(controls.target), nearest: controls.minDistance });
    this.way.setScalar(0);
  }

  sees(points: Vector3[]): boolean { return in_sight(this.camera, points, this.covered, this.canvas.clientHeight); }

  /** Whether a model can be looked at from here, so that models can be told apart by their size. */
  suits(points: Vector3[], box: Box3): boolean {
    const grown = box.getSize(new Vector3()).length() / this.framed.size;
    const most = this.touched ? alike_by_hand : alike;
    return grown < most && grown > 1 / most && (this.touched || this.sees(points));
  }

  /** Turns round the model, by radians, and scales the distance. */
  orbit(turn: number, tilt: number, distance: number): void {
    this.touched = true;
    go_round(this.camera, this.controls.target, turn, tilt, distance, this.controls.maxPolarAngle);
    this.controls.update();
  }

  /** The way to another model: it is not gone into through its walls, which cannot be seen from behind. */
  stop_at(solid: Model | null): void {
    this.solid = solid;
    this.way.setScalar(0);
    this.controls.minDistance = this.framed.nearest;
  }

  /** Another size of the picture. What was seen whole is seen whole from the same side; what was cut off by a hand stays so. */
  resize(width: number, height: number, points: Vector3[], box: Box3): void {
    const whole = { top: 0, bottom: 0 };
    const was_whole = in_sight(this.camera, points, whole, height);
    this.widen(width, height);
    if (!this.touched || !was_whole || in_sight(this.camera, points, whole, height)) return;
    this.put(points, box, this.camera.position.clone().sub(this.controls.target).normalize());
    this.controls.update();
  }

  /** Takes the shape of the picture and stays where it is. */
  widen(width: number, height: number): void {
    this.camera.aspect = width / height;
    this.raise();
  }

  private raise(): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.camera.setViewOffset(clientWidth, clientHeight, 0, this.framed.raised, clientWidth, clientHeight);
  }

  /** Asked once for each way that is gone: a large model has much to be looked through. */
  keep_out(): void {
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
