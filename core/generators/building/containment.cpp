#include "core/generators/building/containment.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::building {
namespace {

// The share of the largest size of the predecessor by which a shape may leave its scope: errors of rounding.
constexpr double rounding_share = 1e-6;

struct Excess {
  double distance = 0;  ///< metres beyond the scope
  int axis = 0;         ///< of the scope, along which the shape leaves it farthest
};

/// Adds the point p, in the frame of a scope from 0 to `size`.
void include(Excess& excess, const glm::dvec3& p, const glm::dvec3& size) {
  for (int axis = 0; axis < 3; ++axis) {
    const double distance = std::max(-p[axis], p[axis] - size[axis]);
    if (distance > excess.distance) excess = {distance, axis};
  }
}

/// How far the shape reaches beyond the scope of `outer`.
Excess excess_of(const Derivation& d, const ShapeState& outer, const ShapeState& shape) {
  const glm::dmat3 back = glm::transpose(d.out.axes[outer.axes]);
  const glm::dvec3 origin = back * (shape.origin - outer.origin);
  const glm::dmat3 axes = back * d.out.axes[shape.axes];
  Excess excess;
  if (shape.has_solid()) {
    for (const glm::dvec3& p : d.out.solid_of(shape.geometry).points)
      include(excess, origin + axes * (p * shape.size), outer.size);
    return excess;
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(corner & 1U, corner >> 1U & 1U, corner >> 2U);
    include(excess, origin + axes * (p * shape.size), outer.size);
  }
  return excess;
}

std::string rounded_text(double metres) { return text_of_number(std::round(metres * 1e6) / 1e6); }

}  // namespace

void check_containment(Derivation& d, std::uint32_t predecessor, const ShapeState& shape,
                       std::uint32_t offset) {
  const bool is_restricted = d.task.stays_inside;
  if (!is_restricted && (d.task.is_blueprint || d.grammar.is_cityengine)) return;
  const ShapeState& outer = d.out.shapes[predecessor];
  if (!is_restricted && dimension(outer.size) < 3) return;
  const Excess excess = excess_of(d, outer, shape);
  const double largest = std::max({outer.size.x, outer.size.y, outer.size.z});
  if (excess.distance <= largest * rounding_share) return;
  constexpr const char* names[] = {"x", "y", "z"};
  const std::string& name = d.grammar.symbols[d.out.shapes[predecessor].symbol].name;
  const std::string message = "this shape leaves the scope of `" + name + "` by " +
                              rounded_text(excess.distance) + " m along " + names[excess.axis] +
                              ", where the scope has " + rounded_text(outer.size[excess.axis]) + " m";
  if (!is_restricted) return warn(d, offset, message);
  d.job.refuse(issue_in_rules(d.task, IssueKind::evaluation, offset,
                              message + "; `restrict` is split, so it has to stay within the scope"));
}

}  // namespace seedmesh::building
