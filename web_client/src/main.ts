/**
 * Connects the parts of the page. The fragment of the address holds the request. The query `quality=low` or
 * `quality=high` sets the rendering quality, and `stage` hides everything but the view, for screenshots.
 */
import { Locked, Refusal, get_preset, get_offer, get_schema, type Issue, type Generator, type Made, type Preset, type Request } from './api';
import { Address, first_shown } from './address';
import { Checker, joined } from './checker';
import { el, grouped, part, sentence } from './dom';
import type { Form } from './form/form';
import type { OutputForm } from './form/output_form';
import { same, type Schema } from './form/schema';
import { draw_gallery, type Gallery } from './gallery';
import { Grower, Retrier } from './grower';
import { forget_hint, wire_hint } from './hint';
import { reopen } from './key';
import { fragment_of } from './link';
import { for_view, is_output, motions_in, own_formats, with_formats, type Motion } from './for_view';
import { wire_seed } from './seed';
import { is_high, make_viewer } from './setup';
import { Store, type State } from './state';
import { wire_status } from './status';
import { wire_tabs } from './tabs';
import type { Core, Tools } from './tools';
import { show_measures, sides_of, still_shown } from './measures';
import type { Model } from './viewer/model';
import { warnings_in } from './warnings';
import './style/base.css';
import './style/layout.css';
import './style/gallery.css';
import './style/form.css';
import './style/view.css';

/** Requested early, so that the server answers while the view is set up. The first caller takes the result. */
function begun<T>(task: () => Promise<T>): (again: () => Promise<T>) => Promise<T> {
  let early: Promise<T> | null = task();
  early.catch(() => { /* The caller that takes the result handles the error. */ });
  return (again) => {
    const taken = early ?? again();
    early = null;
    return taken;
  };
}
const early_offer = begun(get_offer);
const early_first = location.hash.length > 1 ? null : begun(() => get_preset(first_shown));

const store = new Store();
const status = wire_status();
const retrier = new Retrier();
const high = is_high();
const viewer = make_viewer(status, high);
const seed = wire_seed((value) => store.edit({ seed: value }));
const grower = new Grower((phase) => {
  // The state `locked` is kept until the key dialog is answered, even if a model is being generated.
  if (!is_locked || phase.kind !== 'growing') status.phase(phase);
  if (phase.kind === 'refused' && phase.refusal instanceof Locked) locked(phase.refusal, () => grower.again());
  else if (phase.kind === 'refused') refuse(phase.refusal);
  if (phase.kind === 'ready' || phase.kind === 'refused') settle(phase.kind === 'ready');
  if (phase.kind === 'refused' || phase.kind === 'stopped') mark_previous_model();
}, show, async (triangles) => document.body.classList.contains('stage') || status.ask(`This model has ${grouped(triangles)} triangles.`, 'Draw it'));
const checker = new Checker((issues, check, request) => {
  checked = issues;
  show_issues();
  // An inexact estimate can be several times too high. In that case the response itself reports the number before the
  // download.
  if (check?.estimate?.exact && looked_at === request) grower.expect(check.estimate.triangles);
});
const tabs = wire_tabs((page) => tools?.page(page));

let presets: Preset[] = [];
let generators: Generator[] = [];
let gallery: Gallery | null = null;
let form: Form | null = null;
let output_form: OutputForm | null = null;
let tools: Tools | null = null;
/** Aborted when another request is opened or the user cancels. */
let opening = new AbortController();
/** Aborted when the form of another request is to be drawn. */
let drawing = new AbortController();
let keep_camera = false;
let last: { bytes: ArrayBuffer; model: Model | null; triangles: number; base: Request | null; title: string; seed: Request['seed'] } | null = null;
/** The request that the view shows: the page's own, or one in its place. */
let looked_at: Request | null = null;
/** Results of the generation, the validation and the model file itself. */
let refusal: Refusal | null = null;
let checked: Issue[] = [];
let said: Issue[] = [];
/** The message shown when the request was opened. It must stay visible after the model is drawn. */
let standing = '';
let is_locked = false;
let waiting: ((drawn: boolean) => void)[] = [];
/** The schema of the current form, and its generator. */
let schema: Schema | null = null;
let schema_of = '';
/** The schema of the output, which all models share, with its formats and motions. */
let output_schema: Promise<Schema> | null = null;
let formats = ['glb'];
let motions: Motion[] = [];

