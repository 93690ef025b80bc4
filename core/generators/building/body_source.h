#pragma once
/// What the bodies of shapes are made of: boxes, solids, models of the request and built-in parts.
#include <array>
#include <map>
#include <span>
#include <tuple>

#include "core/generators/building/bodies.h"
#include "core/generators/building/patch.h"

namespace seedmesh::building {

/// A shape that is drawn.
struct DrawnBody {
  std::uint32_t shape = 0;
  std::uint16_t layer = 0;
  std::int32_t material = 0;
};

/// Metres in micrometres: bodies equal to that are one.
std::array<std::int64_t, 3> rounded(const glm::dvec3& size);

class BodySource {
 public:
  BodySource(const Shapes& shapes, Looks& looks, std::span<Asset> assets, Job& job)
      : shapes_(shapes), looks_(looks), assets_(assets), job_(job) {}

  const Shape& shape_of(const DrawnBody& body) const { return shapes_.shapes[body.shape]; }
  /// The request's own models keep their form.
  bool is_own(const Shape& shape) const { return is_asset(shape) && !is_part(shape); }
  bool is_asset(const Shape& shape) const { return (shape.geometry & asset_bit) != 0; }
  bool is_part(const Shape& shape) const {
    return is_asset(shape) && assets_[shape.geometry & ~asset_bit].row != nullptr;
  }
  /// A built-in part is made for the size of the scope, and once for equal ones.
  Asset& asset_of(const Shape& shape);
  /// The body in the frame of its scope; no asset.
  void fill(const Shape& shape, Patch& patch);
  BodyCost cost_of(const Shape& shape);

 private:
  const Shapes& shapes_;
  Looks& looks_;
  std::span<Asset> assets_;
  Job& job_;
  PatchMaker patches_;
  /// By the row, the options, the size and the colour in force.
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::array<std::int64_t, 3>, double>, Asset> parts_;
};

}  // namespace seedmesh::building
