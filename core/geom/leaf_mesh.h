#pragma once
/// Organs as small meshes, each in its own frame: attached at the origin, +y toward the tip, the upper side
/// looks to +z. A leaf is 1 long from its attachment to the tip.
#include <span>

#include "core/geom/leaf_shape.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// What a leaf is made of. All but `mesh` want a picture with alpha (core/texture/leaf.h) of one leaf, or for
/// `twig` and `bunch` of a twig.
enum class LeafBuild {
  card,    ///< a square: 2 triangles
  cross,   ///< two squares across each other: 4
  curved,  ///< a square bent as the leaf: 16
  mesh,    ///< its outline: 10 to 100
  twig,    ///< a bent square with a twig of leaves: 16
  bunch,   ///< three of them round the axis: 48
};

struct LeafForm {
  LeafShape shape = LeafShape::simple;
  LeafBuild build = LeafBuild::mesh;
  double fold = 0.25;  ///< radians by which both halves of a blade are raised about its midrib
  double droop = 0.5;  ///< radians by which the tip bends down
  int coarseness = 0;  ///< 0 finest; each step has fewer points on a margin and fewer rows in a bent square
  int level = 0;  ///< of detail: each has fewer points than the one before, and lies where the finest does
  int twig_leaves = 9;      ///< as in the picture
  bool shows_twig = false;  ///< squares of every build have the picture of a twig
};

/// Texture coordinates are those of the picture of the same shape.
Mesh leaf_mesh(const LeafForm& form, const Job& job);

/// A round fruit: closed, 1 high, `width` wide, hanging from the origin to +y; `pointed` 0 .. 1 draws its end
/// out.
struct FruitForm {
  double width = 1;
  double pointed = 0;
  int sides = 10;
};
Mesh fruit_mesh(const FruitForm& form, const Job& job);

/// A surface of bicubic patches, 16 control points each, row by row.
enum class PatchBasis { bezier, b_spline };
struct PatchForm {
  std::span<const glm::vec3> points;  ///< 16 a patch
  PatchBasis basis = PatchBasis::bezier;
  int divisions = 6;  ///< of each side of a patch
};
/// u runs along a row, v from row to row; the normal is along their cross product (du x dv). Triangles
/// without area are left out, as at a side that is drawn together to a point. After Catmull and Clark's
/// evaluation by the basis matrices; Farin, "Curves and Surfaces for CAGD", 2002.
Mesh patch_mesh(const PatchForm& form, const Job& job);

}  // namespace seedmesh
