/** The words of a notation, taken from the vocabulary of the server, for highlighting and completion. */
import type { Vocabulary, Word } from '../api';

export interface Words {
  /** Symbols and operations by their spelling. */
  symbols: Map<string, Word>;
  functions: Map<string, Word>;
  /** Names that are written in quotes; the vocabulary lists them without descriptions. */
  quoted: string[];
}

const written = (word: Word): string => word.symbol ?? word.name ?? '';

/**
 * Word notations have a list of named operations, symbol notations a list of symbols. Rows without a description are
 * names of other things.
 */
export function words_for(notation: string, vocabulary: Vocabulary): Words {
  const all = Object.values(vocabulary).filter((list) => Array.isArray(list));
  const quoted = all.flatMap((list) => list.filter((word) => typeof word === 'string'));
  const lists = all.map((list) => list.filter((word) => typeof word !== 'string'));
  const functions = new Map<string, Word>();
  const symbols = new Map<string, Word>();
  for (const word of (vocabulary['functions'] ?? []).filter((word) => typeof word !== 'string')) functions.set(written(word), word);
  const by_symbol = notation !== 'cga';
  for (const list of lists) {
    for (const word of list) {
      if (functions.get(written(word)) === word || word.text === undefined || (word.symbol !== undefined) !== by_symbol) continue;
      symbols.set(written(word), word);
    }
  }
  return { symbols, functions, quoted };
}
