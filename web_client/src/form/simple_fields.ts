/** Fields with a single small value: numbers, choices, switches, colours and text. */
import { el } from '../dom';
import { parse_json } from '../exact';
import { frame, type Draw, type FieldSpec, type Redraw } from './field';
import type { Schema } from './schema';

const shown = (spec: FieldSpec): unknown => spec.value ?? spec.schema.default;

/** The value that applies to an omitted number: another number of the request, or the example of the schema. */
function stand_in(spec: FieldSpec): number | undefined {
  const full = spec.schema['x-full'];
  const other = full === undefined ? spec.schema.examples?.[0] : spec.beside?.(full);
  return typeof other === 'number' ? other : undefined;
}

/** A field that can redraw itself. */
export function redrawable(make: (redraw: Redraw) => HTMLElement): HTMLElement {
  let element: HTMLElement;
  const redraw: Redraw = (focus = 'input, select, textarea') => {
    const next = make(redraw);
    element.replaceWith(next);
    element = next;
    [...next.querySelectorAll<HTMLElement>(focus)].at(-1)?.focus();
  };
  element = make(redraw);
  return element;
}

/**
 * The range of a slider. It ends at `full`, the upper bound that another member sets. A range too wide for a slider
 * is reduced to the neighbourhood of the value.
 */
function slider_span(schema: Schema, value: number, full?: number): { low: number; high: number; step: number } {
  const { minimum = -Infinity, maximum = Infinity } = schema;
  const whole = schema.type === 'integer';
  const usual = typeof schema.default === 'number' ? schema.default : 0;
  const near = Math.max(Math.abs(value), Math.abs(usual)) || 1;
  const step = schema['x-step'] ?? (whole ? 1 : 10 ** Math.floor(Math.log10(near / 20)));
  if (schema['x-steps']) return { low: Math.max(minimum, 0), high: Math.min(maximum, Math.max(value + 2, 4)), step };
  if (full !== undefined) return { low: Math.max(minimum, 0), high: Math.min(maximum, Math.max(value, full)), step };
  if ((maximum - minimum) / step <= 2000) return { low: minimum, high: maximum, step };
  const reach = Math.ceil((near * 3) / step) * step;
  return { low: Math.max(minimum, minimum < 0 ? -reach : 0), high: Math.min(maximum, reach), step };
}

/** Asks the page to play the growth over this number, up to its value or default. */
function grow_button(spec: FieldSpec): HTMLElement {
  return el('button', { type: 'button', class: 'grow', title: 'Shows the growth up to this number', 'aria-label': `Grow by ${spec.label}`, onclick(event) {
    const value = shown(spec);
    const detail = { pointer: spec.pointer, until: typeof value === 'number' && value > 0 ? value : stand_in(spec) ?? 1, label: spec.label, unit: spec.schema['x-unit'] ?? '' };
    event.target?.dispatchEvent(new CustomEvent('grow', { bubbles: true, detail }));
  } }, 'Grow');
}

export const number_field: Draw = (spec) =>
  redrawable((redraw) => {
    const value = shown(spec);
    const usual = stand_in(spec);
    const known = typeof value === 'number' ? value : usual ?? 0;
    // The server's default is unknown here, so the slider shows no position.
    const is_open = typeof value !== 'number' && usual === undefined;
    const { low, high, step } = slider_span(spec.schema, known, spec.schema['x-full'] === undefined ? undefined : usual);
    const box = el('input', { type: 'number', step, value: typeof value === 'number' ? value : '', placeholder: usual ?? 'not set', inputmode: 'decimal' });
    const slider = el('input', { type: 'range', min: low, max: high, step, value: known, 'aria-label': `${spec.label}, slider`, class: is_open ? 'unset' : '', 'aria-valuetext': is_open ? 'not set' : undefined });
    const unit = spec.schema['x-unit'];
    const body = el('div', { class: 'number' }, slider, el('span', { class: 'box' }, box, unit ? el('span', { class: 'unit' }, unit) : null),
      spec.schema['x-widget'] === 'growth' && grow_button(spec));
    const drawn = frame(spec, box, body, redraw);
    const take = (next: number): void => {
      slider.classList.remove('unset');
      slider.removeAttribute('aria-valuetext');
      spec.value = next;
      spec.change(next);
      drawn.now(next);
    };
    slider.addEventListener('input', () => { box.value = slider.value; take(slider.valueAsNumber); });
    box.addEventListener('input', () => {
      if (Number.isNaN(box.valueAsNumber)) return;
      slider.value = box.value;
      take(box.valueAsNumber);
    });
    // An empty input removes no value, so the current one is shown again.
    box.addEventListener('change', () => { if (Number.isNaN(box.valueAsNumber)) box.value = String(shown(spec) ?? ''); });
    return drawn.element;
  });

export const choice_field: Draw = (spec) =>
  redrawable((redraw) => {
    const values = spec.schema.enum ?? [];
    const value = shown(spec);
    const readable = (each: unknown): string => String(each).replaceAll('_', ' ');
    const option = (each: unknown, words: string): HTMLElement => el('option', { value: String(each), selected: each === value }, words);
    const select = el('select', {},
      // An omitted or invalid value must not appear as one of the choices.
      (spec.schema.default === undefined && !spec.required) && el('option', { value: '', selected: value === undefined }, 'not set'),
      (value !== undefined && !values.includes(value)) && el('option', { value: '?', selected: true, disabled: true }, `${readable(value)}: not known`),
      ...values.map((each) => option(each, readable(each))));
    const drawn = frame(spec, select, select, redraw);
    select.addEventListener('change', () => {
      const next = values.find((each) => String(each) === select.value);
      spec.change(next);
      drawn.now(next);
    });
    return drawn.element;
  });

