#pragma once
/// Converts limbs to one mesh whose surface continues from limb to limb, as bark does.
///
/// skin() makes every limb a closed tube; graft() opens the parent where a limb leaves it. A limb begins in
/// one of three ways:
/// - A collar, for limbs thinner than their parent. The child's first ring lies on the parent's surface, at
///   the intersection of the two tubes, and the parent's triangles end at it.
/// - A fork, for limbs of similar thickness: three half rings that share two points. They lie across the
///   incoming limb, across the outgoing limb and in the crotch between them (after P. Brunt's proctree,
///   2012).
/// - A closed tube, as in skin(), where neither a collar nor a fork fits, or where a face would face away
///   from a normal.
///
/// The number of corners follows the radius, also between the rings of a limb. Joints on a straight piece
/// have no ring. A twig takes a tenth of the triangles of its trunk.
///
/// Phases: ring_plan.h plans each limb, limb_writer.h writes it, junction_normals.h computes the normals of
/// loops, face_check.h finds defects. Limbs with defects are written again in a simpler way (bark_rounds.h),
/// and finally by skin() (fallback_skin.h).
#include <span>

#include "core/geom/plant/contour.h"
#include "core/geom/plant/limbs.h"
#include "core/model/mesh.h"

namespace seedmesh {

struct GraftOptions {
  int sides = 8;                 ///< corners of the thickest limb, 3..64; thinner limbs have fewer, down to 3
  double corner_exponent = 0.3;  ///< the number of corners is proportional to this power of the radius
  bool weld = true;              ///< false: all limbs are closed tubes
  float thinnest = 0;            ///< limbs with a smaller first radius are left out
  /// Limbs with a smaller first radius are closed tubes. Their corners have the angles that welded limbs
  /// would have.
  float thinnest_joint = 0;
  bool pointed = false;     ///< a thin end has no last ring: it is the point of a cone
  bool every_bend = false;  ///< a ring at every bend, however slight
  int lobes = 0;            ///< ribs around every limb of order 0
  float lobe_depth = 0;     ///< depth of the ribs, as a share of the radius, below 1
  /// Internodes may coincide with others: they are found and their limbs left to skin().
  bool overlaps = false;
  bool points = false;  ///< radii may be 0 before the tip: such limbs are left to skin()
  /// Contours of Limbs::contour; limbs with contours are left to skin().
  std::span<const Contour> contours = {};
  float v_scale = 1;        ///< repetitions of the texture for each metre along the limb
  bool wrap = false;        ///< as SkinOptions::wrap
  float least_repeats = 1;  ///< as SkinOptions::least_repeats
  /// Add tangents along u, as add_tangents() would; none where limbs are left to skin().
  bool tangents = false;
  /// If not null: gets for each vertex the joint at the far end of the internode that it moves with. The rim
  /// that two limbs share moves with the parent.
  Array<std::uint32_t>* joints = nullptr;
  /// If not null: gets the colour of each triangle, and limbs have rings where they change their colour, if a
  /// ring fits. The mesh may be split between triangles of different colours.
  Array<std::int16_t>* colors = nullptr;
  /// If not null: set to true if limbs overlap or bend so that no surface is left. The result is then
  /// invalid, and nothing is thrown.
  bool* has_no_surface = nullptr;
  /// If not null: gets for each joint 1 where a limb begins that is welded to its parent.
  Array<std::uint8_t>* grown = nullptr;
  /// If not null: has the position of each joint, and gets for joints without a ring the position where the
  /// drawn limb passes them.
  Array<glm::vec3>* drawn = nullptr;
};

struct GraftCounts {
  std::uint32_t limbs = 0, collars = 0, forks = 0, closed = 0;
  std::uint32_t fallen_back = 0;  ///< limbs left to skin()
  std::uint32_t creases = 0;      ///< faces with a normal of their own
};

/// Returns the bark of all limbs, of all colours. Where limbs part at an acute angle, a vertex may have no normal
/// that points to the front of all its faces. A face that the normal points behind then gets a vertex of its own: a
/// crease.
///
/// Guarantees, as skin(): a closed surface, where every edge belongs to two triangles after welding by
/// position; unit normals that no face faces away from; no unused vertex; u and v in metres (unless `wrap`),
/// one seam.
///
/// Throws Stop where limbs overlap so densely that no surface is left. Spends
/// Resource::triangles while it writes. Runs on job.threads(); the result does not depend on their number.
/// Needs about 40 bytes a vertex beside the mesh, and twice the mesh where a limb had to be written again.
/// `counts` may be null.
Mesh graft(const Limbs& limbs, const GraftOptions& options, Job& job, GraftCounts* counts = nullptr);

}  // namespace seedmesh
