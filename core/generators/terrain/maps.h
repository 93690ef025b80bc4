#pragma once
/// Images of fields: heights and masks in the encodings of engines, colours, normals and splat weights.
#include <vector>

#include "core/base/result.h"
#include "core/generators/api.h"
#include "core/generators/terrain/colors.h"
#include "core/generators/terrain/field.h"
#include "core/texture/png.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

enum class Encoding { grey8, grey16, rgb24, rgba32, raw_little, raw_big };

/// Encodes numbers, row by row, as pixels. `low` becomes 0 and `high` the largest value; other numbers are
/// clamped. Rounds to the nearest value, halves up.
struct Numbers {
  std::int32_t width = 0, depth = 0;
  Array<float> values;
  double low = 0, high = 1;
  bool flip = false;  ///< true: the last row comes first
};
Array<std::uint8_t> encoded(const Numbers& numbers, Encoding encoding, const Job& job);

/// The functions below return images of `side` by `side` pixels over the whole field; its margin may be 0 or more.
texture::Picture color_picture(const Field& field, const Sites& sites, const GroundColors& ground_colors,
                               std::int32_t side, const Job& job);
/// Normals in the tangent space of horizontal ground: red east, green north, blue up (glTF 2.0, OpenGL
/// convention for green).
texture::Picture normal_picture(const Field& field, const Sites& sites, std::int32_t side, const Job& job);
/// Weights of rock, grass, sand and snow in red, green, blue and alpha, which sum to 255.
texture::Picture splat_picture(const Field& field, const Sites& sites, const GroundColors& ground_colors,
                               std::int32_t side, const Job& job);

/// A ground texture that tiles seamlessly.
enum class GroundKind { rock, grass, sand, snow };
texture::Picture ground_texture(GroundKind kind, std::int32_t side, Rng rng, const Job& job);

/// Returns why a file format cannot represent the parameters. Pointers are relative to the parameters, or to
/// the whole request where they begin with "/output/". Sizes of images are unknown here.
std::vector<Issue> format_errors(const TerrainParams& params, const WantedFormat& form);

/// Returns the complete file for a request without such errors. Issues: as above, and unreadable or
/// unsuitable images.
Result<Array<std::uint8_t>> map_file(const TerrainParams& params, const WantedFormat& form, Job& job);

}  // namespace seedmesh::terrain
