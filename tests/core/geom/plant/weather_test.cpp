#include "core/geom/plant/weather.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/geom/skeletons.h"

namespace seedmesh {
namespace {

double apart(const glm::vec3& a, const glm::vec3& b) { return std::sqrt(double{glm::dot(a - b, a - b)}); }

/// A level beam of one metre in `count` internodes, with a twig up at its end and a square leaf on the twig.
Skeleton beam(const Job& job, int count, float radius) {
  SkeletonMaker maker(job);
  std::uint32_t joint = maker.root({0, 0, 0});
  for (int i = 1; i <= count; ++i) {
    joint = maker.grow(joint, {static_cast<float>(i) / static_cast<float>(count), 0, 0}, {radius, radius});
  }
  const std::uint32_t twig = maker.branch(joint, {1, 0.1F, 0}, {0.2F * radius, 0.2F * radius});
  Skeleton skeleton(job);
  skeleton.limbs = std::move(maker.limbs);
  const glm::vec3 corners[] = {{1, 0.1F, 0}, {1.1F, 0.1F, 0}, {1.1F, 0.1F, 0.1F}, {1, 0.1F, 0.1F}};
  for (const glm::vec3& corner : corners) skeleton.outlines.vertex.push_back(corner);
  skeleton.outlines.outline.push_back({0, 4, 1, 0, twig});
  return skeleton;
}

class WeatherTest : public testing::Test {
 protected:
  double sag(const Weather& weather, float radius = 0.01F) {
    Skeleton skeleton = beam(job, 20, radius);
    bend(skeleton, weather, job);
    return -double{skeleton.limbs.position[20].y};
  }
  Job job{1, Job::Options{}};
};

TEST_F(WeatherTest, SagsLikeACantileverUnderSnow) {
  Weather snow;
  snow.snow = 1;
  const double area = 3.14159265358979 * 0.25e-8;
  const double uniform = 0.02 * 9.81 / (8 * 8e9 * area);                    // q l^4 / 8 E I
  const double at_end = 0.01 * 9.81 * (1.0 / 3 + 0.05 / 2) / (8e9 * area);  // F (l^3 / 3 + a l^2 / 2) / E I
  EXPECT_NEAR(sag(snow), uniform + at_end, 0.05 * (uniform + at_end))
      << "twenty hinges, each at the near end of its internode";
}

TEST_F(WeatherTest, BendsThinLimbsMoreThanThickOnes) {
  Weather snow;
  snow.snow = 1;
  EXPECT_GT(sag(snow, 0.01F), 6 * sag(snow, 0.02F)) << "r^4 in the stiffness, r in the load";
}

TEST_F(WeatherTest, CarriesTwigAndLeafAlong) {
  Skeleton skeleton = beam(job, 20, 0.01F);
  Weather storm;
  storm.snow = 30;
  storm.wind = {0, 0, 25};
  bend(skeleton, storm, job);
  const Limbs& limbs = skeleton.limbs;
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    const double length = i == 21 ? 0.1 : 0.05;
    EXPECT_NEAR(apart(limbs.position[i], limbs.position[limbs.parent[i]]), length, 1e-6) << i;
  }
  EXPECT_LT(apart(skeleton.outlines.vertex[0], limbs.position[21]), 1e-6) << "the leaf stays on its twig";
  EXPECT_NEAR(apart(skeleton.outlines.vertex[0], skeleton.outlines.vertex[2]), 0.1 * std::sqrt(2.0), 1e-6);
  EXPECT_GT(limbs.position[20].z, 0.01F);
  EXPECT_LT(limbs.position[20].y, -0.02F);
}

TEST_F(WeatherTest, NeverTurnsPastTheForce) {
  Weather avalanche;
  avalanche.snow = 1000;
  avalanche.stiffness = 1e3;
  Skeleton skeleton = beam(job, 20, 0.01F);
  bend(skeleton, avalanche, job);
  for (std::size_t i = 1; i <= 20; ++i) {
    EXPECT_GE(skeleton.limbs.position[i].x, -1e-4F) << "hangs, and does not swing through";
    EXPECT_LT(skeleton.limbs.position[i].y, skeleton.limbs.position[i - 1].y);
  }
}

TEST_F(WeatherTest, ChangesNothingWhenItIsCalm) {
  Skeleton skeleton = beam(job, 20, 0.01F);
  const Skeleton before = beam(job, 20, 0.01F);
  bend(skeleton, {}, job);
  EXPECT_TRUE(std::equal(before.limbs.position.begin(), before.limbs.position.end(),
                         skeleton.limbs.position.begin()));
}

TEST_F(WeatherTest, TakesAlongWhatBeganAfterAMove) {
  SkeletonMaker maker(job);
  const auto root = maker.root({0, 0, 0});
  const auto end = maker.grow(root, {1, 0, 0}, {0.01F, 0.01F});
  const auto loose = maker.root({1.5F, 0, 0});
  maker.grow(loose, {2, 0, 0}, {0.01F, 0.01F});
  Skeleton skeleton(job);
  skeleton.limbs = std::move(maker.limbs);
  for (const std::uint32_t anchor : {Limbs::none, Limbs::none, end, Limbs::none})
    skeleton.limbs.anchor.push_back(anchor);
  Weather snow;
  snow.snow = 1;
  bend(skeleton, snow, job);
  EXPECT_NEAR(apart(skeleton.limbs.position[1], skeleton.limbs.position[2]), 0.5, 1e-6);
  EXPECT_LT(skeleton.limbs.position[2].y, -1e-4F);
}

}  // namespace
}  // namespace seedmesh
