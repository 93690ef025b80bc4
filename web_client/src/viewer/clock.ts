/** Synchronises with the GPU for time measurements. WebGL commands run after the calls that issue them have returned. */
import type { WebGLRenderer } from 'three';

const pixel = new Uint8Array(4);

/** Waits until the frame is finished: reading a pixel forces the GPU to complete it. */
export function wait_for(renderer: WebGLRenderer): void {
  const context = renderer.getContext();
  context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, pixel);
}