const persist = <T>(task: () => Promise<T>, signal: AbortSignal): Promise<T> =>
  retrier.persist(task, (reason, until) => status.phase({ kind: 'waiting', reason, until }), signal);

/** Fetched once. After a failure the next caller tries again. */
const get_output = (): Promise<Schema> => output_schema ??= persist(() => get_schema('output'), new AbortController().signal)
  .catch((error: unknown) => { output_schema = null; throw error; });

const quietly = (task: Promise<void>, again = (): void => {}): void => {
  task.catch((error: unknown) => {
    if (error instanceof Locked) locked(error, again);
    else if (error instanceof Refusal) refuse(error);
  });
};

/** An action that opens a request is repeated after a key was entered. */
const opening_of = (open: () => Promise<void>): void => quietly(open(), () => opening_of(open));

/** Without a key no model can be shown. The alert offers to enter one. */
function locked(why: Locked, again: () => void): void {
  status.phase({ kind: 'refused', refusal: why });
  status.issues(why.message, [], 0, () => { reopen(); status.issues('', [], 0, () => {}); again(); }, 'Enter a key');
}

const begin_opening = (): AbortSignal => {
  opening.abort();
  opening = new AbortController();
  standing = '';
  return opening.signal;
};

function stand(words: string): void {
  standing = words;
  status.issues(words, [], 0, () => {});
}

const address = new Address({
  store, persist,
  presets: () => presets,
  generators: () => generators,
  get_preset: (name, signal) => (name === first_shown && early_first ? early_first(() => get_preset(name, signal)) : get_preset(name, signal)),
  begin: begin_opening,
  damaged: () => stand('This link is damaged: its request is not complete. Get the link again, or select a preset from the gallery.'),
});

const core: Core = {
  store, viewer, high, status, seed, tabs,
  shown: () => last,
  looked_at: () => looked_at,
  grow_again: () => { if (store.current) grow(store.current.request, 'now'); },
  preview: (request) => grow(request, 'now'),
  drawn: () => new Promise((resolve) => {
    if (document.body.dataset['state'] === 'ready') resolve(true);
    else waiting.push(resolve);
  }),
  open(request, title, words = '') {
    begin_opening();
    store.open(request, { preset: null, title, description: '' });
    if (words) stand(words);
    tabs.open('parameters');
    quietly(address.push(null));
  },
  write(request, preset) {
    const from = address.origin_of(request, preset);
    if (!from || !is_another(request, from.preset)) { store.write(request); return; }
    begin_opening();
    store.open(request, from);
    quietly(address.push(from.preset));
  },
  search: () => gallery?.search(),
};

function settle(drawn: boolean): void {
  for (const resolve of waiting) resolve(drawn);
  waiting = [];
}

function grow(request: Request, when: 'now' | 'soon'): void {
  looked_at = request;
  grower.ask(for_view(request, tools?.motion() ?? null), when);
}

/**
 * True if a JSON request shares no parameter value with the request that it replaces. One or two parameters are too
 * few to decide.
 */
function is_another(request: Request, preset: string | null): boolean {
  const { current } = store;
  if (!current || request.generator !== current.request.generator) return true;
  if (preset !== null) return preset !== current.preset;
  const before = Object.entries(current.request.parameters);
  return before.length > 2 && before.every(([name, value]) => !same(request.parameters[name], value));
}

/** Marks the measures as those of the previous model while it stays on screen. */
function mark_previous_model(): void {
  if (last && store.current && last.base !== store.current.base) still_shown(last.title, viewer);
}

async function show(made: Made, request: Request): Promise<void> {
  const { triangles, warnings } = made.statistics;
  refusal = null;
  said = warnings > 0 ? warnings_in(made.bytes) : [];
  // A generated model has no errors, even if the check of an earlier text reports some later. Errors of the output
  // stay, because the view uses only a part of it.
  checked = checked.filter((issue) => issue.mild || is_output(issue));
  show_issues();
  if (viewer && !standing) status.issues('', [], 0, () => {});
  last = { bytes: made.bytes, model: null, triangles, base: store.current?.base ?? null, title: store.current?.title ?? '', seed: request.seed };
  still_shown('', null);
  if (viewer) {
    last.model = await viewer.show(made.bytes, keep_camera);
    keep_camera = true;
    tools?.shown(last.model, triangles);
    show_measures(viewer);
  }
  seed.drawn(request.seed);
  const pieces = (triangles === 0 && last.model?.pieces) || { name: 'Triangles', count: triangles };
  status.shown(made.statistics, pieces);
  const size = viewer?.measures.size;
  const [wide, high, deep] = size ? sides_of(size) : [];
  const measure = size ? `, ${wide} m wide, ${high} m high, ${deep} m deep` : '';
  const summary = `${store.current?.title ?? 'Model'}, seed ${request.seed}: ${grouped(pieces.count)} ${pieces.name.toLowerCase()}`;
  part('picture').setAttribute('aria-label', summary + measure);
  status.arrived(summary);
  document.body.dataset['shown'] = String(Number(document.body.dataset['shown']) + 1);
}

