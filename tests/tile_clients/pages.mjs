// The real server, and Chromium with a page of each client of 3D Tiles. Everything that a page requests or says is kept.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { build } from 'esbuild';
import { launch } from '../browser/chromium.mjs';

const here = import.meta.dirname;
const types = { '.js': 'text/javascript', '.json': 'application/json', '.wasm': 'application/wasm', '.css': 'text/css', '.png': 'image/png', '.jpg': 'image/jpeg' };
const document_of = (scripts) => `<!doctype html><link rel="icon" href="data:,"><style>body { margin: 0; overflow: hidden }</style><body>${scripts.map((each) => `<script src="${each}"></script>`).join('')}`;

/** Serves the two pages and the files of CesiumJS. */
async function serve_pages() {
  const { outputFiles: [bundle] } = await build({ entryPoints: [path.join(here, 'three_page.js')], bundle: true, write: false, format: 'iife', target: 'es2022', logLevel: 'error' });
  const made = {
    '/three': ['text/html', document_of(['/three_page.js'])], '/three_page.js': ['text/javascript', bundle.text],
    '/cesium': ['text/html', document_of(['/cesium/Cesium.js', '/cesium_page.js'])], '/cesium_page.js': ['text/javascript', fs.readFileSync(path.join(here, 'cesium_page.js'))],
  };
  const server = http.createServer((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    if (made[pathname]) return response.writeHead(200, { 'content-type': made[pathname][0] }).end(made[pathname][1]);
    const file = path.join(here, 'node_modules/cesium/Build/Cesium', path.normalize(pathname.replace(/^\/cesium/, '/')));
    if (!fs.existsSync(file) || !fs.statSync(file).isFile()) return response.writeHead(404).end();
    return response.writeHead(200, { 'content-type': types[path.extname(file)] ?? 'application/octet-stream' }).end(fs.readFileSync(file));
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  return server;
}

/** A browser in which `open(client)` gives a page; `files` lists its requests to the service, `faults` what failed or was complained of. */
export async function open_browser(service) {
  const [pages, browser] = await Promise.all([serve_pages(), launch()]);
  return {
    async open(client, { width = 640, height = 360 } = {}) {
      const page = await (await browser.newContext({ viewport: { width, height } })).newPage();
      page.setDefaultTimeout(120_000);
      page.faults = [];
      page.files = [];
      page.on('pageerror', (error) => page.faults.push(error.message));
      page.on('console', (message) => {
        // Remarks on every page: the software renderer on its own speed, 3d-tiles-renderer on any tileset of version 1.1.
        if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver Message|software|tiles versions at 1\.1/i.test(message.text())) page.faults.push(`console: ${message.text().slice(0, 300)}`);
      });
      page.on('requestfailed', (request) => page.faults.push(`${request.url()}: ${request.failure()?.errorText}`));
      page.on('response', (response) => {
        if (response.status() !== 200 && response.status() !== 304) page.faults.push(`${response.url()}: ${response.status()}`);
      });
      // The protocol of the browser tells what came from its own cache.
      const session = await page.context().newCDPSession(page), by_id = new Map();
      await session.send('Network.enable');
      session.on('Network.responseReceived', ({ requestId, response }) => {
        if (!response.url.startsWith(service.url)) return;
        const file = { url: response.url, from_memory: response.fromDiskCache === true || response.fromPrefetchCache === true, bytes: 0, sent: 0 };
        by_id.set(requestId, file);
        page.files.push(file);
      });
      session.on('Network.requestServedFromCache', ({ requestId }) => { if (by_id.has(requestId)) by_id.get(requestId).from_memory = true; });
      session.on('Network.dataReceived', ({ requestId, dataLength }) => { if (by_id.has(requestId)) by_id.get(requestId).bytes += dataLength; });
      // A request beside another one for the same file is answered from the cache, without a byte of the connection.
      session.on('Network.loadingFinished', ({ requestId, encodedDataLength }) => {
        const file = by_id.get(requestId);
        if (file) Object.assign(file, { sent: encodedDataLength, from_memory: file.from_memory || encodedDataLength === 0 });
      });
      await page.goto(`http://127.0.0.1:${pages.address().port}/${client}`);
      await page.waitForFunction('window.client');
      return page;
    },
    async close() { await browser.close(); pages.close(); },
  };
}
