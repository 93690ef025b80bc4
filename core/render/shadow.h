#pragma once
/// Shadows of the sun: a shadow map (Williams 1978) with percentage-closer filtering (Reeves and others 1987).
#include "core/render/scene.h"

namespace seedmesh::render {

/// Distances from the sun, as a square map that covers the whole model.
struct ShadowMap {
  Frame frame;  ///< towards the sun
  glm::dvec2 low{0};
  double step = 1;  ///< metres of a texel
  std::uint32_t size = 0;
  Array<float> depth;  ///< towards the sun; greater is nearer to it
  /// The least and the greatest depth in a square of `block` texels and up to `reach` texels beyond it.
  struct Range {
    float least, greatest;
  };
  static constexpr std::uint32_t block = 8;
  static constexpr float reach = 4;
  Array<Range> around;

  /// A position in the map: in texels, and towards the sun.
  struct Position {
    float x, y, depth;
  };
  /// Returns the position in the map of a point in the frame of the model.
  Position position_of(const glm::vec3& position) const {
    const auto form = [&position](const glm::vec4& row) {
      return (row.x * position.x + row.y * position.y) + (row.z * position.z + row.w);
    };
    return {form(lens.right), form(lens.down), form(lens.towards) + bias};
  }
  /// Whether something is nearer to the sun than a position, `dx` and `dy` texels beside it. Outside: false.
  bool is_dark(const Position& at, float dx, float dy) const {
    const float x = at.x + dx, y = at.y + dy;
    if (!(x >= 0 && y >= 0 && x < side && y < side)) return false;
    return depth[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)] > at.depth;
  }
  /// Returns 1 (light) or 0 (dark) where is_dark() has the same result for all offsets up to `reach`, and -1
  /// where that is not known.
  float common_light(const Position& at) const {
    if (!(at.x >= reach && at.y >= reach && at.x < side - reach && at.y < side - reach)) return -1;
    const Range& range =
        around[static_cast<std::size_t>(at.y) / block * blocks + static_cast<std::size_t>(at.x) / block];
    if (range.greatest <= at.depth) return 1;
    return range.least > at.depth ? 0.0F : -1.0F;
  }

  Lens lens;       ///< maps the frame of the model to texels and depth
  float bias = 0;  ///< metres towards the sun
  float side = 0;  ///< `size`
  std::size_t stride = 0, blocks = 0;
};

/// `sun` has axes towards the sun. Cost: about 50 ns a triangle and 1 ns a covered texel. Sheets that blend cast
/// no shadow, and sheets of one side none where they face away from the sun.
ShadowMap draw_shadows(const Scene& scene, const Frame& sun, std::uint32_t size, const Job& job);

}  // namespace seedmesh::render
