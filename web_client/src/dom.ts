/** Making elements. Nothing here writes a style attribute: the page's policy forbids it. */

type Attribute = string | number | boolean | undefined | ((event: Event) => void);
type Child = Node | string | null | undefined | false;

/** `el('button', { type: 'button', onclick: roll }, 'Roll')`; false and undefined leave an attribute out. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, Attribute> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name.replace(/^on/, ''), value);
    else if (value !== false && value !== undefined) element.setAttribute(name, value === true ? '' : String(value));
  }
  element.append(...children.filter((child): child is Node | string => Boolean(child)));
  return element;
}

/** The element that index.html promises. */
export function part<T extends HTMLElement = HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (!element) throw new Error(`index.html has no #${id}`);
  return element as T;
}

let last_id = 0;
export const fresh_id = (word: string): string => `${word}-${(last_id += 1)}`;

/** Strokes of 24 x 24 icons. */
const strokes = {
  reset: 'M4 12a8 8 0 1 0 2.5-5.8M4 4v4.5h4.5',
  help: 'M9.2 9a2.8 2.8 0 1 1 4.2 2.4c-.9.5-1.4 1.1-1.4 2.1M12 17.2v.1',
  add: 'M12 5v14M5 12h14',
  remove: 'M6 6l12 12M18 6L6 18',
  first: 'M18 6l-8 6 8 6zM6 6v12',
  back: 'M15 6l-8 6 8 6z',
  next: 'M9 6l8 6-8 6z',
  last: 'M6 6l8 6-8 6zM18 6v12',
} as const;

export function icon(name: keyof typeof strokes): SVGSVGElement {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  svg.setAttribute('viewBox', '0 0 24 24');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS(space, 'path');
  path.setAttribute('d', strokes[name]);
  svg.append(path);
  return svg;
}

/** 12345 -> "12,345" */
export const grouped = (count: number): string => count.toLocaleString('en');

/** Whole numbers within a sentence, those of five digits and more: 258097152 -> 258,097,152. Words in quotes stay. */
export const with_groups = (text: string): string =>
  text.replaceAll(/(?<![\w.,"'`#])\d{5,}(?![\w"'`]|\.\d)/g, (digits) => digits.replaceAll(/\B(?=(?:\d{3})+$)/g, ','));

/** With a large letter at its beginning. */
export const sentence = (text: string): string => text.replace(/^[a-z]/, (first) => first.toUpperCase());

/** 3 significant digits, without the zeros at the end. */
export const rounded = (value: number): string => String(Number(value.toPrecision(3)));
