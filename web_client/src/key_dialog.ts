/** The question for a key: closed by whoever has none, open until one is known to the service. */
import { el, part } from './dom';

/** The key, or null where there is none. `keep` is told the key and whether the tab shall remember it. */
export function ask(why: string, holds: (key: string) => Promise<boolean>, keep: (key: string, in_tab: boolean) => void): Promise<string | null> {
  const dialog = part<HTMLDialogElement>('key-dialog');
  const input = el('input', { type: 'password', id: 'key', autocomplete: 'off', spellcheck: 'false', autocapitalize: 'off', required: true, 'aria-describedby': 'key-fault' });
  const in_tab = el('input', { type: 'checkbox', class: 'switch', id: 'key-in-tab' });
  const fault = el('p', { class: 'fault', id: 'key-fault', role: 'alert' });
  const use = el('button', { class: 'first' }, 'Use it');
  const form = el('form', { method: 'dialog' },
    el('div', { class: 'row' }, el('label', { for: 'key' }, 'Key'), input),
    el('div', { class: 'row' }, el('label', { for: 'key-in-tab' }, 'Remember it until this tab is closed'), in_tab),
    fault,
    el('div', { class: 'row end' }, use, el('button', { type: 'button', onclick: () => dialog.close() }, 'Without a key')));
  dialog.replaceChildren(el('h2', { id: 'key-title' }, 'This service asks for a key'), el('p', { class: 'soft' }, why), form);
  return new Promise((resolve) => {
    let found: string | null = null;
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      const key = input.value.trim();
      use.disabled = true;
      fault.textContent = '';
      holds(key).then((does) => {
        if (does) {
          found = key;
          keep(key, in_tab.checked);
          dialog.close();
        } else {
          fault.textContent = 'The service does not know this key.';
          input.setAttribute('aria-invalid', 'true');
          input.select();
        }
      }, () => { fault.textContent = 'The service does not answer.'; }).finally(() => { use.disabled = false; });
    });
    dialog.addEventListener('close', () => { input.value = ''; dialog.replaceChildren(); resolve(found); }, { once: true });
    dialog.showModal();
  });
}
