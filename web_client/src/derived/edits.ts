/** Changes of single shapes of a building: the parameter `edits`, which finds a shape by its path. */
import { is_members, type Members } from '../form/schema';

/** What changes about a shape; null takes the change back. */
export type ShapeChange = { remove: true } | { rule: string } | null;

const same_path = (one: unknown, other: string): boolean =>
  typeof one === 'string' && one.replaceAll(/(?<=[^\]])(?=\/|$)/g, '[1]') === other.replaceAll(/(?<=[^\]])(?=\/|$)/g, '[1]');

const edits_in = (parameters: Members): Members[] => (Array.isArray(parameters['edits']) ? parameters['edits'].filter(is_members) : []);

/** The present change of the shape at this path. */
export const edit_at = (parameters: Members, path: string): Members | undefined => edits_in(parameters).find((edit) => same_path(edit['shape'], path));

/** The parameters with another change of one shape. Attributes of an edit are kept unless the shape is removed. */
export function with_edit(parameters: Members, path: string, change: ShapeChange): Members {
  const others = edits_in(parameters).filter((edit) => !same_path(edit['shape'], path));
  const attributes = edit_at(parameters, path)?.['attributes'];
  const kept = attributes !== undefined && !(change && 'remove' in change) ? { attributes } : {};
  const edits = change ? [...others, { shape: path, ...kept, ...change }] : others;
  const { edits: _, ...rest } = parameters;
  return edits.length > 0 ? { ...rest, edits } : rest;
}
