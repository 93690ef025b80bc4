/**
 * Growing by a number of the request (x-widget: growth), such as the age of one plant or of all: the model at one value
 * after the other. The request stays as it is; only what is looked at changes.
 */
import type { Request } from './api';
import { el, icon, part, rounded } from './dom';
import { is_members } from './form/schema';

/** What a field asks for: which number, up to where, what it is called and counted in. */
export interface GrowthAsk { pointer: string; until: number; label: string; unit: string }

/** So many values are shown from nothing to all, each at least so long, in milliseconds. */
const stages = 24, beat = 80;

interface Context {
  request(): Request | null;
  /** Shows a request in place of the page's own, until that changes or is shown again. */
  preview(request: Request): void;
  back(): void;
  /** Ends when what was asked for last is drawn; false where it was refused. */
  drawn(): Promise<boolean>;
  /** Whether the camera stays where it is. */
  hold(on: boolean): void;
}

export interface Growth {
  start(ask: GrowthAsk): void;
  /** The request has changed: what grew is gone. */
  leave(): void;
}

/** The value with one number in it exchanged; all on the way to it is copied. */
export function with_number(value: unknown, pointer: string, number: number): unknown {
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
  const away = el('button', { type: 'button', id: 'growth-away', class: 'quiet', 'aria-label': 'Leave the growth', title: 'Back to the request as it is' }, icon('remove'));
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
    play.setAttribute('aria-label', playing ? 'Stop the growth' : 'Play the growth');
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
