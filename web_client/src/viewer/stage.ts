/** The surroundings of the model: light, the ground with its metric grid, and a person of 1.8 m for scale. */
import {
  Box3, CapsuleGeometry, Color, DirectionalLight, Group, HemisphereLight, Mesh, MeshBasicMaterial, PlaneGeometry,
  ShaderMaterial, ShadowMaterial, SphereGeometry, Vector3, type Material, type Texture,
} from 'three';
import { corners_of } from './frame';
import { sky_texture } from './sky';

/** The movable light: its direction in degrees, and whether it is on. */
export interface Sun { on: boolean; turn: number; height: number }

const grid_vertex = `
  varying vec2 ground;
  void main() {
    vec4 in_world = modelMatrix * vec4(position, 1.0);
    ground = in_world.xz;
    gl_Position = projectionMatrix * viewMatrix * in_world;
  }`;

// Lines about one pixel wide at any distance, every tenth one stronger, fading out towards the edge.
const grid_fragment = `
  uniform vec3 color;
  uniform float cell;
  uniform float reach;
  uniform vec2 centre;
  varying vec2 ground;
  float lines(float size) {
    vec2 at = ground / size;
    vec2 width = fwidth(at);
    vec2 near_line = abs(fract(at - 0.5) - 0.5) / max(width, vec2(1e-6));
    float line = 1.0 - min(min(near_line.x, near_line.y), 1.0);
    return line * (1.0 - smoothstep(0.2, 0.6, max(width.x, width.y)));
  }
  void main() {
    float fade = 1.0 - smoothstep(0.25, 1.0, length(ground - centre) / reach);
    float strength = max(0.35 * lines(cell), 0.75 * lines(cell * 10.0)) * fade;
    gl_FragColor = vec4(color, strength);
  }`;

/** Depth offset: terrain of a model at the same height is drawn in front of the grid. */
const behind = { polygonOffset: true, polygonOffsetFactor: 4, polygonOffsetUnits: 16 };

/** A person of 1.8 m, without shading, so that it does not distract. */
function person(material: Material): Group {
  const group = new Group();
  const limb = (radius: number, foot: [number, number], top: [number, number], depth: number): void => {
    const across = top[0] - foot[0], along = top[1] - foot[1];
    const mesh = new Mesh(new CapsuleGeometry(radius, Math.hypot(across, along) - 2 * radius, 8, 20), material);
    mesh.position.set((foot[0] + top[0]) / 2, (foot[1] + top[1]) / 2, 0);
    mesh.rotation.z = Math.atan2(-across, along);
    mesh.scale.z = depth;
    group.add(mesh);
  };
  const head = new Mesh(new SphereGeometry(0.115, 28, 20), material);
  head.position.y = 1.685;
  head.scale.set(0.8, 1, 0.9);
  group.add(head);
  limb(0.05, [0, 1.4], [0, 1.64], 1);
  limb(0.165, [0, 0.98], [0, 1.52], 0.62);
  limb(0.15, [0, 0.82], [0, 1.22], 0.66);
  for (const side of [-1, 1]) {
    limb(0.075, [side * 0.1, 0], [side * 0.085, 0.98], 0.95);
    limb(0.047, [side * 0.25, 0.76], [side * 0.165, 1.47], 0.95);
  }
  return group;
}

/**
 * True if a person is a useful scale for the model. Beside a model of a hundred metres a person is too small to see;
 * beside a knee-high shrub the person would dominate the view.
 */
const tells = (size: Vector3): boolean => size.y < 60 && (size.y > 1.2 || (size.y > 0.6 && Math.max(size.x, size.z) > 2.4));

export class Stage {
  readonly group = new Group();
  /** The side of a grid cell in metres, a power of ten. */
  cell = 1;
  /** The height of the ground. */
  floor = 0;
  private readonly sky = new HemisphereLight(0xffffff, 0x9a958a, 2.3);
  private readonly sun = new DirectionalLight(0xfff3e0, 3.1);
  private readonly rim = new DirectionalLight(0xdfeaff, 0.7);
  private readonly grid: Mesh<PlaneGeometry, ShaderMaterial>;
  private readonly shade: Mesh<PlaneGeometry, ShadowMaterial>;
  private readonly figure: Group;
  private readonly skin = new MeshBasicMaterial({ toneMapped: false });
  /** null until the user has chosen. */
  private wants_figure: boolean | null = null;
  private wants_grid = true;
  private light: Sun = { on: true, turn: 38, height: 51 };
  private background: Texture | null = null;
  private dark = false;
  private around = new Box3(new Vector3(-1, 0, -1), new Vector3(1, 2, 1));

