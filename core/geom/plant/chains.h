#pragma once
/// Limbs as chains of joints: which joint continues which, where limbs begin, and which internodes coincide.
#include "core/geom/plant/limbs.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Lengths below which a part of the model cannot be distinguished from a point. Readers of a file weld
/// vertices at 1e-6 of its diagonal; vertices of skin() keep a multiple of that distance.
struct Scale {
  Box box;             ///< box of all joints
  float size = 0;      ///< diagonal of the model with its bark, an upper bound
  float shortest = 0;  ///< an internode not longer than this is left out
  float thinnest = 0;  ///< a radius below this is a point
  float apart = 0;     ///< least distance of two vertices of a tube
};
/// Returns the scale of a skeleton whose tubes have this number of sides.
Scale scale_of(const Limbs& limbs, int sides);

/// Flags of a joint.
enum Mark : std::uint8_t {
  drawn_before = 1,  ///< its internode coincides with an earlier one and is not written
  revisit = 2,       ///< an earlier joint has the same position
  fork = 4,          ///< a side branch begins here
  straight_on = 8,   ///< the limb goes straight on and needs no ring here (SkinOptions::corners)
};

struct Chains {
  Array<std::uint32_t> next;  ///< the joint that continues the limb of this one, Limbs::none at its end
  Array<std::uint32_t> head;  ///< first joints: roots, and the first joint of each side branch; rising
  Array<std::uint8_t> mark;   ///< bits of Mark
};

/// Links the joints of every limb and finds internodes that coincide (same ends in either order, same radii).
/// The first of them stays, and what grows from a later one grows from the first. Linear time; 20 to 40 bytes
/// a joint while it runs, 9 to 13 for the result.
Chains find_chains(const Limbs& limbs, const Scale& scale, Job& job);

/// Returns, for each joint, the first joint that it coincides with, or the joint itself.
Array<std::uint32_t> originals_of(const Limbs& limbs, const Scale& scale, Job& job);

/// find_chains() without the search for internodes that coincide; a tenth of the time.
Chains link_chains(const Limbs& limbs, Job& job);

}  // namespace seedmesh
