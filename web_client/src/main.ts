/**
 * Brings the parts together. The address tells what is shown: `#…` carries a request; in the query `quality=low` or
 * `quality=high` chooses how it is drawn, and `stage` leaves only the picture, for making pictures.
 */
import { Refusal, get_preset, get_presets, get_schema, type Fault, type Made, type Preset, type Request } from './api';
import { wire_copies, wire_downloads } from './actions';
import { el, grouped, part, rounded } from './dom';
import { draw_form, type Form } from './form/form';
import { draw_gallery, type Gallery } from './gallery';
import { Grower, Patience } from './grower';
import { pack, unpack } from './link';
import { wire_seed } from './seed';
import { Store, type State } from './state';
import { wire_status } from './status';
import { wire_tabs } from './tabs';
import { show_measures, wire_view } from './view_tools';
import { Viewer } from './viewer/viewer';
import './style/base.css';
import './style/layout.css';
import './style/gallery.css';
import './style/form.css';

/** What a visitor sees first, where the server has it. */
const first_shown = 'kogovsek_grm';

interface Memory { preset: string | null }

const query = new URLSearchParams(location.search);
const dark = matchMedia('(prefers-color-scheme: dark)');
const still = matchMedia('(prefers-reduced-motion: reduce)');

const store = new Store();
const status = wire_status();
const tabs = wire_tabs();
const patience = new Patience();
const viewer = make_viewer();
const seed = wire_seed((value) => store.edit({ seed: value }));
const grower = new Grower((phase) => {
  status.phase(phase);
  if (phase.kind === 'refused') refuse(phase.refusal);
}, show);

let presets: Preset[] = [];
let gallery: Gallery | null = null;
let form: Form | null = null;
let drawn_for = '';
let opening = new AbortController();
let keep_camera = false;
let address_timer = 0;
let last_refusal: Refusal | null = null;
/** The model that is shown is not the one that the link meant: that has to stay readable. */
let link_is_damaged = false;

/** A machine without a graphics card says so in the name of its renderer. */
function make_viewer(): Viewer | null {
  const asked = query.get('quality');
  const soft = /swiftshader|llvmpipe|software/i.test(renderer_name());
  document.body.classList.toggle('stage', query.has('stage'));
  try {
    const made = new Viewer(part<HTMLCanvasElement>('picture'), {
      quality: asked === 'low' || (asked !== 'high' && soft) ? 'low' : 'high', dark: dark.matches, still: still.matches, covered: query.has('stage') ? 0 : 72,
    });
    if (query.has('stage')) { made.set_grid(false); made.set_figure(false); }
    made.on_context = (lost) => status.lost(lost);
    dark.addEventListener('change', () => made.set_theme(dark.matches));
    return made;
  } catch {
    status.faults('This browser gives no picture: WebGL 2 is missing or switched off. Downloads work all the same.', [], 0, () => {});
    return null;
  }
}

function renderer_name(): string {
  const context = document.createElement('canvas').getContext('webgl2');
  const detail = context?.getExtension('WEBGL_debug_renderer_info');
  const name = context && detail ? String(context.getParameter(detail.UNMASKED_RENDERER_WEBGL)) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return name;
}

async function show(made: Made, request: Request): Promise<void> {
  await viewer?.show(made.bytes, keep_camera);
  keep_camera = true;
  last_refusal = null;
  form?.show_faults([]);
  if (viewer && !link_is_damaged) status.faults('', [], 0, () => {});
  if (viewer) show_measures(viewer);
  status.shown(made.statistics);
  const size = viewer?.measures.size;
  const measure = size ? `, ${rounded(size.x)} m wide, ${rounded(size.y)} m high, ${rounded(size.z)} m deep` : '';
  part('picture').setAttribute('aria-label',
    `${store.current?.title ?? 'Model'}, seed ${request.seed}: ${grouped(made.statistics.triangles)} triangles${measure}`);
  document.body.dataset['shown'] = String(Number(document.body.dataset['shown']) + 1);
}

function refuse(refusal: Refusal): void {
  last_refusal = refusal;
  const homeless = form ? form.show_faults(refusal.faults) : refusal.faults;
  const in_fields = refusal.faults.length - homeless.length;
  // One fault is its own summary.
  const rest = homeless.filter((fault: Fault) => fault.message !== refusal.message);
  status.faults(refusal.message, rest, in_fields, () => {
    tabs.open('parameters');
    const faulty = part('parameters').querySelector<HTMLElement>('.faulty .spot, .faulty input, .faulty textarea, .faulty select');
    faulty?.focus();
    faulty?.scrollIntoView({ block: 'center' });
  });
}