/** Shows errors at the fields and in the JSON. */
function show_issues(): void {
  const issues = joined(refusal?.issues ?? [], checked, said);
  tools?.show_issues(issues);
  form?.show_issues(issues);
  output_form?.show_issues(issues);
}

/** The label of the nearest field that contains a value. */
function label_at(pointer: string): string | undefined {
  for (let nearest = pointer; nearest; nearest = nearest.slice(0, nearest.lastIndexOf('/'))) {
    const label = part('parameters').querySelector(`[data-pointer="${CSS.escape(nearest)}"] > .field-head > .label`);
    if (label) return label.textContent;
  }
  return undefined;
}

function refuse(next: Refusal): void {
  refusal = next;
  show_issues();
  const { issues } = next;
  const homeless = issues.filter((issue) => !form?.holds(issue) && !output_form?.holds(issue));
  const one = issues.length === 1 ? issues[0] : undefined;
  const label = one && label_at(one.pointer);
  const detail = issues.length > 1 ? `This request has ${issues.length} errors.` : label ? `${label}: ${next.message}` : sentence(next.message);
  // A single error is already the summary.
  const rest = homeless.filter((issue: Issue) => issue.message !== next.message);
  status.issues(detail, rest, issues.length - homeless.length, () => {
    tabs.open('parameters');
    go_to(part('parameters').querySelector('.field.invalid :is(.spot, input, textarea, select)'));
  });
}

function go_to(field: HTMLElement | null): void {
  field?.focus();
  field?.scrollIntoView({ block: 'center' });
}

/** Leads to the first field with a warning. Warnings without a field are listed under the JSON. */
function lead_to_warning(): void {
  const mild = part('parameters').querySelector(':is(.issue.mild:not([hidden]), .spot.mild)');
  tabs.open(mild ? 'parameters' : 'request');
  for (let up = mild?.closest('details'); up; up = up.parentElement?.closest('details')) up.open = true;
  go_to(mild ? mild.closest('.field')?.querySelector<HTMLElement>(':is(.spot.mild, input, textarea, select)') ?? null : part('request').querySelector('.spot.mild'));
}

/** Opens the page that streams the tiles of the current world. */
async function enter_world(event: Event): Promise<void> {
  event.preventDefault();
  if (store.current) location.href = `./world.html#${await fragment_of(store.current.request, null)}`;
}

/** Draws the form of the request's generator, once per opened request and after changes outside the form. */
async function draw_parameters(state: State, is_new: boolean, signal: AbortSignal): Promise<void> {
  const { generator } = state.request;
  if (!generators.some(({ name }) => name === generator)) {
    form = schema = null;
    schema_of = '';
    tools?.explain({});
    part('parameters').replaceChildren(el('h2', { class: 'unseen' }, 'Parameters'), el('p', { class: 'soft' }, `There is no generator “${generator}”, so there are no parameters to show. Edit the JSON instead.`));
    return;
  }
  const [known, output, { draw_form, keep_view, about, output_form: make_output }] = await Promise.all([
    schema && schema_of === generator ? schema : persist(() => get_schema(generator, signal), signal), get_output(), persist(() => import('./form/form'), signal)]);
  const { request, base } = store.current ?? state;
  if (signal.aborted || request.generator !== generator) return;
  schema = known;
  schema_of = generator;
  const restore = keep_view(part('parameters'));
  // A form that is being replaced must not write to the request.
  const mine: Form = draw_form(schema, request.parameters, base.parameters, '/parameters', (parameters) => { if (form === mine) store.edit({ parameters }); });
  form = mine;
  output_form ??= make_output((asked) => store.edit({ output: asked }));
  output_form.follow(with_formats(output, formats_of(schema, request), request), request.output ?? {}, base.output ?? {});
  part('parameters').replaceChildren(el('h2', { class: 'unseen' }, 'Parameters'), about(generator, schema, state.description), ...(generator === 'world' ? [el('p', {}, el('a', { href: './world.html', onclick: (event) => void enter_world(event) }, 'Move in this world'))] : []), form.element, ...(generator === 'world' ? [] : [output_form.element]));
  restore();
  if (is_new) part('parameters').scrollTop = 0;
  explain();
  // The response may have arrived before the form.
  if (refusal) refuse(refusal);
  else show_issues();
}

