/// Organs, generalized cylinders, materials and levels of detail of the generator.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/generators/lsystem/lsystem.h"
#include "core/schema/issue_list.h"
#include "generated/params/lsystem.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

LsystemParams params_of(const char* text) {
  IssueList errors;
  LsystemParams params = read_lsystem(Json::parse(text), "", errors);
  EXPECT_TRUE(errors.empty()) << (errors.empty() ? "" : errors.issues().front().message);
  return params;
}

Model model_of(const char* text, const Demand& demand = {}) {
  Job job(1, Job::Options{});
  Result<Model> model = generate(params_of(text), context_of(job, demand));
  if (!model) {
    ADD_FAILURE() << model.error().issues.front().message;
    return {};
  }
  return *std::move(model);
}

std::vector<Issue> issues_of(const char* text) { return check(params_of(text), Limits{}); }

const Node* node_named(const Model& model, std::string_view name) {
  for (const Node& node : model.nodes) {
    if (node.name == name) return &node;
  }
  return nullptr;
}

const Mesh& first_mesh(const Model& model, const Node& node) {
  return model.meshes[static_cast<std::size_t>(node.mesh)].primitives.front().mesh;
}

TEST(Lines, HaveNoTextures) {
  // glTF 2.0, section 3.9.3: a texture needs texture coordinates, which lines have not.
  const Model model = model_of(R"({"axiom":"F{.f+(90)f+(90)f}","style":"lines",
      "materials":[{"color":"#ff0000","texture":"oak_bark"}]})");
  ASSERT_THAT(model.materials, SizeIs(2));
  EXPECT_THAT(model.materials[0].recipe.kind, IsEmpty());
  EXPECT_FLOAT_EQ(model.materials[0].base_color.x, 1);
  EXPECT_FLOAT_EQ(model.materials[0].base_color.y, 0);
  EXPECT_EQ(model.materials[1].recipe.kind, "oak_bark") << "of the polygon";
  ASSERT_THAT(model.warnings, SizeIs(1));
  EXPECT_EQ(model.warnings[0].pointer, "/materials/0/texture");
  EXPECT_EQ(model.warnings[0].message, "has no effect on lines");
}

TEST(Tubes, WarnOfInternodesThatAreTooThin) {
  const Model koch = model_of(R"({"axiom":"F","productions":["F -> F+F--F+F"],"angle":60,"iterations":9})");
  ASSERT_EQ(koch.warnings.size(), 1U);
  EXPECT_EQ(koch.warnings[0].pointer, "/width");
  EXPECT_THAT(koch.warnings[0].message, testing::StartsWith("262144 internodes are too thin"));
  EXPECT_TRUE(model_of(R"({"axiom":"F","productions":["F -> F+F--F+F"],"angle":60,"iterations":4})")
                  .warnings.empty());
}

/// Figure 2.6 of The Algorithmic Beauty of Plants, whose trunk has a length of 1 and a width of 10.
TEST(Tubes, WarnOfInternodesThatAreAsWideAsThePlant) {
  const std::string figure = R"json(,
    "productions":["A(l,w) -> !(w)F(l)[&(45)B(l*0.6,w*0.707)]/(137.5)A(l*0.9,w*0.707)",
                   "B(l,w) -> !(w)F(l)[-(45)$C(l*0.6,w*0.707)]C(l*0.9,w*0.707)",
                   "C(l,w) -> !(w)F(l)[+(45)$B(l*0.6,w*0.707)]B(l*0.9,w*0.707)"],"iterations":10})json";
  const Model pixels = model_of((R"json({"axiom":"A(1,10)")json" + figure).c_str());
  ASSERT_EQ(pixels.warnings.size(), 1U);
  EXPECT_EQ(pixels.warnings[0].pointer, "/width");
  EXPECT_THAT(pixels.warnings[0].message, testing::StartsWith("the widest internode has a diameter of 10 m"));
  EXPECT_TRUE(model_of((R"json({"axiom":"A(1,0.1)")json" + figure).c_str()).warnings.empty());
}

