#pragma once
/// The order in which skin() walks a skeleton: which joint continues which, where limbs begin, and what lies
/// on top of what.
#include "core/geom/limbs.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Lengths below which a part of the model cannot be told from a point. Whoever welds a model's vertices does
/// so at a millionth of its diagonal; everything skin() makes keeps a multiple of that apart.
struct Scale {
  Box box;             ///< of all joints
  float size = 0;      ///< diagonal of the skinned model, rather too great
  float shortest = 0;  ///< an internode not longer than this is passed over
  float thinnest = 0;  ///< a radius below this is a point
  float apart = 0;     ///< least distance of two vertices of a tube
};
Scale scale_of(const Limbs& limbs, int sides);

/// What is known of a joint besides its limb; a set of bits.
enum Mark : std::uint8_t {
  drawn_before = 1,  ///< its internode lies on an earlier one and is not skinned
  revisit = 2,       ///< an earlier joint stands at the same place
  fork = 4,          ///< a side branch begins here
  straight_on = 8,   ///< the limb goes on from here as it came, and no ring is needed (SkinOptions::corners)
};

struct Chains {
  Array<std::uint32_t> next;  ///< the joint that continues the limb of this one, Limbs::none at its end
  Array<std::uint32_t> head;  ///< first joints: roots, and the first joint of each side branch; rising
  Array<std::uint8_t> mark;   ///< of Mark
};

/// Links every limb and finds internodes that lie on others (same ends in either direction, same radii): the
/// first stays. What grows from the later one grows from the first. Linear time; 20 to 40 bytes a joint while
/// it runs, 9 to 13 after.
Chains find_chains(const Limbs& limbs, const Scale& scale, Job& job);

/// Of each joint the one that it was drawn on top of, or itself.
Array<std::uint32_t> originals_of(const Limbs& limbs, const Scale& scale, Job& job);

/// find_chains() without looking for internodes drawn twice; a tenth of the work.
Chains link_chains(const Limbs& limbs, Job& job);

}  // namespace seedmesh