/** The form of the request's generator; drawn once for each request that is opened. */
async function draw_parameters(state: State, signal: AbortSignal): Promise<void> {
  const schema = await persist(() => get_schema(state.request.generator, signal), signal);
  own_formats = schema['x-formats'] ?? [];
  offer_downloads();
  form = draw_form(schema, state.request.parameters, state.base.parameters, '/parameters', (parameters) => store.edit({ parameters }));
  part('parameters').replaceChildren(
    el('h2', { class: 'unseen' }, 'Parameters'),
    el('p', { class: 'soft about' }, state.description || schema.description || ''), form.element);
  // The answer may have come before the form.
  if (last_refusal) refuse(last_refusal);
}

/** The address carries what is shown; the entry of the history also remembers which preset it came from. */
async function write_address(state: State, how: 'push' | 'replace'): Promise<void> {
  const text = `#${await pack(state.request)}`;
  if (store.current !== state) return;
  drawn_for = text;
  const memory: Memory = { preset: state.preset };
  if (how === 'push') history.pushState(memory, '', text);
  else history.replaceState(memory, '', text);
}

const persist = <T>(task: () => Promise<T>, signal: AbortSignal): Promise<T> =>
  patience.persist(task, (reason, until) => status.phase({ kind: 'waiting', reason, until }), signal);

store.subscribe((state, cause) => {
  seed.show(state.request.seed);
  part('title').textContent = state.title;
  gallery?.mark(state.preset);
  if (cause === 'open') {
    keep_camera = false;
    form = null;
    const { signal } = opening;
    last_refusal = null;
    quietly(draw_parameters(state, signal));
  } else {
    link_is_damaged = false;
    // Browsers refuse to change the address as fast as a slider moves.
    clearTimeout(address_timer);
    address_timer = window.setTimeout(() => quietly(write_address(state, 'replace')), 300);
  }
  grower.ask(state.request, cause === 'open' ? 'now' : 'soon');
});

function begin_opening(): AbortSignal {
  opening.abort();
  opening = new AbortController();
  link_is_damaged = false;
  return opening.signal;
}

async function open_preset(preset: Preset): Promise<void> {
  const signal = begin_opening();
  gallery?.mark(preset.name);
  const request = await persist(() => get_preset(preset.name, signal), signal);
  store.open(request, { preset: preset.name, title: preset.title, description: preset.description });
}

async function open_link(fragment: string): Promise<void> {
  begin_opening();
  drawn_for = fragment;
  try {
    const request = await unpack(fragment.slice(1));
    const from = presets.find((preset) => preset.name === (history.state as Memory | null)?.preset);
    store.open(request, { preset: from?.name ?? null, title: from?.title ?? 'From a link', description: from?.description ?? '' });
  } catch {
    if (!store.current) await open_first();
    link_is_damaged = true;
    status.faults('This link is damaged: it holds no whole request. Ask for it once more, or choose from the gallery.', [], 0, () => {});
  }
}

const open_first = (): Promise<void> => {
  drawn_for = '';
  const first = presets.find((preset) => preset.name === first_shown) ?? presets[0];
  return first ? open_preset(first) : Promise.resolve();
};

const open_address = (): Promise<void> => (location.hash.length > 1 ? open_link(location.hash) : open_first());

/** A card leaves an entry in the browser's history, so that Back returns to what was shown before. */
async function choose(preset: Preset): Promise<void> {
  await open_preset(preset);
  clearTimeout(address_timer);
  if (store.current?.preset === preset.name) await write_address(store.current, 'push');
}

const quietly = (task: Promise<void>): void => {
  task.catch((error: unknown) => { if (error instanceof Refusal) refuse(error); });
};

/** The formats of all models, and those of the generator that is shown. */
let model_formats = ['glb'];
let own_formats: string[] = [];
const offer_downloads = (): void => wire_downloads([...model_formats, ...own_formats], actions);

const actions = {
  request: (): Request | null => store.current?.request ?? null,
  name: (): string => `${store.current?.preset ?? 'seedmesh'}-${store.current?.request.seed ?? 0}`,
  say: status.say,
  fail: (text: string): void => status.faults(text, [], 0, () => {}),
};

async function start(): Promise<void> {
  wire_copies(actions);
  if (viewer) wire_view(viewer, seed.roll);
  part('cancel').addEventListener('click', () => grower.cancel());
  const again = (): void => { patience.nudge(); grower.again(); };
  part('again').addEventListener('click', again);
  addEventListener('online', () => { if (['gone', 'full'].includes(document.body.dataset['state'] ?? '')) again(); });
  addEventListener('hashchange', () => { if (location.hash !== drawn_for) quietly(open_address()); });

  const { signal } = new AbortController();
  presets = await persist(() => get_presets(signal), signal);
  gallery = draw_gallery(part('gallery'), presets, (preset) => quietly(choose(preset)));
  quietly(open_address());

  const output = await persist(() => get_schema('output', signal), signal);
  model_formats = output['x-formats'] ?? model_formats;
  offer_downloads();
}

quietly(start());
