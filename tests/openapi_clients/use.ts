// Calls of both generated clients. Prints what the test compares.
import createClient from 'openapi-fetch';
import type { paths } from './made/api';
import { client } from './made/hey/client.gen';
import { generate, getPreset, getPresetModel, listPresets } from './made/hey/sdk.gen';

declare const process: { env: Record<string, string> };
const baseUrl = process.env['SEEDMESH_URL']!;
const open = createClient<paths>({ baseUrl });
client.setConfig({ baseUrl: baseUrl as never });
const plant = { generator: 'lsystem', parameters: { axiom: 'FFF' } } as const;
const query = { seed: '3', 'output.textures': 64 } as const;

async function main(): Promise<void> {
  const model = await open.POST('/v1/generate', { body: plant, parseAs: 'arrayBuffer' });
  const preset = await open.GET('/v1/presets/{name}.{extension}', { params: { path: { name: 'oak', extension: 'glb' }, query }, parseAs: 'arrayBuffer' });
  const refused = await open.POST('/v1/validate', { body: { preset: 'oakk' } });
  const hey_model = await generate({ body: plant, parseAs: 'blob' });
  const hey_preset = await getPresetModel({ path: { name: 'oak', extension: 'glb' }, query, parseAs: 'blob' });
  const hey_refused = await generate({ body: { preset: 'oakk' } });
  const blob: Blob | undefined = hey_model.data;
  console.log(JSON.stringify({
    openapi_fetch: { model: (model.data as unknown as ArrayBuffer).byteLength, preset: (preset.data as unknown as ArrayBuffer).byteLength, pointer: refused.error?.errors?.[0]?.pointer },
    hey_api: { model: blob?.size, preset: (hey_preset.data as Blob).size, pointer: (hey_refused.error as { errors?: { pointer: string }[] }).errors?.[0]?.pointer },
    presets: (await listPresets()).data?.presets.length,
    generator: (await getPreset({ path: { name: 'oak' } })).data?.generator,
  }));
}

export async function does_not_compile(): Promise<void> {
  // @ts-expect-error no such parameter
  await open.POST('/v1/generate', { body: { generator: 'lsystem', parameters: { axioms: 'F' } } });
  // @ts-expect-error no such parameter
  await generate({ body: { generator: 'lsystem', parameters: { axioms: 'F' } } });
  // @ts-expect-error no such generator
  await generate({ body: { generator: 'trees' } });
}

void main();
