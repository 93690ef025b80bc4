/** Changes of single shapes of a building (x-widget: shape-edits). A change finds its shape by a path. */

export interface Edit { shape: string; rule?: string; remove?: boolean; attributes?: object }
/** What changes about a shape; null takes the change back. */
export type ShapeChange = { rule?: string; remove?: boolean } | null;

/** A missing number of a step is 1. */
const whole = (path: string): string => path.replaceAll(/(?<=[^\]])(?=\/|$)/g, '[1]');

/** The present change of the shape at this path. */
export const edit_at = (edits: Edit[], path: string): Edit | undefined => edits.find((edit) => whole(edit.shape) === whole(path));

/** The changes with another one of one shape. Its attributes are kept unless it is removed. */
export function with_edit(edits: Edit[], path: string, change: ShapeChange): Edit[] {
  const others = edits.filter((edit) => whole(edit.shape) !== whole(path));
  if (!change) return others;
  const kept = edit_at(edits, path)?.attributes;
  return [...others, { shape: path, ...(kept && !change.remove ? { attributes: kept } : {}), ...change }];
}
