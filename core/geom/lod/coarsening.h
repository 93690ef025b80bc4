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
  float worth = 0;    ///< area by which the outline changes without this station
  float corners = 3;  ///< of the ring at this station, for graft()
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
    const float price = price_for(options_.triangles);
    count(price);
    return write(price);
  }

 private:
  static constexpr float forever = std::numeric_limits<float>::infinity();
  static constexpr std::size_t look_every = 1024;
  // Hidden limbs keep this share: they are visible through gaps, and where leaves are removed.
  static constexpr float least_shown = 0.08F;
  // A random factor of each limb's worth differs from 1 by at most this.
  static constexpr float most_favour = 0.2F;

  void read();
  void read_limb(std::uint32_t head);
  void simplify(std::size_t first, std::size_t last);
  float price_for(std::uint64_t triangles);
  std::uint64_t count(float price);
  struct Bill;
  Bill bill_of(std::size_t limb, int corners, float price) const;
  Bill best_bill(std::size_t limb, float price) const;
  static bool stays(const Station& station, float corners, float price) {
    return station.worth == forever || station.worth > price * 2 * corners;
  }
  bool stays(std::size_t limb, std::size_t station, float price) const {
    return stays(stations_[station], corners_at(limb, station), price);
  }
  bool must_stay(std::uint32_t joint, std::uint32_t next) const;
  CoarseLimbs write(float price);
  void write_limb(std::size_t limb, float price, CoarseLimbs& out, Array<std::uint32_t>& place);
  std::uint32_t add(std::size_t limb, std::uint32_t joint, std::uint32_t parent, CoarseLimbs& out) const;

  int corners(float radius, int sides) const { return corners_by_radius(radius, thickest_, sides); }
  float corners_at(std::size_t limb, std::size_t station) const {
    return options_.skin ? static_cast<float>(corners_[limb].now) : stations_[station].corners;
  }
  /// The radius at the base of a limb.
  float first_radius(std::uint32_t head) const {
    const std::uint32_t joint = limbs_.parent[head] == Limbs::none ? chains_.next[head] : head;
    return joint == Limbs::none ? 0 : limbs_.base_radius[joint];
  }
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
  /// The factor of the radius that gives a tube with fewer corners the mean width of the finest one. After
  /// Cauchy, the mean width of a convex outline is its circumference divided by pi.
  float widening(std::size_t limb, float radius) const {
    const auto round = [](int n) { return n * math::sin(math::pi / n); };
    const LimbCorners own =
        options_.skin ? corners_[limb]
                      : LimbCorners{static_cast<std::uint8_t>(corners(radius, options_.sides)),
                                    static_cast<std::uint8_t>(corners(radius, options_.finest_sides))};
    return own.now == own.finest ? 1.0F : static_cast<float>(round(own.finest) / round(own.now));
  }
  /// A random factor, so that equal limbs are not all removed at the same price.
  float favour_of(std::uint32_t head) const {
    const std::uint64_t hash = key_at(key_of(head), 0xFA70);
    return 1 + most_favour * (static_cast<float>(hash >> 40U) * 0x1p-23F - 1);
  }
  std::uint64_t key_of(std::uint32_t joint) const { return limbs_.key.empty() ? joint : limbs_.key[joint]; }
  const glm::vec3& place_of(std::uint32_t joint) const {
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
  std::vector<LimbCorners> corners_;   ///< for each limb, for skin(), at the price of the last count()
  std::vector<Station> stations_;      ///< limb by limb, each from its base
  std::vector<std::size_t> first_;     ///< first station of each limb; one more entry at the end
  std::vector<float> area_;            ///< for each limb its visible area
  std::vector<std::uint8_t> kept_;     ///< for each limb, at the price of the last count()
  std::vector<std::uint8_t> is_fork_;  ///< for each joint: 1 where a kept limb branches off
};

}  // namespace seedmesh
