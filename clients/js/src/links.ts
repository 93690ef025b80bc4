/** Addresses that are made without a server: permalinks, presets, signatures. */
import type { Request } from './types.js';

/** Characters of a link that the server takes. */
const longest_link = 8000;
const extensions: Record<string, string> = { png16: 'png', png8: 'png', rgb24: 'png', rgba32: 'png', placements: 'zip' };

/** `seed`, `output.x`, a parameter's name, or `constants.x`. */
export type Overrides = Record<string, string | number | boolean>;

function base64url(bytes: Uint8Array): string {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/** The request as base64url of raw deflate. */
export async function token_of(request: Request): Promise<string> {
  const packed = new Blob([JSON.stringify(request)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  return base64url(new Uint8Array(await new Response(packed).arrayBuffer()));
}

/** The extension of the format that the request names. */
export function extension_of(request: Request): string {
  const format = request.output?.format ?? 'glb';
  return extensions[format] ?? format;
}

/** Path of a link that contains the request. RangeError if no server would take it. */
export async function permalink_path(request: Request, extension = extension_of(request)): Promise<string> {
  const path = `/v1/models/${await token_of(request)}.${extension}`;
  if (path.length > longest_link) throw new RangeError(`the link has ${path.length} characters, expected at most ${longest_link}`);
  return path;
}

/** How a picture is taken. `view`: a name, or azimuth and elevation in degrees, as "35,18". */
export interface PictureOptions {
  /** Pixels a side, or width and height, as "640x360". */
  size?: number | `${number}x${number}`;
  view?: string;
  ground?: 'auto' | 'none' | 'plane';
}

/** The path of a picture of a model. */
export async function picture_path(request: Request, options: PictureOptions = {}): Promise<string> {
  const query = new URLSearchParams();
  for (const [key, value] of Object.entries(options)) if (value !== undefined) query.set(key, String(value));
  return `${await permalink_path(request, 'webp')}${query.size ? `?${query}` : ''}`;
}

export function preset_path(name: string, overrides: Overrides = {}, extension = 'glb'): string {
  const query = new URLSearchParams(Object.entries(overrides).map(([key, value]) => [key, String(value)]));
  return `/v1/presets/${encodeURIComponent(name)}.${extension}${query.size ? `?${query}` : ''}`;
}

/** The path with a signature, for a server with signing keys. `expires`: seconds since 1970. */
export async function sign_path(path: string, key: string, secret: Uint8Array<ArrayBuffer>, expires?: number): Promise<string> {
  const covered = `${path}${path.includes('?') ? '&' : '?'}${expires === undefined ? '' : `expires=${expires}&`}key=${key}`;
  const signing = await crypto.subtle.importKey('raw', secret, { name: 'HMAC', hash: 'SHA-256' }, false, ['sign']);
  const digest = await crypto.subtle.sign('HMAC', signing, new TextEncoder().encode(covered));
  return `${covered}&signature=${base64url(new Uint8Array(digest))}`;
}
