/** The plants of a scene: a click on one shows its word, and its request can be saved or opened. */
import type { Request } from '../api';
import { el, grouped, rounded } from '../dom';
import { is_members } from '../form/schema';
import type { Overlay } from './overlay';

interface Placement { model: string; translation: number[] }
/** The word of a model. A word that is cut has no depth. */
interface Word { string: string; length: number; branches: number; depth: number | null }
interface Answer { placements: Placement[]; models: Record<string, Request>; words?: Record<string, Word> }
export interface PlantActs { save(request: Request, name: string): void; open(request: Request, title: string): void }

/** Longer words are shortened on the page. */
const longest = 4000;

export const is_scene = (answer: object): answer is Answer => {
  const { placements, models } = answer as Partial<Answer>;
  return Array.isArray(placements) && placements.length > 0 && is_members(models);
};

export class PlantList {
  readonly element: HTMLElement;
  private readonly answer: Answer;
  private readonly overlay: Overlay | null;
  private readonly acts: PlantActs;
  private readonly details = el('div', { class: 'picked', role: 'status' });

  constructor(answer: Answer, overlay: Overlay | null, acts: PlantActs) {
    this.answer = answer;
    this.overlay = overlay;
    this.acts = acts;
    this.element = el('section', { class: 'standing' }, el('h3', {}, 'Places'),
      el('p', { class: 'soft' }, `${grouped(answer.placements.length)} models stand here. Click one in the view for its request and its word.`), this.details);
  }

  /** Selects the placement that is nearest to a point of the ground. */
  pick(x: number, z: number): void {
    const away = ({ translation }: Placement): number => Math.hypot((translation[0] ?? 0) - x, (translation[2] ?? 0) - z);
    const nearest = this.answer.placements.reduce<Placement | null>((best, each) => (best === null || away(each) < away(best) ? each : best), null);
    if (!nearest) return;
    const [east = 0, up = 0, south = 0] = nearest.translation;
    this.overlay?.set_boxes([{ origin: [east - 0.5, up, south - 0.5], axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], size: [1, 2, 1] }]);
    this.overlay?.mark_box(0);
    this.show(nearest, away(nearest));
  }

  private show({ model, translation }: Placement, away: number): void {
    const request = this.answer.models[model];
    const word = this.answer.words?.[model];
    const row = (name: string, value: string): HTMLElement => el('div', {}, el('dt', {}, name), el('dd', {}, value));
    this.details.replaceChildren(el('h4', {}, model), el('dl', { class: 'figures' },
      row('Place', translation.map(rounded).join(', ') + ' m'), row('Distance from the click', `${rounded(away)} m`),
      ...(word ? [row('Modules', grouped(word.length)), row('Branches', grouped(word.branches)), row('Depth', word.depth === null ? 'not known, the word is cut' : grouped(word.depth))] : [])));
    if (word) {
      const text = word.string;
      this.details.append(el('pre', { class: 'long', tabindex: 0, 'aria-label': 'Word' }, text.length > longest ? `${text.slice(0, longest)} …` : text));
    }
    if (!request) return;
    this.details.append(el('div', { class: 'row' },
      el('button', { type: 'button', id: 'save-plant', title: 'Saves the request of this model alone', onclick: () => this.acts.save(request, model) }, 'Save this one'),
      el('button', { type: 'button', id: 'open-plant', title: 'Opens this model alone', onclick: () => this.acts.open(request, model) }, 'Open this one')));
  }
}
