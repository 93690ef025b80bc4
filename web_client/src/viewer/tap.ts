/** Presses on the picture: a press and a release in one place, so that a drag, which turns the view, is none. */
import { Raycaster, Vector2, type PerspectiveCamera } from 'three';

/** A hand trembles by so many pixels. */
const tremor = 5;

/** `act` gets the release, and for how many milliseconds it was pressed. */
export function on_tap(canvas: HTMLCanvasElement, act: (event: PointerEvent, held: number) => void): void {
  let down: { id: number; x: number; y: number; at: number } | null = null;
  canvas.addEventListener('pointerdown', (event) => {
    // A second finger makes a gesture of it.
    down = event.isPrimary ? { id: event.pointerId, x: event.clientX, y: event.clientY, at: event.timeStamp } : null;
  });
  const strays = (event: PointerEvent): boolean => down !== null && Math.hypot(event.clientX - down.x, event.clientY - down.y) > tremor;
  // Who comes back to where the drag began has turned the view all the same.
  canvas.addEventListener('pointermove', (event) => { if (event.pointerId === down?.id && strays(event)) down = null; });
  canvas.addEventListener('pointercancel', () => { down = null; });
  canvas.addEventListener('pointerup', (event) => {
    const pressed = down;
    const is_tap = pressed?.id === event.pointerId && !strays(event);
    down = null;
    if (pressed && is_tap) act(event, event.timeStamp - pressed.at);
  });
}

/** The ray from the eye through the place of an event. */
export function ray_of(canvas: HTMLCanvasElement, camera: PerspectiveCamera, event: MouseEvent): Raycaster {
  const area = canvas.getBoundingClientRect();
  const caster = new Raycaster();
  caster.setFromCamera(new Vector2((event.clientX - area.left) / area.width * 2 - 1, 1 - (event.clientY - area.top) / area.height * 2), camera);
  return caster;
}
