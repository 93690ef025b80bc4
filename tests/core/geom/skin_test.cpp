#include "core/geom/skin.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/base/math.h"
#include "tests/core/geom/skeletons.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

Job job_of(int threads = 1) { return Job(1, Job::Options{.threads = threads}); }

/// All barks as the primitives of one mesh, as they go into the file.
MeshMeasures measure_all(const std::vector<Bark>& barks) {
  std::vector<const Mesh*> primitives;
  for (const Bark& bark : barks) primitives.push_back(&bark.mesh);
  return measure(primitives);
}

Model model_of(std::vector<Bark> barks) {
  Model model;
  model.materials.resize(1);
  model.meshes.resize(1);
  for (Bark& bark : barks) {
    narrow(bark.mesh, job_of());
    model.meshes[0].primitives.push_back({std::move(bark.mesh), 0, {}});
  }
  return model;
}

bool same_bytes(const Mesh& a, const Mesh& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.bytes()) == 0);
  };
  return same(a.position, b.position) && same(a.normal, b.normal) && same(a.uv[0], b.uv[0]) &&
         same(a.index.wide, b.index.wide);
}

/// A limb through the points, all of one radius.
Limbs limb_through(const Job& job, const std::vector<glm::vec3>& points, float radius) {
  SkeletonMaker maker(job);
  std::uint32_t joint = maker.root(points[0]);
  for (std::size_t i = 1; i < points.size(); ++i) joint = maker.grow(joint, points[i], {radius, radius});
  return std::move(maker.limbs);
}

TEST(Skin, MakesAClosedCylinderOfOneInternode) {
  Job job = job_of();
  const auto barks = skin(limb_through(job, {{0, 0, 0}, {0, 2, 0}}, 0.1F), {.sides = 8}, job);
  ASSERT_THAT(barks, SizeIs(1));
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
  const MeshMeasures m = measure_all(barks);
  EXPECT_EQ(m.open_edges, 0U);
  EXPECT_EQ(m.triangles, 8U + 16U + 8U);
  const double cross_section = 4 * std::sqrt(2.0) / 2 * 0.1 * 0.1;  // of a regular octagon
  EXPECT_NEAR(m.volume, cross_section * (2 - 0.1 + 0.1 / 3), 1e-4);
  const Box box = bounds_of(barks[0].mesh.position.span());
  EXPECT_EQ(box.min.y, 0);
  EXPECT_EQ(box.max.y, 2);
}

TEST(Skin, GivesTextureCoordinatesInMetresWithOneSeam) {
  Job job = job_of();
  const auto barks = skin(limb_through(job, {{0, 0, 0}, {0, 2, 0}, {0, 5, 0}}, 0.25F), {.sides = 16}, job);
  glm::vec2 most{0};
  for (const glm::vec2& uv : barks[0].mesh.uv[0]) most = glm::max(most, uv);
  EXPECT_NEAR(most.x, 2 * math::pi * 0.25, 1e-5);
  EXPECT_NEAR(most.y, 5, 1e-5);
}

TEST(Skin, LeavesOutTextureCoordinatesAndTheirSeamOnRequest) {
  Job job = job_of();
  const auto barks =
      skin(limb_through(job, {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}}, 0.1F), {.sides = 20, .uv = false}, job);
  EXPECT_TRUE(barks[0].mesh.uv[0].empty());
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
  EXPECT_EQ(measure_all(barks).open_edges, 0U);
}

TEST(Skin, KeepsABendOfNinetyDegreesInOneTube) {
  Job job = job_of();
  for (int sides : {3, 4, 6, 8, 17}) {
    const auto side = static_cast<std::uint64_t>(sides);
    const auto barks =
        skin(limb_through(job, {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}}, 0.5F), {.sides = sides}, job);
    EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
    EXPECT_EQ(measure_all(barks).triangles, side * (1 + 2 + 2 + 1));
  }
}

