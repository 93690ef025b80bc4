/** The seed: typed, rolled, or taken from those before. Beyond 2^53 a JavaScript number is no longer exact, so it is text there. */
import { el, part } from './dom';

const largest = 2n ** 64n - 1n;
const most_kept = 12;

export type Seed = number | string;

/** null where the text is no seed. */
export function seed_of(text: string): Seed | null {
  if (!/^\d{1,20}$/.test(text.trim())) return null;
  const seed = BigInt(text.trim());
  if (seed > largest) return null;
  return seed <= BigInt(Number.MAX_SAFE_INTEGER) ? Number(seed) : String(seed);
}

/** The seed `step` further; past the largest it begins again at 0. */
export const seed_after = (seed: Seed, step: number): Seed => seed_of(String((BigInt(seed_of(String(seed)) ?? 0) + BigInt(step)) % (largest + 1n))) ?? 0;

export interface SeedBox {
  show(seed: Seed): void;
  roll(): void;
  /** A model of this seed was drawn: it goes to the front of the list. */
  drawn(seed: Seed): void;
}

export function wire_seed(change: (seed: Seed) => void): SeedBox {
  const box = part<HTMLInputElement>('seed');
  const list = part('seed-list');
  const fault = part('seed-fault');
  let before: Seed[] = [];
  let shown: Seed = 0;
  const judge = (is_seed: boolean): void => {
    box.setAttribute('aria-invalid', String(!is_seed));
    fault.textContent = is_seed ? '' : `A seed is a whole number from 0 to ${largest.toLocaleString('en')}.`;
  };
  const show = (seed: Seed): void => {
    shown = seed;
    // A request of another hand may have one that is none, and what is wrong with it is told with its other faults.
    box.setAttribute('aria-invalid', String(seed_of(String(seed)) === null));
    fault.textContent = '';
    box.title = String(seed);
    // What is being typed stays as it is: 007 is 7.
    if (String(seed_of(box.value)) !== String(seed)) box.value = String(seed);
  };
  const roll = (): void => {
    const seed = crypto.getRandomValues(new Uint32Array(1))[0] ?? 0;
    show(seed);
    change(seed);
  };
  box.addEventListener('input', () => {
    const seed = seed_of(box.value);
    judge(seed !== null);
    if (seed !== null) change(seed);
  });
  // What is no seed does not stay: the page shows and shares the one before.
  box.addEventListener('change', () => {
    if (seed_of(box.value) !== null) return;
    show(shown);
  });
  part('dice').addEventListener('click', roll);
  return {
    show, roll,
    drawn(seed) {
      before = [seed, ...before.filter((each) => each !== seed)].slice(0, most_kept);
      list.replaceChildren(...before.map((each) => el('li', {},
        el('button', { type: 'button', 'data-close': true, 'aria-current': String(each === seed), onclick: () => { show(each); change(each); } }, String(each)))));
    },
  };
}
