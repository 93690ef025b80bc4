#pragma once
/// Heights on a square grid, and the position of the grid in a world of tiles.
///
/// Rows run from north (-Z) to south (+Z), samples of a row from west (-X) to east (+X); sample 0 of row 0 is
/// the north-west corner. Heights are in metres. A margin of samples of the neighbours surrounds the field,
/// so that normals and filters at a border agree with those of the neighbour.
#include <cstdint>
#include <vector>

#include "core/base/array.h"
#include "core/base/result.h"

namespace seedmesh::terrain {

struct Field {
  std::int32_t width = 0, depth = 0;  ///< samples west to east and north to south, without margin
  std::int32_t margin = 0;
  double cell = 1;  ///< metres between samples
  Array<float> heights;
  std::uint64_t voids = 0;     ///< number of samples without a height in the source; they were filled
  std::vector<Warning> notes;  ///< warnings about the source, with pointers into the parameters

  Field() = default;
  Field(const Job& job, std::int32_t wide, std::int32_t deep, std::int32_t around)
      : width(wide),
        depth(deep),
        margin(around),
        heights(job,
                static_cast<std::size_t>(wide + 2 * around) * static_cast<std::size_t>(deep + 2 * around)) {}

  std::int32_t stride() const { return width + 2 * margin; }
  std::int32_t rows() const { return depth + 2 * margin; }
  std::size_t index_of(std::int32_t x, std::int32_t z) const {
    return static_cast<std::size_t>(z + margin) * static_cast<std::size_t>(stride()) +
           static_cast<std::size_t>(x + margin);
  }
  float& at(std::int32_t x, std::int32_t z) { return heights[index_of(x, z)]; }
  float at(std::int32_t x, std::int32_t z) const { return heights[index_of(x, z)]; }
  float* row(std::int32_t z) { return heights.data() + index_of(0, z); }
  const float* row(std::int32_t z) const { return heights.data() + index_of(0, z); }
};

/// Samples [x, x + width) by [z, z + depth) of a world, in samples of the finest level of detail. Without
/// tiles, the world is the field itself.
struct Window {
  std::int64_t x = 0, z = 0;
  std::int32_t width = 0, depth = 0;
};

struct Range {
  float low = 0, high = 0;
};

/// Returns the lowest and highest height without the margin.
Range range_of(const Field& field, const Job& job);

/// Returns the same heights with a smaller margin.
Field cropped(Field field, std::int32_t margin, const Job& job);

/// Resamples the field to `side` samples from west to east and proportionally from north to south, by
/// Catmull-Rom splines. New samples at old positions keep their heights. Requires margin 0 and returns margin
/// 0.
Field resampled(const Field& field, std::int32_t side, const Job& job);

}  // namespace seedmesh::terrain
