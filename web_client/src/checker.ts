/**
 * Validates the request in parallel with its generation, so that errors and warnings appear even if the model is
 * slow.
 */
import { Refusal, check, type Check, type Issue, type Request } from './api';

const debounce = 120;

export class Checker {
  private running = new AbortController();
  private timer = 0;
  private readonly tell: (issues: Issue[], check: Check | null, request: Request) => void;

  constructor(tell: (issues: Issue[], check: Check | null, request: Request) => void) {
    this.tell = tell;
  }

  /**
   * A newer request replaces an older one. If the server is busy or unreachable, the model request already reports
   * that.
   */
  ask(request: Request): void {
    clearTimeout(this.timer);
    this.running.abort();
    this.running = new AbortController();
    const { signal } = this.running;
    this.timer = window.setTimeout(() => {
      check(request, signal).then(
        (answer) => this.tell(answer.warnings, answer, request),
        (error: unknown) => { if (!signal.aborted) this.tell(error instanceof Refusal ? error.issues : [], null, request); });
    }, debounce);
  }
}

/** Removes duplicates of errors that both answers contain. */
export function joined(...lists: Issue[][]): Issue[] {
  const seen = new Set<string>();
  return lists.flat().filter((issue) => {
    const key = JSON.stringify([issue.pointer, issue.message, issue.line ?? 0, issue.column ?? 0]);
    return !seen.has(key) && seen.add(key);
  });
}
