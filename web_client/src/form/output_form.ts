/** The form of the request's output: a folded group that is drawn when it is opened, or when a fault points into it. */
import type { Fault } from '../api';
import { el, with_groups } from '../dom';
import { is_output } from '../for_view';
import { Board } from './field';
import { member_fields } from './group_fields';
import type { Members, Schema } from './schema';

const pointer = '/output';

export interface OutputForm {
  element: HTMLElement;
  /** The request was written by another hand: what is drawn is drawn anew. */
  follow(schema: Schema, value: Members, base: Members): void;
  show_faults(faults: Fault[]): void;
  holds(fault: Fault): boolean;
}

/** `change` gets the whole new value; undefined takes it out of the request. */
export function output_form(change: (value: Members | undefined) => void): OutputForm {
  const place = el('div');
  const element = el('details', { class: 'group', 'data-pointer': pointer }, el('summary', {}, el('h3', {}, 'Output')), place);
  let schema: Schema = {};
  let value: Members = {}, base: Members = {};
  let board = new Board();
  let faults: Fault[] = [];
  let is_drawn = false;

  const draw = (): void => {
    if (is_drawn) return;
    is_drawn = true;
    board = new Board();
    const general = el('p', { class: 'fault', hidden: true });
    board.add(pointer, (own) => {
      general.hidden = own.length === 0;
      general.textContent = with_groups(own.map((each) => each.message).join('\n'));
    });
    const fields = member_fields({
      schema, pointer, label: '', value, base, board,
      change(next) { value = next as Members; change(Object.keys(value).length > 0 ? value : undefined); },
    });
    place.replaceChildren(
      el('p', { class: 'soft' }, 'What downloads, links and copied programs ask for. The picture shows what of it a browser can show.'),
      general, ...fields.map((field) => field.element));
    board.show(faults);
  };
  element.addEventListener('toggle', () => { if (element.open) draw(); });

  return {
    element,
    follow(...next) {
      [schema, value, base] = next;
      // Only what is in sight is worth drawing now.
      is_drawn = false;
      place.replaceChildren();
      if (element.open) draw();
    },
    show_faults(next) {
      faults = next.filter(is_output);
      if (faults.some((fault) => !fault.mild)) {
        element.open = true;
        draw();
      }
      if (is_drawn) board.show(faults);
    },
    holds: is_output,
  };
}
