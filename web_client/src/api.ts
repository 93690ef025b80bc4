/**
 * Client of the HTTP interface that api_schema/openapi.json describes. All addresses are relative, so that any path
 * prefix works.
 */
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

/** A generator and its title. */
export interface Generator { name: string; title: string }

export interface Offer { presets: Preset[]; generators: Generator[] }

/**
 * One error or warning of a request. `pointer` is a JSON Pointer into it; line and column count from 1 in a grammar's
 * text.
 */
export interface Issue {
  pointer: string;
  /** The kind of error, for example `unknown_key`. Warnings have none. */
  code?: string;
  message: string;
  line?: number;
  column?: number;
  /** True for a warning: the server accepts the request nevertheless. */
  mild?: boolean;
}

/** A symbol, an operation or a function of a notation. */
export interface Word { symbol?: string; name?: string; parameters?: string; text?: string; example?: string }

/** Lists of words with descriptions, or of names alone. */
export type Vocabulary = Record<string, (Word | string)[]>;

export interface Check { warnings: Issue[]; estimate: { triangles: number; bytes: number; exact: boolean } | null }

/** `is_kept` means that the model came from the server's cache; `milliseconds` is then the time of the answer. */
export interface Statistics { triangles: number; bytes: number; milliseconds: number; is_kept: boolean; warnings: number }

export interface Made { bytes: ArrayBuffer; statistics: Statistics }

interface Problem { title?: string; detail?: string; format?: string; errors?: Issue[] }

/** Shows long lists of names in short. The reference documentation contains them all. */
const brief = (text: string): string =>
  text.replace(/((?:[\w.-]+, ){8})((?:[\w.-]+, ){4,}[\w.-]+)/, (_, first: string, rest: string) => `${first}and ${rest.split(', ').length} more`);

/** The server rejects the request itself, so that a retry would not help. */
export class Refusal extends Error {
  readonly issues: Issue[];
  /** For an import: the format that the server recognised. */
  readonly format: string;
  constructor(problem: Problem) {
    super(brief(problem.detail ?? problem.title ?? 'The server refused the request.'));
    this.issues = (problem.errors ?? []).map((issue) => ({ ...issue, message: brief(issue.message) }));
    this.format = problem.format ?? '';
  }
}

/** The service requires a key, and the request had none or a wrong one. */
export class Locked extends Refusal {}

/** The server is at capacity or is shutting down. Retry after `seconds`, if the server sent that number. */
export class Busy extends Error {
  readonly seconds: number | null;
  constructor(detail: string, seconds: number | null) {
    super(detail);
    this.seconds = seconds;
  }
}

/** The model has more triangles than the caller accepts without asking the user. */
export class Heavy extends Error {
  readonly triangles: number;
  constructor(triangles: number) {
    super('The model is very large.');
    this.triangles = triangles;
  }
}

/** No answer, or an answer that does not come from the Seedmesh server. */
export class Gone extends Error {}

async function problem_of(response: Response): Promise<Problem> {
  try {
    return (await response.json()) as Problem;
  } catch {
    return { detail: `The server responded with ${response.status} ${response.statusText}.` };
  }
}

