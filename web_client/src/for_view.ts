/** The request as the page draws it: one level, in core glTF, which needs no decoder; moved as the view wants it. */
import type { Request } from './api';

/** A member of the output that lets the model move, and its value: a clip, or weights for the wind. */
export interface Motion { member: string; value: string }

export const moved = (output: Request['output'], motion: Motion): Request['output'] => ({ ...output, [motion.member]: motion.value });

export function for_view(request: Request, motion: Motion | null): Request {
  const { lods: _, profile: __, ...output } = request.output ?? {};
  const still = { ...output, format: 'glb' };
  return { ...request, output: motion ? moved(still, motion) ?? still : still };
}
