/**
 * Keeps the page address in step with the shown request. Every history entry of the browser holds a request in its
 * fragment.
 */
import type { Generator, Preset, Request } from './api';
import { fragment_of, longest_link, preset_in, unpack } from './link';
import type { State, Store } from './state';

interface Context {
  store: Store;
  presets(): Preset[];
  generators(): Generator[];
  get_preset(name: string, signal: AbortSignal): Promise<Request>;
  /** Starts to open another request and cancels an opening that is still in progress. */
  begin(): AbortSignal;
  persist<T>(task: () => Promise<T>, signal: AbortSignal): Promise<T>;
  /** The fragment does not hold a request. */
  damaged(): void;
}

/** The preset that a first visitor sees, if the server offers it. */
export const first_shown = 'kogovsek_grm';

export class Address {
  private drawn_for = '';
  private timer = 0;
  private readonly context: Context;

  constructor(context: Context) {
    this.context = context;
  }

  /** The address is updated after a short delay, because browsers limit how often a page may change it. */
  follow(state: State): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.write(state, 'replace'), 300);
  }

  /** True if the browser shows an address that this page did not write. */
  get is_foreign(): boolean { return location.hash !== this.drawn_for; }

  open(): Promise<void> {
    return location.hash.length > 1 ? this.open_link(location.hash) : this.open_first();
  }

  /** Choosing a card adds a history entry, so that Back returns to the previous model. */
  async choose(preset: Preset): Promise<void> {
    await this.open_preset(preset);
    await this.push(preset.name);
  }

  /** Adds a history entry for the current request. */
  async push(preset: string | null): Promise<void> {
    clearTimeout(this.timer);
    const { current } = this.context.store;
    if (current?.preset === preset) await this.write(current, 'push');
  }

  private async open_preset(preset: Preset): Promise<void> {
    const signal = this.context.begin();
    const request = await this.context.persist(() => this.context.get_preset(preset.name, signal), signal);
    this.context.store.open(request, { preset: preset.name, title: preset.title, description: preset.description });
  }

  private async open_first(): Promise<void> {
    this.drawn_for = '';
    const presets = this.context.presets();
    const first = presets.find((preset) => preset.name === first_shown) ?? presets[0];
    if (first) await this.open_preset(first);
  }

  private async open_link(fragment: string): Promise<void> {
    this.context.begin();
    this.drawn_for = fragment;
    try {
      const request = await unpack(fragment.slice(1));
      const name = preset_in(fragment);
      const from = this.context.presets().find((preset) => preset.name === name && preset.generator === request.generator);
      this.context.store.open(request, { preset: from?.name ?? null, title: from?.title ?? this.title_of(request), description: from?.description ?? '' });
    } catch {
      if (!this.context.store.current) await this.open_first();
      this.context.damaged();
    }
  }

  /** The preset and title of a request typed as JSON; null if its generator does not exist. */
  origin_of(request: Request, preset: string | null): { preset: string | null; title: string; description: string } | null {
    if (!this.context.generators().some(({ name }) => name === request.generator)) return null;
    const from = this.context.presets().find((each) => each.name === preset && each.generator === request.generator);
    return { preset: from?.name ?? null, title: from?.title ?? this.title_of(request, 'from JSON'), description: from?.description ?? '' };
  }

  /** A request without a preset is named after its generator and its first parameter that is a plain word. */
  private title_of({ generator, parameters }: Request, whence = 'from a link'): string {
    const title = this.context.generators().find(({ name }) => name === generator)?.title;
    if (title === undefined) return 'Unknown generator';
    const word = Object.values(parameters).find((value) => typeof value === 'string' && /^[a-z][a-z_]{3,23}$/.test(value));
    return word === undefined ? `${title} ${whence}` : `${title}, ${String(word).replaceAll('_', ' ')}`;
  }

  private async write(state: State, how: 'push' | 'replace'): Promise<void> {
    const packed = `#${await fragment_of(state.request, state.preset)}`;
    if (this.context.store.current !== state) return;
    // A request that is too long for an address is left out of it. The page reports this when the user copies the
    // link.
    this.drawn_for = packed.length <= longest_link ? packed : '';
    const address = this.drawn_for || location.pathname + location.search;
    if (how === 'push') history.pushState(null, '', address);
    else history.replaceState(null, '', address);
  }
}
