/** The presets as cards with pictures, narrowed by words and tags. */
import type { Preset } from './api';
import { el } from './dom';

export interface Gallery {
  /** Marks the card of the preset that is open; null for none. */
  mark(name: string | null): void;
}

export function draw_gallery(place: HTMLElement, presets: Preset[], choose: (preset: Preset) => void): Gallery {
  const counts = new Map<string, number>();
  for (const tag of presets.flatMap((preset) => preset.tags)) counts.set(tag, (counts.get(tag) ?? 0) + 1);
  const tags = [...counts].filter(([, count]) => count > 1).sort((a, b) => b[1] - a[1] || (a[0] < b[0] ? -1 : 1)).map(([tag]) => tag);

  const search = el('input', { type: 'search', placeholder: 'Search', 'aria-label': 'Search the gallery', autocomplete: 'off' });
  const chips = tags.map((tag) => el('button', { type: 'button', class: 'chip', 'aria-pressed': 'false' }, tag));
  const count = el('p', { class: 'unseen', role: 'status' });
  const none = el('p', { class: 'soft', hidden: true }, 'Nothing here has these words and tags.');
  const cards = presets.map((preset) => ({ preset, element: card(preset, () => choose(preset)) }));

  const narrow = (): void => {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const wanted = tags.filter((_, index) => chips[index]?.getAttribute('aria-pressed') === 'true');
    let left = 0;
    for (const { preset, element } of cards) {
      const text = `${preset.name} ${preset.title} ${preset.description} ${preset.tags.join(' ')}`.toLowerCase();
      const fits = words.every((word) => text.includes(word)) && wanted.every((tag) => preset.tags.includes(tag));
      element.hidden = !fits;
      if (fits) left += 1;
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
  place.replaceChildren(
    el('div', { class: 'gallery-head' }, search, el('div', { class: 'chips', role: 'group', 'aria-label': 'Tags' }, ...chips), count),
    el('div', { class: 'cards' }, ...cards.map((each) => each.element)), none,
  );
  return {
    mark(name) {
      for (const { preset, element } of cards) element.setAttribute('aria-pressed', String(preset.name === name));
    },
  };
}

function card(preset: Preset, choose: () => void): HTMLElement {
  const picture = el('img', { src: `./thumbnails/${preset.name}.webp`, alt: '', width: 192, height: 144, loading: 'lazy', decoding: 'async' });
  picture.addEventListener('error', () => picture.classList.add('missing'));
  return el('button', { type: 'button', class: 'card', 'aria-pressed': 'false', 'data-preset': preset.name, title: preset.description, onclick: choose },
    picture, el('span', {}, preset.title));
}
