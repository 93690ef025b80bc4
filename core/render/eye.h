#pragma once
/// Projection of vertices to the image of a camera or to the map of the sun. For core/render only.
#include <algorithm>

#include "core/render/camera.h"

namespace seedmesh::render {

constexpr std::int32_t fixed_bits = 4;
constexpr std::int32_t fixed_one = 1 << fixed_bits;  ///< a sample in fixed-point numbers

/// A vertex in the image: fixed-point numbers, and a depth that is linear in the image; greater is nearer.
struct Projected {
  std::int32_t x = 0, y = 0;
  float depth = 0;
};

/// Returns a position in samples as a fixed-point number. It is clamped to a range outside of every image, so that
/// products of two differences fit 64 bits.
inline std::int32_t fixed(float samples) {
  constexpr float farthest = 1 << 20;
  const float at = std::clamp(samples, -farthest, farthest) * fixed_one + 0.5F;
  const auto whole = static_cast<std::int32_t>(at);
  return whole - (static_cast<float>(whole) > at ? 1 : 0);
}

/// Maps the positions of one mesh to samples. Each row is a linear form of x, y, z and 1.
struct Lens {
  glm::vec4 right{0}, down{0}, towards{0};
  glm::vec2 middle{0};          ///< the vanishing point, in samples
  bool is_perspective = false;  ///< `towards` is the distance from the eye, and `depth` its reciprocal

  Projected operator()(const glm::vec3& p) const {
    const auto form = [&p](const glm::vec4& row) {
      return (row.x * p.x + row.y * p.y) + (row.z * p.z + row.w);
    };
    const float x = form(right), y = form(down), along = form(towards);
    if (!is_perspective) return {fixed(x), fixed(y), along};
    const float near = 1 / std::max(along, 1e-9F);
    return {fixed(middle.x + x * near), fixed(middle.y + y * near), near};
  }
};

/// A camera with a square image, or parallel light with a square map.
class Eye {
 public:
  Eye(const Camera& camera, std::uint32_t size);
  /// The sample at (0, 0) shows `low` along the first two axes of the frame; `step` is the side of a sample.
  Eye(const Frame& frame, const glm::dvec2& low, double step, std::uint32_t size);

  Lens lens_at(const glm::mat4& at) const;
  std::uint32_t size() const { return size_; }
  bool is_perspective() const { return is_perspective_; }

 private:
  glm::dvec4 right_{0}, down_{0}, towards_{0};
  bool is_perspective_;
  std::uint32_t size_;
};

}  // namespace seedmesh::render
