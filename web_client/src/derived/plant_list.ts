/** The plants of a scene: a click on one shows its word, and its request can be saved or opened. */
import type { Request } from '../api';
import { el, grouped, rounded } from '../dom';
import { is_members, type Members } from '../form/schema';
import type { Overlay } from './overlay';

interface Placement { model: string; translation: number[]; scale: number[] }
export interface PlantActs { save(request: Request, name: string): void; open(request: Request, title: string): void }

const is_placement = (value: unknown): value is Placement => is_members(value) && typeof value['model'] === 'string' && Array.isArray(value['translation']);

/** Longer words are shortened on the page. */
const longest = 4000;

export const is_scene = (answer: Members): boolean => Array.isArray(answer['placements']) && answer['placements'].some(is_placement) && is_members(answer['models']);

export class PlantList {
  readonly element: HTMLElement;
  private readonly placements: Placement[];
  private readonly models: Members;
  private readonly words: Members;
  private readonly overlay: Overlay | null;
  private readonly acts: PlantActs;
  private readonly details = el('div', { class: 'picked', role: 'status' });

  constructor(answer: Members, overlay: Overlay | null, acts: PlantActs) {
    this.placements = (answer['placements'] as unknown[]).filter(is_placement);
    this.models = answer['models'] as Members;
    this.words = is_members(answer['words']) ? answer['words'] : {};
    this.overlay = overlay;
    this.acts = acts;
    this.element = el('section', { class: 'plants' }, el('h3', {}, 'Places'),
      el('p', { class: 'soft' }, `${grouped(this.placements.length)} models stand here. Click one in the view for its request and its word.`), this.details);
  }

  /** Selects the placement that is nearest to a point of the ground. */
  pick(x: number, z: number): void {
    const away = ({ translation }: Placement): number => Math.hypot((translation[0] ?? 0) - x, (translation[2] ?? 0) - z);
    const nearest = this.placements.reduce<Placement | null>((best, each) => (best === null || away(each) < away(best) ? each : best), null);
    if (!nearest) return;
    const [east = 0, up = 0, south = 0] = nearest.translation;
    this.overlay?.set_boxes([{ origin: [east - 0.5, up, south - 0.5], axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], size: [1, 2, 1] }]);
    this.overlay?.mark_box(0);
    this.show(nearest, away(nearest));
  }

  private show({ model, translation }: Placement, away: number): void {
    const request = this.models[model];
    const word = this.words[model];
    const row = (name: string, value: string): HTMLElement => el('div', {}, el('dt', {}, name), el('dd', {}, value));
    const number = (of: Members, name: string): string => (typeof of[name] === 'number' ? grouped(of[name]) : 'not known, the word is cut');
    this.details.replaceChildren(el('h4', {}, model), el('dl', { class: 'figures' },
      row('Place', translation.map(rounded).join(', ') + ' m'), row('Distance from the click', `${rounded(away)} m`),
      ...(is_members(word) ? [row('Modules', number(word, 'length')), row('Branches', number(word, 'branches')), row('Depth', number(word, 'depth'))] : [])));
    if (is_members(word)) {
      const text = String(word['string']);
      this.details.append(el('pre', { class: 'long', tabindex: 0, 'aria-label': 'Word' }, text.length > longest ? `${text.slice(0, longest)} …` : text));
    }
    if (!is_members(request)) return;
    const whole = request as unknown as Request;
    this.details.append(el('div', { class: 'row' },
      el('button', { type: 'button', id: 'save-plant', title: 'Saves the request of this model alone', onclick: () => this.acts.save(whole, model) }, 'Save this one'),
      el('button', { type: 'button', id: 'open-plant', title: 'Opens this model alone', onclick: () => this.acts.open(whole, model) }, 'Open this one')));
  }
}
