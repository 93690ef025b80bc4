// The official inspector against a server: the schemas of all tools are portable, and its calls are answered.
import assert from 'node:assert/strict';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, run, serve } from '../http/support.mjs';

const node = process.env.SEEDMESH_NEWER_NODE ?? process.execPath;
const inspector = path.join(import.meta.dirname, 'node_modules/.bin/mcp-inspector');
let server;
before(async () => { server = await serve(program); });
after(() => server?.stop());

/** Inspector: --cli URL --transport http, then the arguments. Resolves to its status and output. */
async function inspect(...args) {
  const { status, out, err } = await run(node, [inspector, '--cli', `${server.url}/mcp`, '--transport', 'http', ...args]);
  return { status, out: out.toString(), err: err.toString() };
}

test('--strict reports no schema that some client could not read', async () => {
  const { status, out, err } = await inspect('--method', 'tools/list', '--strict');
  assert.equal(status, 0, err + out);
  assert.equal(JSON.parse(out).tools.length, 6);
});

test('resources and prompts are listed', async () => {
  const resources = await inspect('--method', 'resources/list'), prompts = await inspect('--method', 'prompts/list');
  assert.deepEqual([resources.status, prompts.status], [0, 0], resources.err + prompts.err);
  assert.ok(JSON.parse(resources.out).resources.length > 10);
  assert.equal(JSON.parse(prompts.out).prompts.length, 3);
});

test('a tool is called', async () => {
  const { status, out, err } = await inspect('--method', 'tools/call', '--tool-name', 'generate', '--tool-arg', 'preset=menger_sponge', 'seed=3');
  assert.equal(status, 0, err + out);
  assert.match(out, /menger_sponge_3\.glb/);
});
