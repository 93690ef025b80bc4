/** Code examples that request the model and save it. The page only shows them and never runs them. */
import { in_format, type Request } from './api';
import { has_key } from './key';

/** The copied code reads the key from this variable at run time, so that the key is not copied. */
const key_variable = 'SEEDMESH_KEY';

/** File extensions that differ from the name of the format. */
export const endings: Record<string, string> = { png16: 'png', png8: 'png', rgb24: 'png', rgba32: 'png', placements: 'zip' };

/** The requested format; the default is glb. */
export const own_format = (request: Request): string => String(request.output?.['format'] ?? 'glb');

const file_of = (request: Request): string => `model.${endings[own_format(request)] ?? own_format(request)}`;
const own = (request: Request): Request => in_format(request, own_format(request));

const address = (): string => new URL('v1/generate', location.href.split(/[?#]/)[0]).href;

/** A command for a POSIX shell. */
export function curl_of(request: Request): string {
  const quote = (text: string): string => `'${text.replaceAll("'", `'\\''`)}'`;
  return `curl --fail-with-body -o ${file_of(request)} -H 'Content-Type: application/json'${has_key() ? ` -H "Authorization: Bearer $${key_variable}"` : ''} -d ${quote(JSON.stringify(own(request)))} ${quote(address())}`;
}

/** Writes JSON as a Python literal. Only three words differ; the string escapes are the same in both languages. */
function python_literal(value: unknown, indent: string): string {
  if (value === null) return 'None';
  if (typeof value === 'boolean') return value ? 'True' : 'False';
  if (typeof value !== 'object') return JSON.stringify(value).replace(/[\u0080-\uffff]/g, (unit) => `\\u${unit.charCodeAt(0).toString(16).padStart(4, '0')}`).replace(/\\u(d[89ab]..)\\u(d[c-f]..)/g,
    (_, high: string, low: string) => `\\U${(((parseInt(high, 16) & 0x3ff) << 10 | parseInt(low, 16) & 0x3ff) + 0x10000).toString(16).padStart(8, '0')}`);
  const inner = `${indent}    `;
  const items = Array.isArray(value)
    ? value.map((each) => python_literal(each, inner))
    : Object.entries(value).map(([name, each]) => `${python_literal(name, inner)}: ${python_literal(each, inner)}`);
  const [open, close] = Array.isArray(value) ? ['[', ']'] : ['{', '}'];
  const flat = items.join(', ');
  return flat.length + indent.length < 90 && !flat.includes('\n') ? `${open}${flat}${close}` : `${open}\n${items.map((item) => `${inner}${item},\n`).join('')}${indent}${close}`;
}

/** Uses only the Python standard library. */
export function python_of(request: Request): string {
  return `import json
${has_key() ? 'import os\n' : ''}import urllib.error
import urllib.request

request = ${python_literal(own(request), '')}

call = urllib.request.Request(
    ${JSON.stringify(address())},
    data=json.dumps(request).encode(),
    headers={"Content-Type": "application/json"${has_key() ? `, "Authorization": "Bearer " + os.environ["${key_variable}"]` : ''}},
)
try:
    with urllib.request.urlopen(call) as answer, open("${file_of(request)}", "wb") as file:
        file.write(answer.read())
except urllib.error.HTTPError as problem:
    raise SystemExit(problem.read().decode())
`;
}

/** An ES module for Node. The same fetch call works in a browser. */
export function javascript_of(request: Request): string {
  return `import { writeFile } from 'node:fs/promises';

const request = ${JSON.stringify(own(request), null, 2)};

const answer = await fetch(${JSON.stringify(address())}, {
  method: 'POST',
  headers: { 'Content-Type': 'application/json'${has_key() ? `, Authorization: \`Bearer \${process.env.${key_variable}}\`` : ''} },
  body: JSON.stringify(request),
});
if (!answer.ok) throw new Error(await answer.text());
await writeFile('${file_of(request)}', new Uint8Array(await answer.arrayBuffer()));
`;
}
