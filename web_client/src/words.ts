/** Searching by words: each word of the question begins a word of the text; "oaks" finds an oak. */

/** In small letters and without accents, taken apart where neither letter nor digit stands. */
const words_in = (text: string): string[] =>
  text.normalize('NFD').replaceAll(/\p{M}/gu, '').toLowerCase().split(/[^\p{L}\p{N}.]+/u).filter(Boolean);

/** The word, and what it may be the plural of. */
function singulars(word: string): string[] {
  if (word.length < 4 || !word.endsWith('s') || word.endsWith('ss')) return [word];
  const forms = [word, word.slice(0, -1)];
  if (word.endsWith('ies')) forms.push(`${word.slice(0, -3)}y`);
  if (/(?:s|x|z|ch|sh)es$/.test(word)) forms.push(word.slice(0, -2));
  if (word.endsWith('ves')) forms.push(`${word.slice(0, -3)}f`);
  return forms;
}

/** Asks whether all words of a question are in the text. */
export function matcher(text: string): (question: string) => boolean {
  const words = words_in(text);
  return (question) => words_in(question).every((asked) => singulars(asked).some((form) => words.some((word) => word.startsWith(form))));
}
