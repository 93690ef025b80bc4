/** Clicks on the ground, told to whoever listens on the canvas, and marks that stand there. */
import { Plane, Raycaster, Vector2, Vector3, type Object3D, type PerspectiveCamera } from 'three';
import type { GroundClick, GroundMarks } from '../form/planting';
import type { ScopeBox } from './boxes';

/** A hand trembles by so many pixels. */
const tremor = 5;
/** A finger that rests so long, in milliseconds, asks for what a right click does. */
const long_press = 500;

interface Scene { camera: PerspectiveCamera; model(): Object3D | null; floor(): number }

export function wire_ground(canvas: HTMLCanvasElement, scene: Scene, mark: (boxes: ScopeBox[], chosen: number) => void): void {
  let down: { x: number; y: number; at: number } | null = null;
  canvas.addEventListener('pointerdown', (event) => { down = event.isPrimary ? { x: event.clientX, y: event.clientY, at: event.timeStamp } : null; });
  canvas.addEventListener('pointerup', (event) => {
    if (!down || Math.hypot(event.clientX - down.x, event.clientY - down.y) > tremor) return;
    const area = canvas.getBoundingClientRect();
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2((event.clientX - area.left) / area.width * 2 - 1, 1 - (event.clientY - area.top) / area.height * 2), scene.camera);
    const model = scene.model();
    const hit = model && caster.intersectObject(model, true)[0]?.point;
    const met = hit ?? caster.ray.intersectPlane(new Plane(new Vector3(0, 1, 0), -scene.floor()), new Vector3());
    if (!met) return;
    const is_long = event.pointerType === 'touch' && event.timeStamp - down.at > long_press;
    const detail: GroundClick = { x: met.x, z: met.z, button: is_long ? 2 : event.button, reach: scene.camera.position.distanceTo(met) * 0.03, on_ground: Boolean(hit) };
    canvas.dispatchEvent(new CustomEvent('ground-click', { detail }));
  });
  canvas.addEventListener('mark-ground', (event) => {
    const { places, chosen } = (event as CustomEvent<GroundMarks>).detail;
    mark(places.map(([x, z], index) => {
      const low = height_at(scene, x, z);
      const far = scene.camera.position.distanceTo(new Vector3(x, low, z));
      const tall = far * (index === chosen ? 0.07 : 0.035), thin = far * 0.004;
      return { origin: [x - thin / 2, low, z - thin / 2], axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], size: [thin, tall, thin] };
    }), chosen);
  });
}

function height_at(scene: Scene, x: number, z: number): number {
  const model = scene.model();
  const caster = new Raycaster(new Vector3(x, 1e4, z), new Vector3(0, -1, 0));
  // The lowest of what lies there: a mark stands at the foot of a tree, not on its crown.
  return (model && caster.intersectObject(model, true).at(-1)?.point.y) ?? scene.floor();
}
