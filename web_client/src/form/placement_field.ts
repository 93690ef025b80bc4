/**
 * A list of places on the ground (x-widget: placement): planted by a right click or a long press in the picture or, with
 * "Plant by click" on, by any click; chosen by a click on a mark or in the list; moved, and taken away. The first member
 * of an entry that is two numbers is its place, east and south of the middle.
 */
import { el, icon, rounded } from '../dom';
import { member_fields } from './group_fields';
import { frame, type Draw } from './field';
import { chosen_in, enter, mark, type Spot, type Way } from './planting';
import { fresh_value, is_members, pointer_to, type Members, type Schema } from './schema';
import { redrawable } from './simple_fields';

const is_pair = (schema: Schema): boolean => schema.type === 'array' && schema.minItems === 2 && schema.maxItems === 2;
/** A list shows so many of its places, and the chosen one; the picture shows where the others are. */
const most_rows = 200;
/** Leaves the focus where it is. */
const no_focus = ':not(*)';

function spot_of(entry: Members | undefined, where: string): Spot {
  const pair = entry?.[where];
  return Array.isArray(pair) ? [Number(pair[0]), Number(pair[1])] : [0, 0];
}

export const placement_field: Draw = (place) => {
  // What outlives the drawing anew of the list.
  let chosen = -1;
  let way: Way = 'choose';
  return redrawable((redraw) => {
    const item = place.schema.items ?? {};
    const title = item.title ?? 'Place';
    const where = Object.entries(item.properties ?? {}).find(([, member]) => is_pair(member))?.[0] ?? '';
    const given = place.value ?? place.schema.default;
    const entries: Members[] = Array.isArray(given) ? given.filter(is_members) : [];
    if (chosen >= entries.length) chosen = -1;
    const box = el('div', { class: 'list' });
    const drawn = frame(place, box, box, redraw);
    place.board.clear_below(place.pointer);
    const tell = (): void => { place.value = [...entries]; place.change(place.value); drawn.now(place.value); };
    const done = (focus: string): void => { tell(); redraw(focus); };

    const show_chosen = (): void => {
      redraw(no_focus);
      const row = document.querySelector(`[data-pointer="${CSS.escape(place.pointer)}"] .chosen`);
      for (let up = row?.closest('details'); up; up = up.parentElement?.closest('details') ?? null) up.open = true;
      row?.scrollIntoView({ block: 'nearest' });
    };
    const remove = (index: number, focus: string): void => {
      entries.splice(index, 1);
      chosen = -1;
      if (way === 'move') way = 'choose';
      done(focus);
    };
    const add = (entry: Members): void => { entries.push(entry); chosen = entries.length - 1; tell(); };

    const tool = (own: Way, text: string, hint: string, is_off: boolean): HTMLElement =>
      el('button', { type: 'button', 'aria-pressed': String(way === own), title: hint, disabled: is_off, onclick() { way = way === own ? 'choose' : own; redraw(`[title="${hint}"]`); } }, text);
    box.append(el('div', { class: 'row' },
      tool('plant', 'Plant by click', 'A right click or a long press plants at any time', false),
      tool('move', 'Move by click', 'The chosen one goes to where you click', chosen < 0)));

    entries.forEach((entry, index) => {
      if (index >= most_rows && index !== chosen) return;
      const name = `${title} ${index + 1}`;
      const choose = el('button', { type: 'button', class: index === chosen ? 'chosen' : '', 'aria-pressed': String(index === chosen) },
        `${name}: ${spot_of(entry, where).map(rounded).join(', ')} m`);
      choose.addEventListener('click', () => { chosen = index === chosen ? -1 : index; chosen_in(place.pointer); redraw('.chosen'); });
      choose.addEventListener('keydown', (event) => { if (event.key === 'Delete') remove(index, '.add'); });
      const take = el('button', { type: 'button', class: 'quiet small', 'aria-label': `Remove ${name}`, title: 'Remove', onclick: () => remove(index, '.add') }, icon('remove'));
      box.append(el('div', { class: 'row placed' }, choose, take));
      if (index !== chosen) return;
      box.append(el('div', { class: 'nest' }, ...member_fields({
        ...place, schema: item, pointer: pointer_to(place.pointer, index), label: name, value: entry,
        base: Array.isArray(place.base) ? place.base[index] : undefined,
        change(value) { entries[index] = value as Members; tell(); mark(); },
      }).map((member) => member.element)));
    });
    if (entries.length > most_rows) box.append(el('p', { class: 'soft' }, `${entries.length - most_rows} more stand in the picture.`));
    box.append(el('button', { type: 'button', class: 'add', onclick() { chosen_in(place.pointer); add(fresh_value(item) as Members); redraw('.chosen'); } },
      icon('add'), `Add ${title.toLowerCase()}`));

    // After the list is in the page: what is not there is not known to the picture.
    queueMicrotask(() => enter(place.pointer, {
      box, way, chosen,
      places: () => entries.map((entry) => spot_of(entry, where)),
      // What is planted is like the one that is chosen.
      plant(spot) { add({ ...structuredClone(entries[chosen] ?? (fresh_value(item) as Members)), [where]: spot }); show_chosen(); },
      move(spot) { entries[chosen] = { ...entries[chosen], [where]: spot }; tell(); show_chosen(); },
      choose(index) { chosen = index; show_chosen(); },
      remove: () => remove(chosen, no_focus),
    }));
    return drawn.element;
  });
};
