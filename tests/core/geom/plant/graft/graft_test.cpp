#include "core/geom/plant/graft/graft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/quick_math.h"
#include "core/geom/mesh/tangents.h"
#include "tests/core/geom/skeletons.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

/// A trunk with limbs in a spiral, each with twigs, of which some leave so flat that no collar fits.
Limbs spiral(const Job& job, double steepest) {
  SkeletonMaker maker(job);
  std::uint32_t trunk = maker.root({0, 0, 0});
  Rng rng(8);
  for (int i = 1; i <= 30; ++i) {
    const float height = 0.25F * static_cast<float>(i), radius = 0.2F * (1 - height / 9);
    trunk = maker.grow(trunk, {0, height, 0}, {radius + 0.006F, radius});
    const math::SinCos around = math::quick_sincos_degrees(137.5 * i);
    const math::SinCos lean = math::quick_sincos_degrees(rng.uniform(8, steepest));
    const glm::dvec3 along{around.cos * lean.sin, lean.cos, around.sin * lean.sin};
    const float thick = radius * static_cast<float>(rng.uniform(0.2, 0.9));
    glm::vec3 at = maker.limbs.position[trunk] + glm::vec3(along * 0.9);
    auto limb = maker.branch(trunk, at, {thick, 0.6F * thick});
    for (int k = 0; k < 4; ++k) {
      at += glm::vec3(along * 0.3) + glm::vec3(0, 0.05F, 0);
      limb = maker.grow(limb, at, {0.6F * thick, 0.5F * thick});
      maker.branch(limb, at + glm::vec3(0.2F * static_cast<float>(k - 1), 0.3F, 0.1F),
                   {0.2F * thick, 0.1F * thick});
    }
  }
  return std::move(maker.limbs);
}

TEST(Graft, MakesOneClosedSurfaceOfLimbsWithEnoughSpace) {
  Job job(1, Job::Options{});
  GraftCounts counts;
  const Mesh mesh = graft(spiral(job, 80), {}, job, &counts);
  EXPECT_TRUE(faults(mesh).empty());
  EXPECT_EQ(measure({&mesh}).open_edges, 0U);
  EXPECT_GT(counts.collars + counts.forks, 60U);
  EXPECT_GT(counts.closed, 0U) << "some leave too flat";
  EXPECT_EQ(counts.limbs, 1 + counts.collars + counts.forks + counts.closed);
}

/// How many pieces a surface has, its vertices welded by position.
std::size_t pieces_of(const Mesh& mesh) {
  std::map<std::tuple<float, float, float>, std::size_t> points;
  std::vector<std::size_t> stands_for;
  const auto find = [&](std::size_t i) {
    while (stands_for[i] != i) i = stands_for[i] = stands_for[stands_for[i]];
    return i;
  };
  const auto point = [&](std::uint32_t vertex) {
    const glm::vec3 p = mesh.position[vertex];
    const auto [place, is_new] = points.try_emplace({p.x, p.y, p.z}, stands_for.size());
    if (is_new) stands_for.push_back(stands_for.size());
    return place->second;
  };
  for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
    const std::size_t a = point(mesh.index.at(i)), b = point(mesh.index.at(i + 1)),
                      c = point(mesh.index.at(i + 2));
    stands_for[find(b)] = find(a);
    stands_for[find(c)] = find(a);
  }
  std::size_t pieces = 0;
  for (std::size_t i = 0; i < stands_for.size(); ++i) pieces += stands_for[i] == i ? 1U : 0U;
  return pieces;
}

TEST(Graft, HasOnePieceAndOneForEachLimbThatIsClosed) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Job job(seed, Job::Options{});
    GraftCounts counts;
    const Mesh mesh = graft(spiral(job, 30 + 10 * static_cast<double>(seed)), {}, job, &counts);
    const std::uint32_t roots = counts.limbs - counts.collars - counts.forks - counts.closed;
    EXPECT_EQ(pieces_of(mesh), roots + counts.closed + counts.fallen_back);
  }
}

/// A limb of three corners at a narrow angle: the mean of the normals of both surfaces looks away from its
/// long faces.
TEST(Graft, TurnsTheNormalsOfANarrowCollarRatherThanCloseIt) {
  Job job(1, Job::Options{});
  SkeletonMaker maker(job);
  std::uint32_t trunk = maker.root({0, 0, 0});
  std::size_t twigs = 0;
  for (int i = 1; i < 12; ++i) {
    const auto height = static_cast<float>(i);
    trunk = maker.grow(trunk, {0, height, 0}, {0.1F, 0.1F});
    if (i == 11) break;
    const float side = i % 2 ? 1.0F : -1.0F;
    maker.branch(trunk, glm::vec3{side * 1.2F, height + 1.5F, 0.1F}, {0.035F, 0.01F});
    ++twigs;
  }
  GraftCounts counts;
  const Mesh mesh = graft(maker.limbs, {}, job, &counts);
  EXPECT_TRUE(faults(mesh).empty());
  EXPECT_EQ(counts.collars, twigs);
  EXPECT_EQ(pieces_of(mesh), 1U);
}

