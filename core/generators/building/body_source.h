#pragma once
/// The geometry of drawn shapes: boxes, solids, assets of the request and built-in parts.
#include <array>
#include <map>
#include <span>
#include <tuple>

#include "core/generators/building/bodies.h"
#include "core/generators/building/body_surface.h"

namespace seedmesh::building {

/// A shape that is drawn.
struct DrawnBody {
  std::uint32_t shape = 0;
  std::uint16_t layer = 0;
  std::int32_t material = 0;
};

/// Returns a size in metres as whole micrometres. Bodies whose rounded sizes are equal count as equal.
std::array<std::int64_t, 3> rounded(const glm::dvec3& size);

class BodySource {
 public:
  BodySource(const Shapes& shapes, MaterialTable& materials, std::span<Asset> assets, Job& job)
      : shapes_(shapes), materials_(materials), assets_(assets), job_(job) {}

  const Shape& shape_of(const DrawnBody& body) const { return shapes_.shapes[body.shape]; }
  /// Whether a shape is an asset of the request. Its form does not depend on the size, unlike that of a built-in part.
  bool is_own(const Shape& shape) const { return is_asset(shape) && !is_part(shape); }
  bool is_asset(const Shape& shape) const { return (shape.geometry & asset_bit) != 0; }
  bool is_part(const Shape& shape) const {
    return is_asset(shape) && assets_[shape.geometry & ~asset_bit].row != nullptr;
  }
  /// Returns the asset of a shape. A built-in part is made for the size of the scope, once for equal sizes.
  Asset& asset_of(const Shape& shape);
  /// Fills the surface of a body that is no asset, in the frame of its scope.
  void fill(const Shape& shape, BodySurface& surface);
  /// Returns the numbers of triangles, vertices and primitives of a body.
  BodyCost cost_of(const Shape& shape);

 private:
  const Shapes& shapes_;
  MaterialTable& materials_;
  std::span<Asset> assets_;
  Job& job_;
  SurfaceBuilder surfaces_{&job_};
  /// By row, options, size, current colour and current material.
  std::map<
      std::tuple<std::uint32_t, std::uint32_t, std::array<std::int64_t, 3>, std::uint32_t, std::uint32_t>,
      Asset>
      parts_;
};

}  // namespace seedmesh::building