TEST(Skin, KeepsStairsAndNarrowTurnsOfTurtleCurvesInOneTube) {
  Job job = job_of();
  const auto stairs = skin(limb_through(job, {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}}, 0.5F),
                           {.sides = 8}, job);
  EXPECT_THAT(faults(stairs[0].mesh), IsEmpty());
  EXPECT_EQ(measure_all(stairs).triangles, 8U * (1 + 2 * 4 + 1));
  const auto hairpin =
      skin(limb_through(job, {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}, 0.48F), {.sides = 8}, job);
  EXPECT_THAT(faults(hairpin[0].mesh), IsEmpty());
  EXPECT_EQ(measure_all(hairpin).triangles, 8U * (1 + 2 * 3 + 1));
}

TEST(Skin, ClosesTheTubeWhereALimbTurnsBack) {
  Job job = job_of();
  const auto barks = skin(limb_through(job, {{0, 0, 0}, {0, 1, 0}, {0.1F, 0, 0}}, 0.1F), {.sides = 8}, job);
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
  EXPECT_EQ(measure_all(barks).open_edges, 0U);
  EXPECT_EQ(measure_all(barks).triangles, 2 * 8U * (1 + 2 + 1));
}

TEST(Skin, EndsInAPointWhereTheRadiusIsZero) {
  Job job = job_of();
  SkeletonMaker maker(job);
  maker.grow(maker.root({0, 0, 0}), {0, 3, 0}, {0.5F, 0});
  const auto barks = skin(maker.limbs, {.sides = 7}, job);
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
  EXPECT_EQ(measure_all(barks).triangles, 7U + 7U);
  EXPECT_EQ(measure_all(barks).open_edges, 0U);
}

TEST(Skin, CutsTaperingInternodesIntoStacks) {
  Job job = job_of();
  SkeletonMaker maker(job);
  const std::uint32_t straight = maker.grow(maker.root({0, 0, 0}), {0, 1, 0}, {0.5F, 0.5F});
  maker.grow(straight, {0, 2, 0}, {0.5F, 0.2F});
  const auto barks = skin(maker.limbs, {.sides = 6, .stacks = 4}, job);
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
  EXPECT_EQ(measure_all(barks).triangles, 6U * (1 + 2 * (1 + 4) + 1));
}

TEST(Skin, TiltsNormalsWithTheCone) {
  Job job = job_of();
  SkeletonMaker maker(job);
  maker.grow(maker.root({0, 0, 0}), {0, 1, 0}, {1, 0});
  const auto barks = skin(maker.limbs, {.sides = 8}, job);
  const Mesh& mesh = barks[0].mesh;
  std::size_t on_flank = 0;
  for (std::size_t i = 0; i < mesh.normal.size(); ++i) {
    if (mesh.position[i].y == 0 && mesh.normal[i].y > 0) {
      EXPECT_NEAR(mesh.normal[i].y, std::sqrt(0.5), 1e-6);
      ++on_flank;
    }
  }
  EXPECT_EQ(on_flank, 9U);
}

TEST(Skin, PassesOverInternodesOfNoLengthAndOfNoRadius) {
  Job job = job_of();
  SkeletonMaker maker(job);
  std::uint32_t joint = maker.grow(maker.root({0, 0, 0}), {0, 1, 0}, {0.1F, 0.1F});
  joint = maker.grow(joint, {0, 1, 0}, {0.1F, 0.1F});
  joint = maker.grow(joint, {0, 2, 0}, {0.1F, 0.1F});
  joint = maker.grow(joint, {0, 3, 0}, {0, 0});
  const auto barks = skin(maker.limbs, {.sides = 8}, job);
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
  EXPECT_EQ(measure_all(barks).triangles, 8U * (1 + 2 * 2 + 1));
}

TEST(Skin, MakesNothingOfNothing) {
  Job job = job_of();
  EXPECT_THAT(skin(Limbs(job), {}, job), IsEmpty());
  EXPECT_THAT(skin(limb_through(job, {{1, 1, 1}}, 0.1F), {}, job), IsEmpty());
  EXPECT_THAT(skin(limb_through(job, {{1, 1, 1}, {1, 1, 1}}, 0.1F), {}, job), IsEmpty());
}

TEST(Skin, KeepsTubesThatBeginAtOnePlaceApart) {
  Job job = job_of();
  SkeletonMaker maker(job);
  const std::uint32_t fork = maker.grow(maker.root({0, 0, 0}), {0, 1, 0}, {0.1F, 0.1F});
  for (const glm::vec3 to :
       {glm::vec3{1, 1, 0}, {-1, 1, 0}, {0, 1, 1}, {0, 1, -1}, {0, 2, 0}, {0.5F, 1.5F, 0}}) {
    maker.branch(fork, to, {0.1F, 0.05F});
  }
  const auto barks = skin(maker.limbs, {.sides = 8}, job);
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
  EXPECT_EQ(measure_all(barks).open_edges, 0U);
}

