#include <gmock/gmock.h>

#include <set>

#include "core/base/math.h"
#include "core/generators/building/collision.h"
#include "core/generators/building/hull.h"
#include "core/texture/paint.h"
#include "tests/core/building/rules.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::building {
namespace {

using testing::IsEmpty;

Model demanded(const BuildingParams& params, const Demand& demand) {
  Job job(1, Job::Options{});
  Result<Model> model = generate(params, context_of(job, demand));
  if (!model) {
    ADD_FAILURE() << model.error().issues.front().message;
    return {};
  }
  finish(*model, job);
  return std::move(*model);
}

const std::vector<Primitive>& shown(const Model& model, const Node& node, std::size_t level) {
  const int mesh =
      level == 0 || node.lods.empty() ? node.mesh : node.lods[std::min(level, node.lods.size()) - 1];
  return model.meshes[static_cast<std::size_t>(mesh)].primitives;
}

std::size_t triangles_of(const Model& model, std::size_t level) {
  std::size_t sum = 0;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    for (const Primitive& primitive : shown(model, node, level)) sum += primitive.mesh.elements();
  }
  return sum;
}

TEST(Levels, AreMadeByTheGrammarsOwnAttribute) {
  const BuildingParams params = with(
      "@Range(0, 2) attr lod = 0\nA --> case lod == 2: B. case lod == 1: split(x){ 5: B. }* else: split(x){ "
      "1: "
      "B. }*");
  const Model model = demanded(params, {.lods = 5});
  EXPECT_EQ(triangles_of(model, 0), 120U);
  EXPECT_EQ(triangles_of(model, 1), 24U);
  EXPECT_EQ(triangles_of(model, 2), 12U);
  EXPECT_EQ(model.nodes[1].lods.size(), 2U);  // its range has no more
  EXPECT_THAT(faults(model), IsEmpty());
  BuildingParams coarse = params;
  coarse.attributes["lod"] = 1.0;
  EXPECT_EQ(demanded(coarse, {.lods = 5}).nodes[1].lods.size(), 1U);
  // Without the attribute there is one level, made of nodes as ever.
  for (const Node& node : demanded(with("A --> split(x){ 5: B. }*"), {.lods = 3}).nodes)
    EXPECT_TRUE(node.lods.empty());
}

TEST(Sharing, GivesEveryBodyANodeOrMergesThemOnRequest) {
  const BuildingParams params = with("A --> split(x){ 1: B. }*");
  EXPECT_EQ(demanded(params, {.share_organs = true}).meshes.size(), 1U);  // one box, ten copies
  const Model merged = demanded(params, {.copies = CopyForm::merge});
  EXPECT_EQ(merged.meshes.size(), 2U);  // neighbours that touch are in different layers
  for (const Node& node : merged.nodes) EXPECT_TRUE(node.instances.transforms.empty());
  EXPECT_EQ(triangles_of(merged, 0), 120U);
  EXPECT_THAT(faults(merged), IsEmpty());
}

TEST(Levels, AreNoneOfValuesThatMakeNothingCoarser) {
  const auto levels = [](const char* rules) {
    const Model model = demanded(with(rules), {.lods = 4});
    EXPECT_THAT(faults(model), IsEmpty());
    std::size_t most = 0;
    for (const Node& node : model.nodes) most = std::max(most, 1 + node.lods.size());
    return most;
  };
  EXPECT_EQ(levels("attr lod = 0 A --> split(x){ 5: B. }*"), 1U);
  EXPECT_EQ(levels("attr lod = 0 A --> case lod < 2: split(x){ 5: B. }* else: B."), 2U);
}

TEST(Levels, OfBlueprintsGetCoarserAndKeepTheirExtent) {
  for (int i = 0; i <= static_cast<int>(BuildingBlueprint::warehouse); ++i) {
    const auto blueprint = static_cast<BuildingBlueprint>(i);
    BuildingParams params;
    params.blueprint = blueprint;
    params.size = {30, 0, 18};
    const Model model = demanded(params, {.lods = 3});
    const std::size_t full = triangles_of(model, 0), middle = triangles_of(model, 1),
                      mass = triangles_of(model, 2);
    EXPECT_GT(full, 2 * middle) << text_of(blueprint);
    EXPECT_GT(middle, 2 * mass) << text_of(blueprint);
    EXPECT_GT(mass, 10U);
    EXPECT_THAT(faults(model), IsEmpty());
    const auto top = [&](std::size_t level) {
      float high = 0;
      for (const Node& node : model.nodes) {
        if (node.mesh < 0) continue;
        for (const Primitive& primitive : shown(model, node, level))
          high = std::max(high, primitive.mesh.bounds.max.y);
      }
      return high;
    };
    EXPECT_NEAR(top(2), top(0), 0.35F * top(0));
  }
}

