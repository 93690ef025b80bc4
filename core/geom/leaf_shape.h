#pragma once
/// Outlines of leaves and petals in the plane: what leaf meshes (leaf_mesh.h) and leaf textures
/// (core/texture) are both drawn from, so that one fits the other.
///
/// A leaf's frame: attached at the origin, +y toward its tip, 1 long, +x to the right; its upper side is
/// seen.
#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace seedmesh {

/// How leaf shapes are called in requests; the order of leaf_shape_names().
enum class LeafShape {
  simple,    ///< ovate, entire margin
  willow,    ///< lanceolate
  birch,     ///< triangular, toothed
  cordate,   ///< heart-shaped
  lobed,     ///< as of oaks
  maple,     ///< palmately lobed
  ginkgo,    ///< a fan
  compound,  ///< pinnate: leaflets in pairs, as of ashes
  palmate,   ///< leaflets from one point, as of chestnuts
  needles,   ///< a shoot of needles, as of firs
  palm,      ///< a frond
  kite,      ///< four corners, the leaf of Kogovšek's thesis
  petal,     ///< of a flower
};
constexpr int leaf_shape_count = 13;
std::span<const std::string_view> leaf_shape_names();

/// A line that grows thinner: a stalk, a needle or a vein.
struct LeafLine {
  glm::dvec2 from{0}, to{0};
  double width = 0, end_width = 0;
};

/// One blade: a leaf, or a leaflet of a compound one.
struct LeafBlade {
  std::vector<glm::dvec2> right, left;  ///< margins from base to tip, both ends included in each
  glm::dvec2 base{0}, tip{0, 1};        ///< ends of its midrib
  double half_width = 0;                ///< greatest distance of the margin from the midrib
  std::vector<LeafLine> veins;
};

struct LeafDrawing {
  std::vector<LeafBlade> blades;  ///< those drawn later lie above
  std::vector<LeafLine> stalks;   ///< petiole, rachis, needles
  std::size_t woody = 1;          ///< the first so many stalks are wood, where the leaf has any
  glm::dvec2 low{0}, high{0};  ///< box of everything, with a little room round it: the square of the texture
};

/// How fine a drawing is: points between two points of the margin's table, and whether there are teeth and
/// veins.
struct LeafDetail {
  int steps = 6;
  bool teeth = true, veins = true;
};

/// A single leaf. With `count` > 1 a twig of so many leaves in its plane, alternately left and right; of
/// needles a branchlet of so many shoots, of petals a spray of so many blossoms.
LeafDrawing draw_leaf(LeafShape shape, const LeafDetail& detail, int count = 1);

}  // namespace seedmesh
