#include "core/geom/plant/contour.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <optional>

#include "core/base/math.h"
#include "tests/core/geom/barks.h"
#include "tests/core/geom/skeletons.h"

namespace seedmesh {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

Job job_of() { return Job(1, Job::Options{.threads = 1}); }

TEST(Contour, NamesThePointWhereAnOutlineIsInvalid) {
  using Outline = std::vector<glm::dvec2>;
  EXPECT_EQ(contour_error(Outline{{1, 0}, {0, 1}, {-1, -1}}), "point 2 is outside the circle of radius 1");
  EXPECT_EQ(contour_error(Outline{{1, 0}, {0.99, 0.005}, {-0.5, 0.5}, {0, -1}}),
            "point 0 is closer than 0.02 to the next");
  EXPECT_THAT(*contour_error(Outline{{0.5, 0.5}, {0.9, 0.1}, {0.5, 0.4}, {0.2, 0.9}}),
              testing::HasSubstr("is not visible"));
  Outline twice;
  for (int i = 0; i < 10; ++i) {
    const math::SinCos at = math::sincos_degrees(72.0 * i + i);
    twice.emplace_back(at.cos * 0.9, at.sin * 0.9);
  }
  EXPECT_THAT(*contour_error(twice), testing::HasSubstr("more than once"));
}

/// An outline that is visible from the centre, with points at random distances from it.
Contour random_contour(Rng& rng) {
  const std::uint32_t count = 3 + rng.below(10);
  std::vector<glm::dvec2> outline;
  for (std::uint32_t i = 0; i < count; ++i) {
    const math::SinCos at = math::sincos(2 * math::pi * (i + rng.uniform(0, 0.4)) / count);
    outline.push_back(glm::dvec2(at.cos, at.sin) * rng.uniform(0.4, 0.99));
  }
  if (rng.below(2)) std::reverse(outline.begin(), outline.end());
  EXPECT_EQ(contour_error(outline), std::nullopt);
  return make_contour(outline);
}

TEST(Skin, IsClosedWhateverCrossSectionsItsLimbsHave) {
  Job job = job_of();
  Rng rng(78);
  for (std::uint64_t seed = 0; seed < 800; ++seed) {
    Limbs limbs = random_limbs(job, seed);
    const std::vector<Contour> contours{random_contour(rng), random_contour(rng)};
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      limbs.contour.push_back(static_cast<std::uint8_t>(rng.below(3)));
      Frame frame;
      for (int turns = 0; turns < 3; ++turns) {
        frame =
            roll(seedmesh::turn(frame, math::sincos(rng.uniform(-4, 4))), math::sincos(rng.uniform(-4, 4)));
      }
      limbs.frame.push_back(quaternion(frame));
    }
    const SkinOptions options{.sides = 12 + static_cast<int>(rng.below(12)),
                              .stacks = rng.below(3) ? 1 : 1 + static_cast<int>(rng.below(6)),
                              .uv = rng.below(4) != 0,
                              .contours = contours};
    const auto barks = skin(limbs, options, job);
    const MeshMeasures measures = measure_all(barks);
    EXPECT_EQ(measures.open_edges, 0U) << "seed " << seed;
    for (const Bark& bark : barks) {
      for (const glm::vec3& normal : bark.mesh.normal)
        ASSERT_NEAR(glm::dot(normal, normal), 1, 1e-4) << "seed " << seed;
    }
  }
}

