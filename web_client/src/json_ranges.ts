/** Maps each JSON Pointer to the text range of its value, and finds the first syntax error of a JSON text. */
import { pointer_to } from './form/schema';

export interface TextRange { from: number; to: number }

/** Thrown by `ranges_in`. `at` is the offset of the first invalid character. */
export class NotJson extends Error {
  readonly at: number;
  constructor(message: string, at: number) {
    super(message);
    this.at = at;
  }
}

/** The range of every value by its pointer ('' is the document). Throws NotJson. */
export function ranges_in(text: string): Map<string, TextRange> {
  const ranges = new Map<string, TextRange>();
  let at = 0;
  const blank = (): void => { while (/[ \t\n\r]/.test(text[at] ?? '')) at += 1; };
  const found = (): string => (at >= text.length ? 'the end of the text' : `\`${text[at]}\``);
  const expect = (character: string): void => {
    blank();
    if (text[at] !== character) throw new NotJson(`Expected \`${character}\`, found ${found()}`, at);
    at += 1;
  };
  const string = (): string => {
    const from = at;
    const match = /"(?:[^"\\\u0000-\u001f]|\\(?:["\\/bfnrt]|u[\da-fA-F]{4}))*"/y;
    match.lastIndex = at;
    const taken = match.exec(text);
    if (!taken) throw new NotJson('This string has no closing quote, or has a character that must be escaped', from);
    at += taken[0].length;
    return JSON.parse(taken[0]) as string;
  };
  const members = (close: string, member: () => void): void => {
    at += 1;
    blank();
    if (text[at] === close) { at += 1; return; }
    for (;;) {
      member();
      blank();
      if (text[at] === close) { at += 1; return; }
      if (text[at] !== ',') throw new NotJson(`Expected \`,\` or \`${close}\`, found ${found()}`, at);
      at += 1;
    }
  };
  const value = (pointer: string): void => {
    blank();
    const from = at;
    if (text[at] === '{') {
      members('}', () => {
        blank();
        if (text[at] !== '"') throw new NotJson(`Expected a name in quotes, found ${found()}`, at);
        const name = string();
        expect(':');
        value(pointer_to(pointer, name));
      });
    } else if (text[at] === '[') {
      let index = 0;
      members(']', () => { value(pointer_to(pointer, index)); index += 1; });
    } else if (text[at] === '"') {
      string();
    } else {
      const word = /(?:true|false|null|-?(?:0|[1-9]\d*)(?:\.\d+)?(?:[eE][-+]?\d+)?)(?![\w.])/y;
      word.lastIndex = at;
      const taken = word.exec(text);
      if (!taken) throw new NotJson(`Expected a value, found ${found()}`, at);
      at += taken[0].length;
    }
    ranges.set(pointer, { from, to: at });
  };
  value('');
  blank();
  if (at < text.length) throw new NotJson(`Expected nothing more, found ${found()}`, at);
  return ranges;
}

/** The range of the value that an error points to, or of its nearest enclosing value. */
export function range_of(ranges: Map<string, TextRange>, pointer: string): TextRange {
  let nearest = pointer;
  while (nearest && !ranges.has(nearest)) nearest = nearest.slice(0, nearest.lastIndexOf('/'));
  return ranges.get(nearest) ?? { from: 0, to: 0 };
}
