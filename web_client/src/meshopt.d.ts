/** The package declares types only for its WebAssembly decoder. */
declare module '*/meshopt_decoder_reference.js' {
  export const MeshoptDecoder: { decodeGltfBufferAsync(count: number, stride: number, source: Uint8Array, mode: string, filter?: string): Promise<Uint8Array> };
}
