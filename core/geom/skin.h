#pragma once
/// Limbs -> Mesh: tubes that follow limbs.
#include <vector>

#include "core/geom/limbs.h"
#include "core/model/mesh.h"

namespace seedmesh {

struct SkinOptions {
  int sides = 8;    ///< corners of a cross-section of the thickest limb, 3..64
  int stacks = 1;   ///< rings an internode is cut into, 1..16; only where the radius changes along it
  bool uv = true;
};

/// The bark of one colour index, as one mesh.
struct Bark {
  std::int16_t color = 0;
  Mesh mesh;
};

/// Skins every limb as one closed tube: rings are mitred at joints and turn without twist along the limb, both ends
/// are closed, u runs round the limb and v along it, both in metres, with one doubled seam. Triangles are counter-
/// clockwise outside and come in cache order. Internodes of no length are passed over; an internode that lies exactly
/// on another one (same ends, same radii) is skinned once; where a bend is so sharp that mitred rings would cross,
/// the limb is closed and a new tube starts. Guarantees: unit normals, no unused vertex, no triangle of zero area, no
/// triangle turned against its normals, no NaN.
/// In: limbs with finite positions and radii >= 0 (a radius of 0 makes a point). Out: one Bark for each colour index in
/// use, rising. Spends Resource::triangles before it allocates. Runs on job.threads(); the result does not depend on it.
std::vector<Bark> skin(const Limbs& limbs, const SkinOptions& options, Job& job);

/// The same skeleton as line segments (two vertices a segment, shared along limbs), one mesh for each colour index.
std::vector<Bark> wires(const Limbs& limbs, Job& job);

/// How many triangles `skin` would make, without making them; exact except for internodes drawn twice.
std::uint64_t skin_triangles(const Limbs& limbs, const SkinOptions& options);

}  // namespace seedmesh
