/** Selects the kind of field for a value by its schema. */
import { attributes_field } from './attributes_field';
import type { Draw } from './field';
import { list_field, map_field, object_field, variant_field } from './group_fields';
import { placement_field } from './placement_field';
import { colors_field, image_field, request_field, vector_field } from './row_fields';
import { is_members, type Schema } from './schema';
import { choice_field, color_field, json_field, number_field, rows_field, switch_field, word_field } from './simple_fields';
import { text_field } from './text_field';
import { texture_field } from './texture_field';

/** Selects a list field: any items, a fixed number of numbers, colours, or lines of text. */
function list_for({ items, minItems, maxItems }: Schema): Draw {
  if (!items) return json_field;
  const is_number = items.type === 'number' || items.type === 'integer';
  if (is_number && minItems !== undefined && minItems === maxItems && minItems <= 16) return vector_field;
  if (items['x-widget'] === 'color') return colors_field;
  return items.type === 'string' ? text_field : list_field;
}

/** Draws the field that fits the schema. */
function field_for(schema: Schema): Draw {
  if (schema.enum) return schema['x-widget'] === 'texture' ? texture_field : choice_field;
  if (schema.oneOf) {
    const types = schema.oneOf.map((one) => one.type);
    return types.every((type) => type === 'number' || type === 'integer' || type === 'string') ? word_field : variant_field;
  }
  switch (schema.type) {
    case 'number':
    case 'integer': return number_field;
    case 'boolean': return switch_field;
    case 'string':
      if (schema['x-widget'] === 'color') return color_field;
      if (schema['x-widget'] === 'image' || schema['x-widget'] === 'heights') return image_field;
      return schema['x-grammar'] && schema['x-grammar'] !== 'expression' ? text_field : word_field;
    case 'array':
      if (schema['x-widget'] === 'placement') return placement_field;
      return schema['x-widget'] === 'json' ? rows_field : list_for(schema);
    case 'object':
      if (schema['x-widget'] === 'request') return request_field;
      if (schema['x-widget'] === 'attributes') return attributes_field;
      if (schema.properties) return object_field;
      return is_members(schema.additionalProperties) ? map_field : json_field;
    default: return json_field;
  }
}

export const draw_field: Draw = (spec) => field_for(spec.schema)(spec);
