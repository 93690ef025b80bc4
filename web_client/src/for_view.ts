/** The request as the page draws it: one level without the bodies that an engine collides with, for the web or in core glTF, since other profiles mean other programs; moved as the view wants it. */
import type { Fault, Request } from './api';
import type { Schema } from './form/schema';

/** A member of the output that lets the model move, its value, and how a menu calls it: a clip, or weights by which the page lets it sway. */
export interface Motion { member: string; value: string; label: string }

/** What the schema of the output marks as motions. */
export const motions_in = (output: Schema): Motion[] => Object.entries(output.properties ?? {})
  .filter(([, schema]) => schema['x-widget'] === 'motion' || schema['x-widget'] === 'wind-weights')
  .flatMap(([member, schema]) => (schema.enum ?? []).map(String).filter((value) => value !== schema.default)
    .map((value) => ({ member, value, label: schema['x-widget'] === 'wind-weights' ? 'Wind' : value.replace(/^./, (first) => first.toUpperCase()) })));

export const moved = (output: Request['output'], motion: Motion): Request['output'] => ({ ...output, [motion.member]: motion.value });

export const is_output = (fault: Fault): boolean => /^\/output(\/|$)/.test(fault.pointer);

/** The formats that a generator has besides, as far as its parameters allow. */
export const own_formats = (schema: Schema, { parameters }: Request): string[] => (schema['x-formats'] ?? []).filter((format) =>
  Object.entries(schema['x-formats-where']?.[format] ?? {}).every(([name, value]) => (parameters[name] ?? schema.properties?.[name]?.default) === value));

/** The schema of the output with the formats alone that the generator has, and what the request asks for. */
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
