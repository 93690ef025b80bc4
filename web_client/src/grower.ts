/** Live update: keeps the view consistent with the request, whatever the server's state. */
import { Busy, Gone, Heavy, Refusal, follow, generate, in_format, type Made, type Request } from './api';

export type Phase =
  | { kind: 'growing'; share: number | null }
  | { kind: 'ready' }
  | { kind: 'refused'; refusal: Refusal }
  | { kind: 'waiting'; reason: 'full' | 'gone'; until: number }
  | { kind: 'locked' }
  | { kind: 'stopped' };

/**
 * The first change after a pause is sent at once. During continuous changes, the request is sent after a pause this
 * long.
 */
const debounce = 150;
/**
 * Records a step from the change to its model in the browser's performance timeline. Only the last entry of each name
 * is kept.
 */
export function measured(name: string, start: number, end = performance.now()): void {
  performance.clearMeasures(`seedmesh-${name}`);
  performance.measure(`seedmesh-${name}`, { start, end });
}

/**
 * If the last model took longer, the next is generated with an event stream. This shows the progress but costs a
 * second request.
 */
const slow = 400;
const longest_wait = 30_000;
/**
 * A model with at least this many triangles is fetched only after confirmation, because it can make the browser lose
 * its WebGL context.
 */
export const heavy = 3_000_000;

/**
 * Retries `task` while the server is at capacity or unreachable, with growing pauses. `nudge` ends a pause. Refusals
 * and the reason of an aborted signal are thrown.
 */
export class Retrier {
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
  /** The time of the last change (performance.now). */
  private asked = -Infinity;
  /** Incremented with every start and cancellation, so that an outdated answer is recognised. */
  private turn = 0;
  /** The request whose large model the user has confirmed. */
  private permitted: Request | null = null;
  /** The last request that needed confirmation, and its number of triangles. */
  private asked_about: { request: Request; triangles: number } | null = null;
  private is_fetching = false;
  private readonly retrier = new Retrier();
  private readonly tell: (phase: Phase) => void;
  private readonly show: (made: Made, request: Request) => Promise<void>;
  private readonly permit: (triangles: number) => Promise<boolean>;

  /** `permit` asks the user whether to fetch a model with this number of triangles. */
  constructor(tell: (phase: Phase) => void, show: (made: Made, request: Request) => Promise<void>, permit: (triangles: number) => Promise<boolean>) {
    this.tell = tell;
    this.show = show;
    this.permit = permit;
  }

  /** A newer request replaces an older one, whose generation is also cancelled on the server. */
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

  /**
   * Reports the expected number of triangles of the running request. Above the limit, the user is asked before the
   * download.
   */
  expect(triangles: number): void {
    if (triangles >= heavy && this.is_fetching && this.permitted !== this.last) void this.question(triangles);
  }

  cancel(): void {
    this.abort();
    this.tell({ kind: 'stopped' });
  }

  /** Ends a pause, or restarts after a cancellation. */
  again(): void {
    if (this.running) this.retrier.nudge();
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
      const made = await this.retrier.persist(
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
    // The model is in the cache only because this page has just generated it, so it is not reported as cached.
    return took === null ? made : { ...made, statistics: { ...made.statistics, milliseconds: took, is_kept: false } };
  }
}
