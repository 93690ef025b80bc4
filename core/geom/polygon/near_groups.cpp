#include "core/geom/polygon/near_groups.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/base/disjoint_sets.h"

namespace seedmesh {
namespace {

using glm::dvec3;

// Smaller groups are compared pair by pair.
constexpr std::size_t few = 12;
constexpr std::size_t comparisons_a_check = 50'000;

/// Cuts the points into groups along gaps of each axis in turn, and compares those of a group that has none.
class NearGroups {
 public:
  NearGroups(std::span<const dvec3> points, double reach, const Job& job)
      : points_(points), reach_(reach), job_(job), sets_(points.size()), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    cut(order_, 0, 0);
  }

  std::vector<std::uint32_t> take() {
    for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = sets_.of(i);
    return std::move(order_);
  }

 private:
  void count_comparisons(std::size_t count) {
    comparisons_ += count;
    if (comparisons_ < comparisons_a_check) return;
    comparisons_ = 0;
    job_.check();
  }

  /// `uncut` counts the axes in a row along which the group has no gap.
  void cut(std::span<std::uint32_t> group, int axis, int uncut) {
    count_comparisons(8 * group.size());
    if (group.size() < 2) return;
    if (group.size() <= few || uncut == 3) return compare(group);
    std::sort(group.begin(), group.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair{points_[a][axis], a} < std::pair{points_[b][axis], b};
    });
    std::size_t first = 0;
    const int next_axis = (axis + 1) % 3;
    for (std::size_t i = 1; i <= group.size(); ++i) {
      if (i < group.size() && !(points_[group[i]][axis] - points_[group[i - 1]][axis] > reach_)) continue;
      const bool is_whole = first == 0 && i == group.size();
      cut(group.subspan(first, i - first), next_axis, is_whole ? uncut + 1 : 0);
      first = i;
    }
  }

  bool are_near(std::uint32_t a, std::uint32_t b, double reach) const {
    const dvec3 apart = points_[a] - points_[b];
    return glm::dot(apart, apart) <= reach * reach;
  }

  void compare(std::span<std::uint32_t> group) {
    // Points within half the reach of the first are all near each other.
    const auto rest = std::stable_partition(group.begin() + 1, group.end(), [&](std::uint32_t i) {
      const bool is_near = are_near(group[0], i, 0.5 * reach_);
      if (is_near) sets_.join(group[0], i);
      return is_near;
    });
    for (auto a = rest; a != group.end(); ++a) {
      for (auto b = group.begin(); b != a; ++b) {
        if (are_near(*a, *b, reach_)) sets_.join(*a, *b);
      }
      count_comparisons(static_cast<std::size_t>(a - group.begin()));
    }
  }

  std::span<const dvec3> points_;
  double reach_;
  const Job& job_;
  DisjointSets sets_;
  std::vector<std::uint32_t> order_;
  std::size_t comparisons_ = 0;
};

}  // namespace

std::vector<std::uint32_t> near_groups(std::span<const dvec3> points, double reach, const Job& job) {
  return NearGroups(points, reach, job).take();
}

}  // namespace seedmesh
