/**
 * The attributes that the rules of a building declare with `attr`, each as a field: a number with the range of @Range,
 * a choice for @Enum, a colour for @Color, a switch for true and false. @Group, @Order, @Description and @Hidden are
 * followed. Attributes that the request sets and the rules do not declare stay in a list below.
 */
import { el } from '../dom';
import { frame, type Draw, type FieldSpec } from './field';
import { map_field, member_fields } from './group_fields';
import { is_members, type Members, type Schema } from './schema';
import { redrawable } from './simple_fields';

interface Note { name: string; given: string[]; named: Record<string, string> }
interface Declared { name: string; value: string; notes: Note[] }

export interface RuleAttribute { name: string; group: string; order: number; schema: Schema }

/** The text without comments; texts in quotes stay. `#` in a colour is inside quotes. */
const without_comments = (text: string): string =>
  text.replace(/"(?:\\.|[^"\\\n])*"|\/\*[\s\S]*?\*\/|\/\/[^\n]*|#[^\n]*/g, (found) => (found.startsWith('"') ? found : ' '));

/** The arguments between parentheses, at commas outside of quotes. */
const arguments_of = (text: string): string[] => (text.match(/(?:"(?:\\.|[^"\\])*"|[^,"])+/g) ?? []).map((each) => each.trim()).filter(Boolean);

const unquoted = (text: string): string => (text.startsWith('"') ? text.slice(1, -1).replace(/\\(.)/g, '$1') : text);

function note_of(name: string, inside: string): Note {
  const note: Note = { name: name.toLowerCase(), given: [], named: {} };
  for (const each of arguments_of(inside)) {
    const named = /^([A-Za-z_]\w*)\s*=\s*([\s\S]*)$/.exec(each);
    if (named?.[1]) note.named[named[1]] = unquoted(named[2] ?? '');
    else note.given.push(unquoted(each));
  }
  return note;
}

/** The declarations before the first style, which changes only values. */
function declared_in(text: string): Declared[] {
  const plain = without_comments(text).split(/^\s*(?:@\w+\s*(?:\([^)]*\)\s*)*)*style\s+[A-Za-z_]\w*\s*$/m)[0] ?? '';
  const out: Declared[] = [];
  const pattern = /((?:@\s*\w+\s*(?:\((?:"(?:\\.|[^"\\])*"|[^()"])*\))?\s*)*)\battr\s+([A-Za-z_]\w*)\s*=\s*("(?:\\.|[^"\\])*"|[^\n]*)/g;
  for (const [, notes = '', name = '', value = ''] of plain.matchAll(pattern)) {
    const read = [...notes.matchAll(/@\s*(\w+)\s*(?:\(((?:"(?:\\.|[^"\\])*"|[^()"])*)\))?/g)];
    out.push({ name, value: value.trim(), notes: read.map(([, called = '', inside = '']) => note_of(called, inside)) });
  }
  return out;
}

const finite = (text: string | undefined): number | undefined => {
  const number = Number(text);
  return text === undefined || text === '' || Number.isNaN(number) ? undefined : number;
};

/** The schema of one attribute, from its value and its annotations. Undefined for a value that has to be computed. */
function schema_of({ value, notes }: Declared): Schema {
  const find = (name: string): Note | undefined => notes.find((note) => note.name === name);
  const schema: Schema = { description: find('description')?.given.join(' ') };
  const number = finite(value);
  const choices = find('enum') ?? notes.find((note) => note.name === 'range' && note.given.some((each) => finite(each) === undefined));
  const range = find('range');
  if (choices) {
    const all: unknown[] = choices.given.map((each) => (number === undefined ? each : finite(each) ?? each));
    return { ...schema, enum: all, default: value.startsWith('"') ? unquoted(value) : number ?? all[0] };
  }
  if (value === 'true' || value === 'false') return { ...schema, type: 'boolean', default: value === 'true' };
  if (value.startsWith('"')) return { ...schema, type: 'string', 'x-widget': find('color') ? 'color' : undefined, default: unquoted(value) };
  const low = finite(range?.named.min ?? range?.given[0]), high = finite(range?.named.max ?? range?.given[1]);
  if (number === undefined && !range) return { ...schema, oneOf: [{ type: 'number' }, { type: 'string' }, { type: 'boolean' }] };
  const is_bound = range?.named.restricted !== 'false';
  return { ...schema, type: 'number', default: number, minimum: is_bound ? low : undefined, maximum: is_bound ? high : undefined,
    'x-step': finite(range?.named.stepsize ?? range?.given[2]), 'x-unit': find('distance') || find('length') ? 'm' : find('angle') ? '°' : undefined };
}

