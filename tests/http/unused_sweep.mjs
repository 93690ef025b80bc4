#!/usr/bin/env node
// Sets each parameter of a generator alone to other values, in every preset, and lists those that change neither the bytes nor the
// warnings. Some of these are right: a limit that no position exceeds, or a colour that is the same. A person has to judge them.
//   unused_sweep.mjs GENERATOR [milliseconds of the slowest preset] [file with requests instead of presets: {name: request}]
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { argv, exit } from 'node:process';
import { program, serve } from './support.mjs';

const most_values = 6, shown = 6;
const text = JSON.stringify;

/** The forms of a value: the alternatives of its schema. */
function forms(schema) {
  const alternatives = schema.oneOf ?? schema.anyOf;
  return alternatives ? alternatives.flatMap(forms) : [schema];
}

/** Numbers that differ from the present one and lie in the range of the schema. */
function numbers(form, fallback, now) {
  const least = form.minimum ?? form.exclusiveMinimum ?? -1000, most = form.maximum ?? form.exclusiveMaximum ?? 1000;
  const usual = least <= 1 && most >= 1 ? 1 : (least + Math.min(most, least + 10)) / 2;
  const base = [now, form.default, fallback, usual].find((each) => typeof each === 'number');
  const whole = (value) => (form.type === 'integer' ? Math.round(value) : value);
  const all = [base * 1.37 + 0.013, base * 0.61, base + 1].map((each) => Math.min(Math.max(whole(each), least), most));
  return all.filter((each) => each !== base).slice(0, 2);
}

/** An object with one member, and with those that are required beside it. */
function objects(form) {
  return Object.entries(form.properties).flatMap(([name, member]) => {
    const [value] = values(member);
    if (value === undefined) return [];
    const made = {};
    for (const required of form.required ?? []) [made[required]] = values(form.properties[required] ?? {});
    return [{ ...made, [name]: value }];
  });
}

/** Values of a parameter other than the present one or, without one, the default. */
function values(schema, now) {
  const found = [];
  for (const form of forms(schema)) {
    if (form.const !== undefined) found.push(form.const);
    else if (form.enum) found.push(...form.enum);
    else if (form.type === 'boolean') found.push(true, false);
    else if (form.type === 'number' || form.type === 'integer') found.push(...numbers(form, schema.default, now));
    else if (form.type === 'string' && /0-9a-f/.test(form.pattern ?? '')) found.push('#c01874');
    else if (schema.examples ?? form.examples) found.push(...(form.examples ?? schema.examples));
    else if (form.type === 'object' && form.properties && now === undefined) found.push(...objects(form));
  }
  const present = text(now === undefined ? schema.default : now);
  return found.filter((each) => text(each) !== present).slice(0, most_values);
}

/** All parameters of a schema as [path, schema, present value]. Of lists and maps, the first entry stands for all. */
function* leaves(schema, parameters, path = []) {
  for (const [name, member] of Object.entries(schema.properties ?? {})) {
    const now = parameters?.[name], here = [...path, name];
    yield [here, member, now];
    if (member['x-widget'] === 'request') continue;
    for (const form of forms(member)) {
      if (form.type === 'object' && form.properties) yield* leaves(form, Array.isArray(now) ? undefined : now, here);
      const entry = form.type === 'array' ? form.items : form.additionalProperties;
      const first = now && typeof now === 'object' ? Object.keys(now)[0] : undefined;
      if (!entry || typeof entry !== 'object' || first === undefined) continue;
      yield [[...here, Array.isArray(now) ? 0 : first], entry, now[first]];
      for (const each of forms(entry)) yield* leaves(each, now[first], [...here, Array.isArray(now) ? 0 : first]);
    }
  }
}

function changed(request, path, value) {
  const made = structuredClone(request);
  let place = made.parameters;
  for (const name of path.slice(0, -1)) {
    if (typeof place[name] !== 'object' || place[name] === null) place[name] = {};
    place = place[name];
  }
  place[path.at(-1)] = value;
  return made;
}

/** What a request yields, without its own account of itself. */
async function outcome(server, request) {
  const { status, bytes, headers, json } = await server.generate(request);
  if (status !== 200) return `refused ${json?.errors?.[0]?.pointer ?? status} ${json?.errors?.[0]?.message ?? ''}`;
  const hash = createHash('md5');
  if (bytes.subarray(0, 4).toString() !== 'glTF') return hash.update(bytes).digest('hex');
  const length = bytes.readUInt32LE(12), document = JSON.parse(bytes.subarray(20, 20 + length));
  const warnings = document.asset.extras?.warnings;
  delete document.asset.extras;
  return hash.update(text([document, warnings, headers['seedmesh-warnings']])).update(bytes.subarray(20 + length)).digest('hex');
}

async function sweep(server, schema, name, request, slowest, found) {
  const base = { ...request, parameters: request.parameters ?? {}, output: { ...request.output, provenance: 'none', name: 'model' } };
  const plain = await outcome(server, base);
  const begun = performance.now();
  await outcome(server, { ...base, seed: 987654321 });  // not from the cache
  if (performance.now() - begun > slowest || plain.startsWith('refused')) return console.log(`skipped ${name}`);
  for (const [path, member, now] of leaves(schema, base.parameters)) {
    const key = path.join('/').replace(/\b\d+\b/g, '#');
    for (const value of values(member, now)) {
      const made = await outcome(server, changed(base, path, value));
      if (!found.has(key)) found.set(key, { silent: [], effective: 0, refused: 0 });
      const entry = found.get(key);
      if (made === plain) entry.silent.push(`${name} ${text(value).slice(0, 60)}`);
      else if (made.startsWith('refused')) entry.refused += 1;
      else entry.effective += 1;
    }
  }
}

const [generator, slowest = '40', file] = argv.slice(2);
const server = await serve(program, ['--threads', '1', '--log-level', 'error']);
const known = (await server.get('/v1/presets')).json.presets.filter((each) => each.generator === generator);
if (known.length === 0) {
  console.error(`found ${generator}; expected the name of a generator`);
  exit(2);
}
const requests = file ? JSON.parse(readFileSync(file)) : {};
for (const { name } of file ? [] : known) requests[name] = (await server.get(`/v1/presets/${name}`)).json;
const schema = (await server.get(`/v1/schemas/${generator}`)).json, found = new Map();
for (const [name, request] of Object.entries(requests)) await sweep(server, schema, name, request, Number(slowest), found);
let silent = 0;
for (const [key, entry] of found) {
  silent += entry.silent.length;
  if (entry.silent.length > 0)
    console.log(`${key}: ${entry.silent.length} without effect, ${entry.effective} with one, ${entry.refused} refused: ${entry.silent.slice(0, shown).join('; ')}`);
}
console.log(`${silent} settings of ${found.size} parameters changed neither bytes nor warnings`);
await server.stop();
