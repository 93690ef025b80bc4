/** What the server offers, as api_schema/openapi.json describes it. Addresses are relative, so any path prefix works. */
import { parse_json } from './exact';
import type { Schema } from './form/schema';
import { has_key, key_fields, unlock } from './key';

export interface Request {
  generator: string;
  seed: number | string;
  parameters: Record<string, unknown>;
  output?: Record<string, unknown>;
}

export interface Preset { name: string; generator: string; title: string; description: string; tags: string[] }

/** A kind of model and what it is called. */
export interface Generator { name: string; title: string }

export interface Offer { presets: Preset[]; generators: Generator[] }

/** One fault of a request: a JSON Pointer into it; line and column, from 1, point into a grammar's text. */
export interface Fault {
  pointer: string;
  message: string;
  line?: number;
  column?: number;
  /** A warning: the request is taken nevertheless. */
  mild?: boolean;
}

/** A symbol, an operation or a function of a notation. */
export interface Word { symbol?: string; name?: string; parameters?: string; text?: string; example?: string }

/** Lists of words, or of names alone. */
export type Vocabulary = Record<string, (Word | string)[]>;

export interface Check { warnings: Fault[]; estimate: { triangles: number; bytes: number; exact: boolean } | null }

/** `is_kept`: the server had the model, and `milliseconds` is what the answer took. */
export interface Statistics { triangles: number; bytes: number; milliseconds: number; is_kept: boolean; warnings: number }

export interface Made { bytes: ArrayBuffer; statistics: Statistics }

interface Problem { title?: string; detail?: string; errors?: Fault[] }

/** The server understood and says no: trying again would not help. */
/** A list of more names than can be overlooked is cut: the reference has them all. */
const brief = (text: string): string =>
  text.replace(/((?:[\w.-]+, ){8})((?:[\w.-]+, ){4,}[\w.-]+)/, (_, first: string, rest: string) => `${first}and ${rest.split(', ').length} more`);

export class Refusal extends Error {
  readonly faults: Fault[];
  constructor(problem: Problem) {
    super(brief(problem.detail ?? problem.title ?? 'The server refused the request.'));
    this.faults = (problem.errors ?? []).map((fault) => ({ ...fault, message: brief(fault.message) }));
  }
}

/** The service is closed to whoever shows no key, or the wrong one. */
export class Locked extends Refusal {}

/** The server is full or about to end: to be asked again, after `seconds` where it said so. */
export class Busy extends Error {
  readonly seconds: number | null;
  constructor(detail: string, seconds: number | null) {
    super(detail);
    this.seconds = seconds;
  }
}

/** The model has more triangles than were wanted without a question. */
export class Heavy extends Error {
  readonly triangles: number;
  constructor(triangles: number) {
    super('The model is very large.');
    this.triangles = triangles;
  }
}

/** No answer at all, or one from something that is not the server. */
export class Gone extends Error {}

async function problem_of(response: Response): Promise<Problem> {
  try {
    return (await response.json()) as Problem;
  } catch {
    return { detail: `The server answered ${response.status} ${response.statusText}.` };
  }
}

async function call(address: string, init: RequestInit = {}): Promise<Response> {
  let response: Response;
  const shown = has_key();
  try {
    response = await fetch(address, { ...init, headers: { ...init.headers, ...key_fields() } });
  } catch (error) {
    if (init.signal?.aborted) throw error;
    throw new Gone('The server does not answer.');
  }
  if (response.ok) return response;
  if (response.status === 429 || response.status === 503) {
    const seconds = Number(response.headers.get('Retry-After') ?? NaN);
    throw new Busy((await problem_of(response)).detail ?? '', Number.isFinite(seconds) ? seconds : null);
  }
  if (response.status === 401 || response.status === 403) {
    const problem = await problem_of(response);
    const opened = await unlock(response.status, shown);
    init.signal?.throwIfAborted();
    if (opened) return call(address, init);
    throw response.status === 401 ? new Locked(problem) : new Refusal(problem);
  }
  if (response.status === 502) throw new Gone('The server does not answer.');
  throw new Refusal(await problem_of(response));
}

const read = async <T>(address: string, signal?: AbortSignal): Promise<T> =>
  (await (await call(address, { signal: signal ?? null })).json()) as T;

/** In the order in which they are to be shown. */
export const get_offer = (signal?: AbortSignal): Promise<Offer> => read<Offer>('v1/presets', signal);

export const get_presets = async (signal?: AbortSignal): Promise<Preset[]> => (await get_offer(signal)).presets;

export async function get_preset(name: string, signal?: AbortSignal): Promise<Request> {
  const response = await call(`v1/presets/${encodeURIComponent(name)}`, { signal: signal ?? null });
  return complete(parse_json(await response.text()) as Partial<Request>);
}

export const get_schema = (name: string, signal?: AbortSignal): Promise<Schema> =>
  read<Schema>(`v1/schemas/${encodeURIComponent(name)}`, signal);

/** RFC 7396: members of the patch over those there are; null takes a member away. */
function merged(base: unknown, patch: unknown): unknown {
  if (typeof patch !== 'object' || patch === null || Array.isArray(patch)) return patch;
  const result: Record<string, unknown> = typeof base === 'object' && base !== null && !Array.isArray(base) ? { ...base } : {};
  for (const [name, value] of Object.entries(patch)) {
    if (value === null) delete result[name];
    else result[name] = merged(result[name], value);
  }
  return result;
}

/** A request, and the preset that it came from. */
export interface Written { request: Request; preset: string | null }

