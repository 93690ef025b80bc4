/** The form of the request's output: a collapsed group, drawn when it is opened or when an error points into it. */
import type { Issue } from '../api';
import { el, with_groups } from '../dom';
import { is_output } from '../for_view';
import { Board } from './field';
import { draw_field } from './fields';
import { member_fields } from './group_fields';
import type { Members, Schema } from './schema';

const pointer = '/output';

export interface OutputForm {
  element: HTMLElement;
  /** The request was changed outside this form, so the form is redrawn. */
  follow(schema: Schema, value: Members, base: Members): void;
  show_issues(issues: Issue[]): void;
  holds(issue: Issue): boolean;
}

/** `change` receives the whole new value; undefined removes the output from the request. */
export function output_form(change: (value: Members | undefined) => void): OutputForm {
  const body = el('div');
  const element = el('details', { class: 'group', 'data-pointer': pointer }, el('summary', {}, el('h3', {}, 'Output')), body);
  let schema: Schema = {};
  let value: Members = {}, base: Members = {};
  let board = new Board(draw_field);
  let issues: Issue[] = [];
  let is_drawn = false;

  const draw = (): void => {
    if (is_drawn) return;
    is_drawn = true;
    board = new Board(draw_field);
    const general = el('p', { class: 'issue', hidden: true });
    board.add(pointer, (own) => {
      general.hidden = own.length === 0;
      general.textContent = with_groups(own.map((each) => each.message).join('\n'));
    });
    const fields = member_fields({
      schema, pointer, label: '', value, base, board,
      change(next) { value = next as Members; change(Object.keys(value).length > 0 ? value : undefined); },
    });
    body.replaceChildren(
      el('p', { class: 'soft' }, 'Settings of downloads, links and copied programs. The view shows them as far as a browser can.'),
      general, ...fields.map((field) => field.element));
    board.show(issues);
  };
  element.addEventListener('toggle', () => { if (element.open) draw(); });

  return {
    element,
    follow(...next) {
      [schema, value, base] = next;
      // A collapsed form is not drawn.
      is_drawn = false;
      body.replaceChildren();
      if (element.open) draw();
    },
    show_issues(next) {
      issues = next.filter(is_output);
      if (issues.some((issue) => !issue.mild)) {
        element.open = true;
        draw();
      }
      if (is_drawn) board.show(issues);
    },
    holds: is_output,
  };
}
