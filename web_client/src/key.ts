/**
 * The key of a service with access control. It is kept in memory, and in session storage only if the user chooses so.
 * It is sent only in the header that the API documents.
 */

const kept = 'seedmesh-key';

function remembered(): string | null {
  try {
    return sessionStorage.getItem(kept);
  } catch {
    return null;
  }
}

let key = remembered();
let asking: Promise<string | null> | null = null;
/** After the user has closed the dialog, later requests do not open it again. */
let is_closed = false;

export const has_key = (): boolean => key !== null;

export function key_fields(): Record<string, string> {
  return key === null ? {} : { Authorization: `Bearer ${key}` };
}

/** Allows the next request to open the dialog again. */
export const reopen = (): void => { is_closed = false; };

function keep(next: string | null, in_tab: boolean): void {
  key = next;
  try {
    if (next !== null && in_tab) sessionStorage.setItem(kept, next);
    else sessionStorage.removeItem(kept);
  } catch { /* Without storage, the key is kept in memory only. */ }
}

/** Asks the service whether it accepts the key. The service checks the key before it reads the request body. */
async function holds(candidate: string): Promise<boolean> {
  const answer = await fetch('v1/validate', { method: 'POST', headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${candidate}` }, body: 'null' });
  return answer.status !== 401 && answer.status !== 403;
}

/**
 * Called when the service requires a key (401) or refuses the sent key (403). Returns true if the request should be
 * repeated. All waiting requests share one dialog.
 */
export async function unlock(status: number, shown: boolean): Promise<boolean> {
  if (shown && key !== null && status === 403 && (await holds(key))) return false;
  if (is_closed) return false;
  const why = shown ? 'The service does not accept the key.' : 'The service generates models only with a key.';
  asking ??= (async () => {
    try {
      const { ask } = await import('./key_dialog');
      const answer = ask(why, holds, keep);
      dispatchEvent(new CustomEvent('locked', { detail: true }));
      return await answer;
    } finally {
      asking = null;
      dispatchEvent(new CustomEvent('locked', { detail: false }));
    }
  })();
  const next = await asking;
  is_closed = next === null;
  return next !== null;
}
