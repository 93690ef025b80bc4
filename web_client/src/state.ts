/** The one document of the page: a request, and what its fields go back to. All parts read and write it here. */
import type { Request } from './api';

/**
 * edit: a field or the seed; write: the whole request by another hand than the form's (its JSON, undo), so that the form
 * is drawn anew; open: another request altogether; return: another one that was shown before, by undo or redo.
 */
export type Cause = 'open' | 'edit' | 'write' | 'return';

export interface State {
  readonly request: Request;
  /** What "reset" returns to: the request as it was opened. */
  readonly base: Request;
  /** The preset it was opened from; null for a link. */
  readonly preset: string | null;
  readonly title: string;
  readonly description: string;
}

type Listener = (state: State, cause: Cause) => void;

/** So many steps can be undone. */
const most_steps = 50;
/** Edits that follow each other this fast are one step: a slider in motion, a word being typed. */
const one_step = 700;

export class Store {
  private state: State | null = null;
  private readonly listeners: Listener[] = [];
  private past: State[] = [];
  private future: State[] = [];
  private last_edit = 0;

  get current(): State | null { return this.state; }
  get can_undo(): boolean { return this.past.length > 0; }
  get can_redo(): boolean { return this.future.length > 0; }

  subscribe(listener: Listener): void {
    this.listeners.push(listener);
  }

  open(request: Request, from: { preset: string | null; title: string; description: string }): void {
    this.remember();
    this.last_edit = 0;
    this.tell({ request, base: request, ...from }, 'open');
  }

  edit(change: Partial<Request>): void {
    this.change((request) => ({ ...request, ...change }), 'edit');
  }

  /** The whole request; the preset and what fields go back to stay. */
  write(request: Request): void {
    this.change(() => request, 'write');
  }

  undo(): void {
    this.step(this.past, this.future);
  }

  redo(): void {
    this.step(this.future, this.past);
  }

  private change(made: (request: Request) => Request, cause: Cause): void {
    if (!this.state) return;
    const now = Date.now();
    if (now - this.last_edit > one_step || this.future.length > 0) this.remember();
    this.last_edit = now;
    this.tell({ ...this.state, request: made(this.state.request) }, cause);
  }

  private remember(): void {
    if (!this.state) return;
    this.past = [...this.past, this.state].slice(-most_steps);
    this.future = [];
  }

  private step(from: State[], to: State[]): void {
    const next = from.pop();
    if (!next || !this.state) return;
    to.push(this.state);
    this.last_edit = 0;
    this.tell(next, next.base === this.state.base ? 'write' : 'return');
  }

  private tell(state: State, cause: Cause): void {
    this.state = state;
    for (const listener of this.listeners) listener(state, cause);
  }
}
