/** The presets as cards with thumbnails, grouped by generator and filtered by words, generator and tags. */
import type { Generator, Preset } from './api';
import { el } from './dom';
import { neighbour, roving } from './roving';
import { matcher } from './word_search';

export interface Gallery {
  /** Marks the card of the open preset; null marks none. */
  mark(name: string | null): void;
  /** Moves the focus to the search box. */
  search(): void;
}

const chip = (text: string, attributes: Record<string, string> = {}): HTMLElement =>
  el('button', { type: 'button', class: 'chip', 'aria-pressed': 'false', ...attributes }, text);
const is_pressed = (button: HTMLElement): boolean => button.getAttribute('aria-pressed') === 'true';
const press = (button: HTMLElement, on: boolean): void => button.setAttribute('aria-pressed', String(on));

/** In the order of the generators. Presets of an unlisted generator come last. */
function families(presets: Preset[], generators: Generator[]): { title: string; of_it: Preset[] }[] {
  const by_name = Map.groupBy(presets, (preset) => preset.generator);
  const known = generators.filter(({ name }) => by_name.has(name));
  const others = [...by_name.keys()].filter((name) => !known.some((each) => each.name === name)).map((name) => ({ name, title: name }));
  return [...known, ...others].map(({ name, title }) => ({ title, of_it: by_name.get(name) ?? [] }));
}

/** Tags that more than one preset has, the most frequent first. */
function tags_of(presets: Preset[]): string[] {
  const counts = new Map<string, number>();
  for (const tag of presets.flatMap((preset) => preset.tags)) counts.set(tag, (counts.get(tag) ?? 0) + 1);
  return [...counts].filter(([, count]) => count > 1).sort((a, b) => b[1] - a[1] || (a[0] < b[0] ? -1 : 1)).map(([tag]) => tag);
}

export function draw_gallery(container: HTMLElement, presets: Preset[], generators: Generator[], choose: (preset: Preset) => void): Gallery {
  const search = el('input', { type: 'search', placeholder: 'Search', 'aria-label': 'Search the gallery', 'aria-keyshortcuts': '/', autocomplete: 'off' });
  const chips = tags_of(presets).map((tag) => ({ tag, button: chip(tag) }));
  const more_head = el('summary', {}, 'More tags');
  const more = el('details', { class: 'more more-tags' }, more_head,
    el('div', { class: 'chips', role: 'group', 'aria-label': 'Tags' }, ...chips.map(({ button }) => button)));
  const count = el('p', { class: 'unseen', role: 'status' });
  const none_text = el('p', { class: 'soft' });
  const none = el('div', { class: 'none', hidden: true }, none_text, el('button', { type: 'button', onclick: () => clear() }, 'Show all presets'));
  const groups = families(presets, generators).map(({ title, of_it }) => {
    const tally = el('span', { class: 'soft' });
    const cards = of_it.map((preset) => ({
      preset, element: card(preset, () => choose(preset)),
      fits: matcher(`${preset.name} ${preset.title} ${preset.description} ${preset.tags.join(' ')} ${preset.generator} ${title}`),
    }));
    return { cards, tally, button: chip(title), element: el('section', { class: 'family', 'aria-label': title },
      el('h2', { class: 'family-head' }, title, ' ', tally), el('div', { class: 'cards' }, ...cards.map((each) => each.element))) };
  });
  const cards = groups.flatMap((group) => group.cards);
  const visible = (): HTMLElement[] => cards.map((each) => each.element).filter((each) => !each.hidden);
  const one_card = roving(container, visible, neighbour, () => search.focus());

  const narrow = (): void => {
    const wanted = chips.filter(({ button }) => is_pressed(button)).map(({ tag }) => tag);
    const of_one = groups.some(({ button }) => is_pressed(button));
    let left = 0;
    for (const { cards: of_it, tally, button, element: section } of groups) {
      let here = 0;
      for (const { preset, element, fits } of of_it) {
        element.hidden = (of_one && !is_pressed(button)) || !wanted.every((tag) => preset.tags.includes(tag)) || !fits(search.value);
        if (!element.hidden) here += 1;
      }
      section.hidden = here === 0;
      tally.textContent = String(here);
      left += here;
    }
    none.hidden = left > 0;
    const chosen = [...groups.filter(({ button }) => is_pressed(button)).map(({ button }) => button.textContent), ...wanted];
    none_text.textContent = `No preset has ${[search.value.trim() && `the words “${search.value.trim()}”`, chosen.length > 0 && `the marks ${chosen.join(', ')}`].filter(Boolean).join(' and ')}.`;
    count.textContent = `${left} of ${cards.length} presets`;
    more_head.textContent = wanted.length > 0 ? `More tags: ${wanted.join(', ')}` : 'More tags';
    one_card.settle();
  };
  function clear(): void {
    search.value = '';
    for (const { button } of [...groups, ...chips]) press(button, false);
    narrow();
    search.focus();
  }

  search.addEventListener('input', () => {
    // A search opens all groups, so that its results are visible.
    if (search.value.trim()) more.open = false;
    narrow();
  });
  search.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowDown' && event.key !== 'Enter') return;
    event.preventDefault();
    visible()[0]?.focus();
  });
  for (const { button } of groups) {
    button.addEventListener('click', () => {
      const on = !is_pressed(button);
      for (const other of groups) press(other.button, on && other.button === button);
      narrow();
    });
  }
  for (const { button } of chips) button.addEventListener('click', () => { press(button, !is_pressed(button)); narrow(); });

  const kinds = el('div', { class: 'chips kinds', role: 'group', 'aria-label': 'Generators' }, ...groups.map(({ button }) => button));
  roving(kinds, () => groups.map(({ button }) => button)).settle();
  roving(more, () => chips.map(({ button }) => button)).settle();
  narrow();
  container.replaceChildren(el('div', { class: 'gallery-head' }, search, kinds, more, count), ...groups.map((group) => group.element), none);
  return {
    mark(name) {
      for (const { preset, element } of cards) {
        press(element, preset.name === name);
        if (preset.name === name) one_card.settle(element);
      }
    },
    search() { search.focus(); search.select(); },
  };
}

function card(preset: Preset, choose: () => void): HTMLElement {
  const picture = el('img', { src: `./thumbnails/${preset.name}.webp`, alt: '', width: 192, height: 144, loading: 'lazy', decoding: 'async' });
  // The server may be unreachable only for a short time, so the thumbnails are requested again.
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
