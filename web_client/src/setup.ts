/** Rendering settings from the address and the capabilities of the machine. */
import { part } from './dom';
import type { Status } from './status';
import { Viewer } from './viewer/viewer';

export const query = new URLSearchParams(location.search);
const dark = matchMedia('(prefers-color-scheme: dark)');
const still = matchMedia('(prefers-reduced-motion: reduce)');

/** The renderer name reveals software rendering. */
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
 * Tracks the size of the overlays at the top and bottom of the view. The bottom one changes with steps, motion and
 * messages; the top one with the width.
 */
function watch_rims(viewer: Viewer): void {
  const upper = part('upper'), lower = part('lower'), hint = part('hint'), notice = part('notice');
  const below = lower.parentElement!, view = below.parentElement!;
  let had_hint = false, is_measured = false;
  const rims = new ResizeObserver(() => {
    // A temporary message replaces the statistics without moving the model.
    const state = document.body.dataset['state'] ?? '';
    const is_passing = !notice.hidden && ['starting', 'growing', 'ready'].includes(state);
    if (upper.offsetHeight === 0 || (is_passing && is_measured)) return;
    is_measured = true;
    const has_hint = hint.offsetHeight > 0;
    // If the user closes the hint, the model is fitted to the free space. If a change closes it, the scale stays so
    // that both models can be compared.
    const is_sent_away = had_hint && !has_hint && hint.dataset['sent'] === 'away';
    viewer.set_covered({ top: upper.offsetTop + upper.offsetHeight + 8, bottom: Math.max(72, view.clientHeight - below.offsetTop + 10) }, is_sent_away);
    had_hint = has_hint;
  });
  // The notice is observed too, because changes during a message are skipped and have to be measured when it ends.
  for (const rim of [upper, below, notice]) rims.observe(rim);
  // Truncated text is shown in full as a tooltip.
  for (const words of [part('title'), part('measures')])
    words.addEventListener('pointerenter', () => { words.title = words.scrollWidth > words.clientWidth ? words.textContent : ''; });
}

/** Returns null if the browser does not support WebGL 2. */
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
    status.issues('This browser cannot show models, because WebGL 2 is missing or switched off. Downloads still work.', [], 0, () => {});
    return null;
  }
}
