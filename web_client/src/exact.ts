/** JSON whose whole numbers stay exact: beyond 2^53 a JavaScript number is rounded, and the service takes the digits as text too. */

/** Strings, which are passed over, and whole numbers of as many digits as a seed of 64 bits can have. */
const words = /"(?:[^"\\]|\\.)*"|(?<![\w.+-])\d{16,20}(?![\w.])/g;

/** Throws SyntaxError, as JSON.parse does. */
export const parse_json = (text: string): unknown =>
  JSON.parse(text.replace(words, (word) => (word.startsWith('"') || Number.isSafeInteger(Number(word)) ? word : `"${word}"`)));
