/**
 * A text area with line numbers that marks the character of a fault: for grammars as one text, and for lists of
 * strings with one entry a line. Behind the text area lies a copy of the text, invisible but for its marks.
 */
import type { Fault } from '../api';
import { el } from '../dom';
import { frame, type Draw, type Place } from './field';
import { redrawable } from './simple_fields';

const most_rows = 16;

/** A place in the text, both from 0. `column` counts characters (code points), as the server does. */
interface Spot { line: number; column: number; message: string }

/** Which line of the text each entry of the list stands on. Empty lines are no entries. */
export const entry_lines = (text: string): number[] =>
  text.split('\n').flatMap((line, index) => (line.trim() === '' ? [] : [index]));

/** UTF-16 offset of a spot in the text; a spot past the end of its line is the end of the line. */
export function offset_of(text: string, spot: { line: number; column: number }): number {
  const lines = text.split('\n');
  const before = lines.slice(0, spot.line).reduce((sum, line) => sum + line.length + 1, 0);
  return before + [...(lines[spot.line] ?? '')].slice(0, spot.column).join('').length;
}

export const text_field: Draw = (place) =>
  redrawable((redraw) => {
    const is_list = place.schema.type === 'array';
    const one_line = !is_list && place.schema['x-grammar'] !== undefined && place.schema['x-grammar'] !== 'cga';
    const area = el('textarea', { wrap: 'off', spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off', class: 'code' });
    area.value = text_of(place, is_list);
    const gutter = el('div', { class: 'gutter', 'aria-hidden': 'true' });
    const marks = el('pre', { class: 'marks', 'aria-hidden': 'true' });
    const spots_below = el('ul', { class: 'spots', hidden: true });
    const editor = el('div', { class: 'editor' }, gutter, el('div', { class: 'paper' }, marks, area));
    const drawn = frame(place, area, el('div', {}, editor, spots_below), redraw);

    let spots: Spot[] = [];
    const follow = (): void => {
      marks.scrollTop = area.scrollTop;
      marks.scrollLeft = area.scrollLeft;
      gutter.scrollTop = area.scrollTop;
    };
    const draw = (): void => {
      const lines = area.value.split('\n').length;
      const faulty = new Set(spots.map((spot) => spot.line));
      area.rows = Math.min(Math.max(lines, one_line ? 1 : 2), most_rows);
      gutter.replaceChildren(...Array.from({ length: lines }, (_, index) =>
        el('div', { class: faulty.has(index) ? 'faulty' : undefined }, String(index + 1))));
      marks.replaceChildren(...marked(area.value, spots));
      follow();
    };
    const take = (value: unknown): void => { place.change(value); drawn.now(value); };
    area.addEventListener('scroll', follow);
    area.addEventListener('input', () => {
      spots = [];
      draw();
      take(is_list ? area.value.split('\n').map((line) => line.trim()).filter((line) => line !== '') : area.value);
    });

    place.board.add(place.pointer, (faults) => {
      spots = faults.map((fault) => spot_of(fault, place.pointer, area.value, is_list));
      drawn.element.classList.toggle('faulty', spots.length > 0);
      area.setAttribute('aria-invalid', String(spots.length > 0));
      spots_below.hidden = spots.length === 0;
      spots_below.replaceChildren(...spots.map((spot, index) => spot_row(area, spot, faults[index])));
      draw();
    });
    draw();
    return drawn.element;
  });

function text_of(place: Place, is_list: boolean): string {
  const value = place.value ?? place.schema.default;
  // An entry with line breaks of its own becomes one line: to a grammar they are spaces.
  if (is_list) return Array.isArray(value) ? value.map((entry) => String(entry).replaceAll('\n', ' ')).join('\n') : '';
  return typeof value === 'string' ? value : '';
}

function spot_of(fault: Fault, pointer: string, text: string, is_list: boolean): Spot {
  const message = fault.message;
  const column = (fault.column ?? 1) - 1;
  if (!is_list) return { line: (fault.line ?? 1) - 1, column, message };
  const entry = Number(fault.pointer.slice(pointer.length + 1).split('/')[0]);
  const line = entry_lines(text)[entry] ?? 0;
  // Entries reach the server trimmed; its columns start after the indent.
  const indent = /^\s*/.exec(text.split('\n')[line] ?? '')?.[0].length ?? 0;
  return { line, column: column + indent, message };
}

/** "Line 2, column 7: what is wrong", which leads to the place and selects the character there. */
function spot_row(area: HTMLTextAreaElement, spot: Spot, fault: Fault | undefined): HTMLElement {
  const where = fault?.column === undefined ? `Line ${spot.line + 1}` : `Line ${spot.line + 1}, column ${spot.column + 1}`;
  const go = el('button', { type: 'button', class: 'spot' }, el('b', {}, where), `: ${spot.message}`);
  go.addEventListener('click', () => {
    const begin = offset_of(area.value, spot);
    area.focus();
    area.setSelectionRange(begin, Math.min(begin + 1, area.value.length));
  });
  return el('li', {}, go);
}

function marked(text: string, spots: Spot[]): (Node | string)[] {
  const parts: (Node | string)[] = [];
  let done = 0;
  const begins = [...new Set(spots.map((spot) => offset_of(text, spot)))].sort((a, b) => a - b);
  for (const begin of begins) {
    const at_end = begin >= text.length || text[begin] === '\n';
    const character = at_end ? ' ' : String.fromCodePoint(text.codePointAt(begin) ?? 32);
    parts.push(text.slice(done, begin), el('mark', {}, character));
    done = begin + (at_end ? 0 : character.length);
  }
  parts.push(`${text.slice(done)}\n`);
  return parts;
}
