/** A choice of a generated texture (x-widget: texture): the names, and pictures of them to click. */
import { el } from '../dom';
import { frame, type Draw } from './field';
import { redrawable } from './simple_fields';

/** Values without a texture of their own have no picture. */
const has_picture = (value: string): boolean => value !== 'none' && value !== 'auto';
const readable = (value: string): string => value.replaceAll('_', ' ');

export const texture_field: Draw = (spec) =>
  redrawable((redraw) => {
    const values = (spec.schema.enum ?? []).map(String);
    const value = String(spec.value ?? spec.schema.default ?? '');
    const select = el('select', {}, ...values.map((each) => el('option', { value: each, selected: each === value }, readable(each))));
    const buttons = values.filter(has_picture).map((each) => el('button', {
      type: 'button', class: 'texture', title: readable(each), 'aria-label': readable(each), 'aria-pressed': String(each === value), onclick: () => take(each),
    }, el('img', { src: `./textures/${each}.webp`, alt: '', width: 48, height: 48, loading: 'lazy' })));
    const pictures = el('details', { class: 'textures' }, el('summary', {}, 'Pictures'), el('div', { class: 'texture-grid', role: 'group', 'aria-label': `${spec.label}, pictures` }, ...buttons));
    const drawn = frame(spec, select, el('div', {}, select, pictures), redraw);
    const take = (next: string): void => {
      select.value = next;
      for (const button of buttons) button.setAttribute('aria-pressed', String(button.title === readable(next)));
      spec.change(next);
      drawn.now(next);
    };
    select.addEventListener('change', () => take(select.value));
    return drawn.element;
  });
