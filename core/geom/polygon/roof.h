#pragma once
/// Roofs over any plan with courtyards: planes that rise from the eaves and end where they meet.
///
/// Points are in space as by `raised` of plan.h; the walls end at height 0. A roof has one or two closed
/// solids. The body stands on the plan: slopes, vertical gables and a base at height 0 that faces down. With
/// an overhang or a thickness there is also a cover: a shell over the slopes and beyond the walls, with an
/// underside (soffit) and an edge (fascia). The two share no plane, so that one mesh can contain both.
#include <array>
#include <optional>

#include "core/geom/polygon/plan.h"
#include "core/model/mesh.h"

namespace seedmesh {

enum class RoofKind {
  flat,
  hip,      ///< a slope from every edge
  gable,    ///< vertical ends where the hip roof has triangles, or at `gables`
  pyramid,  ///< one apex over the centroid; a hip roof if the plan is not star-shaped from there
  shed,     ///< one slope, from the edge `low_edge`
  mansard,  ///< a steep slope and a flatter slope above it, from every edge
  gambrel,  ///< a mansard with vertical ends
};

struct RoofOptions {
  RoofKind kind = RoofKind::hip;
  double angle = 0.6;            ///< radians, 0 < angle < pi/2; of the lower slope for mansard and gambrel
  std::optional<double> height;  ///< of the highest point, instead of `angle`; both slopes of mansard and
                                 ///< gambrel are scaled to it, but not `break_height`
  double upper_angle = 0.35;     ///< mansard, gambrel: of the upper slope
  double break_height = 0;       ///< mansard, gambrel: where the slope changes; 0: at 0.3 of the way inwards
  double overhang = 0;           ///< metres along the slope, past the eaves
  double verge = 0;              ///< metres beyond vertical ends, horizontally
  double thickness = 0;          ///< thickness of the cover, vertically; 0 with an overhang means 0.12
  std::optional<double> flat_top;     ///< hip, gable, mansard, gambrel: height of a horizontal cut
  std::uint32_t low_edge = 0;         ///< shed
  std::vector<std::uint32_t> gables;  ///< gable, gambrel: edges with vertical ends; empty: chosen by shape
  std::vector<double> edge_angles;    ///< hip, gable: one for each edge; pi/2 is vertical; empty: `angle`
};

enum class RoofRole {
  slope,   ///< or the horizontal top
  gable,   ///< a vertical wall
  base,    ///< base at height 0 within the walls; faces down
  soffit,  ///< underside of the cover
  fascia,  ///< vertical edge of the cover
};
constexpr std::array<const char*, 5> roof_role_names{"roof", "gable", "base", "soffit", "fascia"};

/// A planar face (to a billionth of the plan). Corners counter-clockwise seen from outside.
struct RoofFace {
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  RoofRole role = RoofRole::slope;
  bool is_cover = false;
  std::uint32_t edge = none;  ///< the edge of the plan that the face belongs to
  std::vector<std::uint32_t> outline;
  std::vector<std::vector<std::uint32_t>> holes;
  glm::dvec3 normal{0, 1, 0};  ///< unit
  glm::dvec3 along{1, 0, 0};   ///< unit, horizontal, along the eave: `normal` x `along` points up the slope
};

struct Roof {
  std::vector<glm::dvec3> point;  ///< shared by faces that meet
  std::vector<RoofFace> faces;    ///< faces of the body, then of the cover
  double height = 0;              ///< height of the highest point
  /// One sentence for each option that could not be used; the roof is flat or of the kind that the sentence
  /// names.
  std::vector<std::string> warnings;
};

/// Makes a roof. A plan with defects gets one horizontal face and a warning. Every roof is checked
/// (straight_skeleton.h). If the check fails, the roof is made again with other tolerances for merging points. Then
/// it is made from a plan whose points are moved by up to a thousandth of its diagonal. If all attempts fail, it is
/// flat with a warning. A flat roof without thickness is one face that faces up, and no solid.
Roof roof(const Plan& plan, const RoofOptions& options, const Job& job);

/// Returns the edges that RoofKind::gable makes vertical unless the options name some: those whose slope of the hip
/// roof is a triangle, of two neighbours the shorter edge, and never all edges.
std::vector<std::uint32_t> gable_edges(const Plan& plan, const Job& job);

/// The faces of each role as a mesh with flat normals. Texture coordinates are in metres: u along the eave
/// and v up the slope, or u along the wall and v the height. Spends Resource::triangles. Roles without faces
/// are left out.
struct RoofMesh {
  RoofRole role = RoofRole::slope;
  Mesh mesh;
};
/// Makes the meshes of all roles.
std::vector<RoofMesh> meshes_of(const Roof& roof, Job& job);

/// Returns the triangles of one face, as positions in Roof::point.
/// Checks stop and deadline where there is a job.
std::vector<std::uint32_t> triangulate(const Roof& roof, const RoofFace& face, const Job* job = nullptr);

}  // namespace seedmesh
