/** The interface of the code editor, for code that must not import the editor's chunk. */
import type { Vocabulary } from '../api';

/** A range of the text with an error, or with a warning if `mild`. Offsets are UTF-16 code units. */
export interface Mark { from: number; to: number; message: string; mild?: boolean }

export interface CodeOptions {
  /** The value of x-grammar in the schema, or "json". */
  notation: string;
  label: string;
  text: string;
  /** Called for changes by the user, but not for those by the page. */
  change(text: string): void;
}

export interface CodeEditor {
  /**
   * The element that contains the editor in a shadow root. Constructed style sheets are allowed there by the content
   * security policy.
   */
  readonly host: HTMLElement;
  text(): string;
  set_text(text: string): void;
  mark(marks: Mark[]): void;
  /** Sets the cursor position and focuses the editor. */
  go(from: number, to?: number): void;
}

export type MakeEditor = (options: CodeOptions, vocabulary: Vocabulary) => CodeEditor;
