#pragma once
/// Fields from images inside a request, and base64 decoding.
#include <string_view>

#include "core/base/result.h"
#include "core/generators/terrain/field.h"

namespace seedmesh {
struct TerrainImage;
}

namespace seedmesh::terrain {

/// Decodes base64 (RFC 4648 section 4, padding optional). If the text is a data URL, only the part after its
/// head is decoded. An issue with an empty pointer names the first invalid character.
Result<Array<std::uint8_t>> bytes_of_base64(std::string_view text, const Job& job);

/// Returns the heights of an image, with its voids filled and counted. Issues point below "/image". `cell` stays 1.
Result<Field> field_of_image(const TerrainImage& image, const Job& job);

}  // namespace seedmesh::terrain
