/** Reads the server's zip files, whose entries are stored without compression, and the levels of detail in them. */
import { Model } from './model';

interface Uri { uri?: string }

/** The entries by name. Throws if the bytes are not a zip or an entry is compressed. */
function entries_of(bytes: ArrayBuffer): Map<string, Uint8Array<ArrayBuffer>> {
  const view = new DataView(bytes);
  let end = bytes.byteLength - 22;
  while (end >= 0 && view.getUint32(end, true) !== 0x06054b50) end -= 1;
  if (end < 0) throw new Error('This is not a zip file.');
  const found = new Map<string, Uint8Array<ArrayBuffer>>();
  let at = view.getUint32(end + 16, true);
  for (let left = view.getUint16(end + 10, true); left > 0; left -= 1) {
    if (view.getUint16(at + 10, true) !== 0) throw new Error('An entry of the zip file is compressed.');
    const size = view.getUint32(at + 20, true), name_length = view.getUint16(at + 28, true);
    const local = view.getUint32(at + 42, true);
    const name = new TextDecoder().decode(new Uint8Array(bytes, at + 46, name_length));
    const start = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
    found.set(name, new Uint8Array(bytes, start, size));
    at += 46 + name_length + view.getUint16(at + 30, true) + view.getUint16(at + 32, true);
  }
  return found;
}

const level_of = (name: string): number => Number(/_LOD(\d+)\.gltf$/.exec(name)?.[1] ?? 0);

/** The models of a zip, from fine to coarse. */
export async function levels_of(bytes: ArrayBuffer): Promise<Model[]> {
  const entries = entries_of(bytes);
  const addresses = new Map<string, string>();
  const address = (name: string): string => {
    const known = addresses.get(name);
    if (known) return known;
    const made = URL.createObjectURL(new Blob([entries.get(name) ?? new Uint8Array()]));
    addresses.set(name, made);
    return made;
  };
  const names = [...entries.keys()].filter((name) => name.endsWith('.gltf')).sort((a, b) => level_of(a) - level_of(b));
  try {
    return await Promise.all(names.map((name) => {
      const json = JSON.parse(new TextDecoder().decode(entries.get(name))) as { buffers?: Uri[]; images?: Uri[] };
      for (const part of [...(json.buffers ?? []), ...(json.images ?? [])])
        if (part.uri !== undefined && entries.has(part.uri)) part.uri = address(part.uri);
      return Model.from(JSON.stringify(json));
    }));
  } finally {
    for (const made of addresses.values()) URL.revokeObjectURL(made);
  }
}
