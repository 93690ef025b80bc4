#pragma once
/// Levels of detail of a plant. Every level is made from the same skeleton with fewer elements, not by
/// simplifying a mesh, so that all levels have the same silhouette. After Tunnel, "Puude genereerimine
/// L-süsteemidega", 2012, section 3.4.2: level i has the quality 1 / sqrt(i + 1). 32 sides become 32, 22, 18,
/// 16, 14; 6 stacks become 6, 4, 3, 3, 2.
#include "core/base/job.h"
#include "core/geom/plant/limbs.h"

namespace seedmesh {

constexpr int most_levels = 5;

class Detail {
 public:
  explicit Detail(int level) : level_(level) {}

  int level() const { return level_; }
  /// Return the number of sides or stacks at this level if level 0 has `most`, rounded down; at least 3 sides and
  /// 1 stack.
  int sides(int most) const;
  int stacks(int most) const;
  /// Returns the number of sides of a tree's bark, whose thin limbs have few at every level: most / (level + 1)^0.3.
  int bark_sides(int most) const;
  /// Returns the share of the organs that is kept: 1 / sqrt(level + 1).
  double organs() const;
  /// Returns the greatest number of triangles of the bark, if the finest level has `finest` and the share `seen` of
  /// it is visible. This is 1 / (level + 1)^0.65 of the visible part, and 1 / (2 (level + 1)) of the part hidden by
  /// leaves.
  std::uint64_t bark(std::uint64_t finest, double seen) const;
  /// Returns the share of the area covered by organs that may become uncovered.
  double loss() const { return 0.005 * level_; }
  /// Returns the greatest number of triangles of tubes that nothing hides: finest / sqrt(level + 1).
  std::uint64_t tubes(std::uint64_t finest) const {
    return static_cast<std::uint64_t>(static_cast<double>(finest) * organs());
  }
  /// Returns the greatest number of triangles of a level whose finer neighbour has `triangles`.
  static std::uint64_t fewer_than(std::uint64_t triangles) { return triangles * 89 / 100; }

 private:
  int level_;
};

/// Some joints of limbs, in the same order, and for each original joint its new index (Limbs::none where
/// removed).
struct KeptLimbs {
  Limbs limbs;
  Array<std::uint32_t> new_index;
};

/// Keeps the joints whose entry in `stays` is not 0. The parent of a kept joint must be kept too.
KeptLimbs keep(const Limbs& limbs, const Array<std::uint8_t>& stays, Job& job);

/// Removes internodes that coincide with earlier ones (find_chains()). Their children move to the earlier
/// ones.
KeptLimbs without_repeats(const Limbs& limbs, int sides, Job& job);

/// Returns the greatest radius of all internodes.
float thickest(const Limbs& limbs);

}  // namespace seedmesh
