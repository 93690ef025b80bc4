/** Fields of several small values side by side: vectors and matrices, colours, pictures, and requests inside requests. */
import { get_presets } from '../api';
import { el, icon } from '../dom';
import { when_seen } from '../editor/load';
import { frame, type Draw } from './field';
import { member_fields } from './group_fields';
import { is_members, type Members } from './schema';
import { redrawable } from './simple_fields';

const axes = ['x', 'y', 'z'];

/** A fixed number of numbers, each with its unit. Three are named by their axes; nine and twelve stand in rows, as a matrix does. */
export const vector_field: Draw = (place) =>
  redrawable((redraw) => {
    const count = place.schema.minItems ?? 0;
    const given = place.value ?? place.schema.default;
    const numbers: number[] = Array.from({ length: count }, (_, index) => Number(Array.isArray(given) ? given[index] ?? 0 : 0));
    const step = place.schema['x-step'] ?? place.schema.items?.['x-step'] ?? 'any';
    const box = el('div', { class: `vector across-${count % 4 === 0 && count > 4 ? 4 : count > 4 ? 3 : count}` });
    const drawn = frame(place, box, box, redraw);
    const shown = given !== undefined;
    const unit = place.schema['x-unit'] ?? place.schema.items?.['x-unit'];
    numbers.forEach((number, index) => {
      const axis = count === 3 ? axes[index] : undefined;
      const name = axis ?? String(index + 1);
      const input = el('input', { type: 'number', step, value: shown ? number : '', inputmode: 'decimal', 'aria-label': `${place.label}, ${name}` });
      input.addEventListener('input', () => {
        if (Number.isNaN(input.valueAsNumber)) return;
        numbers[index] = input.valueAsNumber;
        place.value = [...numbers];
        place.change(place.value);
        drawn.now(place.value);
      });
      box.append(el('span', { class: axis ? 'box with-axis' : 'box' }, axis && el('span', { class: 'axis', 'aria-hidden': 'true' }, axis), input, unit && el('span', { class: 'unit' }, unit)));
    });
    return drawn.element;
  });

/** Colours in a row, each a well. */
export const colors_field: Draw = (place) =>
  redrawable((redraw) => {
    const given = place.value ?? place.schema.default;
    const colors: string[] = Array.isArray(given) ? given.map(String) : [];
    const box = el('div', { class: 'colors' });
    const drawn = frame(place, box, box, redraw);
    const tell = (): void => { place.value = [...colors]; place.change(place.value); drawn.now(place.value); };
    colors.forEach((color, index) => {
      const name = `${place.label} ${index + 1}`;
      const well = el('input', { type: 'color', value: color, 'aria-label': name });
      well.addEventListener('input', () => { colors[index] = well.value; tell(); });
      const remove = el('button', { type: 'button', class: 'quiet small', 'aria-label': `Remove ${name}`, title: 'Remove' }, icon('remove'));
      remove.addEventListener('click', () => { colors.splice(index, 1); tell(); redraw('.add'); });
      box.append(el('span', { class: 'one-color' }, well, colors.length > (place.schema.minItems ?? 0) ? remove : null));
    });
    const add = el('button', { type: 'button', class: 'add' }, icon('add'), 'Add colour');
    add.addEventListener('click', () => { colors.push(colors.at(-1) ?? '#808080'); tell(); redraw('.add'); });
    box.append(add);
    return drawn.element;
  });

/** Pictures beyond this make a request that no link can carry. */
const largest_picture = 12e6;

/** A file as a data URI. */
const data_uri = (file: Blob): Promise<string> => new Promise((resolve, reject) => {
  const reader = new FileReader();
  reader.onload = () => resolve(String(reader.result));
  reader.onerror = () => reject(reader.error ?? new Error('The file cannot be read.'));
  reader.readAsDataURL(file);
});

