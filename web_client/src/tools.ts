/**
 * Everything that the first model does not need: import, export, the JSON editor, steps, view tools, comparisons and
 * help. It is a separate chunk, loaded while the server generates that model.
 */
import type { Issue, Request } from './api';
import { save_picture, save_proctree, save_request, wire_copies, wire_downloads } from './actions';
import { own_format } from './commands';
import { part } from './dom';
import type { Edit } from './derived/edits';
import type { GroundClick } from './form/planting';
import type { Schema } from './form/schema';
import type { Motion } from './for_view';
import { wire_growth, type GrowthAsk } from './growth';
import { is_typing, wire_help } from './help';
import { levels_of, motions_of } from './levels';
import { wire_menus } from './menu';
import { wire_nine } from './seed_choice';
import { wire_files } from './open_files';
import { wire_request_text } from './request_text';
import { wire_result } from './result';
import type { SeedBox } from './seed';
import type { State, Store } from './state';
import type { Status } from './status';
import { wire_steps } from './steps';
import type { Page, Tabs } from './tabs';
import { wire_compare, wire_motion, wire_view_menu } from './view_menu';
import { wire_view } from './view_tools';
import type { Model } from './viewer/model';
import type { Viewer } from './viewer/viewer';

export interface Core {
  store: Store;
  viewer: Viewer | null;
  high: boolean;
  status: Status;
  seed: SeedBox;
  tabs: Tabs;
  /** The shown GLB and the request that it belongs to. */
  shown(): { bytes: ArrayBuffer; title: string; seed: Request['seed'] } | null;
  /** The request that the view shows: the page's own, or one in its place. */
  looked_at(): Request | null;
  grow_again(): void;
  /** Shows another request in the view without changing the page's own. */
  preview(request: Request): void;
  /** Resolves when the model of the last change is drawn; false if it was refused. */
  drawn(): Promise<boolean>;
  /** `words` is a message that stays visible after the model is drawn. */
  open(request: Request, title: string, words?: string): void;
  /** Replaces the whole request. A request without common parameters is treated as a newly opened one. */
  write(request: Request, preset: string | null): void;
  search(): void;
}

export interface Tools {
  follow(state: State, is_new: boolean): void;
  /** The schema of the request's generator. */
  explain(schema: Schema): void;
  shown(model: Model, triangles: number): void;
  show_issues(issues: Issue[]): void;
  page(page: Page): void;
  offer(formats: string[], motions: Motion[]): void;
  /** The motion that is selected in the view. */
  motion(): Motion | null;
}

