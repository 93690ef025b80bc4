/** Keeps the keyboard focus near its position when the focused element is removed. */
import { part } from './dom';

const can_focus = 'button, input, select, textarea, summary, a[href]';
const is_there = (element: HTMLElement): boolean => element.isConnected && !element.matches(':disabled') && element.checkVisibility();

/** An element and its enclosing groups, recorded because the element may be removed later. */
interface FocusRecord { element: HTMLElement; around: HTMLElement[] }

function focus_record_of(element: HTMLElement): FocusRecord {
  const around: HTMLElement[] = [];
  for (let up: HTMLElement | null = element; up; up = up.parentElement) if (up.matches('[role="group"], .notice, .menu, dialog')) around.push(up);
  return { element, around };
}

export function keep_focus(): void {
  let last: FocusRecord | null = null;
  /** The element that had the focus before a dialog opened. */
  const openers = new WeakMap<HTMLElement, FocusRecord>();

  const next_to = ({ element, around }: FocusRecord): HTMLElement | null => {
    for (const region of around) {
      const opener = openers.get(region);
      if (opener) return is_there(opener.element) ? opener.element : next_to(opener);
      const all = [...region.querySelectorAll<HTMLElement>(can_focus)];
      const at = all.indexOf(element);
      const near = all.filter(is_there).sort((a, b) => Math.abs(all.indexOf(a) - at) - Math.abs(all.indexOf(b) - at))[0];
      if (near) return near;
    }
    return null;
  };
  const look = (): void => void requestAnimationFrame(() => {
    const now = document.activeElement;
    if (!last || is_there(last.element) || (now && now !== document.body && now !== last.element)) return;
    (next_to(last) ?? part('picture')).focus();
  });

  document.addEventListener('focusin', (event) => {
    const element = event.target as HTMLElement;
    const dialog = element.closest('dialog');
    if (dialog && last && last.element.closest('dialog') !== dialog) openers.set(dialog, last);
    // The code that redraws the form restores the focus itself.
    last = element.closest('.bar, .view, dialog') ? focus_record_of(element) : null;
  });
  for (const event of ['click', 'keyup', 'close']) document.addEventListener(event, look, true);
  new MutationObserver(look).observe(document.body, { attributeFilter: ['data-state'] });
}