/** A request as it was written, which may name a preset: then what it says over that preset. */
export async function whole(written: unknown): Promise<Written> {
  if (typeof written !== 'object' || written === null || Array.isArray(written)) throw new Error('A request is an object.');
  const { preset, ...rest } = written as Partial<Request> & { preset?: unknown };
  if (typeof preset === 'string') return { request: complete(merged(await get_preset(preset), rest) as Partial<Request>), preset };
  if (typeof rest.generator !== 'string') throw new Error('A request names its generator.');
  return { request: complete(rest), preset: null };
}

/** With the members that the page relies on. */
export const complete = (request: Partial<Request>): Request =>
  ({ ...request, generator: request.generator ?? '', seed: request.seed ?? 0, parameters: request.parameters ?? {} });

const post_json = (address: string, request: Request, accept: string, signal?: AbortSignal): Promise<Response> =>
  call(address, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json', Accept: accept },
    body: JSON.stringify(request),
    signal: signal ?? null,
  });

const post = (request: Request, accept: string, signal?: AbortSignal): Promise<Response> =>
  post_json('v1/generate', request, accept, signal);

export const get_vocabulary = (): Promise<Vocabulary> => read<Vocabulary>('v1/vocabulary');

/** Every fault (a Refusal) or every warning, without the model. */
export async function check(request: Request, signal?: AbortSignal): Promise<Check> {
  const answer = (await (await post_json('v1/validate', request, 'application/json', signal)).json()) as Check;
  return { estimate: answer.estimate, warnings: answer.warnings.map((warning) => ({ ...warning, mild: true })) };
}

/** What the generator makes before there is geometry; its members are the generator's own. */
export const derive = async (request: Request, signal?: AbortSignal): Promise<Record<string, unknown>> =>
  (await (await post_json('v1/derive', request, 'application/json', signal)).json()) as Record<string, unknown>;

/** The formats that the server can import, from its own description. */
export async function import_formats(): Promise<string[]> {
  const { components } = await read<{ components: { parameters: { ImportFormat?: { schema?: { enum?: string[] } } } } }>('openapi.json');
  return components.parameters.ImportFormat?.schema?.enum ?? [];
}

/** A file of another program as a request of ours. */
export async function import_file(text: string, format: string, entry: string): Promise<{ request: Request; warnings: Fault[] }> {
  const query = new URLSearchParams(entry ? { format, entry } : { format });
  const response = await call(`v1/import?${query}`, { method: 'POST', headers: { 'Content-Type': 'text/plain' }, body: text });
  const answer = parse_json(await response.text()) as { request: Partial<Request>; warnings: Fault[] };
  return { request: complete(answer.request), warnings: answer.warnings };
}

export const in_format = (request: Request, format: string): Request =>
  ({ ...request, output: { ...request.output, format } });

/** A body that breaks off counts as no answer. */
async function whole_body(response: Response, signal?: AbortSignal): Promise<ArrayBuffer> {
  try {
    return await response.arrayBuffer();
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Gone('The answer broke off.');
  }
}

/** Throws Heavy, before it is fetched, where the model has `most` triangles or more. */
export async function generate(request: Request, signal?: AbortSignal, most = Infinity): Promise<Made> {
  const response = await post(request, '*/*', signal);
  const number = (name: string): number => Number(response.headers.get(name) ?? 0);
  if (number('Seedmesh-Triangles') >= most) {
    void response.body?.cancel();
    throw new Heavy(number('Seedmesh-Triangles'));
  }
  const bytes = await whole_body(response, signal);
  const timing = response.headers.get('Server-Timing') ?? '';
  return {
    bytes,
    statistics: {
      triangles: number('Seedmesh-Triangles'),
      warnings: number('Seedmesh-Warnings'),
      // Content-Length counts what travelled, which may be compressed; the file is what counts here.
      bytes: bytes.byteLength,
      milliseconds: total_duration(timing),
      is_kept: /\bcache;\s*desc="?(hit|shared)/.test(timing),
    },
  };
}

const sum_of = (timing: Record<string, number> | undefined): number | null =>
  (timing ? Object.values(timing).reduce((sum, each) => sum + each, 0) : null);

export function total_duration(server_timing: string): number {
  let sum = 0;
  for (const [, duration] of server_timing.matchAll(/;\s*dur=([\d.]+)/g)) sum += Number(duration);
  return sum;
}

/**
 * Lets the server make the model and tell how far it is; the model itself is asked for afterwards, from the server's
 * cache. `tell` gets a share from 0 to 1. Returns the milliseconds of the making; null where the server does not say.
 */
export async function follow(request: Request, tell: (share: number) => void, signal: AbortSignal): Promise<number | null> {
  const response = await post(request, 'text/event-stream', signal);
  const reader = response.body!.pipeThrough(new TextDecoderStream()).getReader();
  const stages: string[] = [];
  let text = '';
  let took: number | null = null;
  for (;;) {
    const chunk = await reader.read().catch(() => {
      signal.throwIfAborted();
      throw new Gone('The answer broke off.');
    });
    if (chunk.done) return took;
    text += chunk.value;
    const events = text.split('\n\n');
    text = events.pop() ?? '';
    for (const event of events) {
      const name = /^event: (.*)$/m.exec(event)?.[1];
      const data = /^data: (.*)$/m.exec(event)?.[1] ?? '{}';
      if (name === 'error') throw new Refusal(JSON.parse(data) as Problem);
      if (name === 'done') took = sum_of((JSON.parse(data) as { timing?: Record<string, number> }).timing);
      if (name !== 'progress') continue;
      const progress = JSON.parse(data) as { stage: string; share: number };
      if (!stages.includes(progress.stage)) stages.push(progress.stage);
      // Nobody knows beforehand how many stages there are: each takes half of what is left.
      const before = 1 - 0.5 ** (stages.length - 1);
      tell(before + (1 - before) * 0.5 * progress.share);
    }
  }
}
