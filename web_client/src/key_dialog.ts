/** The dialog that asks for a key. It stays open until the service accepts a key or the user closes it. */
import { el, part } from './dom';

/** Returns the key, or null without one. `keep` receives the key and whether the tab should remember it. */
export function ask(why: string, holds: (key: string) => Promise<boolean>, keep: (key: string, in_tab: boolean) => void): Promise<string | null> {
  const dialog = part<HTMLDialogElement>('key-dialog');
  const input = el('input', { type: 'password', id: 'key', autocomplete: 'off', spellcheck: 'false', autocapitalize: 'off', required: true, 'aria-describedby': 'key-error' });
  const in_tab = el('input', { type: 'checkbox', class: 'switch', id: 'key-in-tab' });
  const issue = el('p', { class: 'issue', id: 'key-error', role: 'alert' });
  const use = el('button', { class: 'first' }, 'Use it');
  const form = el('form', { method: 'dialog' },
    el('div', { class: 'row' }, el('label', { for: 'key' }, 'Key'), input),
    el('div', { class: 'row' }, el('label', { for: 'key-in-tab' }, 'Remember it until this tab is closed'), in_tab),
    issue,
    el('div', { class: 'row end' }, use, el('button', { type: 'button', onclick: () => dialog.close() }, 'Without a key')));
  dialog.replaceChildren(el('h2', { id: 'key-title' }, 'This service requires a key'), el('p', { class: 'soft' }, why), form);
  return new Promise((resolve) => {
    let found: string | null = null;
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      const key = input.value.trim();
      use.disabled = true;
      issue.textContent = '';
      holds(key).then((does) => {
        if (does) {
          found = key;
          keep(key, in_tab.checked);
          dialog.close();
        } else {
          issue.textContent = 'The service does not accept this key.';
          input.setAttribute('aria-invalid', 'true');
          input.select();
        }
      }, () => { issue.textContent = 'The service does not respond.'; }).finally(() => { use.disabled = false; });
    });
    dialog.addEventListener('close', () => { input.value = ''; dialog.replaceChildren(); resolve(found); }, { once: true });
    dialog.showModal();
  });
}
