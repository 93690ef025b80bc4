/** The seed: typed, or rolled. Beyond 2^53 a JavaScript number is no longer exact, so it is kept as text there. */
import { part } from './dom';

const largest = 2n ** 64n - 1n;

/** null where the text is no seed. */
export function seed_of(text: string): number | string | null {
  if (!/^\d{1,20}$/.test(text.trim())) return null;
  const seed = BigInt(text.trim());
  if (seed > largest) return null;
  return seed <= BigInt(Number.MAX_SAFE_INTEGER) ? Number(seed) : String(seed);
}

export function wire_seed(change: (seed: number | string) => void): { show(seed: number | string): void; roll(): void } {
  const box = part<HTMLInputElement>('seed');
  const show = (seed: number | string): void => {
    box.setAttribute('aria-invalid', 'false');
    // What is being typed stays as it is: 007 is 7.
    if (seed_of(box.value) !== seed) box.value = String(seed);
  };
  const roll = (): void => {
    const seed = crypto.getRandomValues(new Uint32Array(1))[0] ?? 0;
    show(seed);
    change(seed);
  };
  box.addEventListener('input', () => {
    const seed = seed_of(box.value);
    box.setAttribute('aria-invalid', String(seed === null));
    if (seed !== null) change(seed);
  });
  part('dice').addEventListener('click', roll);
  return { show, roll };
}
