/** Exports from the page: downloaded files, the shared link, and code that requests the model. */
import { Busy, Gone, generate, get_text, in_format, type Request } from './api';
import { curl_of, endings, javascript_of, own_format, python_of } from './commands';
import { el, part, sentence } from './dom';
import { card_of, fragment_of, link_to, longest_link } from './link';

export interface Context {
  request(): Request | null;
  /** The preset that the request came from. */
  preset(): string | null;
  /** The file name without its extension. */
  name(): string;
  /** The current view as an image. */
  picture(): Promise<Blob | null>;
  say(text: string): void;
  /** An empty text clears the previous message. */
  fail(text: string): void;
  /** Shows a message until the task ends, then shows the message passed to the returned function. */
  begin(text: string): (text: string) => void;
}

const written: Record<string, string> = { gltf: 'glTF', placements: 'Placements' };

/** Chat and mail programs truncate links longer than this. */
const long_link = 2000;

const called = (format: string): string => written[format] ?? format.toUpperCase();
const ending_of = (format: string): string => endings[format] ?? format;
const hint_for = (format: string): string => `Download as ${format in endings ? `${called(format)}, a .${ending_of(format)}` : `.${format}`}`;
/** Two formats can share one file extension, so their menu entries show the format name. */
const file_name = (name: string, format: string): string => `${name}${format in endings ? `-${format}` : ''}.${ending_of(format)}`;

/** Adds one button per format. The format that the request itself names has a button outside the menu. */
export function wire_downloads(formats: string[], context: Context): void {
  const request = context.request();
  const wanted = request ? own_format(request) : 'glb';
  const first = formats.includes(wanted) ? wanted : formats[0] ?? 'glb';
  const main = part('download');
  main.dataset['format'] = first;
  main.title = hint_for(first);
  main.textContent = called(first);
  part('downloads').replaceChildren(...formats.filter((format) => format !== first).map((format) =>
    el('button', { type: 'button', 'data-format': format, 'data-close': true, title: hint_for(format) }, called(format))));
  for (const button of document.querySelectorAll<HTMLButtonElement>('[data-format]'))
    button.onclick = () => void download(button.dataset['format'] ?? '', context);
}

export function wire_copies(context: Context): void {
  const on = (id: string, act: (request: Request) => Promise<void>): void =>
    part(id).addEventListener('click', () => { const request = context.request(); if (request) void act(request); });
  on('copy-link', async (request) => {
    const link = await link_to(request, context.preset());
    if (link.length > longest_link) {
      context.fail(`This request is too long for a link: ${link.length} characters. Save it as JSON instead. Drop the file here to open it.`);
      return;
    }
    const warning = link.length > long_link ? `. It has ${link.length} characters: some programs cut it. The request as JSON is safer` : '';
    await copy(link, `The link is copied${warning}`, context);
  });
  on('copy-card', async (request) => {
    const link = await card_of(request);
    if (link === null) context.fail('This request is too long for an address of the service. Copy the link instead.');
    else await copy(link, 'The link is copied', context);
  });
  on('copy-curl', (request) => copy(curl_of(request), 'The command is copied', context));
  on('copy-python', (request) => copy(python_of(request), 'The Python program is copied', context));
  on('copy-javascript', (request) => copy(javascript_of(request), 'The JavaScript program is copied', context));
  on('save-request', async (request) => save_request(request, context));
  on('save-picture', () => save_picture(context));
}

export function save_request(request: Request, context: Context, name = context.name()): void {
  save(new Blob([`${JSON.stringify(request, null, 2)}\n`]), `${name}.json`);
  context.say('The request is saved');
}

export async function save_picture(context: Context): Promise<void> {
  const name = context.name();
  const picture = await context.picture();
  if (!picture) return;
  save(picture, `${name}-view.png`);
  context.say('The image is saved');
}

function save(file: Blob, name: string): void {
  const address = URL.createObjectURL(file);
  el('a', { href: address, download: name }).click();
  // The browser reads the object URL after this task has ended. One minute is long enough for that.
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

/** Saves a tree of the model proctree as a file of proctree. */
export async function save_proctree(request: Request, context: Context): Promise<void> {
  context.fail('');
  const name = `${context.name()}.proctree.json`;
  try {
    save(new Blob([await get_text(`v1/models/${await fragment_of(request, null)}.proctree.json`)]), name);
    context.say(`${name} is saved`);
  } catch (error) {
    context.fail(`Cannot save ${name}: ${sentence((error as Error).message)}`);
  }
}

/** Downloads in progress, so that one file is not fetched twice at the same time. */
const coming = new Map<Request, Set<string>>();

async function download(format: string, context: Context): Promise<void> {
  const request = context.request();
  if (!request) return;
  const formats = coming.get(request) ?? new Set();
  if (formats.has(format)) return;
  coming.set(request, formats.add(format));
  // Another model may be shown by the time the file arrives.
  const name = file_name(context.name(), format);
  const mark = (): void => {
    for (const button of document.querySelectorAll<HTMLElement>('[data-format]'))
      button.setAttribute('aria-busy', String(coming.get(context.request() ?? request)?.has(button.dataset['format'] ?? '') ?? false));
  };
  mark();
  context.fail('');
  const done = context.begin(`${name} is being fetched`);
  try {
    const { bytes } = await generate(in_format(request, format));
    save(new Blob([bytes]), name);
    done(`${name} is downloaded`);
  } catch (error) {
    const why = error instanceof Busy ? 'The server is busy.' : error instanceof Gone ? 'The server cannot be reached.' : (error as Error).message;
    done('');
    context.fail(`Cannot save ${name}: ${sentence(why)}`);
  } finally {
    formats.delete(format);
    if (formats.size === 0) coming.delete(request);
    mark();
  }
}

async function copy(text: string, done: string, context: Context): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    context.say(done);
  } catch {
    const area = part<HTMLTextAreaElement>('by-hand-text');
    area.value = text;
    part<HTMLDialogElement>('by-hand').showModal();
    area.select();
  }
}
