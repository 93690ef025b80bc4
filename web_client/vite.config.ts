import { defineConfig } from 'vite';
import { slim_three } from './slim_three.ts';

// Relative addresses let the page live under any path of a proxy. `npm run dev` asks a server on the default port.
export default defineConfig({
  base: './',
  plugins: [slim_three()],
  build: { target: 'es2023', assetsInlineLimit: 0, modulePreload: false, chunkSizeWarningLimit: 700, rolldownOptions: { input: ['index.html', 'world.html'] } },
  server: { proxy: { '/v1': 'http://127.0.0.1:8080', '/docs': 'http://127.0.0.1:8080' } },
});
