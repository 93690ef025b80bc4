#pragma once
/// The implementation of coarsen(): coarse_limbs.cpp selects what to keep, coarse_limbs_write.cpp writes it.
#include <algorithm>
#include <limits>
#include <vector>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/geom/lod/coarse_limbs.h"
#include "core/geom/plant/chains.h"
#include "core/geom/plant/tube_formulas.h"

namespace seedmesh {

/// A cross-section of a limb at a joint.
struct Station {
  std::uint32_t joint = Limbs::none;
  glm::vec3 position{0};
  float radius = 0;
  float error = 0;    ///< area by which the outline changes without this station
  float corners = 3;  ///< corners of the ring at this station, for graft()
};

class Coarsening {
 public:
  Coarsening(const Limbs& limbs, const CoarseOptions& options, Job& job)
      : limbs_(limbs), options_(options), job_(job), chains_(link_chains(limbs, job)) {
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      if (limbs.parent[i] != Limbs::none) thickest_ = std::max(thickest_, limbs.base_radius[i]);
    }
    if (!options.skin) return;
    least_corners_ = least_sides_of(*options.skin);
    for (const std::uint32_t head : chains_.head)
      thickest_head_ = std::max(thickest_head_, first_radius(head));
  }

  CoarseLimbs run() {
    read();
    const float multiplier = multiplier_for(options_.triangles);
    count(multiplier);
    return write(multiplier);
  }

 private:
  static constexpr float forever = std::numeric_limits<float>::infinity();
  static constexpr std::size_t check_interval = 1024;
  // The least visible share assumed for hidden limbs. They show through gaps and where leaves are removed.
  static constexpr float least_shown = 0.08F;
  // The random factor of each limb's error differs from 1 by at most this.
  static constexpr float most_deviation = 0.2F;

  void read();
  void read_limb(std::uint32_t head);
  void simplify(std::size_t first, std::size_t last);
  float multiplier_for(std::uint64_t triangles);
  std::uint64_t count(float multiplier);
  struct LimbCost;
  LimbCost cost_of(std::size_t limb, int corners, float multiplier) const;
  LimbCost best_cost(std::size_t limb, float multiplier) const;
  static bool stays(const Station& station, float corners, float multiplier) {
    return station.error == forever || station.error > multiplier * 2 * corners;
  }
  bool stays(std::size_t limb, std::size_t station, float multiplier) const {
    return stays(stations_[station], corners_at(limb, station), multiplier);
  }
  bool must_stay(std::uint32_t joint, std::uint32_t next) const;
  CoarseLimbs write(float multiplier);
  void write_limb(std::size_t limb, float multiplier, CoarseLimbs& out, Array<std::uint32_t>& place);
  std::uint32_t add(std::size_t limb, std::uint32_t joint, std::uint32_t parent, CoarseLimbs& out) const;

  int corners(float radius, int sides) const { return corners_by_radius(radius, thickest_, sides); }
  float corners_at(std::size_t limb, std::size_t station) const {
    return options_.skin ? static_cast<float>(corners_[limb].current) : stations_[station].corners;
  }
  /// Returns the radius at the base of a limb.
  float first_radius(std::uint32_t head) const {
    const std::uint32_t joint = limbs_.parent[head] == Limbs::none ? chains_.next[head] : head;
    return joint == Limbs::none ? 0 : limbs_.base_radius[joint];
  }
  /// Returns the corners that the limb has at the finest level.
  LimbCorners finest_corners(std::uint32_t head) const {
    if (!options_.skin) return {};
    if (options_.was_grafted) {
      int own = std::max(least_corners_, corners(first_radius(head), options_.skin->sides));
      for (std::uint32_t joint = head; joint != Limbs::none; joint = chains_.next[joint]) {
        if (chains_.mark[joint] & fork) own = std::max(own, least_opened_corners);
      }
      own = std::min(own, options_.skin->sides);
      return {static_cast<std::uint8_t>(own), static_cast<std::uint8_t>(own)};
    }
    const auto sides = static_cast<std::uint8_t>(
        options_.skin->adapt ? sides_of_limb(*options_.skin, first_radius(head), thickest_head_)
                             : options_.skin->sides);
    return {sides, sides};
  }
  /// Returns the factor by which the radius grows so that a tube with fewer corners keeps its mean width. After
  /// Cauchy, the mean width of a convex outline is its circumference divided by pi.
  float widening(std::size_t limb, float radius) const {
    const auto round = [](int n) { return n * math::sin(math::pi / n); };
    const LimbCorners own =
        options_.skin ? corners_[limb]
                      : LimbCorners{static_cast<std::uint8_t>(corners(radius, options_.sides)),
                                    static_cast<std::uint8_t>(corners(radius, options_.finest_sides))};
    return own.current == own.finest ? 1.0F : static_cast<float>(round(own.finest) / round(own.current));
  }
  /// Returns the random factor of a limb. Without it, equal limbs would all be removed at the same multiplier.
  float random_factor(std::uint32_t head) const {
    const std::uint64_t hash = key_at(key_of(head), 0xFA70);
    return 1 + most_deviation * (static_cast<float>(hash >> 40U) * 0x1p-23F - 1);
  }
  std::uint64_t key_of(std::uint32_t joint) const { return limbs_.key.empty() ? joint : limbs_.key[joint]; }
  const glm::vec3& position_of(std::uint32_t joint) const {
    return options_.drawn.empty() ? limbs_.position[joint] : options_.drawn[joint];
  }
  float shown(std::uint32_t joint) const {
    return options_.shown.empty() ? 1.0F : std::max(least_shown, options_.shown[joint]);
  }
  std::size_t begin(std::size_t limb) const { return first_[limb]; }
  std::size_t end(std::size_t limb) const { return first_[limb + 1]; }

  const Limbs& limbs_;
  const CoarseOptions& options_;
  Job& job_;
  Chains chains_;
  float thickest_ = 0, thickest_head_ = 0;
  int least_corners_ = 3;
  /// Corners of each limb, for skin(), with the multiplier of the last count().
  std::vector<LimbCorners> corners_;
  std::vector<Station> stations_;      ///< limb by limb, each from its base
  std::vector<std::size_t> first_;     ///< first station of each limb; one more entry at the end
  std::vector<float> area_;            ///< visible area of each limb times its random factor
  std::vector<std::uint8_t> kept_;     ///< whether each limb is kept, with the multiplier of the last count()
  std::vector<std::uint8_t> is_fork_;  ///< 1 for each joint where a kept limb branches off
};

}  // namespace seedmesh
