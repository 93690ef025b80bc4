/** Word search: each word of the query must be a prefix of a word in the text; "oaks" finds "oak". */

/** Converts to lower case without accents and splits at all characters that are neither letters nor digits. */
const words_in = (text: string): string[] =>
  text.normalize('NFD').replaceAll(/\p{M}/gu, '').toLowerCase().split(/[^\p{L}\p{N}.]+/u).filter(Boolean);

/** The word and its possible singular forms. */
function singulars(word: string): string[] {
  if (word.length < 4 || !word.endsWith('s') || word.endsWith('ss')) return [word];
  const forms = [word, word.slice(0, -1)];
  if (word.endsWith('ies')) forms.push(`${word.slice(0, -3)}y`);
  if (/(?:s|x|z|ch|sh)es$/.test(word)) forms.push(word.slice(0, -2));
  if (word.endsWith('ves')) forms.push(`${word.slice(0, -3)}f`);
  return forms;
}

/** Returns a predicate: whether a text contains all words of the query. */
export function matcher(text: string): (question: string) => boolean {
  const words = words_in(text);
  return (question) => words_in(question).every((asked) => singulars(asked).some((form) => words.some((word) => word.startsWith(form))));
}
