// Draws all levels of detail of a plant from the same camera, with the sun and the sky of views.json, and compares each
// with the one before. Usage: SEEDMESH_PROGRAM=... node tests/pictures/levels.mjs PRESET... [--save DIRECTORY]
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import zlib from 'node:zlib';
import { launch } from '../browser/chromium.mjs';

const here = import.meta.dirname;
const types = { '.html': 'text/html', '.mjs': 'text/javascript', '.js': 'text/javascript', '.gltf': 'model/gltf+json', '.png': 'image/png' };
const plan = JSON.parse(fs.readFileSync(path.join(here, 'views.json'), 'utf8'));

/** The files of an archive by name. */
export function unzip(bytes) {
  const files = new Map();
  let end = bytes.length - 22;
  while (bytes.readUInt32LE(end) !== 0x06054b50) --end;
  for (let at = bytes.readUInt32LE(end + 16), left = bytes.readUInt16LE(end + 10); left > 0; --left) {
    const [method, packed, , name, extra, comment] = [bytes.readUInt16LE(at + 10), bytes.readUInt32LE(at + 20), 0, bytes.readUInt16LE(at + 28), bytes.readUInt16LE(at + 30), bytes.readUInt16LE(at + 32)];
    const local = bytes.readUInt32LE(at + 42), first = local + 30 + bytes.readUInt16LE(local + 26) + bytes.readUInt16LE(local + 28);
    const data = bytes.subarray(first, first + packed);
    files.set(bytes.toString('utf8', at + 46, at + 46 + name), method === 0 ? data : zlib.inflateRawSync(data));
    at += 46 + name + extra + comment;
  }
  return files;
}

/** The archive of a preset with all its levels, made by a program. */
function archive_of(program, preset, output) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-levels-'));
  const file = path.join(folder, 'model.zip'), request = path.join(folder, 'request.json');
  try {
    fs.writeFileSync(request, JSON.stringify({ preset, seed: 3, output: { format: 'zip', ...output } }));
    execFileSync(program, ['generate', request, '-o', file], { stdio: ['ignore', 'ignore', 'inherit'] });
    return unzip(fs.readFileSync(file));
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
}

const triangles_of = (gltf) => gltf.meshes.flatMap((mesh) => mesh.primitives).reduce((sum, each) => sum + gltf.accessors[each.indices].count / 3, 0);

/** Serves the page and the files of models, each in its own folder. */
function serve(models) {
  const server = http.createServer((request, response) => {
    const wanted = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    const [, kind, model, ...rest] = wanted.split('/');
    const file = wanted === '/' ? 'page.html' : wanted === '/page.mjs' ? 'page.mjs' : kind === 'node_modules' ? path.join('..', wanted) : null;
    const bytes = kind === 'models' ? models.get(model)?.get(rest.join('/')) : file && fs.readFileSync(path.join(here, file));
    if (!bytes) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': types[path.extname(file ?? wanted)] ?? 'application/octet-stream' }).end(bytes);
  });
  return new Promise((done) => server.listen(0, '127.0.0.1', () => done(server)));
}

/**
 * For each preset the levels, finest first: triangles; share of the finest; `overlap` of the outline with that of the level
 * before, intersection by union; luminance by that of the level before. Means over three directions.
 */
export async function compare_levels(program, names, { lods = 4, impostor = true, rows = 480, directory = null } = {}) {
  const models = new Map(names.map((name) => [name, archive_of(program, name, { lods, textures: 512, ...(impostor && { impostor }) })]));
  const server = await serve(models), browser = await launch(), results = new Map();
  try {
    for (const [name, files] of models) {
      const levels = [...files.keys()].filter((each) => each.endsWith('.gltf'))
        .map((file) => ({ file, triangles: triangles_of(JSON.parse(files.get(file))) })).sort((a, b) => b.triangles - a.triangles);
      const page = await browser.newPage({ viewport: { width: rows, height: rows } });
      await page.goto(`http://127.0.0.1:${server.address().port}/`);
      await page.waitForFunction('window.ready', null, { timeout: 60_000 });
      const images = await page.evaluate(([urls, all, size, keep]) => window.draw_levels(urls, all, size, keep), [levels.map(({ file }) => `/models/${name}/${file}`), plan, rows, directory !== null]);
      await page.close();
      results.set(name, levels.map((level, i) => ({ ...level, share: level.triangles / levels[0].triangles, ...images[i] })));
      if (directory) {
        fs.mkdirSync(directory, { recursive: true });
        images.forEach((each, i) => fs.writeFileSync(path.join(directory, `${name}_${i}.png`), Buffer.from(each.image.split(',')[1], 'base64')));
      }
    }
  } finally {
    await browser.close();
    server.close();
  }
  return results;
}

if (process.argv[1] === import.meta.filename) {
  const save = process.argv.indexOf('--save'), directory = save > 0 ? process.argv[save + 1] : null;
  const names = process.argv.slice(2, save > 0 ? save : undefined);
  console.log('| preset | level | triangles | share | overlap | luminance by that before |\n| --- | --- | --- | --- | --- | --- |');
  for (const name of names) {
    const [[, levels]] = await compare_levels(process.env.SEEDMESH_PROGRAM, [name], { directory });
    levels.forEach(({ triangles, share, overlap, brightness }, i) => console.log(`| ${name} | ${i} | ${triangles} | ${(100 * share).toFixed(1)} % | ${i ? overlap.toFixed(3) : '-'} | ${i ? brightness.toFixed(3) : '-'} |`));
  }
}
