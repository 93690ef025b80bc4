/** Asks the server about a request beside the making of its model: warnings and faults come although the model is slow. */
import { Refusal, check, type Check, type Fault, type Request } from './api';

const debounce = 120;

export class Checker {
  private running = new AbortController();
  private timer = 0;
  private readonly tell: (faults: Fault[], check: Check | null, request: Request) => void;

  constructor(tell: (faults: Fault[], check: Check | null, request: Request) => void) {
    this.tell = tell;
  }

  /** The last request wins. A server that is full or gone is left alone: the model's own request tells about that. */
  ask(request: Request): void {
    clearTimeout(this.timer);
    this.running.abort();
    this.running = new AbortController();
    const { signal } = this.running;
    this.timer = window.setTimeout(() => {
      check(request, signal).then(
        (answer) => this.tell(answer.warnings, answer, request),
        (error: unknown) => { if (!signal.aborted) this.tell(error instanceof Refusal ? error.faults : [], null, request); });
    }, debounce);
  }
}

/** What both answers say is said once. */
export function joined(...lists: Fault[][]): Fault[] {
  const seen = new Set<string>();
  return lists.flat().filter((fault) => {
    const key = JSON.stringify([fault.pointer, fault.message, fault.line ?? 0, fault.column ?? 0]);
    return !seen.has(key) && seen.add(key);
  });
}
