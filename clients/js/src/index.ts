export { Client, type ClientOptions, type CallOptions, type GenerateOptions, type Model, type Progress, type DerivationOf } from './client.js';
export { Busy, Refused, SeedmeshError } from './errors.js';
export { extension_of, permalink_path, picture_path, preset_path, sign_path, token_of, type Overrides, type PictureOptions } from './links.js';
export type * from './types.js';
