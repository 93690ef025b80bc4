/**
 * The key that a closed service asks for. It is kept in memory, in the tab's own storage where a hand says so, and goes
 * nowhere but into the field of the request that the service documents.
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
/** Whoever has closed the question is not asked again by every request. */
let is_closed = false;

export const has_key = (): boolean => key !== null;

export function key_fields(): Record<string, string> {
  return key === null ? {} : { Authorization: `Bearer ${key}` };
}

/** Lets the next request ask again. */
export const reopen = (): void => { is_closed = false; };

function keep(next: string | null, in_tab: boolean): void {
  key = next;
  try {
    if (next !== null && in_tab) sessionStorage.setItem(kept, next);
    else sessionStorage.removeItem(kept);
  } catch { /* Then it is kept in memory alone. */ }
}

/** Whether the service knows the key: it looks at that before it reads the request. */
async function holds(candidate: string): Promise<boolean> {
  const answer = await fetch('v1/validate', { method: 'POST', headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${candidate}` }, body: 'null' });
  return answer.status !== 401 && answer.status !== 403;
}

/**
 * Called where the service has refused for want of a key (401), or perhaps because of the one that was shown (403).
 * true where the request is worth another try. All requests that wait share one question.
 */
export async function unlock(status: number, shown: boolean): Promise<boolean> {
  if (shown && key !== null && status === 403 && (await holds(key))) return false;
  if (is_closed) return false;
  const why = shown ? 'The service does not know the key that it was shown.' : 'The service makes models for those who have a key.';
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
