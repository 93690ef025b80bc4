/**
 * The step bar for an integer with x-steps in the schema: first, back, forward, play, and return to the requested
 * value.
 */
import type { Schema } from './form/schema';
import type { State } from './state';
import { el, icon, part } from './dom';

/** The minimum time of each step during playback, in milliseconds. */
const beat = 450;

interface Context {
  edit(name: string, value: number | undefined): void;
  /** Resolves when the model of the last change is drawn; false if it was refused. */
  drawn(): Promise<boolean>;
}

export interface Steps {
  /** Sets which parameter counts steps. Called for each generator. */
  take(schema: Schema | null): void;
  follow(state: State): void;
  by(step: number): void;
}

export function wire_steps(context: Context): Steps {
  const box = part('step-bar');
  let name: string | null = null;
  let title: string | undefined;
  let usual: number | undefined;
  let least = 0, now: number | undefined, last: number | undefined;
  let playing = 0;

  const button = (id: string, label: string, sign: Node | string, act: () => void): HTMLButtonElement =>
    el('button', { type: 'button', id: `step-${id}`, 'aria-label': label, title: label, onclick: act }, sign);
  const go = (value: number | undefined): void => { if (name !== null) context.edit(name, value); };
  const stop = (): void => { playing += 1; draw(); };
  const fresh = button('fresh', 'First step', icon('first'), () => { stop(); go(least); });
  const back = button('back', 'Previous step', icon('back'), () => { stop(); by(-1); });
  const count = el('output', { id: 'step-now' });
  const next = button('next', 'Next step', icon('next'), () => { stop(); by(1); });
  const play = button('play', 'Play the steps', 'Play', () => { if (is_playing) stop(); else void run(); });
  const finish = button('finish', 'Last step', icon('last'), () => { stop(); go(last); });
  box.append(fresh, back, count, next, play, finish);
  let is_playing = false;

  const by = (step: number): void => { if (now !== undefined) go(Math.max(least, now + step)); };

  async function run(): Promise<void> {
    const turn = (playing += 1);
    is_playing = true;
    draw();
    const until = last ?? (now ?? least) + 5;
    let at = now === undefined || now >= until ? least : now;
    if (at !== now) go(at);
    while (turn === playing) {
      const begin = Date.now();
      if (!(await context.drawn()) || turn !== playing || at >= until) break;
      await new Promise((resolve) => setTimeout(resolve, Math.max(0, beat - (Date.now() - begin))));
      if (turn !== playing) break;
      at += 1;
      go(at);
    }
    if (turn === playing) { is_playing = false; draw(); }
  }

  function draw(): void {
    box.hidden = name === null;
    count.textContent = now === undefined ? 'all steps' : last === undefined || last < now ? `step ${now}` : `step ${now} of ${last}`;
    back.disabled = now === undefined || now <= least;
    fresh.disabled = now === least;
    next.disabled = now === undefined;
    finish.disabled = now === last;
    play.textContent = is_playing ? 'Stop' : 'Play';
    play.setAttribute('aria-label', is_playing ? 'Pause the steps' : 'Play the steps');
  }

  return {
    by,
    take(schema) {
      // Redrawing the form for the same generator does not stop the playback.
      const of_another = schema?.title !== title;
      title = schema?.title;
      const found = Object.entries(schema?.properties ?? {}).find(([, member]) => member['x-steps'] && member.type === 'integer');
      name = found?.[0] ?? null;
      usual = typeof found?.[1].default === 'number' ? found[1].default : undefined;
      least = Math.max(0, found?.[1].minimum ?? 0);
      box.setAttribute('aria-label', found?.[1].title ?? 'Steps');
      if (of_another) {
        is_playing = false;
        playing += 1;
      }
      draw();
    },
    follow(state) {
      if (name === null) return;
      const value = state.request.parameters[name] ?? usual, base = state.base.parameters[name] ?? usual;
      now = typeof value === 'number' ? value : undefined;
      last = typeof base === 'number' ? base : undefined;
      draw();
    },
  };
}
