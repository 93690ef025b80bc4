#include "core/geom/plant/leaf_mesh.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/math.h"
#include "core/geom/plant/organs.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

using testing::IsEmpty;

constexpr LeafBuild builds[] = {LeafBuild::card, LeafBuild::cross, LeafBuild::curved,
                                LeafBuild::mesh, LeafBuild::twig,  LeafBuild::bunch};

Job job_of(int threads = 1) { return Job(1, Job::Options{.threads = threads}); }

TEST(LeafMesh, IsSoundForEveryShapeBuildAndCoarseness) {
  const Job job = job_of();
  for (int shape = 0; shape < leaf_shape_count; ++shape) {
    for (const LeafBuild build : builds) {
      std::size_t before = ~std::size_t{0};
      for (int coarseness = 0; coarseness < 5; ++coarseness) {
        LeafForm form;
        form.shape = static_cast<LeafShape>(shape);
        form.build = build;
        form.coarseness = coarseness;
        const Mesh mesh = leaf_mesh(form, job);
        const std::string what = std::string(leaf_shape_names()[static_cast<std::size_t>(shape)]) +
                                 ", build " + std::to_string(static_cast<int>(build)) + ", " +
                                 std::to_string(coarseness);
        EXPECT_THAT(faults(mesh), IsEmpty()) << what;
        EXPECT_GT(mesh.elements(), 0U) << what;
        EXPECT_LE(mesh.elements(), before) << what;
        before = mesh.elements();
        for (const glm::vec2& uv : mesh.uv[0]) {
          EXPECT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1) << what;
        }
      }
    }
  }
}

TEST(LeafMesh, IsSoundForTheStrongestFoldsAndBends) {
  const Job job = job_of();
  for (const LeafBuild build : builds) {
    for (const double droop : {-180.0, -165.0, -151.0, -120.0, 120.0, 151.0, 180.0}) {
      for (const double fold : {-80.0, -40.0, 0.0, 15.0, 40.0, 80.0}) {
        for (int coarseness = 0; coarseness < 5; ++coarseness) {
          LeafForm form;
          form.build = build;
          form.droop = math::radians(droop);
          form.fold = math::radians(fold);
          form.coarseness = coarseness;
          EXPECT_THAT(faults(leaf_mesh(form, job)), IsEmpty())
              << static_cast<int>(build) << ", " << droop << ", " << fold << ", " << coarseness;
        }
      }
    }
  }
}

TEST(LeafMesh, IsOneLongAndFlatWhereItIsNeitherFoldedNorBent) {
  const Job job = job_of();
  LeafForm form;
  form.fold = form.droop = 0;
  const Box box = bounds_of(leaf_mesh(form, job).position.span());
  EXPECT_NEAR(box.min.y, 0, 1e-6);
  EXPECT_NEAR(box.max.y, 1, 1e-6);
  EXPECT_NEAR(box.max.z, 0, 1e-6);
}

TEST(LeafMesh, TiltsBothSquaresOfACross) {
  const Job job = job_of();
  LeafForm form;
  form.build = LeafBuild::cross;
  form.tilt = math::radians(60);
  const Mesh mesh = leaf_mesh(form, job);
  ASSERT_EQ(mesh.normal.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    // cos 60 degrees is 1/2, sin 60 degrees is the root of 3/4.
    EXPECT_NEAR(mesh.normal[i].z, 0.5, 1e-6);
    EXPECT_NEAR(mesh.normal[i].x, (i < 4 ? 1 : -1) * std::sqrt(0.75), 1e-6);
    EXPECT_NEAR(glm::dot(mesh.normal[i], mesh.position[i]), 0, 1e-6) << "both squares contain the axis";
  }
  EXPECT_THAT(faults(mesh), IsEmpty());
}

TEST(LeafMesh, HasTheAreaOfItsOutline) {
  const Job job = job_of();
  LeafForm form;
  form.shape = LeafShape::kite;
  form.fold = form.droop = 0;
  const Mesh mesh = leaf_mesh(form, job);
  EXPECT_NEAR(measure({&mesh}).area, 0.35, 1e-5);  // half of 0.7 by 1
}

TEST(FruitMesh, IsClosedAndTurnedOutside) {
  const Job job = job_of();
  for (const double pointed : {0.0, 0.5, 1.0}) {
    const Mesh mesh = fruit_mesh({.pointed = pointed}, job);
    EXPECT_THAT(faults(mesh), IsEmpty());
    const MeshMeasures m = measure({&mesh});
    EXPECT_EQ(m.open_edges, 0U);
    EXPECT_GT(m.volume, 0.1);
  }
}

TEST(BallMesh, IsASphereAboutTheOrigin) {
  const Job job = job_of();
  const Mesh mesh = ball_mesh(24, job);
  EXPECT_THAT(faults(mesh),
              ::testing::Each(::testing::HasSubstr("cache misses")));  // finish() sets the order
  for (const glm::vec3& p : mesh.position) EXPECT_NEAR(glm::length(p), 0.5, 1e-6);
  const MeshMeasures m = measure({&mesh});
  EXPECT_EQ(m.open_edges, 0U);
  EXPECT_NEAR(m.volume, 3.14159265 / 6, 0.03);
}

TEST(DiscMesh, HasTheAreaOfItsPolygon) {
  const Job job = job_of();
  const Mesh mesh = disc_mesh(16, job);
  EXPECT_THAT(faults(mesh), IsEmpty());
  EXPECT_NEAR(measure({&mesh}).area, 0.5 * 16 * 0.25 * std::sin(2 * 3.14159265358979 / 16), 1e-6);
}

