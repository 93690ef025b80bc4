// A Menger sponge of level 3 by the peer, npm manifold-3d: a cube minus the square prisms of every level
// along the three axes, the usual CSG construction. Wall time, without start-up.
import Module from 'manifold-3d';

const kernel = await Module();
kernel.setup();
const { Manifold } = kernel;

function holes(rounds) {
  const prisms = [];
  for (let round = 1; round <= rounds; round += 1) {
    const side = 3 ** -round;
    for (let i = 0; i < 3 ** (round - 1); i += 1) {
      for (let j = 0; j < 3 ** (round - 1); j += 1) prisms.push([side, (3 * i + 1.5) * side - 0.5, (3 * j + 1.5) * side - 0.5]);
    }
  }
  return prisms;
}

function sponge(rounds) {
  const along_z = Manifold.union(holes(rounds).map(([side, x, y]) => Manifold.cube([side, side, 2], true).translate([x, y, 0])));
  const along_x = along_z.rotate([0, 90, 0]), along_y = along_z.rotate([90, 0, 0]);
  return Manifold.cube([1, 1, 1], true).subtract(along_z).subtract(along_x).subtract(along_y);
}

const seconds = [];
let triangles = 0;
for (let run = 0; run < 3; run += 1) {
  const start = performance.now();
  triangles = sponge(3).getMesh().numTri;
  seconds.push((performance.now() - start) / 1e3);
}
console.log(JSON.stringify({ name: 'Menger 3, 1 thread', package: 'manifold-3d', unit: 'triangles', amount: triangles, seconds: seconds.sort((a, b) => a - b)[1] }));
