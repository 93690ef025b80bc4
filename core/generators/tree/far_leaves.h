#pragma once
/// The leaves of coarser levels of detail: cards with fewer triangles and the same texture.

#include "core/generators/api.h"
#include "core/model/mesh.h"
#include "generated/params/tree.h"

namespace seedmesh::tree {

/// How the leaves of a level are built, in descending order of their numbers of triangles.
enum class LeafDetail {
  bent,      ///< as leaf_mesh() builds them at that level
  square,    ///< flat cards: two triangles for each side
  triangle,  ///< one triangle for each side; it contains the visible part of the texture, which is not repeated
  single,    ///< the same triangle for both sides, in a double-sided material
  one_card,  ///< the same, for one of crossed cards
};

/// Whether a leaf has only one triangle for both sides of a card.
inline bool is_single(LeafDetail detail) { return detail >= LeafDetail::single; }

/// Whether leaves can be built with less detail than `bent`. This requires a generated texture that the
/// output contains.
bool has_far_leaves(const TreeParams& params, const GenerateContext& context);

/// Returns the mesh of a leaf of length 1 at a level, with faces on one side.
Mesh far_leaf(const TreeParams& params, LeafDetail detail, int level, const Job& job);

/// Keeps one triangle of each pair of a front and a back: the side that faces away from the vertical axis through
/// `middle`, which is the visible one from outside the crown. `mesh` consists of copies of `leaf`. In `leaf`,
/// all front triangles come before all back triangles, and triangles share no vertices.
Mesh outer_sides(const Mesh& mesh, const Mesh& leaf, const glm::vec3& middle, const Job& job);

/// Returns the factor for the brightness of the texture of single triangles. It makes the crown as bright as
/// with leaves that have two sides. It is needed because renderers flip the normals of back faces, which then
/// point away from the sky. The factor is the mean light on `all` divided by that on `outer`, in three
/// horizontal views. The light of the sky is a fifth of that of the sun. `all`: all leaves as `triangle` with
/// backs; `outer`: those of the level after outer_sides(). Cost: about 0.5 us a triangle.
float gain_of(const Mesh& all, const Mesh& outer, const Job& job);

/// Returns the factor for the colours of the leaves of a coarser level, which has the share `share` of all
/// leaves. The factor makes up for the missing shadows of the leaves and twigs that are left out. Measured
/// with the presets.
float dimming(double share);

}  // namespace seedmesh::tree
