/** The package tells types of its decoder in WebAssembly alone. */
declare module '*/meshopt_decoder_reference.js' {
  export const MeshoptDecoder: { decodeGltfBufferAsync(count: number, stride: number, source: Uint8Array, mode: string, filter?: string): Promise<Uint8Array> };
}
