/** The whole request as JSON in the code editor: one more hand on the same state as the form's. */
import { whole, type Fault, type Request, type Written } from './api';
import { el, part } from './dom';
import { load_editor, type CodeEditor, type Mark } from './editor/load';
import { parse_json } from './exact';
import { same } from './form/schema';
import { NotJson, place_of, places_in } from './json_places';
import type { State } from './state';

export interface RequestText {
  /** The page has come into sight: the editor is loaded at the first time. */
  open(): void;
  follow(state: State): void;
  show_faults(faults: Fault[]): void;
}

/** JSON on one line, with air. */
function flat_of(value: unknown): string {
  if (typeof value !== 'object' || value === null) return JSON.stringify(value) ?? 'null';
  if (Array.isArray(value)) return `[${value.map(flat_of).join(', ')}]`;
  const members = Object.entries(value).filter(([, member]) => member !== undefined);
  return members.length === 0 ? '{}' : `{ ${members.map(([name, member]) => `${JSON.stringify(name)}: ${flat_of(member)}`).join(', ')} }`;
}

/** What is short stays on one line: a production or a vector is read in one look. */
export function written(value: unknown, indent = ''): string {
  const flat = flat_of(value);
  if (typeof value !== 'object' || value === null || (flat.length + indent.length < 60 && indent !== '')) return flat;
  const inner = `${indent}  `;
  if (Array.isArray(value)) return value.length === 0 ? '[]' : `[\n${value.map((each) => inner + written(each, inner)).join(',\n')}\n${indent}]`;
  const members = Object.entries(value).filter(([, member]) => member !== undefined);
  return members.length === 0 ? '{}' : `{\n${members.map(([name, member]) => `${inner}${JSON.stringify(name)}: ${written(member, inner)}`).join(',\n')}\n${indent}}`;
}

/** `write` gets the request and the preset that it names. */
export function wire_request_text(write: (request: Request, preset: string | null) => void): RequestText {
  const page = part('request');
  const note = el('p', { class: 'fault', id: 'request-fault', role: 'status' });
  const place = el('div', { class: 'json' }, el('p', { class: 'soft' }, 'The editor is on its way.'));
  page.replaceChildren(el('h2', { class: 'unseen' }, 'Request as JSON'),
    el('p', { class: 'soft about' }, 'What is sent to the server. Changes here appear in the form and in the picture at once.'), place, note);
  let editor: CodeEditor | null = null;
  let current: Request | null = null;
  let faults: Fault[] = [];
  let asked = 0;

  const mark = (): void => {
    if (!editor) return;
    const text = editor.text();
    try {
      const places = places_in(text);
      editor.mark(faults.map((fault): Mark => ({ ...place_of(places, fault.pointer), message: told(fault), ...(fault.mild ? { mild: true } : {}) })));
      note.replaceChildren(...faults.map((fault) => spot(editor, place_of(places, fault.pointer), fault)));
    } catch (error) {
      if (!(error instanceof NotJson)) throw error;
      editor.mark([{ from: error.at, to: error.at + 1, message: error.message }]);
      const { line, column } = line_of(text, error.at);
      note.replaceChildren(spot(editor, { from: error.at, to: error.at + 1 }, { pointer: '', message: error.message, line, column }));
    }
  };

  async function changed(text: string): Promise<void> {
    const turn = (asked += 1);
    faults = [];
    mark();
    let given: Written;
    try {
      given = await whole(parse_json(text));
    } catch (error) {
      if (error instanceof SyntaxError || turn !== asked) return;
      faults = [{ pointer: '', message: (error as Error).message }];
      mark();
      return;
    }
    if (turn !== asked) return;
    current = given.request;
    write(given.request, given.preset);
  }

  const set = (): void => {
    if (!editor || !current) return;
    try {
      if (same(parse_json(editor.text()), JSON.parse(JSON.stringify(current)))) return;
    } catch { /* What is no JSON gives way to what counts. */ }
    editor.set_text(written(current));
    mark();
  };

  return {
    open() {
      if (editor) return;
      load_editor().then((make) => {
        if (editor) return;
        editor = make({ notation: 'json', label: 'Request as JSON', text: written(current ?? {}), change: (text) => void changed(text) });
        place.replaceChildren(editor.host);
        mark();
      }, () => place.replaceChildren(el('p', { class: 'soft' }, 'The editor cannot be fetched: the server does not answer. Open this page of the panel again to try once more.')));
    },
    follow(state) {
      if (state.request === current) return;
      current = state.request;
      asked += 1;
      set();
    },
    show_faults(next) {
      faults = next;
      mark();
    },
  };
}

const told = (fault: Fault): string =>
  fault.line === undefined ? `${fault.pointer ? `${fault.pointer}: ` : ''}${fault.message}` : `${fault.pointer ? `${fault.pointer}, ` : ''}line ${fault.line}, column ${fault.column ?? 1}: ${fault.message}`;

function spot(editor: CodeEditor | null, at: { from: number; to: number }, fault: Fault): HTMLElement {
  return el('button', { type: 'button', class: fault.mild ? 'spot mild' : 'spot', onclick: () => editor?.go(at.from, at.to) }, told(fault));
}

function line_of(text: string, at: number): { line: number; column: number } {
  const before = text.slice(0, at).split('\n');
  return { line: before.length, column: [...(before.at(-1) ?? '')].length + 1 };
}
