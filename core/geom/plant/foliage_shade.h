#pragma once
/// Vertex colours of foliage: the light that leaves take from each other, and differences of hue by limb, twig
/// and leaf.
///
/// - Occlusion: 1 - Options::occlusion (1 - exp(-0.35 L)). L is the one-sided leaf area per area between the leaf and
///   the sky. It is the mean over the zenith (counted twice) and four directions 45 degrees from it. It is computed
///   on a grid of at most 16 cells along each axis.
/// - Hue: a rotation of the colour about the grey axis. Its variance has three parts in the ratio 9 : 9 : 4. They
///   belong to the limb that leaves the trunk, to the limb that bears the leaf, and to the leaf.
/// - If Options::hue is above 0, one leaf in fifty has the colour of a withered leaf.
#include <cstdint>

#include "core/geom/plant/limbs.h"

namespace seedmesh {

class FoliageShade {
 public:
  struct Options {
    float occlusion = 0;  ///< the largest share of light that a leaf loses, 0 .. 1
    float hue = 0;        ///< standard deviation, degrees
    float tint = 0;       ///< largest difference in brightness between leaves, 0 .. 1
    glm::vec3 color{1};   ///< linear colour of the leaves, for the rotation of the hue
    float leaf_area = 1;  ///< leaf area of an organ of scale 1, m^2
  };

  /// Linear in joints and organs; 8 bytes a joint and at most 16 KiB for the grid. Borrows nothing.
  FoliageShade(const Limbs& limbs, const Organs& organs, const Options& options, const Job& job);

  /// Returns the colour of all vertices of an organ, red in the lowest byte; opaque.
  std::uint32_t color_of(const Organ& organ) const;

  /// Returns the share of light at a point, 1 - options.occlusion to 1.
  float light_at(const glm::vec3& point) const;

 private:
  void add_occlusion(const Organs& organs, const Job& job);
  void add_hues(const Limbs& limbs, const Job& job);
  std::size_t cell_at(int x, int y, int z) const;

  Options options_;
  glm::vec3 low_{0};
  float cell_ = 1;
  int count_[3] = {1, 1, 1};
  Array<float> light_;  ///< light of each cell
  Array<float> hue_;    ///< hue for each joint, of its limb and of the limb that leaves the trunk, degrees
  glm::vec3 ratio_a_degree_{0};  ///< change of the colour, as a share of it
};

}  // namespace seedmesh