/** A picture as a data URI: chosen, dropped or pasted, with its thumbnail. */
export const image_field: Draw = (place) =>
  redrawable((redraw) => {
    const value = typeof place.value === 'string' ? place.value : '';
    const source = value === '' ? '' : value.startsWith('data:') ? value : `data:image/png;base64,${value}`;
    const choose = el('input', { type: 'file', accept: 'image/png,image/jpeg', class: 'unseen', tabindex: -1, 'aria-hidden': 'true' });
    const open = el('button', { type: 'button' }, value ? 'Other picture' : 'Choose a picture');
    const note = el('span', { class: 'soft' }, value ? `${Math.round(value.length * 0.75 / 1024)} KB` : 'or drop it here');
    const remove = value ? el('button', { type: 'button', class: 'quiet small', 'aria-label': `Remove ${place.label}`, title: 'Remove' }, icon('remove')) : null;
    const area = el('div', { class: 'picture-drop' }, source ? el('img', { src: source, alt: `${place.label} as it is now` }) : null, open, note, remove, choose);
    const drawn = frame(place, area, area, redraw);
    const take = async (file: File | undefined): Promise<void> => {
      if (!file) return;
      if (!/^image\/(png|jpeg)$/.test(file.type)) { note.textContent = `${file.name} is neither PNG nor JPEG`; return; }
      if (file.size > largest_picture) { note.textContent = `${file.name} is larger than 12 MB`; return; }
      place.value = await data_uri(file);
      place.change(place.value);
      redraw('button');
    };
    open.addEventListener('click', () => choose.click());
    choose.addEventListener('change', () => void take(choose.files?.[0]));
    remove?.addEventListener('click', () => { place.value = undefined; place.change(undefined); redraw('button'); });
    // A hand that misses the dashed box means it nevertheless.
    drawn.element.addEventListener('dragover', (event) => { event.preventDefault(); event.stopPropagation(); area.classList.add('over'); });
    drawn.element.addEventListener('dragleave', () => area.classList.remove('over'));
    drawn.element.addEventListener('drop', (event) => {
      event.preventDefault();
      event.stopPropagation();
      area.classList.remove('over');
      void take(event.dataTransfer?.files[0]);
    });
    return drawn.element;
  });

/** A request inside this one: a preset by its picture, or all of it member by member. */
export const request_field: Draw = (place) =>
  redrawable((redraw) => {
    const given: Members = is_members(place.value) ? place.value : {};
    const name = typeof given['preset'] === 'string' ? given['preset'] : '';
    const choose = el('select', { 'aria-label': `Preset of ${place.label}` }, el('option', { value: name }, name || 'No preset'));
    const picture = name ? el('img', { src: `./thumbnails/${name}.webp`, alt: '', width: 96, height: 72, loading: 'lazy' }) : null;
    const box = el('div', { class: 'nest' });
    const drawn = frame(place, box, box, redraw);
    place.board.clear_below(place.pointer);
    choose.addEventListener('change', () => {
      const { preset: _, ...rest } = given;
      place.value = choose.value ? { preset: choose.value, ...('seed' in rest ? { seed: rest['seed'] } : {}) } : rest;
      place.change(place.value);
      redraw('select');
    });
    when_seen(choose, () => void get_presets().then((presets) => {
      const groups = Map.groupBy(presets, (preset) => preset.generator);
      choose.replaceChildren(el('option', { value: '', selected: name === '' }, 'No preset'), ...[...groups].map(([generator, of_it]) =>
        el('optgroup', { label: generator }, ...of_it.map((preset) => el('option', { value: preset.name, selected: preset.name === name }, preset.title)))));
    }, () => { /* The name itself stays as the only choice. */ }));
    const inner = { ...place, change(value: unknown) { place.value = value; place.change(value); drawn.now(value); } };
    box.append(el('div', { class: 'child' }, picture, choose),
      el('details', { class: 'more' }, el('summary', {}, 'All of it'), ...member_fields(inner).map((member) => member.element)));
    return drawn.element;
  });
