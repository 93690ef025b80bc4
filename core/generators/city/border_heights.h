#pragma once
/// Heights of ground between the heights of its border.
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace seedmesh::city {

/// A point of the border of a ground in metres, and its height.
struct BorderPoint {
  glm::dvec2 at{0};
  double height = 0;
};

/// Points of a border, with the boxes of runs of consecutive points. Runs too far away to matter are skipped, with the
/// same results.
class BorderHeights {
 public:
  BorderHeights() = default;
  explicit BorderHeights(std::vector<BorderPoint> points);

  std::span<const BorderPoint> points() const { return points_; }

  /// Returns the height at one of the points if no slope to another point exceeds the limit: its own, or the mean of
  /// the greatest lower bound and the least upper bound.
  double limited(const BorderPoint& point) const;

  /// Returns the height at a position where the ground would be at `natural` without a border. Where the border itself
  /// is too steep, the lower points decide.
  double at(const glm::dvec2& position, double natural) const;

 private:
  struct Stretch {
    glm::dvec2 low{0}, high{0};
    double least = 0, most = 0;        ///< heights
    std::size_t first = 0, count = 0;  ///< points
  };
  std::span<const BorderPoint> points_of(const Stretch& stretch) const {
    return points().subspan(stretch.first, stretch.count);
  }
  static double squared_distance(const Stretch& stretch, const glm::dvec2& position);
  double highest_below(const glm::dvec2& position) const;

  std::vector<BorderPoint> points_;
  std::vector<Stretch> stretches_;
};

}  // namespace seedmesh::city
