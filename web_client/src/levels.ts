/** What the viewer asks the server for besides the model itself: levels of detail, and which motions there are. */
import { Refusal, check, generate, type Request } from './api';
import { moved, type Motion } from './for_view';

/** The most that the service makes. */
const most_levels = 5;

/** A zip with as many levels as the model has. */
export async function levels_of(request: Request): Promise<ArrayBuffer> {
  for (let lods = most_levels; ; lods -= 1) {
    try {
      return (await generate({ ...request, output: { ...request.output, format: 'zip', lods } })).bytes;
    } catch (error) {
      if (!(error instanceof Refusal) || lods <= 2) throw error;
    }
  }
}

/** Which of the motions the generator can make, as far as its word about a request goes. */
export async function motions_of(request: Request, motions: Motion[]): Promise<Motion[]> {
  const can = await Promise.all(motions.map(async (motion) => {
    try {
      await check({ ...request, output: moved(request.output, motion) ?? {} });
      return true;
    } catch (error) {
      return error instanceof Refusal && !error.faults.some((fault) => fault.pointer.startsWith('/output'));
    }
  }));
  return motions.filter((_, index) => can[index]);
}
