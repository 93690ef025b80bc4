/** The code editor: CodeMirror 6 with the notations of the service. Only load.ts imports it. */
import { autocompletion, completionKeymap } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap } from '@codemirror/commands';
import { StreamLanguage, bracketMatching, type StreamParser } from '@codemirror/language';
import { lintKeymap, setDiagnostics, type Diagnostic } from '@codemirror/lint';
import { Annotation, Compartment, EditorState } from '@codemirror/state';
import { EditorView, keymap, lineNumbers } from '@codemirror/view';
import type { Vocabulary } from '../api';
import { completions } from './complete';
import type { CodeEditor, CodeOptions, MakeEditor } from './types';
import { colours, look, tags } from './theme';
import { formula, json, production, shape_rules } from './notations';
import { words_for, type Words } from './words';

function parser_for(notation: string, words: Words): StreamParser<unknown> {
  const parser = notation === 'json' ? json
    : notation === 'cga' ? shape_rules(words)
    : notation === 'expression' ? formula(words)
    : production(words, notation === 'production');
  return { ...(parser as StreamParser<unknown>), tokenTable: tags };
}

/** Marks changes that the page makes, as opposed to the user. */
const by_page = Annotation.define<boolean>();

export const make_editor: MakeEditor = (options: CodeOptions, vocabulary: Vocabulary): CodeEditor => {
  const words = words_for(options.notation, vocabulary);
  const host = document.createElement('div');
  host.className = 'code-editor';
  const root = host.attachShadow({ mode: 'open' });
  const validity = new Compartment();
  const valid = (is: boolean): ReturnType<typeof EditorView.contentAttributes.of> =>
    EditorView.contentAttributes.of({ 'aria-label': options.label, 'aria-invalid': String(!is), autocapitalize: 'off', tabindex: '0' });

  const view = new EditorView({
    root,
    parent: root as unknown as Element,
    state: EditorState.create({
      doc: options.text,
      extensions: [
        lineNumbers(), history(), bracketMatching(), look, colours,
        StreamLanguage.define(parser_for(options.notation, words)),
        options.notation === 'json' ? [] : autocompletion({ override: [completions(words, options.notation)], icons: false }),
        // Tab is not bound, so that keyboard users can leave the editor.
        keymap.of([...completionKeymap, ...historyKeymap, ...lintKeymap, ...defaultKeymap]),
        validity.of(valid(true)),
        EditorView.updateListener.of((update) => {
          if (update.docChanged && !update.transactions.some((each) => each.annotation(by_page))) options.change(view.state.doc.toString());
        }),
      ],
    }),
  });

  return {
    host,
    text: () => view.state.doc.toString(),
    set_text(text) {
      const old = view.state.doc.toString();
      if (old === text) return;
      // Only the differing range is replaced, so that the cursor keeps its position.
      let from = 0, end = old.length, last = text.length;
      while (from < Math.min(end, last) && old[from] === text[from]) from += 1;
      while (end > from && last > from && old[end - 1] === text[last - 1]) { end -= 1; last -= 1; }
      view.dispatch({ changes: { from, to: end, insert: text.slice(from, last) }, annotations: by_page.of(true) });
    },
    mark(marks) {
      const { length } = view.state.doc;
      const diagnostics = marks.map((mark): Diagnostic => ({
        from: Math.min(mark.from, length), to: Math.min(Math.max(mark.to, mark.from), length),
        message: mark.message, severity: mark.mild ? 'warning' : 'error',
      }));
      view.dispatch(setDiagnostics(view.state, diagnostics));
      view.dispatch({ effects: validity.reconfigure(valid(!marks.some((mark) => !mark.mild))) });
    },
    go(from, to = from) {
      const { length } = view.state.doc;
      const start = Math.min(from, length);
      // Scrolls to the start of the range, because the end of a long line would move the start out of view.
      view.dispatch({ selection: { anchor: Math.min(to, length), head: start }, effects: EditorView.scrollIntoView(start, { y: 'center' }) });
      view.focus();
    },
  };
};
