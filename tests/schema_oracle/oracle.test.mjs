// The readers made from the schemas against ajv: the same documents, drawn by seed, get the same verdict from both.
import { test } from 'node:test';
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import Ajv from 'ajv';
import Ajv2020 from 'ajv/dist/2020.js';
import { Dice, draw, spoil } from './draw.mjs';

const root = path.resolve(import.meta.dirname, '../..');
const build = process.env.SEEDMESH_BUILD ?? path.join(root, 'build/release');
const openapi = JSON.parse(fs.readFileSync(path.join(build, 'generated/openapi.json'), 'utf8'));
const annotations = ['x-unit', 'x-group', 'x-step', 'x-order', 'x-advanced', 'x-grammar', 'x-cpp-name', 'x-widget', 'x-steps', 'x-full', 'x-short', 'x-formats', 'x-formats-where', 'x-files', 'x-motions', 'x-applies-when'];

const document_count = 2000;
const schemas = ['lsystem', 'tree', 'fractal', 'terrain', 'scene', 'output', 'request'];

/** Takes out the requests inside a request, and what cannot be without one: readers judge them by their own generator's schema, too, which ajv cannot. */
function without_children(schema) {
  const needs_one = (member) => member['x-widget'] === 'request' || (member.required ?? []).some((key) => needs_one(member.properties?.[key] ?? {})) || (member.items && needs_one(member.items));
  for (const [key, member] of Object.entries(schema.properties ?? {})) {
    if (needs_one(member)) delete schema.properties[key];
    else without_children(member);
  }
  if (schema.oneOf) schema.oneOf = schema.oneOf.filter((part) => !needs_one(part));
  for (const part of [schema.items, schema.additionalProperties, ...(schema.oneOf ?? [])]) if (part && typeof part === 'object') without_children(part);
  return schema;
}

/** A schema as it is served: without references; the request leaves the parameters open. */
function served(name) {
  const { schemas } = openapi.components;
  const schema = without_children(structuredClone(schemas[name]));
  if (name === 'request') Object.assign(schema.properties, { parameters: { type: 'object', additionalProperties: true }, output: schemas.output });
  return schema;
}

function judge(name, documents) {
  const input = documents.map((document) => `${name} ${JSON.stringify(document)}\n`).join('');
  const output = execFileSync(path.join(build, 'tests/schema_oracle/judge_requests'), { input, maxBuffer: 1 << 28 });
  return output.toString().trim().split('\n').map((line) => JSON.parse(line));
}

const exists = (document, pointer) => {
  let at = document;
  for (const token of pointer.split('/').slice(1)) {
    const key = token.replaceAll('~1', '/').replaceAll('~0', '~');
    if (at === null || typeof at !== 'object' || !Object.hasOwn(at, key)) return false;
    at = at[key];
  }
  return true;
};

/** The places ajv complains about, as our contract points at them. Of alternatives only the whole counts. */
function pointers(errors) {
  const places = errors.map((error) => {
    const token = (key) => '/' + key.replaceAll('~', '~0').replaceAll('/', '~1');
    if (error.keyword === 'additionalProperties') return error.instancePath + token(error.params.additionalProperty);
    if (error.keyword === 'propertyNames') return error.instancePath + token(error.params.propertyName);
    return error.propertyName === undefined ? error.instancePath : error.instancePath + token(error.propertyName);
  });
  return [...new Set(places)];
}

for (const name of schemas) {
  const dice = new Dice(name.length);
  const schema = served(name);
  const documents = Array.from({ length: document_count }, (_, i) => (i % 2 ? spoil(draw(schema, dice), dice) : draw(schema, dice)));
  const verdicts = judge(name, documents);

  for (const [dialect, Validator] of [['Draft 7', Ajv], ['2020-12', Ajv2020]]) {
    test(`${name}: ${document_count} documents get the verdict of ajv (${dialect})`, () => {
      const ajv = new Validator({ allErrors: true, strict: true, strictTypes: false, allowUnionTypes: true });
      for (const word of annotations) ajv.addKeyword(word);
      const validate = ajv.compile(schema);
      let taken = 0;
      documents.forEach((document, i) => {
        const expected = validate(document);
        taken += expected ? 1 : 0;
        const text = JSON.stringify(document);
        assert.equal(verdicts[i].pointers.length === 0, expected, `${text}\nours ${JSON.stringify(verdicts[i].pointers)}\najv ${ajv.errorsText(validate.errors)}`);
        for (const pointer of verdicts[i].pointers) assert.ok(exists(document, pointer), `${text}: ${pointer} is nowhere`);
        if (expected) return;
        // Each pointer of ajv is one of ours, or above or below one of ours: our reader selects an alternative earlier.
        const near = (a, b) => a === b || a.startsWith(`${b}/`) || b.startsWith(`${a}/`);
        for (const pointer of pointers(validate.errors)) assert.ok(verdicts[i].pointers.some((ours) => near(ours, pointer)), `${text}: ajv points at "${pointer}", we at ${verdicts[i].pointers}`);
      });
      assert.ok(taken >= document_count / 2 && taken < document_count, `${taken} documents were in order`);
    });
  }

  test(`${name}: the canonical form reads as the same parameters, and writes as itself`, () => {
    documents.forEach((document, i) => assert.ok(verdicts[i].stable, JSON.stringify(document)));
  });

  test(`${name}: JavaScript prints the canonical form as we do`, () => {
    const sorted = (value) => {
      if (Array.isArray(value)) return value.map(sorted);
      if (value === null || typeof value !== 'object') return value;
      return Object.fromEntries(Object.keys(value).sort().map((key) => [key, sorted(value[key])]));
    };
    verdicts.filter((verdict) => verdict.pointers.length === 0).forEach(({ canonical }) => assert.equal(canonical, JSON.stringify(sorted(JSON.parse(canonical)))));
  });
}

test('the default of every parameter is one that its schema takes', () => {
  const ajv = new Ajv({ strict: false });
  const visit = (schema) => {
    if (schema.default !== undefined) assert.ok(ajv.validate(schema, schema.default), JSON.stringify(schema));
    for (const example of schema.examples ?? []) assert.ok(ajv.validate(schema, example), JSON.stringify(example));
    Object.values(schema.properties ?? {}).forEach(visit);
    if (schema.items) visit(schema.items);
    (schema.oneOf ?? []).forEach(visit);
  };
  for (const name of schemas) visit(served(name));
});
