#pragma once
/// Roofs over any plan, courtyards included: the planes that rise from the eaves, cut where they meet.
///
/// Space: `raised` of plan.h; height 0 is where the walls end. Two closed solids may come out. The body
/// stands on the plan: its slopes, its upright gables, and its base at height 0 looking down; without the
/// base it closes walls that have no top. With an overhang (or a thickness) there is a cover on top of it: a
/// shell that follows the slopes outwards over the walls, with an underside (soffit) and an edge (fascia).
/// The two share no plane, so both may stand in one mesh.
#include <array>
#include <optional>

#include "core/geom/plan.h"
#include "core/model/mesh.h"

namespace seedmesh {

enum class RoofKind {
  flat,
  hip,      ///< a slope from every edge
  gable,    ///< upright ends where the hip roof has triangles, or at `gables`
  pyramid,  ///< one apex over the middle; a plan that cannot be seen whole from there gets a hip roof
  shed,     ///< one slope, from the edge `low_edge`
  mansard,  ///< a steep slope and a flatter one above it, from every edge
  gambrel,  ///< the same with upright ends
};

struct RoofOptions {
  RoofKind kind = RoofKind::hip;
  double angle = 0.6;            ///< radians, 0 < angle < pi/2; of the lower slope for mansard and gambrel
  std::optional<double> height;  ///< of the highest point instead of `angle`; both slopes of mansard and
                                 ///< gambrel are scaled to it, and `break_height` is kept
  double upper_angle = 0.35;     ///< mansard, gambrel: of the upper slope
  double break_height = 0;  ///< mansard, gambrel: where it changes; 0: at three tenths of the way inwards
  double overhang = 0;      ///< metres along the slope, past the eaves
  double verge = 0;         ///< metres past upright ends, level
  double thickness = 0;     ///< of the cover, upright; 0 with an overhang means 0.12
  std::optional<double> flat_top;     ///< hip, gable, mansard, gambrel: cut off level at this height
  std::uint32_t low_edge = 0;         ///< shed
  std::vector<std::uint32_t> gables;  ///< gable, gambrel: edges with upright ends; empty: chosen by shape
  std::vector<double> edge_angles;    ///< hip, gable: one for each edge; pi/2 is upright; empty: `angle`
};

enum class RoofRole {
  slope,   ///< or the level top
  gable,   ///< upright, a wall
  base,    ///< at height 0, looks down, within the walls
  soffit,  ///< underside of the cover
  fascia,  ///< upright edge of the cover
};
constexpr std::array<const char*, 5> roof_role_names{"roof", "gable", "base", "soffit", "fascia"};

/// A planar face (to a billionth of the plan). Corners counter-clockwise seen from outside.
struct RoofFace {
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  RoofRole role = RoofRole::slope;
  bool is_cover = false;
  std::uint32_t edge = none;  ///< of the plan that it belongs to
  std::vector<std::uint32_t> outline;
  std::vector<std::vector<std::uint32_t>> holes;
  glm::dvec3 normal{0, 1, 0};  ///< unit
  glm::dvec3 along{
      1, 0, 0};  ///< unit, level, in the face: along the eave, so that `normal` x `along` points up the slope
};

struct Roof {
  std::vector<glm::dvec3> point;  ///< shared by faces that meet
  std::vector<RoofFace> faces;    ///< of the body, then of the cover
  double height = 0;              ///< of the highest point
  /// What could not be made as asked, one sentence each; the roof is then flat, or of the kind that is named.
  std::vector<std::string> warnings;
};

/// Over a plan with faults there is one level face and a warning. Every roof is checked
/// (straight_skeleton.h); one that fails is made again from a plan shaken by a millionth, and then flat with
/// a warning. A flat roof without thickness is one face that looks up, no solid.
Roof roof(const Plan& plan, const RoofOptions& options, const Job& job);

/// The edges that `RoofKind::gable` makes upright when none are named: of the hip roof, the ends whose slope
/// is a triangle; of neighbours the shorter one; never all.
std::vector<std::uint32_t> gable_edges(const Plan& plan, const Job& job);

/// All faces of one role as a mesh: flat normals, UV in metres (u along the eave, v up the slope; upright
/// faces u along the wall, v the height). Spends Resource::triangles. Roles without faces have no entry.
struct RoofMesh {
  RoofRole role = RoofRole::slope;
  Mesh mesh;
};
std::vector<RoofMesh> meshes_of(const Roof& roof, Job& job);

/// The triangles of one face, as numbers into Roof::point.
std::vector<std::uint32_t> triangulate(const Roof& roof, const RoofFace& face);

}  // namespace seedmesh
