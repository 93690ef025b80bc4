/**
 * A list of positions on the ground (x-widget: placement). A right click or a long press in the view adds one; with
 * "Plant by click" on, any click does. Entries are selected by a click on their marker or in the list, and can be
 * moved and removed. The first member of an entry with two numbers is its position, in metres east and south of the
 * centre.
 */
import { el, icon, rounded } from '../dom';
import { member_fields } from './group_fields';
import { frame, type Draw } from './field';
import { chosen_in, enter, mark, type Spot, type Way } from './planting';
import { fresh_value, is_members, pointer_to, type Members, type Schema } from './schema';
import { redrawable } from './simple_fields';

const is_pair = (schema: Schema): boolean => schema.type === 'array' && schema.minItems === 2 && schema.maxItems === 2;
/** The list shows at most this many entries and the selected one; the view shows the positions of the others. */
const most_rows = 200;
/** Leaves the focus where it is. */
const no_focus = ':not(*)';

function spot_of(entry: Members | undefined, where: string): Spot {
  const pair = entry?.[where];
  return Array.isArray(pair) ? [Number(pair[0]), Number(pair[1])] : [0, 0];
}

export const placement_field: Draw = (spec) => {
  // State that is kept when the list is redrawn.
  let chosen = -1;
  let way: Way = 'choose';
  return redrawable((redraw) => {
    const item = spec.schema.items ?? {};
    const title = item.title ?? 'FieldSpec';
    const where = Object.entries(item.properties ?? {}).find(([, member]) => is_pair(member))?.[0] ?? '';
    const given = spec.value ?? spec.schema.default;
    const entries: Members[] = Array.isArray(given) ? given.filter(is_members) : [];
    if (chosen >= entries.length) chosen = -1;
    const box = el('div', { class: 'list' });
    const drawn = frame(spec, box, box, redraw);
    spec.board.clear_below(spec.pointer);
    const tell = (): void => { spec.value = [...entries]; spec.change(spec.value); drawn.now(spec.value); };
    const done = (focus: string): void => { tell(); redraw(focus); };

    const show_chosen = (): void => {
      redraw(no_focus);
      const row = document.querySelector(`[data-pointer="${CSS.escape(spec.pointer)}"] .chosen`);
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
      tool('plant', 'Plant by click', 'A right click or a long press also plants', false),
      tool('move', 'Move by click', 'Moves the selected one to the position of the click', chosen < 0)));

    entries.forEach((entry, index) => {
      if (index >= most_rows && index !== chosen) return;
      const name = `${title} ${index + 1}`;
      const choose = el('button', { type: 'button', class: index === chosen ? 'chosen' : '', 'aria-pressed': String(index === chosen) },
        `${name}: ${spot_of(entry, where).map(rounded).join(', ')} m`);
      choose.addEventListener('click', () => { chosen = index === chosen ? -1 : index; chosen_in(spec.pointer); redraw('.chosen'); });
      choose.addEventListener('keydown', (event) => { if (event.key === 'Delete') remove(index, '.add'); });
      const take = el('button', { type: 'button', class: 'quiet small', 'aria-label': `Remove ${name}`, title: 'Remove', onclick: () => remove(index, '.add') }, icon('remove'));
      box.append(el('div', { class: 'row placed' }, choose, take));
      if (index !== chosen) return;
      box.append(el('div', { class: 'nest' }, ...member_fields({
        ...spec, schema: item, pointer: pointer_to(spec.pointer, index), label: name, value: entry,
        base: Array.isArray(spec.base) ? spec.base[index] : undefined,
        change(value) { entries[index] = value as Members; tell(); mark(); },
      }).map((member) => member.element)));
    });
    if (entries.length > most_rows) box.append(el('p', { class: 'soft' }, `${entries.length - most_rows} more are shown in the view only.`));
    box.append(el('button', { type: 'button', class: 'add', onclick() { chosen_in(spec.pointer); add(fresh_value(item) as Members); redraw('.chosen'); } },
      icon('add'), `Add ${title.toLowerCase()}`));

    // The view ignores lists that are not yet in the document.
    queueMicrotask(() => enter(spec.pointer, {
      box, way, chosen,
      positions: () => entries.map((entry) => spot_of(entry, where)),
      // A new entry copies the selected one.
      plant(spot) { add({ ...structuredClone(entries[chosen] ?? (fresh_value(item) as Members)), [where]: spot }); show_chosen(); },
      move(spot) { entries[chosen] = { ...entries[chosen], [where]: spot }; tell(); show_chosen(); },
      choose(index) { chosen = index; show_chosen(); },
      remove: () => remove(chosen, no_focus),
    }));
    return drawn.element;
  });
};
