#pragma once
/// The footprints of buildings and of their parts; used by map_buildings.cpp.
#include <vector>

#include "core/geom/polygon/plan.h"
#include "core/import/map_data.h"

namespace seedmesh {

struct MapConversion;

/// A footprint of a feature, with the building whose part it is.
struct MapBody {
  enum class Role { none, outline, part };
  const MapFeature* feature = nullptr;
  const MapFeature* outline = nullptr;  ///< for a part: the building around it
  Plan plan;
  Role role = Role::none;
  bool is_hidden = false;  ///< its parts replace it
};

/// Returns the footprints of all buildings and parts as plans without defects. Sets `is_building` for each feature that
/// is one, even if it is left out.
std::vector<MapBody> map_bodies(MapConversion& map, const MapData& data, std::vector<bool>& is_building);

}  // namespace seedmesh
