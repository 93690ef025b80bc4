/** The common parts of all form fields: the pointer into the request, the frame, and the display of errors. */
import type { Issue } from '../api';
import { el, fresh_id, icon, with_groups } from '../dom';
import { same, type Schema } from './schema';

/** The position of a field in the request, and the callbacks for its changes. */
export interface FieldSpec {
  schema: Schema;
  /** The JSON Pointer of the field in the request. */
  pointer: string;
  label: string;
  value: unknown;
  /** The value that "reset" restores; undefined removes the member. */
  base: unknown;
  board: Board;
  /** True if the member cannot be removed. */
  required?: boolean;
  /** The value of a sibling member, or its default from the schema. */
  beside?(name: string): unknown;
  /** The value of the sibling member that is a grammar. */
  grammar?(): unknown;
  /** Called with the new value; undefined removes the member from the request. */
  change(value: unknown): void;
  /** Called if a reset has to redraw more than the field itself. */
  redraw?: Redraw;
}

/** Redraws a field and focuses the last element that matches the selector. */
export type Redraw = (focus?: string) => void;

/** Draws the field with its current value and its control. */
export type Draw = (spec: FieldSpec) => HTMLElement;

/** Shows the errors at its pointer or below. */
export type Sink = (issues: Issue[]) => void;

/** All fields by pointer. An error is shown at the nearest field that contains its pointer. */
export class Board {
  readonly draw: Draw;
  private readonly sinks = new Map<string, Sink>();

  /**
   * `draw` draws any field from its schema. Nested fields use it, so that no kind of field has to import the others.
   */
  constructor(draw: Draw) {
    this.draw = draw;
  }

  add(pointer: string, sink: Sink): void {
    this.sinks.set(pointer, sink);
  }

  /** Removes the fields below a field that is being redrawn. */
  clear_below(pointer: string): void {
    for (const key of this.sinks.keys()) if (key.startsWith(`${pointer}/`)) this.sinks.delete(key);
  }

  holds(issue: Issue): boolean {
    return this.sinks.has(this.nearest(issue));
  }

  private nearest(issue: Issue): string {
    let { pointer } = issue;
    while (pointer && !this.sinks.has(pointer)) pointer = pointer.slice(0, pointer.lastIndexOf('/'));
    return pointer;
  }

  /** Shows each error at its field, removes the corrected ones, and returns those without a field. */
  show(issues: Issue[]): Issue[] {
    const by_sink = new Map<string, Issue[]>();
    const homeless: Issue[] = [];
    for (const issue of issues) {
      const pointer = this.nearest(issue);
      if (!this.sinks.has(pointer)) homeless.push(issue);
      else by_sink.set(pointer, [...(by_sink.get(pointer) ?? []), issue]);
    }
    for (const [pointer, sink] of this.sinks) sink(by_sink.get(pointer) ?? []);
    return homeless;
  }
}

export interface Frame {
  element: HTMLElement;
  /** Updates the reset button for the current value. */
  now(value: unknown): void;
  /** Connects the label with a control that replaces the previous one. */
  no_control(): void;
}

/**
 * Adds label, help text, reset button and errors to a control. `control` receives the label and the errors for
 * assistive technology; `body` is the drawn element. A group of controls, such as a list, is labelled as a group.
 */
export function frame(spec: FieldSpec, control: HTMLElement, body: HTMLElement, redraw: Redraw): Frame {
  const { schema, board } = spec;
  const is_group = !(control instanceof HTMLInputElement || control instanceof HTMLSelectElement || control instanceof HTMLTextAreaElement);
  control.id ||= fresh_id('field');
  const label = el(is_group ? 'span' : 'label', { class: 'label', id: `${control.id}-label`, for: is_group ? undefined : control.id }, spec.label);
  const help = el('p', { class: 'help', id: `${control.id}-help`, hidden: true }, schema.description ?? '');
  const issue = el('p', { class: 'issue', id: `${control.id}-error`, hidden: true });

  const open_help = el('button', { type: 'button', class: 'quiet small', 'aria-label': `About ${spec.label}`, 'aria-expanded': 'false', title: schema.description, 'aria-controls': help.id }, icon('help'));
  open_help.addEventListener('click', () => {
    help.hidden = !help.hidden;
    open_help.setAttribute('aria-expanded', String(!help.hidden));
  });
  const reset = el('button', { type: 'button', class: 'quiet small reset', 'aria-label': `Reset ${spec.label}`, title: 'Reset', hidden: true }, icon('reset'));
  reset.addEventListener('click', () => {
    spec.value = structuredClone(spec.base);
    spec.change(spec.value);
    (spec.redraw ?? redraw)();
  });

  if (is_group) { control.setAttribute('role', 'group'); control.setAttribute('aria-labelledby', label.id); }
  control.setAttribute('aria-describedby', `${help.id} ${issue.id}`);
  const element = el('div', { class: 'field', 'data-pointer': spec.pointer },
    el('div', { class: 'field-head' }, label, schema.description ? open_help : null, reset), body, help, issue);

  board.add(spec.pointer, (issues) => {
    const is_invalid = issues.some((each) => !each.mild);
    element.classList.toggle('invalid', is_invalid);
    if (!is_group) control.setAttribute('aria-invalid', String(is_invalid));
    issue.classList.toggle('mild', !is_invalid);
    issue.hidden = issues.length === 0;
    issue.textContent = with_groups(issues.map((each) => each.message).join('\n'));
  });
  const now = (value: unknown): void => { reset.hidden = same(value, spec.base); };
  now(spec.value);
  const no_control = (): void => { label.removeAttribute('for'); };
  return { element, now, no_control };
}
