#pragma once
/// Outlines of leaves and petals in the plane. Leaf meshes (leaf_mesh.h) and leaf textures (core/texture) are
/// both drawn from them, so that they match.
///
/// The frame of a leaf: attached at the origin, +y toward its tip, length 1, +x to the right, seen from
/// above.
#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace seedmesh {

/// The leaf shapes of requests, in the order of leaf_shape_names().
enum class LeafShape {
  simple,        ///< ovate, entire margin
  willow,        ///< lanceolate
  birch,         ///< triangular, toothed
  cordate,       ///< heart-shaped
  lobed,         ///< a lobed leaf, as of oaks
  maple,         ///< palmately lobed
  ginkgo,        ///< a fan
  compound,      ///< pinnate: leaflets in pairs, as of ashes
  palmate,       ///< leaflets from one point, as of chestnuts
  needles,       ///< a shoot of short needles, as of spruces
  pine_needles,  ///< a shoot of long needles in pairs
  palm,          ///< a frond
  kite,          ///< four corners, the leaf of Kogovšek's thesis
  petal,         ///< the petal of a flower
};
constexpr int leaf_shape_count = 14;
std::span<const std::string_view> leaf_shape_names();
constexpr bool has_needles(LeafShape shape) {
  return shape == LeafShape::needles || shape == LeafShape::pine_needles;
}

/// A line that becomes thinner: a stalk, a needle or a vein.
struct LeafLine {
  glm::dvec2 from{0}, to{0};
  double width = 0, end_width = 0;
};

/// One blade: a leaf, or a leaflet of a compound leaf.
struct LeafBlade {
  std::vector<glm::dvec2> right, left;  ///< margins from base to tip, each with both ends
  glm::dvec2 base{0}, tip{0, 1};        ///< ends of the midrib
  double half_width = 0;                ///< the largest distance of the margin from the midrib
  std::vector<LeafLine> veins;
};

struct LeafDrawing {
  std::vector<LeafBlade> blades;  ///< blades in drawing order: later blades lie above
  std::vector<LeafLine> stalks;   ///< petiole, rachis, needles
  std::size_t woody = 1;          ///< the first `woody` stalks are drawn as wood
  glm::dvec2 low{0}, high{0};     ///< bounding square with a small margin; the texture covers it
};

/// The detail of a drawing: the number of interpolated points between two control points of the outline, and
/// whether it has teeth and veins.
struct LeafDetail {
  int steps = 6;
  bool teeth = true, veins = true;
};

/// Returns a single leaf or, with `count` > 1, a twig with this number of leaves in its plane, alternately left
/// and right. For needles it is a branchlet with this number of shoots, for petals a spray with this number of
/// blossoms.
LeafDrawing draw_leaf(LeafShape shape, const LeafDetail& detail, int count = 1);

}  // namespace seedmesh