export const switch_field: Draw = (spec) =>
  redrawable((redraw) => {
    const box = el('input', { type: 'checkbox', class: 'switch', checked: shown(spec) === true });
    const drawn = frame(spec, box, box, redraw);
    drawn.element.classList.add('field-inline');
    box.addEventListener('change', () => { spec.change(box.checked); drawn.now(box.checked); });
    return drawn.element;
  });

/** Returns the colour of a text as `#rrggbb`, which a picker needs: codes, names of CSS (`DarkOrange`) and codes without `#`. */
function picker_color(text: string): string | undefined {
  if (/^#[0-9a-f]{6}$/i.test(text)) return text;
  const context = document.createElement('canvas').getContext('2d');
  if (!context || text === '') return undefined;
  const unknown = '#010203';
  context.fillStyle = unknown;
  context.fillStyle = /^[0-9a-f]{6}$/i.test(text) ? `#${text}` : text;
  const found = String(context.fillStyle);
  return found !== unknown && /^#[0-9a-f]{6}$/.test(found) ? found : undefined;
}

export const color_field: Draw = (spec) =>
  redrawable((redraw) => {
    const value = String(shown(spec) ?? '');
    const well = el('input', { type: 'color', value: picker_color(value) ?? '#808080', class: value ? '' : 'unset', 'aria-label': `${spec.label}, picker` });
    const text = el('input', { type: 'text', value, size: 8, placeholder: 'not set', spellcheck: 'false', autocomplete: 'off' });
    const drawn = frame(spec, text, el('div', { class: 'color' }, well, text), redraw);
    const take = (next: string): void => {
      const colour = next === '' ? undefined : next;
      well.classList.toggle('unset', colour === undefined);
      spec.change(colour);
      drawn.now(colour);
    };
    well.addEventListener('input', () => { text.value = well.value; take(well.value); });
    text.addEventListener('input', () => {
      well.value = picker_color(text.value) ?? well.value;
      take(text.value);
    });
    return drawn.element;
  });

/** Text. If the schema also accepts a number, text that parses as a number is stored as one. */
export const word_field: Draw = (spec) =>
  redrawable((redraw) => {
    const takes_number = spec.schema.oneOf?.some((one) => one.type === 'number' || one.type === 'integer') ?? false;
    const example = spec.schema.examples?.[0];
    const input = el('input', { type: 'text', value: String(shown(spec) ?? ''), spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off', placeholder: typeof example === 'string' ? example : undefined, maxlength: spec.schema.maxLength });
    const drawn = frame(spec, input, input, redraw);
    input.addEventListener('input', () => {
      const number = Number(input.value);
      // Whole numbers beyond 2^53 would be rounded, so their digits are kept as text.
      const is_exact = Number.isSafeInteger(number) || !/^\s*\d+\s*$/.test(input.value);
      const value = takes_number && input.value.trim() !== '' && Number.isFinite(number) && is_exact ? number : input.value;
      spec.change(value);
      drawn.now(value);
    });
    return drawn.element;
  });

/** The fallback for all other values: the JSON text. */
export const json_field: Draw = (spec) =>
  redrawable((redraw) => {
    const area = el('textarea', { rows: 4, class: 'code', spellcheck: 'false' });
    area.value = shown(spec) === undefined ? '' : JSON.stringify(shown(spec), null, 2);
    const drawn = frame(spec, area, area, redraw);
    area.addEventListener('input', () => {
      let value: unknown;
      try {
        value = area.value.trim() === '' ? undefined : parse_json(area.value);
      } catch {
        area.setAttribute('aria-invalid', 'true');
        return;
      }
      area.setAttribute('aria-invalid', 'false');
      spec.change(value);
      drawn.now(value);
    });
    return drawn.element;
  });

/** Longer lists make the page slow; they are changed in the text of the request. */
const most_rows = 3000;

const rows_text = (value: unknown): string =>
  Array.isArray(value) && value.length > 0 ? `[\n${value.map((row) => JSON.stringify(row)).join(',\n')}\n]` : value === undefined ? '' : JSON.stringify(value);

/** A long list as JSON with one item on each line. */
export const rows_field: Draw = (spec) =>
  redrawable((redraw) => {
    const value = shown(spec);
    const count = Array.isArray(value) ? value.length : 0;
    const area = el('textarea', { rows: Math.min(count + 3, 12), class: 'code', spellcheck: 'false', wrap: 'off' });
    const is_long = count > most_rows;
    area.readOnly = is_long;
    area.value = is_long ? `${count.toLocaleString('en')} items: too many for this field. Code shows them.` : rows_text(value);
    const drawn = frame(spec, area, area, redraw);
    area.addEventListener('input', () => {
      let read: unknown;
      try {
        read = area.value.trim() === '' ? undefined : parse_json(area.value);
      } catch {
        area.setAttribute('aria-invalid', 'true');
        return;
      }
      area.setAttribute('aria-invalid', 'false');
      spec.change(read);
      drawn.now(read);
    });
    return drawn.element;
  });
