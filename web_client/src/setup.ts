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
      // What lies at the lower rim grows and shrinks with what the model has: steps, motion; at the upper with the width of the page.
      const upper = part('upper'), lower = part('lower');
      const rims = new ResizeObserver(() => {
        if (upper.offsetHeight > 0) made.set_covered({ top: upper.offsetTop + upper.offsetHeight + 8, bottom: Math.max(72, lower.offsetHeight + 32) });
      });
      for (const rim of [upper, lower]) rims.observe(rim);
    }
    made.on_context = (lost) => status.lost(lost);
    dark.addEventListener('change', () => made.set_theme(dark.matches));
    return made;
  } catch {
    status.faults('This browser gives no picture: WebGL 2 is missing or switched off. Downloads work all the same.', [], 0, () => {});
    return null;
  }
}