TEST(Organs, HaveTheColourOfTheirKindInThePaletteInsteadOfThatOfBark) {
  const auto organ_of = [](const std::string& members) {
    const Model model = model_of(
        (R"json({"axiom":"F;(2)F,(0)~leaf","surfaces":{"leaf":{"build":"mesh"}})json" + members + "}")
            .c_str());
    const auto& mesh = model.meshes[static_cast<std::size_t>(node_named(model, "organs")->mesh)];
    return model.materials[static_cast<std::size_t>(mesh.primitives[0].material)].name;
  };
  EXPECT_EQ(organ_of(""), "leaf_surface");
  EXPECT_EQ(
      organ_of(R"(,"materials":[{"name":"wood","color":"#553311"},{"name":"green","color":"#00ff00"}])"),
      "wood_surface");
  const Model model =
      model_of(R"json({"axiom":"F~aF~bF'~a","surfaces":{"a":{"shape":"petal"},"b":{"shape":"fruit"}}})json");
  std::vector<std::string> names;
  for (const Material& material : model.materials) names.push_back(material.name);
  EXPECT_THAT(names, testing::UnorderedElementsAre("bark", "petal_surface", "berry", "leaf_surface"));
}

TEST(Organs, AreReportedWhereThereAreNoSurfaces) {
  const Model model = model_of(R"({"axiom":"F~F"})");
  ASSERT_EQ(model.warnings.size(), 1U);
  EXPECT_EQ(model.warnings[0].pointer, "/axiom");
  EXPECT_EQ(model.warnings[0].column, 2);
}

TEST(Surfaces, HaveThePositionAndHeadingOfTheTurtle) {
  const Model model = model_of(
      R"json({"axiom":"F(2)-(90)~leaf(0.5)","surfaces":{"leaf":{"shape":"kite","fold":0,"droop":0}}})json");
  const Node* organs = node_named(model, "organs");
  ASSERT_TRUE(organs);
  const Box box = bounds_of(first_mesh(model, *organs).position.span());
  EXPECT_NEAR(box.min.x, 0, 1e-6);
  EXPECT_NEAR(box.max.x, 0.5, 1e-6);
  EXPECT_NEAR(box.max.y, 2 + 0.35 / 2, 1e-6);
}

TEST(Surfaces, AreReadByTheirLongestName) {
  const Model model = model_of(
      R"json({"axiom":"F~leaf~leaf_old(2)",
              "surfaces":{"leaf":{"size":0.1},"leaf_old":{"size":0.1,"color":3}}})json");
  const Node* organs = node_named(model, "organs");
  ASSERT_TRUE(organs);
  EXPECT_THAT(model.meshes[static_cast<std::size_t>(organs->mesh)].primitives, SizeIs(2));
}

TEST(Surfaces, AreRefusedWhereTheirNameIsNotKnown) {
  const std::vector<Issue> issues = issues_of(R"({"axiom":"F~petal","surfaces":{"leaf":{}}})");
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].pointer, "/axiom");
  EXPECT_EQ(issues[0].column, 2);
  EXPECT_THAT(issues[0].message, HasSubstr("~leaf"));
}

TEST(Surfaces, LeaveATildeAloneWhereThereAreNone) { EXPECT_THAT(issues_of(R"({"axiom":"F~F"})"), IsEmpty()); }

TEST(Surfaces, NeedPatchesForTheShapePatchesOnly) {
  EXPECT_THAT(issues_of(R"({"axiom":"F","surfaces":{"p":{"shape":"patches"}}})"), SizeIs(1));
}

TEST(Surfaces, BecomeNodesOfOneMeshOnRequest) {
  const Model model =
      model_of(R"({"axiom":"F~l+F~l+F~l","surfaces":{"l":{"size":0.2}}})", {.share_organs = true});
  const Node* leaves = node_named(model, "l");
  ASSERT_TRUE(leaves);
  EXPECT_THAT(leaves->instances.transforms, SizeIs(3));
}

TEST(Surfaces, HaveTheTextureOfTheirKindOnSquares) {
  const Model model = model_of(
      R"({"axiom":"F~a~b","surfaces":{"a":{"shape":"birch","build":"card"},"b":{"shape":"birch"}},
          "materials":[{"color":"#446633"}]})");
  std::vector<std::string> kinds;
  for (const Material& material : model.materials) kinds.push_back(material.recipe.kind);
  EXPECT_THAT(kinds, testing::UnorderedElementsAre("", "birch_leaf", ""));
}

TEST(Materials, NeedAColourATextureOrAnImage) {
  const std::vector<Issue> issues =
      issues_of(R"({"axiom":"F","materials":[{"texture":"oak_bark"},{"roughness":0.2}]})");
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].pointer, "/materials/1");
}

TEST(Materials, ReportAnInvalidImage) {
  const std::vector<Issue> issues =
      issues_of(R"({"axiom":"F","materials":[{"images":{"color":"bark.png"}}]})");
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].pointer, "/materials/0/images/color");
}

