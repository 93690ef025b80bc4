#pragma once
/// Reads the JSON of Overpass.
#include <string_view>

#include "core/import/import.h"

namespace seedmesh {

/// Returns the scene of a map that Overpass wrote as JSON.
Result<Imported> import_osm_json(std::string_view text, const ImportOptions& options);

}  // namespace seedmesh
