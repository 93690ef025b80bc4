/** Loads the code editor, which is a separate chunk, when the first text that uses it becomes visible. */
import { get_vocabulary, type Vocabulary } from '../api';
import type { CodeEditor, CodeOptions } from './types';

type Make = (options: CodeOptions) => CodeEditor;
let ready: Make | null = null;

/** The editor module after `load_editor` has resolved; null before. */
export const loaded_editor = (): Make | null => ready;

let loading: Promise<Make> | null = null;

/** Rejects if the server is unreachable. The next call tries again. */
export function load_editor(): Promise<Make> {
  loading ??= Promise.all([import('./editor'), get_vocabulary().catch((): Vocabulary => ({}))])
    .then(([{ make_editor }, vocabulary]) => (ready = (options: CodeOptions) => make_editor(options, vocabulary)));
  loading.catch(() => { loading = null; });
  return loading;
}

/** Calls `act` once, when the element becomes visible. */
export function when_seen(element: Element, act: () => void): void {
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    act();
  });
  observer.observe(element);
}
