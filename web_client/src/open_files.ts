/**
 * Files that come in, chosen or dropped: a request of ours, or a file of another program, which the server turns into
 * one. Which program's it is the server finds out: its formats are tried in turn.
 */
import { Refusal, import_file, import_formats, whole, type Fault, type Request, type Written } from './api';
import { el, part, sentence } from './dom';
import { parse_json } from './exact';
import { is_members } from './form/schema';

interface Context {
  /** `words` stay over the model when it is drawn. */
  open(request: Request, title: string, words?: string): void;
  /** Ends when what was opened is drawn. */
  drawn(): Promise<boolean>;
  say(text: string): void;
  fail(text: string): void;
}

/** The server's own limit for a body. */
const largest = 16 * 1024 * 1024;

export function wire_files(context: Context): { choose(): void } {
  const input = part<HTMLInputElement>('file');
  const sign = part('drop-sign');
  const choose = (): void => { input.value = ''; input.click(); };
  part('open-file').addEventListener('click', choose);
  input.addEventListener('change', () => { if (input.files?.[0]) void take(input.files[0], context); });
  // A drag over a child of the page leaves and enters at once; the sign goes when nothing has entered again.
  let depth = 0;
  const has_file = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
  addEventListener('dragenter', (event) => { if (has_file(event)) { depth += 1; sign.hidden = false; } });
  addEventListener('dragleave', (event) => { if (has_file(event)) { depth -= 1; sign.hidden = depth > 0 ? sign.hidden : true; } });
  addEventListener('dragover', (event) => { if (has_file(event)) event.preventDefault(); });
  addEventListener('drop', (event) => {
    depth = 0;
    sign.hidden = true;
    const files = [...event.dataTransfer?.files ?? []];
    const [file] = files;
    if (!file || event.defaultPrevented) return;
    event.preventDefault();
    void take(file, context, files.length);
  });
  return { choose };
}

/** `of` so many that were dropped at once. */
async function take(file: File, context: Context, of = 1): Promise<void> {
  if (file.size > largest) { context.fail(`${file.name} is larger than 16 MB.`); return; }
  const text = await file.text().catch(() => null);
  if (text === null) { context.fail(`${file.name} cannot be read. A folder is not opened: drop the files in it one by one.`); return; }
  if (text.trim() === '') { context.fail(`${file.name} is empty.`); return; }
  const others = of > 1 ? `. It is one of ${of} files: they are opened one at a time` : '';
  if (text.includes('\0')) {
    context.fail(file.type.startsWith('image/') ? `${file.name} is a picture: drop it on the field of the picture that it is for.` : `${file.name} is no text: neither a request nor a grammar.`);
    return;
  }
  try {
    const given = await as_request(text);
    if (given) await opened(context, given.request, title_of(file), `${file.name} is opened${others}`);
    else await import_any(file, text, context, others);
  } catch (error) {
    context.fail(`${file.name}: ${sentence((error as Error).message)}`);
  }
}

const title_of = (file: File): string => file.name.replace(/\.[^.]*$/, '');

/** null where it is none of ours; one of ours that cannot be had is told as such. */
async function as_request(text: string): Promise<Written | null> {
  let json: unknown;
  try {
    json = parse_json(text);
  } catch {
    return null;
  }
  return is_members(json) && ('generator' in json || 'preset' in json) ? whole(json) : null;
}

/** How sure a refusal is that the file is of its format: a reader that knows none of it has most to say. */
interface Attempt { format: string; refusal: Refusal }

async function import_any(file: File, text: string, context: Context, others: string): Promise<void> {
  const attempts: Attempt[] = [];
  for (const format of await import_formats()) {
    try {
      await accept(file, text, format, '', context, others);
      return;
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      attempts.push({ format, refusal: error });
    }
  }
  attempts.sort((a, b) => Number(wants_entry(b.refusal)) - Number(wants_entry(a.refusal)) || a.refusal.faults.length - b.refusal.faults.length);
  ask(file, text, attempts, context);
}

const wants_entry = (refusal: Refusal): boolean => refusal.faults.some((fault) => fault.pointer === '/entry');

async function accept(file: File, text: string, format: string, entry: string, context: Context, others = ''): Promise<void> {
  const { request, warnings } = await import_file(text, format, entry);
  const lost = warnings.length === 0 ? '' : `What ${file.name} says and a request cannot: ${warnings.map(told).join(' ')}`;
  await opened(context, request, entry || title_of(file),
    `${file.name} is imported from ${format}${lost ? ` with ${warnings.length} warnings` : ''}${others}`, lost);
}

/** What happens while the model is made would wipe the word away. */
async function opened(context: Context, request: Request, title: string, word: string, lost = ''): Promise<void> {
  context.open(request, title, lost);
  if (await context.drawn()) context.say(word);
}

const told = (fault: Fault): string => (fault.line === undefined ? sentence(fault.message) : `Line ${fault.line}, column ${fault.column ?? 1}: ${fault.message}.`);

/** No format took the file: the reader that came closest says why, and another one or an entry can be named. */
function ask(file: File, text: string, attempts: Attempt[], context: Context): void {
  const dialog = part<HTMLDialogElement>('import-dialog');
  const list = el('ul', { class: 'faults' });
  const format = el('select', { id: 'import-format' }, ...attempts.map((attempt) => el('option', { value: attempt.format }, attempt.format)));
  const entry = el('input', { id: 'import-entry', type: 'text', autocomplete: 'off', spellcheck: 'false' });
  const tell = (refusal: Refusal | undefined): void => {
    const faults = refusal?.faults ?? [];
    list.replaceChildren(...(faults.length > 0 ? faults.map((fault) => el('li', {}, told(fault))) : [el('li', {}, sentence(refusal?.message ?? ''))]));
  };
  format.addEventListener('change', () => tell(attempts[format.selectedIndex]?.refusal));
  tell(attempts[0]?.refusal);
  const again = el('button', { type: 'button', class: 'first' }, 'Import');
  again.addEventListener('click', () => {
    accept(file, text, format.value, entry.value.trim(), context).then(
      () => dialog.close(),
      (error: unknown) => tell(error instanceof Refusal ? error : new Refusal({ detail: String(error) })));
  });
  dialog.replaceChildren(
    ...(attempts[0] && wants_entry(attempts[0].refusal)
      ? [el('h2', { id: 'import-title' }, `Which entry of ${file.name}?`), el('p', { class: 'soft' }, 'It holds several: name the one to import.')]
      : [el('h2', { id: 'import-title' }, `${file.name} is not understood`), el('p', { class: 'soft' }, 'It is no request, and no format takes it as it is.')]),
    el('div', { class: 'row' }, el('label', { for: 'import-format' }, 'Format'), format, el('label', { for: 'import-entry' }, 'Entry'), entry),
    el('div', { role: 'status' }, list),
    el('div', { class: 'row end' }, again, el('button', { type: 'button', onclick: () => dialog.close() }, 'Close')));
  dialog.showModal();
}
