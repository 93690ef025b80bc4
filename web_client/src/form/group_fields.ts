/** Fields that hold fields: objects, lists, maps from names to values, and choices between forms of one value. */
import { el, icon } from '../dom';
import { draw_field } from './form';
import { frame, type Draw, type Place } from './field';
import { fits, fresh_value, is_members, pointer_to, same, type Members, type Schema } from './schema';
import { redrawable } from './simple_fields';

const words = (key: string): string => key.replaceAll('_', ' ').replace(/^./, (first) => first.toUpperCase());

/** The members of an object, each a field; `change` gets the whole object. */
export function member_fields(place: Place): { name: string; schema: Schema; element: HTMLElement }[] {
  const members: Members = is_members(place.value) ? { ...place.value } : {};
  const base: Members = is_members(place.base) ? place.base : {};
  return Object.entries(place.schema.properties ?? {}).map(([name, schema]) => ({
    name,
    schema,
    element: draw_field({
      schema,
      pointer: pointer_to(place.pointer, name),
      label: schema.title ?? words(name),
      value: members[name],
      base: base[name],
      board: place.board,
      required: place.schema.required?.includes(name) ?? false,
      beside: (other) => members[other] ?? place.schema.properties?.[other]?.default,
      change(value) {
        if (value === undefined) delete members[name];
        else members[name] = value;
        place.value = { ...members };
        place.change(place.value);
      },
    }),
  }));
}

export const object_field: Draw = (place) =>
  redrawable((redraw) => {
    const box = el('div', { class: 'nest' });
    const drawn = frame(place, box, box, redraw);
    place.board.clear_below(place.pointer);
    const inner = { ...place, change(value: unknown) { place.value = value; place.change(value); drawn.now(value); } };
    box.append(...member_fields(inner).map((member) => member.element));
    return drawn.element;
  });

/** An object's members without a frame round them, for where a frame stands already. */
const bare_fields = (place: Place): HTMLElement[] =>
  place.schema.properties ? member_fields(place).map((member) => member.element) : [draw_field(place)];

const remove_button = (label: string, remove: () => void): HTMLElement =>
  el('button', { type: 'button', class: 'quiet small', 'aria-label': `Remove ${label}`, title: 'Remove', onclick: remove }, icon('remove'));

const add_button = (label: string, add: () => void): HTMLElement =>
  el('button', { type: 'button', class: 'add', onclick: add }, icon('add'), `Add ${label.toLowerCase()}`);

/** A list of anything but strings: one folded card an entry. */
export const list_field: Draw = (place) =>
  redrawable((redraw) => {
    const item = place.schema.items ?? {};
    const item_title = item.title ?? 'entry';
    const given = place.value ?? place.schema.default;
    const entries: unknown[] = Array.isArray(given) ? [...given] : [];
    const box = el('div', { class: 'list' });
    const drawn = frame(place, box, box, redraw);
    place.board.clear_below(place.pointer);
    const tell = (): void => { place.value = [...entries]; place.change(place.value); drawn.now(place.value); };
    const base_entries = Array.isArray(place.base) ? place.base : [];
    entries.forEach((entry, index) => {
      const name = `${item_title} ${index}`;
      const summary = el('summary', {}, ...summary_of(entry, name, item));
      const fields = bare_fields({
        schema: item, pointer: pointer_to(place.pointer, index), label: name, value: entry, base: base_entries[index], board: place.board,
        change(value) { entries[index] = value; summary.replaceChildren(...summary_of(value, name, item)); tell(); },
      });
      const remove = remove_button(name, () => { entries.splice(index, 1); tell(); redraw('.add'); });
      box.append(el('details', { class: 'entry' }, summary, el('div', { class: 'entry-body' }, ...fields, remove)));
    });
    box.append(add_button(item_title, () => {
      entries.push(entries.length ? structuredClone(entries.at(-1)) : fresh_value(item));
      tell();
      redraw('.add');
    }));
    return drawn.element;
  });

