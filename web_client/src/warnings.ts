/** What the server had to say of a model while it made it: warnings that stand in the file alone. */
import type { Fault } from './api';

interface Json { asset?: { extras?: { warnings?: Fault[] } } }

/** Of a GLB: its first chunk is the JSON. */
export function warnings_in(glb: ArrayBuffer): Fault[] {
  const length = new DataView(glb).getUint32(12, true);
  const { asset } = JSON.parse(new TextDecoder().decode(new Uint8Array(glb, 20, length))) as Json;
  return (asset?.extras?.warnings ?? []).map((warning) => ({ ...warning, mild: true }));
}
