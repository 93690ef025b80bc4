/** Many buttons as one stop of the Tab key: the arrow keys, Home and End go from one to the other. */

/** The button that a key leads to, by its place in the list; -1 is out at the top; undefined where the key means nothing. */
export type Leads = (buttons: HTMLElement[], at: number, key: string) => number | undefined;

export interface Roving {
  /** The buttons that are there have changed, or `chosen` is to be the one stop. */
  settle(chosen?: HTMLElement): void;
}

/** In reading order. */
export const in_a_row: Leads = ({ length }, at, key) => {
  if (key === 'Home') return 0;
  if (key === 'End') return length - 1;
  if (key === 'ArrowRight' || key === 'ArrowDown') return Math.min(at + 1, length - 1);
  if (key === 'ArrowLeft' || key === 'ArrowUp') return Math.max(at - 1, 0);
  return undefined;
};

/** By where they stand: rows are what stands at one height. */
export const neighbour: Leads = (cards, at, key) => {
  if (key !== 'ArrowDown' && key !== 'ArrowUp') return in_a_row(cards, at, key);
  const here = cards[at]!.getBoundingClientRect();
  const down = key === 'ArrowDown';
  let found: number | undefined, nearest = Infinity;
  cards.forEach((card, index) => {
    const there = card.getBoundingClientRect();
    const ahead = down ? there.top - here.bottom : here.top - there.bottom;
    if (ahead < -1) return;
    const distance = ahead * 1000 + Math.abs(there.left - here.left);
    if (distance < nearest) { nearest = distance; found = index; }
  });
  return found ?? (down ? at : -1);
};

/** `buttons` are those in sight; `out` is where the way up from the first row leads. */
export function roving(place: HTMLElement, buttons: () => HTMLElement[], leads: Leads = in_a_row, out = (): void => {}): Roving {
  let stop: HTMLElement | undefined;
  const settle = (chosen = stop): void => {
    const all = buttons();
    if (stop) stop.tabIndex = -1;
    stop = chosen && all.includes(chosen) ? chosen : all[0];
    for (const button of all) button.tabIndex = button === stop ? 0 : -1;
  };
  place.addEventListener('focusin', (event) => {
    const button = event.target as HTMLElement;
    if (button !== stop && buttons().includes(button)) settle(button);
  });
  place.addEventListener('keydown', (event) => {
    const all = buttons();
    const at = all.indexOf(event.target as HTMLElement);
    const next = at < 0 ? undefined : leads(all, at, event.key);
    if (next === undefined) return;
    event.preventDefault();
    if (next < 0) out();
    else all[next]?.focus();
  });
  return { settle };
}
