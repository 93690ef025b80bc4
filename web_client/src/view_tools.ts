/** The buttons and keys of the picture. Single letters count only while the picture has the focus. */
import { part, rounded } from './dom';
import type { Viewer } from './viewer/viewer';

export function wire_view(viewer: Viewer, roll: () => void): void {
  const toggle = (id: string, set: (on: boolean) => void): (() => void) => {
    const button = part(id);
    const flip = (): void => {
      const on = button.getAttribute('aria-pressed') !== 'true';
      button.setAttribute('aria-pressed', String(on));
      set(on);
    };
    button.addEventListener('click', flip);
    return flip;
  };
  const fit = (): void => viewer.fit();
  part('fit').addEventListener('click', fit);
  const turn = 0.12;
  const keys: Record<string, () => void> = {
    f: fit,
    w: toggle('wireframe', (on) => viewer.set_wireframe(on)),
    g: toggle('grid', (on) => { viewer.set_grid(on); show_measures(viewer); }),
    h: toggle('figure', (on) => viewer.set_figure(on)),
    r: roll,
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
}

/** "1.4 × 2.1 × 0.3 m · grid of 1 m" */
export function show_measures(viewer: Viewer): void {
  const { size, cell } = viewer.measures;
  const grid = part('grid').getAttribute('aria-pressed') === 'true' ? ` · grid of ${rounded(cell)} m` : '';
  part('measures').textContent = `${rounded(size.x)} × ${rounded(size.y)} × ${rounded(size.z)} m${grid}`;
}