TEST(Skin, KeepsEveryPointOfACrossSectionAndBlendsFromOneToTheNext) {
  Job job = job_of();
  const std::vector<glm::dvec2> square{{0.7, 0.7}, {-0.7, 0.7}, {-0.7, -0.7}, {0.7, -0.7}};
  const std::vector<Contour> contours{make_contour(square)};
  Limbs limbs = limb_through(job, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}, 1);
  for (const int contour : {1, 1, 0}) {
    limbs.contour.push_back(static_cast<std::uint8_t>(contour));
    limbs.frame.push_back(quaternion(Frame{}));
  }
  const auto barks = skin(limbs, {.sides = 8, .contours = contours}, job);
  ASSERT_THAT(barks, SizeIs(1));
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
  const auto has = [&](const glm::vec3& place) {
    return std::any_of(barks[0].mesh.position.begin(), barks[0].mesh.position.end(),
                       [&](const glm::vec3& at) { return glm::dot(at - place, at - place) < 1e-10F; });
  };
  for (const float height : {0.0F, 1.0F}) {
    for (const glm::dvec2& corner : square) EXPECT_TRUE(has({corner.x, height, corner.y}));
  }
  for (const glm::vec3& at : barks[0].mesh.position) {  // the circle's ring stands below the tip's cone
    if (at.y > 1.01F && at.y < 1.99F) {
      EXPECT_NEAR(at.x * at.x + at.z * at.z, 1, 1e-5);
    }
  }
}

/// A straight limb whose frames roll by `degrees` from one joint to the next.
Limbs rolling_limb(const Job& job, double degrees, float length) {
  SkeletonMaker maker(job);
  Frame frame;
  std::uint32_t joint = maker.root({0, 0, 0});
  for (int i = 0; i < 6; ++i) {
    if (i > 0) {
      if (i > 1) frame = roll(frame, math::sincos_degrees(degrees));
      joint = maker.grow(joint, maker.limbs.position[joint] + glm::vec3{0, length, 0}, {0.5F, 0.5F});
    }
    maker.limbs.contour.push_back(1);
    maker.limbs.frame.push_back(quaternion(frame));
  }
  return std::move(maker.limbs);
}

/// Corners of triangles whose normal looks away from the triangle.
int corners_looking_inward(const Mesh& mesh) {
  int count = 0;
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    const std::uint32_t corner[3] = {mesh.index.at(i), mesh.index.at(i + 1), mesh.index.at(i + 2)};
    const glm::vec3 face = glm::cross(mesh.position[corner[1]] - mesh.position[corner[0]],
                                      mesh.position[corner[2]] - mesh.position[corner[0]]);
    for (const std::uint32_t each : corner) count += glm::dot(face, mesh.normal[each]) < 0 ? 1 : 0;
  }
  return count;
}

TEST(Skin, ShowsNoInsideWhereAHollowCrossSectionTwists) {
  Job job = job_of();
  std::vector<glm::dvec2> star;
  for (int i = 0; i < 8; ++i) {
    const math::SinCos at = math::sincos_degrees(45 * i);
    star.emplace_back(at.cos * (i % 2 ? 0.2828 : 1), at.sin * (i % 2 ? 0.2828 : 1));
  }
  const std::vector<Contour> contours{make_contour(star)};
  for (const double degrees : {-45.0, -20.0, 8.0, 45.0}) {
    for (const float length : {0.6F, 3.0F}) {
      for (const int sides : {8, 16}) {
        for (const bool has_uv : {false, true}) {
          const auto barks = skin(rolling_limb(job, degrees, length),
                                  {.sides = sides, .uv = has_uv, .contours = contours}, job);
          ASSERT_THAT(barks, SizeIs(1));
          EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
          EXPECT_EQ(corners_looking_inward(barks[0].mesh), 0)
              << degrees << " degrees in " << length << " m by " << sides << " sides";
        }
      }
    }
  }
}

TEST(Skin, CutsATwistedInternodeIntoItsStacks) {
  Job job = job_of();
  const std::vector<glm::dvec2> square{{0.7, 0.7}, {-0.7, 0.7}, {-0.7, -0.7}, {0.7, -0.7}};
  const std::vector<Contour> contours{make_contour(square)};
  const auto triangles = [&](double degrees, int stacks) {
    return skin_count(rolling_limb(job, degrees, 3), {.sides = 4, .stacks = stacks, .contours = contours},
                      job)
        .triangles;
  };
  EXPECT_EQ(triangles(0, 8), triangles(0, 1));
  EXPECT_EQ(triangles(10, 8), triangles(0, 1) + 4U * 7 * 8) << "four internodes twist";
  EXPECT_EQ(triangles(45, 1), triangles(0, 1) + 4U * 2 * 8) << "a ring for each 15 degrees";
}

}  // namespace
}  // namespace seedmesh
