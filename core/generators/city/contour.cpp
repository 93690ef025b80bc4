// Marching squares: Lorensen and Cline, "Marching cubes", 1987, in the plane; lines are simplified after Douglas and
// Peucker, "Algorithms for the reduction of the number of points required to represent a digitized line", 1973.
#include <algorithm>
#include <array>
#include <map>

#include "core/base/math.h"
#include "core/generators/city/region.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double level = 0.5;
constexpr double tolerance = 100;  // cm

/// A lattice with one more column and row around the box, where the value counts as 0, so that contours close.
struct Lattice {
  dvec2 low{0};
  double step = 1;
  std::int32_t columns = 0, rows = 0;
  std::vector<std::uint8_t> inside;

  dvec2 position(std::int32_t x, std::int32_t y) const { return low + dvec2(x, y) * step; }
  bool at(std::int32_t x, std::int32_t y) const {
    return inside[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(x)] != 0;
  }
  bool is_rim(std::int32_t x, std::int32_t y) const {
    return x == 0 || y == 0 || x == columns - 1 || y == rows - 1;
  }
};

/// Ends of the sides of lattice squares: 2 n for the side east of lattice point n, 2 n + 1 for the side north of it.
using Side = std::int64_t;

class Contour {
 public:
  Contour(const ValueAt& value, const dvec2& low, const dvec2& high, Job& job) : value_(value) {
    const dvec2 size = high - low;
    lattice_.step = std::max(2.0, std::max(size.x, size.y) / 300);
    lattice_.low = low - dvec2(lattice_.step);
    lattice_.columns = math::to_int32(size.x / lattice_.step) + 4;
    lattice_.rows = math::to_int32(size.y / lattice_.step) + 4;
    for (std::int32_t y = 0; y < lattice_.rows; ++y) {
      job.check();
      for (std::int32_t x = 0; x < lattice_.columns; ++x)
        lattice_.inside.push_back(!lattice_.is_rim(x, y) && value_(lattice_.position(x, y)) >= level ? 1 : 0);
    }
  }

  Rings rings() {
    for (std::int32_t y = 0; y + 1 < lattice_.rows; ++y) {
      for (std::int32_t x = 0; x + 1 < lattice_.columns; ++x) add_square(x, y);
    }
    Rings all;
    while (!next_.empty()) {
      std::vector<dvec2> ring;
      const Side first = next_.begin()->first;
      for (Side side = first;;) {
        const auto at = next_.find(side);
        if (at == next_.end()) break;
        ring.push_back(position_of(side));
        side = at->second;
        next_.erase(at);
      }
      CmRing simple = simplified(ring);
      if (simple.size() >= 3) all.push_back(std::move(simple));
    }
    return all;
  }

 private:
  Side side_of(std::int32_t x, std::int32_t y, bool is_north) const {
    return 2 * (static_cast<Side>(y) * lattice_.columns + x) + (is_north ? 1 : 0);
  }

  /// Joins the sides of a square between the inside, which is to the left, and the outside.
  void add_square(std::int32_t x, std::int32_t y) {
    const std::array<bool, 4> in = {lattice_.at(x, y), lattice_.at(x + 1, y), lattice_.at(x + 1, y + 1),
                                    lattice_.at(x, y + 1)};
    const std::array<Side, 4> sides = {side_of(x, y, false), side_of(x + 1, y, true),
                                       side_of(x, y + 1, false), side_of(x, y, true)};
    // The contour enters where the inside ends in counter-clockwise order and leaves where it begins before that.
    for (std::size_t k = 0; k < 4; ++k) {
      if (!in[k] || in[(k + 1) % 4]) continue;
      std::size_t begin = k;
      while (in[(begin + 3) % 4]) begin = (begin + 3) % 4;
      next_[sides[k]] = sides[(begin + 3) % 4];
    }
  }

  dvec2 position_of(Side side) const {
    const auto n = static_cast<std::int32_t>(side / 2);
    const std::int32_t x = n % lattice_.columns, y = n / lattice_.columns;
    const std::int32_t x2 = side % 2 == 0 ? x + 1 : x, y2 = side % 2 == 0 ? y : y + 1;
    dvec2 in = lattice_.position(x, y), out = lattice_.position(x2, y2);
    if (!lattice_.at(x, y)) std::swap(in, out);
    if (lattice_.is_rim(x, y) || lattice_.is_rim(x2, y2)) return (in + out) * 50.0;
    for (int k = 0; k < 8; ++k) {
      const dvec2 middle = (in + out) / 2.0;
      (value_(middle) >= level ? in : out) = middle;
    }
    return (in + out) * 50.0;  // the middle, in centimetres
  }

  static CmRing simplified(const std::vector<dvec2>& ring) {
    std::vector<std::uint8_t> keeps(ring.size(), 0);
    const std::size_t half = ring.size() / 2;
    keeps[0] = keeps[half] = 1;
    keep_between(ring, 0, half, keeps);
    keep_between(ring, half, ring.size(), keeps);
    CmRing simple;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const CmPoint p = rounded_cm(ring[i]);
      if (keeps[i] != 0 && (simple.empty() || simple.back() != p)) simple.push_back(p);
    }
    while (simple.size() > 1 && simple.back() == simple.front()) simple.pop_back();
    return simple;
  }
  static void keep_between(const std::vector<dvec2>& ring, std::size_t first, std::size_t last,
                           std::vector<std::uint8_t>& keeps) {
    std::vector<std::pair<std::size_t, std::size_t>> open = {{first, last}};
    while (!open.empty()) {
      const auto [from, to] = open.back();
      open.pop_back();
      double worst = tolerance;
      std::size_t at = from;
      for (std::size_t i = from + 1; i < to; ++i) {
        const double off = distance_to_segment(ring[i], ring[from], ring[to % ring.size()]);
        if (off <= worst) continue;
        worst = off;
        at = i;
      }
      if (at == from) continue;
      keeps[at] = 1;
      open.emplace_back(from, at);
      open.emplace_back(at, to);
    }
  }

  const ValueAt& value_;
  Lattice lattice_;
  std::map<Side, Side> next_;
};

}  // namespace

Rings contour_of(const ValueAt& value, const glm::dvec2& low, const glm::dvec2& high, Job& job) {
  return Contour(value, low, high, job).rings();
}

}  // namespace seedmesh::city
