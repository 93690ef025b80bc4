#pragma once
/// Levels of detail of a plant: the same skeleton skinned again with less, never a mesh made simpler, so that
/// all levels have one silhouette and all their promises. After Tunnel, "Puude genereerimine L-süsteemidega",
/// 2012, section 3.4.2: level i has the quality 1 / sqrt(i + 1), so that 32 sides and 6 stacks become 32, 22,
/// 18, 16, 14 and 6, 4, 3, 3, 2.
#include "core/base/job.h"
#include "core/geom/limbs.h"

namespace seedmesh {

constexpr int most_levels = 5;

class Detail {
 public:
  explicit Detail(int level) : level_(level) {}

  int level() const { return level_; }
  /// Of `most` at level 0, rounded down; at least 3 and 1.
  int sides(int most) const;
  int stacks(int most) const;
  /// Of a tree's bark, whose thin limbs have few at every level: most / (level + 1)^0.3.
  int bark_sides(int most) const;
  /// The share of the organs that stays: 1 / sqrt(level + 1).
  double organs() const;
  /// How many triangles the bark may have, the finest level having `finest`: 1 / (level + 1)^0.65 of what is
  /// seen of it, the share `seen`, and half of 1 / (level + 1) of what is hidden by leaves.
  std::uint64_t bark(std::uint64_t finest, double seen) const;
  /// The share of what the organs cover that may be bare where more of them stay for it.
  double loss() const { return 0.005 * level_; }
  /// The same for tubes that nothing hides and that hardly become simpler: 1 / sqrt(level + 1).
  std::uint64_t tubes(std::uint64_t finest) const {
    return static_cast<std::uint64_t>(static_cast<double>(finest) * organs());
  }
  /// The most that a level may have after one of so many.
  static std::uint64_t fewer_than(std::uint64_t triangles) { return triangles * 89 / 100; }

 private:
  int level_;
};

/// The joints whose `stays` is not 0, in their order, and the new number of each old joint (`none` of those
/// that go). Who stays must have a parent that does.
struct KeptLimbs {
  Limbs limbs;
  Array<std::uint32_t> new_place;
};
KeptLimbs keep(const Limbs& limbs, const Array<std::uint8_t>& stays, Job& job);

/// Limbs without the internodes that lie on earlier ones (find_chains()); what grew from those grows from
/// these.
KeptLimbs without_repeats(const Limbs& limbs, int sides, Job& job);

/// The greatest radius of an internode.
float thickest(const Limbs& limbs);

}  // namespace seedmesh
