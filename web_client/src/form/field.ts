/** What every field of the form is made of: its place in the request, its frame, and where its faults are shown. */
import type { Fault } from '../api';
import { el, fresh_id, icon, with_groups } from '../dom';
import { same, type Schema } from './schema';

/** Where a field sits, and how it tells that it was changed. */
export interface Place {
  schema: Schema;
  /** JSON Pointer into the request. */
  pointer: string;
  label: string;
  value: unknown;
  /** What "reset" goes back to; undefined leaves the member out. */
  base: unknown;
  board: Board;
  /** Whether it cannot be left out. */
  required?: boolean;
  /** The value of a member of the same object, or what the schema says for it. */
  beside?(name: string): unknown;
  /** undefined takes the member out of the request. */
  change(value: unknown): void;
  /** Where more than the field itself has to be drawn anew after a reset. */
  redraw?: Redraw;
}

/** Draws a field anew and gives the focus to the last element that matches. */
export type Redraw = (focus?: string) => void;

/** Draws the field with the value and its control in place. */
export type Draw = (place: Place) => HTMLElement;

/** Takes the faults at its pointer or below. */
export type Sink = (faults: Fault[]) => void;

/** All fields by pointer; a fault goes to the one that is nearest above it. */
export class Board {
  private readonly sinks = new Map<string, Sink>();

  add(pointer: string, sink: Sink): void {
    this.sinks.set(pointer, sink);
  }

  /** Forgets what stood below a field that is drawn anew. */
  clear_below(pointer: string): void {
    for (const key of this.sinks.keys()) if (key.startsWith(`${pointer}/`)) this.sinks.delete(key);
  }

  holds(fault: Fault): boolean {
    return this.sinks.has(this.nearest(fault));
  }

  private nearest(fault: Fault): string {
    let { pointer } = fault;
    while (pointer && !this.sinks.has(pointer)) pointer = pointer.slice(0, pointer.lastIndexOf('/'));
    return pointer;
  }

  /** Shows each fault at its field, takes away those that are mended, and returns the ones without a field. */
  show(faults: Fault[]): Fault[] {
    const by_sink = new Map<string, Fault[]>();
    const homeless: Fault[] = [];
    for (const fault of faults) {
      const pointer = this.nearest(fault);
      if (!this.sinks.has(pointer)) homeless.push(fault);
      else by_sink.set(pointer, [...(by_sink.get(pointer) ?? []), fault]);
    }
    for (const [pointer, sink] of this.sinks) sink(by_sink.get(pointer) ?? []);
    return homeless;
  }
}

export interface Frame {
  element: HTMLElement;
  /** Tells the frame the value that is shown now, for its reset button. */
  now(value: unknown): void;
  /** The control has given way to one that is labelled otherwise. */
  no_control(): void;
}

/**
 * Label, help, reset and faults round a control. `control` carries the label and the faults for assistive tools;
 * `body` is what is drawn. A group of controls (a list, a map) is labelled as a group instead.
 */
export function frame(place: Place, control: HTMLElement, body: HTMLElement, redraw: Redraw): Frame {
  const { schema, board } = place;
  const is_group = !(control instanceof HTMLInputElement || control instanceof HTMLSelectElement || control instanceof HTMLTextAreaElement);
  control.id ||= fresh_id('field');
  const label = el(is_group ? 'span' : 'label', { class: 'label', id: `${control.id}-label`, for: is_group ? undefined : control.id }, place.label);
  const help = el('p', { class: 'help', id: `${control.id}-help`, hidden: true }, schema.description ?? '');
  const fault = el('p', { class: 'fault', id: `${control.id}-fault`, hidden: true });

  const open_help = el('button', { type: 'button', class: 'quiet small', 'aria-label': `About ${place.label}`, 'aria-expanded': 'false', title: schema.description, 'aria-controls': help.id }, icon('help'));
  open_help.addEventListener('click', () => {
    help.hidden = !help.hidden;
    open_help.setAttribute('aria-expanded', String(!help.hidden));
  });
  const reset = el('button', { type: 'button', class: 'quiet small reset', 'aria-label': `Reset ${place.label}`, title: 'Reset', hidden: true }, icon('reset'));
  reset.addEventListener('click', () => {
    place.value = structuredClone(place.base);
    place.change(place.value);
    (place.redraw ?? redraw)();
  });

  if (is_group) { control.setAttribute('role', 'group'); control.setAttribute('aria-labelledby', label.id); }
  control.setAttribute('aria-describedby', `${help.id} ${fault.id}`);
  const element = el('div', { class: 'field', 'data-pointer': place.pointer },
    el('div', { class: 'field-head' }, label, schema.description ? open_help : null, reset), body, help, fault);

  board.add(place.pointer, (faults) => {
    const is_faulty = faults.some((each) => !each.mild);
    element.classList.toggle('faulty', is_faulty);
    if (!is_group) control.setAttribute('aria-invalid', String(is_faulty));
    fault.classList.toggle('mild', !is_faulty);
    fault.hidden = faults.length === 0;
    fault.textContent = with_groups(faults.map((each) => each.message).join('\n'));
  });
  const now = (value: unknown): void => { reset.hidden = same(value, place.base); };
  now(place.value);
  const no_control = (): void => { label.removeAttribute('for'); };
  return { element, now, no_control };
}
