import { el, part, rounded } from './dom';
import type { Viewer } from './viewer/viewer';

/** The title of the request whose model is still shown although another request is open. */
let other = '';

/**
 * Sizes in metres. A size that is negligible beside the largest is rounded to 0, so that a flat drawing has no depth.
 */
export function sides_of({ x, y, z }: { x: number; y: number; z: number }): string[] {
  const least = Math.max(x, y, z) * 1e-5;
  return [x, y, z].map((side) => (side < least ? '0' : rounded(side)));
}

/** "1.4 × 2.1 × 0.3 m · grid of 1 m" */
export function show_measures(viewer: Viewer): void {
  const { size, cell } = viewer.measures;
  const grid = part('grid').getAttribute('aria-pressed') === 'true' && el('span', { class: 'cell-size' }, ` · grid of ${rounded(cell)} m`);
  const measures = other ? `The view still shows ${other}` : size ? `${sides_of(size).join(' × ')} m` : 'Nothing to show';
  part('measures').replaceChildren(measures, ...(grid && !other ? [grid] : []));
}

/**
 * Labels the measures as those of another model when the model of the open request did not arrive. An empty title
 * removes the label.
 */
export function still_shown(title: string, viewer: Viewer | null): void {
  other = title;
  if (title) part('statistics').hidden = true;
  if (viewer) show_measures(viewer);
}
