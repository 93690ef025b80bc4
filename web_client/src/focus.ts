/** Whoever works by keys is not sent back to the start of the page when the button under the hand goes. */
import { part } from './dom';

const can_focus = 'button, input, select, textarea, summary, a[href]';
const is_there = (element: HTMLElement): boolean => element.isConnected && !element.matches(':disabled') && element.checkVisibility();

/** Where an element stood: it may be gone from there when it is asked. */
interface Stand { element: HTMLElement; around: HTMLElement[] }

function stand_of(element: HTMLElement): Stand {
  const around: HTMLElement[] = [];
  for (let up: HTMLElement | null = element; up; up = up.parentElement) if (up.matches('[role="group"], .notice, .menu, dialog')) around.push(up);
  return { element, around };
}

export function keep_focus(): void {
  let last: Stand | null = null;
  /** What had the focus before a dialog took it. */
  const openers = new WeakMap<HTMLElement, Stand>();

  const next_to = ({ element, around }: Stand): HTMLElement | null => {
    for (const place of around) {
      const opener = openers.get(place);
      if (opener) return is_there(opener.element) ? opener.element : next_to(opener);
      const all = [...place.querySelectorAll<HTMLElement>(can_focus)];
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
    // The form is drawn anew by those who know where the focus has to go.
    last = element.closest('.bar, .view, dialog') ? stand_of(element) : null;
  });
  for (const event of ['click', 'keyup', 'close']) document.addEventListener(event, look, true);
  new MutationObserver(look).observe(document.body, { attributeFilter: ['data-state'] });
}
