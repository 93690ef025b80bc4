// Requests and checks that the contract tests share.
import assert from 'node:assert/strict';
import zlib from 'node:zlib';

export const plant = { generator: 'lsystem', seed: 3, parameters: { axiom: 'X', productions: ['X -> F[+X]F[-X]+X', 'F -> FF'], iterations: 4, angle: 20 } };
export const random = (seed) => ({ ...plant, seed, parameters: { ...plant.parameters, productions: ['X -> F[+X]F[-X]+X : 0.5', 'X -> F[-X]F[+X]-X : 0.5', 'F -> FF'] } });
export const word = (answer) => answer.json?.type?.split(/[#/]/).pop();

export function is_problem(answer, status, kind) {
  assert.equal(answer.status, status, answer.text.slice(0, 300));
  assert.match(answer.type, /^application\/problem\+json/);
  assert.equal(answer.json.status, status);
  assert.ok(answer.json.title && answer.json.detail);
  assert.equal(answer.json.instance, answer.headers['x-request-id']);
  assert.equal(answer.headers['cache-control'], 'no-store');
  if (kind) assert.equal(word(answer), kind);
}

export function is_glb(bytes) {
  assert.equal(bytes.subarray(0, 4).toString(), 'glTF');
  assert.equal(bytes.readUInt32LE(8), bytes.length);
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
}

/** A token as anybody can make one. */
export const token_of = (object) => zlib.deflateRawSync(Buffer.from(JSON.stringify(object))).toString('base64url');
export const opened = (link) => JSON.parse(zlib.inflateRawSync(Buffer.from(/models\/([^.]+)\./.exec(link)[1], 'base64url')).toString());

/** A system in Fractint's notation. */
export const koch = 'Koch {\n  Angle 6\n  Axiom F--F--F\n  F=F+F--F+F\n}\n';
