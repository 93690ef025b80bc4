#include "core/geom/plant/graft/graft_input.h"

namespace seedmesh {

GraftInput::GraftInput(const Limbs& the_limbs, const Chains& the_chains, const Scale& the_scale,
                       const GraftOptions& the_options, const std::vector<JoinMode>& modes)
    : limbs(the_limbs),
      chains(the_chains),
      scale(the_scale),
      options(the_options),
      join(modes),
      rings(ring_tables(the_limbs, the_options)),
      first_child(the_limbs.size(), Limbs::none),
      next_sibling(the_chains.head.size(), Limbs::none) {
  for (std::size_t i = chains.head.size(); i-- > 0;) {
    const std::uint32_t parent = limbs.parent[chains.head[i]];
    if (parent == Limbs::none) continue;
    next_sibling[i] = first_child[parent];
    first_child[parent] = static_cast<std::uint32_t>(i);
  }
}

std::vector<std::uint32_t> parent_limbs(const GraftInput& in) {
  std::vector<std::uint32_t> limb_of(in.limbs.size(), Limbs::none),
      parents(in.chains.head.size(), Limbs::none);
  for (std::uint32_t i = 0; i < parents.size(); ++i) {
    for (std::uint32_t joint = in.chains.head[i]; joint != Limbs::none; joint = in.chains.next[joint])
      limb_of[joint] = i;
    const std::uint32_t from = in.limbs.parent[in.chains.head[i]];
    if (from != Limbs::none) parents[i] = limb_of[from];
  }
  return parents;
}

}  // namespace seedmesh
