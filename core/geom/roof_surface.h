#pragma once
/// The surfaces that roofs are made of, before they become solids; only roof.cpp uses it.
#include <optional>

#include "core/geom/straight_skeleton.h"

namespace seedmesh {

/// Planar faces over a whole plan.
struct RoofSurface {
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  struct Face {
    std::uint32_t edge = none;   ///< of the plan that the roof is for; none: level
    double speed = 0;            ///< metres inwards for each metre up; 0: upright
    glm::dvec2 direction{1, 0};  ///< of the edge
    std::vector<std::uint32_t> outline;
    std::vector<std::vector<std::uint32_t>> holes;
  };
  std::vector<glm::dvec3> point;  ///< x, y and height in z; first those of the plan
  std::vector<Face> faces;
};

/// Slopes that begin at a height, up to the next stage.
struct RoofStage {
  std::vector<double> speed;  ///< by edge of the plan that the roof is for
  double rise = std::numeric_limits<double>::infinity();
};

/// A plan of a roof: itself, or moved outwards.
struct RoofBase {
  Plan plan;
  std::vector<std::uint32_t> source;  ///< edge of the plan that the roof is for, by edge
  double height = 0;
};

/// Slopes by the straight skeleton, stage after stage; what the last one leaves is level. None where the
/// skeleton is not sound.
std::optional<RoofSurface> sloped_surface(const RoofBase& base, const std::vector<RoofStage>& stages,
                                          const Job& job);

/// From every edge to one point over the plan; `apex.z` is its height. None where a side is not seen from
/// there, or the plan has holes.
std::optional<RoofSurface> fan_surface(const RoofBase& base, const glm::dvec3& apex);

/// One plane, at height 0 along `at` in `direction`, with `tangent` up to its left; and the upright faces
/// below it down to base.height (none where `is_bare`).
struct RoofPlane {
  glm::dvec2 at{0}, direction{1, 0};
  double tangent = 0;
  std::uint32_t edge = 0;
  bool is_bare = false;
};
RoofSurface plane_surface(const RoofBase& base, const RoofPlane& plane);

/// Makes points nearer than `reach` one; faces that lose their area go.
void weld(RoofSurface& surface, double reach);

double height_of(const RoofSurface& surface);

/// How high the steep slope of a two-slope roof goes so that the change lies at a share of the whole, over a
/// plan whose inmost point lies `way` inwards. `steep` and `flat` are tangents, `share` is cut at 1.
double break_at(double share, double way, double steep, double flat);

}  // namespace seedmesh
