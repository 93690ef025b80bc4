/** The code editor is a file of its own, fetched when the first text that it is for comes into sight. */
import { get_vocabulary, type Vocabulary } from '../api';

/** A stretch of the text that something is said about; `mild` for a warning. Offsets in UTF-16 units. */
export interface Mark { from: number; to: number; message: string; mild?: boolean }

export interface CodeOptions {
  /** The schema's x-grammar, or "json". */
  notation: string;
  label: string;
  text: string;
  /** Only what a hand has changed is told. */
  change(text: string): void;
}

export interface CodeEditor {
  /** Holds the editor in a shadow root, because the page's policy lets no script write styles into the document. */
  readonly host: HTMLElement;
  text(): string;
  set_text(text: string): void;
  mark(marks: Mark[]): void;
  /** Puts the cursor there, and the focus. */
  go(from: number, to?: number): void;
}

export type MakeEditor = (options: CodeOptions, vocabulary: Vocabulary) => CodeEditor;
type Make = (options: CodeOptions) => CodeEditor;
let ready: Make | null = null;

/** What `load_editor` has given before; null until then. */
export const loaded_editor = (): Make | null => ready;

let loading: Promise<Make> | null = null;

/** Rejects where the server is gone; the next call tries again. */
export function load_editor(): Promise<Make> {
  loading ??= Promise.all([import('./editor'), get_vocabulary().catch((): Vocabulary => ({}))])
    .then(([{ make_editor }, vocabulary]) => (ready = (options: CodeOptions) => make_editor(options, vocabulary)));
  loading.catch(() => { loading = null; });
  return loading;
}

/** Calls once, when the element is in sight. */
export function when_seen(element: Element, act: () => void): void {
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    act();
  });
  observer.observe(element);
}