TEST(Skin, SkinsAnInternodeDrawnTwiceOnce) {
  Job job = job_of();
  SkeletonMaker maker(job);
  const std::uint32_t foot = maker.grow(maker.root({0, 0, 0}), {0, 1, 0}, {0.1F, 0.1F});
  const std::uint32_t first = maker.branch(foot, {1, 2, 0}, {0.1F, 0.1F});
  const std::uint32_t second = maker.branch(foot, {1, 2, 0}, {0.1F, 0.1F});
  maker.grow(first, {2, 2, 0}, {0.1F, 0.1F});
  maker.grow(second, {1, 3, 0}, {0.1F, 0.1F});
  const std::uint32_t backwards = maker.branch(first, {0, 1, 0}, {0.1F, 0.1F});
  maker.grow(backwards, {-1, 1, 0}, {0.1F, 0.1F});
  const auto barks = skin(maker.limbs, {.sides = 8}, job);
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
  // trunk; first with what follows it; what follows the second; what follows the one drawn backwards
  EXPECT_EQ(measure_all(barks).triangles, 8U * (2 + 2) + 8U * (2 + 4) + 8U * (2 + 2) + 8U * (2 + 2));
}

TEST(Skin, GoesOverIntoAnotherColourWithoutAGap) {
  Job job = job_of();
  SkeletonMaker maker(job);
  maker.color = 3;
  const std::uint32_t joint = maker.grow(maker.root({0, 0, 0}), {0, 1, 0}, {0.1F, 0.1F});
  maker.color = 1;
  maker.grow(joint, {0.5F, 2, 0}, {0.1F, 0.1F});
  const auto barks = skin(maker.limbs, {.sides = 8}, job);
  ASSERT_THAT(barks, SizeIs(2));
  EXPECT_EQ(barks[0].color, 1);
  EXPECT_EQ(barks[1].color, 3);
  EXPECT_EQ(measure_all(barks).open_edges, 0U);
  EXPECT_THAT(faults(model_of(skin(maker.limbs, {.sides = 8}, job))), IsEmpty());
}

TEST(Skin, HasNoFaultOnThousandsOfRandomSkeletons) {
  Job job = job_of();
  Rng rng(77);
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const Limbs limbs = random_limbs(job, seed);
    const SkinOptions options{.sides = 3 + static_cast<int>(rng.below(14)),
                              .stacks = rng.below(3) ? 1 : 1 + static_cast<int>(rng.below(6)),
                              .uv = rng.below(4) != 0};
    auto barks = skin(limbs, options, job);
    EXPECT_EQ(measure_all(barks).open_edges, 0U) << "seed " << seed;
    EXPECT_THAT(faults(model_of(std::move(barks))), IsEmpty())
        << "seed " << seed << " sides " << options.sides;
  }
}

