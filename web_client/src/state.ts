/** The one document of the page: a request, and what its fields go back to. All parts read and write it here. */
import type { Request } from './api';

/** edit: a field or the seed; open: another request as a whole, which the form has to be drawn anew for. */
export type Cause = 'open' | 'edit';

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

export class Store {
  private state: State | null = null;
  private readonly listeners: Listener[] = [];

  get current(): State | null {
    return this.state;
  }

  subscribe(listener: Listener): void {
    this.listeners.push(listener);
  }

  open(request: Request, from: { preset: string | null; title: string; description: string }): void {
    this.tell({ request, base: request, ...from }, 'open');
  }

  edit(change: Partial<Request>): void {
    if (this.state) this.tell({ ...this.state, request: { ...this.state.request, ...change } }, 'edit');
  }

  private tell(state: State, cause: Cause): void {
    this.state = state;
    for (const listener of this.listeners) listener(state, cause);
  }
}
