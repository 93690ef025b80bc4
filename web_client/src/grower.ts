/** Live update: keeps the picture in step with the request, whatever the server does meanwhile. */
import { Busy, Gone, Heavy, Refusal, follow, generate, in_format, type Made, type Request } from './api';

export type Phase =
  | { kind: 'growing'; share: number | null }
  | { kind: 'ready' }
  | { kind: 'refused'; refusal: Refusal }
  | { kind: 'waiting'; reason: 'full' | 'gone'; until: number }
  | { kind: 'locked' }
  | { kind: 'stopped' };

/** The first change after a rest is asked for at once; while a hand moves on, the server is asked when it rests this long. */
const debounce = 150;
/** The parts of the way from a change to its model, in the browser's own list of times: the last of each. */
export function measured(name: string, start: number, end = performance.now()): void {
  performance.clearMeasures(`seedmesh-${name}`);
  performance.measure(`seedmesh-${name}`, { start, end });
}

/** A model that took longer is made under the event stream, which tells the progress at the cost of a second request. */
const slow = 400;
const longest_wait = 30_000;
/** A model of as many triangles is fetched only when asked for: it can cost a browser its picture. */
export const heavy = 3_000_000;

/**
 * Runs `task` until it gives something other than "full" or "gone", waiting longer each time. A nudge ends a wait.
 * Refusals and the signal's reason are thrown.
 */
export class Patience {
  private readonly wakes = new Set<() => void>();

  async persist<T>(task: () => Promise<T>, wait: (reason: 'full' | 'gone', until: number) => void, signal: AbortSignal): Promise<T> {
    for (let attempt = 0; ; attempt += 1) {
      try {
        return await task();
      } catch (error) {
        signal.throwIfAborted();
        if (!(error instanceof Busy) && !(error instanceof Gone)) throw error;
        const asked = error instanceof Busy ? (error.seconds ?? 0) * 1000 : 0;
        const backed_off = Math.min(1000 * 2 ** attempt, longest_wait) * (0.8 + 0.4 * Math.random());
        const pause = Math.max(asked, backed_off);
        wait(error instanceof Busy ? 'full' : 'gone', Date.now() + pause);
        await this.sleep(pause, signal);
      }
    }
  }

  nudge(): void {
    for (const wake of this.wakes) wake();
  }

  private sleep(milliseconds: number, signal: AbortSignal): Promise<void> {
    return new Promise((resolve, reject) => {
      const end = (settle: () => void): void => {
        clearTimeout(timer);
        signal.removeEventListener('abort', stop);
        this.wakes.delete(wake);
        settle();
      };
      const stop = (): void => end(() => reject(signal.reason));
      const wake = (): void => end(resolve);
      const timer = setTimeout(wake, milliseconds);
      signal.addEventListener('abort', stop, { once: true });
      this.wakes.add(wake);
    });
  }
}

export class Grower {
  private running: AbortController | null = null;
  private timer = 0;
  private last: Request | null = null;
  private last_took = 0;
  /** When the last change was made, on the clock of the page. */
  private asked = -Infinity;
  /** Counts what was begun or given up, so that a late answer to a question is known as such. */
  private turn = 0;
  /** The request whose model may be as large as it is. */
  private permitted: Request | null = null;
  /** What was asked about the last model that is so large. */
  private asked_about: { request: Request; triangles: number } | null = null;
  private is_fetching = false;
  private readonly patience = new Patience();
  private readonly tell: (phase: Phase) => void;
  private readonly show: (made: Made, request: Request) => Promise<void>;
  private readonly permit: (triangles: number) => Promise<boolean>;

  /** `permit` asks whether a model of so many triangles is wanted. */
  constructor(tell: (phase: Phase) => void, show: (made: Made, request: Request) => Promise<void>, permit: (triangles: number) => Promise<boolean>) {
    this.tell = tell;
    this.show = show;
    this.permit = permit;
  }

  /** The last request wins: what runs for an earlier one is broken off, in the server too. */
  ask(request: Request, when: 'now' | 'soon'): void {
    const now = performance.now();
    const rested = now - this.asked > debounce;
    this.asked = now;
    this.last = request;
    this.abort();
    this.tell({ kind: 'growing', share: null });
    this.timer = window.setTimeout(() => void this.run(request), when === 'now' || rested ? 0 : debounce);
  }

  get is_running(): boolean { return this.running !== null; }

  /** What is being made is known to have so many triangles: where these are many, it is asked for before it is fetched. */
  expect(triangles: number): void {
    if (triangles >= heavy && this.is_fetching && this.permitted !== this.last) void this.question(triangles);
  }

  cancel(): void {
    this.abort();
    this.tell({ kind: 'stopped' });
  }

  /** Ends a wait, or starts over after a cancel. */
  again(): void {
    if (this.running) this.patience.nudge();
    else if (this.last && this.last === this.asked_about?.request && this.last !== this.permitted) void this.question(this.asked_about.triangles);
    else if (this.last) this.ask(this.last, 'now');
  }

  private abort(): void {
    clearTimeout(this.timer);
    this.running?.abort();
    this.running = null;
    this.is_fetching = false;
    this.turn += 1;
  }

  private async question(triangles: number): Promise<void> {
    const request = this.last;
    this.asked_about = request && { request, triangles };
    this.abort();
    const { turn } = this;
    const is_wanted = await this.permit(triangles);
    if (turn !== this.turn || !request) return;
    if (!is_wanted) {
      this.tell({ kind: 'stopped' });
      return;
    }
    this.permitted = request;
    void this.run(request);
  }

  private async run(request: Request): Promise<void> {
    const controller = new AbortController();
    const { signal } = controller;
    this.running = controller;
    this.is_fetching = true;
    const { asked } = this;
    const sent = performance.now();
    try {
      const made = await this.patience.persist(
        () => this.fetch(in_format(request, 'glb'), signal),
        (reason, until) => this.tell({ kind: 'waiting', reason, until }),
        signal,
      );
      this.is_fetching = false;
      measured('wait', asked, sent);
      measured('answer', sent);
      await this.show(made, request);
      measured('all', asked);
      signal.throwIfAborted();
      this.tell({ kind: 'ready' });
    } catch (error) {
      if (signal.aborted) return;
      if (error instanceof Heavy) {
        void this.question(error.triangles);
        return;
      }
      this.tell({ kind: 'refused', refusal: error instanceof Refusal ? error : new Refusal({ detail: String(error) }) });
    } finally {
      if (this.running === controller) this.running = null;
    }
  }

  private async fetch(request: Request, signal: AbortSignal): Promise<Made> {
    const begin = performance.now();
    this.tell({ kind: 'growing', share: null });
    const took = this.last_took > slow ? await follow(request, (share) => this.tell({ kind: 'growing', share }), signal) : null;
    const made = await generate(request, signal, this.permitted === this.last ? Infinity : heavy);
    this.last_took = performance.now() - begin;
    // What was followed lies in the server's cache because it was made for this page just now.
    return took === null ? made : { ...made, statistics: { ...made.statistics, milliseconds: took, is_kept: false } };
  }
}
