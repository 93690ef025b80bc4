/** Detects taps on the view: a press and a release at the same position, as opposed to a drag. */
import { Raycaster, Vector2, type PerspectiveCamera } from 'three';

/** The movement, in pixels, that still counts as a tap. */
const tap_tolerance = 5;

/** `act` receives the release event and the duration of the press in milliseconds. */
export function on_tap(canvas: HTMLCanvasElement, act: (event: PointerEvent, held: number) => void): void {
  let down: { id: number; x: number; y: number; at: number } | null = null;
  canvas.addEventListener('pointerdown', (event) => {
    // A second finger starts a gesture, so there is no tap.
    down = event.isPrimary ? { id: event.pointerId, x: event.clientX, y: event.clientY, at: event.timeStamp } : null;
  });
  const strays = (event: PointerEvent): boolean => down !== null && Math.hypot(event.clientX - down.x, event.clientY - down.y) > tap_tolerance;
  // A pointer that returns to its start has rotated the view nevertheless.
  canvas.addEventListener('pointermove', (event) => { if (event.pointerId === down?.id && strays(event)) down = null; });
  canvas.addEventListener('pointercancel', () => { down = null; });
  canvas.addEventListener('pointerup', (event) => {
    const pressed = down;
    const is_tap = pressed?.id === event.pointerId && !strays(event);
    down = null;
    if (pressed && is_tap) act(event, event.timeStamp - pressed.at);
  });
}

/** The ray from the camera through the position of an event. */
export function ray_of(canvas: HTMLCanvasElement, camera: PerspectiveCamera, event: MouseEvent): Raycaster {
  const area = canvas.getBoundingClientRect();
  const caster = new Raycaster();
  caster.setFromCamera(new Vector2((event.clientX - area.left) / area.width * 2 - 1, 1 - (event.clientY - area.top) / area.height * 2), camera);
  return caster;
}
