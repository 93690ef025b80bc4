/** A one-line hint for first visitors. */
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

/** After the first action the hint is no longer needed. */
export function forget_hint(): void {
  part('hint').hidden = true;
  try {
    localStorage.setItem(known, '1');
  } catch { /* Without storage, the hint is shown again on the next visit. */ }
}

function remembered(): boolean {
  try {
    return localStorage.getItem(known) !== null;
  } catch {
    return false;
  }
}