double volume_of_collision(const Model& model, std::vector<std::string>* names = nullptr) {
  double sum = 0;
  for (const Node& node : model.nodes) {
    if (node.collision == CollisionShape::none) continue;
    EXPECT_EQ(node.collision, CollisionShape::convex);
    if (names != nullptr) names->push_back(node.name);
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(node.mesh)].primitives[0].mesh;
    EXPECT_THAT(faults(mesh), IsEmpty());
    double own = 0;
    for (std::size_t t = 0; t < mesh.index.size(); t += 3) {
      const glm::dvec3 a = mesh.position[mesh.index.at(t)], b = mesh.position[mesh.index.at(t + 1)],
                       c = mesh.position[mesh.index.at(t + 2)];
      own += glm::dot(a, glm::cross(b, c)) / 6;
      // No corner stands out of any triangle's plane.
      const glm::dvec3 normal = math::unit(glm::cross(b - a, c - a), glm::dvec3(0, 1, 0));
      for (const glm::vec3& p : mesh.position.span()) EXPECT_LT(glm::dot(normal, glm::dvec3(p) - a), 1e-4);
    }
    EXPECT_GT(own, 0);
    sum += own;
  }
  return sum;
}

TEST(Collision, IsConvexBodiesAroundMasses) {
  std::vector<std::string> names;
  const BuildingParams house = with(
      "Lot --> [ extrude(6) comp(f){ side: split(x){ ~2: [ t(0, 1, 0) s('1, 1, 0.3) i(\"window\") ] Wall. }* "
      "} ] t(0, 6, "
      "0) roofGable(45) Roof.",
      {10, 0, 8});
  EXPECT_NEAR(volume_of_collision(demanded(house, {.collision = CollisionNames::plain}), &names), 480 + 160,
              1e-3);
  EXPECT_EQ(names, (std::vector<std::string>{"collision_01", "collision_02"}));
  EXPECT_EQ(volume_of_collision(demanded(house, {})), 0);
}

TEST(Collision, IncludesARoofOnAFaceButNoWindow) {
  const BuildingParams params = with(
      "Lot --> extrude(6) comp(f){ top: roofGable(45) Roof. | side: split(x){ ~2: [ s('1, '1, 0.3) "
      "i(\"window\") ] "
      "Wall. }* }",
      {10, 0, 8});
  std::vector<std::string> names;
  EXPECT_NEAR(volume_of_collision(demanded(params, {.collision = CollisionNames::plain}), &names), 640, 1e-3);
  EXPECT_EQ(names.size(), 2U);
}

TEST(Collision, CutsBodiesThatAreFarFromConvex) {
  BuildingParams params = with("Lot --> extrude(3) comp(f){ all: Wall. }");
  params.footprint = {{{0, 0}, {10, 0}, {10, 2}, {2, 2}, {2, 10}, {0, 10}}};
  std::vector<std::string> names;
  EXPECT_NEAR(volume_of_collision(demanded(params, {.collision = CollisionNames::unreal}), &names), 108,
              1e-3);
  EXPECT_EQ(names, (std::vector<std::string>{"UCX_building_01", "UCX_building_02"}));
  params.footprint.push_back({{0.5, 0.5}, {0.5, 1.5}, {1.5, 1.5}, {1.5, 0.5}});
  EXPECT_NEAR(volume_of_collision(demanded(params, {.collision = CollisionNames::godot})), 105, 3.1);
}

TEST(Hull, ContainsAllPointsOfRandomClouds) {
  Rng rng(9);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<glm::dvec3> points;
    const std::uint32_t count = 4 + rng.below(16);
    for (std::uint32_t i = 0; i < count; ++i)
      points.emplace_back(rng.uniform(-3, 3), rng.uniform(0, 9), rng.uniform(-1, 1));
    const Solid hull = hull_of(points);
    ASSERT_TRUE(hull.is_closed);
    for (const Face& face : hull.faces) {
      const glm::dvec3 normal = math::unit(area_vector(hull, face, glm::dvec3(1)), glm::dvec3(0, 1, 0));
      const glm::dvec3 base = hull.points[hull.corners[hull.loops[face.first_loop].first]];
      for (const glm::dvec3& p : points) EXPECT_LT(glm::dot(normal, p - base), 1e-5);
    }
    // Euler: a closed surface without a handle.
    std::set<std::uint32_t> used(hull.corners.begin(), hull.corners.end());
    EXPECT_EQ(used.size() + hull.faces.size(), hull.corners.size() / 2 + 2) << trial;
  }
  EXPECT_TRUE(hull_of(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).faces.empty());
}

