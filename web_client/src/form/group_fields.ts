/**
 * Fields that contain other fields: objects, lists, maps from names to values, and values with several forms (oneOf).
 */
import { el, icon } from '../dom';
import { frame, type Draw, type FieldSpec } from './field';
import { fits, fresh_value, is_members, pointer_to, same, type Members, type Schema } from './schema';
import { redrawable } from './simple_fields';

const words = (key: string): string => key.replaceAll('_', ' ').replace(/^./, (first) => first.toUpperCase());

/** The members of an object, each as a field. `change` receives the whole object. */
export function member_fields(spec: FieldSpec): { name: string; schema: Schema; element: HTMLElement }[] {
  const members: Members = is_members(spec.value) ? { ...spec.value } : {};
  const base: Members = is_members(spec.base) ? spec.base : {};
  return Object.entries(spec.schema.properties ?? {}).map(([name, schema]) => ({
    name,
    schema,
    element: spec.board.draw({
      schema,
      pointer: pointer_to(spec.pointer, name),
      label: schema.title ?? words(name),
      value: members[name],
      base: base[name],
      board: spec.board,
      required: spec.schema.required?.includes(name) ?? false,
      beside: (other) => members[other] ?? spec.schema.properties?.[other]?.default,
      grammar: () => members[Object.keys(spec.schema.properties ?? {}).find((other) => spec.schema.properties?.[other]?.['x-grammar']) ?? ''],
      change(value) {
        if (value === undefined) delete members[name];
        else members[name] = value;
        spec.value = { ...members };
        spec.change(spec.value);
      },
    }),
  }));
}

export const object_field: Draw = (spec) =>
  redrawable((redraw) => {
    const box = el('div', { class: 'nest' });
    const drawn = frame(spec, box, box, redraw);
    spec.board.clear_below(spec.pointer);
    const inner = { ...spec, change(value: unknown) { spec.value = value; spec.change(value); drawn.now(value); } };
    box.append(...member_fields(inner).map((member) => member.element));
    return drawn.element;
  });

/** The members of an object without a frame, for use inside an existing frame. */
const bare_fields = (spec: FieldSpec): HTMLElement[] =>
  spec.schema.properties ? member_fields(spec).map((member) => member.element) : [spec.board.draw(spec)];

const remove_button = (label: string, remove: () => void): HTMLElement =>
  el('button', { type: 'button', class: 'quiet small', 'aria-label': `Remove ${label}`, title: 'Remove', onclick: remove }, icon('remove'));

const add_button = (label: string, add: () => void): HTMLElement =>
  el('button', { type: 'button', class: 'add', onclick: add }, icon('add'), `Add ${label.toLowerCase()}`);

/** A list of items other than strings, with one collapsible card per entry. */
export const list_field: Draw = (spec) =>
  redrawable((redraw) => {
    const item = spec.schema.items ?? {};
    const item_title = item.title ?? 'entry';
    const given = spec.value ?? spec.schema.default;
    const entries: unknown[] = Array.isArray(given) ? [...given] : [];
    const box = el('div', { class: 'list' });
    const drawn = frame(spec, box, box, redraw);
    spec.board.clear_below(spec.pointer);
    const tell = (): void => { spec.value = [...entries]; spec.change(spec.value); drawn.now(spec.value); };
    const base_entries = Array.isArray(spec.base) ? spec.base : [];
    entries.forEach((entry, index) => {
      const name = `${item_title} ${index}`;
      const summary = el('summary', {}, ...summary_of(entry, name, item));
      const fields = bare_fields({
        schema: item, pointer: pointer_to(spec.pointer, index), label: name, value: entry, base: base_entries[index], board: spec.board,
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

/** Summary of an entry: its number, its first text, and a colour swatch if it has a colour. */
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

/** A map from names to values. If a name occurs twice, the lower row wins. */
export const map_field: Draw = (spec) =>
  redrawable((redraw) => {
    const item = is_members(spec.schema.additionalProperties) ? (spec.schema.additionalProperties as Schema) : {};
    const item_title = item.title ?? 'entry';
    const given = spec.value ?? spec.schema.default;
    const rows = Object.entries(is_members(given) ? given : {});
    const base: Members = is_members(spec.base) ? spec.base : {};
    const box = el('div', { class: 'map' });
    const drawn = frame(spec, box, box, redraw);
    spec.board.clear_below(spec.pointer);
    const tell = (): void => { spec.value = Object.fromEntries(rows); spec.change(spec.value); drawn.now(spec.value); };
    rows.forEach((row, index) => {
      const name = el('input', { type: 'text', class: 'name', value: row[0], 'aria-label': `Name of ${item_title.toLowerCase()} ${index + 1}`, spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off' });
      name.addEventListener('change', () => { row[0] = name.value.trim(); tell(); redraw('.add'); });
      const field = spec.board.draw({
        schema: item, pointer: pointer_to(spec.pointer, row[0]), label: row[0] || 'Value', value: row[1], base: base[row[0]], board: spec.board,
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

/** A value with several forms, such as a number or an object: a select for the form, with its field below. */
export const variant_field: Draw = (spec) =>
  redrawable((redraw) => {
    const forms = spec.schema.oneOf ?? [];
    const value = spec.value ?? spec.schema.default;
    const at = Math.max(0, forms.findIndex((form) => fits(form, value)));
    const form = forms[at] ?? {};
    const choose = el('select', { 'aria-label': `Form of ${spec.label}`, class: 'form-choice' }, ...forms.map((each, index) =>
      el('option', { value: index, selected: index === at }, each.title ?? form_names[each.type ?? ''] ?? `Form ${index + 1}`)));
    choose.addEventListener('change', () => {
      spec.value = converted(spec, forms[choose.selectedIndex] ?? {});
      spec.change(spec.value);
      redraw();
    });
    const { oneOf: _, ...common } = spec.schema;
    const inner = spec.board.draw({ ...spec, schema: { ...common, ...form }, value: spec.value, redraw, change(next) { spec.value = next; spec.change(next); } });
    inner.querySelector('.field-head')?.append(choose);
    return inner;
  });

/** Switching between the short and the long form keeps the numbers. Any other form starts with default values. */
function converted(spec: FieldSpec, to: Schema): unknown {
  const short = spec.schema['x-short'] ?? [];
  const value = spec.value ?? spec.schema.default;
  if (fits(to, spec.base) && !same(spec.base, value)) return structuredClone(spec.base);
  if (to.type === 'object' && typeof value === 'number') return Object.fromEntries(short.map((name) => [name, value]));
  const first = is_members(value) && short[0] !== undefined ? (value[short[0]] ?? spec.schema.default) : undefined;
  return fits(to, first) ? first : fresh_value(to);
}
