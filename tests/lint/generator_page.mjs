#!/usr/bin/env node
// docs/add-a-generator.md against the generator that the tests build in the way it describes, tests/generators/toy: every code block
// is a part of the files there, every path is one of this tree (with an existing generator in place of the page's), and the CMake
// files are those that list generators.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

const root = process.argv[2] ?? '.';
const toy = 'tests/generators/toy';
const page_name = 'docs/add-a-generator.md';
const read = (file) => fs.readFileSync(path.join(root, file), 'utf8');
const page = read(page_name);
const collapsed = (text) => text.replace(/\s+/g, ' ').trim();
const blocks = (language) => [...page.matchAll(new RegExp(`^\`\`\`${language}\\n([\\s\\S]*?)^\`\`\`$`, 'gm'))].map((match) => match[1]);
const folders = (top) => fs.readdirSync(path.join(root, top), { withFileTypes: true, recursive: true });
const cmake_files = ['CMakeLists.txt', ...folders('core').filter(({ name }) => name === 'CMakeLists.txt').map((entry) => path.join(entry.parentPath ?? entry.path, entry.name))]
  .map((file) => path.relative(root, path.resolve(root, file)));

const checks = {
  'C++ blocks stand in the sources of the toy': () => {
    const sources = fs.readdirSync(path.join(root, toy)).filter((file) => /\.(h|cpp)$/.test(file)).map((file) => collapsed(read(`${toy}/${file}`)));
    assert.ok(blocks('cpp').length);
    for (const block of blocks('cpp')) assert.ok(sources.some((text) => text.includes(collapsed(block))), block);
  },
  'JSON blocks are members of its schema, and its preset': () => {
    const schema = JSON.parse(read(`${toy}/cone.schema.json`)), preset = JSON.parse(read(`${toy}/leaning.json`));
    assert.ok(blocks('json').length);
    for (const block of blocks('json')) {
      if (block.startsWith('{')) assert.deepEqual(JSON.parse(block), preset);
      else for (const [name, value] of Object.entries(JSON.parse(`{${block}}`))) assert.deepEqual(value, schema.properties[name], name);
    }
  },
  'CMake blocks call a function of ours with libraries of ours': () => {
    const text = cmake_files.map(read).join('\n');
    assert.ok(blocks('cmake').length);
    for (const block of blocks('cmake')) {
      const [, name, words] = /^(\w+)\(([^)]*)\)/.exec(block);
      assert.match(text, new RegExp(`^function\\(${name} `, 'm'), name);
      for (const library of words.split(/\s+/).filter((word) => word.startsWith('seedmesh_')))
        assert.match(text, new RegExp(`^seedmesh_library\\(${library.slice('seedmesh_'.length)}\\b`, 'm'), library);
    }
  },
  'every path is there, for a generator that is': () => {
    const named = [...page.matchAll(/`((?:core|api_schema|tests|docs)\/[\w./-]+)`|\]\(\.\.\/([\w./-]+)\)/g)].map((match) => match[1] ?? match[2]);
    assert.ok(named.length > 5);
    for (const each of named) {
      const here = each.startsWith(toy) ? each : each.replace(/\bcone\b/g, 'fractal').replace(/\/leaning\.json$/, '');
      assert.ok(fs.existsSync(path.join(root, here)), `${each} (looked for ${here})`);
    }
  },
  'the CMake files are those that name a generator': () => {
    const listing = cmake_files.filter((file) => /add_subdirectory\(fractal\)|seedmesh_fractal\b/.test(read(file)));
    const named = [...page.matchAll(/`([\w/]*CMakeLists\.txt)`/g)].map((match) => match[1].replace(/\bcone\b/, 'fractal'));
    for (const file of listing) assert.ok(named.includes(file), `${file} names every generator, and the page does not name the file`);
    for (const file of named) assert.ok(listing.includes(file) || file === 'core/generators/fractal/CMakeLists.txt', `${file} names no generator`);
  },
};

let failed = 0;
for (const [name, check] of Object.entries(checks)) {
  try {
    check();
  } catch (error) {
    failed += 1;
    console.log(`${page_name}: not so: ${name}\n  ${error.message.replaceAll('\n', '\n  ')}`);
  }
}
console.log(`${Object.keys(checks).length - failed} passed, ${failed} failed`);
process.exitCode = failed ? 1 : 0;
