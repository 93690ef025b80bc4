#include "core/geom/plant/skin.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/base/math.h"
#include "tests/core/geom/barks.h"
#include "tests/core/geom/skeletons.h"
#include "tests/support/mesh_faults.h"
#include "tests/support/narrow.h"

namespace seedmesh {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

Job job_of(int threads = 1) { return Job(1, Job::Options{.threads = threads}); }

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

TEST(Skin, SeparatesTubesThatBeginAtOnePosition) {
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

TEST(Skin, HasNoDefectOnThousandsOfRandomSkeletons) {
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

TEST(Skin, HasNoDefectOnCurvesThatReturnToTheirOwnCorners) {
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
  EXPECT_EQ(skin_count(spiral, options, job).triangles, triangles);
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