/** An entry's number, its first text, and a swatch where it has a colour. */
function summary_of(entry: unknown, name: string, schema: Schema): (Node | string)[] {
  const parts: (Node | string)[] = [];
  let text = is_members(entry) ? '' : String(entry);
  for (const [key, member] of Object.entries(is_members(entry) ? entry : {})) {
    if (schema.properties?.[key]?.['x-widget'] === 'color') {
      const swatch = el('span', { class: 'swatch' });
      swatch.style.backgroundColor = String(member);
      parts.push(swatch);
    } else if (typeof member === 'string' && !text) text = member;
  }
  return [...parts, name, text ? el('span', { class: 'soft' }, text) : ''];
}

/** Names with values. A name that is taken twice counts once, the lower row. */
export const map_field: Draw = (place) =>
  redrawable((redraw) => {
    const item = is_members(place.schema.additionalProperties) ? (place.schema.additionalProperties as Schema) : {};
    const item_title = item.title ?? 'entry';
    const given = place.value ?? place.schema.default;
    const rows = Object.entries(is_members(given) ? given : {});
    const base: Members = is_members(place.base) ? place.base : {};
    const box = el('div', { class: 'map' });
    const drawn = frame(place, box, box, redraw);
    place.board.clear_below(place.pointer);
    const tell = (): void => { place.value = Object.fromEntries(rows); place.change(place.value); drawn.now(place.value); };
    rows.forEach((row, index) => {
      const name = el('input', { type: 'text', class: 'name', value: row[0], 'aria-label': `Name of ${item_title.toLowerCase()} ${index + 1}`, spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off' });
      name.addEventListener('change', () => { row[0] = name.value.trim(); tell(); redraw('.add'); });
      const field = draw_field({
        schema: item, pointer: pointer_to(place.pointer, row[0]), label: row[0] || 'Value', value: row[1], base: base[row[0]], board: place.board,
        change(value) { row[1] = value ?? ''; tell(); },
      });
      box.append(el('div', { class: 'pair' }, name, field, remove_button(row[0], () => { rows.splice(index, 1); tell(); redraw('.add'); })));
    });
    box.append(add_button(item_title, () => {
      let number = rows.length + 1;
      while (rows.some(([taken]) => taken === `c${number}`)) number += 1;
      const types = item.oneOf?.map((one) => one.type) ?? [item.type];
      rows.push([`c${number}`, types.includes('number') ? 1 : fresh_value(item)]);
      tell();
      redraw('.add');
    }));
    return drawn.element;
  });

const form_names: Record<string, string> = { number: 'One value', integer: 'One value', object: 'In detail', array: 'List', string: 'By name', boolean: 'On or off', null: 'None' };

/** One value in several forms, such as a number or an object: a choice of the form, and its field below. */
export const variant_field: Draw = (place) =>
  redrawable((redraw) => {
    const forms = place.schema.oneOf ?? [];
    const value = place.value ?? place.schema.default;
    const at = Math.max(0, forms.findIndex((form) => fits(form, value)));
    const form = forms[at] ?? {};
    const choose = el('select', { 'aria-label': `Form of ${place.label}`, class: 'form-choice' }, ...forms.map((each, index) =>
      el('option', { value: index, selected: index === at }, each.title ?? form_names[each.type ?? ''] ?? `Form ${index + 1}`)));
    choose.addEventListener('change', () => {
      place.value = converted(place, forms[choose.selectedIndex] ?? {});
      place.change(place.value);
      redraw();
    });
    const { oneOf: _, ...common } = place.schema;
    const inner = draw_field({ ...place, schema: { ...common, ...form }, value: place.value, redraw, change(next) { place.value = next; place.change(next); } });
    inner.querySelector('.field-head')?.append(choose);
    return inner;
  });

/** Between the short and the long form the numbers are kept; any other form starts afresh. */
function converted(place: Place, to: Schema): unknown {
  const short = place.schema['x-short'] ?? [];
  const value = place.value ?? place.schema.default;
  if (fits(to, place.base) && !same(place.base, value)) return structuredClone(place.base);
  if (to.type === 'object' && typeof value === 'number') return Object.fromEntries(short.map((name) => [name, value]));
  const first = is_members(value) && short[0] !== undefined ? (value[short[0]] ?? place.schema.default) : undefined;
  return fits(to, first) ? first : fresh_value(to);
}
