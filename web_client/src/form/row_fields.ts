/** Fields with several small values in a row: vectors and matrices, colours, images, and nested requests. */
import { get_presets } from '../api';
import { el, icon } from '../dom';
import { when_seen } from '../editor/load';
import { frame, type Draw } from './field';
import { member_fields } from './group_fields';
import { is_members, type Members } from './schema';
import { redrawable } from './simple_fields';

const axes = ['x', 'y', 'z'];

/**
 * A fixed number of numbers, each with its unit. Three are labelled by axis; nine and twelve are laid out as a
 * matrix.
 */
export const vector_field: Draw = (spec) =>
  redrawable((redraw) => {
    const count = spec.schema.minItems ?? 0;
    const given = spec.value ?? spec.schema.default;
    const numbers: number[] = Array.from({ length: count }, (_, index) => Number(Array.isArray(given) ? given[index] ?? 0 : 0));
    const step = spec.schema['x-step'] ?? spec.schema.items?.['x-step'] ?? 'any';
    const box = el('div', { class: `vector across-${count % 4 === 0 && count > 4 ? 4 : count > 4 ? 3 : count}` });
    const drawn = frame(spec, box, box, redraw);
    const shown = given !== undefined;
    const unit = spec.schema['x-unit'] ?? spec.schema.items?.['x-unit'];
    numbers.forEach((number, index) => {
      const axis = count === 3 ? axes[index] : undefined;
      const name = axis ?? String(index + 1);
      const input = el('input', { type: 'number', step, value: shown ? number : '', inputmode: 'decimal', 'aria-label': `${spec.label}, ${name}` });
      input.addEventListener('input', () => {
        if (Number.isNaN(input.valueAsNumber)) return;
        numbers[index] = input.valueAsNumber;
        spec.value = [...numbers];
        spec.change(spec.value);
        drawn.now(spec.value);
      });
      box.append(el('span', { class: axis ? 'box with-axis' : 'box' }, axis && el('span', { class: 'axis', 'aria-hidden': 'true' }, axis), input, unit && el('span', { class: 'unit' }, unit)));
    });
    return drawn.element;
  });

/** Colours in a row, each as a colour input. */
export const colors_field: Draw = (spec) =>
  redrawable((redraw) => {
    const given = spec.value ?? spec.schema.default;
    const colors: string[] = Array.isArray(given) ? given.map(String) : [];
    const box = el('div', { class: 'colors' });
    const drawn = frame(spec, box, box, redraw);
    const tell = (): void => { spec.value = [...colors]; spec.change(spec.value); drawn.now(spec.value); };
    colors.forEach((color, index) => {
      const name = `${spec.label} ${index + 1}`;
      const well = el('input', { type: 'color', value: color, 'aria-label': name });
      well.addEventListener('input', () => { colors[index] = well.value; tell(); });
      const remove = el('button', { type: 'button', class: 'quiet small', 'aria-label': `Remove ${name}`, title: 'Remove' }, icon('remove'));
      remove.addEventListener('click', () => { colors.splice(index, 1); tell(); redraw('.add'); });
      box.append(el('span', { class: 'one-color' }, well, colors.length > (spec.schema.minItems ?? 0) ? remove : null));
    });
    const add = el('button', { type: 'button', class: 'add' }, icon('add'), 'Add colour');
    add.addEventListener('click', () => { colors.push(colors.at(-1) ?? '#808080'); tell(); redraw('.add'); });
    box.append(add);
    return drawn.element;
  });

const pictures = { accept: 'image/png,image/jpeg', type: /^image\/(png|jpeg)$/, names: 'PNG or JPEG' };
const elevations = { accept: 'image/png,image/jpeg,image/webp,image/tiff,.tif,.tiff,.hgt', type: /^image\/(png|jpeg|webp|tiff)$/, names: 'PNG, JPEG, WebP, TIFF or .hgt file' };

/** Larger images make the request too long for a link. */
const largest_picture = 12e6;

