#pragma once
/// Positions of the samples of a field in a model.
#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// The centre of the field is at the origin; texture coordinates 0..1 start in the north-west. Does not own
/// the field.
struct Ground {
  explicit Ground(const Field& given)
      : field(given),
        west(-(given.width - 1) / 2.0 * given.cell),
        north(-(given.depth - 1) / 2.0 * given.cell) {}
  float x(std::int32_t i) const { return static_cast<float>(west + i * field.cell); }
  float z(std::int32_t j) const { return static_cast<float>(north + j * field.cell); }
  float u(std::int32_t i) const { return static_cast<float>(static_cast<double>(i) / (field.width - 1)); }
  float v(std::int32_t j) const { return static_cast<float>(static_cast<double>(j) / (field.depth - 1)); }

  const Field& field;
  double west, north;
};

}  // namespace seedmesh::terrain
