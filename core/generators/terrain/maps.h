#pragma once
/// Fields as pictures: heights and masks in the encodings of engines, colours, normals and splat weights.
#include <vector>

#include "core/base/result.h"
#include "core/generators/form.h"
#include "core/generators/terrain/colors.h"
#include "core/generators/terrain/field.h"
#include "core/texture/png.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

enum class Encoding { grey8, grey16, rgb24, rgba32, raw_little, raw_big };

/// Numbers, row by row, as pixels; `low` becomes 0 and `high` the greatest value, what lies outside the
/// nearest of the two; nearest value, halves up.
struct Numbers {
  std::int32_t width = 0, depth = 0;
  Array<float> values;
  double low = 0, high = 1;
  bool flip = false;  ///< the last row first
};
Array<std::uint8_t> encoded(const Numbers& numbers, Encoding encoding, const Job& job);

/// Pictures of `side` by `side` pixels over the whole field; margin 0 or more.
texture::Picture color_picture(const Field& field, const Sites& sites, const Looks& looks, std::int32_t side,
                               const Job& job);
/// Tangent space of a ground that lies level: red east, green north, blue up (glTF 2.0, OpenGL's green).
texture::Picture normal_picture(const Field& field, const Sites& sites, std::int32_t side, const Job& job);
/// Rock, grass, sand and snow in red, green, blue and alpha, which sum to 255.
texture::Picture splat_picture(const Field& field, const Sites& sites, const Looks& looks, std::int32_t side,
                               const Job& job);

/// Ground that repeats without a seam.
enum class GroundKind { rock, grass, sand, snow };
texture::Picture ground_texture(GroundKind kind, std::int32_t side, Rng rng, const Job& job);

/// What keeps a form from holding what the parameters ask for; pointers relative to them, or to the whole
/// request where they begin with "/output/". Sizes of images are not known here.
std::vector<Issue> form_faults(const TerrainParams& params, const WantedForm& form);

/// What a form holds of a request without such faults: a whole file. Issues as above, and of images that
/// cannot be read or do not fit.
Result<Array<std::uint8_t>> map_file(const TerrainParams& params, const WantedForm& form, Job& job);

}  // namespace seedmesh::terrain
