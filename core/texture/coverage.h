#pragma once
/// How much of each texel a polygon covers.
#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

namespace seedmesh::texture {

/// Pixels [x0, x1) x [y0, y1).
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// The exact coverage of texels by a polygon: every edge adds, in each row, the signed area to its right, and
/// a running sum along the row gives the coverage. The outline is closed and may turn in either direction; its corners
/// are in texels. Parts of the polygon outside of the window do not count.
class Coverage {
 public:
  Coverage(const std::vector<glm::dvec2>& outline, const Window& window) : window_(window) {
    change_.resize(static_cast<std::size_t>(window.width() + 2) *
                   static_cast<std::size_t>(window.y1 - window.y0));
    for (std::size_t i = 0; i < outline.size(); ++i) add(outline[i], outline[(i + 1) % outline.size()]);
  }

  /// Writes the coverage of the row y, 0 to 1, to `out`, which has an element for each texel of the window.
  void read(int y, std::vector<float>& out) const {
    double sum = 0;
    const double* change = change_.data() + row(y);
    for (int x = 0; x < window_.width(); ++x) {
      sum += change[x];
      out[static_cast<std::size_t>(x)] = static_cast<float>(std::min(1.0, std::abs(sum)));
    }
  }

 private:
  std::size_t row(int y) const {
    return static_cast<std::size_t>(y - window_.y0) * static_cast<std::size_t>(window_.width() + 2);
  }

  void add(glm::dvec2 a, glm::dvec2 b) {
    if (a.y == b.y) return;
    const double sign = a.y < b.y ? 1 : -1;
    if (a.y > b.y) std::swap(a, b);
    const double slope = (b.x - a.x) / (b.y - a.y);
    const int first = std::max(window_.y0, static_cast<int>(std::floor(a.y)));
    const int last = std::min(window_.y1 - 1, static_cast<int>(std::floor(b.y)));
    for (int y = first; y <= last; ++y) {
      const double top = std::max<double>(a.y, y), bottom = std::min<double>(b.y, y + 1.0);
      if (bottom <= top) continue;
      add_piece(y, a.x + (top - a.y) * slope, a.x + (bottom - a.y) * slope, sign * (bottom - top));
    }
  }

  /// A piece of an edge inside one row, from x `from` to `to`, of signed height `height`: spread over the
  /// texels that it crosses.
  void add_piece(int y, double from, double to, double height) {
    double* change = change_.data() + row(y);
    const double low = std::clamp<double>(std::min(from, to) - window_.x0, 0, window_.width());
    const double high = std::clamp<double>(std::max(from, to) - window_.x0, 0, window_.width());
    const int first = static_cast<int>(low), last = static_cast<int>(high);
    if (first == last) {
      const double right = 1 - (0.5 * (low + high) - first);
      change[first] += height * right;
      change[first + 1] += height * (1 - right);
      return;
    }
    const double by_x = height / (high - low);
    for (int x = first; x <= last; ++x) {
      const double l = std::max<double>(low, x), r = std::min<double>(high, x + 1.0);
      const double share = (r - l) * by_x, right = 1 - (0.5 * (l + r) - x);
      change[x] += share * right;
      change[x + 1] += share * (1 - right);
    }
  }

  Window window_;
  std::vector<double> change_;
};

}  // namespace seedmesh::texture
