/**
 * The subset of JSON Schema that api_schema uses, with its x- keywords. The form depends on these and on no parameter
 * name.
 */

export interface Schema {
  title?: string;
  description?: string;
  type?: 'object' | 'array' | 'string' | 'number' | 'integer' | 'boolean' | 'null';
  properties?: Record<string, Schema>;
  additionalProperties?: boolean | Schema;
  required?: string[];
  items?: Schema;
  minItems?: number;
  maxItems?: number;
  enum?: unknown[];
  const?: unknown;
  oneOf?: Schema[];
  default?: unknown;
  minimum?: number;
  maximum?: number;
  pattern?: string;
  maxLength?: number;
  examples?: unknown[];
  'x-group'?: string;
  'x-unit'?: string;
  'x-step'?: number;
  /** The value counts rewriting steps: each step multiplies the size of the model. */
  'x-steps'?: boolean;
  'x-advanced'?: boolean;
  'x-widget'?: string;
  /** The sibling member whose value applies if this one is omitted, and which is also its upper bound. */
  'x-full'?: string;
  'x-grammar'?: string;
  /** In the output schema: the formats of all models. In a generator's schema: its additional formats. */
  'x-formats'?: string[];
  /** The formats that require a certain parameter value. */
  'x-files'?: Record<string, Record<string, unknown>>;
  'x-formats-where'?: Record<string, Record<string, unknown>>;
  /** In a generator's schema: the output members that animate its models. */
  'x-motions'?: string[];
  /** The members of the object form that the single number of the short form sets. */
  'x-short'?: string[];
}

export type Members = Record<string, unknown>;

export const is_members = (value: unknown): value is Members =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

export const same = (a: unknown, b: unknown): boolean => JSON.stringify(a) === JSON.stringify(b);

/** True if `value` has the type that `schema` requires. The server checks the ranges. */
export function fits(schema: Schema, value: unknown): boolean {
  if ('const' in schema) return same(schema.const, value);
  if (schema.enum) return schema.enum.includes(value);
  if (schema.oneOf) return schema.oneOf.some((one) => fits(one, value));
  switch (schema.type) {
    case 'object': return is_members(value);
    case 'array': return Array.isArray(value);
    case 'integer': return Number.isInteger(value);
    case 'null': return value === null;
    default: return typeof value === schema.type;
  }
}

/** The initial value of a new entry. */
export function fresh_value(schema: Schema): unknown {
  if (schema.default !== undefined) return structuredClone(schema.default);
  if (schema.examples?.length) return structuredClone(schema.examples[0]);
  if ('const' in schema) return schema.const;
  if (schema.enum) return schema.enum[0];
  if (schema.oneOf?.[0]) return fresh_value(schema.oneOf[0]);
  switch (schema.type) {
    case 'object': {
      const members: Members = {};
      for (const name of schema.required ?? []) members[name] = fresh_value(schema.properties?.[name] ?? {});
      return members;
    }
    case 'array': return Array.from({ length: schema.minItems ?? 0 }, () => fresh_value(schema.items ?? {}));
    case 'boolean': return false;
    case 'string': return schema['x-widget'] === 'color' ? '#808080' : '';
    case 'number':
    case 'integer': return Math.min(Math.max(0, schema.minimum ?? 0), schema.maximum ?? 0);
    default: return null;
  }
}

export const pointer_to = (parent: string, key: string | number): string =>
  `${parent}/${String(key).replaceAll('~', '~0').replaceAll('/', '~1')}`;
