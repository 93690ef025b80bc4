#pragma once
/// The input that all parts of graft() read.
#include <vector>

#include "core/geom/plant/chains.h"
#include "core/geom/plant/graft/ring_shape.h"

namespace seedmesh {

/// How a limb is joined to its parent, in the order of preference.
enum class JoinMode : std::uint8_t {
  full,      ///< welded to its parent, with side limbs welded to it
  detached,  ///< a closed end at its parent, with side limbs welded to it
  closed,    ///< a closed tube; its side limbs are closed where they begin
  none       ///< left to skin()
};

/// Refers to objects of the caller and owns only the tables. Limbs have the indices of Chains::head.
struct GraftInput {
  GraftInput(const Limbs& the_limbs, const Chains& the_chains, const Scale& the_scale,
             const GraftOptions& the_options, const std::vector<JoinMode>& modes);

  const Limbs& limbs;
  const Chains& chains;
  const Scale& scale;
  const GraftOptions& options;
  const std::vector<JoinMode>& join;  ///< join of each limb; changes from round to round
  RingTables rings;
  std::vector<std::uint32_t> first_child;   ///< first limb that begins at each joint
  std::vector<std::uint32_t> next_sibling;  ///< next limb that begins at the same joint, for each limb

  std::uint64_t key_of(std::uint32_t joint) const { return limbs.key.empty() ? joint : limbs.key[joint]; }
};

/// Returns the limb that each limb grows from, or Limbs::none.
std::vector<std::uint32_t> parent_limbs(const GraftInput& in);

}  // namespace seedmesh