/// Forks of like thickness from wide to narrow angles, at bends.
Limbs zigzag(const Job& job, double lean, double twist) {
  SkeletonMaker maker(job);
  std::uint32_t trunk = maker.root({0, 0, 0});
  glm::vec3 at{0};
  for (int i = 1; i < 12; ++i) {
    const math::SinCos way = math::quick_sincos_degrees(i % 2 ? lean : -lean);
    at += glm::vec3(0.6 * way.sin, 0.8 * way.cos, 0.02 * i);
    trunk = maker.grow(trunk, at, {0.1F, 0.1F});
    const math::SinCos side = math::quick_sincos_degrees(twist * i);
    maker.branch(trunk, at + glm::vec3(0.3 * side.cos, 1.3, 0.3 * side.sin), {0.06F, 0.03F});
  }
  return std::move(maker.limbs);
}

TEST(Graft, CreasesSharpForksRatherThanCloseThem) {
  std::uint32_t creases = 0, grown = 0, closed = 0;
  for (int lean = 0; lean <= 30; lean += 5) {
    for (int twist = 20; twist < 160; twist += 20) {
      Job job(1, Job::Options{});
      GraftCounts counts;
      const Mesh mesh = graft(zigzag(job, lean, twist), {}, job, &counts);
      ASSERT_TRUE(faults(mesh).empty()) << lean << ", " << twist;
      EXPECT_EQ(pieces_of(mesh), 1 + counts.closed + counts.fallen_back);
      creases += counts.creases;
      grown += counts.collars + counts.forks;
      closed += counts.closed;
    }
  }
  EXPECT_GT(creases, 0U);
  EXPECT_GT(grown, 3 * closed) << "the others find no room";
}

TEST(Graft, HasTangentsAsTheTrianglesWouldGiveThem) {
  for (const int lobes : {0, 5}) {
    Job job(1, Job::Options{});
    GraftOptions options;
    options.wrap = true;
    options.lobes = lobes;
    options.lobe_depth = 0.2F;
    options.tangents = true;
    Mesh mesh = graft(spiral(job, 80), options, job);
    ASSERT_EQ(mesh.tangent.size(), mesh.position.size());
    Array<glm::vec4> written = std::exchange(mesh.tangent, {});
    Model model;
    model.materials.emplace_back().normal_texture.texture = 0;
    model.meshes.emplace_back().primitives.push_back({std::move(mesh), 0, {}});
    add_tangents(model, job);
    const Mesh& summed = model.meshes[0].primitives[0].mesh;
    std::size_t near = 0, same_hand = 0;
    for (std::size_t i = 0; i < written.size(); ++i) {
      const glm::vec3 tangent(written[i]);
      ASSERT_NEAR(glm::length(tangent), 1, 1e-4);
      ASSERT_NEAR(glm::dot(tangent, summed.normal[i]), 0, 1e-3);
      near += glm::dot(tangent, glm::vec3(summed.tangent[i])) > 0.9F ? 1U : 0U;
      same_hand += written[i].w == summed.tangent[i].w ? 1U : 0U;
    }
    // Others are at tips, where the picture runs together, and on loops, where it bends.
    EXPECT_GT(near, written.size() * 8 / 10) << near << " of " << written.size();
    EXPECT_GT(same_hand, written.size() * 97 / 100) << same_hand << " of " << written.size();
  }
}

TEST(Graft, StaysSoundWhateverTheLimbsAre) {
  int made = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    Job job(seed, Job::Options{});
    GraftOptions options;
    options.overlaps = true;
    options.wrap = seed % 2;
    Array<std::uint32_t> joints(job);
    options.joints = seed % 3 ? &joints : nullptr;
    const Limbs limbs = random_limbs(job, seed);
    try {
      const Mesh mesh = graft(limbs, options, job);
      for (const std::string& fault : faults(mesh)) {
        // Limbs that are drawn twice begin with the same vertex.
        const bool is_drawn_twice = fault.find("duplicate vertices") != std::string::npos;
        EXPECT_TRUE(is_drawn_twice) << "seed " << seed << ": " << fault;
      }
      if (options.joints) {
        EXPECT_EQ(joints.size(), mesh.position.size());
        for (const std::uint32_t joint : joints) EXPECT_LT(joint, limbs.size());
      }
      made += mesh.position.empty() ? 0 : 1;
    } catch (const Stop& stop) {
      EXPECT_EQ(stop.issue().kind, IssueKind::evaluation);
    }
  }
  EXPECT_GT(made, 80);
}

