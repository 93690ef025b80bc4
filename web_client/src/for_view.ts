/** The request as the page draws it: one level, in core glTF, which needs no decoder; moved as the view wants it. */
import type { Request } from './api';

export function for_view(request: Request, motion: string | null): Request {
  const { lods: _, profile: __, ...output } = request.output ?? {};
  return { ...request, output: { ...output, format: 'glb', ...(motion === null ? {} : { animation: motion }) } };
}
