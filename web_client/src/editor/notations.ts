/**
 * Tokenizers for syntax highlighting, one line at a time and without a grammar. Only the server validates the text.
 */
import type { StreamParser, StringStream } from '@codemirror/language';
import type { Words } from './words';

interface Line { section: 'left' | 'condition' | 'right' | 'odds'; depth: number; in_comment: boolean }

const start = (): Line => ({ section: 'left', depth: 0, in_comment: false });
const arrow = /^(?:-{1,2}>|~>|→|⟶)/;
const number = /^(?:\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+)/;
const name = /^[\p{L}_$][\p{L}\p{N}_$.]*/u;

function expression(stream: StringStream, words: Words): string | null {
  if (stream.match(number)) return 'number';
  const word = stream.match(name) as RegExpMatchArray | null;
  if (word) return words.functions.has(word[0]) ? 'function' : 'word';
  if (stream.match(/^(?:[<>=!]=?|&&?|\|\|?|[-+*/^%?:])/)) return 'operator';
  stream.next();
  return null;
}

/** Productions of L-systems, one per line. Axioms consist of a right-hand side alone. */
export function production(words: Words, has_left: boolean): StreamParser<Line> {
  const longest = Math.max(1, ...[...words.symbols.keys()].map((symbol) => symbol.length));
  return {
    startState: start,
    token(stream, line) {
      if (stream.sol()) Object.assign(line, { section: has_left ? 'left' : 'right', depth: 0 });
      if (stream.eatSpace()) return null;
      if (line.depth === 0 && stream.match(arrow)) { line.section = 'right'; return 'arrow'; }
      const next = stream.peek() ?? '';
      if (next === '(') { line.depth += 1; stream.next(); return 'paren'; }
      if (next === ')') { line.depth = Math.max(0, line.depth - 1); stream.next(); return 'paren'; }
      if (line.depth > 0 || line.section === 'condition' || line.section === 'odds') return expression(stream, words);
      if (next === ':') {
        line.section = line.section === 'left' ? 'condition' : 'odds';
        stream.next();
        return 'arrow';
      }
      if (line.section === 'left' && (next === '<' || next === '>')) { stream.next(); return 'arrow'; }
      if (next === '[' || next === ']') { stream.next(); return 'branch'; }
      const at = stream.match(/^@[^\s\d()[\]{}][\p{L}]*/u) as RegExpMatchArray | null;
      if (at) return words.symbols.has(at[0]) ? 'turtle' : 'module';
      for (let length = longest; length > 0; length -= 1) {
        const symbol = stream.string.slice(stream.pos, stream.pos + length);
        if (symbol.length === length && words.symbols.has(symbol)) {
          stream.pos += length;
          return line.section === 'left' ? 'module' : 'turtle';
        }
      }
      stream.next();
      return /[\p{L}\p{N}]/u.test(next) ? 'module' : null;
    },
  };
}

/** Expressions, and functions defined by expressions. */
export const formula = (words: Words): StreamParser<Line> => ({
  startState: start,
  token: (stream) => (stream.eatSpace() ? null : expression(stream, words)),
});

/** Rules of shape grammars: `Name(a) --> operation(b) { 1 : Other | ~1 : Third }`. */
export const shape_rules = (words: Words): StreamParser<Line> => ({
  startState: start,
  token(stream, line) {
    if (line.in_comment) {
      if (stream.match(/^.*?\*\//)) line.in_comment = false;
      else stream.skipToEnd();
      return 'comment';
    }
    if (stream.eatSpace()) return null;
    if (stream.match('/*')) { line.in_comment = true; return 'comment'; }
    if (stream.match('//') || (stream.sol() && stream.match('#'))) { stream.skipToEnd(); return 'comment'; }
    if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) return 'string';
    if (stream.match(arrow) || stream.match(/^\.{3}/)) return 'arrow';
    if (stream.match(number)) return 'number';
    const word = stream.match(name) as RegExpMatchArray | null;
    if (word) {
      const after = stream.string.slice(stream.pos);
      // The name that a rule defines is highlighted as such even if an operation or a function has the same name.
      if (/^\s*(?:\([^)]*\))?\s*(?::[^-=~]*)?(?:-{1,2}>|~>|→|=(?!=))/.test(after)) return 'module';
      if (words.functions.has(word[0]) && /^\s*\(/.test(after)) return 'function';
      return words.symbols.has(word[0]) ? 'turtle' : 'word';
    }
    if (stream.match(/^[[\]{}|]/)) return 'branch';
    if (stream.match(/^[()]/)) return 'paren';
    stream.next();
    return 'operator';
  },
});

export const json: StreamParser<Line> = {
  startState: start,
  token(stream) {
    if (stream.eatSpace()) return null;
    if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) return /^\s*:/.test(stream.string.slice(stream.pos)) ? 'member' : 'string';
    if (stream.match(/^-?\d+\.?\d*(?:[eE][-+]?\d+)?/)) return 'number';
    if (stream.match(/^(?:true|false|null)\b/)) return 'function';
    if (stream.match(/^[[\]{}]/)) return 'branch';
    stream.next();
    return null;
  },
};
