#pragma once
/// Limbs -> Mesh as a tree grows it: one surface that goes over from limb to limb.
///
/// skin() makes every limb a closed tube; graft() opens the parent where a limb leaves it. Three ways to
/// begin:
/// - A collar: the child's first ring lies on the parent's surface, as the intersection of the two tubes, and
/// the
///   parent's triangles end at it. For limbs thinner than their parent.
/// - A fork of limbs of like thickness: three half rings that share two points, across the incoming limb, the
///   outgoing one and the crotch between (after P. Brunt's proctree, 2012).
/// - Closed, as skin() does it: where there is no room for either, or a face would look against a normal.
///
/// Cross-sections have corners by their radius, between the rings of a limb too, and joints on a straight
/// piece have no ring of their own: a twig takes a tenth of the triangles of its trunk.
#include <span>

#include "core/geom/contour.h"
#include "core/geom/limbs.h"
#include "core/model/mesh.h"

namespace seedmesh {

struct GraftOptions {
  int sides = 8;             ///< corners of the thickest limb, 3..64; thinner ones have fewer, down to 3
  bool weld = true;          ///< false: all limbs are closed tubes
  float thinnest = 0;        ///< limbs of a smaller radius where they begin are left out
  float thinnest_joint = 0;  ///< thinner limbs, where they begin, stand closed inside their parent,
                             ///< turned as they would grow out of it
  bool pointed = false;      ///< a thin end is the point of the last ring's cone and has no ring of its own
  bool every_bend = false;   ///< a ring at every bend, however slight
  int lobes = 0;             ///< ribs around every limb of order 0
  float lobe_depth = 0;      ///< as a share of the radius, below 1
  bool overlaps = false;  ///< limbs may lie on each other, piece by piece: such are found and left to skin()
  bool points = false;    ///< limbs may be points where they begin or on the way: such are left to skin()
  std::span<const Contour> contours = {};  ///< of Limbs::contour; limbs that have one are left to skin()
  float v_scale = 1;  ///< texture lengths a metre along the limb; u is in metres round it
  /// For pictures that repeat: u goes a whole number of times from 0 to 1 round each limb, once a metre of
  /// circumference where it begins and at least once, and v keeps the picture's proportions as the limb grows
  /// thinner.
  bool wrap = false;
  /// The mesh gets tangents along u, as add_tangents() would make them of the result; but none where limbs
  /// are left to skin().
  bool tangents = false;
  /// Where given, it gets for each vertex the joint at the far end of the internode that it moves with. The
  /// rim that two limbs share moves with the older one.
  Array<std::uint32_t>* joints = nullptr;
  /// Where given, limbs have rings where they change their colour, as far as there is room, and it gets the
  /// colour of each triangle. The mesh may be parted between triangles of different colours.
  Array<std::int16_t>* colors = nullptr;
  /// Where given, it says whether the limbs lie in heaps, or bend, so that no surface is left; what is
  /// returned is of no use then, and nothing is refused.
  bool* is_heap = nullptr;
  /// Where given, it gets of each joint 1 where a limb begins there that has grown out of its parent.
  Array<std::uint8_t>* grown = nullptr;
  /// Where given, it has the position of each joint and gets, for those that have no ring of their own, where
  /// the limb that is drawn passes by.
  Array<glm::vec3>* drawn = nullptr;
};

struct GraftCounts {
  std::uint32_t limbs = 0, collars = 0, forks = 0, closed = 0, fallen_back = 0;
  std::uint32_t creases = 0;  ///< faces with a normal of their own
};

/// The bark of all limbs, whatever their colour. Where limbs part so sharply that no normal of a corner is in
/// front of all its faces, the one behind has a vertex of its own there: a crease. Guarantees as skin():
/// closed, welded by position every edge in two triangles; unit normals that no face looks against; no unused
/// vertex; u and v in metres (unless `wrap`), one seam. Heaps of limbs so dense that no surface is left are
/// refused (Code::limit). `counts` may be null. Limbs that would break a guarantee are skinned by skin()
/// instead. Spends Resource::triangles as it goes. Runs on job.threads(); the result does not depend on it.
/// About 40 bytes a vertex beside the mesh, and the mesh once more where a limb had to be written anew.
Mesh graft(const Limbs& limbs, const GraftOptions& options, Job& job, GraftCounts* counts = nullptr);

}  // namespace seedmesh
