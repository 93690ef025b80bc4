/**
 * Shows nine seeds of one request in a 3 x 3 grid: the current one and eight random ones. The user may choose one.
 */
import { Refusal, generate, type Request } from './api';
import { el, part } from './dom';
import { for_view } from './for_view';
import { Retrier } from './grower';
import { seed_after, type Seed } from './seed';

interface Context {
  request(): Request | null;
  portrait(bytes: ArrayBuffer, width: number, height: number): Promise<HTMLCanvasElement>;
  choose(seed: Seed): void;
}

const width = 264, height = 198;

export function wire_nine(context: Context): void {
  const dialog = part<HTMLDialogElement>('nine-dialog');
  const retrier = new Retrier();
  let running = new AbortController();
  dialog.addEventListener('close', () => running.abort());
  // The thumbnails belong to one request and are outdated when it changes.
  part('nine').addEventListener('click', () => { dialog.showModal(); void fill(); });

  async function fill(first?: Seed): Promise<void> {
    const request = context.request();
    if (!request) return;
    running.abort();
    running = new AbortController();
    const { signal } = running;
    const begin = first ?? request.seed;
    const seeds = Array.from({ length: 9 }, (_, index) => seed_after(begin, index));
    const cells = seeds.map((seed) => {
      const cell = el('button', { type: 'button', class: 'cell', 'data-seed': String(seed), 'aria-label': `Seed ${seed}${seed === request.seed ? ' · now' : ''}`, 'aria-current': String(seed === request.seed) },
        el('span', { class: 'cell-picture' }), el('span', {}, String(seed), seed === request.seed && el('b', {}, ' · now')));
      cell.addEventListener('click', () => { context.choose(seed); dialog.close(); });
      return cell;
    });
    const more = el('button', { type: 'button', onclick: () => void fill(seed_after(begin, 9)) }, 'Nine more');
    dialog.replaceChildren(
      el('h2', { id: 'nine-title' }, 'Nine seeds'), el('div', { class: 'nine' }, ...cells),
      el('div', { class: 'row end' }, more, el('button', { type: 'button', onclick: () => dialog.close() }, 'Close')));
    dialog.dataset['filled'] = '0';
    // The models are requested one by one, so that the server stays available to others and the first thumbnail
    // appears earlier.
    for (const [index, seed] of seeds.entries()) {
      const slot = cells[index]?.firstElementChild;
      try {
        const { bytes } = await retrier.persist(
          () => generate(for_view({ ...request, seed }, null), signal),
          (reason) => slot?.replaceChildren(reason === 'full' ? 'The server is busy. Next attempt soon' : 'No response. Next attempt soon'), signal);
        const picture = await context.portrait(bytes, width, height);
        if (signal.aborted) return;
        slot?.replaceWith(picture);
      } catch (error) {
        if (signal.aborted) return;
        slot?.replaceChildren(error instanceof Refusal ? 'Refused' : 'Nothing to show');
      }
      dialog.dataset['filled'] = String(index + 1);
    }
  }
}
