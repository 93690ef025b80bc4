/**
 * Leaves out what this page never asks of three.js, which would otherwise be a seventh of the first load: its renderer
 * and its glTF reader name everything that they can do, so that no bundler finds what is not needed. Whatever is
 * changed here is looked for by its text; a release of three.js in which it is not there does not build.
 */
import type { Plugin } from 'vite';

const sources = '/three/src/';
const file_of = (id: string): string => id.replaceAll('\\', '/').split(sources)[1] ?? '';

/** Chunks behind #ifdef words that no material of this page defines: its surfaces are those of core glTF. */
const unused_chunks = [
  'alphahash_fragment', 'alphahash_pars_fragment', 'batching_pars_vertex', 'batching_vertex', 'bumpmap_pars_fragment', 'clearcoat_normal_fragment_begin',
  'clearcoat_normal_fragment_maps', 'clearcoat_pars_fragment', 'clipping_planes_fragment', 'clipping_planes_pars_fragment', 'clipping_planes_pars_vertex',
  'clipping_planes_vertex', 'displacementmap_pars_vertex', 'displacementmap_vertex', 'dithering_fragment', 'dithering_pars_fragment', 'gradientmap_pars_fragment', 'iridescence_fragment', 'iridescence_pars_fragment',
  'lightmap_pars_fragment', 'lightprobes_pars_fragment', 'lights_lambert_fragment', 'lights_lambert_pars_fragment', 'lights_phong_fragment',
  'lights_phong_pars_fragment', 'lights_toon_fragment', 'lights_toon_pars_fragment', 'logdepthbuf_fragment', 'logdepthbuf_pars_fragment',
  'logdepthbuf_pars_vertex', 'logdepthbuf_vertex', 'transmission_fragment', 'transmission_pars_fragment',
];

/** Programs of materials and lights that the page has none of. */
const unused_programs = ['distance', 'equirect', 'linedashed', 'meshlambert', 'meshmatcap', 'meshphong', 'meshtoon', 'sprite', 'vsm'];

/** What stands in for a module: as much of it as the renderer touches when nobody uses it. */
const stand_ins: Record<string, string> = {
  'renderers/webxr/WebXRManager.js': `
    const nothing = () => {};
    export class WebXRManager {
      enabled = false; isPresenting = false; cameraAutoUpdate = false;
      addEventListener = nothing; removeEventListener = nothing; dispose = nothing; setAnimationLoop = nothing;
      getEnvironmentBlendMode = nothing; getDepthSensingMesh = () => null; hasDepthSensing = () => false;
    }`,
  'renderers/webxr/WebXRController.js': 'export class WebXRController {}',
  // Light from pictures of surroundings: the page lights by lamps.
  'extras/PMREMGenerator.js': 'export class PMREMGenerator {}',
};

/** Extensions of glTF that the service writes, or that its readers may meet. */
const kept_extensions = ['GLTFMeshGpuInstancing', 'GLTFMeshoptCompression', 'GLTFTextureWebPExtension'];

/** The text of a GLSL program without comments and idle spaces. Lines stay where they count: at # words. */
export function tight(glsl: string): string {
  return glsl
    .replaceAll(/\/\*[^]*?\*\//g, '').replaceAll(/\/\/.*$/gm, '')
    .split('\n').map((line) => line.trim()).filter((line) => line !== '')
    .map((line) => (line.startsWith('#') ? line.replaceAll(/\s+/g, ' ') : line.replaceAll(/\s*([-+*/=<>!&|?:,;(){}[\]])\s*/g, '$1').replaceAll(/\s+/g, ' ')))
    .join('\n');
}

function slim_shader(file: string, code: string): string {
  const name = file.replace(/^.*\//, '').replace('.glsl.js', '');
  const empty = file.includes('/ShaderLib/') ? unused_programs.includes(name) : unused_chunks.includes(name);
  return code.replaceAll(/`([^`]*)`/g, (_, glsl: string) => (empty ? '``' : `\`${tight(glsl)}\``));
}

function slim_reader(code: string): string {
  const left = new Set<string>();
  const slim = code.replaceAll(/this\.register\( function \( parser \) \{\s*return new (\w+)\( parser[^)]*\);\s*\} \);/g, (whole, name: string) => {
    if (kept_extensions.includes(name)) { left.add(name); return whole; }
    return '';
  });
  if (left.size !== kept_extensions.length || slim.length === code.length) throw new Error('GLTFLoader.js is not as slim_three.ts knows it');
  return slim;
}

export function slim_three(): Plugin {
  const met = new Set<string>();
  return {
    name: 'slim-three',
    enforce: 'pre',
    apply: 'build',
    resolveId(id, importer) { return id === 'three' ? this.resolve('three/src/Three.js', importer, { skipSelf: true }) : null; },
    load(id) {
      met.add(file_of(id));
      return stand_ins[file_of(id)] ?? null;
    },
    transform(code, id) {
      if (file_of(id).endsWith('.glsl.js')) return { code: slim_shader(file_of(id), code), map: null };
      if (id.endsWith('/loaders/GLTFLoader.js')) return { code: slim_reader(code), map: null };
      return null;
    },
    buildEnd(error) {
      if (error) return;
      const shaders = 'renderers/shaders/';
      const absent = [
        ...unused_chunks.map((name) => `${shaders}ShaderChunk/${name}.glsl.js`), ...unused_programs.map((name) => `${shaders}ShaderLib/${name}.glsl.js`), ...Object.keys(stand_ins),
      ].filter((file) => !met.has(file));
      if (absent.length > 0) this.error(`three.js has no ${absent.join(', ')} any more: look at slim_three.ts`);
    },
  };
}
