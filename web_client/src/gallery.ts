/** The presets as cards with pictures, by generator, narrowed by words and tags. */
import type { Preset } from './api';
import { el } from './dom';

export interface Gallery {
  /** Marks the card of the preset that is open; null for none. */
  mark(name: string | null): void;
  /** Puts the cursor into the search box. */
  search(): void;
}

const readable = (name: string): string => name.replaceAll('_', ' ').replace(/^./, (first) => first.toUpperCase());

export function draw_gallery(place: HTMLElement, presets: Preset[], choose: (preset: Preset) => void): Gallery {
  const counts = new Map<string, number>();
  for (const tag of presets.flatMap((preset) => preset.tags)) counts.set(tag, (counts.get(tag) ?? 0) + 1);
  const tags = [...counts].filter(([, count]) => count > 1).sort((a, b) => b[1] - a[1] || (a[0] < b[0] ? -1 : 1)).map(([tag]) => tag);

  const search = el('input', { type: 'search', placeholder: 'Search', 'aria-label': 'Search the gallery', 'aria-keyshortcuts': '/', autocomplete: 'off' });
  const chips = tags.map((tag) => el('button', { type: 'button', class: 'chip', 'aria-pressed': 'false' }, tag));
  const count = el('p', { class: 'unseen', role: 'status' });
  const none = el('p', { class: 'soft', hidden: true }, 'Nothing here has these words and tags.');
  const cards = presets.map((preset) => ({ preset, element: card(preset, () => choose(preset)) }));
  const groups = [...Map.groupBy(cards, (each) => each.preset.generator)].map(([generator, of_it]) => {
    const tally = el('span', { class: 'soft' });
    return { of_it, tally, element: el('section', { class: 'family', 'aria-label': readable(generator) },
      el('h2', { class: 'family-head' }, readable(generator), ' ', tally), el('div', { class: 'cards' }, ...of_it.map((each) => each.element))) };
  });

  const narrow = (): void => {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const wanted = tags.filter((_, index) => chips[index]?.getAttribute('aria-pressed') === 'true');
    let left = 0;
    for (const { of_it, tally, element: section } of groups) {
      let here = 0;
      for (const { preset, element } of of_it) {
        const text = `${preset.name} ${preset.title} ${preset.description} ${preset.tags.join(' ')} ${preset.generator}`.toLowerCase();
        const fits = words.every((word) => text.includes(word)) && wanted.every((tag) => preset.tags.includes(tag));
        element.hidden = !fits;
        if (fits) here += 1;
      }
      section.hidden = here === 0;
      tally.textContent = String(here);
      left += here;
    }
    none.hidden = left > 0;
    count.textContent = `${left} of ${cards.length} presets`;
  };
  search.addEventListener('input', narrow);
  for (const chip of chips) {
    chip.addEventListener('click', () => {
      chip.setAttribute('aria-pressed', String(chip.getAttribute('aria-pressed') !== 'true'));
      narrow();
    });
  }
  const visible = (): HTMLElement[] => groups.flatMap((group) => group.of_it).map((each) => each.element).filter((each) => !each.hidden);
  search.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowDown' && event.key !== 'Enter') return;
    event.preventDefault();
    visible()[0]?.focus();
  });
  place.addEventListener('keydown', (event) => {
    const at = visible().indexOf(event.target as HTMLElement);
    const next = at < 0 ? undefined : neighbour(visible(), at, event.key);
    if (next === undefined) return;
    event.preventDefault();
    if (next < 0) search.focus();
    else visible()[next]?.focus();
  });
  narrow();
  place.replaceChildren(
    el('div', { class: 'gallery-head' }, search, el('div', { class: 'chips', role: 'group', 'aria-label': 'Tags' }, ...chips), count),
    ...groups.map((group) => group.element), none,
  );
  return {
    mark(name) {
      for (const { preset, element } of cards) element.setAttribute('aria-pressed', String(preset.name === name));
    },
    search() { search.focus(); search.select(); },
  };
}

/** The card that an arrow leads to: rows are what stands at one height. -1 is above the first row. */
function neighbour(cards: HTMLElement[], at: number, key: string): number | undefined {
  if (key === 'Home') return 0;
  if (key === 'End') return cards.length - 1;
  if (key === 'ArrowRight') return Math.min(at + 1, cards.length - 1);
  if (key === 'ArrowLeft') return Math.max(at - 1, 0);
  if (key !== 'ArrowDown' && key !== 'ArrowUp') return undefined;
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
}

function card(preset: Preset, choose: () => void): HTMLElement {
  const picture = el('img', { src: `./thumbnails/${preset.name}.webp`, alt: '', width: 192, height: 144, loading: 'lazy', decoding: 'async' });
  // A server that is gone comes back.
  let wait = 5000;
  picture.addEventListener('load', () => picture.classList.remove('missing'));
  picture.addEventListener('error', () => {
    picture.classList.add('missing');
    setTimeout(() => { picture.src = picture.src; }, wait);
    wait = Math.min(wait * 2, 120_000);
  });
  return el('button', { type: 'button', class: 'card', 'aria-pressed': 'false', 'data-preset': preset.name, title: preset.description, onclick: choose },
    picture, el('span', {}, preset.title));
}
