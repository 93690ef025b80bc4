/** The words of a notation, out of the vocabulary that the server prints: for colours and for completion. */
import type { Vocabulary, Word } from '../api';

export interface Words {
  /** Symbols and operations, by how they are written. */
  symbols: Map<string, Word>;
  functions: Map<string, Word>;
}

const written = (word: Word): string => word.symbol ?? word.name ?? '';

/**
 * Notations of words have a list of operations with names; those of symbols have one of symbols. Rows without a text
 * are names of other things.
 */
export function words_for(notation: string, vocabulary: Vocabulary): Words {
  const lists = Object.values(vocabulary).filter((list): list is Word[] => Array.isArray(list));
  const functions = new Map<string, Word>();
  const symbols = new Map<string, Word>();
  for (const word of vocabulary['functions'] ?? []) functions.set(written(word), word);
  const by_symbol = notation !== 'cga';
  for (const list of lists) {
    if (list === vocabulary['functions']) continue;
    for (const word of list) {
      if (word.text === undefined || (word.symbol !== undefined) !== by_symbol) continue;
      symbols.set(written(word), word);
    }
  }
  return { symbols, functions };
}
