import { el, part, rounded } from './dom';
import type { Viewer } from './viewer/viewer';

/** "1.4 × 2.1 × 0.3 m · grid of 1 m" */
export function show_measures(viewer: Viewer): void {
  const { size, cell } = viewer.measures;
  const grid = part('grid').getAttribute('aria-pressed') === 'true' && el('span', { class: 'cell-size' }, ` · grid of ${rounded(cell)} m`);
  part('measures').replaceChildren(`${rounded(size.x)} × ${rounded(size.y)} × ${rounded(size.z)} m`, ...(grid ? [grid] : []));
}
