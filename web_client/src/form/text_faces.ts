/** The two implementations of a text field: a plain text area, and the code editor after it is loaded. */
import { el } from '../dom';
import type { CodeEditor, Mark } from '../editor/types';

export interface Face {
  readonly element: HTMLElement;
  text(): string;
  set_text(text: string): void;
  mark(marks: Mark[]): void;
  go(from: number, to: number): void;
}

const most_rows = 16;

/** A text area with line numbers. A transparent copy of the text behind it shows the error marks. */
export function plain_face(text: string, one_line: boolean, change: (text: string) => void): Face & { area: HTMLTextAreaElement } {
  const area = el('textarea', { wrap: 'off', spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off', class: 'code' });
  area.value = text;
  const gutter = el('div', { class: 'gutter', 'aria-hidden': 'true' });
  const under = el('pre', { class: 'marks', 'aria-hidden': 'true' });
  const element = el('div', { class: 'editor' }, gutter, el('div', { class: 'paper' }, under, area));
  let marks: Mark[] = [];
  const follow = (): void => {
    under.scrollTop = area.scrollTop;
    under.scrollLeft = area.scrollLeft;
    gutter.scrollTop = area.scrollTop;
  };
  const draw = (): void => {
    const lines = area.value.split('\n').length;
    const invalid = new Set(marks.filter((mark) => !mark.mild).map((mark) => area.value.slice(0, mark.from).split('\n').length));
    area.rows = Math.min(Math.max(lines, one_line ? 1 : 2), most_rows);
    gutter.replaceChildren(...Array.from({ length: lines }, (_, index) =>
      el('div', { class: invalid.has(index + 1) ? 'invalid' : undefined }, String(index + 1))));
    under.replaceChildren(...marked(area.value, marks));
    follow();
  };
  area.addEventListener('scroll', follow);
  area.addEventListener('input', () => {
    marks = [];
    draw();
    change(area.value);
  });
  draw();
  return {
    area, element,
    text: () => area.value,
    set_text(next) { area.value = next; draw(); },
    mark(next) {
      marks = next;
      area.setAttribute('aria-invalid', String(marks.some((mark) => !mark.mild)));
      draw();
    },
    go(from, to) {
      area.focus();
      area.setSelectionRange(from, to, 'backward');
      // Browsers do not scroll a selection into view, so the line is centred and scrolled to its start.
      const lines = area.value.split('\n').length, line = area.value.slice(0, from).split('\n').length - 1;
      area.scrollTop = area.scrollHeight * line / lines - area.clientHeight / 2;
      area.scrollLeft = 0;
      follow();
    },
  };
}

export const code_face = (editor: CodeEditor): Face => ({
  element: editor.host, text: editor.text, set_text: editor.set_text, mark: editor.mark, go: editor.go,
});

function marked(text: string, marks: Mark[]): (Node | string)[] {
  const parts: (Node | string)[] = [];
  let done = 0;
  for (const begin of [...new Set(marks.map((mark) => mark.from))].sort((a, b) => a - b)) {
    const at_end = begin >= text.length || text[begin] === '\n';
    const character = at_end ? ' ' : String.fromCodePoint(text.codePointAt(begin) ?? 32);
    parts.push(text.slice(done, begin), el('mark', {}, character));
    done = begin + (at_end ? 0 : character.length);
  }
  parts.push(`${text.slice(done)}\n`);
  return parts;
}
