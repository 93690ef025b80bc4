#pragma once
/// Plans: polygons with holes, in metres, such as the footprints of buildings.
///
/// A plan lies in the plane (x, y), seen from above. `raised` maps it to space: x stays and y becomes -z, so
/// that counter-clockwise rings are counter-clockwise seen from above (+Y).
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/base/job.h"

namespace seedmesh {

using PlanRing = std::vector<glm::dvec2>;

/// rings[0] is the outer ring, counter-clockwise. The others are holes, clockwise, so that the inside is
/// always to the left. Rings do not repeat their first point. Edge i of a ring goes from point i to the next.
/// Edges are numbered through all rings.
struct Plan {
  std::vector<PlanRing> rings;
};

/// Returns a point of the plan at a height: x east, y up, -z north.
inline glm::dvec3 raised(const glm::dvec2& p, double height) { return {p.x, height, -p.y}; }

/// A defect at a point of a ring.
struct PlanDefect {
  std::uint32_t ring = 0, vertex = 0;
  std::string message;  ///< "crosses the edge from point 3 of ring 0"
};

/// Returns all defects of a plan: fewer than three points, numbers that are not finite, rings without an area, and
/// edges that cross or touch. A point nearer to the next than a millionth of the diagonal is a defect. So is a hole
/// outside of the outer ring or inside another hole. The direction of rings may be wrong, but a last point equal to
/// the first is a defect (see `read_plan`). Cost: about n log n in practice. Checks stop and deadline where there is
/// a job.
std::vector<PlanDefect> defects_of(const Plan& plan, const Job* job = nullptr);

/// Returns a plan of rings in any direction. A last point equal to the first is removed, as GeoJSON has it. Points in
/// the middle of straight edges stay.
Plan read_plan(std::vector<PlanRing> rings);

/// Returns the area of a ring in square metres; negative if the ring is clockwise.
double signed_area(std::span<const glm::dvec2> ring);
/// Returns the area of a plan without its holes, in square metres.
double area(const Plan& plan);
/// Returns the centroid of a ring, whose area is not 0.
glm::dvec2 centroid_of(std::span<const glm::dvec2> ring);
/// Returns the number of edges of all rings.
std::uint32_t edge_count(const Plan& plan);
/// Returns the two ends of an edge, by its number through all rings.
std::pair<glm::dvec2, glm::dvec2> edge_of(const Plan& plan, std::uint32_t edge);
/// Whether a point lies inside the plan or on its border.
bool contains(const Plan& plan, const glm::dvec2& point);
/// Returns the diagonal of the box around the outer ring.
double diagonal_of(const Plan& plan);

/// Whether triangles without area are kept. They occur where a point lies in the middle of a straight edge.
/// `keep`: every point is used, so that neighbours along the edge meet exactly. `drop`: plans with one ring
/// have no such triangles, because their shading would be wrong.
enum class ThinTriangles { keep, drop };

/// Returns counter-clockwise triangles that fill a plan, as indices of points counted through all rings; see
/// Triangulator. Checks stop and deadline where there is a job.
std::vector<std::uint32_t> triangulate(const Plan& plan, ThinTriangles thin = ThinTriangles::keep,
                                       const Job* job = nullptr);

/// A plan made from another. Each edge is parallel to an edge of the original.
struct DerivedPlan {
  Plan plan;
  std::vector<std::uint32_t> source;  ///< edge of the original, indexed by edge of `plan`
};

/// The region between an edge and its new position.
struct PlanStrip {
  std::uint32_t edge = 0;
  Plan plan;
};

struct Setback {
  std::vector<DerivedPlan> remainder;  ///< the rest inside: none, one or several plans
  std::vector<PlanStrip> strips;       ///< strips, indexed by edge; with the remainder they fill the plan
};

/// Moves each edge i inwards by distances[i] >= 0 with mitred corners, by the weighted straight skeleton
/// (Aichholzer and Aurenhammer 1996; Biedl, Held, Huber, Kaaser and Palfrader, "Weighted straight skeletons
/// in the plane", 2015). If the skeleton fails its own check, the remainder is the plan itself and there are
/// no strips.
Setback setback(const Plan& plan, std::span<const double> distances, const Job& job);

/// Moves all edges by one distance, inwards if it is negative, with mitred corners. Outwards, holes become
/// smaller and may vanish. Empty if nothing is left.
std::vector<DerivedPlan> offset(const Plan& plan, double distance, const Job& job);

/// Moves each edge i outwards by distances[i] >= 0.
std::vector<DerivedPlan> outset(const Plan& plan, std::span<const double> distances, const Job& job);

}  // namespace seedmesh
