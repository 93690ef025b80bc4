/** The form of a generator, drawn from its schema alone: groups, fields by type, faults at their fields. */
import type { Fault } from '../api';
import { el } from '../dom';
import { Board, type Draw, type Place } from './field';
import { list_field, map_field, member_fields, object_field, variant_field } from './group_fields';
import { placement_field } from './placement_field';
import { colors_field, image_field, request_field, vector_field } from './row_fields';
import { is_members, type Members, type Schema } from './schema';
import { choice_field, color_field, json_field, number_field, switch_field, word_field } from './simple_fields';
import { text_field } from './text_field';

/** A list of anything, of a fixed number of numbers, of colours, of lines of text. */
function list_for({ items, minItems, maxItems }: Schema): Draw {
  if (!items) return json_field;
  const is_number = items.type === 'number' || items.type === 'integer';
  if (is_number && minItems !== undefined && minItems === maxItems && minItems <= 16) return vector_field;
  if (items['x-widget'] === 'color') return colors_field;
  return items.type === 'string' ? text_field : list_field;
}

/** The field that can show what the schema describes. */
function field_for(schema: Schema): Draw {
  if (schema.enum) return choice_field;
  if (schema.oneOf) {
    const types = schema.oneOf.map((one) => one.type);
    return types.every((type) => type === 'number' || type === 'integer' || type === 'string') ? word_field : variant_field;
  }
  switch (schema.type) {
    case 'number':
    case 'integer': return number_field;
    case 'boolean': return switch_field;
    case 'string':
      if (schema['x-widget'] === 'color') return color_field;
      if (schema['x-widget'] === 'image') return image_field;
      return schema['x-grammar'] && schema['x-grammar'] !== 'expression' ? text_field : word_field;
    case 'array': return schema['x-widget'] === 'placement' ? placement_field : list_for(schema);
    case 'object':
      if (schema['x-widget'] === 'request') return request_field;
      if (schema.properties) return object_field;
      return is_members(schema.additionalProperties) ? map_field : json_field;
    default: return json_field;
  }
}

export const draw_field: Draw = (place) => field_for(place.schema)(place);

export { output_form } from './output_form';

export interface Form {
  element: HTMLElement;
  /** Shows faults at their fields and returns those that belong to none. */
  show_faults(faults: Fault[]): Fault[];
  /** Whether some field shows it. */
  holds(fault: Fault): boolean;
}

/** What is open and what has the focus, to be found again when the form is drawn anew. */
export function keep_place(place: HTMLElement): () => void {
  const key = (details: HTMLDetailsElement): string =>
    `${details.closest('[data-pointer]')?.getAttribute('data-pointer') ?? ''} ${details.className} ${details.querySelector('summary')?.textContent ?? ''}`;
  const open = new Map([...place.querySelectorAll('details')].map((details) => [key(details), details.open]));
  const { scrollTop } = place;
  const focused = place.contains(document.activeElement) ? document.activeElement?.closest('[data-pointer]')?.getAttribute('data-pointer') : null;
  return () => {
    for (const details of place.querySelectorAll('details')) details.open = open.get(key(details)) ?? details.open;
    place.scrollTop = scrollTop;
    if (focused) place.querySelector<HTMLElement>(`[data-pointer="${CSS.escape(focused)}"] :is(input, select, textarea, button)`)?.focus({ preventScroll: true });
  };
}

/** `pointer` is where the value stands in the request; `change` gets the whole new value. */
export function draw_form(schema: Schema, value: Members, base: Members, pointer: string, change: (value: Members) => void): Form {
  const board = new Board();
  const place: Place = {
    schema, pointer, label: schema.title ?? '', value, base, board,
    change: (next) => change(next as Members),
  };
  const groups = new Map<string, { first: HTMLElement[]; more: HTMLElement[] }>();
  for (const member of member_fields(place)) {
    const name = member.schema['x-group'] ?? 'General';
    const group = groups.get(name) ?? { first: [], more: [] };
    groups.set(name, group);
    // A member that is folded away but set by the request would be overlooked.
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
    show_faults(faults) {
      const homeless = board.show(faults);
      // What is faulty is not left folded away.
      for (const faulty of element.querySelectorAll('.field.faulty'))
        for (let up = faulty.closest('details'); up; up = up.parentElement?.closest('details') ?? null) up.open = true;
      return homeless;
    },
    holds: (fault) => board.holds(fault),
  };
}

/** What the generator is, in a line or two, and where it is explained at length. */
export const about = (generator: string, schema: Schema, description: string): HTMLElement =>
  el('p', { class: 'soft about' }, `${description || schema.description || ''} `, el('a', { href: `./docs#schema-${generator}` }, `About ${schema.title ?? generator}`));
