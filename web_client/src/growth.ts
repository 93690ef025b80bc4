/**
 * Plays the growth of a model over one number of the request (x-widget: growth), such as the age of a plant. The
 * stored request is unchanged; only the view changes.
 */
import type { Request } from './api';
import { el, icon, part, rounded } from './dom';
import { is_members } from './form/schema';

/** The event detail of a growth field: the number to vary, its upper bound, its label and its unit. */
export interface GrowthAsk { pointer: string; until: number; label: string; unit: string }

/** The number of steps from zero to the full value, and the minimum time of each step in milliseconds. */
const stages = 24, beat = 80;

interface Context {
  request(): Request | null;
  /** Shows another request in place of the page's own until the own request changes or is shown again. */
  preview(request: Request): void;
  back(): void;
  /** Resolves when the last requested model is drawn; false if it was refused. */
  drawn(): Promise<boolean>;
  /** Keeps the camera in place while true. */
  hold(on: boolean): void;
}

export interface Growth {
  start(ask: GrowthAsk): void;
  /** Stops the playback because the request has changed. */
  leave(): void;
}

/** Returns a copy of the value with one number replaced. */
function with_number(value: unknown, pointer: string, number: number): unknown {
  if (pointer === '') return number;
  const [, key = '', rest = ''] = /^\/([^/]*)(.*)$/.exec(pointer) ?? [];
  const name = key.replaceAll('~1', '/').replaceAll('~0', '~');
  if (Array.isArray(value)) return value.map((each: unknown, index) => (index === Number(name) ? with_number(each, rest, number) : each));
  const members = is_members(value) ? value : {};
  return { ...members, [name]: with_number(members[name], rest, number) };
}

export function wire_growth(context: Context): Growth {
  const bar = part('growth');
  const play = el('button', { type: 'button', id: 'growth-play' });
  const slider = el('input', { type: 'range', id: 'growth-value', min: 0, max: stages });
  const now = el('output', { id: 'growth-now' });
  const away = el('button', { type: 'button', id: 'growth-away', class: 'quiet', 'aria-label': 'Close the growth', title: 'Back to the unchanged request' }, icon('remove'));
  bar.append(play, slider, now, away);
  let ask: GrowthAsk = { pointer: '', until: 1, label: '', unit: '' };
  let turn = 0;
  let is_playing = false;

  const show = (stage: number): void => {
    slider.value = String(stage);
    const value = stage / stages * ask.until;
    now.textContent = `${ask.label} ${rounded(value)} of ${rounded(ask.until)}${ask.unit && ` ${ask.unit}`}`;
    const request = context.request();
    if (request) context.preview(with_number(request, ask.pointer, value) as Request);
  };
  const tell = (playing: boolean): void => {
    is_playing = playing;
    play.textContent = playing ? 'Stop' : 'Play';
    play.setAttribute('aria-label', playing ? 'Pause the growth' : 'Play the growth');
  };
  const stop = (): void => { turn += 1; tell(false); };

  async function run(): Promise<void> {
    const mine = (turn += 1);
    tell(true);
    const from = slider.valueAsNumber >= stages ? 1 : slider.valueAsNumber;
    for (let stage = from; stage <= stages && mine === turn; stage += 1) {
      const begin = Date.now();
      show(stage);
      if (!(await context.drawn()) || mine !== turn) break;
      await new Promise((resolve) => setTimeout(resolve, Math.max(0, beat - (Date.now() - begin))));
    }
    if (mine === turn) tell(false);
  }

  function leave(): void {
    if (bar.hidden) return;
    stop();
    bar.hidden = true;
    context.hold(false);
  }

  play.addEventListener('click', () => { if (is_playing) stop(); else void run(); });
  slider.addEventListener('input', () => { stop(); show(slider.valueAsNumber); });
  away.addEventListener('click', () => { leave(); context.back(); part('picture').focus(); });
  return {
    start(next) {
      ask = next;
      bar.hidden = false;
      slider.setAttribute('aria-label', ask.label);
      slider.value = String(stages);
      context.hold(true);
      void run();
    },
    leave,
  };
}
