/**
 * A comparison of two models under one camera: the other model to the left of a divider, the current one to the
 * right.
 */
import { Vector2, type Object3D, type PerspectiveCamera, type Scene, type WebGLRenderer } from 'three';
import { Model } from './model';

export class Comparison {
  other: Model | null = null;
  /** The position of the divider, as a fraction of the width. */
  divider = 0.5;
  private turn = 0;

  /** Loads a GLB, or removes the other model if null. A result that a later call supersedes is disposed of. */
  async take(bytes: ArrayBuffer | null): Promise<void> {
    const turn = (this.turn += 1);
    const other = bytes ? await Model.from(bytes) : null;
    if (turn !== this.turn) {
      other?.dispose();
      return;
    }
    this.other?.dispose();
    this.other = other;
  }

  /** Renders the scene, or both halves if there is another model. `stage` is visible on both sides. */
  render(renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera, stage: Object3D): void {
    const { other } = this;
    if (!other) { renderer.render(scene, camera); return; }
    const size = renderer.getSize(new Vector2());
    const shown = scene.children.filter((child) => child !== stage && child.visible);
    renderer.setScissorTest(true);
    for (const side of ['other', 'own'] as const) {
      for (const child of shown) child.visible = side === 'own';
      if (side === 'other') scene.add(other.root);
      else other.root.removeFromParent();
      const from = side === 'other' ? 0 : this.divider * size.x;
      renderer.setScissor(from, 0, side === 'other' ? this.divider * size.x : size.x - from, size.y);
      renderer.shadowMap.needsUpdate = true;
      renderer.render(scene, camera);
    }
    renderer.setScissorTest(false);
  }
}
