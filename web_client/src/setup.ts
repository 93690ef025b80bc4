/** How this visit is drawn: what the address asks for, and what the machine can. */
import { part } from './dom';
import type { Status } from './status';
import { Viewer } from './viewer/viewer';

export const query = new URLSearchParams(location.search);
const dark = matchMedia('(prefers-color-scheme: dark)');
const still = matchMedia('(prefers-reduced-motion: reduce)');

/** A machine without a graphics card says so in the name of its renderer. */
function renderer_name(): string {
  const context = document.createElement('canvas').getContext('webgl2');
  const detail = context?.getExtension('WEBGL_debug_renderer_info');
  const name = context && detail ? String(context.getParameter(detail.UNMASKED_RENDERER_WEBGL)) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return name;
}

export function is_high(): boolean {
  const asked = query.get('quality');
  return asked === 'high' || (asked !== 'low' && !/swiftshader|llvmpipe|software/i.test(renderer_name()));
}

/**
 * What lies at the lower rim grows and shrinks with what the model has, steps, motion, and with what is said of it; at the
 * upper with the width of the page.
 */
function watch_rims(viewer: Viewer): void {
  const upper = part('upper'), lower = part('lower'), hint = part('hint'), notice = part('notice');
  const below = lower.parentElement!, view = below.parentElement!;
  let had_hint = false, is_measured = false;
  const rims = new ResizeObserver(() => {
    // A word of the moment takes the place of the figures, and moves nothing.
    const state = document.body.dataset['state'] ?? '';
    const is_passing = !notice.hidden && ['starting', 'growing', 'ready'].includes(state);
    if (upper.offsetHeight === 0 || (is_passing && is_measured)) return;
    is_measured = true;
    const has_hint = hint.offsetHeight > 0;
    // Who sends the hint away gets its room; where it goes because of a change, both models are seen at one scale.
    const is_sent_away = had_hint && !has_hint && hint.dataset['sent'] === 'away';
    viewer.set_covered({ top: upper.offsetTop + upper.offsetHeight + 8, bottom: Math.max(72, view.clientHeight - below.offsetTop + 10) }, is_sent_away);
    had_hint = has_hint;
  });
  // The word itself too: what was not looked at while it stood there is looked at when it goes.
  for (const rim of [upper, below, notice]) rims.observe(rim);
  // What is cut off is told to who points at it.
  for (const words of [part('title'), part('measures')])
    words.addEventListener('pointerenter', () => { words.title = words.scrollWidth > words.clientWidth ? words.textContent : ''; });
}

/** null where the browser has no WebGL 2. */
export function make_viewer(status: Status, high: boolean): Viewer | null {
  document.body.classList.toggle('stage', query.has('stage'));
  try {
    const made = new Viewer(part<HTMLCanvasElement>('picture'), {
      quality: high ? 'high' : 'low', dark: dark.matches, still: still.matches, covered: query.has('stage') ? { top: 0, bottom: 0 } : { top: 72, bottom: 72 },
    });
    if (query.has('stage')) {
      made.set_grid(false);
      made.set_figure(false);
    } else {
      watch_rims(made);
    }
    made.on_context = (lost) => status.lost(lost);
    dark.addEventListener('change', () => made.set_theme(dark.matches));
    return made;
  } catch {
    status.faults('This browser gives no picture: WebGL 2 is missing or switched off. Downloads work all the same.', [], 0, () => {});
    return null;
  }
}
