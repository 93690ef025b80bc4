/** Reads the warnings that the server stores in the model file. */
import type { Issue } from './api';

interface Json { asset?: { extras?: { warnings?: Issue[] } } }

/** Reads the JSON chunk, which is the first chunk of a GLB. */
export function warnings_in(glb: ArrayBuffer): Issue[] {
  const length = new DataView(glb).getUint32(12, true);
  const { asset } = JSON.parse(new TextDecoder().decode(new Uint8Array(glb, 20, length))) as Json;
  return (asset?.extras?.warnings ?? []).map((warning) => ({ ...warning, mild: true }));
}
