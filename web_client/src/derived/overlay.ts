/** Draws the shapes of the list over the model. The viewer implements this interface. */
import type { ScopeBox } from '../viewer/boxes';

export interface Overlay {
  set_boxes(scopes: ScopeBox[] | null, color_of?: (index: number) => number): void;
  /** Highlights the shape with this index; -1 highlights none. */
  mark_box(index: number): void;
}
