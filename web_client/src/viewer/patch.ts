/**
 * Shader patches for the materials of a model: wind displacement by the weights of the file, and a dithered fade
 * between levels of detail. Both insert lines into the shader programs of three.js.
 */
import { Vector2, Vector3, type Material, type Texture, type WebGLProgramParametersWithUniforms } from 'three';

/**
 * Shared by all models. x: the phase of the wind loop in radians; y: the displacement of the treetop in metres; z:
 * the flutter of a leaf in metres.
 */
export const breeze = { value: new Vector3() };

/** The range of the dither threshold that is drawn; (0, 2) draws every pixel. */
export type Fade = { value: Vector2 };
export const whole = (): Fade => ({ value: new Vector2(0, 2) });

// Trunk, branches and leaves move separately (Sousa, GPU Gems 3, chapter 16). Every frequency is a whole number of
// periods per loop, so that the loop is seamless.
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
// Interleaved gradient noise (Jimenez 2014). The two levels use complementary ranges, so that every pixel is drawn
// once.
const fade_body = `
  float dot_of_fade = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  if (dot_of_fade < fade.x || dot_of_fade >= fade.y) discard;
`;

function inserted(source: string, head: string, before: string, body: string): string {
  if (!source.includes(before)) throw new Error(`The program has no ${before}`);
  return head + source.replace(before, `${body}\n${before}`);
}

/** The offset of a line's halo in clip space: one pixel to the right and one down. */
export const aside = { value: new Vector2(0.002, -0.002) };

/** Draws lines with an offset of one pixel. */
export function shift(lines: Material): void {
  lines.onBeforeCompile = (program: WebGLProgramParametersWithUniforms) => {
    program.uniforms['aside'] = aside;
    program.vertexShader = inserted(program.vertexShader, 'uniform vec2 aside;\n', '#include <logdepthbuf_vertex>', '  gl_Position.xy += aside * gl_Position.w;');
  };
  lines.customProgramCacheKey = () => 'aside';
}

/** How a replacement material cuts out pixels: by the `map` and `alphaTest` of the original. */
export type Cut = 'normals' | { squares: Texture };

function cut_out(program: WebGLProgramParametersWithUniforms, cut: Cut): void {
  if (cut === 'normals') {
    // The normal material of three.js supports neither maps nor alpha tests.
    program.fragmentShader = inserted(program.fragmentShader, 'uniform sampler2D map;\nuniform float alphaTest;\n', '#include <clipping_planes_fragment>',
      '  if (texture2D(map, vMapUv).a < alphaTest) discard;');
    return;
  }
  program.uniforms['squares'] = { value: cut.squares };
  program.fragmentShader = inserted(program.fragmentShader, 'uniform sampler2D squares;\n', '#include <specularmap_fragment>',
    '  diffuseColor.rgb = texture2D(squares, vMapUv).rgb;');
}

// The mean opacity of needles is below their cutoff. In the last levels of a mipmap, which are a few texels wide, they would
// therefore vanish, and conifers far away would be bare. The opacity of the last two levels rises, up to twice as high.
const far_body = `
#ifdef USE_MAP
  vec2 size_of_map = vec2(textureSize(map, 0)), along_x = dFdx(vMapUv) * size_of_map, along_y = dFdy(vMapUv) * size_of_map;
  float level_of_map = 0.5 * log2(max(max(dot(along_x, along_x), dot(along_y, along_y)), 1e-9));
  diffuseColor.a *= 1.0 + clamp(level_of_map - log2(max(size_of_map.x, size_of_map.y)) + 2.0, 0.0, 2.0) / 2.0;
#endif
`;

const patched = new WeakMap<Material, { key: string; fade: Fade | null }>();

/** Patches a material once with the requested features. */
export function patch(material: Material, sways: boolean, fade: Fade | null, cut: Cut | null = null): void {
  const is_cut_out = cut === null && material.alphaTest > 0;
  const key = `${sways ? 'sways' : ''} ${fade ? 'fades' : ''}${is_cut_out ? ' far' : ''}${cut ? ` cut ${cut === 'normals' ? cut : 'squares'}` : ''}`;
  const known = patched.get(material);
  if (key === ' ' || (known?.key === key && known.fade === fade)) return;
  patched.set(material, { key, fade });
  material.onBeforeCompile = (program: WebGLProgramParametersWithUniforms) => {
    if (sways) {
      program.uniforms['breeze'] = breeze;
      program.vertexShader = inserted(program.vertexShader, sway_head, '#include <project_vertex>', '  transformed += sway(transformed);');
    }
    if (cut) cut_out(program, cut);
    if (is_cut_out) program.fragmentShader = inserted(program.fragmentShader, '', '#include <alphatest_fragment>', far_body);
    if (fade) {
      program.uniforms['fade'] = fade;
      program.fragmentShader = inserted(program.fragmentShader, fade_head, '#include <clipping_planes_fragment>', fade_body);
    }
  };
  material.customProgramCacheKey = () => key;
  material.needsUpdate = true;
}
