/** What leaves the page: files, the link, programs that fetch the model. */
import { Busy, Gone, generate, in_format, type Request } from './api';
import { curl_of, endings, javascript_of, own_format, python_of } from './commands';
import { el, part } from './dom';
import { link_to, longest_link } from './link';

export interface Context {
  request(): Request | null;
  /** Where the request came from. */
  preset(): string | null;
  /** The file's name without its ending. */
  name(): string;
  /** What is seen now. */
  picture(): Promise<Blob | null>;
  say(text: string): void;
  fail(text: string): void;
}

const written: Record<string, string> = { gltf: 'glTF' };

/** Links beyond this are cut by chats and mail. */
const long_link = 2000;

const called = (format: string): string => written[format] ?? format.toUpperCase();
const told = (format: string): string => `Download as .${endings[format] ?? format}`;

/** One button for each format; what the request itself asks for has the button outside the menu. */
export function wire_downloads(formats: string[], context: Context): void {
  const request = context.request();
  const wanted = request ? own_format(request) : 'glb';
  const first = formats.includes(wanted) ? wanted : formats[0] ?? 'glb';
  const main = part('download');
  main.dataset['format'] = first;
  main.title = told(first);
  main.textContent = called(first);
  part('downloads').replaceChildren(...formats.filter((format) => format !== first).map((format) =>
    el('button', { type: 'button', 'data-format': format, 'data-close': true, title: told(format) }, called(format))));
  for (const button of document.querySelectorAll<HTMLButtonElement>('[data-format]'))
    button.onclick = () => void download(button.dataset['format'] ?? '', context);
}

export function wire_copies(context: Context): void {
  const on = (id: string, act: (request: Request) => Promise<void>): void =>
    part(id).addEventListener('click', () => { const request = context.request(); if (request) void act(request); });
  on('copy-link', async (request) => {
    const link = await link_to(request, context.preset());
    if (link.length > longest_link) {
      context.fail(`This request is too long for a link: ${link.length} characters. Save it as JSON instead, which opens here by drop.`);
      return;
    }
    const warning = link.length > long_link ? `. It has ${link.length} characters: some programs cut it. The request as JSON is safer` : '';
    await copy(link, `The link is copied${warning}`, context);
  });
  on('copy-curl', (request) => copy(curl_of(request), 'The command is copied', context));
  on('copy-python', (request) => copy(python_of(request), 'The Python program is copied', context));
  on('copy-javascript', (request) => copy(javascript_of(request), 'The JavaScript program is copied', context));
  on('save-request', async (request) => save_request(request, context));
  on('save-picture', () => save_picture(context));
}

export function save_request(request: Request, context: Context): void {
  save(new Blob([`${JSON.stringify(request, null, 2)}\n`]), 'json', context);
  context.say('The request is saved');
}

export async function save_picture(context: Context): Promise<void> {
  const picture = await context.picture();
  if (!picture) return;
  save(picture, 'png', context);
  context.say('The picture is saved');
}

function save(file: Blob, ending: string, context: Context): void {
  const address = URL.createObjectURL(file);
  el('a', { href: address, download: `${context.name()}.${ending}` }).click();
  // The browser reads the address after this task; a minute is long enough for it.
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

async function download(format: string, context: Context): Promise<void> {
  const request = context.request();
  if (!request) return;
  try {
    const { bytes } = await generate(in_format(request, format));
    save(new Blob([bytes]), endings[format] ?? format, context);
    context.say(`${called(format)} is downloaded`);
  } catch (error) {
    const why = error instanceof Busy ? 'The server is full.' : error instanceof Gone ? 'The server cannot be reached.' : (error as Error).message;
    context.fail(`No file: ${why}`);
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
