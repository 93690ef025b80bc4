/** One line that tells a first visitor what can be done here. */
import { part } from './dom';

const known = 'seedmesh-hint-seen';

export function wire_hint(): void {
  part('hint').hidden = remembered();
  part('hint-away').addEventListener('click', () => {
    part('hint').dataset['sent'] = 'away';
    forget_hint();
    part('picture').focus();
  });
}

/** Whoever has done something needs no hint any more. */
export function forget_hint(): void {
  part('hint').hidden = true;
  try {
    localStorage.setItem(known, '1');
  } catch { /* A browser that keeps nothing shows it again. */ }
}

function remembered(): boolean {
  try {
    return localStorage.getItem(known) !== null;
  } catch {
    return false;
  }
}
