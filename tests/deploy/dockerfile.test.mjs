// What the Dockerfile copies is in the context that .dockerignore leaves, by the rules of Docker and of buildah.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';

const root = path.resolve(import.meta.dirname, '../..');
const tracked = execFileSync('git', ['ls-files'], { cwd: root, encoding: 'utf8', maxBuffer: 1 << 26 }).trim().split('\n');

/** One line of .dockerignore as a test of a path. Docker cleans a pattern like a path: a slash at its end means nothing. */
function matcher(line) {
  const pattern = path.posix.normalize(line).replace(/^\/|\/$/g, '');
  const source = pattern.split(/(\*\*\/|\*\*|\*|\?)/).map((piece) => ({ '**/': '(.*/)?', '**': '.*', '*': '[^/]*', '?': '[^/]' })[piece] ?? piece.replace(/[.+^${}()|[\]\\]/g, '\\$&')).join('');
  return new RegExp(`^${source}(/.*)?$`);
}

const ignored_by = (lines) => {
  const rules = lines.filter((line) => line && !line.startsWith('#')).map(matcher);
  return (file) => rules.some((rule) => rule.test(file));
};

test('a pattern that ends with a slash matches files as well', () => {
  assert.ok(ignored_by(['docs/*/'])('docs/worlds.md'));
  assert.ok(!ignored_by(['docs/*/*'])('docs/worlds.md'));
  assert.ok(ignored_by(['docs/*/*'])('docs/pictures/page.webp'));
  assert.ok(ignored_by(['**/node_modules'])('web_client/node_modules/vite/package.json'));
  assert.ok(!ignored_by(['tests'])('docs/tests.md'));
});

test('every file that the build reads is in the context of the image', () => {
  const lines = fs.readFileSync(path.join(root, '.dockerignore'), 'utf8').split('\n');
  assert.ok(lines.every((line) => !line.startsWith('!')), 'this test does not read exceptions');
  const ignored = ignored_by(lines);
  const copied = fs.readFileSync(path.join(root, 'Dockerfile'), 'utf8').split('\n')
    .filter((line) => line.startsWith('COPY ') && !line.includes('--from=')).flatMap((line) => line.split(/\s+/).slice(1, -1));
  assert.ok(copied.includes('docs') && copied.includes('core') && copied.includes('dev'), String(copied));
  for (const source of copied) {
    const files = tracked.filter((file) => file === source || file.startsWith(`${source}/`));
    // Of the documentation, the program contains the pages alone.
    const read = source === 'docs' ? files.filter((file) => /^docs\/[^/]+\.md$/.test(file)) : files;
    assert.ok(read.length > 0, `the repository has no ${source}`);
    assert.deepEqual(read.filter(ignored), [], `files of ${source} are left out`);
  }
});
