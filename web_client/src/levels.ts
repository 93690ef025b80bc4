/** Additional requests of the view: levels of detail, and the motions that a model supports. */
import { Refusal, check, generate, type Request } from './api';
import { moved, type Motion } from './for_view';

/** The largest number of levels that the server generates. */
const most_levels = 5;

/** Fetches a zip with all levels of the model. The server refuses more levels than a model has, so fewer are tried. */
export async function levels_of(request: Request): Promise<ArrayBuffer> {
  for (let lods = most_levels; ; lods -= 1) {
    try {
      return (await generate({ ...request, output: { ...request.output, format: 'zip', lods } })).bytes;
    } catch (error) {
      if (!(error instanceof Refusal) || lods <= 2) throw error;
    }
  }
}

/** Returns the motions that the generator supports for a request, as far as validation shows. */
export async function motions_of(request: Request, motions: Motion[]): Promise<Motion[]> {
  const can = await Promise.all(motions.map(async (motion) => {
    try {
      await check({ ...request, output: moved(request.output, motion) ?? {} });
      return true;
    } catch (error) {
      return error instanceof Refusal && !error.issues.some((issue) => issue.pointer.startsWith('/output'));
    }
  }));
  return motions.filter((_, index) => can[index]);
}
