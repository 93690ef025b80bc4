#pragma once
/// Bodies of buildings: a plan with a floor, walls and a roof, as one closed surface. Maps describe buildings in
/// this way (Simple 3D Buildings of OpenStreetMap).
///
/// Points are (x, y) of the plan and a height. Gabled, gambrel, saltbox, round, skillion and half-hipped roofs are
/// the lower envelope of planes over the smallest rectangle around the plan. They therefore fit any plan with
/// courtyards. Hipped and mansard roofs are those of roof.h. Pyramidal roofs, domes and onions are cones and surfaces
/// of rings about the centroid.
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/geom/polygon/plan.h"

namespace seedmesh {

enum class MassRoof {
  flat,
  skillion,     ///< one plane
  gabled,       ///< two planes; over a plan that is no rectangle, by the straight skeleton
  half_hipped,  ///< gabled, with ends that slope from half of the height
  gambrel,      ///< two slopes on each side
  saltbox,      ///< gabled, with the ridge at 0.35 of the width
  round,        ///< half an ellipse across
  hipped,       ///< a slope from every edge
  mansard,      ///< two slopes from every edge
  pyramidal,    ///< one apex over the centroid
  dome,         ///< half an ellipsoid over the plan
  onion,        ///< wider than the plan, with a tip
};
constexpr std::array<const char*, 12> mass_roof_names{"flat",    "skillion",  "gabled", "half_hipped",
                                                      "gambrel", "saltbox",   "round",  "hipped",
                                                      "mansard", "pyramidal", "dome",   "onion"};

struct MassOptions {
  MassRoof roof = MassRoof::flat;
  double base = 0;         ///< height of the floor
  double eaves = 3;        ///< height where the walls end and the roof begins; above `base`
  double roof_height = 0;  ///< height of the highest point above the eaves; 0 for a flat roof
  /// Unit vector in the plan that points down a slope, at a right angle to the ridge. Null: at a right angle to the
  /// longer side of the smallest rectangle; for a skillion roof, outwards at a right angle to the longest edge.
  std::optional<glm::dvec2> direction;
  bool across = false;  ///< whether the ridge runs along the shorter side; only without a direction
};

enum class MassPart : std::uint8_t { wall, roof, floor };

struct Mass {
  /// A planar face with one normal. Its triangles are [first, `first` of the next face).
  struct Face {
    MassPart part = MassPart::wall;
    glm::dvec3 normal{0, 0, 1};
    std::uint32_t first = 0;
  };
  std::vector<glm::dvec3> point;  ///< x and y of the plan, and the height; shared by faces that meet
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<Face> faces;
  /// The roof that was built. It differs from that of the options if that one failed.
  MassRoof made = MassRoof::flat;
};

/// The smallest rectangle around a plan that has a side along one of the edges of its convex hull.
struct PlanBox {
  glm::dvec2 middle{0};
  glm::dvec2 along{1, 0};  ///< unit, of the longer side
  glm::dvec2 half{0};      ///< half of the longer and of the shorter side
};
/// Returns the smallest such rectangle by area.
PlanBox smallest_box(const Plan& plan);

/// Makes the body. `plan` has no defects (`defects_of`). Every edge of the surface belongs to one triangle in
/// each direction, also after coordinates are rounded to single precision. A roof for which this fails is
/// replaced by another kind (`made`). Pyramidal roofs, domes and onions over a plan with courtyards, or that is
/// not visible as a whole from its centroid, become hipped. Cost: that of the triangulation, and of the straight
/// skeleton for hipped, mansard, and some gabled and gambrel roofs.
Mass mass_of(const Plan& plan, const MassOptions& options, const Job& job);

/// Whether every edge of the triangles occurs equally often in both directions, and no triangle repeats a point.
bool is_closed(const Mass& mass);

/// Returns the height above the eaves of a roof of this kind whose slopes have this angle (radians).
double roof_height_at(const Plan& plan, const MassOptions& options, double angle, const Job& job);

}  // namespace seedmesh
