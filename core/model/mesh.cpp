#include "core/model/mesh.h"

#include <algorithm>

#include "core/base/wide.h"

namespace seedmesh {

std::size_t Mesh::elements() const {
  if (packed) return packed->elements;
  const std::size_t corners = index.size() ? index.size() : position.size();
  switch (topology) {
    case Topology::triangles:
      return corners / 3;
    case Topology::lines:
      return corners / 2;
    case Topology::points:
      return corners;
  }
  return 0;
}

std::uint64_t Mesh::bytes() const {
  if (packed) return packed->bytes;
  std::uint64_t sum = position.bytes() + normal.bytes() + color.bytes() + tangent.bytes() + joints.bytes() +
                      weights.bytes() + 4 * bone.bytes() + next_position.bytes() + index.wide.bytes() +
                      index.small.bytes();
  for (const auto& set : uv) sum += set.bytes();
  return sum;
}

namespace {

// Coordinates in one row: a multiple of 8 for vectors of up to 256 bits, and of 3 for whole points.
constexpr std::size_t row = 24;

/// Updates the minimum and maximum of each column over whole rows of coordinates; returns the number of rows.
SEEDMESH_WIDE std::size_t take_rows(const float* at, std::size_t count, float* __restrict low,
                                    float* __restrict high) {
  std::size_t rows = 0;
  for (; row * (rows + 1) <= count; ++rows, at += row) {
    for (std::size_t k = 0; k < row; ++k) {
      low[k] = at[k] < low[k] ? at[k] : low[k];
      high[k] = high[k] < at[k] ? at[k] : high[k];
    }
  }
  return rows;
}

}  // namespace

Box bounds_of(std::span<const glm::vec3> position) {
  if (position.empty()) return {};
  float low[row], high[row];
  for (std::size_t k = 0; k < row; ++k) low[k] = high[k] = position[0][static_cast<int>(k % 3)];
  const std::size_t rows = take_rows(&position[0].x, 3 * position.size(), low, high);
  Box box{position[0], position[0]};
  for (std::size_t k = 0; k < row; k += 3) {
    box.min = glm::min(box.min, glm::vec3(low[k], low[k + 1], low[k + 2]));
    box.max = glm::max(box.max, glm::vec3(high[k], high[k + 1], high[k + 2]));
  }
  for (const glm::vec3& p : position.subspan(rows * row / 3)) {
    box.min = glm::min(box.min, p);
    box.max = glm::max(box.max, p);
  }
  return box;
}

Box bounds_of(const Mesh& mesh) {
  return mesh.packed ? mesh.packed->bounds : bounds_of(mesh.position.span());
}

}  // namespace seedmesh
