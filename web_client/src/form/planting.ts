/**
 * The lists of places of a form share one picture: its clicks go to one of them, and the marks on its ground are of all.
 * The picture speaks by events on the canvas and knows no list.
 */
import { part } from '../dom';

/**
 * What the picture tells of a click that was no drag: where on the ground, how wide it may miss, and whether there is any ground. A long
 * press of a finger is a right click.
 */
export interface GroundClick { x: number; z: number; button: number; reach: number; on_ground: boolean }
/** What it is asked to mark; `chosen` counts among all places. */
export interface GroundMarks { places: Spot[]; chosen: number }

/** East and south of the middle, in metres. */
export type Spot = [number, number];
/** What a plain click does. */
export type Way = 'choose' | 'plant' | 'move';

/** A list of places, as the picture knows it. */
export interface Bed {
  readonly box: HTMLElement;
  readonly way: Way;
  readonly chosen: number;
  places(): Spot[];
  plant(spot: Spot): void;
  move(spot: Spot): void;
  /** -1 for none. */
  choose(index: number): void;
  remove(): void;
}

/** More marks hide the model, and each of them has to find its ground. */
const most_marks = 400;
const hundredth = (value: number): number => Math.round(value * 100) / 100;

/** By the pointer of the list, because a list is drawn anew whenever it changes. */
const beds = new Map<string, Bed>();
let last_used = '';
let in_sight = false;
let is_marking = false;
let is_wired = false;

/** Takes a list in, or takes it in again after it was drawn anew. */
export function enter(pointer: string, bed: Bed): void {
  if (beds.size === 0) wire();
  beds.set(pointer, bed);
  mark();
}

/** The list that a hand has used last takes what is planted next. */
export const use = (pointer: string): void => { last_used = pointer; };

function living(): [string, Bed][] {
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

/** Once for all lists that are drawn in this moment. Marks stand only while the form is in sight. */
export function mark(): void {
  if (is_marking) return;
  is_marking = true;
  queueMicrotask(() => {
    is_marking = false;
    const places: Spot[] = [];
    let chosen = -1;
    for (const [, bed] of in_sight ? living() : []) {
      if (bed.chosen >= 0) chosen = places.length + bed.chosen;
      places.push(...bed.places());
    }
    // The chosen one is marked however many there are.
    if (chosen >= most_marks) { places[0] = places[chosen]!; chosen = 0; }
    const detail: GroundMarks = { places: places.slice(0, most_marks), chosen };
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
    tell('There is no ground at this place');
  } else if (click.button === 2 || planting) {
    // Where nothing was used yet, the list that has most is meant: the trees rather than the house.
    const fullest = [...all].sort((a, b) => b[1].places().length - a[1].places().length)[0];
    const taker = planting ?? all.find(([pointer]) => pointer === last_used) ?? (all.length === 1 || fullest?.[1].places().length ? fullest : undefined);
    if (!taker) { tell('Nothing here stands place by place yet. Add the first place in the form'); return; }
    choose_only(taker[0], all);
    use(taker[0]);
    taker[1].plant(spot);
    // Who has another page open sees neither the list nor the marks.
    if (!in_sight) tell(`Planted at ${spot.join(', ')} m, for the list under Parameters. Undo takes it away`);
  } else if (click.button === 0 && moving) {
    moving[1].move(spot);
  } else if (click.button === 0) {
    choose_nearest(click, all);
  }
}

const tell = (detail: string): void => void part('picture').dispatchEvent(new CustomEvent('tell', { bubbles: true, detail }));

function choose_nearest(click: GroundClick, all: [string, Bed][]): void {
  let nearest: { pointer: string; bed: Bed; index: number } | null = null, least = click.reach;
  for (const [pointer, bed] of all) {
    bed.places().forEach(([x, z], index) => {
      const distance = Math.hypot(x - click.x, z - click.z);
      if (distance <= least) { least = distance; nearest = { pointer, bed, index }; }
    });
  }
  const found = nearest as { pointer: string; bed: Bed; index: number } | null;
  choose_only(found?.pointer ?? '', all);
  if (!found) return;
  use(found.pointer);
  found.bed.choose(found.index);
}

/** Lets go of what is chosen in the other lists. */
function choose_only(pointer: string, all: [string, Bed][]): void {
  for (const [other, bed] of all) if (other !== pointer && bed.chosen >= 0) bed.choose(-1);
}

/** Called by a list in which a hand has chosen. */
export const chosen_in = (pointer: string): void => { use(pointer); choose_only(pointer, living()); };
