/**
 * Draws the plan of a city from above with north at the top. Steps show the streets first, then blocks, lots and
 * buildings. A click selects a street, a block or a lot, and shows its properties and the request of its building.
 */
import type { Request } from '../api';
import { el, grouped, icon, rounded } from '../dom';
import { is_members, type Members } from '../form/schema';

type Point = [number, number];
interface Feature { kind: string; properties: Members; rings: Point[][]; box: [number, number, number, number] }

const steps = ['Highways', 'Streets', 'Blocks', 'Lots', 'Buildings'] as const;

/** Drawn from the bottom to the top. */
const fills: Record<string, string> = { water: '#8fb3c9', park: '#9dbf7f', square: '#d9c9a3', verge: '#c8cfae', lot: '#ece5d5', carriageway: '#8d8f93', junction: '#8d8f93', sidewalk: '#c9c6bf' };
const wide = new Set(['highway', 'major']);
const selected = '#c2410c';
/** How far a click may be from the line of a street, in pixels. */
const reach = 5;

export const is_plan = (value: unknown): value is { features: unknown[] } =>
  is_members(value) && value['type'] === 'FeatureCollection' && Array.isArray(value['features']);

const is_point = (value: unknown): value is Point => Array.isArray(value) && typeof value[0] === 'number' && typeof value[1] === 'number';

function rings_of(geometry: Members): Point[][] {
  const { coordinates } = geometry;
  if (!Array.isArray(coordinates)) return [];
  const lists = geometry['type'] === 'Polygon' ? coordinates : geometry['type'] === 'LineString' ? [coordinates] : [[coordinates]];
  return lists.map((list) => (Array.isArray(list) ? list.filter(is_point) : []));
}

function feature_of(value: unknown): Feature | null {
  if (!is_members(value) || !is_members(value['geometry']) || !is_members(value['properties'])) return null;
  const { geometry, properties } = value as { geometry: Members; properties: Members };
  const rings = rings_of(geometry), all = rings.flat();
  if (all.length === 0 || typeof properties['kind'] !== 'string') return null;
  const xs = all.map(([x]) => x), ys = all.map(([, y]) => y);
  return { kind: properties['kind'], properties, rings, box: [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)] };
}

/** By the even-odd rule. */
function holds(feature: Feature, [x, y]: Point): boolean {
  const [west, south, east, north] = feature.box;
  if (x < west || x > east || y < south || y > north) return false;
  let inside = false;
  for (const ring of feature.rings) {
    ring.forEach(([ax, ay], index) => {
      const [bx, by] = ring[(index + 1) % ring.length] ?? [ax, ay];
      if (ay > y !== by > y && x < ax + (bx - ax) * (y - ay) / (by - ay)) inside = !inside;
    });
  }
  return inside;
}

function distance_to(line: Point[], [x, y]: Point): number {
  let least = Infinity;
  line.slice(1).forEach(([bx, by], index) => {
    const [ax, ay] = line[index] ?? [bx, by];
    const length = (bx - ax) ** 2 + (by - ay) ** 2;
    const share = length > 0 ? Math.min(1, Math.max(0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length)) : 0;
    least = Math.min(least, Math.hypot(x - ax - share * (bx - ax), y - ay - share * (by - ay)));
  });
  return least;
}

