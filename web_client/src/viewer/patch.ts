/**
 * What the materials of a model can do besides: sway in the wind by the weights that a file carries, and fade from one
 * level of detail to the next by dots. Both are some lines in three's own programs.
 */
import { Vector2, Vector3, type Material, type Texture, type WebGLProgramParametersWithUniforms } from 'three';

/** x: the moment as an angle of a loop, y: how far the top of the model bends, in metres, z: how far a leaf flutters. Of all models. */
export const breeze = { value: new Vector3() };

/** Which part of the dots of a model is drawn, from and to; all at (0, 2). */
export type Fade = { value: Vector2 };
export const whole = (): Fade => ({ value: new Vector2(0, 2) });

// Trunk, branches and leaves as Sousa (GPU Gems 3, chapter 16) tells them apart. Every frequency is a whole number of
// turns a loop, so that the loop has no seam.
const sway_head = `
#ifndef USE_UV2
attribute vec2 uv2;
#endif
#ifndef USE_UV3
attribute vec2 uv3;
#endif
uniform vec3 breeze;
vec3 sway(vec3 at) {
  float phase = uv3.x * 6.2832;
  float lean = uv2.x * (0.65 + 0.25 * sin(breeze.x) + 0.1 * sin(breeze.x * 3.0));
  float swing = uv2.y * (0.5 * sin(breeze.x * 3.0 + phase) + 0.3 * sin(breeze.x * 5.0 + phase * 2.0));
  float flutter = uv3.y * sin(breeze.x * 23.0 + phase * 5.0 + dot(at, vec3(2.1, 1.7, 2.9)));
  return breeze.y * (lean * vec3(0.8, -0.12 * uv2.x, 0.5) + swing * vec3(0.3, 0.18, -0.25)) + breeze.z * flutter * vec3(0.5, 0.9, -0.5);
}
`;

const fade_head = `
uniform vec2 fade;
`;
// Noise without a pattern that the eye finds (Jimenez 2014); what one level leaves out the other draws.
const fade_body = `
  float dot_of_fade = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  if (dot_of_fade < fade.x || dot_of_fade >= fade.y) discard;
`;

function inserted(source: string, head: string, before: string, body: string): string {
  if (!source.includes(before)) throw new Error(`The program has no ${before}`);
  return head + source.replace(before, `${body}\n${before}`);
}

/** The step of a line's halo, in the coordinates of the screen: one pixel to the right and one down. */
export const aside = { value: new Vector2(0.002, -0.002) };

/** Draws lines a pixel aside of where they are. */
export function shift(lines: Material): void {
  lines.onBeforeCompile = (program: WebGLProgramParametersWithUniforms) => {
    program.uniforms['aside'] = aside;
    program.vertexShader = inserted(program.vertexShader, 'uniform vec2 aside;\n', '#include <logdepthbuf_vertex>', '  gl_Position.xy += aside * gl_Position.w;');
  };
  lines.customProgramCacheKey = () => 'aside';
}

/** What a material that stands in for another draws of it: only where its picture is, as `map` and `alphaTest` tell. */
export type Cut = 'normals' | { squares: Texture };

function cut_out(program: WebGLProgramParametersWithUniforms, cut: Cut): void {
  if (cut === 'normals') {
    // three's own program of normals knows no pictures.
    program.fragmentShader = inserted(program.fragmentShader, 'uniform sampler2D map;\nuniform float alphaTest;\n', '#include <clipping_planes_fragment>',
      '  if (texture2D(map, vMapUv).a < alphaTest) discard;');
    return;
  }
  program.uniforms['squares'] = { value: cut.squares };
  program.fragmentShader = inserted(program.fragmentShader, 'uniform sampler2D squares;\n', '#include <specularmap_fragment>',
    '  diffuseColor.rgb = texture2D(squares, vMapUv).rgb;');
}

const patched = new WeakMap<Material, { key: string; fade: Fade | null }>();

/** Adds what is asked for to a material, once. */
export function patch(material: Material, sways: boolean, fade: Fade | null, cut: Cut | null = null): void {
  const key = `${sways ? 'sways' : ''} ${fade ? 'fades' : ''}${cut ? ` cut ${cut === 'normals' ? cut : 'squares'}` : ''}`;
  const known = patched.get(material);
  if (key === ' ' || (known?.key === key && known.fade === fade)) return;
  patched.set(material, { key, fade });
  material.onBeforeCompile = (program: WebGLProgramParametersWithUniforms) => {
    if (sways) {
      program.uniforms['breeze'] = breeze;
      program.vertexShader = inserted(program.vertexShader, sway_head, '#include <project_vertex>', '  transformed += sway(transformed);');
    }
    if (cut) cut_out(program, cut);
    if (fade) {
      program.uniforms['fade'] = fade;
      program.fragmentShader = inserted(program.fragmentShader, fade_head, '#include <clipping_planes_fragment>', fade_body);
    }
  };
  material.customProgramCacheKey = () => key;
  material.needsUpdate = true;
}
