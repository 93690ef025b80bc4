#pragma once
/// Organs as small meshes in their own frames: attached at the origin, +y toward the tip, the upper side
/// toward +z. A leaf has the length 1 from its attachment to its tip.
#include <span>

#include "core/geom/plant/leaf_shape.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// How a leaf is built. All builds but `mesh` need a texture with alpha (core/texture/leaf.h) of one leaf, or
/// of a twig for `twig` and `bunch`.
enum class LeafBuild {
  card,    ///< a square: 2 triangles
  cross,   ///< two crossed squares: 4 triangles
  curved,  ///< a square bent like the leaf: 16 triangles
  mesh,    ///< the outline: 4 to 700 triangles
  twig,    ///< a bent square with the texture of a twig: 16 triangles
  bunch,   ///< three of these around the axis: 48 triangles
};

struct LeafForm {
  LeafShape shape = LeafShape::simple;
  LeafBuild build = LeafBuild::mesh;
  double fold = 0.25;  ///< angle by which both halves of a blade are raised about the midrib, radians
  double droop = 0.5;  ///< angle by which the tip bends down, radians
  /// As in requests: 0 is the finest, and each step has fewer points on a margin and fewer rows in a bent square.
  int coarseness = 0;
  /// Level of detail: each has fewer points than the one before, and follows the surface of level 0.
  int level = 0;
  int twig_leaves = 9;      ///< number of leaves of a twig, as in the texture
  bool shows_twig = false;  ///< all builds made of squares use the texture of a twig, not of a leaf
  /// Of `cross`: the angle of both squares to the plane of a flat leaf, radians. 0: one is in that plane, the other at
  /// right angles to it.
  double tilt = 0;
};

/// Returns the mesh of a leaf. Its texture coordinates match the texture of the same shape.
Mesh leaf_mesh(const LeafForm& form, const Job& job);

/// A round fruit: closed, 1 high, `width` wide, from the origin to +y. `pointed`, 0..1, stretches the far end
/// to a point.
struct FruitForm {
  double width = 1;
  double pointed = 0;
  int sides = 10;
};
Mesh fruit_mesh(const FruitForm& form, const Job& job);

/// Returns a ball of diameter 1 about the origin.
Mesh ball_mesh(int sides, const Job& job);
/// Returns a disc of diameter 1 about the origin in the plane of x and y, with `sides` corners; its normal is +z.
Mesh disc_mesh(int sides, const Job& job);

/// A surface of bicubic patches, 16 control points each, row by row.
enum class PatchBasis { bezier, b_spline };
struct PatchForm {
  std::span<const glm::vec3> points;  ///< 16 for each patch
  PatchBasis basis = PatchBasis::bezier;
  int divisions = 6;  ///< number of divisions of each side of a patch
};
/// u runs along a row, v from row to row; the normal is along du x dv. Triangles without area are left out,
/// as at a side that is a point. After Farin, "Curves and Surfaces for CAGD", 2002.
Mesh patch_mesh(const PatchForm& form, const Job& job);

}  // namespace seedmesh
