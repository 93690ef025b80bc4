// ./dev pictures judge DIRECTORY [view...]: draws the views of views.json, for a comparison before and after a
// change. The judge is a person; for crowns, the table also has what a program can measure: the luminance of the
// top third by that of the middle third, and the share of nearly black pixels (Y below 0.03) in the top third.
// SEEDMESH_PROGRAM is the program that makes the models.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import { launch } from '../browser/chromium.mjs';

const here = import.meta.dirname;
const types = { '.html': 'text/html', '.mjs': 'text/javascript', '.js': 'text/javascript', '.glb': 'model/gltf-binary' };

/** Makes the models of the views with a program; returns their paths by view. */
function models_of(program, views, folder) {
  return new Map(views.map((view) => {
    const file = path.join(folder, `${view.name}.glb`), request = path.join(folder, `${view.name}.json`);
    const preset = JSON.parse(execFileSync(program, ['presets', view.preset], { encoding: 'utf8' }));
    const parameters = { ...preset.parameters, ...view.parameters };
    if (view.leaf) parameters.leaf = { ...preset.parameters.leaf, ...view.leaf };
    fs.writeFileSync(request, JSON.stringify({ ...preset, seed: view.seed, parameters }));
    execFileSync(program, ['generate', request, '-o', file]);
    return [view.name, file];
  }));
}

function serve(files) {
  const server = http.createServer((request, response) => {
    const wanted = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    const model = files.get(path.basename(wanted, '.glb'));
    const file = wanted === '/' ? path.join(here, 'page.html')
      : wanted === '/page.mjs' ? path.join(here, 'page.mjs')
        : wanted.startsWith('/node_modules/three/') ? path.join(here, '..', wanted)
          : model;
    if (!file || !fs.existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': types[path.extname(file)] ?? 'text/plain' }).end(fs.readFileSync(file));
  });
  return new Promise((done) => server.listen(0, '127.0.0.1', () => done(server)));
}

/** Draws views into a directory (none: no files), and `more` views that views.json lacks; returns their measures by name. */
export async function draw_views(program, wanted, directory, more = []) {
  const plan = JSON.parse(fs.readFileSync(path.join(here, 'views.json'), 'utf8'));
  const views = [...plan.views.filter((view) => wanted.length === 0 || wanted.includes(view.name)), ...more];
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-views-'));
  const server = await serve(models_of(program, views, folder)), browser = await launch();
  const measures = {};
  try {
    const page = await browser.newPage({ viewport: { width: plan.size[0], height: plan.size[1] } });
    for (const view of views) {
      await page.goto(`http://127.0.0.1:${server.address().port}/`);
      await page.waitForFunction('window.ready', null, { timeout: 60_000 });
      measures[view.name] = await page.evaluate(([url, each, all]) => window.draw(url, each, all), [`/models/${view.name}.glb`, view, plan]);
      if (directory) await page.screenshot({ path: path.join(directory, `${view.name}.png`), timeout: 120_000 });
    }
  } finally {
    await browser.close();
    server.close();
    fs.rmSync(folder, { recursive: true });
  }
  return measures;
}

if (process.argv[1] === import.meta.filename) {
  const [directory, ...wanted] = process.argv.slice(2);
  if (!directory) throw new Error('expected a directory for the images');
  fs.mkdirSync(directory, { recursive: true });
  const measures = await draw_views(process.env.SEEDMESH_PROGRAM, wanted, directory);
  console.log('| view | triangles | top by middle third | nearly black in the top third |\n| --- | --- | --- | --- |');
  for (const [name, { triangles, thirds }] of Object.entries(measures)) {
    const crown = thirds ? `${(thirds[0].luminance / thirds[1].luminance).toFixed(2)} | ${(100 * thirds[0].near_black).toFixed(1)} %` : '- | -';
    console.log(`| ${name} | ${triangles} | ${crown} |`);
  }
}
