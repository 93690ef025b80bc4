/** Lists the shapes of a derivation, draws their scopes as boxes over the model, and describes the selected one. */
import { el, grouped, rounded } from '../dom';
import { Board } from '../form/field';
import { draw_field } from '../form/fields';
import { is_members, same, type Members, type Schema } from '../form/schema';
import { edit_at, with_edit, type Edit, type ShapeChange } from './edits';
import type { Overlay } from './overlay';
import type { ScopeBox } from '../viewer/boxes';

export interface Shape { id: number; path?: string | null; parent?: number | null; symbol: string; parameters?: unknown; active?: boolean; rule?: string; line?: number; choice?: number; scope: ScopeBox }

export const is_shapes = (value: unknown): value is Shape[] =>
  Array.isArray(value) && value.length > 0 && value.every((each) => is_members(each) && 'symbol' in each && is_members(each['scope']));

/** The changes of single shapes in the request; null if its generator has none. */
export interface Edited {
  edits(): Edit[] | null;
  write(edits: Edit[]): void;
  /** The schema of the attributes of a change, and the rules that declare them. */
  attributes(): Schema | null;
  rules(): unknown;
}

/** The fields for the attributes of a shape. They stay while a value is typed and the list is drawn again. */
interface AttributeFields { path: string; element: HTMLElement; written: Members }

/** More boxes would hide the model and each other. */
const most = 20_000;

export class ShapeList {
  readonly element: HTMLElement;
  private readonly shapes: Shape[];
  private readonly overlay: Overlay | null;
  private readonly lead: ((line: number) => void) | null;
  private readonly edited: Edited;
  private readonly details = el('div', { class: 'picked', role: 'status' });
  private readonly symbols: string[];
  private readonly on = el('input', { type: 'checkbox', class: 'switch', id: 'show-shapes' });
  private readonly kind = el('select', { id: 'shape-kind' });
  private seen: Shape[] = [];
  private picked: Shape | undefined;
  private fields: AttributeFields | undefined;

  constructor(shapes: Shape[], overlay: Overlay | null, lead: ((line: number) => void) | null, edited: Edited) {
    this.shapes = shapes;
    this.edited = edited;
    this.overlay = overlay;
    this.lead = lead;
    const counts = new Map<string, number>();
    for (const shape of shapes) counts.set(shape.symbol, (counts.get(shape.symbol) ?? 0) + 1);
    this.symbols = [...counts.keys()];
    this.kind.append(el('option', { value: '' }, `Parts of the result (${grouped(shapes.filter((shape) => shape.active !== false).length)})`),
      el('option', { value: '*' }, `All shapes (${grouped(shapes.length)})`),
      ...[...counts].map(([symbol, count]) => el('option', { value: `=${symbol}` }, `${symbol} (${grouped(count)})`)));
    this.on.addEventListener('change', () => this.lay_over());
    this.kind.addEventListener('change', () => this.lay_over());
    this.element = el('section', { class: 'shapes' }, el('h3', {}, 'Shapes'),
      el('div', { class: 'row' }, el('label', { for: 'show-shapes' }, 'Boxes over the model'), this.on),
      el('div', { class: 'row' }, el('label', { for: 'shape-kind' }, 'Which'), this.kind),
      el('p', { class: 'soft' }, 'Show the boxes and click a part of the model for its details.'), this.details);
  }

  /** The selection in the previous list, kept when the request changes. */
  take_over(before: ShapeList): void {
    this.on.checked = before.on.checked;
    if ([...this.kind.options].some((option) => option.value === before.kind.value)) this.kind.value = before.kind.value;
    if (this.on.checked) this.lay_over();
    this.fields = before.fields;
    const path = before.picked?.path;
    const again = path ? this.shapes.find((each) => each.path === path) : undefined;
    if (again) this.describe(again);
  }

  lay_over(): void {
    const kind = this.kind.value;
    this.seen = this.shapes.filter((shape) => (kind === '' ? shape.active !== false : kind === '*' || `=${shape.symbol}` === kind)).slice(0, most);
    this.overlay?.set_boxes(this.on.checked ? this.seen.map((shape) => shape.scope) : null, (index) => this.symbols.indexOf(this.seen[index]?.symbol ?? ''));
    if (this.picked && this.on.checked) this.overlay?.mark_box(this.seen.indexOf(this.picked));
  }

  pick(index: number): void {
    this.describe(this.seen[index]);
  }

