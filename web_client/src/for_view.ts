/**
 * The request that the page draws: one level of detail, without collision bodies, as web or core glTF because other
 * profiles need other readers, with the motion chosen in the view.
 */
import type { Issue, Request } from './api';
import type { Schema } from './form/schema';

/**
 * An output member that adds motion, its value and its menu label. The motion is an animation clip or wind weights
 * that the page evaluates.
 */
export interface Motion { member: string; value: string; label: string }

/** Reads the motions from the schema of the output. */
export const motions_in = (output: Schema): Motion[] => Object.entries(output.properties ?? {})
  .filter(([, schema]) => schema['x-widget'] === 'motion' || schema['x-widget'] === 'wind-weights')
  .flatMap(([member, schema]) => (schema.enum ?? []).map(String).filter((value) => value !== schema.default)
    .map((value) => ({ member, value, label: schema['x-widget'] === 'wind-weights' ? 'Wind' : value.replace(/^./, (first) => first.toUpperCase()) })));

export const moved = (output: Request['output'], motion: Motion): Request['output'] => ({ ...output, [motion.member]: motion.value });

export const is_output = (issue: Issue): boolean => /^\/output(\/|$)/.test(issue.pointer);

/** The additional formats that a generator has with these parameters. */
export const own_formats = (schema: Schema, { parameters }: Request): string[] => (schema['x-formats'] ?? []).filter((format) =>
  Object.entries(schema['x-formats-where']?.[format] ?? {}).every(([name, value]) => (parameters[name] ?? schema.properties?.[name]?.default) === value));

/** The schema of the output, limited to the formats of the generator and the requested format. */
export function with_formats(output: Schema, formats: string[], request: Request): Schema {
  const { format, ...others } = output.properties ?? {};
  const can = (format?.enum ?? []).filter((each) => formats.includes(String(each)) || each === request.output?.['format']);
  return { ...output, properties: { format: { ...format, enum: can }, ...others } };
}

export function for_view(request: Request, motion: Motion | null): Request {
  const { lods: _, impostor: __, collision: ___, profile, instancing, ...output } = request.output ?? {};
  const is_web = profile === 'web';
  const still = {
    ...output, ...(is_web ? { profile } : {}), format: 'glb',
    ...(instancing === undefined || (instancing === 'gpu' && !is_web) ? {} : { instancing }),
  };
  return { ...request, output: motion ? moved(still, motion) ?? still : still };
}
