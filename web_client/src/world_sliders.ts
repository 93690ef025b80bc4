/** Sliders for the numbers of a world's parameters that have a range, made from the schema. */
import { el } from './dom';

interface Node { type?: string; title?: string; description?: string; minimum?: number; maximum?: number; default?: unknown; properties?: Record<string, Node> }
type Values = Record<string, unknown>;

const spoken = (name: string): string => name.charAt(0).toUpperCase() + name.slice(1).replaceAll('_', ' ');

/** Steps that meet the values which people write. */
const step_of = (low: number, high: number): number => (high - low > 20 ? 1 : 0.01);

/** The parameters with one number changed; `group` is the object that has it. */
export function changed(parameters: Values, group: string, name: string, value: number): Values {
  return { ...parameters, [group]: { ...parameters[group] as Values | undefined, [name]: value } };
}

/** A group of sliders for each object of the schema; `change` receives the parameters when a slider is let go. */
export function sliders(schema: Node, parameters: Values, change: (parameters: Values) => void): HTMLElement[] {
  let now = parameters;
  return Object.entries(schema.properties ?? {}).flatMap(([group, { properties = {} }]) => {
    const rows = Object.entries(properties).flatMap(([name, { minimum, maximum, default: usual, description = '' }]) => {
      if (minimum === undefined || maximum === undefined) return [];
      const value = Number((now[group] as Values | undefined)?.[name] ?? usual ?? minimum);
      const output = el('output', {}, String(value));
      const input = el('input', { type: 'range', name: `${group}/${name}`, title: description });
      Object.assign(input, { min: String(minimum), max: String(maximum), step: String(step_of(minimum, maximum)) });
      input.value = String(value);
      input.addEventListener('input', () => { output.textContent = input.value; });
      input.addEventListener('change', () => { now = changed(now, group, name, Number(input.value)); change(now); });
      return [el('label', {}, el('span', {}, spoken(name)), input, output)];
    });
    return rows.length > 0 ? [el('fieldset', {}, el('legend', {}, spoken(group)), ...rows)] : [];
  });
}
