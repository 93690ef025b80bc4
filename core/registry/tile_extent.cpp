#include "core/registry/tile_extent.h"

#include "core/generators/terrain/terrain.h"
#include "generated/params/terrain.h"

namespace seedmesh {

float tile_extent(const Generator& generator, const Generator::Params& params) {
  if (generator.name != "terrain") return 0;
  return terrain::tile_extent(*static_cast<const TerrainParams*>(params.get()));
}

}  // namespace seedmesh
