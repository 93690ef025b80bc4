/** Reports clicks on the ground as events on the canvas, and shows markers on the ground. */
import { Plane, Raycaster, Vector3, type Group, type Object3D, type PerspectiveCamera } from 'three';
import type { GroundClick, GroundMarks } from '../form/planting';
import { is_ground } from './land';
import { draw_marks } from './marks';
import { on_tap, ray_of } from './tap';

/** The duration of a long press, in milliseconds, which acts as a right click. */
const long_press = 500;

interface Scene { camera: PerspectiveCamera; model(): Object3D | null; floor(): number }

export function wire_ground(canvas: HTMLCanvasElement, scene: Scene, mark: (marks: Group | null) => void): void {
  on_tap(canvas, (event, held) => {
    const caster = ray_of(canvas, scene.camera, event);
    const model = scene.model();
    const hit = model && caster.intersectObject(model, true)[0]?.point;
    const met = hit ?? caster.ray.intersectPlane(new Plane(new Vector3(0, 1, 0), -scene.floor()), new Vector3());
    if (!met) return;
    const is_long = event.pointerType === 'touch' && held > long_press;
    const detail: GroundClick = { x: met.x, z: met.z, button: is_long ? 2 : event.button, reach: scene.camera.position.distanceTo(met) * 0.03, on_ground: Boolean(hit) || !model || !is_ground(model) };
    canvas.dispatchEvent(new CustomEvent('ground-click', { detail }));
  });
  canvas.addEventListener('mark-ground', (event) => {
    const { positions, chosen } = (event as CustomEvent<GroundMarks>).detail;
    mark(positions.length > 0 ? draw_marks(positions.map(([x, z]) => new Vector3(x, height_at(scene, x, z), z)), chosen) : null);
  });
}

function height_at(scene: Scene, x: number, z: number): number {
  const model = scene.model();
  const caster = new Raycaster(new Vector3(x, 1e4, z), new Vector3(0, -1, 0));
  // The lowest surface is used: a marker belongs at the foot of a tree, not on its crown.
  return (model && caster.intersectObject(model, true).at(-1)?.point.y) ?? scene.floor();
}
