/** The help dialog: keyboard shortcuts, and mouse and touch gestures in the view. */
import { el, part } from './dom';

export const keys: [string, [string, string][]][] = [
  ['Anywhere', [
    ['?', 'This list'], ['Ctrl Z', 'Undo'], ['Ctrl Shift Z', 'Redo'], ['Ctrl S', 'Save the request as JSON'], ['Ctrl O', 'Open a file'], ['/', 'Search the gallery'],
  ]],
  ['In the gallery', [['Arrows', 'From card to card'], ['Home, End', 'To the first, to the last'], ['Enter', 'Open']]],
  ['Mouse on the view', [['Drag', 'Turn'], ['Right drag', 'Move sideways'], ['Wheel', 'Zoom'], ['Click', 'Select a position or a part'], ['Right click', 'Plant, if the form has a list of positions']]],
  ['On the view', [
    ['Arrows', 'Turn'], ['+ −', 'Zoom'], ['F', 'Show all'], ['W', 'Wireframe'], ['G', 'Grid'], ['H', 'Person of 1.8 m'], ['R', 'Another seed'],
    ['N', 'Shaded, flat, normals, squares'], ['C', 'Compare with this model'], ['P', 'Save the view as an image'], ['[ ]', 'Previous step, next step'], ['Space', 'Play or stop the motion'],
    ['Delete', 'Remove the selected position'],
  ]],
  ['Fingers on the view', [['One finger', 'Turn'], ['Two fingers', 'Move; pinch to zoom'], ['Tap', 'Select a position or a part'], ['Long press', 'Plant, if the form has a list of positions']]],
  ['On foot and in flight', [['W A S D', 'Go'], ['Q Z', 'Rise, sink (in flight)'], ['Page up, down', 'Rise, sink'], ['Arrows', 'Look around'], ['Shift', 'Faster'], ['Esc', 'Back to rotating the model']]],
];

/** Letters are not shortcuts inside text inputs. */
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
      // The heading takes the focus. Focusing a link or button further down would scroll the dialog.
      el('form', { method: 'dialog', class: 'dialog-head' }, el('h2', { id: 'keys-title', tabindex: -1, autofocus: true }, 'Keys and gestures'), el('button', {}, 'Close')),
      el('div', { class: 'keys' }, ...keys.map(([where, list]) => el('section', { class: where.startsWith('Fingers') && 'fingers' }, el('h3', {}, where), el('dl', {},
        ...list.map(([key, does]) => el('div', {}, el('dt', {}, el('kbd', {}, key)), el('dd', {}, does))))))),
      el('p', { class: 'soft' }, 'Every parameter is explained in its form, and all routes in the ', el('a', { href: './docs' }, 'reference'), '.'));
    dialog.showModal();
    dialog.scrollTop = 0;
  };
  part('help').addEventListener('click', open);
  return { open };
}
