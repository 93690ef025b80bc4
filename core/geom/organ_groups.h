#pragma once
/// Organs by their looks: what of them becomes one mesh.
#include <cstdint>
#include <vector>

#include "core/geom/organs.h"

namespace seedmesh {

/// Organs of one surface and colour, in their order.
struct OrganGroup {
  std::uint32_t surface;
  std::int16_t color;
  std::vector<std::uint32_t> organs;
};

/// By surface and colour, both rising, without what place_organs() passes over. 5 ns an organ.
std::vector<OrganGroup> organ_groups(const Organs& organs, const FoliageOptions& options, const Job& job);

}  // namespace seedmesh
