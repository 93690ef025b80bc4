/** The tabs of the panel. On narrow screens the panel is a sheet that can be collapsed. */
import { part } from './dom';

const names = ['gallery', 'parameters', 'request', 'result'] as const;
export type Page = (typeof names)[number];

export interface Tabs {
  open(page: Page): void;
  is_open(page: Page): boolean;
}

/** `opened` is called for each tab that becomes visible. */
export function wire_tabs(opened: (page: Page) => void): Tabs {
  const tabs = names.map((name) => part(`tab-${name}`));
  const fold = part('fold'), panel = part('panel');
  let now: Page = 'gallery';
  const fold_to = (open: boolean): void => {
    panel.classList.toggle('folded', !open);
    fold.setAttribute('aria-expanded', String(open));
    fold.setAttribute('aria-label', open ? 'Collapse the panel' : 'Expand the panel');
  };
  const open = (page: Page): void => {
    now = page;
    names.forEach((name, index) => {
      part(name).hidden = name !== page;
      tabs[index]?.setAttribute('aria-selected', String(name === page));
      tabs[index]?.setAttribute('tabindex', name === page ? '0' : '-1');
    });
    fold_to(true);
    opened(page);
  };
  names.forEach((name, index) => {
    tabs[index]?.addEventListener('click', () => open(name));
    tabs[index]?.addEventListener('keydown', (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step === undefined) return;
      const next = (index + step + names.length) % names.length;
      open(names[next] ?? 'gallery');
      tabs[next]?.focus();
    });
  });
  fold.addEventListener('click', () => fold_to(panel.classList.contains('folded')));
  return { open, is_open: (page) => now === page };
}
