/** Fields with one small value: numbers, choices, switches, colours, words. */
import { el } from '../dom';
import { parse_json } from '../exact';
import { frame, type Draw, type Place, type Redraw } from './field';
import type { Schema } from './schema';

const shown = (place: Place): unknown => place.value ?? place.schema.default;

/** What stands for a number that is left out: another number of the request, or what the schema has as an example. */
function stand_in(place: Place): number | undefined {
  const full = place.schema['x-full'];
  const other = full === undefined ? place.schema.examples?.[0] : place.beside?.(full);
  return typeof other === 'number' ? other : undefined;
}

/** A field whose whole drawing can be made anew. */
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

/** What a slider spans: up to `full`, where more is no more. A range too wide to aim in is cut to the neighbourhood of the value. */
export function slider_span(schema: Schema, value: number, full?: number): { low: number; high: number; step: number } {
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

/** Asks the page to let grow by this number, up to what it is, or to what stands for it. */
function grow_button(place: Place): HTMLElement {
  return el('button', { type: 'button', class: 'grow', title: 'Lets it grow up to this number', 'aria-label': `Grow by ${place.label}`, onclick(event) {
    const value = shown(place);
    const detail = { pointer: place.pointer, until: typeof value === 'number' && value > 0 ? value : stand_in(place) ?? 1, label: place.label, unit: place.schema['x-unit'] ?? '' };
    event.target?.dispatchEvent(new CustomEvent('grow', { bubbles: true, detail }));
  } }, 'Grow');
}

export const number_field: Draw = (place) =>
  redrawable((redraw) => {
    const value = shown(place);
    const usual = stand_in(place);
    const known = typeof value === 'number' ? value : usual ?? 0;
    // What the server takes then is not known here: the slider shows no place of it.
    const is_open = typeof value !== 'number' && usual === undefined;
    const { low, high, step } = slider_span(place.schema, known, place.schema['x-full'] === undefined ? undefined : usual);
    const box = el('input', { type: 'number', step, value: typeof value === 'number' ? value : '', placeholder: usual ?? 'not set', inputmode: 'decimal' });
    const slider = el('input', { type: 'range', min: low, max: high, step, value: known, 'aria-label': `${place.label}, slider`, class: is_open ? 'unset' : '', 'aria-valuetext': is_open ? 'not set' : undefined });
    const unit = place.schema['x-unit'];
    const body = el('div', { class: 'number' }, slider, el('span', { class: 'box' }, box, unit ? el('span', { class: 'unit' }, unit) : null),
      place.schema['x-widget'] === 'growth' && grow_button(place));
    const drawn = frame(place, box, body, redraw);
    const take = (next: number): void => {
      slider.classList.remove('unset');
      slider.removeAttribute('aria-valuetext');
      place.value = next;
      place.change(next);
      drawn.now(next);
    };
    slider.addEventListener('input', () => { box.value = slider.value; take(slider.valueAsNumber); });
    box.addEventListener('input', () => {
      if (Number.isNaN(box.valueAsNumber)) return;
      slider.value = box.value;
      take(box.valueAsNumber);
    });
    // An emptied box says nothing: it shows the value that counts again.
    box.addEventListener('change', () => { if (Number.isNaN(box.valueAsNumber)) box.value = String(shown(place) ?? ''); });
    return drawn.element;
  });

export const choice_field: Draw = (place) =>
  redrawable((redraw) => {
    const values = place.schema.enum ?? [];
    const value = shown(place);
    const readable = (each: unknown): string => String(each).replaceAll('_', ' ');
    const option = (each: unknown, words: string): HTMLElement => el('option', { value: String(each), selected: each === value }, words);
    const select = el('select', {},
      // What a request may leave out, and what it says wrongly, is not passed off as one of the choices.
      (place.schema.default === undefined && !place.required) && el('option', { value: '', selected: value === undefined }, 'not set'),
      (value !== undefined && !values.includes(value)) && el('option', { value: '?', selected: true, disabled: true }, `${readable(value)}: not known`),
      ...values.map((each) => option(each, readable(each))));
    const drawn = frame(place, select, select, redraw);
    select.addEventListener('change', () => {
      const next = values.find((each) => String(each) === select.value);
      place.change(next);
      drawn.now(next);
    });
    return drawn.element;
  });

export const switch_field: Draw = (place) =>
  redrawable((redraw) => {
    const box = el('input', { type: 'checkbox', class: 'switch', checked: shown(place) === true });
    const drawn = frame(place, box, box, redraw);
    drawn.element.classList.add('field-inline');
    box.addEventListener('change', () => { place.change(box.checked); drawn.now(box.checked); });
    return drawn.element;
  });

export const color_field: Draw = (place) =>
  redrawable((redraw) => {
    const value = String(shown(place) ?? '');
    const well = el('input', { type: 'color', value: value || '#808080', class: value ? '' : 'unset', 'aria-label': `${place.label}, picker` });
    const text = el('input', { type: 'text', value, size: 8, placeholder: 'not set', spellcheck: 'false', autocomplete: 'off' });
    const drawn = frame(place, text, el('div', { class: 'color' }, well, text), redraw);
    const take = (next: string): void => {
      const colour = next === '' ? undefined : next;
      well.classList.toggle('unset', colour === undefined);
      place.change(colour);
      drawn.now(colour);
    };
    well.addEventListener('input', () => { text.value = well.value; take(well.value); });
    text.addEventListener('input', () => {
      if (/^#[0-9a-f]{6}$/i.test(text.value)) well.value = text.value;
      take(text.value);
    });
    return drawn.element;
  });

/** Text; where the schema takes a number too, text that reads as a number is one. */
export const word_field: Draw = (place) =>
  redrawable((redraw) => {
    const takes_number = place.schema.oneOf?.some((one) => one.type === 'number' || one.type === 'integer') ?? false;
    const example = place.schema.examples?.[0];
    const input = el('input', { type: 'text', value: String(shown(place) ?? ''), spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off', placeholder: typeof example === 'string' ? example : undefined, maxlength: place.schema.maxLength });
    const drawn = frame(place, input, input, redraw);
    input.addEventListener('input', () => {
      const number = Number(input.value);
      // Whole numbers beyond 2^53 would be rounded: their digits stay as they are.
      const is_exact = Number.isSafeInteger(number) || !/^\s*\d+\s*$/.test(input.value);
      const value = takes_number && input.value.trim() !== '' && Number.isFinite(number) && is_exact ? number : input.value;
      place.change(value);
      drawn.now(value);
    });
    return drawn.element;
  });

/** What no other field can show: the JSON itself. */
export const json_field: Draw = (place) =>
  redrawable((redraw) => {
    const area = el('textarea', { rows: 4, class: 'code', spellcheck: 'false' });
    area.value = shown(place) === undefined ? '' : JSON.stringify(shown(place), null, 2);
    const drawn = frame(place, area, area, redraw);
    area.addEventListener('input', () => {
      let value: unknown;
      try {
        value = area.value.trim() === '' ? undefined : parse_json(area.value);
      } catch {
        area.setAttribute('aria-invalid', 'true');
        return;
      }
      area.setAttribute('aria-invalid', 'false');
      place.change(value);
      drawn.now(value);
    });
    return drawn.element;
  });