/** Reads a file as a data URI. */
const data_uri = (file: Blob): Promise<string> => new Promise((resolve, reject) => {
  const reader = new FileReader();
  reader.onload = () => resolve(String(reader.result));
  reader.onerror = () => reject(reader.error ?? new Error('The file cannot be read.'));
  reader.readAsDataURL(file);
});

/** An image as a data URI: chosen, dropped or pasted, with a thumbnail. */
export const image_field: Draw = (spec) =>
  redrawable((redraw) => {
    const value = typeof spec.value === 'string' ? spec.value : '';
    const source = value === '' ? '' : value.startsWith('data:') ? value : `data:image/png;base64,${value}`;
    const { accept, type, names } = spec.schema['x-widget'] === 'heights' ? elevations : pictures;
    const choose = el('input', { type: 'file', accept, class: 'unseen', tabindex: -1, 'aria-hidden': 'true' });
    const open = el('button', { type: 'button' }, value ? 'Other image' : 'Choose an image');
    const note = el('span', { class: 'soft' }, value ? `${Math.round(value.length * 0.75 / 1024)} KB` : 'or drop it here');
    const remove = value ? el('button', { type: 'button', class: 'quiet small', 'aria-label': `Remove ${spec.label}`, title: 'Remove' }, icon('remove')) : null;
    const area = el('div', { class: 'picture-drop' }, source ? el('img', { src: source, alt: `${spec.label} as it is now`, onerror: (event: Event) => (event.target as HTMLElement).remove() }) : null, open, note, remove, choose);
    const drawn = frame(spec, area, area, redraw);
    const take = async (file: File | undefined): Promise<void> => {
      if (!file) return;
      if (!type.test(file.type) && !(type === elevations.type && /\.(tiff?|hgt)$/i.test(file.name))) { note.textContent = `${file.name} is no ${names}`; return; }
      if (file.size > largest_picture) { note.textContent = `${file.name} is larger than 12 MB`; return; }
      spec.value = await data_uri(file);
      spec.change(spec.value);
      redraw('button');
    };
    open.addEventListener('click', () => choose.click());
    choose.addEventListener('change', () => void take(choose.files?.[0]));
    remove?.addEventListener('click', () => { spec.value = undefined; spec.change(undefined); redraw('button'); });
    // Drops and pastes next to the dashed box are accepted too.
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

/** A nested request: a preset with its thumbnail, or all members. */
export const request_field: Draw = (spec) =>
  redrawable((redraw) => {
    const given: Members = is_members(spec.value) ? spec.value : {};
    const name = typeof given['preset'] === 'string' ? given['preset'] : '';
    const choose = el('select', { 'aria-label': `Preset of ${spec.label}` }, el('option', { value: name }, name || 'No preset'));
    const picture = name ? el('img', { src: `./thumbnails/${name}.webp`, alt: '', width: 96, height: 72, loading: 'lazy' }) : null;
    const box = el('div', { class: 'nest' });
    const drawn = frame(spec, box, box, redraw);
    spec.board.clear_below(spec.pointer);
    choose.addEventListener('change', () => {
      const { preset: _, ...rest } = given;
      spec.value = choose.value ? { preset: choose.value, ...('seed' in rest ? { seed: rest['seed'] } : {}) } : rest;
      spec.change(spec.value);
      redraw('select');
    });
    when_seen(choose, () => void get_presets().then((presets) => {
      const groups = Map.groupBy(presets, (preset) => preset.generator);
      choose.replaceChildren(el('option', { value: '', selected: name === '' }, 'No preset'), ...[...groups].map(([generator, of_it]) =>
        el('optgroup', { label: generator }, ...of_it.map((preset) => el('option', { value: preset.name, selected: preset.name === name }, preset.title)))));
    }, () => { /* Without the list of presets, the current name is the only choice. */ }));
    const inner = { ...spec, change(value: unknown) { spec.value = value; spec.change(value); drawn.now(value); } };
    box.append(el('div', { class: 'child' }, picture, choose),
      el('details', { class: 'more' }, el('summary', {}, 'Everything'), ...member_fields(inner).map((member) => member.element)));
    return drawn.element;
  });
