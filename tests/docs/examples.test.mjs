// Every example of README and docs/ is run: JSON blocks are requests that the built program accepts, shell and Python blocks end with
// status 0 against a running server. What cannot be run stands in a list below, with the reason.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { program, run, serve } from '../http/support.mjs';

const root = path.resolve(import.meta.dirname, '../..');
const read = (file) => fs.readFileSync(path.join(root, file), 'utf8');
const pages = ['README.md', 'CONTRIBUTING.md', 'deploy/README.md',
  ...fs.readdirSync(path.join(root, 'clients')).map((name) => `clients/${name}/README.md`).filter((file) => fs.existsSync(path.join(root, file))),
  ...fs.readdirSync(path.join(root, 'docs'), { recursive: true }).filter((file) => file.endsWith('.md')).map((file) => `docs/${file}`)].sort();

// Pages whose blocks another test compares with the code.
const covered_elsewhere = { 'docs/add-a-generator.md': 'tests/lint/generator_page.mjs compares its blocks with tests/generators/toy' };

// Commands that are not run here. Each pattern stands for whole lines of a block.
const not_run = [
  { line: /^python3 -m pip install /, reason: 'tests/clients/python.test.mjs installs the built wheel into an environment of its own' },
  { line: /^(\(cd clients\/js && npm install && npm pack\)|npm install \.\/clients\/js\/seedmesh-client-[\d.]+\.tgz)$/, reason: 'tests/clients/js.test.mjs packs the package and installs it without a network' },
  { line: /^\.\/dev \w+/, reason: 'tasks of ./dev take minutes; below, each is only looked up in the list of tasks' },
  { line: /^docker (build|run) /, reason: 'deploy/smoke.sh runs the image with the same options; this machine may have no container engine' },
];

// What an example takes for granted, and numbers that would take minutes.
const replaced = [
  [/http:\/\/(127\.0\.0\.1|localhost):8080/g, () => server.url],
  [/build\/release\/seedmesh/g, () => 'seedmesh'],
  [/\$\(seq 200\)/g, () => '$(seq 2)'],
  [/SEEDMESH_SIGNING_KEYS=…/g, () => `SEEDMESH_SIGNING_KEYS=2026a:${'5a'.repeat(32)}`],
];
const given_files = {
  'assets/oak.seedmesh': '{"preset": "oak", "seed": 7}\n',
  'request.json': '{"preset": "abop_1_24f", "seed": 7}\n',
  '.curlrc': 'fail-with-body\nsilent\nshow-error\n',  // an answer that is an error ends curl with a status
  'town.osm': '<osm version="0.6"><node id="1" lat="46" lon="14.5"/><node id="2" lat="46" lon="14.5002"/><node id="3" lat="46.0001" lon="14.5002"/><node id="4" lat="46.0001" lon="14.5"/><way id="5"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/><tag k="building" v="yes"/></way></osm>\n',
  'plant.l': 'Lsystem: 1\nderivation length: 2\nAxiom: A\nA --> F[+A]A\nendlsystem\n',
  'plant.v': 'angle factor: 12\n',
  'koch.l': 'Koch1 { ; two systems in the file\n Angle 6\n Axiom F--F--F\n F=F+F--F+F\n}\nKoch2 {\n Angle 12\n Axiom F---F---F---F\n F=F+F--F+F\n}\n',
};

/** The fenced blocks of a page: language, text, and line of the fence. */
function blocks_of(page) {
  const text = read(page);
  return [...text.matchAll(/^```(\w+(?: request file)?)\n([\s\S]*?)^```$/gm)].map((match) => ({
    page, language: match[1], text: match[2], line: text.slice(0, match.index).split('\n').length,
  }));
}

const blocks = pages.filter((page) => !covered_elsewhere[page]).flatMap(blocks_of);
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-docs-'));
let server;

before(async () => {
  server = await serve(program);
  fs.mkdirSync(path.join(folder, 'bin'));
  fs.symlinkSync(program, path.join(folder, 'bin', 'seedmesh'));
  fs.mkdirSync(path.join(folder, 'assets'));
  for (const [name, text] of Object.entries(given_files)) fs.writeFileSync(path.join(folder, name), text);
});
after(async () => {
  await server?.stop();
  fs.rmSync(folder, { recursive: true });
});

