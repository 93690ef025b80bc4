#include "core/geom/plant/foliage_shade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/job.h"

namespace seedmesh {
namespace {

Job job_of() { return Job(1, Job::Options{}); }

/// A block of leaves of the size of a metre, `layers` high, with one leaf of `area` in each cubic metre.
Organs block_of(int side, int layers, const Job& job) {
  Organs organs(job);
  for (int y = 0; y < layers; ++y) {
    for (int z = 0; z < side; ++z) {
      for (int x = 0; x < side; ++x) {
        Organ organ;
        organ.position = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
        organ.key = static_cast<std::uint64_t>(x + 100 * (y + 100 * z));
        organs.organ.push_back(organ);
      }
    }
  }
  return organs;
}

/// Beer's law: a column of leaf area index L passes exp(-0.35 L).
TEST(FoliageShade, DarkensALeafByTheLeavesBetweenItAndTheSky) {
  const Job job = job_of();
  const Limbs limbs(job);
  const Organs organs = block_of(17, 17, job);
  FoliageShade::Options options;
  options.occlusion = 1;
  options.leaf_area = 0.1F;
  const FoliageShade shade(limbs, organs, options, job);
  // Cells are one metre wide, except the last, which holds two leaves of each row. Half of the own layer counts.
  const float top = shade.light_at({8, 16, 8}), bottom = shade.light_at({8, 0, 8});
  EXPECT_GT(top, 0.9F);
  EXPECT_LE(top, 1.0F);
  const double straight = std::exp(-0.35 * 16.5 * 0.1), slanted = std::exp(-0.35 * 8 * 1.4142 * 0.1);
  EXPECT_NEAR(static_cast<double>(bottom), (2 * straight + 4 * slanted) / 6, 0.06);
  float before = bottom;
  for (int y = 1; y <= 16; ++y) {
    const float here = shade.light_at({8, static_cast<float>(y), 8});
    EXPECT_GE(here, before - 1e-6F) << y;
    before = here;
  }
}

TEST(FoliageShade, LeavesNoLessThanTheShareOfTheOptions) {
  const Job job = job_of();
  const Limbs limbs(job);
  const Organs organs = block_of(17, 17, job);
  FoliageShade::Options options;
  options.occlusion = 0.55F;
  options.leaf_area = 50;
  const FoliageShade shade(limbs, organs, options, job);
  for (const Organ& organ : organs.organ) {
    ASSERT_GE(shade.light_at(organ.position), 0.45F - 1e-5F);
    ASSERT_GE(shade.color_of(organ) & 0xFFU, 114U);
    ASSERT_EQ(shade.color_of(organ) >> 24U, 255U);
  }
}

double hue_of(const glm::dvec3& c) {
  return std::atan2(std::sqrt(3.0) * (c.y - c.z), 2 * c.x - c.y - c.z) * 180 / 3.14159265358979;
}

/// The hue of leaves that are not withered, in degrees. `even` has hardly any difference but for those.
std::vector<double> hues_of(const FoliageShade& shade, const FoliageShade& even, const Organs& organs,
                            const glm::vec3& color) {
  std::vector<double> hues;
  for (const Organ& organ : organs.organ) {
    if ((even.color_of(organ) >> 8U & 0xFFU) < 200) continue;
    const std::uint32_t word = shade.color_of(organ);
    const glm::dvec3 factor(word & 0xFFU, word >> 8U & 0xFFU, word >> 16U & 0xFFU);
    hues.push_back(hue_of(glm::dvec3(color) * factor));
  }
  return hues;
}

double deviation_of(const std::vector<double>& values) {
  double mean = 0, square = 0;
  for (const double each : values) mean += each / static_cast<double>(values.size());
  for (const double each : values)
    square += (each - mean) * (each - mean) / static_cast<double>(values.size());
  return std::sqrt(square);
}

/// A trunk with `count` limbs, each with four twigs.
Limbs limbs_of(int count, const Job& job) {
  Limbs limbs(job);
  const auto add = [&](std::uint32_t parent, bool starts, std::uint16_t order) {
    limbs.position.push_back({0, static_cast<float>(limbs.size()), 0});
    limbs.parent.push_back(parent);
    limbs.starts_limb.push_back(starts ? 1 : 0);
    limbs.order.push_back(order);
    limbs.key.push_back(limbs.position.size());
    return static_cast<std::uint32_t>(limbs.position.size() - 1);
  };
  const std::uint32_t root = add(Limbs::none, false, 0), trunk = add(root, false, 0);
  for (int i = 0; i < count; ++i) {
    const std::uint32_t limb = add(trunk, true, 1);
    for (int twig = 0; twig < 4; ++twig) add(limb, true, 2);
  }
  return limbs;
}

TEST(FoliageShade, VariesTheHueByLimbTwigAndLeaf) {
  const Job job = job_of();
  const Limbs limbs = limbs_of(200, job);
  Organs organs(job);
  for (std::uint32_t joint = 2; joint < limbs.size(); ++joint) {
    if (limbs.order[joint] != 2) continue;
    for (std::uint64_t leaf = 0; leaf < 8; ++leaf) {
      Organ organ;
      organ.limb_joint = joint;
      organ.key = joint * 8 + leaf + 17;
      organs.organ.push_back(organ);
    }
  }
  FoliageShade::Options options;
  options.hue = 4.7F;
  options.color = {0.107F, 0.254F, 0.042F};
  const FoliageShade shade(limbs, organs, options, job);
  options.hue = 1e-3F;
  const FoliageShade even(limbs, organs, options, job);
  // The hue sector of a rotation about the grey axis: the wanted deviation within the rounding to bytes.
  EXPECT_NEAR(deviation_of(hues_of(shade, even, organs, options.color)), 4.7, 0.7);
  Organs twig(job), limb(job);
  for (std::uint64_t leaf = 0; leaf < 2000; ++leaf) {
    Organ organ = organs.organ[0];
    organ.key = leaf;
    twig.organ.push_back(organ);
  }
  EXPECT_NEAR(deviation_of(hues_of(shade, even, twig, options.color)), 2.0, 0.3)
      << "3, 3 and 2 degrees together are 4.7";
}

TEST(FoliageShade, WithersOneLeafInFifty) {
  const Job job = job_of();
  const Limbs limbs = limbs_of(1, job);
  FoliageShade::Options options;
  options.hue = 1;
  options.color = {0.107F, 0.254F, 0.042F};
  int withered = 0;
  Organs organs(job);
  for (std::uint64_t leaf = 0; leaf < 20'000; ++leaf) {
    Organ organ;
    organ.key = leaf;
    organs.organ.push_back(organ);
  }
  const FoliageShade shade(limbs, organs, options, job);
  for (const Organ& organ : organs.organ) {
    if ((shade.color_of(organ) >> 8U & 0xFFU) < 180) ++withered;
  }
  EXPECT_NEAR(withered, 400, 80);
}

}  // namespace
}  // namespace seedmesh