TEST(Materials, AreTransparentByTheirOpacity) {
  const Model model = model_of(R"({"axiom":"F","materials":[{"color":"#ffffff","opacity":0.5}]})");
  EXPECT_EQ(model.materials.front().alpha_mode, AlphaMode::blend);
  EXPECT_EQ(model.materials.front().base_color.w, 0.5F);
}

TEST(Materials, SendOutLight) {
  const Model model = model_of(
      R"({"axiom":"F","materials":[{"color":"#000000","emission":{"color":"#ff00ff","strength":4}}]})");
  EXPECT_EQ(model.materials.front().emissive, glm::vec3(4, 0, 4));
  EXPECT_EQ(model_of(R"({"axiom":"F","materials":[{"color":"#000000"}]})").materials.front().emissive,
            glm::vec3(0));
}

TEST(Sweep, PassesThroughItsControlPointsAndChangesWidthSmoothly) {
  Job job(1, Job::Options{});
  const Result<Json> derived =
      derive(params_of(R"({"axiom":"@GsF(1)+(90)!(0.02)F(1)@Ge"})"), context_of(job));
  ASSERT_TRUE(derived);
  const Json& turtle = (*derived)["turtle"];
  EXPECT_EQ(turtle["segments"], 16);
  EXPECT_NEAR(turtle["position"][0].get<double>(), -1, 1e-9);
  EXPECT_GT(turtle["total_length"].get<double>(), 2);
  EXPECT_LT(turtle["total_length"].get<double>(), 2.4);
}

TEST(Sweep, IsStraightWhereItsHeadingsAre) {
  Job job(1, Job::Options{});
  const Result<Json> derived = derive(params_of(R"({"axiom":"@Gsf(1)@Gc(5)f(1)@Ge"})"), context_of(job));
  ASSERT_TRUE(derived);
  EXPECT_EQ((*derived)["turtle"]["segments"], 13);
  EXPECT_NEAR((*derived)["turtle"]["total_length"].get<double>(), 2, 1e-9);
}

TEST(Sweep, LeavesBranchesAsTheyAre) {
  Job job(1, Job::Options{});
  const Result<Json> derived = derive(params_of(R"({"axiom":"@GsF[+F]F@Ge"})"), context_of(job));
  ASSERT_TRUE(derived);
  EXPECT_EQ((*derived)["turtle"]["segments"], 8 + 1 + 8);
}

TEST(Sweep, RefusesACrossSectionThatIsNotThere) {
  const auto issues =
      issues_of(R"json({"axiom":"@Gs@#(2)f(1)@Ge","contours":[[[1,0],[0,1],[-1,0],[0,-1]]]})json");
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].pointer, "/axiom");
  EXPECT_THAT(issues[0].message, testing::HasSubstr("expected 0 (circle) to 1"));
  // An index that is known only during drawing is refused there.
  Job job(1, Job::Options{});
  const auto params = params_of(R"json({"axiom":"A(2)","productions":["A(n)->@Gs@#(n)f(1)@Ge"],"iterations":1,
                                        "contours":[[[1,0],[0,1],[-1,0],[0,-1]]]})json");
  try {
    (void)generate(params, context_of(job));
    FAIL() << "no error was reported";
  } catch (const Stop& stop) {
    EXPECT_THAT(stop.what(), testing::HasSubstr("found the contour 2; expected 0 (circle) to 1"));
  }
}

TEST(Sweep, RefusesACrossSectionThatEnclosesNothing) {
  const auto issues = check(params_of(R"({"axiom":"F","contours":[[[1,0],[0.9,0.3],[0.8,0.1]]]})"), Limits{});
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].pointer, "/contours/0");
}

TEST(Levels, FallInTriangles) {
  const Model model = model_of(
      R"json({"axiom":"A(1,0.1)",
              "productions":["A(l,w) -> !(w)F(l)[&(40)A(l*0.8,w*0.7)]/(137)[&(40)A(l*0.8,w*0.7)]~leaf"],
              "iterations":8,"sides":32,"stacks":6,"surfaces":{"leaf":{"size":0.1,"color":1}}})json",
      {.lods = 5});
  for (const char* name : {"bark", "organs"}) {
    const Node* node = node_named(model, name);
    ASSERT_TRUE(node);
    ASSERT_THAT(node->lods, SizeIs(4));
    std::size_t before = first_mesh(model, *node).elements();
    for (const int lod : node->lods) {
      const std::size_t now = model.meshes[static_cast<std::size_t>(lod)].primitives.front().mesh.elements();
      EXPECT_LT(now, before) << name;
      before = now;
    }
  }
}

