/** The buttons and shortcuts of the view. Single letters are active only while the view has the focus. */
import { part } from './dom';
import { show_triangles } from './level_choice';
import { show_measures } from './measures';
import type { Viewer } from './viewer/viewer';

interface Acts {
  roll(): void;
  next_mode(): void;
  compare(): void;
  save_picture(): void;
  step(by: number): void;
  play(): void;
  leave_gait(): void;
}

/** A toggle button. The callback applies the new state; the returned function flips it. */
export function toggle(id: string, set: (on: boolean) => void): () => void {
  const button = part(id);
  const flip = (): void => {
    const on = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(on));
    set(on);
  };
  button.addEventListener('click', flip);
  return flip;
}

export function wire_view(viewer: Viewer, acts: Acts): void {
  // The walking and flying modes offer a button that returns to orbit.
  const fit = (): void => { acts.leave_gait(); viewer.fit(); };
  part('fit').addEventListener('click', fit);
  const turn = 0.12;
  const keys: Record<string, () => void> = {
    f: fit,
    w: toggle('wireframe', (on) => viewer.set_wireframe(on)),
    g: toggle('grid', (on) => { viewer.set_grid(on); show_measures(viewer); }),
    h: toggle('figure', (on) => viewer.set_figure(on)),
    r: acts.roll,
    n: acts.next_mode,
    c: acts.compare,
    p: acts.save_picture,
    '[': () => acts.step(-1),
    ']': () => acts.step(1),
    ' ': acts.play,
    escape: acts.leave_gait,
    arrowleft: () => viewer.orbit(-turn, 0, 1),
    arrowright: () => viewer.orbit(turn, 0, 1),
    arrowup: () => viewer.orbit(0, -turn, 1),
    arrowdown: () => viewer.orbit(0, turn, 1),
    '+': () => viewer.orbit(0, 0, 0.9),
    '=': () => viewer.orbit(0, 0, 0.9),
    '-': () => viewer.orbit(0, 0, 1 / 0.9),
  };
  part('picture').addEventListener('keydown', (event) => {
    const act = keys[event.key.toLowerCase()];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
  const drawn = part('drawn');
  const time = (milliseconds: number): string => `${milliseconds < 10 ? milliseconds.toFixed(1) : Math.round(milliseconds)} ms`;
  const figure = part('figure');
  const tell_figure = (): void => { figure.setAttribute('aria-pressed', String(viewer.has_figure)); };
  tell_figure();
  viewer.on_drawn = (milliseconds, frame) => {
    show_triangles(viewer);
    tell_figure();
    const level = viewer.level === null ? '' : `, level ${viewer.level}`;
    drawn.textContent = `${time(milliseconds)}${frame === null ? '' : `, frame ${time(frame)}, ${Math.round(1000 / frame)} a second`}${level}`;
  };
}
