/** The intermediate result of the generator (POST /v1/derive): figures, texts, height maps, plans and shapes. */
import { Refusal, derive, type Request } from './api';
import { el, grouped, part, rounded } from './dom';
import { is_members, type Members } from './form/schema';
import type { State } from './state';
import { CityPlanView, is_plan } from './derived/city_plan';
import { draw_map, draw_profile, is_heights } from './derived/height_map';
import { PlantList, is_scene, type PlantActs } from './derived/plant_list';
import { ShapeList, is_shapes, type Edited } from './derived/shape_list';
import type { Overlay } from './derived/overlay';

export interface Result {
  /** Whether the panel is visible. The server is asked only then. */
  open(in_sight: boolean): void;
  follow(state: State, is_new: boolean): void;
  /** Another model is drawn, so the overlay of the previous one is removed. */
  drawn(): void;
  picked(index: number): void;
  /** The user has clicked at this point of the ground. */
  touched(x: number, z: number): void;
  /** Asks again for the shown request, because what is asked for has changed. */
  repeat(): void;
}

/** Longer texts are shortened on the page. The full text is in the server's response. */
const longest = 4000;
/** The server is asked after changes have paused for this long, in milliseconds. */
const debounce = 200;

/**
 * `lead` moves the cursor to a line of the rules; `has_rules` tells whether the shown request contains rules. `acts.open`
 * opens another request, such as that of a building of a city.
 */
export function wire_result(overlay: Overlay | null, lead: (line: number) => void, has_rules: () => boolean, acts: { edited: Edited; plants: PlantActs; open: (request: Request, title: string) => void; with_all(request: Request): Request }): Result {
  const page = part('result');
  let request: Request | null = null;
  let shown_for: Request | null = null;
  let in_sight = false;
  let running = new AbortController();
  let shapes: ShapeList | null = null;
  let plan: CityPlanView | null = null;
  let plants: PlantList | null = null;
  let is_unanswered = false;
  let timer = 0;

  async function ask(): Promise<void> {
    if (!in_sight || !request || shown_for === request) return;
    running.abort();
    running = new AbortController();
    const { signal } = running;
    const asked = request;
    is_unanswered = false;
    page.dataset['for'] = '';
    try {
      const answer = await derive(acts.with_all(asked), signal);
      shown_for = asked;
      draw(answer);
    } catch (error) {
      if (signal.aborted) return;
      shapes = plan = null;
      is_unanswered = !(error instanceof Refusal);
      page.replaceChildren(head(), el('p', { class: 'soft' }, error instanceof Refusal ? `Nothing to show: ${error.message}` : 'The server does not respond.'));
    }
    page.dataset['for'] = String(asked.seed);
  }

  function draw(answer: Members): void {
    const focused = document.activeElement;
    const rest = { ...answer };
    const parts: (HTMLElement | null)[] = [];
    const before = shapes, plan_before = plan;
    shapes = plan = null;
    plants = null;
    if (is_plan(rest['plan'])) {
      plan = new CityPlanView(rest['plan'], acts.open);
      if (plan_before) plan.take_over(plan_before);
      parts.push(plan.element);
      delete rest['plan'];
    }
    if (is_heights(rest)) {
      parts.push(rest.height === 1 ? draw_profile(rest) : draw_map(rest));
      delete (rest as Members)['heights'];
    }
    if (is_shapes(rest['shapes'])) {
      shapes = new ShapeList(rest['shapes'], overlay, has_rules() ? lead : null, acts.edited);
      if (before) shapes.take_over(before);
      parts.push(shapes.element);
      delete rest['shapes'];
    }
    if (is_scene(rest)) {
      plants = new PlantList({ ...rest }, overlay, acts.plants);
      parts.push(plants.element);
      delete (rest as Partial<typeof rest>).words;
    }
    const figures = figures_of(rest);
    parts.push(figures.length > 0 ? el('dl', { class: 'figures' }, ...figures.map(([name, value]) => el('div', {}, el('dt', {}, name), el('dd', {}, value)))) : null);
    for (const [name, value] of Object.entries(rest)) parts.push(...long_part(name, value));
    page.replaceChildren(head(), ...parts.filter((each) => each !== null));
    // A field that the new parts contain keeps the focus.
    if (focused instanceof HTMLElement && page.contains(focused)) focused.focus({ preventScroll: true });
  }

  return {
    open(now) { in_sight = now; void ask(); },
    follow(state, is_new) {
      request = state.request;
      if (is_new) shapes = plants = plan = null;
      clearTimeout(timer);
      timer = window.setTimeout(() => void ask(), debounce);
    },
    drawn() {
      if (shapes) shapes.lay_over();
      else overlay?.set_boxes(null);
      // A drawn model shows that the server is reachable, so an unanswered request is repeated.
      if (is_unanswered) void ask();
    },
    picked(index) { shapes?.pick(index); },
    repeat() { shown_for = null; void ask(); },
    touched(x, z) { if (in_sight) plants?.pick(x, z); },
  };
}