/// An outline in sight of the middle, its points at random distances from it.
Contour random_contour(Rng& rng) {
  const std::uint32_t count = 3 + rng.below(10);
  std::vector<glm::dvec2> outline;
  for (std::uint32_t i = 0; i < count; ++i) {
    const math::SinCos at = math::sincos(2 * math::pi * (i + rng.uniform(0, 0.4)) / count);
    outline.push_back(glm::dvec2(at.cos, at.sin) * rng.uniform(0.4, 0.99));
  }
  if (rng.below(2)) std::reverse(outline.begin(), outline.end());
  EXPECT_EQ(contour_fault(outline), std::nullopt);
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

TEST(Contour, NamesThePointAtWhichAnOutlineIsAtFault) {
  using Outline = std::vector<glm::dvec2>;
  EXPECT_EQ(contour_fault(Outline{{1, 0}, {0, 1}, {-1, -1}}), "point 2 lies outside the circle of radius 1");
  EXPECT_EQ(contour_fault(Outline{{1, 0}, {0.99, 0.005}, {-0.5, 0.5}, {0, -1}}),
            "point 0 is closer than 0.02 to the next");
  EXPECT_THAT(*contour_fault(Outline{{0.5, 0.5}, {0.9, 0.1}, {0.5, 0.4}, {0.2, 0.9}}),
              testing::HasSubstr("cannot be seen"));
  Outline twice;
  for (int i = 0; i < 10; ++i) {
    const math::SinCos at = math::sincos_degrees(72.0 * i + i);
    twice.emplace_back(at.cos * 0.9, at.sin * 0.9);
  }
  EXPECT_THAT(*contour_fault(twice), testing::HasSubstr("more than once"));
}

/// A straight limb whose frames roll by so many degrees from one joint to the next.
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
    return skin_triangles(rolling_limb(job, degrees, 3),
                          {.sides = 4, .stacks = stacks, .contours = contours});
  };
  EXPECT_EQ(triangles(0, 8), triangles(0, 1));
  EXPECT_EQ(triangles(10, 8), triangles(0, 1) + 4U * 7 * 8) << "four internodes twist";
  EXPECT_EQ(triangles(45, 1), triangles(0, 1) + 4U * 2 * 8) << "a ring for each 15 degrees";
}

TEST(Skin, HasNoFaultOnCurvesThatComeBackToTheirOwnCorners) {
  Job job = job_of();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    SkeletonMaker maker(job);
    Frame frame;
    std::uint32_t joint = maker.root({0, 0, 0});
    for (int i = 0; i < 3000; ++i) {
      frame = turn(frame, math::sincos_degrees(rng.below(2) ? 90 : -90));
      joint = maker.grow(joint, maker.limbs.position[joint] + glm::vec3(frame.heading), {0.1F, 0.1F});
    }
    const auto barks = skin(maker.limbs, {.sides = 6}, job);
    EXPECT_THAT(faults(barks[0].mesh), IsEmpty()) << "seed " << seed;
  }
}

TEST(Skin, CountsItsTrianglesBeforehand) {
  Job job = job_of();
  const Limbs spiral = [&] {
    SkeletonMaker maker(job);
    Frame frame;
    std::uint32_t joint = maker.root({0, 0, 0});
    for (int i = 0; i < 100; ++i) {
      frame = pitch(turn(frame, math::sincos(0.2)), math::sincos(0.1));
      joint = maker.grow(joint, maker.limbs.position[joint] + glm::vec3(frame.heading), {0.1F, 0.08F});
    }
    return std::move(maker.limbs);
  }();
  const SkinOptions options{.sides = 9, .stacks = 3};
  const std::uint64_t triangles = measure_all(skin(spiral, options, job)).triangles;
  EXPECT_EQ(skin_triangles(spiral, options), triangles);
  EXPECT_EQ(job.spent(Resource::triangles), triangles);
}

TEST(Skin, GivesTheSameBytesOnAnyNumberOfThreads) {
  Job one = job_of(1), eight = job_of(8);
  SkeletonMaker maker(one);
  Rng rng(5);
  std::vector<std::uint32_t> joints{maker.root({0, 0, 0})};
  for (int i = 0; i < 20000; ++i) {
    maker.color = static_cast<std::int16_t>(rng.below(3));
    const std::uint32_t parent = joints[rng.below(static_cast<std::uint32_t>(joints.size()))];
    const glm::dvec3 step{rng.uniform(-1, 1), rng.uniform(0, 1), rng.uniform(-1, 1)};
    const glm::vec3 to = maker.limbs.position[parent] + glm::vec3(step);
    joints.push_back(rng.below(2) ? maker.grow(parent, to, {0.02F, 0.01F})
                                  : maker.branch(parent, to, {0.02F, 0.01F}));
  }
  const auto a = skin(maker.limbs, {}, one), b = skin(maker.limbs, {}, eight);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(same_bytes(a[i].mesh, b[i].mesh));
}

TEST(Skin, RefusesMoreTrianglesThanAllowed) {
  Job job(1, Job::Options{.limits = {.triangles = 31}});
  const Limbs limbs = limb_through(job, {{0, 0, 0}, {0, 2, 0}}, 0.1F);
  EXPECT_THROW(skin(limbs, {.sides = 8}, job), Stop);
}

}  // namespace
}  // namespace seedmesh