/** The footprint of a building by the size in its request. */
function footprint_of({ properties }: Feature): Point[] {
  const { building, position, turn } = properties;
  if (!is_members(building) || !is_members(building['parameters']) || !is_point(position)) return [];
  const { size } = building['parameters'] as { size?: unknown };
  if (!Array.isArray(size)) return [];
  const angle = Number(turn ?? 0) * Math.PI / 180, [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [width, depth] = [Number(size[0]) / 2, Number(size[2]) / 2];
  return ([[-1, -1], [1, -1], [1, 1], [-1, 1]] as Point[]).map(([u, v]) =>
    [position[0] + u * width * cos - v * depth * sin, position[1] + u * width * sin + v * depth * cos]);
}

export class CityPlanView {
  readonly element: HTMLElement;
  private readonly features: Feature[];
  private readonly footprints: Point[][];
  private readonly open: (request: Request, title: string) => void;
  private readonly canvas = el('canvas', { class: 'city-plan', role: 'img', width: 720, height: 720 });
  private readonly details = el('div', { class: 'picked', role: 'status' });
  private readonly range = el('input', { type: 'range', id: 'plan-step', min: 1, max: steps.length, value: steps.length });
  private readonly step_name = el('output', { for: 'plan-step' });
  /** Metres of the middle of the picture, and pixels for each metre. */
  private middle: Point = [0, 0];
  private scale = 1;
  private least_scale = 1;
  private picked: Feature | null = null;

  constructor(plan: { features: unknown[] }, open: (request: Request, title: string) => void) {
    this.open = open;
    this.features = plan.features.map(feature_of).filter((each) => each !== null);
    this.footprints = this.features.filter(({ kind }) => kind === 'lot').map(footprint_of).filter((each) => each.length > 0);
    const count = (kind: string): string => grouped(this.features.filter((each) => each.kind === kind).length);
    this.canvas.setAttribute('aria-label', `Plan with ${count('street')} streets, ${count('block')} blocks and ${count('lot')} lots`);
    const [west, south, east, north] = this.extent();
    this.canvas.height = Math.round(this.canvas.width * Math.min(Math.max((north - south) / (east - west), 0.4), 1.4));
    this.fit();
    this.range.addEventListener('input', () => { this.picked = null; this.describe(); this.draw(); });
    this.canvas.addEventListener('click', (event) => { if (!this.moved) this.pick(this.place_of(event)); });
    this.canvas.addEventListener('wheel', (event) => { event.preventDefault(); this.zoom(event.deltaY < 0 ? 1.25 : 0.8, this.place_of(event)); }, { passive: false });
    this.wire_drag();
    const button = (label: string, sign: Node | string, act: () => void): HTMLElement => el('button', { type: 'button', 'aria-label': label, title: label, onclick: act }, sign);
    this.element = el('section', { class: 'plan' }, el('h3', {}, 'Plan'),
      el('div', { class: 'row' }, el('label', { for: 'plan-step' }, 'Step'), this.range, this.step_name),
      this.canvas,
      el('div', { class: 'row' }, button('Zoom in', '+', () => this.zoom(1.5, this.middle)), button('Zoom out', '−', () => this.zoom(1 / 1.5, this.middle)),
        button('Whole plan', 'All', () => { this.fit(); this.draw(); }),
        button('Previous of these', icon('back'), () => this.pick_next(-1)), button('Next of these', icon('next'), () => this.pick_next(1))),
      el('p', { class: 'soft' }, 'Click a street, a block or a lot for its details. Scroll to zoom, and drag to move.'), this.details);
    this.draw();
  }

  /** The step and the selection of the previous plan, kept when the request changes. */
  take_over(before: CityPlanView): void {
    this.range.value = before.range.value;
    const id = before.picked?.properties['id'], kind = before.picked?.kind;
    this.picked = this.features.find((each) => id !== undefined && each.kind === kind && each.properties['id'] === id) ?? null;
    this.describe();
    this.draw();
  }

  private moved = false;

  private wire_drag(): void {
    let from: Point | null = null;
    this.canvas.addEventListener('pointerdown', (event) => { from = this.place_of(event); this.moved = false; });
    this.canvas.addEventListener('pointermove', (event) => {
      if (!from || event.buttons === 0) return;
      const [x, y] = this.place_of(event);
      if (Math.hypot(x - from[0], y - from[1]) * this.scale < 4 && !this.moved) return;
      this.moved = true;
      this.middle = [this.middle[0] + from[0] - x, this.middle[1] + from[1] - y];
      this.draw();
    });
    this.canvas.addEventListener('pointerup', () => { from = null; });
  }

  private extent(): Feature['box'] {
    return this.features.find(({ kind }) => kind === 'area')?.box ?? [-1, -1, 1, 1];
  }

  private fit(): void {
    const [west, south, east, north] = this.extent();
    this.middle = [(west + east) / 2, (south + north) / 2];
    this.scale = this.least_scale = 0.96 * Math.min(this.canvas.width / (east - west), this.canvas.height / (north - south));
  }

  private zoom(factor: number, [x, y]: Point): void {
    const before = this.scale;
    this.scale = Math.min(Math.max(this.scale * factor, this.least_scale), 40);
    const share = before / this.scale;
    this.middle = [x + (this.middle[0] - x) * share, y + (this.middle[1] - y) * share];
    this.draw();
  }

  private place_of(event: MouseEvent): Point {
    const area = this.canvas.getBoundingClientRect();
    const x = (event.clientX - area.left) / area.width - 0.5, y = (event.clientY - area.top) / area.height - 0.5;
    return [this.middle[0] + x * this.canvas.width / this.scale, this.middle[1] - y * this.canvas.height / this.scale];
  }

  private get step(): number { return Number(this.range.value); }

  /** The features that the step shows and a click selects, those on top last. */
  private shown(): Feature[] {
    const { step } = this;
    const of_kind = (kind: string): Feature[] => this.features.filter((each) => each.kind === kind);
    const streets = of_kind('street').filter(({ properties }) => step > 1 || wide.has(String(properties['class'])));
    return [...(step >= 3 ? of_kind('block') : []), ...(step >= 4 ? of_kind('lot') : []), ...streets];
  }

  private pick(place: Point): void {
    const found = this.shown().reverse().find((each) => (each.kind === 'street'
      ? distance_to(each.rings[0] ?? [], place) <= Math.max(Number(each.properties['width'] ?? 0) / 2, reach / this.scale)
      : holds(each, place)));
    this.picked = found ?? null;
    this.describe();
    this.draw();
  }

  private pick_next(by: number): void {
    const shown = this.shown();
    const of_kind = this.picked ? shown.filter(({ kind }) => kind === this.picked?.kind) : shown.filter(({ kind }) => kind === shown[shown.length - 1]?.kind);
    const at = this.picked ? of_kind.indexOf(this.picked) : -1;
    this.picked = of_kind[(at + by + of_kind.length) % of_kind.length] ?? null;
    this.describe();
    this.draw();
  }

  private describe(): void {
    const { picked } = this;
    if (!picked) { this.details.replaceChildren(); return; }
    const { building, ...rest } = picked.properties;
    const text = (value: unknown): string => (typeof value === 'number' ? rounded(value) : Array.isArray(value) ? `${value.length > 6 ? grouped(value.length) : value.map(text).join(', ')}` : value === null ? 'none' : typeof value === 'boolean' ? (value ? 'yes' : 'no') : String(value));
    const rows = Object.entries(rest).filter(([name]) => name !== 'kind')
      .map(([name, value]) => el('div', {}, el('dt', {}, name.replaceAll('_', ' ').replace(/^./, (first) => first.toUpperCase())), el('dd', {}, text(value))));
    const title = picked.kind.replace(/^./, (first) => first.toUpperCase());
    const request = is_members(building) ? building as unknown as Request : null;
    this.details.replaceChildren(el('h4', {}, title), el('dl', { class: 'figures' }, ...rows),
      ...(request ? [el('button', { type: 'button', id: 'open-building', onclick: () => this.open(request, 'Building of a lot') }, 'Open its building')] : []));
  }

  private draw(): void {
    const context = this.canvas.getContext('2d');
    this.step_name.textContent = steps[this.step - 1] ?? '';
    if (!context) return;
    const { width, height } = this.canvas, { scale, middle, step } = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    context.setTransform(scale, 0, 0, -scale, width / 2 - middle[0] * scale, height / 2 + middle[1] * scale);
    const half: Point = [width / 2 / scale, height / 2 / scale];
    const is_visible = ({ box }: Feature): boolean => box[0] <= middle[0] + half[0] && box[2] >= middle[0] - half[0] && box[1] <= middle[1] + half[1] && box[3] >= middle[1] - half[1];
    const trace = (lines: Point[][], closed: boolean): void => {
      context.beginPath();
      for (const line of lines) {
        line.forEach(([x, y], index) => (index === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
        if (closed) context.closePath();
      }
    };
    const fill = (kind: string, color: string): void => {
      context.fillStyle = color;
      trace(this.features.filter((each) => each.kind === kind && is_visible(each)).flatMap(({ rings }) => rings), true);
      context.fill('evenodd');
    };
    context.fillStyle = '#f4f1ea';
    trace(this.features.find(({ kind }) => kind === 'area')?.rings ?? [], true);
    context.fill('evenodd');
    fill('water', fills['water']!);
    if (step >= 3) for (const kind of ['verge', 'park', 'square', 'lot', 'sidewalk', 'carriageway', 'junction']) fill(kind, fills[kind]!);
    if (step >= 4) {
      context.strokeStyle = '#b3a88f';
      context.lineWidth = 1 / scale;
      trace(this.features.filter((each) => each.kind === 'lot' && is_visible(each)).flatMap(({ rings }) => rings), true);
      context.stroke();
    }
    if (step >= 5) {
      context.fillStyle = '#7c5b4a';
      trace(this.footprints, true);
      context.fill();
    }
    if (step < 3) {
      for (const { rings, properties } of this.features.filter((each) => each.kind === 'street' && is_visible(each) && (step > 1 || wide.has(String(each.properties['class']))))) {
        context.strokeStyle = wide.has(String(properties['class'])) ? '#3f4145' : '#8d8f93';
        context.lineWidth = Math.max(Number(properties['width'] ?? 6), 1.2 / scale);
        trace(rings, false);
        context.stroke();
      }
    }
    if (!this.picked) return;
    context.strokeStyle = selected;
    context.lineWidth = (this.picked.kind === 'street' ? 5 : 3) / scale;
    trace(this.picked.rings, this.picked.kind !== 'street');
    context.stroke();
  }
}