/// Tunnel 2012, table 8. A tube of n sides and m stacks has 2 n m triangles, and 2 n at its two ends.
TEST(Levels, HaveTheSlicesAndStacksOfTunnel) {
  // A cone and a cylinder.
  for (
      const char* parameters :
      {R"({"axiom":"F","width_rule":"longest_chain","tip_width":0.05,"sides":32,"stacks":6,"levels":"slices"})",
       R"({"axiom":"F","sides":32,"stacks":6,"levels":"slices"})"}) {
    const Model model = model_of(parameters, {.lods = 5});
    const Node& bark = *node_named(model, "bark");
    std::vector<std::size_t> triangles{first_mesh(model, bark).elements()};
    for (const int lod : bark.lods)
      triangles.push_back(model.meshes[static_cast<std::size_t>(lod)].primitives.front().mesh.elements());
    EXPECT_THAT(triangles, ElementsAre(2 * 32 * 6 + 64, 2 * 22 * 4 + 44, 2 * 18 * 3 + 36, 2 * 16 * 3 + 32,
                                       2 * 14 * 2 + 28));
  }
}

/// Tajić 2009, section 4.3: gluCylinder with equal radii, which decrease by 0.015 a step.
TEST(Tubes, AreCylindersWithoutTaper) {
  const auto rings = [](const char* taper) {
    const Model model =
        model_of((R"({"axiom":"A","productions":["A -> FA"],"iterations":3,"step":1,"width":0.4,)"
                  R"("width_rule":"decrement","width_decrement":0.03,"taper":")" +
                  std::string(taper) + R"("})")
                     .c_str());
    std::map<double, std::set<double>> heights;  // by radius
    for (const glm::vec3& p : first_mesh(model, *node_named(model, "bark")).position) {
      const double radius = std::sqrt(static_cast<double>(p.x * p.x + p.z * p.z));
      const double height = std::round(static_cast<double>(p.y) * 1e4) / 1e4;
      if (radius > 0.05) heights[std::round(radius * 1e4) / 1e4].insert(height);
    }
    return heights;
  };
  const auto cylinders = rings("none");
  ASSERT_EQ(cylinders.size(), 3U);
  for (const double radius : {0.185, 0.17, 0.155}) EXPECT_EQ(cylinders.at(radius).size(), 2U) << radius;
  EXPECT_EQ(rings("linear").at(0.17), std::set<double>{2.0});
}

constexpr const char* guest_tree =
    R"json({"axiom":"F(1)[+(60)~ball(2)]F(1)~ball","sides":4,
            "surfaces":{"ball":{"shape":"model","size":0.5,
              "model":{"generator":"fractal","parameters":{"element":"cube","iterations":1}}}}})json";

TEST(SurfaceModels, AreOrgansWithTheirOwnMaterials) {
  const Model model = model_of(guest_tree);
  const Node* organs = node_named(model, "organs");
  ASSERT_TRUE(organs);
  const MeshGroup& group = model.meshes[static_cast<std::size_t>(organs->mesh)];
  ASSERT_FALSE(group.primitives.empty());
  for (const Primitive& primitive : group.primitives) {
    ASSERT_GE(primitive.material, 0);
    EXPECT_LT(static_cast<std::size_t>(primitive.material), model.materials.size());
  }
}

TEST(SurfaceModels, AreScaledByTheModule) {
  const auto size_at = [](const char* axiom) {
    const std::string text = std::string(R"json({"axiom":")json") + axiom +
                             R"json(","surfaces":{"ball":{"shape":"model","size":0.5,
        "model":{"generator":"fractal","parameters":{"element":"cube","iterations":0}}}}})json";
    const Model model = model_of(text.c_str());
    const Box box = bounds_of(first_mesh(model, *node_named(model, "organs")).position.span());
    return box.max - box.min;
  };
  EXPECT_NEAR(size_at("~ball").x, 0.5, 1e-6);
  EXPECT_NEAR(size_at("~ball(2)").x, 1, 1e-6);
}

TEST(SurfaceModels, AreOneModelAndNothingElse) {
  EXPECT_EQ(issues_of(R"({"axiom":"F","surfaces":{"b":{"shape":"model"}}})")[0].pointer, "/surfaces/b");
  EXPECT_EQ(
      issues_of(
          R"({"axiom":"F","surfaces":{"b":{"shape":"kite","glb":"data:model/gltf-binary;base64,AA=="}}})")[0]
          .pointer,
      "/surfaces/b");
  EXPECT_EQ(issues_of(R"({"axiom":"F","surfaces":{"b":{"shape":"model","glb":"leaf.glb"}}})")[0].pointer,
            "/surfaces/b/glb");
}

