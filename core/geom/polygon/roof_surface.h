#pragma once
/// Roof surfaces before they become solids; for roof.cpp only.
#include <optional>

#include "core/geom/polygon/roof.h"
#include "core/geom/polygon/straight_skeleton.h"

namespace seedmesh {

/// Planar faces over a whole plan.
struct RoofSurface {
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  struct Face {
    std::uint32_t edge = none;   ///< of the plan of the roof; none: horizontal
    double speed = 0;            ///< metres inwards for each metre up; 0: vertical
    glm::dvec2 direction{1, 0};  ///< of the edge
    std::vector<std::uint32_t> outline;
    std::vector<std::vector<std::uint32_t>> holes;
  };
  std::vector<glm::dvec3> point;  ///< x, y and height in z; first those of the plan
  std::vector<Face> faces;
};

/// Slopes that begin at a height, up to the next stage.
struct RoofStage {
  std::vector<double> speed;  ///< by edge of the plan of the roof
  double rise = std::numeric_limits<double>::infinity();
};

/// The plan of a roof, or the same moved outwards.
struct RoofBase {
  Plan plan;
  std::vector<std::uint32_t> source;  ///< by edge: the edge of the plan of the roof
  double height = 0;
};

/// Slopes by the straight skeleton, one stage after another. The rest of the last stage is horizontal. `shake` is
/// a share of the diagonal by which the points of the plan are moved at random first; the lower border stays where
/// it is. None if the skeleton is not valid, even with its points moved by a millionth.
std::optional<RoofSurface> sloped_surface(const RoofBase& base, const std::vector<RoofStage>& stages,
                                          double shake, const Job& job);

/// Triangles from every edge to one point over the plan; `apex.z` is its height. None if an edge is not
/// visible from there or the plan has holes.
std::optional<RoofSurface> fan_surface(const RoofBase& base, const glm::dvec3& apex);

/// One plane at height 0 along the line through `at` in `direction`, which rises to its left by `tangent`;
/// and, unless `is_bare`, the vertical faces below it down to base.height.
struct RoofPlane {
  glm::dvec2 at{0}, direction{1, 0};
  double tangent = 0;
  std::uint32_t edge = 0;
  bool is_bare = false;
};
RoofSurface plane_surface(const RoofBase& base, const RoofPlane& plane);

/// Joins points nearer than `reach`, and removes faces that lose their area.
void weld(RoofSurface& surface, double reach, const Job& job);

/// The rings of the plan, as points of the surface; points that were welded away are left out.
std::vector<std::vector<std::uint32_t>> lower_rings(const RoofSurface& surface, const RoofBase& base);

/// Whether the triangles of the body, or of the cover, meet in pairs at all of their edges, with points as in a file
/// with single precision.
bool is_closed(const Roof& roof, bool is_cover, const Job& job);

double height_of(const RoofSurface& surface);

/// The height where the slope of a two-slope roof changes, so that it is a share of the whole height. The
/// innermost point of the plan lies `way` inwards. `steep` and `flat` are tangents. A share above 1 counts as
/// 1.
double break_at(double share, double way, double steep, double flat);

}  // namespace seedmesh
