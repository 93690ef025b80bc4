/** A roving tabindex: many buttons are one stop of the Tab key, and arrow keys, Home and End move between them. */

/** The index of the next button for a key; -1 leaves the group upwards; undefined if the key has no meaning here. */
export type Leads = (buttons: HTMLElement[], at: number, key: string) => number | undefined;

export interface Roving {
  /** Updates the tab stop after the buttons have changed, or makes `chosen` the tab stop. */
  settle(chosen?: HTMLElement): void;
}

/** Moves in document order. */
const in_a_row: Leads = ({ length }, at, key) => {
  if (key === 'Home') return 0;
  if (key === 'End') return length - 1;
  if (key === 'ArrowRight' || key === 'ArrowDown') return Math.min(at + 1, length - 1);
  if (key === 'ArrowLeft' || key === 'ArrowUp') return Math.max(at - 1, 0);
  return undefined;
};

/** Moves by screen position. Buttons at the same height form a row. */
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

/** `buttons` returns the visible buttons; `out` receives the focus above the first row. */
export function roving(container: HTMLElement, buttons: () => HTMLElement[], leads: Leads = in_a_row, out = (): void => {}): Roving {
  let stop: HTMLElement | undefined;
  const settle = (chosen = stop): void => {
    const all = buttons();
    if (stop) stop.tabIndex = -1;
    stop = chosen && all.includes(chosen) ? chosen : all[0];
    for (const button of all) button.tabIndex = button === stop ? 0 : -1;
  };
  container.addEventListener('focusin', (event) => {
    const button = event.target as HTMLElement;
    if (button !== stop && buttons().includes(button)) settle(button);
  });
  container.addEventListener('keydown', (event) => {
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
