#pragma once
/// Plans: flat outlines with courtyards, in metres and double precision, as buildings stand on them.
///
/// A plan lies in the plane (x, y) seen from above; `raised` puts it into space: x stays, y points to -z, so
/// that what turns counter-clockwise here is seen from above (+Y) counter-clockwise too.
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/base/job.h"

namespace seedmesh {

using PlanRing = std::vector<glm::dvec2>;

/// rings[0] is the outside, counter-clockwise; the others are holes, clockwise: the inside is always to the
/// left. No ring repeats its first point at its end. Edge i of a ring goes from its point i to the next;
/// edges are numbered through all rings, in order.
struct Plan {
  std::vector<PlanRing> rings;
};

inline glm::dvec3 raised(const glm::dvec2& p, double height) { return {p.x, height, -p.y}; }

/// One fault, at a point of a ring as the caller gave it.
struct PlanFault {
  std::uint32_t ring = 0, vertex = 0;
  std::string message;  ///< "crosses the edge from point 3 of ring 0"
};

/// Every fault that keeps a plan from being one: fewer than three points, numbers that are not finite, a
/// point that is repeated (nearer than a millionth of the diagonal), a ring without area, edges that cross or
/// touch, a hole that lies outside, or inside another hole. A ring whose last point is its first is taken as
/// closed twice and is a fault (see `read_plan`); the direction of rings is none. Sweeps over x: about n log
/// n for what is met in practice.
std::vector<PlanFault> faults_of(const Plan& plan);

/// Rings as users write them: a last point equal to the first (GeoJSON) goes, and rings are turned as Plan
/// wants. Points in the middle of a straight edge stay.
Plan read_plan(std::vector<PlanRing> rings);

double signed_area(std::span<const glm::dvec2> ring);
double area(const Plan& plan);
/// Of the area, which is not nothing.
glm::dvec2 centroid_of(std::span<const glm::dvec2> ring);
std::uint32_t edge_count(const Plan& plan);
/// The two ends of an edge by its number through all rings.
std::pair<glm::dvec2, glm::dvec2> edge_of(const Plan& plan, std::uint32_t edge);
/// On the border counts as inside.
bool contains(const Plan& plan, const glm::dvec2& point);
/// Diagonal of the box round the outer ring.
double diagonal_of(const Plan& plan);

/// Triangles over all points of a plan, counter-clockwise; the numbers are those of points through all rings.
/// Every point is used, unless only a triangle without area would, so neighbours that share an edge meet it
/// without gaps.
std::vector<std::uint32_t> triangulate(const Plan& plan);

/// A plan that came of another, with the edge of that other that each of its edges lies parallel to.
struct DerivedPlan {
  Plan plan;
  std::vector<std::uint32_t> source;  ///< by edge of `plan`; an edge of the plan it came of
};

/// The region between an edge and where it moved to.
struct PlanStrip {
  std::uint32_t edge = 0;
  Plan plan;
};

struct Setback {
  std::vector<DerivedPlan> remainder;  ///< what is left inside: none, one, or several
  std::vector<PlanStrip> strips;  ///< what was taken, by edge; together with the remainder the whole plan
};

/// Moves edge i inwards by distances[i] >= 0 (one number for each edge), all at once and with their
/// neighbours' corners mitred, by the weighted straight skeleton (Aichholzer and Aurenhammer 1996; Biedl,
/// Held, Huber, Kaaser and Palfrader, "Weighted straight skeletons in the plane", 2015). Where that fails its
/// own check the remainder is the plan itself and there are no strips.
Setback setback(const Plan& plan, std::span<const double> distances, const Job& job);

/// All edges by one distance: inwards where it is negative, outwards else; corners mitred. Outwards holes
/// become smaller and may vanish. Empty where nothing is left.
std::vector<DerivedPlan> offset(const Plan& plan, double distance, const Job& job);

/// Edge i outwards by distances[i] >= 0.
std::vector<DerivedPlan> outset(const Plan& plan, std::span<const double> distances, const Job& job);

}  // namespace seedmesh