TEST(SurfaceModels, AreRefusedWithoutAMesh) {
  Job job(1, Job::Options{});
  const LsystemParams params = params_of(
      R"json({"axiom":"F~b","surfaces":{"b":{"shape":"model","glb":"data:model/gltf-binary;base64,AAAA"}}})json");
  try {
    const Result<Model> model = generate(params, context_of(job));
    FAIL() << "no error was reported";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.issue().pointer, "/surfaces/b/glb");
  }
}

constexpr const char* leafy =
    R"json({"axiom":"F(2)[+(40)F(1)~leaf]F(1)[-(40)F(1)~leaf]F(1)~leaf","width":0.1,"sides":8,
            "surfaces":{"leaf":{"shape":"kite"}}})json";

TEST(GrowthOfOrgans, GivesEachTheBoneOfItsLimb) {
  const Model model = model_of(leafy, {.growth = true});
  const Node* organs = node_named(model, "organs");
  ASSERT_TRUE(organs);
  EXPECT_GE(organs->skin, 0);
  const Mesh& mesh = first_mesh(model, *organs);
  ASSERT_EQ(mesh.bone.size(), mesh.position.size());
  std::set<std::uint16_t> bones(mesh.bone.begin(), mesh.bone.end());
  EXPECT_GE(bones.size(), 3U);  // three leaves on three limbs
  EXPECT_FALSE(bones.contains(0));
}

TEST(GrowthOfOrgans, HasTheSameBonesAtEveryLevel) {
  const Model still = model_of(leafy, {.lods = 3});
  const Model model = model_of(leafy, {.lods = 3, .growth = true});
  ASSERT_EQ(model.skins.size(), 1U);
  for (const char* name : {"bark", "organs"}) {
    const Node* node = node_named(model, name);
    ASSERT_TRUE(node);
    ASSERT_EQ(node->lods.size(), node_named(still, name)->lods.size());
    for (const int lod : node->lods) {
      for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(lod)].primitives) {
        ASSERT_EQ(primitive.mesh.bone.size(), primitive.mesh.position.size());
        for (const std::uint16_t bone : primitive.mesh.bone) EXPECT_LT(bone, model.skins[0].joints.size());
      }
    }
  }
}

TEST(GrowthOfOrgans, IsRefusedWhereTheyShareAMesh) {
  Job job(1, Job::Options{});
  try {
    const Result<Model> model =
        generate(params_of(leafy), context_of(job, {.share_organs = true, .growth = true}));
    FAIL() << "no error was reported";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.issue().pointer, "/output/instancing");
  }
}

/// Returns the silhouette of the model from a side in cells of a grid, from the vertices and centres of its
/// triangles.
std::set<std::pair<int, int>> silhouette(const Model& model, std::size_t level, float cell) {
  std::set<std::pair<int, int>> cells;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const int shown =
        level == 0 || node.lods.empty() ? node.mesh : node.lods[std::min(level, node.lods.size()) - 1];
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(shown)].primitives) {
      const Mesh& mesh = primitive.mesh;
      for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
        const glm::vec3 a = mesh.position[mesh.index.at(i)], b = mesh.position[mesh.index.at(i + 1)],
                        c = mesh.position[mesh.index.at(i + 2)];
        for (int s = 0; s <= 8; ++s) {
          for (int t = 0; s + t <= 8; ++t) {
            const glm::vec3 p =
                a + (b - a) * (static_cast<float>(s) / 8) + (c - a) * (static_cast<float>(t) / 8);
            cells.emplace(static_cast<int>(std::floor(p.x / cell)), static_cast<int>(std::floor(p.y / cell)));
          }
        }
      }
    }
  }
  return cells;
}

TEST(Levels, HaveOneSilhouette) {
  const Model model = model_of(
      R"json({"axiom":"A(1,0.12)","iterations":6,"sides":12,
              "productions":["A(l,w) -> !(w)F(l)[+(28)A(l*0.75,w*0.7)][-(33)A(l*0.7,w*0.7)]"]})json",
      {.lods = 5});
  const auto finest = silhouette(model, 0, 0.1F);
  for (std::size_t level = 1; level < 5; ++level) {
    const auto coarser = silhouette(model, level, 0.1F);
    std::size_t common = 0;
    for (const auto& cell : coarser) common += finest.contains(cell) ? 1U : 0U;
    EXPECT_GT(common, coarser.size() * 9 / 10) << level;  // almost nothing outside the finest level
    // most of the finest level is covered; thin twigs are removed
    EXPECT_GT(common, finest.size() * 7 / 10) << level;
  }
}

}  // namespace
}  // namespace seedmesh::lsystem
