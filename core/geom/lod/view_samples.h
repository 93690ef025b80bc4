#pragma once
/// Views of a plant from several directions, for finding out which parts cover which texels.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Orthographic views of a box from a half circle of directions, most of them slightly from above; the other
/// half would show the same outlines. Views are `across` texels wide and high, which fits the diagonal of the
/// box.
class ViewSamples {
 public:
  static constexpr int across = 384;
  static constexpr std::size_t texels = std::size_t{across} * across;

  ViewSamples(const Box& box, int views);

  int views() const { return static_cast<int>(views_.size()); }
  double texels_a_metre() const { return scale_; }

  /// Returns the position of a point in a view, in texels.
  glm::dvec2 at(int view, const glm::vec3& point) const {
    const glm::dvec3 off = glm::dvec3(point) - middle_;
    const View& from = views_[static_cast<std::size_t>(view)];
    return {0.5 * across + scale_ * glm::dot(off, from.right),
            0.5 * across + scale_ * glm::dot(off, from.up)};
  }

  /// Returns the texel at a position in a view, or `texels` where it is outside.
  static std::size_t texel(const glm::dvec2& at) {
    if (!(at.x >= 0 && at.y >= 0 && at.x < across && at.y < across)) return texels;
    return static_cast<std::size_t>(at.y) * across + static_cast<std::size_t>(at.x);
  }

  /// Calls put(texel) for each texel whose centre is inside the triangle.
  template <class Put>
  static void fill(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const Put& put) {
    const int low = first(std::min({a.y, b.y, c.y})), high = first(std::max({a.y, b.y, c.y}));
    for (int y = low; y < high; ++y) {
      const double middle = y + 0.5;
      double left = across, right = 0;
      const auto cross = [&](const glm::dvec2& from, const glm::dvec2& to) {
        if ((from.y <= middle) == (to.y <= middle)) return;
        const double x = from.x + (middle - from.y) * (to.x - from.x) / (to.y - from.y);
        left = std::min(left, x);
        right = std::max(right, x);
      };
      cross(a, b);
      cross(b, c);
      cross(c, a);
      for (int x = first(left), end = first(right); x < end; ++x)
        put(static_cast<std::size_t>(y) * across + static_cast<std::size_t>(x));
    }
  }

 private:
  struct View {
    glm::dvec3 right, up;
  };
  /// Returns the first texel whose centre is not below `low`.
  static int first(double low) {
    return static_cast<int>(std::ceil(std::clamp(low - 0.5, 0.0, static_cast<double>(across))));
  }

  std::vector<View> views_;
  glm::dvec3 middle_{0};
  double scale_ = 1;
};

}  // namespace seedmesh
