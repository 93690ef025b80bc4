/** Sun, sky, haze and shadows of the page of a world. */
import { CanvasTexture, Color, DirectionalLight, EquirectangularReflectionMapping, FogExp2, HemisphereLight, AgXToneMapping, PCFShadowMap, type PerspectiveCamera, type Scene, SRGBColorSpace, Vector3, type WebGLRenderer } from 'three';

const haze = new Color('#bfd3e4'), zenith = new Color('#5f93cc');
const sight = 38_000, scale_height = 7000; // metres: where haze hides most of the land at the ground, and over which the air thins
const to_sun = new Vector3(0.62, 0.62, 0.48).normalize();
const highest_shadows = 1500; // metres above the ground; from higher up shadows are smaller than a texel
const texels = 2048;

/** A sky that is pale at the horizon and below. */
function sky_texture(): CanvasTexture {
  const canvas = document.createElement('canvas');
  canvas.width = 4;
  canvas.height = 512;
  const pen = canvas.getContext('2d')!, fill = pen.createLinearGradient(0, 0, 0, canvas.height);
  for (const [at, share] of [[0, 0], [0.25, 0.2], [0.4, 0.55], [0.48, 0.92], [0.5, 1], [1, 1]] as const)
    fill.addColorStop(at, `#${zenith.clone().lerp(haze, share).getHexString()}`);
  pen.fillStyle = fill;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  const texture = new CanvasTexture(canvas);
  texture.mapping = EquirectangularReflectionMapping;
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

export class Daylight {
  private readonly sun = new DirectionalLight('#fff1dc', 4.4);
  private readonly fog = new FogExp2(haze, 0);
  private readonly ahead = new Vector3();

  constructor(scene: Scene, renderer: WebGLRenderer) {
    renderer.toneMapping = AgXToneMapping;
    renderer.toneMappingExposure = 0.9;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = PCFShadowMap;
    scene.background = sky_texture();
    scene.fog = this.fog;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(texels, texels);
    this.sun.shadow.camera.near = 1;
    scene.add(this.sun, this.sun.target, new HemisphereLight('#cfe2f6', '#7a7560', 1.6));
  }

  /** Shadows lie around what the camera sees nearest; haze thins with the height. */
  follow(camera: PerspectiveCamera, ground: number): void {
    const above = Math.max(2, camera.position.y - ground);
    this.fog.density = Math.exp(-Math.max(0, camera.position.y) / scale_height) / sight;
    const reach = Math.min(Math.max(2.2 * above, 140), 2400), { sun } = this, { shadow } = sun;
    sun.castShadow = above < highest_shadows;
    camera.getWorldDirection(this.ahead).setY(0);
    if (this.ahead.lengthSq() > 1e-6) this.ahead.normalize();
    const texel = 2 * reach / texels, step = 8 * texel, snap = (value: number): number => Math.round(value / step) * step;
    sun.target.position.set(snap(camera.position.x + 0.85 * reach * this.ahead.x), ground, snap(camera.position.z + 0.85 * reach * this.ahead.z));
    const away = Math.max(1500, 3 * reach);
    sun.position.copy(sun.target.position).addScaledVector(to_sun, away);
    sun.target.updateMatrixWorld();
    if (Math.abs(shadow.camera.right / reach - 1) > 0.02) {
      Object.assign(shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, far: 2 * away });
      shadow.camera.updateProjectionMatrix();
      shadow.normalBias = 1.5 * texel;
      shadow.bias = -texel / (2 * away); // a texel before the surface, so that shadows begin at the walls
    }
  }
}
