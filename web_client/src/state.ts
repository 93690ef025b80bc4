/** The single state of the page: the request and the values that reset restores. All parts read and write it here. */
import type { Request } from './api';

/**
 * edit: a field or the seed changed. write: the whole request changed outside the form (JSON, undo), so that the form
 * is redrawn. open: another request was opened. return: undo or redo went back to another request.
 */
export type Cause = 'open' | 'edit' | 'write' | 'return';

export interface State {
  readonly request: Request;
  /** The request as it was opened, which reset restores. */
  readonly base: Request;
  /** The preset that the request was opened from; null for a link. */
  readonly preset: string | null;
  readonly title: string;
  readonly description: string;
}

type Listener = (state: State, cause: Cause) => void;

/** The number of undo steps. */
const most_steps = 50;
/** Edits within this time, in milliseconds, form one undo step, for example while a slider moves. */
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

  /** Replaces the whole request. The preset and the reset values are unchanged. */
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