/// A flat patch of unit size in the xy plane.
std::vector<glm::vec3> flat_patch() {
  std::vector<glm::vec3> points;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      points.push_back({static_cast<float>(column) / 3, static_cast<float>(row) / 3, 0});
  }
  return points;
}

TEST(PatchMesh, PassesThroughTheCornersOfABezierPatch) {
  const Job job = job_of();
  const std::vector<glm::vec3> points = flat_patch();
  const Mesh mesh = patch_mesh({points, PatchBasis::bezier, 4}, job);
  EXPECT_THAT(faults(mesh), IsEmpty());
  EXPECT_EQ(mesh.elements(), 32U);
  const Box box = bounds_of(mesh.position.span());
  EXPECT_NEAR(box.max.x, 1, 1e-6);
  EXPECT_NEAR(box.max.y, 1, 1e-6);
  for (const glm::vec3& normal : mesh.normal) EXPECT_NEAR(normal.z, 1, 1e-6);
}

TEST(PatchMesh, LiesInsideTheControlPointsOfABSpline) {
  const Job job = job_of();
  const std::vector<glm::vec3> points = flat_patch();
  const Box box = bounds_of(patch_mesh({points, PatchBasis::b_spline, 4}, job).position.span());
  EXPECT_NEAR(box.min.x, 1.0 / 3, 1e-6);
  EXPECT_NEAR(box.max.x, 2.0 / 3, 1e-6);
}

TEST(PatchMesh, LeavesOutWhatIsDrawnTogetherToAPoint) {
  const Job job = job_of();
  std::vector<glm::vec3> points = flat_patch();
  for (int column = 0; column < 4; ++column) points[static_cast<std::size_t>(column)] = {0.5F, 0, 0};
  const Mesh mesh = patch_mesh({points, PatchBasis::bezier, 4}, job);
  EXPECT_THAT(faults(mesh), IsEmpty());
  EXPECT_EQ(mesh.elements(), 28U);
}

/// Leaves in all directions on a ball of radius 2.
Organs leaves_on_a_ball(const Job& job, int count) {
  Organs organs(job);
  for (int i = 0; i < count; ++i) {
    const math::SinCos round = math::sincos(2.4 * i);
    const double y = 1 - 2 * (i + 0.5) / count, flat = std::sqrt(1 - y * y);
    Organ organ;
    organ.position = 2.0F * glm::vec3(flat * round.cos, y, flat * round.sin);
    organ.frame = glm::quat(static_cast<float>(round.cos), 0, static_cast<float>(round.sin), 0);
    organ.scale = glm::vec3(0.1F);
    organs.organ.push_back(organ);
  }
  return organs;
}

TEST(PlaceOrgans, CopiesSurfacesWithoutDefects) {
  Job one = job_of(1), more = job_of(4);
  const Organs organs = leaves_on_a_ball(one, 2000);
  std::vector<Mesh> surfaces;
  surfaces.push_back(leaf_mesh({}, one));
  FoliageOptions options;
  options.surfaces = surfaces;
  options.model_size = 4;
  const std::vector<Foliage> foliage = place_organs(organs, options, one);
  ASSERT_EQ(foliage.size(), 1U);
  EXPECT_THAT(faults(foliage[0].mesh), IsEmpty());
  EXPECT_EQ(foliage[0].mesh.elements(), 2000 * surfaces[0].elements());
  const std::vector<Foliage> again = place_organs(organs, options, more);
  EXPECT_EQ(0, std::memcmp(foliage[0].mesh.position.data(), again[0].mesh.position.data(),
                           again[0].mesh.position.bytes()));
}

TEST(PlaceOrgans, TurnsNormalsTowardTheCrownButNeverOverTheEdge) {
  Job job = job_of();
  const Organs organs = leaves_on_a_ball(job, 500);
  std::vector<Mesh> surfaces;
  surfaces.push_back(leaf_mesh({}, job));
  FoliageOptions options;
  options.surfaces = surfaces;
  options.model_size = 4;
  options.crown = glm::vec3(0);
  const std::vector<Foliage> foliage = place_organs(organs, options, job);
  EXPECT_THAT(faults(foliage[0].mesh), IsEmpty());
  double along = 0;
  for (std::size_t i = 0; i < foliage[0].mesh.position.size(); ++i) {
    along +=
        std::abs(glm::dot(foliage[0].mesh.normal[i], math::unit(foliage[0].mesh.position[i], {0, 1, 0})));
  }
  EXPECT_GT(along / static_cast<double>(foliage[0].mesh.position.size()), 0.8);
}

TEST(PlaceOrgans, SkipsDuplicatesAndOrgansThatAreTooSmall) {
  Job job = job_of();
  Organs organs = leaves_on_a_ball(job, 10);
  organs.organ.push_back(Organ(organs.organ[3]));
  organs.organ.push_back(Organ(organs.organ[4]));
  organs.organ.back().scale = glm::vec3(1e-5F);
  std::vector<Mesh> surfaces;
  surfaces.push_back(leaf_mesh({}, job));
  FoliageOptions options;
  options.surfaces = surfaces;
  options.model_size = 4;
  EXPECT_EQ(place_organs(organs, options, job)[0].mesh.elements(), 10 * surfaces[0].elements());
  EXPECT_EQ(organ_transforms(organs, options, job)[0].transforms.size(), 10U);
}

}  // namespace
}  // namespace seedmesh