export function wire_tools(core: Core): Tools {
  const { store, viewer, status, tabs } = core;
  let failed = '';
  const actions = {
    request: (): Request | null => store.current?.request ?? null,
    preset: (): string | null => store.current?.preset ?? null,
    name: (): string => `${store.current?.preset ?? 'seedmesh'}-${store.current?.request.seed ?? 0}`,
    picture: (): Promise<Blob | null> => viewer?.screenshot() ?? Promise.resolve(null),
    say: status.say,
    fail(text: string): void {
      // Messages of other parts are kept.
      if (text === '' && (failed === '' || part('alert').textContent !== failed)) return;
      status.issues(text, [], 0, () => {});
      failed = part('alert').textContent;
    },
    begin: status.begin,
  };
  const request_text = wire_request_text(core.write);
  const result = wire_result(viewer, (line) => {
    tabs.open('parameters');
    part('parameters').querySelector(`[data-pointer="/parameters/${rules_name()}"]`)?.dispatchEvent(new CustomEvent('go-line', { detail: line }));
  }, () => typeof store.current?.request.parameters[rules_name() ?? ''] === 'string', {
    edited: {
      edits() {
        const name = named('shape-edits');
        const edits = name === undefined ? null : store.current?.request.parameters[name] ?? [];
        return Array.isArray(edits) ? edits as Edit[] : null;
      },
      write(edits) {
        const name = named('shape-edits');
        if (!store.current || name === undefined) return;
        const { [name]: _, ...others } = store.current.request.parameters;
        store.write({ ...store.current.request, parameters: edits.length > 0 ? { ...others, [name]: edits } : others });
      },
      attributes: () => rules_schema?.properties?.[named('shape-edits') ?? '']?.items?.properties?.['attributes'] ?? null,
      rules: () => store.current?.request.parameters[rules_name() ?? ''],
    },
    with_all(request) {
      const name = named('derived');
      return name === undefined ? request : { ...request, parameters: { ...request.parameters, [name]: true } };
    },
    open: (request, title) => core.open(request, title),
    plants: { save: (request, name) => save_request(request, actions, name), open: (request, title) => core.open(request, title) },
  });
  part('picture').addEventListener('ground-click', (event) => {
    const { x, z, button } = (event as CustomEvent<GroundClick>).detail;
    if (button === 0) result.touched(x, z);
  });
  /** The parameter with this widget. */
  const named = (widget: string): string | undefined => Object.entries(rules_schema?.properties ?? {}).find(([, member]) => member['x-widget'] === widget)?.[0];
  const is_proctree = (request: Request): boolean => Object.values(rules_schema?.['x-files'] ?? {}).some((where) =>
    Object.entries(where).every(([name, value]) => (request.parameters[name] ?? rules_schema?.properties?.[name]?.default) === value));
  part('save-proctree').addEventListener('click', () => { const request = actions.request(); if (request) void save_proctree(request, actions); });
  const steps = wire_steps({
    edit(name, value) {
      const { [name]: _, ...others } = store.current?.request.parameters ?? {};
      if (store.current) store.write({ ...store.current.request, parameters: value === undefined ? others : { ...others, [name]: value } });
    },
    drawn: core.drawn,
  });
  const growth = wire_growth({
    request: actions.request, preview: core.preview, back: core.grow_again, drawn: core.drawn,
    hold: (on) => { if (viewer) viewer.held = on; },
  });
  part('parameters').addEventListener('grow', (event) => growth.start((event as CustomEvent<GrowthAsk>).detail));
  const view_menu = viewer && wire_view_menu(viewer, {
    high: core.high, levels: () => levels_of(core.looked_at()!), animate: core.grow_again, fail: actions.fail,
  });
  const motion = viewer && wire_motion(viewer);
  let motions: Motion[] = [];
  let formats: string[] = [];
  let own = 'glb';
  let rules_schema: Schema | null = null;
  /** The parameter that the line number of a shape refers to. */
  const rules_name = (): string | undefined => Object.entries(rules_schema?.properties ?? {}).find(([, member]) => member['x-grammar'] === 'cga')?.[0];

  // The available motions are queried when the menu is opened, once for each opened request.
  let asked_for: Request | null = null;
  const ask_motions = (): void => {
    const state = store.current;
    if (!state || asked_for === state.base || motions.length === 0 || !part<HTMLDetailsElement>('view-menu').open) return;
    asked_for = state.base;
    void motions_of(state.request, motions).then((can) => { if (store.current?.base === state.base) view_menu?.offer_motions(can); });
  };
  part('view-menu').addEventListener('toggle', ask_motions);

  wire_menus();
  wire_copies(actions);
  const files = wire_files({ open: core.open, drawn: core.drawn, say: status.say, fail: actions.fail });
  const help = wire_help();
  wire_keys(core, { open_file: files.choose, help: help.open, save() { if (store.current) save_request(store.current.request, actions); } });
  if (viewer) {
    const compare = wire_compare(viewer, core.shown);
    wire_view(viewer, {
      roll: core.seed.roll, compare,
      next_mode: () => view_menu?.next_mode(), save_picture: () => void save_picture(actions), step: steps.by,
      play: () => motion?.play(), leave_gait: () => view_menu?.leave_gait(),
    });
    viewer.on_pick = (index) => result.picked(index);
    wire_nine({ request: actions.request, portrait: (bytes, width, height) => viewer.portrait(bytes, width, height), choose: (seed) => store.edit({ seed }) });
  }

  return {
    follow(state, is_new) {
      part<HTMLButtonElement>('undo').disabled = !store.can_undo;
      part<HTMLButtonElement>('redo').disabled = !store.can_redo;
      growth.leave();
      part('save-proctree').hidden = !is_proctree(state.request);
      if (own !== own_format(state.request)) wire_downloads(formats, actions);
      own = own_format(state.request);
      steps.follow(state);
      request_text.follow(state);
      result.follow(state, is_new);
      if (is_new) {
        view_menu?.forget();
        motions = [];
      }
    },
    explain(schema) {
      const before = named('derived');
      rules_schema = schema;
      if (named('derived') !== undefined && before === undefined) result.repeat();
      steps.take(schema);
      if (store.current) part('save-proctree').hidden = !is_proctree(store.current.request);
      if (store.current) steps.follow(store.current);
    },
    shown(model, triangles) {
      view_menu?.shown(model, triangles);
      motion?.shown(model);
      result.drawn();
    },
    show_issues: (issues) => request_text.show_issues(issues),
    page(page) {
      if (page === 'request') request_text.open();
      result.open(page === 'result');
    },
    offer(all_formats, all_motions) {
      if (all_formats.join() !== formats.join()) wire_downloads(all_formats, actions);
      formats = all_formats;
      motions = all_motions;
      ask_motions();
    },
    motion: () => view_menu?.motion() ?? null,
  };
}

/** Shortcuts that are active everywhere except in text inputs. */
function wire_keys({ store, tabs, search }: Core, acts: { open_file(): void; help(): void; save(): void }): void {
  part('undo').addEventListener('click', () => store.undo());
  part('redo').addEventListener('click', () => store.redo());
  addEventListener('keydown', (event) => {
    const key = event.key.toLowerCase();
    const held = event.ctrlKey || event.metaKey;
    const act = held && key === 's' ? acts.save
      : held && key === 'o' ? acts.open_file
      : is_typing(event) || event.defaultPrevented ? null
      : held && key === 'z' ? () => (event.shiftKey ? store.redo() : store.undo())
      : held && key === 'y' ? () => store.redo()
      : held || event.altKey ? null
      : key === '?' ? acts.help
      : key === '/' ? () => { tabs.open('gallery'); search(); }
      : null;
    if (!act) return;
    event.preventDefault();
    act();
  });
}
