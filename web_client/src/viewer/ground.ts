/** Clicks on the ground, told to whoever listens on the canvas, and marks that stand there. */
import { Plane, Raycaster, Vector2, Vector3, type Object3D, type PerspectiveCamera } from 'three';
import type { GroundClick, GroundMarks } from '../form/placement_field';
import type { ScopeBox } from './boxes';

/** A hand trembles by so many pixels. */
const tremor = 5;

interface Scene { camera: PerspectiveCamera; model(): Object3D | null; floor(): number }

export function wire_ground(canvas: HTMLCanvasElement, scene: Scene, mark: (boxes: ScopeBox[], chosen: number) => void): void {
  let down: { x: number; y: number } | null = null;
  canvas.addEventListener('pointerdown', (event) => { down = { x: event.clientX, y: event.clientY }; });
  canvas.addEventListener('pointerup', (event) => {
    if (!down || Math.hypot(event.clientX - down.x, event.clientY - down.y) > tremor) return;
    const area = canvas.getBoundingClientRect();
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2((event.clientX - area.left) / area.width * 2 - 1, 1 - (event.clientY - area.top) / area.height * 2), scene.camera);
    const model = scene.model();
    const met = (model && caster.intersectObject(model, true)[0]?.point)
      ?? caster.ray.intersectPlane(new Plane(new Vector3(0, 1, 0), -scene.floor()), new Vector3());
    if (!met) return;
    const reach = scene.camera.position.distanceTo(met) * 0.03;
    const detail: GroundClick = { x: met.x, z: met.z, button: event.button, touch: event.pointerType === 'touch', reach };
    canvas.dispatchEvent(new CustomEvent('ground-click', { detail }));
  });
  canvas.addEventListener('mark-ground', (event) => {
    const { places, chosen } = (event as CustomEvent<GroundMarks>).detail;
    const tall = Math.max(1, scene.camera.position.length() * 0.06), thin = tall * 0.08;
    mark(places.map(([x, z]) => ({
      origin: [x - thin / 2, height_at(scene, x, z), z - thin / 2], axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], size: [thin, tall, thin],
    })), chosen);
  });
}

function height_at(scene: Scene, x: number, z: number): number {
  const model = scene.model();
  const caster = new Raycaster(new Vector3(x, 1e4, z), new Vector3(0, -1, 0));
  // The lowest of what lies there: a mark stands at the foot of a tree, not on its crown.
  return (model && caster.intersectObject(model, true).at(-1)?.point.y) ?? scene.floor();
}