for (const block of blocks.filter(({ language }) => language === 'json')) {
  test(`${block.page}:${block.line}: the request is valid and gives a model`, async () => {
    const request = JSON.parse(block.text);
    const validated = await run(program, ['validate', '-'], { input: block.text });
    assert.equal(validated.status, 0, validated.err);
    assert.equal(JSON.parse(validated.out.toString()).valid, true);
    const made = await run(program, ['generate', '-', '-o', '-'], { input: block.text });
    assert.equal(made.status, 0, made.err);
    assert.ok(made.out.length > 100, `only ${made.out.length} bytes for ${JSON.stringify(request).slice(0, 80)}`);
  });
}

for (const block of blocks.filter(({ language }) => language === 'json request file')) {
  test(`${block.page}:${block.line}: sync makes every file that the request file names`, async () => {
    const place = fs.mkdtempSync(path.join(folder, 'sync-'));
    fs.writeFileSync(path.join(place, 'example.seedmesh'), block.text);
    const { status, out } = await run(program, ['sync', place]);
    assert.equal(status, 0, out.toString());
    for (const name of Object.keys(JSON.parse(block.text).outputs)) assert.ok(fs.statSync(path.join(place, name)).size > 1000, name);
  });
}

/** The lines of a shell block that are run, or nothing. */
function script_of(text) {
  const lines = text.split('\n').filter((line) => !not_run.some((each) => each.line.test(line)));
  const script = replaced.reduce((all, [pattern, by]) => all.replace(pattern, by), lines.join('\n'));
  return script.trim() ? script : '';
}

function environment() {
  return {
    PATH: `${path.join(folder, 'bin')}:${process.env.PATH}`,
    SEEDMESH_URL: server.url,
    PYTHONPATH: path.join(root, 'clients/python/src'),
    PYTHONDONTWRITEBYTECODE: '1',
    CURL_HOME: folder,
    hex: '5a'.repeat(32),
  };
}

for (const block of blocks.filter(({ language, text }) => language === 'sh' && text.split('\n').some((line) => line && !not_run.some((each) => each.line.test(line))))) {
  test(`${block.page}:${block.line}: the commands end with status 0`, async () => {
    const script = `set -euo pipefail; cd '${folder}'\n${script_of(block.text)}`;
    const { status, err, out } = await run('bash', ['-c', script], { env: environment() });
    assert.equal(status, 0, `${script}\n${err}${out.toString().slice(0, 2000)}`);
  });
}

for (const block of blocks.filter(({ language }) => language === 'python')) {
  test(`${block.page}:${block.line}: the Python code ends with status 0`, async () => {
    const { status, err } = await run('bash', ['-c', `cd '${folder}' && python3 -`], { input: block.text, env: environment() });
    assert.equal(status, 0, err);
  });
}

for (const page of pages.filter((each) => /^docs\/[^/]+$/.test(each))) {
  test(`${page} opens with a picture, an example, and a sentence on when to use it`, () => {
    const opening = read(page).split(/^## /m)[0];
    assert.match(opening, /^!\[|^```mermaid$/m);
    assert.match(opening, covered_elsewhere[page] ? /^```/m : /^```(json|sh)$/m);
    assert.match(opening, /^(Use|Read this page) /m);
  });
}

test('curl of the README wrote a GLB', () => {
  assert.equal(fs.readFileSync(path.join(folder, 'plant.glb')).subarray(0, 4).toString(), 'glTF');
});

test('every task of ./dev that a page names is one', () => {
  const tasks = new Set([...read('dev').matchAll(/^#: (\w+)/gm)].map((match) => match[1]));
  const named = pages.flatMap((page) => [...read(page).matchAll(/\.\/dev (\w+)/g)].map((match) => ({ page, task: match[1] })));
  assert.ok(named.length > 10);
  assert.deepEqual(named.filter(({ task }) => !tasks.has(task)), []);
});

test('each exception is still needed', () => {
  const shell = pages.flatMap(blocks_of).filter(({ language }) => language === 'sh').flatMap(({ text }) => text.split('\n'));
  for (const { line, reason } of not_run) assert.ok(shell.some((each) => line.test(each)), `no command is left for: ${reason}`);
  for (const page of Object.keys(covered_elsewhere)) assert.ok(blocks_of(page).length, page);
});
