/**
 * Shows the state of the page as text, as ARIA live regions (status, alert), and as data-state on the body for tests.
 */
import type { Issue, Statistics } from './api';
import { el, grouped, part, rounded, sentence, with_groups } from './dom';
import type { Phase } from './grower';

/** The primitives of a model: triangles, or lines or points if it has no triangles. */
export interface Pieces { name: string; count: number }

/** Shorter waits show no progress bar; in milliseconds. */
const bar_after = 300;
const slow_after = 4000;
/** A moving slider generates many models. Only the last one is announced. */
const rest = 900;

export interface Status {
  phase(phase: Phase): void;
  /** Shows the statistics and the label of the canvas. */
  shown(statistics: Statistics, pieces: Pieces): void;
  /** Announces a finished model to assistive technology, unless another follows shortly. */
  arrived(model: string): void;
  /** Shows a temporary message. */
  say(text: string): void;
  /** Shows a message until the returned function is called, optionally with a final message. */
  begin(text: string): (text: string) => void;
  /**
   * Shows errors without a field and the number of those with one. An empty detail clears the alert. `way` is the
   * label of another action.
   */
  issues(detail: string, homeless: Issue[], in_fields: number, lead: () => void, way?: string): void;
  lost(lost: boolean): void;
  /** Asks a question with one confirming action. The next change of state answers it with no. */
  ask(question: string, yes: string): Promise<boolean>;
}

export function wire_status(): Status {
  const notice = part('notice'), text = part('status'), countdown = part('countdown');
  const cancel = part('cancel'), again = part('again'), alert = part('alert');
  const progress = part<HTMLProgressElement>('progress');
  const announcement = part('announcement');
  let timers: number[] = [];
  let arriving = 0;
  let is_growing = false;
  let was_waiting = false;
  /** The message of a task that runs besides the generation. */
  let task = '';
  let answer_no = (): void => {};

  const clear = (): void => {
    for (const timer of timers) clearTimeout(timer), clearInterval(timer);
    timers = [];
  };
  const show = (message: string, buttons: HTMLElement[] = []): void => {
    if (text.textContent !== message) text.textContent = message;
    countdown.textContent = '';
    cancel.hidden = !buttons.includes(cancel);
    again.hidden = !buttons.includes(again);
    notice.hidden = message === '';
    if (message === '' && task !== '') show(task);
  };
  const say = (message: string): void => {
    // A message with buttons is shown again after the temporary one.
    const buttons = [cancel, again].filter((button) => !button.hidden);
    const before = buttons.length > 0 ? text.textContent : '';
    show(message);
    timers.push(window.setTimeout(() => show(before, buttons), 4000));
  };

  function growing(share: number | null): void {
    if (share === null) progress.removeAttribute('value');
    else progress.value = share;
    if (is_growing) return;
    clear();
    is_growing = true;
    const begin = Date.now();
    timers = [
      window.setTimeout(() => { progress.hidden = false; show('Generating the model', [cancel]); }, bar_after),
      // Without progress reports, a slow server and a slow network cannot be distinguished.
      window.setTimeout(() => show(progress.hasAttribute('value') ? 'Still generating the model' : 'Still waiting for the model', [cancel]), slow_after),
      window.setInterval(() => { if (Date.now() - begin > slow_after) countdown.textContent = `${Math.round((Date.now() - begin) / 1000)} s`; }, 1000),
    ];
  }

  function waiting(reason: 'full' | 'gone', until: number): void {
    was_waiting = true;
    show(reason === 'full' ? 'The server is busy. Next attempt soon' : 'The server cannot be reached. Next attempt soon', [again, cancel]);
    again.textContent = 'Try now';
    const tick = (): void => { countdown.textContent = `in ${Math.max(0, Math.ceil((until - Date.now()) / 1000))} s`; };
    tick();
    timers = [window.setInterval(tick, 250)];
  }

  return {
    say,
    begin(message) {
      task = message;
      if (!is_growing && notice.hidden) show(message);
      return (after) => {
        if (task !== message) return;
        task = '';
        if (after) say(after);
        else if (text.textContent === message) show('');
      };
    },
    phase(phase) {
      answer_no();
      document.body.dataset['state'] = phase.kind === 'waiting' ? phase.reason : phase.kind;
      if (phase.kind === 'growing') {
        growing(phase.share);
        return;
      }
      clear();
      is_growing = false;
      progress.hidden = true;
      switch (phase.kind) {
        case 'waiting': waiting(phase.reason, phase.until); break;
        case 'locked': show('The service requires a key'); break;
        case 'stopped':
          again.textContent = 'Generate again';
          show('Stopped. The view shows the last model', [again]);
          break;
        case 'ready':
          if (was_waiting) say('The server is available again');
          else show('');
          was_waiting = false;
          break;
        case 'refused':
          show('');
          was_waiting = false;
      }
    },
    shown: show_statistics,
    arrived(model) {
      clearTimeout(arriving);
      arriving = window.setTimeout(() => { announcement.textContent = model; }, rest);
    },
    issues(detail, homeless, in_fields, lead, way) {
      if (detail === '') {
        alert.replaceChildren();
        return;
      }
      const go = el('button', { type: 'button', onclick: lead }, way ?? 'Show');
      alert.replaceChildren(
        el('p', {}, with_groups(detail)),
        ...homeless.map((issue) => el('p', {}, with_groups(issue.pointer ? `${issue.pointer}: ${issue.message}` : sentence(issue.message)))),
        ...(in_fields > 0 || way !== undefined ? [go] : []),
      );
    },
    ask(question, yes) {
      document.body.dataset['state'] = 'asking';
      clear();
      is_growing = false;
      progress.hidden = true;
      show('');
      return new Promise((resolve) => {
        answer_no = () => resolve(false);
        const answer = (is: boolean) => () => { answer_no = () => {}; alert.replaceChildren(); resolve(is); };
        alert.replaceChildren(el('p', {}, question), el('button', { type: 'button', onclick: answer(true) }, yes), el('button', { type: 'button', onclick: answer(false) }, 'Leave it'));
      });
    },
    lost(lost) {
      if (lost) show('The browser has lost the view. It returns when the graphics card is available');
      else say('The view is available again');
    },
  };
}

function show_statistics(statistics: Statistics, pieces: Pieces): void {
  part('statistics').hidden = false;
  part('pieces').textContent = pieces.name;
  part('triangles').textContent = grouped(pieces.count);
  part('triangles').dataset['pieces'] = pieces.name.toLowerCase();
  part('triangles').dataset['made'] = String(pieces.count);
  part('warnings-box').hidden = statistics.warnings === 0;
  part('warnings').textContent = grouped(statistics.warnings);
  part('bytes').textContent = size_of(statistics.bytes);
  part('bytes').title = `${grouped(statistics.bytes)} bytes`;
  part('bytes').dataset['bytes'] = String(statistics.bytes);
  const time = `${statistics.milliseconds < 10 ? statistics.milliseconds.toFixed(1) : grouped(Math.round(statistics.milliseconds))} ms`;
  part('made').textContent = statistics.is_kept ? 'Taken' : 'Made in';
  part('milliseconds').textContent = statistics.is_kept ? 'from memory' : time;
  part('milliseconds').title = statistics.is_kept ? `The server took it from its cache and responded in ${time}` : '';
}

function size_of(bytes: number): string {
  if (bytes < 1000) return `${bytes} B`;
  return bytes < 1e6 ? `${rounded(bytes / 1e3)} KB` : `${rounded(bytes / 1e6)} MB`;
}