/** The attributes of rules that a form shows, in the order of their groups. */
function rule_attributes(text: string): RuleAttribute[] {
  const found = declared_in(text).filter(({ notes }) => !notes.some((note) => note.name === 'hidden' || note.name === 'private'));
  const places = new Map<string, number>();
  let group = '';
  return found.map((each, index) => {
    const own = each.notes.find((note) => note.name === 'group');
    if (own) {
      const place = finite(own.given.at(-1));
      group = own.given.filter((part) => finite(part) === undefined).join(' / ');
      if (place !== undefined) places.set(group, place);
    }
    const order = finite(each.notes.find((note) => note.name === 'order')?.given[0]) ?? 1e6;
    return { name: each.name, group, order, index, schema: schema_of(each) };
  }).sort((a, b) => (places.get(a.group) ?? -1) - (places.get(b.group) ?? -1) || a.order - b.order || a.index - b.index);
}

/** The text of the rules beside the field: a text, or the main one of several files. */
function rules_text(rules: unknown): string {
  if (typeof rules === 'string') return rules;
  if (!is_members(rules)) return '';
  const texts = Object.entries(rules).filter((entry): entry is [string, string] => typeof entry[1] === 'string');
  const is_main = ([name]: [string, string]): boolean => !texts.some(([other, text]) => other !== name && text.includes(name.split('/').at(-1) ?? name));
  return (texts.find(is_main) ?? texts[0])?.[1] ?? '';
}

/** The attributes as fields; undefined where the rules declare none. */
function declared_fields(spec: FieldSpec): HTMLElement | undefined {
  const declared = rule_attributes(rules_text(spec.grammar?.()));
  if (declared.length === 0) return undefined;
  return redrawable((redraw) => {
    const box = el('div', { class: 'nest' });
    const drawn = frame(spec, box, box, redraw);
    spec.board.clear_below(spec.pointer);
    const properties = Object.fromEntries(declared.map(({ name, schema }) => [name, schema]));
    const inner = { ...spec, schema: { ...spec.schema, properties }, change(value: unknown) { spec.value = value; spec.change(value); drawn.now(value); } };
    const groups = new Map(declared.map(({ name, group }) => [name, group]));
    let shown = '';
    for (const { name, element } of member_fields(inner)) {
      const group = groups.get(name) ?? '';
      if (group !== shown) box.append(el('h4', { class: 'soft' }, group));
      shown = group;
      box.append(element);
    }
    const given: Members = is_members(spec.value) ? spec.value : {};
    const others = Object.keys(given).filter((name) => !groups.has(name));
    if (others.length > 0) box.append(el('p', { class: 'soft' }, `Not declared by the rules: ${others.join(', ')}`));
    return drawn.element;
  });
}

/** The fields follow the rules: they are drawn again when the pointer or the focus comes to them after a change. */
export const attributes_field: Draw = (spec) => {
  const draw = (): HTMLElement => declared_fields(spec) ?? map_field(spec);
  let rules = rules_text(spec.grammar?.());
  const whole = el('div', {}, draw());
  const follow = (): void => {
    const now = rules_text(spec.grammar?.());
    if (now === rules) return;
    rules = now;
    whole.replaceChildren(draw());
  };
  whole.addEventListener('pointerenter', follow);
  whole.addEventListener('focusin', follow);
  return whole;
};