TEST(Appraisals, EstimateTheBytesOfMergedBodiesAndOfLevels) {
  BuildingParams params;
  params.blueprint = BuildingBlueprint::house;
  params.textures = BuildingTextures::none;
  for (const Demand demand : {Demand{.copies = CopyForm::any}, Demand{.copies = CopyForm::merge},
                              Demand{.lods = 3}, Demand{.share_organs = true}}) {
    Job job(1, Job::Options{});
    const Result<Appraisal> appraisal = appraise(params, context_of(job, demand));
    ASSERT_TRUE(appraisal);
    ASSERT_TRUE(appraisal->estimate);
    const Model model = demanded(params, demand);
    const auto bytes = static_cast<double>(count(model).bytes),
               estimate = static_cast<double>(appraisal->estimate->bytes);
    // The model's own count leaves the JSON out: a node with a mesh, a position and a rotation has about 110
    // characters, a part of a mesh with its accessors about 330.
    double json = 4'000;
    if (demand.share_organs) {
      for (const MeshGroup& mesh : model.meshes) json += 330.0 * static_cast<double>(mesh.primitives.size());
      for (const Node& node : model.nodes) {
        const std::size_t copies = std::max<std::size_t>(1, node.instances.transforms.size());
        json += 110.0 * static_cast<double>(copies);
      }
    }
    EXPECT_GT(estimate, (bytes + json) / 1.5) << demand.lods;
    EXPECT_LT(estimate, (bytes + json) * 1.5) << demand.lods;
  }
}

TEST(Appraisals, CountGeneratedTextures) {
  const auto estimate = [](BuildingTextures textures, int size) {
    BuildingParams params;
    params.blueprint = BuildingBlueprint::house;
    params.textures = textures;
    Job job(1, Job::Options{});
    return static_cast<double>(appraise(params, context_of(job, {.textures = size}))->estimate->bytes);
  };
  const double none = estimate(BuildingTextures::none, 512);
  EXPECT_EQ(estimate(BuildingTextures::auto_, 0), none);
  BuildingParams params;
  params.blueprint = BuildingBlueprint::house;
  Model model = demanded(params, {.textures = 512});
  const Job job(1, Job::Options{});
  texture::paint(model, 512, {}, nullptr, job);
  std::size_t made = 0;
  for (const auto& image : model.textures) made += image->bytes.size();
  EXPECT_NEAR(estimate(BuildingTextures::auto_, 512) - none, static_cast<double>(made),
              0.25 * static_cast<double>(made));
}

TEST(Appraisals, EstimateTheModel) {
  const auto compare = [](BuildingParams params) {
    params.textures = BuildingTextures::none;
    Job job(1, Job::Options{});
    const Result<Appraisal> appraisal = appraise(params, context_of(job));
    ASSERT_TRUE(appraisal);
    ASSERT_TRUE(appraisal->estimate);
    const Model model = demanded(params, {});
    const auto triangles = static_cast<double>(count(model).triangles);
    EXPECT_NEAR(static_cast<double>(appraisal->estimate->triangles), triangles, 0.02 * triangles);
    EXPECT_GT(appraisal->estimate->bytes, count(model).bytes * 4 / 5);
    EXPECT_LT(appraisal->estimate->bytes, count(model).bytes * 3 + 60'000);
  };
  compare(with("A --> split(x){ 0.5: B. }*"));
  compare(with("A --> split(x){ 0.5: split(y){ 0.5: B. }* }*", {20, 20, 1}));
  compare(with("Lot --> extrude(3) comp(f){ top: roofHip(30) Roof. | all: Wall. }", {10, 0, 8}));
  for (const BuildingBlueprint blueprint :
       {BuildingBlueprint::house, BuildingBlueprint::church, BuildingBlueprint::temple}) {
    BuildingParams params;
    params.blueprint = blueprint;
    compare(params);
  }
  Job job(1, Job::Options{});
  EXPECT_TRUE(appraise(with("A --> split(x){ 0.5: B. }*"), context_of(job))->estimate);
  EXPECT_EQ(job.spent(Resource::shapes), 0U);  // nothing of it is spent
  EXPECT_EQ(job.spent(Resource::triangles), 0U);
  EXPECT_FALSE(appraise(with("A --> split(x){ 0.01: split(y){ 0.01: B. }* }*"), context_of(job))->estimate);
}

}  // namespace
}  // namespace seedmesh::building
