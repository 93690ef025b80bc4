/** Levels of detail: fetched on demand, counted, chosen by number or by distance; the choice outlives another seed. */
import { grouped, part } from './dom';
import type { Viewer } from './viewer/viewer';

interface Context {
  /** The menu, and what it offers. */
  select: HTMLSelectElement;
  offer(options: [string, string][]): void;
  /** The zip with levels of detail of the model that is shown; fewer than asked for where it has no more. */
  levels(): Promise<ArrayBuffer>;
  fail(text: string): void;
  /** Levels have come for the first time. */
  came(): void;
}

export interface LevelChoice {
  choose(value: string): void;
  /** Another model is shown. */
  shown(triangles: number): void;
  /** Another request was opened: its model is shown as it is made. */
  forget(): void;
}

export function wire_levels(viewer: Viewer, { select, offer, levels, fail, came }: Context): LevelChoice {
  let made = 0;
  let counts: number[] | null = null;

  const label = (value: string): void => {
    const whole: [string, string] = ['', `As made · ${grouped(made)}`];
    offer(counts
      ? [whole, ['auto', 'By distance'], ...counts.map((count, index): [string, string] => [String(index), `${index} · ${grouped(count)} triangles`])]
      : [whole, ['ask', 'Fetch coarser levels']]);
    select.value = value;
  };
  const show = (value: string): void => viewer.choose_level(value === '' ? null : value === 'auto' ? 'auto' : Number(value));

  async function fetch(wanted: string): Promise<void> {
    select.disabled = true;
    try {
      const found = await viewer.take_levels(await levels());
      // Another model has come: it asks for its own.
      if (!found) return;
      const is_first = counts === null;
      counts = found;
      label(wanted === 'auto' ? wanted : String(Math.min(Number(wanted), found.length - 1)));
      show(select.value);
      if (is_first) came();
    } catch (error) {
      fail(`No levels: ${(error as Error).message}`);
      counts = null;
      label('');
    } finally {
      select.disabled = false;
    }
  }

  return {
    choose(value) {
      if (value === 'ask') { void fetch('auto'); return; }
      show(value);
      if (value === '') { counts = null; label(''); }
    },
    shown(triangles) {
      made = triangles;
      const wanted = counts ? select.value : '';
      label(wanted);
      if (wanted !== '') void fetch(wanted);
    },
    forget() {
      counts = null;
      label('');
    },
  };
}

/** The statistic of triangles: those that are drawn, of those that were made. */
export function tell_triangles(viewer: Viewer): void {
  const told = part('triangles');
  const made = told.dataset['made'];
  if (made === undefined) return;
  const drawn = viewer.level_triangles;
  const text = drawn === null || drawn === Number(made) ? grouped(Number(made)) : `${grouped(drawn)} of ${grouped(Number(made))}`;
  if (told.textContent !== text) told.textContent = text;
}
