/** Renders a thumbnail of another model with the page's own renderer, between two frames. */
import { PerspectiveCamera, Vector2, type Scene, type WebGLRenderer } from 'three';
import { place_camera, usual_direction } from './frame';
import type { Model } from './model';
import type { Stage } from './stage';

/** Takes ownership of the model and disposes of it. The caller frames the stage again afterwards. */
export function draw_portrait(renderer: WebGLRenderer, scene: Scene, stage: Stage, model: Model, width: number, height: number): HTMLCanvasElement {
  const picture = Object.assign(document.createElement('canvas'), { width, height });
  const camera = new PerspectiveCamera(32, width / height);
  place_camera(camera, model.points, usual_direction(model.box), 1);
  const hidden = scene.children.filter((child) => child !== stage.group && child.visible);
  for (const child of hidden) child.visible = false;
  scene.add(model.root);
  stage.surround(model.box);
  stage.bare = true;
  const size = renderer.getSize(new Vector2()), ratio = renderer.getPixelRatio();
  renderer.setPixelRatio(1);
  renderer.setSize(width, height, false);
  renderer.shadowMap.needsUpdate = true;
  renderer.render(scene, camera);
  picture.getContext('2d')?.drawImage(renderer.domElement, 0, 0);
  stage.bare = false;
  model.dispose();
  for (const child of hidden) child.visible = true;
  renderer.setPixelRatio(ratio);
  renderer.setSize(size.x, size.y, false);
  return picture;
}
