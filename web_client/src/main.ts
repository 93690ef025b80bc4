/**
 * Brings the parts together. The address tells what is shown: `#…` carries a request; in the query `quality=low` or
 * `quality=high` chooses how it is drawn, and `stage` leaves only the picture, for making pictures.
 */
import { Locked, Refusal, get_preset, get_offer, get_schema, type Fault, type Generator, type Made, type Preset, type Request } from './api';
import { Address, first_shown } from './address';
import { Checker, joined } from './checker';
import { el, grouped, part, sentence } from './dom';
import type { Form } from './form/form';
import type { OutputForm } from './form/output_form';
import { same, type Schema } from './form/schema';
import { draw_gallery, type Gallery } from './gallery';
import { Grower, Patience } from './grower';
import { forget_hint, wire_hint } from './hint';
import { reopen } from './key';
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

/** Begun now, and taken by whoever asks first: the server answers while the picture is set up. */
function begun<T>(task: () => Promise<T>): (again: () => Promise<T>) => Promise<T> {
  let early: Promise<T> | null = task();
  early.catch(() => { /* Whoever takes it is told. */ });
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
const patience = new Patience();
const high = is_high();
const viewer = make_viewer(status, high);
const seed = wire_seed((value) => store.edit({ seed: value }));
const grower = new Grower((phase) => {
  // A question for a key stands until it is answered, whatever else begins.
  if (!is_locked || phase.kind !== 'growing') status.phase(phase);
  if (phase.kind === 'refused' && phase.refusal instanceof Locked) locked(phase.refusal, () => grower.again());
  else if (phase.kind === 'refused') refuse(phase.refusal);
  if (phase.kind === 'ready' || phase.kind === 'refused') settle(phase.kind === 'ready');
  if (phase.kind === 'refused' || phase.kind === 'stopped') tell_apart();
}, show, async (triangles) => document.body.classList.contains('stage') || status.ask(`This model has ${grouped(triangles)} triangles.`, 'Draw it'));
const checker = new Checker((faults, check, request) => {
  checked = faults;
  show_faults();
  // An estimate may be several times too high; the answer itself tells before it is fetched whole.
  if (check?.estimate?.exact && looked_at === request) grower.expect(check.estimate.triangles);
});
const tabs = wire_tabs((page) => tools?.page(page));

let presets: Preset[] = [];
let generators: Generator[] = [];
let gallery: Gallery | null = null;
let form: Form | null = null;
let output_form: OutputForm | null = null;
let tools: Tools | null = null;
/** Ends with the opening of something else, and with Cancel. */
let opening = new AbortController();
/** Ends when the form of another request is to be drawn. */
let drawing = new AbortController();
let keep_camera = false;
let last: { bytes: ArrayBuffer; model: Model | null; triangles: number; base: Request | null; title: string; seed: Request['seed'] } | null = null;
/** What is asked for as a picture: the page's request, or another in its place. */
let looked_at: Request | null = null;
/** What the making of the model, what the checking of the request, and what the model itself had to say. */
let refusal: Refusal | null = null;
let checked: Fault[] = [];
let said: Fault[] = [];
/** What was said of the model when it was opened, and has to stay readable when it is drawn. */
let standing = '';
let is_locked = false;
let waiting: ((drawn: boolean) => void)[] = [];
/** The schema of the form, and of which generator it is. */
let schema: Schema | null = null;
let schema_of = '';
/** What can be asked of every model, and what of it are formats and motions. */
let output_schema: Promise<Schema> | null = null;
let formats = ['glb'];
let motions: Motion[] = [];

const persist = <T>(task: () => Promise<T>, signal: AbortSignal): Promise<T> =>
  patience.persist(task, (reason, until) => status.phase({ kind: 'waiting', reason, until }), signal);

/** Asked for once; where that is refused, whoever comes next asks again. */
const get_output = (): Promise<Schema> => output_schema ??= persist(() => get_schema('output'), new AbortController().signal)
  .catch((error: unknown) => { output_schema = null; throw error; });

const quietly = (task: Promise<void>, again = (): void => {}): void => {
  task.catch((error: unknown) => {
    if (error instanceof Locked) locked(error, again);
    else if (error instanceof Refusal) refuse(error);
  });
};

/** What opens something can be tried once more, when there is a key. */
const opening_of = (open: () => Promise<void>): void => quietly(open(), () => opening_of(open));

/** Without a key there is nothing to show; the way to it stays. */
function locked(why: Locked, again: () => void): void {
  status.phase({ kind: 'refused', refusal: why });
  status.faults(why.message, [], 0, () => { reopen(); status.faults('', [], 0, () => {}); again(); }, 'Enter a key');
}

const begin_opening = (): AbortSignal => {
  opening.abort();
  opening = new AbortController();
  standing = '';
  return opening.signal;
};

function stand(words: string): void {
  standing = words;
  status.faults(words, [], 0, () => {});
}

const address = new Address({
  store, persist,
  presets: () => presets,
  generators: () => generators,
  get_preset: (name, signal) => (name === first_shown && early_first ? early_first(() => get_preset(name, signal)) : get_preset(name, signal)),
  begin: begin_opening,
  damaged: () => stand('This link is damaged: it holds no whole request. Ask for it once more, or choose from the gallery.'),
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

/** Whether a request that was written at once has nothing left of the one that it was written over; of one or two parameters nothing can be told. */
function is_another(request: Request, preset: string | null): boolean {
  const { current } = store;
  if (!current || request.generator !== current.request.generator) return true;
  if (preset !== null) return preset !== current.preset;
  const before = Object.entries(current.request.parameters);
  return before.length > 2 && before.every(([name, value]) => !same(request.parameters[name], value));
}

/** A model that stays although another request is open is told to be the other's. */
function tell_apart(): void {
  if (last && store.current && last.base !== store.current.base) still_shown(last.title, viewer);
}

async function show(made: Made, request: Request): Promise<void> {
  const { triangles, warnings } = made.statistics;
  refusal = null;
  said = warnings > 0 ? warnings_in(made.bytes) : [];
  // What was made has no errors: the check of an earlier text may say so later than the model does. Of the output it shows a part.
  checked = checked.filter((fault) => fault.mild || is_output(fault));
  show_faults();
  if (viewer && !standing) status.faults('', [], 0, () => {});
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
  const told = `${store.current?.title ?? 'Model'}, seed ${request.seed}: ${grouped(pieces.count)} ${pieces.name.toLowerCase()}`;
  part('picture').setAttribute('aria-label', told + measure);
  status.arrived(told);
  document.body.dataset['shown'] = String(Number(document.body.dataset['shown']) + 1);
}

/** At the fields and in the JSON. */
function show_faults(): void {
  const faults = joined(refusal?.faults ?? [], checked, said);
  tools?.show_faults(faults);
  form?.show_faults(faults);
  output_form?.show_faults(faults);
}

/** What the field is called that stands nearest above a value. */
function label_at(pointer: string): string | undefined {
  for (let nearest = pointer; nearest; nearest = nearest.slice(0, nearest.lastIndexOf('/'))) {
    const label = part('parameters').querySelector(`[data-pointer="${CSS.escape(nearest)}"] > .field-head > .label`);
    if (label) return label.textContent;
  }
  return undefined;
}

function refuse(next: Refusal): void {
  refusal = next;
  show_faults();
  const { faults } = next;
  const homeless = faults.filter((fault) => !form?.holds(fault) && !output_form?.holds(fault));
  const one = faults.length === 1 ? faults[0] : undefined;
  const label = one && label_at(one.pointer);
  const detail = faults.length > 1 ? `This request has ${faults.length} faults.` : label ? `${label}: ${next.message}` : sentence(next.message);
  // One fault is its own summary.
  const rest = homeless.filter((fault: Fault) => fault.message !== next.message);
  status.faults(detail, rest, faults.length - homeless.length, () => {
    tabs.open('parameters');
    go_to(part('parameters').querySelector('.field.faulty :is(.spot, input, textarea, select)'));
  });
}

function go_to(field: HTMLElement | null): void {
  field?.focus();
  field?.scrollIntoView({ block: 'center' });
}

/** To the first field with a warning; those that belong to no field stand under the JSON. */
function lead_to_warning(): void {
  const mild = part('parameters').querySelector(':is(.fault.mild:not([hidden]), .spot.mild)');
  tabs.open(mild ? 'parameters' : 'request');
  for (let up = mild?.closest('details'); up; up = up.parentElement?.closest('details')) up.open = true;
  go_to(mild ? mild.closest('.field')?.querySelector<HTMLElement>(':is(.spot.mild, input, textarea, select)') ?? null : part('request').querySelector('.spot.mild'));
}

/** The form of the request's generator; drawn once for each request that is opened, and when another hand wrote it. */
async function draw_parameters(state: State, is_new: boolean, signal: AbortSignal): Promise<void> {
  const { generator } = state.request;
  if (!generators.some(({ name }) => name === generator)) {
    form = schema = null;
    schema_of = '';
    tools?.explain({});
    part('parameters').replaceChildren(el('h2', { class: 'unseen' }, 'Parameters'), el('p', { class: 'soft' }, `There is no generator “${generator}”, so there are no parameters to show. The JSON can be mended by hand.`));
    return;
  }
  const [known, output, { draw_form, keep_place, about, output_form: make_output }] = await Promise.all([
    schema && schema_of === generator ? schema : persist(() => get_schema(generator, signal), signal), get_output(), persist(() => import('./form/form'), signal)]);
  const { request, base } = store.current ?? state;
  if (signal.aborted || request.generator !== generator) return;
  schema = known;
  schema_of = generator;
  const restore = keep_place(part('parameters'));
  // A form that is about to give way to another writes nothing.
  const mine: Form = draw_form(schema, request.parameters, base.parameters, '/parameters', (parameters) => { if (form === mine) store.edit({ parameters }); });
  form = mine;
  output_form ??= make_output((asked) => store.edit({ output: asked }));
  output_form.follow(with_formats(output, formats_of(schema, request), request), request.output ?? {}, base.output ?? {});
  part('parameters').replaceChildren(el('h2', { class: 'unseen' }, 'Parameters'), about(generator, schema, state.description), form.element, output_form.element);
  restore();
  if (is_new) part('parameters').scrollTop = 0;
  explain();
  // The answer may have come before the form.
  if (refusal) refuse(refusal);
  else show_faults();
}

const formats_of = (of: Schema, request: Request): string[] => [...formats, ...own_formats(of, request)];

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
    if (schema_of !== state.request.generator) part('parameters').replaceChildren(el('p', { class: 'soft' }, 'The parameters are on their way.'));
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
  show_faults();
  document.body.dataset['tools'] = 'ready';
}

async function start(): Promise<void> {
  wire_hint();
  part('cancel').addEventListener('click', () => {
    begin_opening();
    // Nothing is made: what is waited for is the form.
    if (!grower.is_running) drawing.abort();
    gallery?.mark(store.current?.preset ?? null);
    grower.cancel();
  });
  // The address is the request's: a jump within the page must not be written there.
  part('skip').addEventListener('click', (event) => { event.preventDefault(); part('picture').focus(); });
  addEventListener('locked', (event) => {
    is_locked = (event as CustomEvent<boolean>).detail;
    status.phase(is_locked ? { kind: 'locked' } : grower.is_running ? { kind: 'growing', share: null } : { kind: 'ready' });
  });
  // What happens while a model is made would wipe the word away.
  addEventListener('tell', (event) => void core.drawn().then((drawn) => { if (drawn) status.say((event as CustomEvent<string>).detail); }));
  const again = (): void => {
    patience.nudge();
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
