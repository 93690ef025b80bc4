#pragma once
/// Roof surfaces before they become solids. Internal header of roof*.cpp.
#include <optional>

#include "core/geom/polygon/roof.h"
#include "core/geom/polygon/straight_skeleton.h"

namespace seedmesh {

/// Planar faces over a whole plan.
struct RoofSurface {
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  struct Face {
    std::uint32_t edge = none;   ///< edge of the plan of the roof; none: horizontal
    double speed = 0;            ///< metres inwards for each metre up; 0: vertical
    glm::dvec2 direction{1, 0};  ///< direction of the edge
    std::vector<std::uint32_t> outline;
    std::vector<std::vector<std::uint32_t>> holes;
  };
  std::vector<glm::dvec3> point;  ///< x, y and height in z; first those of the plan
  std::vector<Face> faces;
};

/// The slopes of one stage of a roof, and the height that the stage rises.
struct RoofStage {
  std::vector<double> speed;  ///< metres inwards for each metre up, indexed by edge of the plan of the roof
  double rise = std::numeric_limits<double>::infinity();
};

/// The plan of a roof, or that plan offset outwards for an overhang.
struct RoofBase {
  Plan plan;
  /// For each edge of `plan`: the edge of the roof's plan that it comes from.
  std::vector<std::uint32_t> source;
  double height = 0;
};

/// Returns slopes by the straight skeleton, one stage after another. A horizontal face closes the opening that the last
/// stage leaves. The points of the plan are first moved at random by up to `jitter`, a share of the diagonal. The lower
/// border is not moved. If no valid skeleton is found, a second attempt moves the points by at least a millionth of the
/// diagonal; if that fails too, the result is nullopt.
std::optional<RoofSurface> sloped_surface(const RoofBase& base, const std::vector<RoofStage>& stages,
                                          double jitter, const Job& job);

/// Returns triangles from every edge to one point over the plan; `apex.z` is its height. Returns nullopt if an edge is
/// not visible from there or the plan has holes.
std::optional<RoofSurface> fan_surface(const RoofBase& base, const glm::dvec3& apex);

/// A sloped plane. It has the height 0 along the line through `at` in `direction`, and rises to the left of this line
/// with the slope `tangent`. Unless `is_bare`, vertical faces close it down to base.height.
struct RoofPlane {
  glm::dvec2 at{0}, direction{1, 0};
  double tangent = 0;
  std::uint32_t edge = 0;
  bool is_bare = false;
};
/// Makes the surface of a roof with one plane.
RoofSurface plane_surface(const RoofBase& base, const RoofPlane& plane);

/// Joins points nearer than `reach`, and removes faces that lose their area.
void weld(RoofSurface& surface, double reach, const Job& job);

/// Returns the rings of the plan, as points of the surface. Points that were welded away are left out.
std::vector<std::vector<std::uint32_t>> lower_rings(const RoofSurface& surface, const RoofBase& base);

/// Returns whether every edge of the body, or of the cover, belongs to exactly two triangles after coordinates are
/// rounded to float.
bool is_closed(const Roof& roof, bool is_cover, const Job& job);

/// Returns the height of the highest point.
double height_of(const RoofSurface& surface);

/// Returns the height at which the slope of a two-slope roof changes from `steep` to `flat`, which are tangents. This
/// height is `share` of the height of the roof; a share above 1 counts as 1. `depth` is the distance from the eave to
/// the innermost point of the plan.
double break_at(double share, double depth, double steep, double flat);

}  // namespace seedmesh
