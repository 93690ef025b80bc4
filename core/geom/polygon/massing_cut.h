#pragma once
/// A triangulated plan that is cut by lines, so that a height that is linear between the lines is exact on it.
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/geom/polygon/plan.h"

namespace seedmesh {

/// All points p with dot(normal, p) = offset. The normal is a unit vector.
struct PlanLine {
  glm::dvec2 normal{1, 0};
  double offset = 0;
};

class CutPlan {
 public:
  /// The points of the plan come first, in the order of its rings.
  CutPlan(const Plan& plan, const Job& job);

  /// Cuts every triangle that the line crosses. Neighbours share the new points. Points nearer than a millionth
  /// of the diagonal count as points of the line.
  void cut(const PlanLine& line, const Job& job);

  const std::vector<glm::dvec2>& points() const { return point_; }
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangle_; }

  /// Returns the point that follows each point along the border, counter-clockwise around the inside; the point itself
  /// for points inside.
  std::vector<std::uint32_t> next_on_border() const;

 private:
  double slack_;
  std::vector<glm::dvec2> point_;
  std::vector<std::array<std::uint32_t, 3>> triangle_;
};

}  // namespace seedmesh
