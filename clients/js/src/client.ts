import { Busy, Refused, error_of, is_busy } from './errors.js';
import { events_of } from './events.js';
import { permalink_path, picture_path, preset_path, sign_path, type Overrides, type PictureOptions } from './links.js';
import type {
  BuildingDerivation, BuildingRequest, CityDerivation, CityRequest, FractalDerivation, FractalRequest, LsystemDerivation, LsystemRequest, PresetList, Problem,
  Request, SceneDerivation, SceneRequest, TerrainDerivation, TerrainRequest, TreeDerivation, TreeRequest, Validation,
} from './types.js';

export interface ClientOptions {
  /** An API key, sent as bearer token. */
  key?: string;
  /** Seconds to wait while the server is busy; 60 unless given. */
  patience?: number;
  /** Instead of the global fetch, for example with a cache. */
  fetch?: typeof fetch;
}

export interface CallOptions { signal?: AbortSignal }

export interface Progress { stage: string; share: number }

export interface GenerateOptions extends CallOptions {
  /** Called while the model is made. The model is then transferred by a second request, from the cache of the server. */
  on_progress?: (progress: Progress) => void;
}

/** A file that the server made. */
export interface Model {
  data: ArrayBuffer;
  media_type: string;
  etag: string;
  /** Path of the permalink, or null if it would be too long. */
  link: string | null;
  triangles: number;
  vertices: number;
  warnings: number;
}

/** Request and derivation of each generator. */
interface Generators {
  building: [BuildingRequest, BuildingDerivation];
  city: [CityRequest, CityDerivation];
  fractal: [FractalRequest, FractalDerivation];
  lsystem: [LsystemRequest, LsystemDerivation];
  scene: [SceneRequest, SceneDerivation];
  terrain: [TerrainRequest, TerrainDerivation];
  tree: [TreeRequest, TreeDerivation];
}

/** What `derive` answers to a request with this generator. */
export type DerivationOf<G extends keyof Generators> = Generators[G][1];

const shortest_wait = 0.1;  // seconds, for a server that says Retry-After: 0

export class Client {
  readonly url: string;
  private readonly options: ClientOptions;

  constructor(url = 'http://127.0.0.1:8080', options: ClientOptions = {}) {
    this.url = url.replace(/\/+$/, '');
    this.options = options;
  }

  /** The engine version: same engine and same request give the same bytes. */
  async engine(options: CallOptions = {}): Promise<string> {
    return (await (await this.call('/version', options)).json() as { engine: string }).engine;
  }

  /** The gallery, and the generators with their titles. */
  async presets(options: CallOptions = {}): Promise<PresetList> {
    return await (await this.call('/v1/presets', options)).json() as PresetList;
  }

  /** The whole request of a preset. */
  async preset(name: string, options: CallOptions = {}): Promise<Request> {
    return await (await this.call(preset_path(name, {}, 'json'), options)).json() as Request;
  }

  /** Warnings and an estimate of the size, without geometry. */
  async validate(request: Request, options: CallOptions = {}): Promise<Validation> {
    return await (await this.post('/v1/validate', request, options)).json() as Validation;
  }

  /** The generator's own result before geometry. */
  derive<G extends keyof Generators>(request: Generators[G][0] & { generator: G }, options?: CallOptions): Promise<DerivationOf<G>>;
  derive(request: Request, options?: CallOptions): Promise<unknown>;
  async derive(request: Request, options: CallOptions = {}): Promise<unknown> {
    return (await this.post('/v1/derive', request, options)).json();
  }

  async generate(request: Request, options: GenerateOptions = {}): Promise<Model> {
    if (options.on_progress) await this.watch(request, options.on_progress, options);
    const response = await this.post('/v1/generate', request, options);
    const count = (name: string) => Number(response.headers.get(name) ?? 0);
    return {
      data: await response.arrayBuffer(),
      media_type: response.headers.get('content-type') ?? '',
      etag: response.headers.get('etag') ?? '',
      link: response.headers.get('content-location'),
      triangles: count('seedmesh-triangles'),
      vertices: count('seedmesh-vertices'),
      warnings: count('seedmesh-warnings'),
    };
  }

  /** A link that contains the whole request, made without the server. RangeError if the request is too long for one. */
  async permalink(request: Request, extension?: string): Promise<string> {
    return this.url + await permalink_path(request, extension);
  }

  /** A picture of the model that the service draws, as WebP. RangeError if the request is too long for a link. */
  async picture(request: Request, picture: PictureOptions = {}, options: CallOptions = {}): Promise<ArrayBuffer> {
    return (await this.call(await picture_path(request, picture), options)).arrayBuffer();
  }

  preset_url(name: string, overrides: Overrides = {}, extension = 'glb'): string {
    return this.url + preset_path(name, overrides, extension);
  }

  /** A link of this server with a signature, for clients without a key. */
  async sign(url: string, key: string, secret: Uint8Array<ArrayBuffer>, expires?: number): Promise<string> {
    if (!url.startsWith(`${this.url}/`)) throw new TypeError(`found the link ${url}, expected one of ${this.url}`);
    return this.url + await sign_path(url.slice(this.url.length), key, secret, expires);
  }

  private async watch(request: Request, on_progress: (progress: Progress) => void, options: CallOptions): Promise<void> {
    const response = await this.post('/v1/generate', request, options, { accept: 'text/event-stream' });
    if (!response.body) throw new TypeError('the answer has no body');
    for await (const { name, data } of events_of(response.body)) {
      if (name === 'progress') on_progress(data as Progress);
      if (name === 'error') throw new (is_busy((data as Problem).status) ? Busy : Refused)(data as Problem);
      if (name === 'done') return;
    }
    throw new TypeError('the server closed the stream of events before the model was made');
  }

  private post(target: string, request: unknown, options: CallOptions, headers: Record<string, string> = {}): Promise<Response> {
    return this.call(target, options, { method: 'POST', body: JSON.stringify(request), headers: { ...headers, 'content-type': 'application/json' } });
  }

  /** An answer with a status below 300. Repeats the call while the server is busy. */
  private async call(target: string, { signal }: CallOptions, init: RequestInit = {}): Promise<Response> {
    const headers = { ...init.headers as Record<string, string> };
    if (this.options.key) headers['authorization'] = `Bearer ${this.options.key}`;
    const end = Date.now() + 1000 * (this.options.patience ?? 60);
    for (;;) {
      const response = await (this.options.fetch ?? fetch)(this.url + target, { ...init, headers, ...(signal ? { signal } : {}) });
      if (response.ok) return response;
      const named = response.headers.get('retry-after');
      const wait = 1000 * Math.max(Number(named), shortest_wait);
      if (!is_busy(response.status) || !named || !(Date.now() + wait <= end)) throw await error_of(response);
      await response.body?.cancel();
      await pause(wait, signal);
    }
  }
}

/** Resolves after this number of milliseconds; rejects with the reason of the signal. */
function pause(milliseconds: number, signal?: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const stop = () => { clearTimeout(timer); reject(signal?.reason as Error); };
    const timer = setTimeout(() => { signal?.removeEventListener('abort', stop); resolve(); }, milliseconds);
    if (signal?.aborted) stop();
    else signal?.addEventListener('abort', stop, { once: true });
  });
}
