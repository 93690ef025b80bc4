/** View options: shading, materials, levels of detail, motion, light, sky and camera. */
import { el, fresh_id, part } from './dom';
import type { Motion } from './for_view';
import { wire_levels } from './level_choice';
import { wire_pad } from './pad';
import type { Model } from './viewer/model';
import { has_uvs, type Mode } from './viewer/modes';
import type { Viewer } from './viewer/viewer';
import type { Gait } from './viewer/walker';

interface Context {
  /** Fetches the zip with the levels of the shown model. It may contain fewer levels than requested. */
  levels(): Promise<ArrayBuffer>;
  /** Shows the model with the selected motion. */
  animate(): void;
  fail(text: string): void;
  high: boolean;
}

export interface ViewMenu {
  /** Called when another model is shown. */
  shown(model: Model, triangles: number): void;
  /** Sets the motions that the model supports. */
  offer_motions(motions: Motion[]): void;
  /** Called when another request is opened, whose motions are not known yet. */
  forget(): void;
  motion(): Motion | null;
  next_mode(): void;
  leave_gait(): void;
}

const modes: [Mode, string][] = [['shaded', 'Shaded'], ['flat', 'Flat'], ['normals', 'Normals'], ['uv', 'UV squares']];
const gaits: [Gait, string][] = [['orbit', 'Turn'], ['walk', 'On foot'], ['fly', 'In flight']];

function choice(label: string, id: string, change: (value: string) => void): { row: HTMLElement; select: HTMLSelectElement; offer(options: [string, string][]): void } {
  const select = el('select', { id });
  select.addEventListener('change', () => change(select.value));
  return {
    select,
    row: el('div', { class: 'row' }, el('label', { for: id }, label), select),
    offer(options) {
      const value = select.value;
      select.replaceChildren(...options.map(([name, text]) => el('option', { value: name, selected: name === value }, text)));
    },
  };
}

function tick(label: string, id: string, on: boolean, change: (on: boolean) => void): HTMLElement {
  const box = el('input', { type: 'checkbox', class: 'switch', id, checked: on });
  box.addEventListener('change', () => change(box.checked));
  return el('div', { class: 'row' }, el('label', { for: id }, label), box);
}

function range(label: string, low: number, high: number, value: number, change: (value: number) => void): HTMLElement {
  const id = fresh_id('range');
  const input = el('input', { type: 'range', id, min: low, max: high, value });
  input.addEventListener('input', () => change(input.valueAsNumber));
  return el('div', { class: 'row' }, el('label', { for: id }, label), input);
}

function tint(label: string, id: string, value: string, change: (color: string) => void): HTMLElement {
  const input = el('input', { type: 'color', id, value });
  input.addEventListener('input', () => change(input.value));
  return el('div', { class: 'row' }, el('label', { for: id }, label), input);
}