const head = (): DocumentFragment => {
  const both = document.createDocumentFragment();
  both.append(el('h2', { class: 'unseen' }, 'Result'), el('p', { class: 'soft about' }, 'The result of the generator before it makes geometry.'));
  return both;
};
const readable = (name: string): string => name.replaceAll('_', ' ').replace(/^./, (first) => first.toUpperCase());
const is_vector = (value: unknown): value is number[] => Array.isArray(value) && value.length > 0 && value.length <= 4 && value.every((each) => typeof each === 'number');
const figure = (value: number): string => (Number.isInteger(value) ? grouped(value) : rounded(value));

/** Numbers, words and vectors, one per line. Members of nested objects show both names. */
function figures_of(members: Members, before = ''): [string, string][] {
  return Object.entries(members).flatMap(([name, value]): [string, string][] => {
    const label = before ? `${before}, ${name.replaceAll('_', ' ')}` : readable(name);
    if (typeof value === 'number') return [[label, figure(value)]];
    if (typeof value === 'boolean') return [[label, value ? 'yes' : 'no']];
    if (typeof value === 'string' && value.length <= 60) return [[label, value]];
    if (is_vector(value)) return [[label, value.map(figure).join(', ')]];
    if (is_members(value) && Object.keys(value).length <= 8) return figures_of(value, label);
    return [];
  });
}

/** Long texts, tables of objects, and large maps. */
function long_part(name: string, value: unknown): HTMLElement[] {
  const title = el('h3', {}, readable(name));
  if (typeof value === 'string' && value.length > 60) {
    const cut = value.length > longest ? `${value.slice(0, longest)} …` : value;
    return [title, el('pre', { class: 'long', tabindex: 0, 'aria-label': readable(name) }, cut)];
  }
  if (Array.isArray(value) && value.length > 0 && value.every(is_members)) {
    const columns = [...new Set(value.slice(0, 50).flatMap((row) => Object.keys(row)))];
    const cell = (each: unknown): string => (typeof each === 'number' ? figure(each) : is_vector(each) ? each.map(figure).join(', ') : each === undefined ? '' : typeof each === 'string' ? each : JSON.stringify(each).slice(0, 60));
    return [title, el('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': readable(name) }, el('table', {},
      el('thead', {}, el('tr', {}, ...columns.map((column) => el('th', { scope: 'col' }, readable(column))))),
      el('tbody', {}, ...value.slice(0, 200).map((row) => el('tr', {}, ...columns.map((column) => el('td', {}, cell(row[column]))))))))];
  }
  if (is_members(value) && Object.keys(value).length > 8)
    return [title, el('dl', { class: 'figures' }, ...figures_of(value).map(([label, text]) => el('div', {}, el('dt', {}, label), el('dd', {}, text))))];
  return [];
}
