/** Touch buttons for walking and flying. They act while they are held. */
import { el, part } from './dom';
import type { Gait, Walker } from './viewer/walker';

const ways: [string, string, string, Gait[]][] = [
  ['w', '↑', 'Go ahead', ['walk', 'fly']], ['s', '↓', 'Go back', ['walk', 'fly']], ['a', '←', 'Go to the left', ['walk', 'fly']], ['d', '→', 'Go to the right', ['walk', 'fly']],
  ['q', 'Up', 'Rise', ['fly']], ['z', 'Down', 'Sink', ['fly']],
];
/** The duration, in milliseconds, of a click without a hold, as a screen reader sends it. */
const click_goes = 400;

/** The returned function shows the buttons of a movement mode, on touch screens only. */
export function wire_pad(walker: Walker): (gait: Gait) => void {
  const pad = part('pad');
  const has_finger = matchMedia('(any-pointer: coarse)');
  return (gait) => {
    pad.hidden = gait === 'orbit' || !has_finger.matches;
    pad.replaceChildren(...ways.filter(([, , , gaits]) => gaits.includes(gait)).map(([key, sign, label]) => {
      const button = el('button', { type: 'button', 'data-key': key, 'aria-label': label }, sign);
      button.addEventListener('pointerdown', (event) => { button.setPointerCapture(event.pointerId); walker.press(key); });
      for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) button.addEventListener(end, () => walker.release(key));
      // The view keeps the focus, because it releases all keys when it loses it.
      for (const other of ['mousedown', 'contextmenu']) button.addEventListener(other, (event) => event.preventDefault());
      button.addEventListener('click', (event) => {
        if (event.detail > 0) return;
        walker.press(key);
        setTimeout(() => walker.release(key), click_goes);
      });
      return button;
    }));
  };
}