/** Tiles have no options of output, so the page offers only the root tile of a world. */
const formats_of = (of: Schema, request: Request): string[] => (request.generator === 'world' ? ['glb'] : [...formats, ...own_formats(of, request)]);

const explain = (): void => {
  if (!schema) return;
  tools?.explain(schema);
  if (store.current) offer(schema, store.current.request);
};

const offer = (of: Schema, request: Request): void =>
  tools?.offer(formats_of(of, request), motions.filter(({ member }) => of['x-motions']?.includes(member)));

store.subscribe((state, cause) => {
  seed.show(state.request.seed);
  part('title').textContent = state.title;
  gallery?.mark(state.preset);
  const is_new = cause === 'open' || cause === 'return';
  if (cause === 'return') begin_opening();
  if (is_new) {
    keep_camera = false;
    form = null;
    refusal = null;
    checked = said = [];
    drawing.abort();
    drawing = new AbortController();
    if (schema_of !== state.request.generator) part('parameters').replaceChildren(el('p', { class: 'soft' }, 'The parameters are loading.'));
  }
  if (cause !== 'open') {
    standing = '';
    address.follow(state);
    forget_hint();
  }
  if (cause !== 'edit') quietly(draw_parameters(state, is_new, drawing.signal));
  else if (schema) offer(schema, state.request);
  tools?.follow(state, is_new);
  checker.ask(state.request);
  grow(state.request, is_new ? 'now' : 'soon');
});

async function load_tools(signal: AbortSignal): Promise<void> {
  const { wire_tools } = await persist(() => import('./tools'), signal);
  tools = wire_tools(core);
  if (store.current) tools.follow(store.current, true);
  if (last?.model) tools.shown(last.model, last.triangles);
  explain();
  show_issues();
  document.body.dataset['tools'] = 'ready';
}

async function start(): Promise<void> {
  wire_hint();
  part('cancel').addEventListener('click', () => {
    begin_opening();
    // If no model is being generated, the user cancels the loading of the form.
    if (!grower.is_running) drawing.abort();
    gallery?.mark(store.current?.preset ?? null);
    grower.cancel();
  });
  // The fragment holds the request, so following the link must not change it.
  part('skip').addEventListener('click', (event) => { event.preventDefault(); part('picture').focus(); });
  addEventListener('locked', (event) => {
    is_locked = (event as CustomEvent<boolean>).detail;
    status.phase(is_locked ? { kind: 'locked' } : grower.is_running ? { kind: 'growing', share: null } : { kind: 'ready' });
  });
  // Messages during the generation would replace this one, so it is shown after the model is drawn.
  addEventListener('tell', (event) => void core.drawn().then((drawn) => { if (drawn) status.say((event as CustomEvent<string>).detail); }));
  const again = (): void => {
    retrier.nudge();
    grower.again();
    if (form || !store.current || !drawing.signal.aborted) return;
    drawing = new AbortController();
    quietly(draw_parameters(store.current, true, drawing.signal));
  };
  part('again').addEventListener('click', again);
  part('warnings').addEventListener('click', lead_to_warning);
  addEventListener('online', () => { if (['gone', 'full'].includes(document.body.dataset['state'] ?? '')) again(); });
  addEventListener('hashchange', () => { if (address.is_foreign) opening_of(() => address.open()); });

  const { signal } = new AbortController();
  ({ presets, generators } = await persist(() => early_offer(() => get_offer(signal)), signal));
  gallery = draw_gallery(part('gallery'), presets, generators, (preset) => { gallery?.mark(preset.name); forget_hint(); opening_of(() => address.choose(preset)); });
  opening_of(() => address.open());
  quietly(load_tools(signal));

  const output = await get_output();
  formats = output['x-formats'] ?? formats;
  motions = motions_in(output);
  explain();
}

quietly(start());
