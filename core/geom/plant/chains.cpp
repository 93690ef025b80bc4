#include "core/geom/plant/chains.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/geom/mesh/point_grid.h"

namespace seedmesh {
namespace {

// The size of a cell, of the model's diagonal. Not a simple fraction: points of a lattice are not on borders.
constexpr float cell_share = 2.9371e-6F;
// At most this number of internodes at one position is compared.
constexpr int most_compared = 64;
// The slots of this number of joints are prefetched together.
constexpr std::size_t batch = 64;

class ChainFinder {
 public:
  ChainFinder(const Limbs& limbs, const Scale& scale, Job& job, Chains& chains)
      : limbs_(limbs),
        chains_(chains),
        grid_(scale.box, scale.size * cell_share),
        table_(job, limbs.size()),
        same_position_(job, limbs.size()),
        stands_for_(job, limbs.size()),
        near_squared_(square(scale.size * cell_share)),
        short_squared_(square(scale.shortest)) {}

  Array<std::uint32_t> take_originals() { return std::move(stands_for_); }

  void add_all(Job& job) {
    std::array<std::uint64_t, batch> keys{};
    for (std::size_t first = 0; first < limbs_.size(); first += batch) {
      if (first % 4096 == 0) job.check();
      const std::size_t count = std::min(batch, limbs_.size() - first);
      for (std::size_t i = 0; i < count; ++i) {
        keys[i] = grid_.key(limbs_.position[first + i]);
        table_.expect(keys[i]);
      }
      for (std::size_t i = 0; i < count; ++i) add(static_cast<std::uint32_t>(first + i), keys[i]);
    }
  }

 private:
  static float square(float x) { return x * x; }

  void add(std::uint32_t joint, std::uint64_t key) {
    stands_for_[joint] = joint;
    if (limbs_.parent[joint] == Limbs::none) {
      chains_.head.push_back(joint);
      link_position(joint, table_[key]);
      return;
    }
    const std::uint32_t from = stands_for_[limbs_.parent[joint]];
    const glm::vec3 step = limbs_.position[joint] - limbs_.position[from];
    if (glm::dot(step, step) > short_squared_) {
      std::uint32_t& first = table_[key];
      if (first != Limbs::none) {
        const std::uint32_t same = internode_between(first, limbs_.position[from], joint);
        if (same != Limbs::none) {
          chains_.mark[joint] |= drawn_before;
          stands_for_[joint] = same;
          return;
        }
        if (is_drawn_backwards(from, joint)) chains_.mark[joint] |= drawn_before;
      }
      link_position(joint, first);
    }
    if (!limbs_.starts_limb[joint] && chains_.next[from] == Limbs::none) {
      chains_.next[from] = joint;
    } else {
      chains_.head.push_back(joint);
      chains_.mark[from] |= fork;
    }
  }

  void link_position(std::uint32_t joint, std::uint32_t& first) {
    if (first == Limbs::none) {
      first = joint;
      same_position_[joint] = Limbs::none;
    } else {
      same_position_[joint] = same_position_[first];
      same_position_[first] = joint;
      chains_.mark[joint] |= revisit;
    }
  }

  /// A joint in the list of `first` whose internode comes from `start` with the radii of `like`, or none.
  std::uint32_t internode_between(std::uint32_t first, const glm::vec3& start, std::uint32_t like) const {
    std::uint32_t joint = first;
    for (int i = 0; i < most_compared && joint != Limbs::none; ++i, joint = same_position_[joint]) {
      if (begins_at(joint, start) && limbs_.radius[joint] == limbs_.radius[like] &&
          limbs_.base_radius[joint] == limbs_.base_radius[like]) {
        return joint;
      }
    }
    return Limbs::none;
  }

  bool is_drawn_backwards(std::uint32_t from, std::uint32_t joint) {
    std::uint32_t other = table_.peek(grid_.key(limbs_.position[from]));
    for (int i = 0; i < most_compared && other != Limbs::none; ++i, other = same_position_[other]) {
      if (begins_at(other, limbs_.position[joint]) && limbs_.radius[other] == limbs_.base_radius[joint] &&
          limbs_.base_radius[other] == limbs_.radius[joint]) {
        return true;
      }
    }
    return false;
  }

  bool begins_at(std::uint32_t joint, const glm::vec3& start) const {
    if (limbs_.parent[joint] == Limbs::none) return false;
    const glm::vec3 apart = limbs_.position[limbs_.parent[joint]] - start;
    return glm::dot(apart, apart) < near_squared_;
  }

  const Limbs& limbs_;
  Chains& chains_;
  PointGrid grid_;
  NumberTable table_;
  Array<std::uint32_t> same_position_;  ///< lists of joints; the first of each list is in the table
  Array<std::uint32_t> stands_for_;     ///< the joint itself, or the first that it coincides with
  float near_squared_, short_squared_;
};

Chains empty_chains(const Limbs& limbs, const Job& job) {
  return {Array<std::uint32_t>(job, limbs.size(), Limbs::none), Array<std::uint32_t>(job),
          Array<std::uint8_t>(job, limbs.size(), std::uint8_t{0})};
}

}  // namespace

Scale scale_of(const Limbs& limbs, int sides) {
  Scale scale;
  scale.box = bounds_of(limbs.position.span());
  float thickest = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] != Limbs::none)
      thickest = std::max({thickest, limbs.radius[i], limbs.base_radius[i]});
  }
  const glm::vec3 extent = scale.box.max - scale.box.min + 2 * thickest;
  scale.size = std::sqrt(glm::dot(extent, extent));
  scale.apart = 4e-6F * scale.size;
  scale.shortest = 1e-5F * scale.size;
  scale.thinnest = scale.apart / static_cast<float>(2 * math::sin(math::pi / sides));
  return scale;
}

std::uint64_t too_thin(const Limbs& limbs, int sides) {
  const float thinnest = scale_of(limbs, sides).thinnest;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] != Limbs::none && std::max(limbs.base_radius[i], limbs.radius[i]) < thinnest) ++count;
  }
  return count;
}

Chains find_chains(const Limbs& limbs, const Scale& scale, Job& job) {
  Chains chains = empty_chains(limbs, job);
  ChainFinder(limbs, scale, job, chains).add_all(job);
  return chains;
}

Array<std::uint32_t> originals_of(const Limbs& limbs, const Scale& scale, Job& job) {
  Chains chains = empty_chains(limbs, job);
  ChainFinder finder(limbs, scale, job, chains);
  finder.add_all(job);
  return finder.take_originals();
}

Chains link_chains(const Limbs& limbs, Job& job) {
  Chains chains = empty_chains(limbs, job);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    const auto joint = static_cast<std::uint32_t>(i);
    const std::uint32_t from = limbs.parent[i];
    if (from != Limbs::none && !limbs.starts_limb[i] && chains.next[from] == Limbs::none) {
      chains.next[from] = joint;
      continue;
    }
    chains.head.push_back(joint);
    if (from != Limbs::none) chains.mark[from] |= fork;
  }
  return chains;
}

}  // namespace seedmesh
