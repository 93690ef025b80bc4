#pragma once
/// Fields from images inside a request.
#include "core/base/result.h"
#include "core/generators/terrain/field.h"

namespace seedmesh {
struct TerrainImage;
}

namespace seedmesh::terrain {

/// Returns the heights of an image, with its voids filled and counted. Issues point below "/image". `cell` stays 1.
Result<Field> field_of_image(const TerrainImage& image, const Job& job);

}  // namespace seedmesh::terrain