export function wire_view_menu(viewer: Viewer, context: Context): ViewMenu {
  const sun = { on: true, turn: 38, height: 51 };
  const shading = choice('Shading', 'shading', (value) => show_mode(value as Mode));
  shading.offer(modes);
  let is_without_uvs = false;
  const show_mode = (mode: Mode): void => {
    viewer.set_mode(mode);
    if (mode === 'uv' && is_without_uvs) part('picture').dispatchEvent(new CustomEvent('tell', { bubbles: true, detail: 'This model has no UVs, so it is drawn without squares' }));
  };
  const material = choice('Materials', 'material-set', (value) => void viewer.set_variant(value || null));
  const motion = choice('Motion', 'motion-kind', (value) => { viewer.motion.begins = value !== '' && !viewer.is_still; context.animate(); });
  const level = choice('Level of detail', 'detail', (value) => levels.choose(value));
  const gait = choice('Camera', 'gait', (value) => {
    viewer.set_gait(value as Gait);
    part('whereabouts').hidden = value === 'orbit';
    show_pad(value as Gait);
    if (value !== 'orbit') { part<HTMLDetailsElement>('view-menu').open = false; part('picture').focus(); }
  });
  gait.offer(gaits);
  const show_pad = wire_pad(viewer.walker);
  let motions: Motion[] = [];

  const times = tick('Frame time', 'show-drawn', false, (on) => { part('drawn-box').hidden = !on; viewer.set_timed(on); });

  part('view-options').append(
    shading.row, material.row, motion.row, level.row, gait.row,
    tick('Edges of shapes', 'edges', false, (on) => viewer.set_edges(on)),
    tick('Sky', 'sky', false, (on) => viewer.set_sky(on)),
    tick('Fog', 'fog', false, (on) => viewer.set_fog(on)),
    tick('Shadow', 'shadow', context.high, (on) => viewer.set_shadow(on)),
    tick('Light', 'light-on', true, (on) => { sun.on = on; viewer.set_sun(sun); }),
    range('Light from', 0, 360, sun.turn, (value) => { sun.turn = value; viewer.set_sun(sun); }),
    range('Height of light', 1, 90, sun.height, (value) => { sun.height = value; viewer.set_sun(sun); }),
    tint('Colour of light', 'light-color', '#fff3e0', (color) => viewer.set_light_color(color)),
    times);
  viewer.walker.on_move = (position, heading) => {
    part('whereabouts').textContent = `x ${position.x.toFixed(1)}, y ${position.y.toFixed(1)}, z ${position.z.toFixed(1)} m · ${Math.round(heading)}°`;
  };

  let is_for_levels = false;
  const time_for_levels = (on: boolean): void => { times.querySelector('input')?.click(); is_for_levels = on; };
  times.addEventListener('change', () => { is_for_levels = false; });
  const levels = wire_levels(viewer, {
    select: level.select, offer: level.offer, levels: context.levels, fail: context.fail,
    // The frame time shows the benefit of a level of detail.
    came() { if (part('drawn-box').hidden) time_for_levels(true); },
  });
  const offer_motions = (next: Motion[]): void => {
    motions = next;
    motion.row.hidden = motions.length === 0;
    motion.offer([['', 'Still'], ...motions.map(({ value, label }): [string, string] => [value, label])]);
  };

  return {
    shown(model, made) {
      levels.shown(made);
      is_without_uvs = !has_uvs(model);
      shading.offer(modes.map(([mode, text]) => [mode, mode === 'uv' && is_without_uvs ? `${text}: none here` : text]));
      material.row.hidden = model.variants.length === 0;
      material.offer([['', 'As requested'], ...model.variants.map((name): [string, string] => [name, name])]);
    },
    offer_motions,
    forget() {
      offer_motions([]);
      levels.forget();
      // The statistic is hidden again only if it was switched on automatically.
      if (is_for_levels) time_for_levels(false);
    },
    motion: () => motions.find((each) => each.value === motion.select.value) ?? null,
    next_mode() {
      shading.select.selectedIndex = (shading.select.selectedIndex + 1) % modes.length;
      show_mode(shading.select.value as Mode);
    },
    leave_gait() {
      if (gait.select.value === 'orbit') return;
      gait.select.value = 'orbit';
      gait.select.dispatchEvent(new Event('change'));
    },
  };
}

/** The bar under an animated model: play, and a slider for the time. */
export function wire_motion(viewer: Viewer): { shown(model: Model): void; play(): void } {
  const bar = part('motion'), play = part('motion-play'), now = part('motion-now');
  const time = part<HTMLInputElement>('motion-time');
  const tell = (share: number): void => {
    time.value = String(Math.round(share * 1000));
    now.textContent = `${(share * viewer.motion.seconds).toFixed(1)} s`;
    const runs = viewer.motion.is_running;
    play.textContent = runs ? 'Stop' : 'Play';
    play.setAttribute('aria-label', runs ? 'Pause the motion' : 'Play the motion');
  };
  viewer.motion.on_time = tell;
  const flip = (): void => {
    if (!viewer.motion.has_clip) return;
    viewer.play(!viewer.motion.is_running);
    tell(time.valueAsNumber / 1000);
  };
  play.addEventListener('click', flip);
  time.addEventListener('input', () => {
    viewer.play(false);
    viewer.set_time(time.valueAsNumber / 1000);
    tell(time.valueAsNumber / 1000);
  });
  return {
    shown(model) {
      bar.hidden = model.clips.length === 0 && !model.sways;
      if (!bar.hidden) tell(viewer.motion.at);
    },
    play: flip,
  };
}

/** A/B comparison: the model shown at the start stays on the left; later models appear on the right. */
export function wire_compare(viewer: Viewer, shown: () => { bytes: ArrayBuffer; title: string; seed: number | string } | null): (() => void) {
  const button = part('compare'), box = part('divider-box');
  const divider = part<HTMLInputElement>('divider'), line = part('divider-line');
  const set_divider = (): void => {
    viewer.set_divider(divider.valueAsNumber / 100);
    line.style.setProperty('left', `${divider.value}%`);
  };
  const flip = (): void => {
    const on = button.getAttribute('aria-pressed') !== 'true';
    const kept = shown();
    if (on && !kept) return;
    button.setAttribute('aria-pressed', String(on));
    box.hidden = line.hidden = !on;
    if (on) box.querySelector('label')!.replaceChildren(el('b', {}, `Left: seed ${kept?.seed}`), el('span', { class: 'soft' }, kept?.title));
    void viewer.compare(on && kept ? kept.bytes : null).then(set_divider);
  };
  button.addEventListener('click', flip);
  divider.addEventListener('input', set_divider);
  return flip;
}
