/** Completion sources: the vocabulary with descriptions and examples, and the names defined in the text. */
import type { Completion, CompletionContext, CompletionResult } from '@codemirror/autocomplete';
import type { Word } from '../api';
import type { Words } from './words';

function described(word: Word): Pick<Completion, 'detail' | 'info'> {
  const parameters = word.parameters ?? '';
  const example = word.example ? ` Example: ${word.example}` : '';
  return { detail: parameters, info: `${word.text ?? ''}${example}` };
}

const in_parentheses = (before: string): boolean => before.lastIndexOf('(') > before.lastIndexOf(')');

export function completions(words: Words, notation: string): (context: CompletionContext) => CompletionResult | null {
  const of_symbols: Completion[] = [...words.symbols].map(([label, word]) => ({ label, type: 'keyword', ...described(word) }));
  const of_functions: Completion[] = [...words.functions].map(([label, word]) => ({ label, type: 'function', apply: `${label}(`, ...described(word) }));
  const is_symbolic = notation !== 'cga';
  const of_operations = of_symbols.map((each): Completion => (each.detail ? { ...each, apply: `${each.label}(` } : each));
  const of_names: Completion[] = words.quoted.map((label) => ({ label, type: 'text' }));
  return (context) => {
    const line = context.state.doc.lineAt(context.pos);
    const before = line.text.slice(0, context.pos - line.from);
    const in_expression = is_symbolic ? in_parentheses(before) || /:[^-→~]*$/.test(before) || notation === 'expression' : false;
    if (is_symbolic && !in_expression) {
      // One-character symbols need no completion; only longer ones have a prefix.
      const at = context.matchBefore(/@[^\s()]*/);
      if (!at && !context.explicit) return null;
      return { from: at?.from ?? context.pos, options: of_symbols, filter: at !== null };
    }
    const quote = is_symbolic ? null : /"([^"]*)$/.exec(before);
    if (quote && (before.match(/"/g)?.length ?? 0) % 2 === 1)
      return { from: context.pos - (quote[1]?.length ?? 0), options: of_names, validFor: /^[^"]*$/ };
    const word = context.matchBefore(/[\p{L}_$][\p{L}\p{N}_$.]*/u);
    if (!word && !context.explicit) return null;
    const own = [...new Set(context.state.doc.toString().match(/[\p{L}_$][\p{L}\p{N}_$]{1,}/gu) ?? [])]
      .filter((name) => !words.functions.has(name) && !words.symbols.has(name) && name !== word?.text)
      .map((label): Completion => ({ label, type: 'variable' }));
    return { from: word?.from ?? context.pos, options: [...(is_symbolic ? [] : of_operations), ...of_functions, ...(is_symbolic ? [] : own)], validFor: /^[\p{L}\p{N}_$.]*$/u };
  };
}
