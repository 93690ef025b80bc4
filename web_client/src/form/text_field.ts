/**
 * Texts with error positions: grammars as one text, and lists of strings with one entry per line. They start as plain
 * text areas; those with a notation become code editors when they are first visible.
 */
import type { Issue } from '../api';
import { el } from '../dom';
import { load_editor, loaded_editor, when_seen } from '../editor/load';
import type { CodeEditor, CodeOptions, Mark } from '../editor/types';
import { frame, type Draw, type FieldSpec } from './field';
import { redrawable } from './simple_fields';
import { code_face, plain_face, type Face } from './text_faces';

/** A zero-based position in the text. `column` counts code points, as the server does. */
interface Spot { line: number; column: number }

/** The line number of each list entry. Empty lines are not entries. */
const entry_lines = (text: string): number[] =>
  text.split('\n').flatMap((line, index) => (line.trim() === '' ? [] : [index]));

/** The UTF-16 offset of a position. A position past the end of a line is moved to the end. */
function offset_of(text: string, spot: Spot): number {
  const lines = text.split('\n');
  const before = lines.slice(0, spot.line).reduce((sum, line) => sum + line.length + 1, 0);
  return before + [...(lines[spot.line] ?? '')].slice(0, spot.column).join('').length;
}

const notation_of = (spec: FieldSpec): string | undefined => spec.schema['x-grammar'] ?? spec.schema.items?.['x-grammar'];

export const text_field: Draw = (spec) =>
  redrawable((redraw) => {
    const is_list = spec.schema.type === 'array';
    const notation = notation_of(spec);
    const one_line = !is_list && notation !== undefined && notation !== 'cga';
    const take = (text: string): void => {
      const value = is_list ? text.split('\n').map((line) => line.trim()).filter((line) => line !== '') : text;
      spec.value = value;
      spec.change(value);
      drawn.now(value);
    };
    const plain = plain_face(text_of(spec, is_list), one_line, take);
    let face: Face = plain;
    const spots_below = el('ul', { class: 'spots', hidden: true });
    const body = el('div', {}, face.element, spots_below);
    const drawn = frame(spec, plain.area, body, redraw);

    let known: Issue[] = [];
    const show = (issues: Issue[]): void => {
      known = issues;
      const text = face.text();
      const spots = issues.map((issue) => spot_of(issue, spec.pointer, text, is_list));
      const marks = spots.map((spot, index) => mark_of(text, spot, issues[index]));
      const is_invalid = issues.some((issue) => !issue.mild);
      drawn.element.classList.toggle('invalid', is_invalid);
      spots_below.hidden = spots.length === 0;
      spots_below.replaceChildren(...spots.map((spot, index) => spot_row(() => face, spot, marks[index], issues[index])));
      face.mark(marks);
    };
    spec.board.add(spec.pointer, show);

    // A click on a shape leads to the line of its rule. The selection of the text area is kept when the editor
    // replaces it.
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
        notation: notation ?? '', label: spec.label, text: plain.text(),
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
    else if (notation !== undefined) when_seen(plain.element, () => void load_editor().then(become_code, () => { /* Without the editor, the text area stays in use. */ }));
    return drawn.element;
  });

function text_of(spec: FieldSpec, is_list: boolean): string {
  const value = spec.value ?? spec.schema.default;
  // Line breaks inside an entry are shown as spaces; the grammar treats both alike.
  if (is_list) return Array.isArray(value) ? value.map((entry) => String(entry).replaceAll(/\r?\n/g, ' ')).join('\n') : '';
  return typeof value === 'string' ? value.replaceAll('\r\n', '\n') : '';
}

function spot_of(issue: Issue, pointer: string, text: string, is_list: boolean): Spot {
  const column = (issue.column ?? 1) - 1;
  if (!is_list) return { line: (issue.line ?? 1) - 1, column };
  const entry = Number(issue.pointer.slice(pointer.length + 1).split('/')[0]);
  const line = entry_lines(text)[entry] ?? 0;
  // Entries are sent trimmed, so the server's columns start after the indentation.
  const indent = /^\s*/.exec(text.split('\n')[line] ?? '')?.[0].length ?? 0;
  return { line, column: column + indent };
}

/** The character at the position, or the whole line if the error has no column. */
function mark_of(text: string, spot: Spot, issue: Issue | undefined): Mark {
  const from = offset_of(text, issue?.column === undefined ? { line: spot.line, column: 0 } : spot);
  const line_end = text.indexOf('\n', from) < 0 ? text.length : text.indexOf('\n', from);
  const one = from + (text.codePointAt(from) ?? 0 ? String.fromCodePoint(text.codePointAt(from) ?? 32).length : 0);
  const to = issue?.column === undefined ? line_end : Math.min(Math.max(one, from), Math.max(line_end, from));
  return { from, to, message: issue?.message ?? '', ...(issue?.mild ? { mild: true } : {}) };
}

/** A button "Line 2, column 7: message" that selects the character at this position. */
function spot_row(face: () => Face, spot: Spot, mark: Mark | undefined, issue: Issue | undefined): HTMLElement {
  const where = issue?.column === undefined ? `Line ${spot.line + 1}` : `Line ${spot.line + 1}, column ${spot.column + 1}`;
  const go = el('button', { type: 'button', class: issue?.mild ? 'spot mild' : 'spot' }, el('b', {}, where), `: ${issue?.message ?? ''}`);
  go.addEventListener('click', () => { if (mark) face().go(mark.from, mark.to); });
  return el('li', {}, go);
}
