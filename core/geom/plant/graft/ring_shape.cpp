#include "core/geom/plant/graft/ring_shape.h"

#include "core/base/quick_math.h"
#include "core/geom/mesh/vec3x4.h"

namespace seedmesh {
namespace {

constexpr int common_corners = 64;

std::vector<UnitCircle> circles_up_to(int most) {
  std::vector<UnitCircle> circles(static_cast<std::size_t>(most) + 1);
  for (int sides = 3; sides <= most; ++sides) {
    UnitCircle& circle = circles[static_cast<std::size_t>(sides)];
    for (int i = 0; i < sides; ++i) {
      const math::SinCos at = math::quick_sincos(2 * math::pi * i / sides);
      circle.x.push_back(static_cast<float>(at.cos));
      circle.y.push_back(static_cast<float>(at.sin));
    }
    for (std::size_t i = 0; i <= Vec3x4::size; ++i) {
      circle.x.push_back(circle.x[i]);
      circle.y.push_back(circle.y[i]);
    }
  }
  return circles;
}

}  // namespace

float thickest_base(const Limbs& limbs) {
  float thickest = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] != Limbs::none) thickest = std::max(thickest, limbs.base_radius[i]);
  }
  return thickest;
}

RingTables ring_tables(const Limbs& limbs, const GraftOptions& options) {
  static const std::vector<UnitCircle> common = circles_up_to(common_corners);
  RingTables tables;
  // The planner uses half a side of a ring, which is a side of a ring of twice as many corners.
  const int most = 2 * std::max(least_opened_corners, ribbed_corners(options, options.sides));
  if (most > common_corners) tables.own_circles = circles_up_to(most);
  tables.circles = most > common_corners ? tables.own_circles.data() : common.data();
  const float thickest = thickest_base(limbs);
  for (int corners = 4; corners <= options.sides; ++corners) {
    const double share = math::pow((corners - 0.5) / options.sides, 1 / options.corner_exponent);
    tables.corner_radius.push_back(thickest * static_cast<float>(share));
  }
  return tables;
}

int corners_by_table(const RingTables& tables, const GraftOptions& options, float radius) {
  int wanted = 3;
  for (const float least : tables.corner_radius) wanted += radius >= least ? 1 : 0;  // few, and they rise
  return paired_corners(wanted, options.sides);
}

}  // namespace seedmesh
