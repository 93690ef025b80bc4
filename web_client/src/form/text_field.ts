/**
 * Texts that a fault can point into: grammars as one text, and lists of strings with one entry a line. They are plain
 * text areas until they come into sight; those with a notation then become code editors.
 */
import type { Fault } from '../api';
import { el } from '../dom';
import { load_editor, loaded_editor, when_seen, type CodeEditor, type CodeOptions, type Mark } from '../editor/load';
import { frame, type Draw, type Place } from './field';
import { redrawable } from './simple_fields';
import { code_face, plain_face, type Face } from './text_faces';

/** A place in the text, both from 0. `column` counts characters (code points), as the server does. */
interface Spot { line: number; column: number }

/** Which line of the text each entry of the list stands on. Empty lines are no entries. */
export const entry_lines = (text: string): number[] =>
  text.split('\n').flatMap((line, index) => (line.trim() === '' ? [] : [index]));

/** UTF-16 offset of a spot in the text; a spot past the end of its line is the end of the line. */
export function offset_of(text: string, spot: Spot): number {
  const lines = text.split('\n');
  const before = lines.slice(0, spot.line).reduce((sum, line) => sum + line.length + 1, 0);
  return before + [...(lines[spot.line] ?? '')].slice(0, spot.column).join('').length;
}

const notation_of = (place: Place): string | undefined => place.schema['x-grammar'] ?? place.schema.items?.['x-grammar'];

export const text_field: Draw = (place) =>
  redrawable((redraw) => {
    const is_list = place.schema.type === 'array';
    const notation = notation_of(place);
    const one_line = !is_list && notation !== undefined && notation !== 'cga';
    const take = (text: string): void => {
      const value = is_list ? text.split('\n').map((line) => line.trim()).filter((line) => line !== '') : text;
      place.value = value;
      place.change(value);
      drawn.now(value);
    };
    const plain = plain_face(text_of(place, is_list), one_line, take);
    let face: Face = plain;
    const spots_below = el('ul', { class: 'spots', hidden: true });
    const body = el('div', {}, face.element, spots_below);
    const drawn = frame(place, plain.area, body, redraw);

    let known: Fault[] = [];
    const show = (faults: Fault[]): void => {
      known = faults;
      const text = face.text();
      const spots = faults.map((fault) => spot_of(fault, place.pointer, text, is_list));
      const marks = spots.map((spot, index) => mark_of(text, spot, faults[index]));
      const is_faulty = faults.some((fault) => !fault.mild);
      drawn.element.classList.toggle('faulty', is_faulty);
      spots_below.hidden = spots.length === 0;
      spots_below.replaceChildren(...spots.map((spot, index) => spot_row(() => face, spot, marks[index], faults[index])));
      face.mark(marks);
    };
    place.board.add(place.pointer, show);

    // A shape tells the line of its rule. What is selected in the text area stays selected when the editor takes its place.
    drawn.element.addEventListener('go-line', (event) => {
      const line = (event as CustomEvent<number>).detail - 1;
      for (let fold = drawn.element.closest('details'); fold; fold = fold.parentElement?.closest('details') ?? null) fold.open = true;
      face.element.scrollIntoView({ block: 'nearest' });
      face.go(offset_of(face.text(), { line, column: 0 }), offset_of(face.text(), { line, column: 1e6 }));
    });

    const become_code = (make: (options: CodeOptions) => CodeEditor): void => {
      const has_focus = plain.area === document.activeElement;
      const [from, to] = [plain.area.selectionStart, plain.area.selectionEnd];
      const editor = make({
        notation: notation ?? '', label: place.label, text: plain.text(),
        change(text) { show([]); take(text); },
      });
      face = code_face(editor);
      plain.element.replaceWith(editor.host);
      drawn.no_control();
      show(known);
      if (has_focus) face.go(from, to);
    };
    const loaded = loaded_editor();
    if (notation !== undefined && loaded) become_code(loaded);
    else if (notation !== undefined) when_seen(plain.element, () => void load_editor().then(become_code, () => { /* The text area does as well. */ }));
    return drawn.element;
  });

function text_of(place: Place, is_list: boolean): string {
  const value = place.value ?? place.schema.default;
  // An entry with line breaks of its own becomes one line: to a grammar they are spaces.
  if (is_list) return Array.isArray(value) ? value.map((entry) => String(entry).replaceAll(/\r?\n/g, ' ')).join('\n') : '';
  return typeof value === 'string' ? value.replaceAll('\r\n', '\n') : '';
}

function spot_of(fault: Fault, pointer: string, text: string, is_list: boolean): Spot {
  const column = (fault.column ?? 1) - 1;
  if (!is_list) return { line: (fault.line ?? 1) - 1, column };
  const entry = Number(fault.pointer.slice(pointer.length + 1).split('/')[0]);
  const line = entry_lines(text)[entry] ?? 0;
  // Entries reach the server trimmed; its columns start after the indent.
  const indent = /^\s*/.exec(text.split('\n')[line] ?? '')?.[0].length ?? 0;
  return { line, column: column + indent };
}

/** The character at the spot; the whole line where the fault names no column. */
function mark_of(text: string, spot: Spot, fault: Fault | undefined): Mark {
  const from = offset_of(text, fault?.column === undefined ? { line: spot.line, column: 0 } : spot);
  const line_end = text.indexOf('\n', from) < 0 ? text.length : text.indexOf('\n', from);
  const one = from + (text.codePointAt(from) ?? 0 ? String.fromCodePoint(text.codePointAt(from) ?? 32).length : 0);
  const to = fault?.column === undefined ? line_end : Math.min(Math.max(one, from), Math.max(line_end, from));
  return { from, to, message: fault?.message ?? '', ...(fault?.mild ? { mild: true } : {}) };
}

/** "Line 2, column 7: what is wrong", which leads to the place and selects the character there. */
function spot_row(face: () => Face, spot: Spot, mark: Mark | undefined, fault: Fault | undefined): HTMLElement {
  const where = fault?.column === undefined ? `Line ${spot.line + 1}` : `Line ${spot.line + 1}, column ${spot.column + 1}`;
  const go = el('button', { type: 'button', class: fault?.mild ? 'spot mild' : 'spot' }, el('b', {}, where), `: ${fault?.message ?? ''}`);
  go.addEventListener('click', () => { if (mark) face().go(mark.from, mark.to); });
  return el('li', {}, go);
}
