#pragma once
/// Roofs that are the lowest of several planes at every point of a plan; used by massing.cpp.
#include <glm/vec2.hpp>
#include <vector>

#include "core/geom/polygon/massing.h"
#include "core/geom/polygon/massing_cut.h"

namespace seedmesh {

/// The share of the width at which a saltbox roof has its ridge.
constexpr double saltbox_ridge = 0.35;

struct Envelope {
  struct Plane {
    glm::dvec2 rise{0};  ///< metres of height for each metre along x and y
    double height = 0;   ///< height at the origin of the plan
    double at(const glm::dvec2& p) const { return height + rise.x * p.x + rise.y * p.y; }
  };
  std::vector<Plane> planes;
  std::vector<PlanLine> cuts;  ///< lines along which the lowest plane changes

  std::size_t lowest(const glm::dvec2& p) const;  ///< the number of the lowest plane
  double height(const glm::dvec2& p) const { return planes[lowest(p)].at(p); }
};

/// Returns one level plane.
Envelope level_envelope();

/// Returns the roof over the rectangle around the plan: skillion, gabled, half-hipped, gambrel, saltbox or round.
Envelope envelope_of(const Plan& plan, const MassOptions& options);

/// Returns four slopes from the sides of the rectangle around the plan, with the height of the options.
Envelope hipped_envelope(const Plan& plan, const MassOptions& options);

/// Returns the width of the plan across the ridge, or down the slope of a skillion roof.
double width_across(const Plan& plan, const MassOptions& options);

}  // namespace seedmesh
