/** Changes of single shapes of a building (x-widget: shape-edits). A change finds its shape by a path. */
import type { Members } from '../form/schema';

export interface Edit { shape: string; rule?: string; remove?: boolean; attributes?: Members }
/** What changes about a shape; null takes the change back. A member that is undefined takes its own part back. */
export type ShapeChange = { rule?: string | undefined; remove?: boolean; attributes?: Members } | null;

/** A missing number of a step is 1. */
const whole = (path: string): string => path.replaceAll(/(?<=[^\]])(?=\/|$)/g, '[1]');

/** The present change of the shape at this path. */
export const edit_at = (edits: Edit[], path: string): Edit | undefined => edits.find((edit) => whole(edit.shape) === whole(path));

/** The changes with another one of one shape. Its rule and attributes are kept unless it is removed. */
export function with_edit(edits: Edit[], path: string, change: ShapeChange): Edit[] {
  const others = edits.filter((edit) => whole(edit.shape) !== whole(path));
  if (!change) return others;
  if (change.remove) return [...others, { shape: path, remove: true }];
  const { rule, attributes = {} } = { ...edit_at(edits, path), ...change };
  const has_values = Object.keys(attributes).length > 0;
  if (rule === undefined && !has_values) return others;
  return [...others, { shape: path, ...(has_values ? { attributes } : {}), ...(rule === undefined ? {} : { rule }) }];
}
