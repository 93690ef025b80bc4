/** What is going on, in words, for eyes, for assistive tools (status, alert) and for tests (data-state on the body). */
import type { Fault, Statistics } from './api';
import { el, grouped, part, rounded, sentence, with_groups } from './dom';
import type { Phase } from './grower';

/** What a model is made of: triangles, or where it has none, lines or points. */
export interface Pieces { name: string; count: number }

/** A wait that is shorter is not worth a word. */
const bar_after = 300;
const slow_after = 4000;
/** A slider in motion makes many models: the one at which it rests is told. */
const rest = 900;

export interface Status {
  phase(phase: Phase): void;
  /** The statistics of a model, and what its canvas is called. */
  shown(statistics: Statistics, pieces: Pieces): void;
  /** Tells assistive tools of a model that has come, once no other follows. */
  arrived(model: string): void;
  /** A word that goes away by itself. */
  say(text: string): void;
  /** A word that stays until what is returned is called with the word that follows it, or with none. */
  begin(text: string): (text: string) => void;
  /** Faults that no field shows, and how many the fields show; none takes the alert away. `way` names another way out than the fields. */
  faults(detail: string, homeless: Fault[], in_fields: number, lead: () => void, way?: string): void;
  lost(lost: boolean): void;
  /** A question with one way on; what happens next in the page answers it with no. */
  ask(question: string, yes: string): Promise<boolean>;
}

export function wire_status(): Status {
  const notice = part('notice'), text = part('status'), countdown = part('countdown');
  const cancel = part('cancel'), again = part('again'), alert = part('alert');
  const progress = part<HTMLProgressElement>('progress');
  const told = part('told');
  let timers: number[] = [];
  let arriving = 0;
  let is_growing = false;
  let was_waiting = false;
  /** What goes on beside the model. */
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
    // What waits for an answer comes back after the word.
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
      window.setTimeout(() => { progress.hidden = false; show('Growing the model', [cancel]); }, bar_after),
      // Whether the server is slow or the way to it is not known here, unless it tells how far it is.
      window.setTimeout(() => show(progress.hasAttribute('value') ? 'Still growing the model' : 'Still waiting for the model', [cancel]), slow_after),
      window.setInterval(() => { if (Date.now() - begin > slow_after) countdown.textContent = `${Math.round((Date.now() - begin) / 1000)} s`; }, 1000),
    ];
  }

  function waiting(reason: 'full' | 'gone', until: number): void {
    was_waiting = true;
    show(reason === 'full' ? 'The server is full. Trying again soon' : 'The server cannot be reached. Trying again soon', [again, cancel]);
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
        case 'locked': show('The service asks for a key'); break;
        case 'stopped':
          again.textContent = 'Grow again';
          show('Stopped. The last model stays', [again]);
          break;
        case 'ready':
          if (was_waiting) say('The server is back');
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
      arriving = window.setTimeout(() => { told.textContent = model; }, rest);
    },
    faults(detail, homeless, in_fields, lead, way) {
      if (detail === '') {
        alert.replaceChildren();
        return;
      }
      const go = el('button', { type: 'button', onclick: lead }, way ?? 'Show');
      alert.replaceChildren(
        el('p', {}, with_groups(detail)),
        ...homeless.map((fault) => el('p', {}, with_groups(fault.pointer ? `${fault.pointer}: ${fault.message}` : sentence(fault.message)))),
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
      if (lost) show('The browser has lost the picture. It comes back when the graphics card answers');
      else say('The picture is back');
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
  part('milliseconds').title = statistics.is_kept ? `The server had made it before, and answered in ${time}` : '';
}

export function size_of(bytes: number): string {
  if (bytes < 1000) return `${bytes} B`;
  return bytes < 1e6 ? `${rounded(bytes / 1e3)} KB` : `${rounded(bytes / 1e6)} MB`;
}
