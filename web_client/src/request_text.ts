/** The whole request as JSON in the code editor, which edits the same state as the form. */
import { whole, type Issue, type Request, type Written } from './api';
import { el, part } from './dom';
import { load_editor } from './editor/load';
import type { CodeEditor, Mark } from './editor/types';
import { parse_json } from './exact';
import { same } from './form/schema';
import { NotJson, range_of, ranges_in } from './json_ranges';
import type { State } from './state';

export interface RequestText {
  /** Called when the panel page becomes visible. The first call loads the editor. */
  open(): void;
  follow(state: State): void;
  show_issues(issues: Issue[]): void;
}

/** JSON on one line with spaces between its elements. */
function flat_of(value: unknown): string {
  if (typeof value !== 'object' || value === null) return JSON.stringify(value) ?? 'null';
  if (Array.isArray(value)) return `[${value.map(flat_of).join(', ')}]`;
  const members = Object.entries(value).filter(([, member]) => member !== undefined);
  return members.length === 0 ? '{}' : `{ ${members.map(([name, member]) => `${JSON.stringify(name)}: ${flat_of(member)}`).join(', ')} }`;
}

/** Short values stay on one line, so that productions and vectors remain readable. */
export function written(value: unknown, indent = ''): string {
  const flat = flat_of(value);
  if (typeof value !== 'object' || value === null || (flat.length + indent.length < 60 && indent !== '')) return flat;
  const inner = `${indent}  `;
  if (Array.isArray(value)) return value.length === 0 ? '[]' : `[\n${value.map((each) => inner + written(each, inner)).join(',\n')}\n${indent}]`;
  const members = Object.entries(value).filter(([, member]) => member !== undefined);
  return members.length === 0 ? '{}' : `{\n${members.map(([name, member]) => `${inner}${JSON.stringify(name)}: ${written(member, inner)}`).join(',\n')}\n${indent}}`;
}

/** `write` receives the request and the name of its preset. */
export function wire_request_text(write: (request: Request, preset: string | null) => void): RequestText {
  const page = part('request');
  const note = el('p', { class: 'issue', id: 'request-error', role: 'status' });
  const container = el('div', { class: 'json' }, el('p', { class: 'soft' }, 'The editor is loading.'));
  page.replaceChildren(el('h2', { class: 'unseen' }, 'Request as JSON'),
    el('p', { class: 'soft about' }, 'The text that is sent to the server. Changes appear in the form and in the view at once.'), container, note);
  let editor: CodeEditor | null = null;
  let current: Request | null = null;
  let issues: Issue[] = [];
  let asked = 0;

  const mark = (): void => {
    if (!editor) return;
    const text = editor.text();
    try {
      const ranges = ranges_in(text);
      editor.mark(issues.map((issue): Mark => ({ ...range_of(ranges, issue.pointer), message: text_of(issue), ...(issue.mild ? { mild: true } : {}) })));
      note.replaceChildren(...issues.map((issue) => spot(editor, range_of(ranges, issue.pointer), issue)));
    } catch (error) {
      if (!(error instanceof NotJson)) throw error;
      editor.mark([{ from: error.at, to: error.at + 1, message: error.message }]);
      const { line, column } = line_of(text, error.at);
      note.replaceChildren(spot(editor, { from: error.at, to: error.at + 1 }, { pointer: '', message: error.message, line, column }));
    }
  };

  async function changed(text: string): Promise<void> {
    const turn = (asked += 1);
    issues = [];
    mark();
    let given: Written;
    try {
      given = await whole(parse_json(text));
    } catch (error) {
      if (error instanceof SyntaxError || turn !== asked) return;
      issues = [{ pointer: '', message: (error as Error).message }];
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
    } catch { /* Text that is not JSON is replaced by the current request. */ }
    editor.set_text(written(current));
    mark();
  };

  return {
    open() {
      if (editor) return;
      load_editor().then((make) => {
        if (editor) return;
        editor = make({ notation: 'json', label: 'Request as JSON', text: written(current ?? {}), change: (text) => void changed(text) });
        container.replaceChildren(editor.host);
        mark();
      }, () => container.replaceChildren(el('p', { class: 'soft' }, 'The editor cannot be loaded, because the server does not respond. Open this tab again for another attempt.')));
    },
    follow(state) {
      if (state.request === current) return;
      current = state.request;
      asked += 1;
      set();
    },
    show_issues(next) {
      issues = next;
      mark();
    },
  };
}

const text_of = (issue: Issue): string =>
  issue.line === undefined ? `${issue.pointer ? `${issue.pointer}: ` : ''}${issue.message}` : `${issue.pointer ? `${issue.pointer}, ` : ''}line ${issue.line}, column ${issue.column ?? 1}: ${issue.message}`;

function spot(editor: CodeEditor | null, at: { from: number; to: number }, issue: Issue): HTMLElement {
  return el('button', { type: 'button', class: issue.mild ? 'spot mild' : 'spot', onclick: () => editor?.go(at.from, at.to) }, text_of(issue));
}

function line_of(text: string, at: number): { line: number; column: number } {
  const before = text.slice(0, at).split('\n');
  return { line: before.length, column: [...(before.at(-1) ?? '')].length + 1 };
}
