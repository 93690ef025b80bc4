/**
 * The choice of a level of detail: fetched on demand, selected by number or by distance, and kept when the seed
 * changes.
 */
import { grouped, part } from './dom';
import type { Viewer } from './viewer/viewer';

interface Context {
  /** The select element and its options. */
  select: HTMLSelectElement;
  offer(options: [string, string][]): void;
  /** Fetches the zip with the levels of the shown model. It may contain fewer levels than requested. */
  levels(): Promise<ArrayBuffer>;
  fail(text: string): void;
  /** Called when levels are available for the first time. */
  came(): void;
}

export interface LevelChoice {
  choose(value: string): void;
  /** Called when another model is shown. */
  shown(triangles: number): void;
  /** Called when another request is opened, whose model is shown without levels. */
  forget(): void;
}

export function wire_levels(viewer: Viewer, { select, offer, levels, fail, came }: Context): LevelChoice {
  let made = 0;
  let counts: number[] | null = null;

  const label = (value: string): void => {
    const whole: [string, string] = ['', `As generated · ${grouped(made)}`];
    offer(counts
      ? [whole, ['auto', 'By distance'], ...counts.map((count, index): [string, string] => [String(index), `${index} · ${grouped(count)} triangles`])]
      : [whole, ['ask', 'Load coarser levels']]);
    select.value = value;
  };
  const show = (value: string): void => viewer.choose_level(value === '' ? null : value === 'auto' ? 'auto' : Number(value));

  async function fetch(wanted: string): Promise<void> {
    select.disabled = true;
    try {
      const found = await viewer.take_levels(await levels());
      // The model has changed during the download and loads its own levels.
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

/** Shows the number of drawn triangles out of those generated. */
export function show_triangles(viewer: Viewer): void {
  const output = part('triangles');
  const made = output.dataset['made'];
  if (made === undefined) return;
  const drawn = viewer.level_triangles;
  const text = drawn === null || drawn === Number(made) ? grouped(Number(made)) : `${grouped(drawn)} of ${grouped(Number(made))}`;
  if (output.textContent !== text) output.textContent = text;
}
