// Draws documents from a schema by seed: valid ones, and ones with a few members spoiled.

/** A small generator of random numbers with a seed (xorshift of 32 bits), so that a failure can be drawn again. */
export class Dice {
  constructor(seed) { this.state = (seed * 2654435761) >>> 0 || 1; }
  next() {
    let x = this.state;
    x ^= x << 13; x >>>= 0; x ^= x >>> 17; x ^= x << 5;
    this.state = x >>> 0;
    return this.state / 2 ** 32;
  }
  below(count) { return Math.floor(this.next() * count); }
  pick(list) { return list[this.below(list.length)]; }
  chance(share) { return this.next() < share; }
}

const TEXTS = ['', 'F', 'F -> F[+F]F', 'é🌱', 'a b', '"\\', 'a_1', '#a0B1c2', 'glb', '007', 'lsystem', 'koch-island_2', '#12345', '1x'];
const FORMS = {
  '^#[0-9a-fA-F]{6}$': ['#000000', '#aBcDeF'],
  '^[A-Za-z_][A-Za-z0-9_]*$': ['r', '_a1', 'Zz'],
  '^[a-z0-9_-]+$': ['koch_island', 'a-1'],
  '^[0-9]{1,20}$': ['0', '007', '12345678901234567890'],
  '^[A-Za-z0-9_-]{1,64}$': ['oak', 'Old-oak_2'],
};
const ANYTHING = [null, true, false, 0, -1, 2.5, 1e30, -1e-7, 5.0, '', 'text', '#ffffff', [], ['F'], [1, 2, 3], {}, { a: 1 }, { value: 1 }, { yaw: 3 }];

function drawNumber(schema, dice) {
  const low = schema.minimum ?? schema.exclusiveMinimum ?? -1000, high = schema.maximum ?? low + 2000;
  const edge = [schema.minimum, schema.maximum, schema.default].filter((x) => x !== undefined && x <= Number.MAX_SAFE_INTEGER); // JavaScript cannot write 2^64 - 1
  if (edge.length && dice.chance(0.3)) return dice.pick(edge);
  const top = Math.min(high, 1e6);
  const x = low + dice.next() * (top - low) + (schema.exclusiveMinimum === undefined ? 0 : 1e-9);
  return schema.type === 'integer' ? Math.min(high, Math.max(low, Math.round(x))) : x;
}

function drawText(schema, dice) {
  if (schema.enum) return dice.pick(schema.enum);
  if (schema.pattern) return dice.pick(FORMS[schema.pattern]);
  const fitting = TEXTS.filter((t) => [...t].length >= (schema.minLength ?? 0) && [...t].length <= (schema.maxLength ?? Infinity));
  return dice.pick(fitting);
}

function drawObject(schema, dice) {
  const object = {};
  if (schema.additionalProperties && schema.additionalProperties !== true) {
    const keys = schema.propertyNames ? FORMS[schema.propertyNames.pattern] : TEXTS;
    for (let i = dice.below(3); i > 0; i--) object[dice.pick(keys)] = draw(schema.additionalProperties, dice);
  }
  for (const [name, property] of Object.entries(schema.properties ?? {})) {
    if ((schema.required ?? []).includes(name) || dice.chance(0.4)) object[name] = draw(property, dice);
  }
  return object;
}

/** A document that the schema takes. */
export function draw(schema, dice) {
  if (schema.oneOf) return draw(dice.pick(schema.oneOf), dice);
  switch (schema.type) {
    case 'object': return drawObject(schema, dice);
    case 'array': {
      const least = schema.minItems ?? 0, most = Math.min(schema.maxItems ?? 4, least + 4);
      return Array.from({ length: least + dice.below(most - least + 1) }, () => draw(schema.items, dice));
    }
    case 'string': return drawText(schema, dice);
    case 'boolean': return dice.chance(0.5);
    default: return drawNumber(schema, dice);
  }
}

/** Every place inside a document: [holder, key]. */
function places(value, found = []) {
  if (value === null || typeof value !== 'object') return found;
  for (const key of Object.keys(value)) {
    found.push([value, key]);
    places(value[key], found);
  }
  return found;
}

/** Changes one to three places of the document: another value, another key, a member more or less, a number at the edge. */
export function spoil(document, dice) {
  const holder = { document: structuredClone(document) };
  for (let count = 1 + dice.below(3); count > 0; count--) {
    const [at, key] = dice.pick(places(holder));
    const value = at[key];
    switch (dice.below(6)) {
      case 0: at[key] = structuredClone(dice.pick(ANYTHING)); break;
      case 1: if (!Array.isArray(at) && at !== holder) { at[key + 'x'] = value; delete at[key]; } break;
      case 2: if (at !== holder && !Array.isArray(at)) delete at[key]; break;
      case 3: if (value && typeof value === 'object' && !Array.isArray(value)) value[dice.pick(TEXTS)] = structuredClone(dice.pick(ANYTHING)); break;
      case 4: if (typeof value === 'number') at[key] = dice.pick([value + 1e9, -value - 1, value + 0.5, value * 1000]); break;
      default: if (Array.isArray(value)) value.push(structuredClone(dice.pick(ANYTHING))); else if (typeof value === 'string') at[key] = value + dice.pick(TEXTS);
    }
  }
  return holder.document;
}
