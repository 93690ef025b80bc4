/**
 * Opens chosen or dropped files: a Seedmesh request, or a file of another program that the server converts. The
 * server detects the format from the content.
 */
import { Refusal, import_file, import_formats, whole, type Issue, type Request, type Written } from './api';
import { el, part, sentence } from './dom';
import { parse_json } from './exact';
import { is_members } from './form/schema';

interface Context {
  /** `words` is a message that stays visible after the model is drawn. */
  open(request: Request, title: string, words?: string): void;
  /** Resolves when the opened model is drawn. */
  drawn(): Promise<boolean>;
  say(text: string): void;
  fail(text: string): void;
}

/** The server's limit for a request body. */
const largest = 16 * 1024 * 1024;

export function wire_files(context: Context): { choose(): void } {
  const input = part<HTMLInputElement>('file');
  const sign = part('drop-sign');
  const choose = (): void => { input.value = ''; input.click(); };
  part('open-file').addEventListener('click', choose);
  input.addEventListener('change', () => { if (input.files?.[0]) void take(input.files[0], context); });
  // A drag over a child element fires leave and enter in turn. The overlay is hidden only if no enter follows.
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

/** `of` is the number of files dropped together. */
async function take(file: File, context: Context, of = 1): Promise<void> {
  if (file.size > largest) { context.fail(`${file.name} is larger than 16 MB.`); return; }
  const text = await file.text().catch(() => null);
  if (text === null) { context.fail(`${file.name} cannot be read. Folders cannot be opened. Drop its files one by one.`); return; }
  if (text.trim() === '') { context.fail(`${file.name} is empty.`); return; }
  const others = of > 1 ? `. It is one of ${of} files; only one is opened at a time` : '';
  if (text.includes('\0')) {
    context.fail(file.type.startsWith('image/') ? `${file.name} is an image. Drop it on the field of the image.` : `${file.name} is not a text file. Open a request or a grammar.`);
    return;
  }
  try {
    const given = await as_request(text);
    if (given) await opened(context, given.request, title_of(file), `${file.name} is opened${others}`);
    else if (/\.cga$/i.test(file.name)) await opened(context, with_rules(text), title_of(file), `${file.name} is opened${others}`);
    else await import_any(file, text, context, others);
  } catch (error) {
    context.fail(`${file.name}: ${sentence((error as Error).message)}`);
  }
}

const title_of = (file: File): string => file.name.replace(/\.[^.]*$/, '');

/** Returns null for a file that is not a Seedmesh request. Reports an error if the request cannot be opened. */
async function as_request(text: string): Promise<Written | null> {
  let json: unknown;
  try {
    json = parse_json(text);
  } catch {
    return null;
  }
  return is_members(json) && ('generator' in json || 'preset' in json) ? whole(json) : null;
}

/** A building by a rule file of CityEngine, on a lot. */
const with_rules = (rules: string): Request => ({ generator: 'building', seed: 0, parameters: { size: [24, 0, 16], rules } });

interface Attempt { format: string; refusal: Refusal }

/** Tries the detected format first. If it fails, all formats are tried to collect their errors. */
async function import_any(file: File, text: string, context: Context, others: string): Promise<void> {
  const attempts: Attempt[] = [];
  let likeliest = '';
  for (const format of ['', ...await import_formats()]) {
    try {
      await accept(file, text, format, '', context, others);
      return;
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      if (format) attempts.push({ format, refusal: error });
      else likeliest = error.format;
    }
  }
  // A reader of an unrelated format reports the most errors, so the shortest list is the most useful.
  attempts.sort((a, b) => Number(b.format === likeliest) - Number(a.format === likeliest) || a.refusal.issues.length - b.refusal.issues.length);
  ask(file, text, attempts, context);
}

const wants_entry = (refusal: Refusal): boolean => refusal.issues.some((issue) => issue.pointer === '/entry');

async function accept(file: File, text: string, format: string, entry: string, context: Context, others = ''): Promise<void> {
  const { format: found, request, warnings } = await import_file(text, format, entry);
  const lost = warnings.length === 0 ? '' : `These parts of ${file.name} cannot be imported: ${warnings.map(text_of).join(' ')}`;
  await opened(context, request, entry || title_of(file),
    `${file.name} is imported from ${found}${lost ? ` with ${warnings.length} warnings` : ''}${others}`, lost);
}

/** Messages during the generation would replace this one. */
async function opened(context: Context, request: Request, title: string, word: string, lost = ''): Promise<void> {
  context.open(request, title, lost);
  if (await context.drawn()) context.say(word);
}

const text_of = (issue: Issue): string => (issue.line === undefined ? sentence(issue.message) : `Line ${issue.line}, column ${issue.column ?? 1}: ${issue.message}.`);

/**
 * No format accepted the file: shows the errors of the closest reader and offers other formats or archive entries.
 */
function ask(file: File, text: string, attempts: Attempt[], context: Context): void {
  const dialog = part<HTMLDialogElement>('import-dialog');
  const list = el('ul', { class: 'issues' });
  const format = el('select', { id: 'import-format' }, ...attempts.map((attempt) => el('option', { value: attempt.format }, attempt.format)));
  const entry = el('input', { id: 'import-entry', type: 'text', autocomplete: 'off', spellcheck: 'false' });
  const tell = (refusal: Refusal | undefined): void => {
    const issues = refusal?.issues ?? [];
    list.replaceChildren(...(issues.length > 0 ? issues.map((issue) => el('li', {}, text_of(issue))) : [el('li', {}, sentence(refusal?.message ?? ''))]));
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
      ? [el('h2', { id: 'import-title' }, `Which entry of ${file.name}?`), el('p', { class: 'soft' }, 'The file has several entries. Name the one to import.')]
      : [el('h2', { id: 'import-title' }, `${file.name} cannot be read`), el('p', { class: 'soft' }, 'It is not a request, and no import format accepts it.')]),
    el('div', { class: 'row' }, el('label', { for: 'import-format' }, 'Format'), format, el('label', { for: 'import-entry' }, 'Entry'), entry),
    el('div', { role: 'status' }, list),
    el('div', { class: 'row end' }, again, el('button', { type: 'button', onclick: () => dialog.close() }, 'Close')));
  dialog.showModal();
}
