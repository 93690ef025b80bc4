// Cameras that fly over a world as clients of 3D Tiles do: each reads the explicit tileset, and asks for the tiles of its view, coarse ones first.
import http from 'node:http';
import { ask, sleep } from './support.mjs';

/** A tile is replaced nearer than this many times its geometric error: 16 pixels at 1,080 lines and 60 degrees. */
const reach = 58.5;

/** The distance of a camera from a box of 3D Tiles. */
function distance(box, [x, y, z]) {
  const off = (k, half) => Math.max(0, Math.abs([x, y, z][k] - box[k]) - half);
  return Math.hypot(off(0, box[3]), off(1, box[7]), off(2, box[11]));
}

class Camera {
  constructor(origin, home, number) {
    Object.assign(this, { origin, home, number, known: new Map(), answers: new Map(), times: [] });
    this.agent = new http.Agent({ keepAlive: true, maxSockets: 6 });
  }

  /** A file, asked for once, or again with its validator. */
  async file(target) {
    const held = this.known.get(target), begun = performance.now();
    const answer = await ask(this.origin, 'GET', target, { agent: this.agent, headers: held ? { 'if-none-match': held.etag } : {} }).catch((error) => ({ status: error.code, headers: {} }));
    this.answers.set(answer.status, (this.answers.get(answer.status) ?? 0) + 1);
    if (answer.status === 200) {
      this.times.push(performance.now() - begun);
      this.known.set(target, { etag: answer.headers.etag, json: answer.json });
    }
    return this.known.get(target);
  }

  /** Asks for what one picture needs; at most `most` files. */
  async look(place, most) {
    let wave = [{ tile: (await this.file(`${this.home}tileset.json`))?.json?.root, base: `${this.home}tileset.json` }], asked = 0;
    while (wave.length > 0 && asked < most) {
      const next = [];
      await Promise.all(wave.map(async ({ tile, base }) => {
        if (!tile || asked >= most) return;
        const target = new URL(tile.content.uri, `http://x${base}`).pathname;
        // Every tenth file that is there is validated, as a client with an old cache does.
        if (!this.known.has(target) || asked % 10 === 9) { ++asked; await this.file(target); }
        if (target.endsWith('.json')) { next.push({ tile: this.known.get(target)?.json?.root, base: target }); return; }
        if (distance(tile.boundingVolume.box, place) < reach * tile.geometricError) for (const child of tile.children ?? []) next.push({ tile: child, base });
      }));
      wave = next;
    }
  }

  /** Flies until `over()`; each camera has a course, a speed and a height of its own. */
  async fly(over) {
    const turn = this.number * 2.399963, height = 60 + 37 * (this.number % 12);
    for (let step = 0; !over(); ++step) {
      const run = 900 * (this.number % 7) + step * 40;
      await this.look([Math.cos(turn) * run, Math.sin(turn) * run, 250 + height], 40);
      await sleep(50);
    }
    this.agent.destroy();
  }
}

/** `count` cameras over the world at `home` until `work` has ended. Counts answers by status; times of 200 in milliseconds, ascending. */
export async function flights(origin, home, count, work) {
  let over = false;
  const cameras = Array.from({ length: count }, (_, number) => new Camera(origin, home, number));
  const all = Promise.all(cameras.map((camera) => camera.fly(() => over)));
  await work();
  over = true;
  await all;
  const answers = new Map();
  for (const camera of cameras) for (const [status, n] of camera.answers) answers.set(status, (answers.get(status) ?? 0) + n);
  return { answers, times: cameras.flatMap(({ times }) => times).sort((a, b) => a - b) };
}
