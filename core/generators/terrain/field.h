#pragma once
/// Heights on a square grid, and where that grid lies in a world of tiles.
///
/// Rows run from north (-Z) to south (+Z), samples of a row from west (-X) to east (+X); row 0, sample 0 is
/// the north-western corner. Heights are metres. Around the samples that are asked for lies a margin of
/// samples that belong to the neighbours, so that normals and filters at a border see what the neighbour
/// sees.
#include <cstdint>

#include "core/base/array.h"

namespace seedmesh::terrain {

struct Field {
  std::int32_t width = 0, depth = 0;  ///< samples from west to east and from north to south, without margin
  std::int32_t margin = 0;
  double cell = 1;  ///< metres between samples
  Array<float> heights;

  Field() = default;
  Field(const Job& job, std::int32_t wide, std::int32_t deep, std::int32_t around)
      : width(wide),
        depth(deep),
        margin(around),
        heights(job,
                static_cast<std::size_t>(wide + 2 * around) * static_cast<std::size_t>(deep + 2 * around)) {}

  std::int32_t stride() const { return width + 2 * margin; }
  std::int32_t rows() const { return depth + 2 * margin; }
  std::size_t place(std::int32_t x, std::int32_t z) const {
    return static_cast<std::size_t>(z + margin) * static_cast<std::size_t>(stride()) +
           static_cast<std::size_t>(x + margin);
  }
  float& at(std::int32_t x, std::int32_t z) { return heights[place(x, z)]; }
  float at(std::int32_t x, std::int32_t z) const { return heights[place(x, z)]; }
  float* row(std::int32_t z) { return heights.data() + place(0, z); }
  const float* row(std::int32_t z) const { return heights.data() + place(0, z); }
};

/// Samples [x, x + width) by [z, z + depth) of a world that is counted at the finest level; for a field that
/// is no tile, a world of its own.
struct Window {
  std::int64_t x = 0, z = 0;
  std::int32_t width = 0, depth = 0;
};

struct Range {
  float low = 0, high = 0;
};

/// Lowest and highest height, margin left out.
Range range_of(const Field& field, const Job& job);

/// The same heights with a smaller margin.
Field cropped(Field field, std::int32_t margin, const Job& job);

/// `side` samples from west to east on the same ground, as many as fit from north to south, by Catmull-Rom
/// splines in both directions; samples that lie on old ones keep their heights. Margin 0 in and out.
Field resampled(const Field& field, std::int32_t side, const Job& job);

}  // namespace seedmesh::terrain
