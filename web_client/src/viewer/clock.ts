/** How long a picture takes: a browser hands orders on and returns before they are carried out. */
import type { WebGLRenderer } from 'three';

const pixel = new Uint8Array(4);

/** Returns when the picture is finished: one of its pixels cannot be had before. */
export function wait_for(renderer: WebGLRenderer): void {
  const context = renderer.getContext();
  context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, pixel);
}
