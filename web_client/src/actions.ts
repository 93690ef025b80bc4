/** What leaves the page: files, the link, the command. */
import { Busy, Gone, generate, in_format, type Request } from './api';
import { el, part } from './dom';
import { curl_of, link_to } from './link';

interface Context {
  request(): Request | null;
  /** The file's name without its ending. */
  name(): string;
  say(text: string): void;
  fail(text: string): void;
}

const written: Record<string, string> = { gltf: 'glTF' };
const endings: Record<string, string> = { png16: 'png', png8: 'png', rgb24: 'png', rgba32: 'png' };

/** One button for each format. */
export function wire_downloads(formats: string[], context: Context): void {
  part('downloads').replaceChildren(...formats.map((format) =>
    el('button', { type: 'button', 'data-format': format, title: `Download as .${endings[format] ?? format}`, onclick: () => void download(format, context) },
      written[format] ?? format.toUpperCase())));
}

export function wire_copies(context: Context): void {
  part('copy-link').addEventListener('click', async () => {
    const request = context.request();
    if (request) await copy(await link_to(request), 'The link is copied', context);
  });
  part('copy-curl').addEventListener('click', async () => {
    const request = context.request();
    if (request) await copy(curl_of(request), 'The command is copied', context);
  });
}

async function download(format: string, context: Context): Promise<void> {
  const request = context.request();
  if (!request) return;
  try {
    const { bytes } = await generate(in_format(request, format));
    const address = URL.createObjectURL(new Blob([bytes]));
    el('a', { href: address, download: `${context.name()}.${endings[format] ?? format}` }).click();
    // The browser reads the address after this task; a minute is long enough for it.
    setTimeout(() => URL.revokeObjectURL(address), 60_000);
    context.say(`${written[format] ?? format.toUpperCase()} is downloaded`);
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
