import { el, part, rounded } from './dom';
import type { Viewer } from './viewer/viewer';

/** The picture shows another request's model than the page, and whose. */
let other = '';

/** In metres; what is nothing beside the largest side is nothing: a drawing has no depth. */
export function sides_of({ x, y, z }: { x: number; y: number; z: number }): string[] {
  const least = Math.max(x, y, z) * 1e-5;
  return [x, y, z].map((side) => (side < least ? '0' : rounded(side)));
}

/** "1.4 × 2.1 × 0.3 m · grid of 1 m" */
export function show_measures(viewer: Viewer): void {
  const { size, cell } = viewer.measures;
  const grid = part('grid').getAttribute('aria-pressed') === 'true' && el('span', { class: 'cell-size' }, ` · grid of ${rounded(cell)} m`);
  const measures = other ? `The picture still shows ${other}` : size ? `${sides_of(size).join(' × ')} m` : 'Nothing to be seen';
  part('measures').replaceChildren(measures, ...(grid && !other ? [grid] : []));
}

/** The model of what is open did not come: measures and figures are not passed off as its own. An empty title takes that back. */
export function still_shown(title: string, viewer: Viewer | null): void {
  other = title;
  if (title) part('statistics').hidden = true;
  if (viewer) show_measures(viewer);
}
