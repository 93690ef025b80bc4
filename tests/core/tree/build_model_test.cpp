#include "core/generators/tree/build_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "core/generators/tree/tree.h"
#include "core/generators/tree/weber_penn_shape.h"
#include "core/geom/mesh/finish.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::tree {
namespace {

TreeParams small_tree() {
  TreeParams params;
  params.branches_1 = 14;
  params.branches_2 = 8;
  params.Leaves = 8;
  return params;
}

Model made(const TreeParams& params, const Demand& demand = {}) {
  Job job(5, Job::Options{});
  Result<Model> model = generate(params, {job, demand});
  EXPECT_TRUE(model);
  finish(*model, job);
  return std::move(*model);
}

const Node& node(const Model& model, std::string_view name) {
  const auto found = std::find_if(model.nodes.begin(), model.nodes.end(),
                                  [&](const Node& each) { return each.name == name; });
  EXPECT_NE(found, model.nodes.end()) << name;
  return *found;
}

const Mesh& mesh_of(const Model& model, std::string_view name) {
  return model.meshes[static_cast<std::size_t>(node(model, name).mesh)].primitives.front().mesh;
}

double area_of(const Mesh& mesh) { return measure({&mesh}).area; }

TEST(BuildModel, MakesOnePieceOfBarkAndOneOfLeaves) {
  const Model model = made(small_tree());
  EXPECT_EQ(model.meshes.size(), 2U);
  EXPECT_TRUE(faults(model).empty());
  EXPECT_EQ(measure({&mesh_of(model, "bark")}).open_edges, 0U);
}

TEST(BuildModel, RepeatsTheTextureByTheGirthOfEachLimb) {
  const Model model = made(small_tree());
  const Mesh& bark = mesh_of(model, "bark");
  float most = 0;
  std::size_t on_strips = 0;
  for (const glm::vec2& uv : bark.uv[0]) {
    most = std::max(most, std::abs(uv.x));
    on_strips += std::abs(uv.x) <= 0.5F ? 1 : 0;
  }
  EXPECT_LE(most, 5.0F);
  EXPECT_GT(2 * on_strips, bark.uv[0].size()) << "most limbs have less than a third of a metre of girth";
  EXPECT_EQ(model.materials.front().recipe.kind, "oak_bark");
}

TEST(BuildModel, GivesLeavesTheTextureOfTheirShapeAndTheColourOfTheSeason) {
  TreeParams params = small_tree();
  params.leaf.leaf_shape = TreeLeafShape::maple;
  params.season = TreeSeason::autumn;
  const Model model = made(params);
  EXPECT_EQ(model.variants, (std::vector<std::string>{"spring", "summer", "autumn"}));
  const auto& primitive = model.meshes.back().primitives.front();
  ASSERT_EQ(primitive.variant_materials.size(), 3U);
  EXPECT_EQ(primitive.material, primitive.variant_materials[2]);
  std::set<std::string> kinds;
  for (const int material : primitive.variant_materials) {
    const TextureRecipe& recipe = model.materials[static_cast<std::size_t>(material)].recipe;
    kinds.insert(recipe.kind);
    EXPECT_EQ(recipe.color, model.materials.back().recipe.color) << "one picture for all";
    EXPECT_LE(std::max({recipe.factor.x, recipe.factor.y, recipe.factor.z}), 1.0F);
  }
  EXPECT_EQ(kinds, std::set<std::string>{"maple_leaf"});
  EXPECT_EQ(model.meshes.front().primitives.front().variant_materials.size(), 3U);
}

TEST(BuildModel, KeepsTheColourOfBlossoms) {
  TreeParams params = small_tree();
  params.leaf.leaf_shape = TreeLeafShape::petal;
  params.leaf.color = {240, 185, 200};
  const auto colors = [&] {
    const Model model = made(params);
    std::vector<glm::vec4> found;
    for (const int material : model.meshes.back().primitives.front().variant_materials)
      found.push_back(model.materials[static_cast<std::size_t>(material)].base_color);
    return found;
  };
  const std::vector<glm::vec4> same = colors();
  ASSERT_EQ(same.size(), 3U);
  EXPECT_EQ(same[0], same[1]);
  EXPECT_EQ(same[2], same[1]);
  params.leaf.autumn = Color{200, 80, 40};
  const std::vector<glm::vec4> fading = colors();
  EXPECT_EQ(fading[0], fading[1]);
  EXPECT_NE(fading[2], fading[1]);
}

TEST(BuildModel, IsBareInWinterUnlessItIsEvergreen) {
  TreeParams params = small_tree();
  params.season = TreeSeason::winter;
  EXPECT_EQ(made(params).meshes.size(), 1U);
  params.leaf.evergreen = true;
  EXPECT_EQ(made(params).meshes.size(), 2U);
}

TEST(BuildModel, BuildsSoundLeavesOfEveryShape) {
  TreeParams params = small_tree();
  params.branches_1 = 4;
  params.branches_2 = 3;
  for (int shape = 0; shape <= static_cast<int>(TreeLeafShape::petal); ++shape) {
    for (int build = static_cast<int>(TreeBuild::card); build <= static_cast<int>(TreeBuild::bunch);
         ++build) {
      params.leaf.leaf_shape = static_cast<TreeLeafShape>(shape);
      params.leaf.build = static_cast<TreeBuild>(build);
      for (const std::string& fault : faults(made(params))) {
        ADD_FAILURE() << text_of(params.leaf.leaf_shape) << ' ' << text_of(params.leaf.build) << ": "
                      << fault;
      }
    }
  }
}

TEST(BuildModel, HasFewerLeavesAndLessBarkInEveryLevelOfDetail) {
  TreeParams params = small_tree();
  params.branches_1 = 30;
  params.branches_2 = 20;
  params.leaf.coarseness = 4;
  const Model model = made(params, {.lods = 5, .textures = 0});
  EXPECT_TRUE(faults(model).empty());
  const Node &bark = node(model, "bark"), &leaves = node(model, "leaves");
  ASSERT_EQ(bark.lods.size(), 4U);
  ASSERT_EQ(leaves.lods.size(), 4U);
  const auto whole = static_cast<double>(mesh_of(model, "leaves").elements());
  const double area = area_of(mesh_of(model, "leaves"));
  std::size_t before = mesh_of(model, "bark").elements();
  std::size_t all = before + mesh_of(model, "leaves").elements();
  for (std::size_t i = 0; i < 4; ++i) {
    const Mesh& coarser = model.meshes[static_cast<std::size_t>(leaves.lods[i])].primitives.front().mesh;
    const Mesh& wood = model.meshes[static_cast<std::size_t>(bark.lods[i])].primitives.front().mesh;
    const auto level = static_cast<double>(i + 1);
    // More stay than the least share where the outline needs them.
    EXPECT_GT(static_cast<double>(coarser.elements()) / whole, 1 / std::sqrt(level + 1) - 0.01) << level;
    EXPECT_LE(10 * (coarser.elements() + wood.elements()), 9 * all) << level;
    all = coarser.elements() + wood.elements();
    EXPECT_GT(area_of(coarser), 0.99 * area / std::sqrt(level + 1)) << level;
    EXPECT_LE(10 * wood.elements(), 9 * before);
    EXPECT_EQ(measure({&wood}).open_edges, 0U);
    before = wood.elements();
  }
}

TEST(BuildModel, GrowsBarkAndLeavesWithOneSkeletonOfBones) {
  const Model model = made(small_tree(), {.growth = true});
  ASSERT_EQ(model.skins.size(), 1U);
  ASSERT_EQ(model.animations.size(), 1U);
  EXPECT_TRUE(faults(model).empty());
  for (const char* name : {"bark", "leaves"}) {
    const Mesh& mesh = mesh_of(model, name);
    ASSERT_EQ(mesh.bone.size(), mesh.position.size());
    EXPECT_EQ(node(model, name).skin, 0);
    const std::set<std::uint16_t> used(mesh.bone.begin(), mesh.bone.end());
    EXPECT_GT(used.size(), 10U);
    EXPECT_LT(*used.rbegin(), model.skins.front().joints.size());
  }
}

TEST(BuildModel, GrowsEveryLevelOfDetailWithTheSameBones) {
  const Model model = made(small_tree(), {.lods = 3, .growth = true});
  ASSERT_EQ(model.skins.size(), 1U);
  EXPECT_TRUE(faults(model).empty());
  for (const char* name : {"bark", "leaves"}) {
    const Node& shown = node(model, name);
    EXPECT_EQ(shown.skin, 0);
    ASSERT_EQ(shown.lods.size(), 2U);
    for (const int lod : shown.lods) {
      const Mesh& mesh = model.meshes[static_cast<std::size_t>(lod)].primitives.front().mesh;
      ASSERT_EQ(mesh.bone.size(), mesh.position.size());
      for (const std::uint16_t bone : mesh.bone) ASSERT_LT(bone, model.skins.front().joints.size());
    }
  }
}

TEST(BuildModel, SimplifiesADistantTree) {
  TreeParams params = small_tree();
  params.branches_1 = 30;
  params.branches_2 = 20;
  const Model near = made(params);
  params.range = 400;
  const Model far = made(params);
  EXPECT_TRUE(faults(far).empty());
  EXPECT_LT(4 * mesh_of(far, "bark").elements(), mesh_of(near, "bark").elements());
  EXPECT_LT(4 * mesh_of(far, "leaves").elements(), mesh_of(near, "leaves").elements());
  EXPECT_NEAR(area_of(mesh_of(far, "leaves")) / area_of(mesh_of(near, "leaves")), 1, 0.12);
}

TEST(BuildModel, MovesTheRimOfACollarWithTheOlderLimbAlone) {
  const Model model = made(small_tree(), {.growth = true});
  const Mesh& bark = mesh_of(model, "bark");
  std::map<std::tuple<float, float, float>, std::uint16_t> bone;
  for (std::size_t i = 0; i < bark.position.size(); ++i) {
    const glm::vec3 p = bark.position[i];
    const auto [place, is_new] = bone.try_emplace({p.x, p.y, p.z}, bark.bone[i]);
    EXPECT_EQ(place->second, bark.bone[i]) << "vertices at one place part when the tree grows";
  }
}

TEST(BuildModel, WritesWindWeightsThatDoNotTearTheBark) {
  const Model model = made(small_tree(), {.wind = true});
  std::map<std::tuple<float, float, float>, glm::vec2> bend;
  const Mesh& bark = mesh_of(model, "bark");
  ASSERT_EQ(bark.uv[2].size(), bark.position.size());
  float most = 0;
  for (std::size_t i = 0; i < bark.position.size(); ++i) {
    const glm::vec3 p = bark.position[i];
    const auto [place, is_new] = bend.try_emplace({p.x, p.y, p.z}, bark.uv[2][i]);
    EXPECT_LT(glm::distance(place->second, bark.uv[2][i]), 1e-5F);
    most = std::max(most, bark.uv[2][i].y);
    EXPECT_EQ(bark.uv[3][i].y, 0) << "bark does not flutter";
  }
  EXPECT_NEAR(most, 1, 0.2);
  const Mesh& leaves = mesh_of(model, "leaves");
  float flutter = 0;
  for (std::size_t i = 0; i < leaves.position.size(); ++i) {
    for (const float each : {leaves.uv[2][i].x, leaves.uv[2][i].y, leaves.uv[3][i].x, leaves.uv[3][i].y}) {
      EXPECT_GE(each, 0);
      EXPECT_LE(each, 1);
    }
    flutter = std::max(flutter, leaves.uv[3][i].y);
  }
  EXPECT_NEAR(flutter, 1, 0.05);
}

TEST(BuildModel, NamesCollisionBodiesForEachEngine) {
  const std::pair<CollisionNames, const char*> names[] = {
      {CollisionNames::plain, "collision_01"},
      {CollisionNames::unreal, "UCX_bark_01"},
      {CollisionNames::godot, "collision_01-convcolonly"}};
  for (const auto& [convention, name] : names) {
    const Model model = made(small_tree(), {.collision = convention});
    const Mesh& body = mesh_of(model, name);
    EXPECT_TRUE(faults(body).empty());
    const int material =
        model.meshes[static_cast<std::size_t>(node(model, name).mesh)].primitives[0].material;
    EXPECT_TRUE(model.materials[static_cast<std::size_t>(material)].recipe.kind.empty())
        << "no uv, no picture";
    const MeshMeasures measures = measure({&body});
    EXPECT_EQ(measures.open_edges, 0U);
    EXPECT_GT(measures.volume, 0);
  }
}

TEST(BuildModel, ChangesNothingElseWhenRootsAreAdded) {
  TreeParams params = small_tree();
  const Model without = made(params);
  params.roots.count = 6;
  const Model with = made(params);
  EXPECT_EQ(
      std::vector(mesh_of(without, "leaves").position.begin(), mesh_of(without, "leaves").position.end()),
      std::vector(mesh_of(with, "leaves").position.begin(), mesh_of(with, "leaves").position.end()));
  EXPECT_LT(bounds_of(mesh_of(with, "bark").position.span()).min.y, -0.01F);
}

TreeParams bare_trunk() {
  TreeParams params;
  params.Scale = 10;
  params.ScaleV = 0;
  params.curve_v_0 = 0;
  params.Ratio = 0.05;
  params.Leaves = 0;
  params.Levels = 1;
  return params;
}

TEST(BuildModel, ShowsLobesOfEveryDepthDownToTheGround) {
  for (const int lobes : {1, 3, 5, 8, 16}) {
    for (const double depth : {0.15, 0.3, 0.5}) {
      for (const int sides : {3, 8, 16, 24, 64}) {
        for (const double flare : {-0.5, 0.0, 0.6, 4.0}) {
          TreeParams params = bare_trunk();
          params.Lobes = lobes;
          params.LobeDepth = depth;
          params.sides = sides;
          params.Flare = flare;
          const Model model = made(params);
          const Mesh& bark = mesh_of(model, "bark");
          const std::string what = std::to_string(lobes) + " of " + std::to_string(depth) + ", sides " +
                                   std::to_string(sides) + ", flare " + std::to_string(flare);
          EXPECT_TRUE(faults(bark).empty()) << what;
          float nearest = 1e9F, farthest = 0;
          for (const glm::vec3& p : bark.position) {
            if (p.y != 0 || (p.x == 0 && p.z == 0)) continue;
            nearest = std::min(nearest, std::hypot(p.x, p.z));
            farthest = std::max(farthest, std::hypot(p.x, p.z));
          }
          // Of six corners a rib none is at the crest.
          const double seen = 0.86 * depth, wanted = (1 + seen) / (1 - seen);
          EXPECT_GT(static_cast<double>(farthest / nearest), wanted) << what;
        }
      }
    }
  }
}

TEST(BuildModel, StartsALeaningTrunkBelowTheGround) {
  TreeParams params = bare_trunk();
  params.curve_v_0 = -60;
  params.curve_res_0 = 20;
  const Model model = made(params);
  const Mesh& bark = mesh_of(model, "bark");
  EXPECT_TRUE(faults(bark).empty());
  const float lowest = bounds_of(bark.position.span()).min.y;
  EXPECT_LT(lowest, -0.1F);
  std::size_t level = 0;
  for (std::size_t i = 0; i < bark.position.size(); ++i) {
    if (bark.normal[i].y < -0.999F && bark.position[i].y == lowest) ++level;
  }
  EXPECT_GE(level, 8U) << "a level end";
}

TEST(BuildModel, SlopesAWideFlareGently) {
  EXPECT_NEAR(flared(1.25, 0.03), 1 + 1.25 * (std::pow(100, 1 - 0.24) - 1) / 100, 1e-9) << "as in the paper";
  const double steep = 4 * (std::pow(100, 1 - 0.24) - 1) / 100;
  EXPECT_GT(flared(4, 0.03) - 1, 1.4 * steep);
  for (double z = 0; z < 0.125; z += 0.005) EXPECT_GT(flared(4, z), flared(4, z + 0.005));
  EXPECT_EQ(flared(4, 0.125), 1);
  EXPECT_NEAR(flared(4, 0), 1 + 0.99 * 4, 1e-9);
  TreeParams params;
  params.Flare = 0.8;
  params.trunk_flare = 2;
  EXPECT_NEAR(flared_trunk(params, 0), flared(0.8, 0) * flared(2, 0), 1e-9);
}

TEST(BuildModel, SpreadsRootsByTheTrunkWithoutItsFlare) {
  TreeParams params = bare_trunk();
  params.roots.count = 6;
  params.roots.length = 6;
  params.trunk_flare = 1;
  const Model model = made(params);
  const Mesh& bark = mesh_of(model, "bark");
  EXPECT_TRUE(faults(bark).empty());
  const double trunk = 10 * 0.05, foot = trunk * flared(params.Flare, 0) * flared(1, 0);
  const Box box = bounds_of(bark.position.span());
  for (const float reach : {-box.min.x, -box.min.z, box.max.x, box.max.z})
    EXPECT_LT(static_cast<double>(reach), foot + 6.5 * trunk);
  EXPECT_GT(static_cast<double>(box.max.x - box.min.x), 2 * (foot + 2 * trunk));
  EXPECT_GT(static_cast<double>(box.min.y), -(params.roots.depth * 6 + 1) * trunk);
}

TEST(BuildModel, ForksRootsAndEndsThemInAPoint) {
  TreeParams params = bare_trunk();
  params.roots.count = 5;
  Job job(0, Job::Options{});
  const Result<Json> figures = derive(params, {job});
  ASSERT_TRUE(figures);
  EXPECT_EQ((*figures)["levels"][1]["count"], 5);
  EXPECT_GE((*figures)["levels"][2]["count"], 5);
}

TEST(BuildModel, GivesNeedlesOnSquaresTheTextureOfABranchlet) {
  TreeParams params = small_tree();
  params.leaf.leaf_shape = TreeLeafShape::needles;
  params.leaf.build = TreeBuild::cross;
  EXPECT_EQ(made(params).materials.back().recipe.kind, "needles_twig");
  params.leaf.build = TreeBuild::mesh;
  params.leaf.picture = TreePicture::own;
  EXPECT_EQ(made(params).materials.back().recipe.kind, "needles");
  params.leaf.leaf_shape = TreeLeafShape::pine_needles;
  EXPECT_EQ(made(params).materials.back().recipe.kind, "pine_needles");
  params.leaf.build = TreeBuild::cross;
  EXPECT_EQ(made(params).materials.back().recipe.kind, "pine_needles_twig");
}

TEST(BuildModel, RefusesALeafImageThatCannotBeRead) {
  TreeParams params;
  params.leaf.images.color = "data:image/png;base64,AAAA";
  params.bark_images.color = "http://example.org/x.png";
  const std::vector<Issue> issues = check(params, Limits{});
  ASSERT_FALSE(issues.empty());
  EXPECT_EQ(issues.front().pointer, "/bark_images/color");
}

}  // namespace
}  // namespace seedmesh::tree
