#include "core/geom/polygon/near_groups.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <set>

#include "core/base/rng.h"
#include "core/geom/polygon/segment_pairs.h"

namespace seedmesh {
namespace {

Job job_of() { return Job(1, Job::Options{}); }

/// The same by comparing all pairs until nothing changes.
std::vector<std::uint32_t> groups_by_pairs(const std::vector<glm::dvec3>& points, double reach) {
  std::vector<std::uint32_t> group(points.size());
  for (std::uint32_t i = 0; i < group.size(); ++i) group[i] = i;
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < points.size(); ++k) {
        const glm::dvec3 apart = points[i] - points[k];
        if (glm::dot(apart, apart) > reach * reach || group[i] <= group[k]) continue;
        group[i] = group[k];
        is_changed = true;
      }
    }
  }
  return group;
}

TEST(NearGroups, AreThoseOfAllPairs) {
  const Job job = job_of();
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Rng rng = Rng(3).at(seed);
    std::vector<glm::dvec3> points;
    const std::uint32_t count = rng.below(60);
    for (std::uint32_t i = 0; i < count; ++i) {
      // Positions of a coarse grid that are off by about the reach.
      const double x = rng.below(4) + rng.uniform(0, 0.02), y = rng.below(3) + rng.uniform(0, 0.02);
      points.emplace_back(x, y, seed % 2 == 0 ? 0 : rng.uniform(0, 0.02));
    }
    EXPECT_EQ(near_groups(points, 0.01, job), groups_by_pairs(points, 0.01)) << seed;
  }
}

double distance_between(const Segment& a, const Segment& b) {
  const auto cross = [](const glm::dvec2& u, const glm::dvec2& v) { return u.x * v.y - u.y * v.x; };
  const auto to_point = [](const Segment& s, const glm::dvec2& p) {
    const glm::dvec2 along = s.to - s.from;
    const double length = glm::dot(along, along);
    const double share = length > 0 ? std::clamp(glm::dot(p - s.from, along) / length, 0.0, 1.0) : 0;
    return glm::length(p - s.from - along * share);
  };
  const glm::dvec2 u = a.to - a.from, v = b.to - b.from;
  if (cross(u, b.from - a.from) * cross(u, b.to - a.from) < 0 &&
      cross(v, a.from - b.from) * cross(v, a.to - b.from) < 0)
    return 0;
  return std::min({to_point(a, b.from), to_point(a, b.to), to_point(b, a.from), to_point(b, a.to)});
}

TEST(SegmentPairs, AreAllThatAreNearInRisingOrder) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Rng rng = Rng(4).at(seed);
    std::vector<Segment> segments;
    const std::uint32_t count = 1 + rng.below(80);
    const double longest = seed % 3 == 0 ? 10 : 1;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double x = rng.uniform(-5, 5), y = seed % 5 == 0 ? 0 : rng.uniform(-5, 5);
      const double along = rng.uniform(-longest, longest),
                   up = seed % 5 == 0 ? 0 : rng.uniform(-longest, longest);
      segments.push_back({{x, y}, {x + along, y + up}});
    }
    const double reach = rng.uniform(0, 0.5);
    std::vector<std::pair<std::size_t, std::size_t>> found;
    each_near_pair(segments, reach, nullptr, [&](std::size_t i, std::size_t k) {
      found.emplace_back(i, k);
      return true;
    });
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end())) << seed;
    const std::set<std::pair<std::size_t, std::size_t>> set(found.begin(), found.end());
    EXPECT_EQ(set.size(), found.size()) << seed;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      for (std::size_t k = i + 1; k < segments.size(); ++k) {
        if (distance_between(segments[i], segments[k]) <= reach) {
          EXPECT_TRUE(set.count({i, k}) > 0) << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace seedmesh
