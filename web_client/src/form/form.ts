/** The form of a generator, built from its schema alone: groups, typed fields, and errors at their fields. */
import type { Issue } from '../api';
import { el } from '../dom';
import { Board, type FieldSpec } from './field';
import { draw_field } from './fields';
import { member_fields } from './group_fields';
import type { Members, Schema } from './schema';

export { output_form } from './output_form';

export interface Form {
  element: HTMLElement;
  /** Shows errors at their fields and returns those without a field. */
  show_issues(issues: Issue[]): Issue[];
  /** True if a field shows the error. */
  holds(issue: Issue): boolean;
}

/** Records the open groups and the focus, and restores them after the form is redrawn. */
export function keep_view(container: HTMLElement): () => void {
  const key = (details: HTMLDetailsElement): string =>
    `${details.closest('[data-pointer]')?.getAttribute('data-pointer') ?? ''} ${details.className} ${details.querySelector('summary')?.textContent ?? ''}`;
  const open = new Map([...container.querySelectorAll('details')].map((details) => [key(details), details.open]));
  const { scrollTop } = container;
  const focused = container.contains(document.activeElement) ? document.activeElement?.closest('[data-pointer]')?.getAttribute('data-pointer') : null;
  return () => {
    for (const details of container.querySelectorAll('details')) details.open = open.get(key(details)) ?? details.open;
    container.scrollTop = scrollTop;
    if (focused) container.querySelector<HTMLElement>(`[data-pointer="${CSS.escape(focused)}"] :is(input, select, textarea, button)`)?.focus({ preventScroll: true });
  };
}

/** `pointer` is the JSON Pointer of the value in the request; `change` receives the whole new value. */
export function draw_form(schema: Schema, value: Members, base: Members, pointer: string, change: (value: Members) => void): Form {
  const board = new Board(draw_field);
  const spec: FieldSpec = {
    schema, pointer, label: schema.title ?? '', value, base, board,
    change: (next) => change(next as Members),
  };
  const groups = new Map<string, { first: HTMLElement[]; more: HTMLElement[] }>();
  for (const member of member_fields(spec)) {
    const name = member.schema['x-group'] ?? 'General';
    const group = groups.get(name) ?? { first: [], more: [] };
    groups.set(name, group);
    // An advanced member that the request sets is not folded away, because it would be overlooked.
    const folded = member.schema['x-advanced'] && !(member.name in value);
    group[folded ? 'more' : 'first'].push(member.element);
  }
  const element = el('div', { class: 'form' }, ...[...groups].map(([name, group]) =>
    el('details', { class: 'group', open: true },
      el('summary', {}, el('h3', {}, name)),
      ...group.first,
      group.more.length > 0 && el('details', { class: 'more' }, el('summary', {}, 'More'), ...group.more))));
  return {
    element,
    show_issues(issues) {
      const homeless = board.show(issues);
      // Opens the groups that contain errors.
      for (const invalid of element.querySelectorAll('.field.invalid'))
        for (let up = invalid.closest('details'); up; up = up.parentElement?.closest('details') ?? null) up.open = true;
      return homeless;
    },
    holds: (issue) => board.holds(issue),
  };
}

/** A short description of the generator with a link to its documentation. */
export const about = (generator: string, schema: Schema, description: string): HTMLElement =>
  el('p', { class: 'soft about' }, `${description || schema.description || ''} `, el('a', { href: `./docs#schema-${generator}` }, `About ${schema.title ?? generator}`));
