/**
 * Connects all position lists of a form with the view. A click in the view goes to one of the lists; the markers show
 * the positions of all. The view communicates by events on the canvas and has no knowledge of the lists.
 */
import { part } from '../dom';

/**
 * The event detail of a click that was not a drag: the position on the ground, the tolerance for selecting a marker,
 * and whether the click met ground. A long press counts as a right click.
 */
export interface GroundClick { x: number; z: number; button: number; reach: number; on_ground: boolean }
/** The markers to show; `chosen` is an index into all positions. */
export interface GroundMarks { positions: Spot[]; chosen: number }

/** Metres east and south of the centre. */
export type Spot = [number, number];
/** The action of a plain click. */
export type Way = 'choose' | 'plant' | 'move';

/** A list of positions, as the view needs it. */
export interface PlacementList {
  readonly box: HTMLElement;
  readonly way: Way;
  readonly chosen: number;
  positions(): Spot[];
  plant(spot: Spot): void;
  move(spot: Spot): void;
  /** The index of the selected position, or -1. */
  choose(index: number): void;
  remove(): void;
}

/** More markers would hide the model, and each needs its ground height computed. */
const most_marks = 400;
const hundredth = (value: number): number => Math.round(value * 100) / 100;

/** Keyed by the pointer of the list, because a list is recreated whenever it changes. */
const beds = new Map<string, PlacementList>();
let last_used = '';
let in_sight = false;
let is_marking = false;
let is_wired = false;

/** Registers a list, or registers it again after it was redrawn. */
export function enter(pointer: string, bed: PlacementList): void {
  if (beds.size === 0) wire();
  beds.set(pointer, bed);
  mark();
}

/** The list that was used last receives the next position. */
export const use = (pointer: string): void => { last_used = pointer; };

function living(): [string, PlacementList][] {
  for (const [pointer, bed] of beds) if (!bed.box.isConnected) beds.delete(pointer);
  return [...beds];
}

function wire(): void {
  const picture = part('picture');
  if (is_wired) return;
  is_wired = true;
  picture.addEventListener('ground-click', (event) => clicked((event as CustomEvent<GroundClick>).detail));
  picture.addEventListener('ground-changed', mark);
  picture.addEventListener('keydown', (event) => { if (event.key === 'Delete') living().find(([, bed]) => bed.chosen >= 0)?.[1].remove(); });
  new IntersectionObserver((entries) => {
    in_sight = entries.at(-1)?.isIntersecting ?? false;
    mark();
  }).observe(part('parameters'));
}

/** Runs once for all lists that are drawn in the same task. Markers are shown only while the form is visible. */
export function mark(): void {
  if (is_marking) return;
  is_marking = true;
  queueMicrotask(() => {
    is_marking = false;
    const positions: Spot[] = [];
    let chosen = -1;
    for (const [, bed] of in_sight ? living() : []) {
      if (bed.chosen >= 0) chosen = positions.length + bed.chosen;
      positions.push(...bed.positions());
    }
    // The selected position is always marked.
    if (chosen >= most_marks) { positions[0] = positions[chosen]!; chosen = 0; }
    const detail: GroundMarks = { positions: positions.slice(0, most_marks), chosen };
    part('picture').dispatchEvent(new CustomEvent('mark-ground', { detail }));
  });
}

function clicked(click: GroundClick): void {
  const all = living();
  if (all.length === 0) return;
  const spot: Spot = [hundredth(click.x), hundredth(click.z)];
  const planting = all.find(([, bed]) => bed.way === 'plant');
  const moving = all.find(([, bed]) => bed.way === 'move' && bed.chosen >= 0);
  const is_put = click.button === 2 || planting !== undefined || (click.button === 0 && moving !== undefined);
  if (is_put && !click.on_ground) {
    tell('There is no ground at this position');
  } else if (click.button === 2 || planting) {
    // If no list was used yet, the one with the most positions is chosen: the trees rather than the house.
    const fullest = [...all].sort((a, b) => b[1].positions().length - a[1].positions().length)[0];
    const taker = planting ?? all.find(([pointer]) => pointer === last_used) ?? (all.length === 1 || fullest?.[1].positions().length ? fullest : undefined);
    if (!taker) { tell('No layer has single positions yet. Add the first position in the form'); return; }
    choose_only(taker[0], all);
    use(taker[0]);
    taker[1].plant(spot);
    // On another tab neither the list nor its markers are visible, so a message confirms the new position.
    if (!in_sight) tell(`Planted at ${spot.join(', ')} m in the list under Parameters. Undo removes it`);
  } else if (click.button === 0 && moving) {
    moving[1].move(spot);
  } else if (click.button === 0) {
    choose_nearest(click, all);
  }
}

const tell = (detail: string): void => void part('picture').dispatchEvent(new CustomEvent('tell', { bubbles: true, detail }));

function choose_nearest(click: GroundClick, all: [string, PlacementList][]): void {
  let nearest: { pointer: string; bed: PlacementList; index: number } | null = null, least = click.reach;
  for (const [pointer, bed] of all) {
    bed.positions().forEach(([x, z], index) => {
      const distance = Math.hypot(x - click.x, z - click.z);
      if (distance <= least) { least = distance; nearest = { pointer, bed, index }; }
    });
  }
  const found = nearest as { pointer: string; bed: PlacementList; index: number } | null;
  choose_only(found?.pointer ?? '', all);
  if (!found) return;
  use(found.pointer);
  found.bed.choose(found.index);
}

/** Clears the selection of all other lists. */
function choose_only(pointer: string, all: [string, PlacementList][]): void {
  for (const [other, bed] of all) if (other !== pointer && bed.chosen >= 0) bed.choose(-1);
}

/** Called by a list when the user selects one of its entries. */
export const chosen_in = (pointer: string): void => { use(pointer); choose_only(pointer, living()); };
