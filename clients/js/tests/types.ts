// Compiled by the tests with the installed package: what has to compile, and what must not.
import { Client, type Model, type Request } from '@seedmesh/client';
import { load } from '@seedmesh/client/three';

const client = new Client('http://127.0.0.1:8080');

export async function compiles(): Promise<number> {
  const model: Model = await client.generate({ preset: 'oak' });
  await client.generate({ generator: 'tree', seed: '18446744073709551615', parameters: { '0Branches': 1, model: 'weber_penn' }, output: { lods: 2 } });
  await client.generate({ preset: 'oak', parameters: { anything: 1 } });
  await client.generate({ generator: 'scene', parameters: { layers: [{ model: { generator: 'tree', parameters: { model: 'sculpt' } } }] } });
  const word: string = (await client.derive({ generator: 'lsystem', parameters: { axiom: 'F' } })).string;
  const height: number = (await client.derive({ generator: 'tree' })).height;
  const request: Request = await client.preset('oak');
  if (request.generator === 'terrain') request.parameters?.algorithm satisfies string | undefined;
  (await load(client, { preset: 'oak' }, { on_progress: ({ share }) => share })).play_growth();
  return model.triangles + word.length + height;
}

export async function does_not_compile(): Promise<void> {
  // @ts-expect-error no such parameter
  await client.generate({ generator: 'lsystem', parameters: { axioms: 'F' } });
  // @ts-expect-error no such parameter of this generator
  await client.generate({ generator: 'tree', parameters: { axiom: 'F' } });
  // @ts-expect-error no such generator
  await client.generate({ generator: 'trees' });
  // @ts-expect-error no such member
  await client.generate({ preset: 'oak', sead: 3 });
  // @ts-expect-error no such option
  await client.generate({ preset: 'oak', output: { lod: 2 } });
  // @ts-expect-error neither generator nor preset
  await client.generate({ seed: 3 });
  // @ts-expect-error a number is expected
  await client.generate({ generator: 'lsystem', parameters: { iterations: '3' } });
  // @ts-expect-error no such parameter of a request inside a request
  await client.generate({ generator: 'scene', parameters: { layers: [{ model: { generator: 'tree', parameters: { axiom: 'F' } } }] } });
  // @ts-expect-error no such parameter
  await client.derive({ generator: 'lsystem', parameters: { axioms: 'F' } });
  // @ts-expect-error a tree has no word
  (await client.derive({ generator: 'tree' })).string;
}
