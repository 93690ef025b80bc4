// Trees by the peer, npm @dgreenheck/ez-tree: CPU time of generate() and of writing a GLB without textures,
// without start-up. Its presets are compared with ours of similar triangle count.
import { stand_in_for_browser } from './peer_support.mjs';

stand_in_for_browser();
const { Tree } = await import('@dgreenheck/ez-tree');
const { MeshStandardMaterial } = await import('three');
const { GLTFExporter } = await import('three/examples/jsm/exporters/GLTFExporter.js');

/** The preset of ours that a row is compared with -> theirs. */
const pairs = { oak: 'Oak Large', birch: 'Aspen Large', proctree_0: 'Oak Small', spruce: 'Pine Large', quaking_aspen: 'Ash Large',
  black_oak: 'Oak Large', black_tupelo: 'Ash Large', weeping_willow: 'Ash Medium', proctree_3: 'Ash Small', '20,000 triangles': 'Ash Medium' };

const seconds_of = async (work) => {
  const start = process.cpuUsage();
  await work();
  const { user, system } = process.cpuUsage(start);
  return (user + system) / 1e6;
};

for (const [ours, theirs] of Object.entries(pairs)) {
  const runs = [];
  let triangles = 0;
  for (let round = 0; round < 7; round += 1) {
    const tree = new Tree();
    tree.loadPreset(theirs);
    runs.push(await seconds_of(async () => {
      tree.generate();
      triangles = 0;
      tree.traverse((part) => {
        if (!part.isMesh) return;
        part.material = new MeshStandardMaterial();
        triangles += part.geometry.index.count / 3;
      });
      await new GLTFExporter().parseAsync(tree, { binary: true });
    }));
  }
  const seconds = runs.slice(1).sort((a, b) => a - b)[3];
  console.log(JSON.stringify({ name: `tree to GLB: ${ours}`, package: `ez-tree (${theirs})`, unit: 'triangles', amount: triangles, seconds }));
}
