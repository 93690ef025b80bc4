/** The keys of the page. */
import { el, part } from './dom';

export const keys: [string, [string, string][]][] = [
  ['Anywhere', [
    ['?', 'This list'], ['Ctrl Z', 'Undo'], ['Ctrl Shift Z', 'Redo'], ['Ctrl S', 'Save the request as JSON'], ['Ctrl O', 'Open a file'], ['/', 'Search the gallery'],
  ]],
  ['On the picture', [
    ['Arrows', 'Turn'], ['+ −', 'Zoom'], ['F', 'Show all'], ['W', 'Wireframe'], ['G', 'Grid'], ['H', 'Person of 1.8 m'], ['R', 'Another seed'],
    ['N', 'Shaded, flat, normals, squares'], ['C', 'Compare with this model'], ['P', 'Save the picture'], ['[ ]', 'A step back, a step on'], ['Space', 'Play or stop the motion'],
    ['Right click', 'Plant, where the form has a list of places'], ['Delete', 'Take the chosen place away'],
  ]],
  ['On foot and in flight', [['W A S D', 'Go'], ['Q Z', 'Rise, sink (in flight)'], ['Page up, down', 'Rise, sink'], ['Arrows', 'Turn the head'], ['Shift', 'Faster'], ['Esc', 'Back to turning']]],
  ['In the gallery', [['Arrows', 'From card to card'], ['Enter', 'Open']]],
];

/** Where the words of a text are typed, no letter is a command. */
export const is_typing = (event: KeyboardEvent): boolean => {
  const at = event.composedPath()[0];
  return at instanceof HTMLElement && (at.isContentEditable || /^(INPUT|TEXTAREA|SELECT)$/.test(at.tagName)
    && !(at instanceof HTMLInputElement && /^(range|checkbox|color|button|file)$/.test(at.type)));
};

export function wire_help(): { open(): void } {
  const dialog = part<HTMLDialogElement>('keys-dialog');
  const open = (): void => {
    if (dialog.open) return;
    dialog.replaceChildren(
      el('h2', { id: 'keys-title' }, 'Keys'),
      el('div', { class: 'keys' }, ...keys.map(([place, list]) => el('section', {}, el('h3', {}, place), el('dl', {},
        ...list.map(([key, does]) => el('div', {}, el('dt', {}, el('kbd', {}, key)), el('dd', {}, does))))))),
      el('p', { class: 'soft' }, 'Every parameter is explained in its form, and all routes in the ', el('a', { href: './docs' }, 'reference'), '.'),
      el('form', { method: 'dialog' }, el('button', {}, 'Close')));
    dialog.showModal();
  };
  part('help').addEventListener('click', open);
  return { open };
}
