// The TypeScript client: packed, installed elsewhere, compiled against, run in Node and drawn in Chromium.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { launch } from '../browser/chromium.mjs';
import { program, run, serve } from '../http/support.mjs';

const root = path.resolve(import.meta.dirname, '../..');
const tools = path.join(root, 'web_client/node_modules');
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-js-'));
const source = path.join(folder, 'source'), project = path.join(folder, 'project');
const tsc = (...args) => run(path.join(tools, '.bin/tsc'), args);
const npm = (cwd, ...args) => run('npm', [...args, '--prefix', cwd, '--no-audit', '--no-fund', '--offline'], { env: { npm_config_cache: path.join(folder, 'cache') } });
let server;

before(async () => {
  server = await serve(program, ['--cors-origins', '*']);
  fs.cpSync(path.join(root, 'clients/js'), source, { recursive: true });
  fs.symlinkSync(tools, path.join(source, 'node_modules'));
  // Packing compiles the package, as in a fresh checkout.
  const packed = await run('npm', ['pack', source, '--pack-destination', folder, '--silent', '--offline'], { env: { npm_config_cache: path.join(folder, 'cache') } });
  assert.equal(packed.status, 0, packed.err);
  fs.mkdirSync(project);
  fs.writeFileSync(path.join(project, 'package.json'), '{"name": "elsewhere", "private": true, "type": "module"}');
  const installed = await npm(project, 'install', path.join(folder, packed.out.toString().trim()));
  assert.equal(installed.status, 0, installed.err);
  fs.symlinkSync(path.join(root, 'tests/node_modules/three'), path.join(project, 'node_modules/three'));
  fs.symlinkSync(path.join(tools, '@types'), path.join(project, 'node_modules/@types'));
  fs.cpSync(path.join(source, 'tests'), path.join(project, 'tests'), { recursive: true });
});
after(async () => {
  await server?.stop();
  fs.rmSync(folder, { recursive: true });
});

test('the package has its modules, types and page, and no dependency', () => {
  const installed = path.join(project, 'node_modules/@seedmesh/client');
  const { dependencies } = JSON.parse(fs.readFileSync(path.join(installed, 'package.json'), 'utf8'));
  assert.equal(dependencies, undefined);
  const names = fs.readdirSync(installed, { recursive: true });
  for (const name of ['README.md', 'dist/index.js', 'dist/index.d.ts', 'dist/three.js', 'dist/copies.js', 'dist/types.d.ts']) assert.ok(names.includes(name), name);
  assert.ok(!names.some((name) => name.startsWith('src') || name.startsWith('tests')));
});

test('an unknown parameter does not compile', async () => {
  const options = ['--noEmit', '--strict', '--skipLibCheck', '--target', 'es2022', '--module', 'nodenext'];
  const { status, out } = await tsc('--ignoreConfig', ...options, path.join(project, 'tests/types.ts'));
  assert.equal(status, 0, out.toString());
  const unused = path.join(project, 'tests/unused.ts');
  fs.writeFileSync(unused, fs.readFileSync(path.join(project, 'tests/types.ts'), 'utf8').replace("{ axioms: 'F' } }", "{ axiom: 'F' } }"));
  const refused = await tsc('--ignoreConfig', ...options, unused);
  assert.match(refused.out.toString(), /error TS2578: Unused '@ts-expect-error'/);
});

test('the tests of the package pass against a real server', async () => {
  const { status, out } = await run(process.execPath, ['--test', '--test-reporter=tap', path.join(project, 'tests/client.test.mjs')],
    { env: { SEEDMESH_URL: server.url, NODE_TEST_CONTEXT: undefined } });
  assert.equal(status, 0, out.toString());
  assert.match(out.toString(), /^# pass 11$/m);
});

test('the model sways in Chromium', async () => {
  const folders = { '/three/': path.join(root, 'tests/node_modules/three'), '/client/': path.join(project, 'node_modules/@seedmesh/client/dist'), '/': path.join(project, 'tests') };
  const pages = http.createServer((request, response) => {
    const [prefix, base] = Object.entries(folders).find(([each]) => request.url.startsWith(each));
    const file = path.join(base, request.url.slice(prefix.length));
    if (!fs.existsSync(file)) { response.writeHead(404).end(); return; }
    response.writeHead(200, { 'content-type': file.endsWith('.html') ? 'text/html' : 'text/javascript' }).end(fs.readFileSync(file));
  });
  await new Promise((resolve) => { pages.listen(0, '127.0.0.1', resolve); });
  const browser = await launch();
  try {
    const page = await browser.newPage();
    const errors = [];
    page.on('pageerror', (error) => errors.push(error.message));
    page.on('console', (message) => { if (message.type() === 'error' && !/favicon/.test(message.location().url)) errors.push(message.text()); });
    await page.goto(`http://127.0.0.1:${pages.address().port}/wind.html#${server.url}`);
    await page.waitForFunction(() => window.result !== undefined, null, { timeout: 60_000 }).catch((error) => { throw new Error(`${error.message}\n${errors.join('\n')}`); });
    const { dark, in_calm, in_wind } = await page.evaluate(() => window.result);
    assert.deepEqual(errors, []);
    assert.ok(dark > 0.1 && dark < 0.9, `${dark} of the picture is a tree`);
    assert.equal(in_calm, 0);
    assert.ok(in_wind > 1000, `${in_wind} values differ`);
  } finally {
    await browser.close();
    pages.close();
  }
});