template <class T>
bool are_same(const Array<T>& a, const Array<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

TEST(Graft, MakesTheSameOfAnyNumberOfThreads) {
  for (int i = 0; i < 12; ++i) {
    const auto made_by = [&](int threads, Array<std::uint32_t>& joints) {
      Job job(1, {.threads = threads});
      GraftOptions options;
      options.overlaps = i % 2;
      options.wrap = i % 3;
      options.lobes = i % 4 == 3 ? 5 : 0;
      options.lobe_depth = 0.05F;
      joints = Array<std::uint32_t>(job);
      if (i % 5) options.joints = &joints;
      Mesh mesh = graft(spiral(job, 12 + 6 * i), options, job);
      EXPECT_GT(job.spent(Resource::triangles), mesh.elements());
      return mesh;
    };
    Array<std::uint32_t> joints, other_joints;
    const Mesh one = made_by(1, joints);
    EXPECT_GT(one.elements(), 1000U);
    for (const int threads : {2, 3, 8}) {
      const Mesh other = made_by(threads, other_joints);
      EXPECT_TRUE(are_same(one.position, other.position)) << i << ", threads " << threads;
      EXPECT_TRUE(are_same(one.normal, other.normal)) << i << ", threads " << threads;
      EXPECT_TRUE(are_same(one.uv[0], other.uv[0])) << i << ", threads " << threads;
      EXPECT_TRUE(are_same(one.index.wide, other.index.wide)) << i << ", threads " << threads;
      EXPECT_TRUE(are_same(joints, other_joints)) << i << ", threads " << threads;
    }
  }
}

double volume_of(const Mesh& mesh) {
  double six = 0;
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    const glm::dvec3 a(mesh.position[mesh.index.at(i)]), b(mesh.position[mesh.index.at(i + 1)]),
        c(mesh.position[mesh.index.at(i + 2)]);
    six += glm::dot(a, glm::cross(b, c));
  }
  return six / 6;
}

TEST(Graft, HasTheVolumeOfAPrismAndAPyramid) {
  Job job(1, Job::Options{});
  GraftOptions options;
  for (const int sides : {4, 8, 24}) {
    options.sides = sides;
    const Mesh mesh = graft(limb_through(job, {{0, 0, 0}, {0, 5, 0}}, 0.5F), options, job);
    // The last radius of the limb is a cone.
    const double area = 0.5 * sides * 0.25 * math::sin(2 * math::pi / sides);
    EXPECT_NEAR(volume_of(mesh), area * (4.5 + 0.5 / 3), 1e-5);
  }
}

TEST(Graft, MakesATreeOfTwoLimbsThatIsTopologicallyASphere) {
  Job job(1, Job::Options{});
  SkeletonMaker maker(job);
  const std::uint32_t joint = maker.grow(maker.root({0, 0, 0}), {0, 3, 0}, {0.3F, 0.3F});
  maker.grow(joint, {0, 6, 0}, {0.3F, 0.2F});
  maker.branch(joint, {1.5F, 4.5F, 0}, {0.1F, 0.05F});
  GraftCounts counts;
  const Mesh mesh = graft(maker.limbs, {}, job, &counts);
  ASSERT_EQ(counts.collars, 1U);
  std::map<std::tuple<float, float, float>, std::size_t> points;
  for (const glm::vec3& p : mesh.position) points.try_emplace({p.x, p.y, p.z}, points.size());
  const std::size_t triangles = mesh.index.size() / 3;
  // V - E + F = 2, where 2 E = 3 F.
  EXPECT_EQ(2 * points.size(), triangles + 4);
}

TEST(Graft, WrapsUAWholeNumberOfTimesRoundALimb) {
  Job job(1, Job::Options{});
  SkeletonMaker maker(job);
  maker.grow(maker.root({0, 0, 0}), {0, 5, 0}, {0.5F, 0.3F});
  GraftOptions options;
  options.wrap = true;
  const Mesh mesh = graft(maker.limbs, options, job);
  float low = 0, high = 0;
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    if (mesh.normal[i].y < -0.5F) continue;  // the floor
    low = std::min(low, mesh.uv[0][i].x);
    high = std::max(high, mesh.uv[0][i].x);
  }
  EXPECT_NEAR(high - low, 3, 1e-4) << "once a metre of 3.14";
}

}  // namespace
}  // namespace seedmesh
