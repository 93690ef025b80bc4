/**
 * A list of places on the ground (x-widget: placement): planted by a right click in the picture or, with "Plant" on, by
 * a tap; chosen by a click on a mark or in the list; moved, and taken away. The first member of an entry that is two
 * numbers is its place, east and south of the middle.
 */
import { el, icon, part, rounded } from '../dom';
import { member_fields } from './group_fields';
import { frame, type Draw } from './field';
import { fresh_value, is_members, pointer_to, type Members, type Schema } from './schema';
import { redrawable } from './simple_fields';

/** What the picture tells of a click that was no drag: where on the ground, and whether it asks for planting. */
export interface GroundClick { x: number; z: number; button: number; touch: boolean; reach: number }
/** What it is asked to mark. */
export interface GroundMarks { places: [number, number][]; chosen: number }

const is_pair = (schema: Schema): boolean => schema.type === 'array' && schema.minItems === 2 && schema.maxItems === 2;
const tenth = (value: number): number => Math.round(value * 100) / 100;

const is_on = (button: HTMLElement): boolean => button.getAttribute('aria-pressed') === 'true';

/** What a plain click in the picture does: plant, move the chosen one, or, with neither on, choose. */
function ways_to_click(is_one_chosen: boolean): { plant: HTMLElement; move: HTMLElement } {
  const plant = el('button', { type: 'button', 'aria-pressed': 'false', title: 'A right click plants at any time' }, 'Plant by click');
  const move = el('button', { type: 'button', 'aria-pressed': 'false', disabled: !is_one_chosen }, 'Move by click');
  for (const [button, other] of [[plant, move], [move, plant]] as const) {
    button.addEventListener('click', () => {
      button.setAttribute('aria-pressed', String(!is_on(button)));
      other.setAttribute('aria-pressed', 'false');
    });
  }
  return { plant, move };
}

export const placement_field: Draw = (place) => {
  let chosen = -1;
  return redrawable((redraw) => {
    const item = place.schema.items ?? {};
    const where = Object.entries(item.properties ?? {}).find(([, member]) => is_pair(member))?.[0] ?? '';
    const given = place.value ?? place.schema.default;
    const entries: Members[] = Array.isArray(given) ? given.filter(is_members) : [];
    const box = el('div', { class: 'list' });
    const drawn = frame(place, box, box, redraw);
    place.board.clear_below(place.pointer);
    const picture = part('picture');
    const at = (entry: Members | undefined): [number, number] => {
      const pair = entry?.[where];
      return Array.isArray(pair) ? [Number(pair[0]), Number(pair[1])] : [0, 0];
    };
    const mark = (): void => {
      const detail: GroundMarks = { places: entries.map(at), chosen };
      picture.dispatchEvent(new CustomEvent('mark-ground', { detail }));
    };
    const tell = (): void => { place.value = [...entries]; place.change(place.value); drawn.now(place.value); };
    const done = (focus: string): void => { tell(); redraw(focus); };

    const { plant, move } = ways_to_click(chosen >= 0);

    const clicked = (event: Event): void => {
      if (!box.isConnected) { picture.removeEventListener('ground-click', clicked); return; }
      const click = (event as CustomEvent<GroundClick>).detail;
      const spot = [tenth(click.x), tenth(click.z)];
      if (click.button === 2 || is_on(plant)) {
        // What is planted is like the one that is chosen.
        const like = entries[chosen] ?? (fresh_value(item) as Members);
        entries.push({ ...structuredClone(like), [where]: spot });
        chosen = entries.length - 1;
        done('.add');
      } else if (is_on(move) && entries[chosen]) {
        entries[chosen] = { ...entries[chosen], [where]: spot };
        done('.chosen');
      } else {
        const distances = entries.map((entry) => Math.hypot(at(entry)[0] - click.x, at(entry)[1] - click.z));
        const nearest = distances.indexOf(Math.min(...distances));
        chosen = (distances[nearest] ?? Infinity) <= click.reach ? nearest : -1;
        redraw('.chosen');
      }
    };
    picture.addEventListener('ground-click', clicked);
    queueMicrotask(mark);

    const remove = (index: number): void => {
      entries.splice(index, 1);
      chosen = -1;
      done('.add');
    };
    box.append(el('div', { class: 'row' }, plant, move));
    entries.forEach((entry, index) => {
      const name = `${item.title ?? 'Place'} ${index + 1}`;
      const choose = el('button', { type: 'button', class: index === chosen ? 'chosen' : '', 'aria-pressed': index === chosen },
        `${name}: ${at(entry).map(rounded).join(', ')} m`);
      choose.addEventListener('click', () => { chosen = index === chosen ? -1 : index; redraw('.chosen'); });
      choose.addEventListener('keydown', (event) => { if (event.key === 'Delete') remove(index); });
      const take = el('button', { type: 'button', class: 'quiet small', 'aria-label': `Remove ${name}`, title: 'Remove' }, icon('remove'));
      take.addEventListener('click', () => remove(index));
      box.append(el('div', { class: 'row placed' }, choose, take));
      if (index === chosen) {
        box.append(el('div', { class: 'nest' }, ...member_fields({
          ...place, schema: item, pointer: pointer_to(place.pointer, index), label: name, value: entry,
          base: Array.isArray(place.base) ? place.base[index] : undefined,
          change(value) { entries[index] = value as Members; tell(); mark(); },
        }).map((member) => member.element)));
      }
    });
    const add = el('button', { type: 'button', class: 'add' }, icon('add'), `Add ${(item.title ?? 'place').toLowerCase()}`);
    add.addEventListener('click', () => { entries.push(fresh_value(item) as Members); chosen = entries.length - 1; done('.chosen'); });
    box.append(add);
    return drawn.element;
  });
};
