/**
 * Helpers that create elements. They never write a style attribute, because the content security policy forbids it.
 */

type Attribute = string | number | boolean | undefined | ((event: Event) => void);
type Child = Node | string | null | undefined | false;

/**
 * Example: `el('button', { type: 'button', onclick: roll }, 'Roll')`. An attribute that is false or undefined is
 * omitted.
 */
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

/** An element that index.html must contain. */
export function part<T extends HTMLElement = HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (!element) throw new Error(`index.html has no #${id}`);
  return element as T;
}

let last_id = 0;
export const fresh_id = (word: string): string => `${word}-${(last_id += 1)}`;

/** Path data of icons on a 24 x 24 grid. */
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

/**
 * Groups the digits of whole numbers with at least five digits in a sentence: 258097152 -> 258,097,152. Quoted text
 * is unchanged.
 */
export const with_groups = (text: string): string =>
  text.replaceAll(/(?<![\w.,"'`#])\d{5,}(?![\w"'`]|\.\d)/g, (digits) => digits.replaceAll(/\B(?=(?:\d{3})+$)/g, ','));

/** Capitalises the first letter. */
export const sentence = (text: string): string => text.replace(/^[a-z]/, (first) => first.toUpperCase());

/** Rounds to 3 significant digits and omits trailing zeros. */
export const rounded = (value: number): string => String(Number(value.toPrecision(3)));
