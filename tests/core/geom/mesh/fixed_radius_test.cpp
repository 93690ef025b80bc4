#include "core/geom/mesh/fixed_radius.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/math.h"
#include "core/base/rng.h"

namespace seedmesh {
namespace {

constexpr float reach = 1e-5F;

Job job_of() { return Job(1, Job::Options{}); }

/// Of a lattice, a tenth of a metre apart, each moved a little.
std::vector<glm::vec3> scattered(int side, Rng& rng) {
  std::vector<glm::vec3> points;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        const glm::dvec3 off{rng.uniform(0, 0.5), rng.uniform(0, 0.5), rng.uniform(0, 0.5)};
        points.emplace_back(0.1 * (glm::dvec3(x, y, z) + off));
      }
    }
  }
  return points;
}

glm::vec3 direction(Rng& rng) {
  return math::unit(glm::vec3(static_cast<float>(rng.uniform(-1, 1)), static_cast<float>(rng.uniform(-1, 1)),
                              static_cast<float>(rng.uniform(-1, 1))),
                    {1, 0, 0});
}

TEST(NearOthers, AreNoneForDistantPoints) {
  Rng rng(3);
  const std::vector<glm::vec3> points = scattered(12, rng);
  const std::vector<std::uint8_t> twin(points.size(), 0);
  EXPECT_TRUE(near_others(points, twin, bounds_of(points), reach, job_of()).empty());
}

TEST(NearOthers, AreFoundWhereverTheBordersOfCellsLie) {
  Rng rng(4);
  std::vector<glm::vec3> points = scattered(12, rng);
  const std::size_t whole = points.size();
  for (std::size_t i = 0; i < whole; ++i) points.push_back(points[i] + direction(rng) * (0.9F * reach));
  const Array<std::uint8_t> near =
      near_others(points, std::vector<std::uint8_t>(points.size(), 0), bounds_of(points), reach, job_of());
  ASSERT_EQ(near.size(), points.size());
  EXPECT_EQ(std::count(near.begin(), near.end(), 1), static_cast<std::ptrdiff_t>(points.size()));
}

TEST(NearOthers, AreFewWhereFewAre) {
  Rng rng(5);
  std::vector<glm::vec3> points = scattered(12, rng);
  points.push_back(points[100] + direction(rng) * (0.5F * reach));
  points.push_back(points[200] + direction(rng) * (3 * reach));
  const Array<std::uint8_t> near =
      near_others(points, std::vector<std::uint8_t>(points.size(), 0), bounds_of(points), reach, job_of());
  ASSERT_EQ(near.size(), points.size());
  EXPECT_EQ(near[100], 1);
  EXPECT_EQ(near[points.size() - 2], 1);
  EXPECT_LT(std::count(near.begin(), near.end(), 1), 20);
}

TEST(NearOthers, AreNotTwins) {
  Rng rng(6);
  std::vector<glm::vec3> points = scattered(8, rng);
  std::vector<std::uint8_t> twin(points.size(), 0);
  for (std::size_t i = 0; i < 50; ++i) {
    points.push_back(points[i]);
    twin.push_back(1);
  }
  EXPECT_TRUE(near_others(points, twin, bounds_of(points), reach, job_of()).empty());
}

TEST(NearOthers, AreAllOfACluster) {
  Rng rng(7);
  std::vector<glm::vec3> points = scattered(8, rng);
  const std::size_t whole = points.size();
  for (int i = 0; i < 100; ++i) points.push_back(points[50] + direction(rng) * (0.4F * reach));
  const Array<std::uint8_t> near =
      near_others(points, std::vector<std::uint8_t>(points.size(), 0), bounds_of(points), reach, job_of());
  ASSERT_EQ(near.size(), points.size());
  EXPECT_EQ(std::count(near.begin() + static_cast<std::ptrdiff_t>(whole), near.end(), 1), 100);
}

TEST(NearOthers, AreTheSameForAnyNumberOfThreads) {
  Rng rng(8);
  std::vector<glm::vec3> points = scattered(42, rng);
  const std::size_t whole = points.size();
  ASSERT_GT(whole, 65'536U) << "enough points for several threads";
  for (std::size_t i = 0; i < whole; i += 100) points.push_back(points[i] + direction(rng) * (0.9F * reach));
  const std::vector<std::uint8_t> twin(points.size(), 0);
  const auto found_by = [&](int threads) {
    return near_others(points, twin, bounds_of(points), reach, Job(1, {.threads = threads}));
  };
  const Array<std::uint8_t> one = found_by(1);
  ASSERT_EQ(one.size(), points.size());
  for (std::size_t i = whole; i < points.size(); ++i) ASSERT_EQ(one[i], 1);
  for (std::size_t i = 0; i < whole; i += 100) ASSERT_EQ(one[i], 1);
  EXPECT_LT(std::count(one.begin(), one.end(), 1), static_cast<std::ptrdiff_t>(whole / 20));
  for (const int threads : {2, 3, 8}) {
    const Array<std::uint8_t> other = found_by(threads);
    EXPECT_TRUE(std::equal(one.begin(), one.end(), other.begin(), other.end())) << threads;
  }
}

}  // namespace
}  // namespace seedmesh
