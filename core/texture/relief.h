#pragma once
/// Reliefs, the results of the painters, and the images that are made of a relief.
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "core/model/model.h"
#include "core/texture/field.h"

namespace seedmesh::texture {

/// The result of a painter; all values are from 0 to 1.
struct Relief {
  Field height;  ///< 0 lowest
  Field tone;    ///< 0 the dark colour, 0.5 the main one, 1 the light one
  Field accent;  ///< the share of the accent colour; a field of size 1 if there is none
  Field cover;   ///< alpha; a field of size 1 if the image has no gaps
};

/// A row of a relief that a painter writes; `accent` is null where there is none.
struct ReliefRow {
  float *height, *tone, *accent;
};

enum class Accent { none, painted };

/// A relief without gaps. `paint(begin, end, row_at)` writes the rows [begin, end), which row_at(y) returns; ranges run
/// in parallel.
using PaintRows = std::function<void(int begin, int end, const std::function<ReliefRow(int y)>& row_at)>;
Relief paint_rows(int size, Accent accent, const Job& job, const PaintRows& paint);

/// Returns the nearest number from 0 to 1.
inline float clamp_share(float x) {
  const float from = x < 0 ? 0 : x;
  return from > 1 ? 1 : from;
}

/// Colours in sRGB, 0 .. 1.
struct Ramp {
  glm::vec3 dark{0}, main{0.5F}, light{1}, accent{0};
};

/// How a relief becomes images.
struct Finish {
  Ramp ramp;
  float depth = 0.02F;     ///< depth from height 0 to 1, as a share of the width of the image
  float rough_low = 0.9F;  ///< roughness at height 0
  float rough_high = 0.8F;
  float rough_accent = 0.9F;
  float shade = 0.6F;     ///< the occlusion at height 0, as a share
  bool is_grey = false;   ///< the colour image has one channel, red
  bool is_small = false;  ///< smaller files: coarser values
};

/// Three PNG files. An image that was not requested is null.
/// - Colour: RGB, RGBA with the cover as alpha, or grey.
/// - Normals: RGB, in the tangent space of glTF.
/// - Occlusion, roughness and metallic: RGB, as glTF packs them; metallic is 0.
struct Maps {
  std::shared_ptr<const Image> color, normal, surface;
  std::size_t bytes() const { return bytes_of(color) + bytes_of(normal) + bytes_of(surface); }

 private:
  static std::size_t bytes_of(const std::shared_ptr<const Image>& image) {
    return image ? image->bytes.size() + bytes_of(image->webp) : 0;
  }
};

/// The images that are made beside the colour.
struct MapParts {
  bool normal = true, surface = true;
};

/// Returns the width and height of the third image (occlusion, roughness, metallic) if the others have `size`.
/// It is half of `size`, because more detail would not be visible; for a `size` below 32 it is `size`.
constexpr int surface_size(int size) { return size < 32 ? size : size / 2; }

/// Makes the images of a relief. Their names begin with `name`.
Maps make_maps(const Relief& relief, const Finish& finish, const std::string& name, MapParts parts,
               const Job& job);

}  // namespace seedmesh::texture
