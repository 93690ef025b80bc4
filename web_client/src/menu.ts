/** Menus made of <details>, which close on Escape, on a click elsewhere, and after a choice. */
import { keep_focus } from './focus';

/** Limits the height of a menu to the window; the rest is reached by scrolling. */
function give_room(menu: HTMLDetailsElement): void {
  const body = menu.querySelector<HTMLElement>('.menu-body');
  if (body) body.style.setProperty('--room', `${Math.max(120, innerHeight - body.getBoundingClientRect().top - 8)}px`);
}

export function wire_menus(): void {
  keep_focus();
  const menus = (): HTMLDetailsElement[] => [...document.querySelectorAll<HTMLDetailsElement>('details.menu')];
  document.addEventListener('pointerdown', (event) => {
    for (const menu of menus()) if (menu.open && !menu.contains(event.target as Node)) menu.open = false;
  });
  document.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    for (const menu of menus()) {
      if (!menu.open) continue;
      menu.open = false;
      menu.querySelector('summary')?.focus();
    }
  });
  document.addEventListener('click', (event) => {
    const choice = (event.target as Element).closest('[data-close]');
    const menu = choice?.closest<HTMLDetailsElement>('details.menu');
    if (menu) menu.open = false;
  });
  document.addEventListener('toggle', (event) => {
    const opened = event.target as HTMLDetailsElement;
    if (!opened.open || !opened.classList.contains('menu')) return;
    for (const menu of menus()) if (menu !== opened && !menu.contains(opened)) menu.open = false;
    give_room(opened);
  }, true);
  addEventListener('resize', () => { for (const menu of menus()) if (menu.open) give_room(menu); });
}
