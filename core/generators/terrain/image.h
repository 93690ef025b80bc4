#pragma once
/// Fields from pictures that come inside a request, and base64 to carry them.
#include <string_view>

#include "core/base/result.h"
#include "core/generators/terrain/field.h"

namespace seedmesh {
struct TerrainImage;
}

namespace seedmesh::terrain {

/// The bytes of base64 (RFC 4648 section 4, with or without the padding at its end), after the head of a data
/// URL where there is one. An Issue with an empty pointer names the first character that is none of it.
Result<Array<std::uint8_t>> bytes_of_base64(std::string_view text, const Job& job);

/// The heights of a picture. Issues point below "/image". `cell` is left at 1.
Result<Field> field_of_image(const TerrainImage& image, const Job& job);

}  // namespace seedmesh::terrain
