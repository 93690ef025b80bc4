/** Encodes a request in the fragment of the page's address. The link is self-contained; no server stores it. */
import { complete, type Request } from './api';
import { parse_json } from './exact';

/** Browsers and intermediaries truncate longer addresses. Requests with embedded images exceed this. */
export const longest_link = 32_000;

async function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream): Promise<ArrayBuffer> {
  return new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer();
}

/**
 * Deflated JSON in base64url, the same encoding as the server's permalinks; 250 to 1,000 characters for most
 * requests.
 */
async function pack(request: Request): Promise<string> {
  const json = new TextEncoder().encode(JSON.stringify(request));
  const packed = new Uint8Array(await through(json, new CompressionStream('deflate-raw')));
  let binary = '';
  for (const byte of packed) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

/** The fragment: the encoded request, then a dot and the preset, which provides the title. */
export const fragment_of = async (request: Request, preset: string | null): Promise<string> =>
  `${await pack(request)}${preset ? `.${preset}` : ''}`;

export const preset_in = (fragment: string): string | null => /\.([a-z0-9_-]+)$/.exec(fragment)?.[1] ?? null;

/** Throws if the text does not encode a request. */
export async function unpack(fragment: string): Promise<Request> {
  const [text = ''] = fragment.split('.');
  const binary = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
  const bytes = Uint8Array.from(binary, (character) => character.charCodeAt(0));
  const json = parse_json(new TextDecoder().decode(await through(bytes, new DecompressionStream('deflate-raw'))));
  const given = json as Partial<Request> | null;
  if (typeof given !== 'object' || given === null || typeof given.generator !== 'string') throw new Error('no request');
  return complete(given);
}

/** Longer addresses of the service are refused. */
const longest_card = 8_000;

/** The address of the service for a request, which programs show with a picture; null if the request is too long. */
export async function card_of(request: Request): Promise<string | null> {
  const token = await pack(request);
  return token.length > longest_card ? null : new URL(`./m/${token}`, location.href).href;
}

export async function link_to(request: Request, preset: string | null): Promise<string> {
  const address = new URL(location.href);
  address.search = '';
  address.hash = await fragment_of(request, preset);
  return address.href;
}