  constructor(shadows: boolean) {
    const uniforms = { color: { value: new Color() }, cell: { value: 1 }, reach: { value: 10 }, centre: { value: new Vector3() } };
    this.grid = new Mesh(new PlaneGeometry(1, 1), new ShaderMaterial({
      uniforms, vertexShader: grid_vertex, fragmentShader: grid_fragment, transparent: true, depthWrite: false, ...behind,
    }));
    this.grid.rotation.x = -Math.PI / 2;
    this.shade = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial({ opacity: 0.22, depthWrite: false, ...behind }));
    this.shade.rotation.x = -Math.PI / 2;
    this.shade.receiveShadow = true;
    this.shade.visible = shadows;
    this.sun.castShadow = shadows;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 3;
    this.sun.shadow.bias = -0.0005;
    this.figure = person(this.skin);
    this.group.add(this.sky, this.sun, this.sun.target, this.rim, this.grid, this.shade, this.figure);
  }

  /** Places ground, light and person around a model. */
  surround(box: Box3): void {
    this.around.copy(box);
    const size = box.getSize(new Vector3());
    const centre = box.getCenter(new Vector3());
    const largest = Math.max(size.x, size.y, size.z, 1e-3);
    // Roots may extend below the ground. A drawing that extends far below it is placed on its lowest point instead.
    const floor = box.min.y < -0.2 * size.y ? box.min.y : 0;
    this.cell = 10 ** Math.round(Math.log10(largest / 4));
    const reach = largest * 3 + this.cell * 2;
    const uniforms = this.grid.material.uniforms;
    uniforms['cell']!.value = this.cell;
    uniforms['reach']!.value = reach;
    uniforms['centre']!.value = { x: centre.x, y: centre.z };
    for (const plane of [this.grid, this.shade]) {
      plane.scale.setScalar(reach * 2);
      plane.position.set(centre.x, floor, centre.z);
    }
    this.shade.position.y -= largest * 1e-4;
    this.figure.position.set(box.min.x - Math.max(0.5, size.x * 0.08), floor, centre.z);
    this.figure.visible = this.wants_figure ?? tells(size);

    this.floor = floor;
    this.sun.target.position.copy(centre);
    this.sun.position.copy(centre).addScaledVector(this.to_sun, largest * 2.8);
    this.rim.position.copy(centre).add(new Vector3(-0.7, 0.4, -0.9).multiplyScalar(largest));
    const camera = this.sun.shadow.camera;
    const half = size.length() * 0.75 + 1;
    Object.assign(camera, { left: -half, right: half, top: half, bottom: -half, near: largest * 0.05, far: largest * 6 + 4 });
    camera.updateProjectionMatrix();
  }

  /** Includes the person in the framed points if the model has a similar size. */
  sight(box: Box3): Vector3[] {
    const matters = this.figure.visible && (this.wants_figure === true || box.max.y - box.min.y < 12);
    return matters ? corners_of(new Box3().setFromObject(this.figure)) : [];
  }

  private get to_sun(): Vector3 {
    return new Vector3().setFromSphericalCoords(1, (90 - this.light.height) * Math.PI / 180, this.light.turn * Math.PI / 180);
  }

  set_sun(light: Sun): void {
    this.light = { ...light };
    this.sun.visible = light.on;
    this.set_theme(this.dark);
    this.surround(this.around);
    if (this.background) this.set_sky(true);
  }

  /** The colour of fog: that of the page behind the view. */
  get haze(): number { return this.dark ? 0x2a332e : 0xdde5e0; }

  set_light_color(color: string): void { this.sun.color.set(color); }

  set_shadow(on: boolean): void {
    this.sun.castShadow = on;
    this.shade.visible = on;
  }

  /** Shows the sky as the background; null shows the plain background of the page. */
  set_sky(on: boolean): Texture | null {
    this.background?.dispose();
    this.background = on ? sky_texture(this.to_sun, this.light.on) : null;
    return this.background;
  }

  /** Hides ground and person, for the thumbnail of another model. */
  set bare(bare: boolean) {
    this.grid.visible = bare ? false : this.wants_grid;
    if (bare) this.figure.visible = false;
  }

  get has_figure(): boolean { return this.figure.visible; }

  get sky_background(): Texture | null { return this.background; }

  set grid_visible(visible: boolean) { this.wants_grid = visible; this.grid.visible = visible; }

  show_figure(wanted: boolean, box: Box3): void {
    this.wants_figure = wanted;
    this.surround(box);
  }

  set_theme(dark: boolean): void {
    this.dark = dark;
    (this.grid.material.uniforms['color']!.value as Color).set(dark ? 0x8fa398 : 0x6d7f74);
    this.skin.color.set(dark ? 0x4d5d55 : 0x93a198);
    this.shade.material.opacity = dark ? 0.4 : 0.2;
    // With the sun off, the ambient light still shows the shape.
    this.sky.intensity = (dark ? 2.0 : 2.3) * (this.light.on ? 1 : 0.8);
  }
}
