/**
 * The seed: typed, random, or chosen from earlier ones. Above 2^53 it is a string, because a JavaScript number is not
 * exact there.
 */
import { el, part } from './dom';

const largest = 2n ** 64n - 1n;
const most_kept = 12;

export type Seed = number | string;

/** Returns null if the text is not a valid seed. */
function seed_of(text: string): Seed | null {
  if (!/^\d{1,20}$/.test(text.trim())) return null;
  const seed = BigInt(text.trim());
  if (seed > largest) return null;
  return seed <= BigInt(Number.MAX_SAFE_INTEGER) ? Number(seed) : String(seed);
}

/** The seed plus `step`, wrapping to 0 above the largest seed. */
export const seed_after = (seed: Seed, step: number): Seed => seed_of(String((BigInt(seed_of(String(seed)) ?? 0) + BigInt(step)) % (largest + 1n))) ?? 0;

export interface SeedBox {
  show(seed: Seed): void;
  roll(): void;
  /** Puts the seed of a drawn model at the front of the history. */
  drawn(seed: Seed): void;
}

export function wire_seed(change: (seed: Seed) => void): SeedBox {
  const box = part<HTMLInputElement>('seed');
  const list = part('seed-list');
  const issue = part('seed-error');
  let before: Seed[] = [];
  let shown: Seed = 0;
  const mark_validity = (is_seed: boolean): void => {
    box.setAttribute('aria-invalid', String(!is_seed));
    issue.textContent = is_seed ? '' : `A seed is a whole number from 0 to ${largest.toLocaleString('en')}.`;
  };
  const show = (seed: Seed): void => {
    shown = seed;
    // A request from outside the form may have an invalid seed, which is reported with its other errors.
    box.setAttribute('aria-invalid', String(seed_of(String(seed)) === null));
    issue.textContent = '';
    box.title = String(seed);
    // Text that is being typed is not reformatted: 007 means 7.
    if (String(seed_of(box.value)) !== String(seed)) box.value = String(seed);
  };
  const roll = (): void => {
    const seed = crypto.getRandomValues(new Uint32Array(1))[0] ?? 0;
    show(seed);
    change(seed);
  };
  box.addEventListener('input', () => {
    const seed = seed_of(box.value);
    mark_validity(seed !== null);
    if (seed !== null) change(seed);
  });
  // Invalid text is replaced by the last valid seed when the input loses the focus.
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