  private describe(shape: Shape | undefined): void {
    this.picked = shape;
    this.overlay?.mark_box(shape ? this.seen.indexOf(shape) : -1);
    if (!shape) { this.details.replaceChildren(); return; }
    const parents: string[] = [];
    for (let up = shape.parent; up !== null && up !== undefined && parents.length < 20; ) {
      const parent: Shape | undefined = this.shapes.find((each) => each.id === up);
      if (!parent) break;
      parents.unshift(parent.symbol);
      up = parent.parent;
    }
    const { lead } = this;
    const leading_to = (line: number): string | HTMLElement =>
      lead ? el('button', { type: 'button', onclick: () => lead(line) }, String(line)) : String(line);
    const row = (name: string, value: string | HTMLElement): HTMLElement => el('div', {}, el('dt', {}, name), el('dd', {}, value));
    const rule_rows = (words: string, from: Shape | undefined): HTMLElement[] => from?.rule === undefined ? [] : [
      row(words, from.choice === undefined ? from.rule : `${from.rule} (choice ${from.choice})`),
      ...(from.line === undefined ? [] : [row('Line', leading_to(from.line))]),
    ];
    this.details.replaceChildren(el('h4', {}, shape.symbol), el('dl', { class: 'figures' },
      row('Number', String(shape.id)),
      ...(parents.length > 0 ? [row('Made of', parents.join(' › '))] : []),
      ...rule_rows('Made by', this.shapes.find((each) => each.id === shape.parent)),
      ...rule_rows('Replaced by', shape),
      ...(shape.path ? [row('Path', shape.path)] : []),
      row('Size', shape.scope.size.map(rounded).join(' × ') + ' m'),
      row('Corner', shape.scope.origin.map(rounded).join(', ') + ' m'),
      ...(shape.parameters !== undefined && JSON.stringify(shape.parameters) !== '{}' && JSON.stringify(shape.parameters) !== '[]' ? [row('Parameters', JSON.stringify(shape.parameters))] : [])), ...(shape.path && this.edited.edits() ? [this.changes(shape.path, shape)] : []));
  }

  /** Buttons that change the selected shape alone. Only symbols whose rule has been used are offered. */
  private changes(path: string, shape: Shape): HTMLElement {
    const edits = (): Edit[] => this.edited.edits() ?? [];
    const change = (to: ShapeChange): void => this.edited.write(with_edit(edits(), path, to));
    const present = edit_at(edits(), path);
    const rules = [...new Set(this.shapes.filter((each) => each.rule !== undefined).map((each) => each.symbol))].filter((symbol) => symbol !== shape.symbol);
    const rule = el('select', { id: 'edit-rule' }, el('option', { value: '' }, 'its own'), ...rules.map((symbol) => el('option', { value: symbol, selected: symbol === present?.rule }, symbol)));
    rule.addEventListener('change', () => change({ rule: rule.value || undefined }));
    return el('div', { class: 'changes', role: 'group', 'aria-label': 'Change this shape' }, el('h4', {}, 'Change this shape'),
      el('div', { class: 'row' }, el('label', { for: 'edit-rule' }, 'Rule'), rule),
      ...(present?.remove ? [] : this.attributes(path, present?.attributes ?? {}, change)),
      el('div', { class: 'row' },
        el('button', { type: 'button', id: 'edit-remove', onclick: () => change({ remove: true }) }, 'Remove'),
        ...(present ? [el('button', { type: 'button', id: 'edit-undo', onclick: () => change(null) }, 'Undo the change')] : [])));
  }

  /** The attributes that the rules declare, as fields. Shapes that are made of this one inherit the values. */
  private attributes(path: string, given: Members, change: (to: ShapeChange) => void): HTMLElement[] {
    const schema = this.edited.attributes();
    if (!schema) return [];
    if (this.fields?.path === path && same(this.fields.written, given)) return [this.fields.element];
    const fields: AttributeFields = { path, written: given, element: el('div', { class: 'attributes' }) };
    fields.element.append(draw_field({
      schema, pointer: '/edit/attributes', label: schema.title ?? 'Attributes', value: given, base: {}, board: new Board(draw_field), grammar: () => this.edited.rules(),
      change(value) {
        fields.written = is_members(value) ? value : {};
        change({ attributes: fields.written });
      },
    }));
    this.fields = fields;
    return [fields.element];
  }
}