async function call(address: string, init: RequestInit = {}): Promise<Response> {
  let response: Response;
  const shown = has_key();
  try {
    response = await fetch(address, { ...init, headers: { ...init.headers, ...key_fields() } });
  } catch (error) {
    if (init.signal?.aborted) throw error;
    throw new Gone('The server does not respond.');
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
  if (response.status === 502) throw new Gone('The server does not respond.');
  throw new Refusal(await problem_of(response));
}

const read = async <T>(address: string, signal?: AbortSignal): Promise<T> =>
  (await (await call(address, { signal: signal ?? null })).json()) as T;

/** The text at an address of the server. */
export const get_text = async (address: string): Promise<string> => (await call(address)).text();

/** The names in display order. */
export const get_offer = (signal?: AbortSignal): Promise<Offer> => read<Offer>('v1/presets', signal);

export const get_presets = async (signal?: AbortSignal): Promise<Preset[]> => (await get_offer(signal)).presets;

export async function get_preset(name: string, signal?: AbortSignal): Promise<Request> {
  const response = await call(`v1/presets/${encodeURIComponent(name)}`, { signal: signal ?? null });
  return complete(parse_json(await response.text()) as Partial<Request>);
}

export const get_schema = (name: string, signal?: AbortSignal): Promise<Schema> =>
  read<Schema>(`v1/schemas/${encodeURIComponent(name)}`, signal);

/** JSON Merge Patch (RFC 7396): the members of the patch replace those of the target; null removes a member. */
function merged(base: unknown, patch: unknown): unknown {
  if (typeof patch !== 'object' || patch === null || Array.isArray(patch)) return patch;
  const result: Record<string, unknown> = typeof base === 'object' && base !== null && !Array.isArray(base) ? { ...base } : {};
  for (const [name, value] of Object.entries(patch)) {
    if (value === null) delete result[name];
    else result[name] = merged(result[name], value);
  }
  return result;
}

/** A complete request and the preset that it is based on. */
export interface Written { request: Request; preset: string | null }

/** Resolves a request that may name a preset: its other members are merged over that preset. */
export async function whole(written: unknown): Promise<Written> {
  if (typeof written !== 'object' || written === null || Array.isArray(written)) throw new Error('A request is an object.');
  const { preset, ...rest } = written as Partial<Request> & { preset?: unknown };
  if (typeof preset === 'string') return { request: complete(merged(await get_preset(preset), rest) as Partial<Request>), preset };
  if (typeof rest.generator !== 'string') throw new Error('A request names its generator.');
  return { request: complete(rest), preset: null };
}

/** Adds the members that the page relies on. */
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

/** Returns every error (as a Refusal) or every warning, without generating the model. */
export async function check(request: Request, signal?: AbortSignal): Promise<Check> {
  const answer = (await (await post_json('v1/validate', request, 'application/json', signal)).json()) as Check;
  return { estimate: answer.estimate, warnings: answer.warnings.map((warning) => ({ ...warning, mild: true })) };
}

/** Returns the generator's result before geometry exists. Its members depend on the generator. */
export const derive = async (request: Request, signal?: AbortSignal): Promise<Record<string, unknown>> =>
  (await (await post_json('v1/derive', request, 'application/json', signal)).json()) as Record<string, unknown>;

/** The import formats that the server's OpenAPI document lists. */
export async function import_formats(): Promise<string[]> {
  const { components } = await read<{ components: { parameters: { ImportFormat?: { schema?: { enum?: string[] } } } } }>('openapi.json');
  return components.parameters.ImportFormat?.schema?.enum ?? [];
}

/** Converts a file of another program to a request. Without a format, the server detects it from the content. */
export async function import_file(text: string, format: string, entry: string): Promise<{ format: string; request: Request; warnings: Issue[] }> {
  const query = new URLSearchParams({ ...(format && { format }), ...(entry && { entry }) });
  const response = await call(`v1/import?${query}`, { method: 'POST', headers: { 'Content-Type': 'text/plain' }, body: text });
  const answer = parse_json(await response.text()) as { format: string; request: Partial<Request>; warnings: Issue[] };
  return { format: answer.format, request: complete(answer.request), warnings: answer.warnings };
}

export const in_format = (request: Request, format: string): Request =>
  ({ ...request, output: { ...request.output, format } });

/** A response body that ends early counts as no answer. */
async function whole_body(response: Response, signal?: AbortSignal): Promise<ArrayBuffer> {
  try {
    return await response.arrayBuffer();
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Gone('The response ended too early.');
  }
}

/** The tile of a posted world that shows all of it. Its tileset has been answered; `Content-Location` is its address. */
async function root_tile(tileset: Response, signal?: AbortSignal): Promise<Response> {
  void tileset.body?.cancel();
  const address = (tileset.headers.get('Content-Location') ?? '').replace(/^\//, '').replace(/tileset\.json$/, 'c/0/0/0.glb');
  return call(address, { signal: signal ?? null });
}

/** Throws Heavy before the download if the model has `most` triangles or more. Of a world, the model is the root tile. */
export async function generate(request: Request, signal?: AbortSignal, most = Infinity): Promise<Made> {
  const posted = await post(request, '*/*', signal);
  const response = posted.headers.get('Content-Type')?.startsWith('application/json') ? await root_tile(posted, signal) : posted;
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
      // Content-Length counts the transferred bytes, which may be compressed. The page shows the size of the file.
      bytes: bytes.byteLength,
      milliseconds: total_duration(timing),
      is_kept: /\bcache;\s*desc="?(hit|shared)/.test(timing),
    },
  };
}

const sum_of = (timing: Record<string, number> | undefined): number | null =>
  (timing ? Object.values(timing).reduce((sum, each) => sum + each, 0) : null);

function total_duration(server_timing: string): number {
  return Number(/\btotal;\s*dur=([\d.]+)/.exec(server_timing)?.[1] ?? 0);
}

/**
 * Generates the model on the server and reports the progress, from 0 to 1, through `tell`. The caller then fetches
 * the model from the server's cache. Returns the generation time in milliseconds, or null if the server does not
 * report it.
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
      throw new Gone('The response ended too early.');
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
      // The number of stages is not known in advance, so each stage takes half of the remaining range.
      const before = 1 - 0.5 ** (stages.length - 1);
      tell(before + (1 - before) * 0.5 * progress.share);
    }
  }
}
