/// CoplanarRectangles between walls, and the pictures that walls wear.
#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <utility>

#include "core/base/math.h"
#include "core/texture/wall.h"
#include "tests/core/building/rules.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::building {
namespace {

using testing::IsEmpty;

BuildingParams blueprint(BuildingBlueprint name) {
  BuildingParams params;
  params.blueprint = name;
  return params;
}

/// How often a vertex lies within an edge of another triangle of the same plane.
std::size_t corners_on_edges(const Model& model) {
  struct Edge {
    glm::dvec3 from, to, normal;
  };
  std::vector<Edge> edges;
  for (const MeshGroup& mesh : model.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      const Mesh& m = primitive.mesh;
      for (std::size_t i = 0; i < m.index.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        edges.push_back({m.position[m.index.at(i)], m.position[m.index.at(next)], m.normal[m.index.at(i)]});
      }
    }
  }
  std::size_t count = 0;
  for (const Edge& edge : edges) {
    const glm::dvec3 along = edge.to - edge.from;
    const double squared = glm::dot(along, along);
    for (const Edge& other : edges) {
      if (glm::dot(edge.normal, other.normal) < 0.999) continue;
      const double share = glm::dot(other.from - edge.from, along) / squared;
      if (share < 1e-4 || share > 1 - 1e-4) continue;
      count += glm::length(edge.from + along * share - other.from) < 1e-5 ? 1U : 0U;
    }
  }
  return count;
}

constexpr const char* picture =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAA"
    "AElFTkSuQmCC";

/// Hutsko 2022, figures 2.11 and 2.12: a picture of the facade, whatever the style draws.
TEST(FacadeImage, CoversTheWallsOfEveryStyle) {
  for (const char* style : {"plaster", "brick", "wood"}) {
    BuildingParams params = blueprint(BuildingBlueprint::house);
    params.attributes["style"] = std::string(style);
    params.facade_image = picture;
    params.facade_tile = {4, 2};
    const Model model = model_of(params);
    double area = 0;
    for (const MeshGroup& group : model.meshes) {
      for (const Primitive& primitive : group.primitives) {
        const Material& material = model.materials[static_cast<std::size_t>(primitive.material)];
        // Walls are tinted; the part that makes a chimney is plain brick, and shutters have a tint of their own.
        // Of the walls only what looks down over an opening has no picture.
        if (material.name.starts_with(style + std::string("_")) && material.name != "wood_55675a") {
          for (const glm::vec3& normal : primitive.mesh.normal) EXPECT_LT(normal.y, -0.99) << material.name;
        }
        if (material.name != "facade") continue;
        EXPECT_GE(material.base_color_texture.texture, 0);
        const Mesh& mesh = primitive.mesh;
        for (const glm::vec3& normal : mesh.normal) EXPECT_NEAR(normal.y, 0, 1e-3);
        for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
          const std::uint32_t a = mesh.index.at(i), b = mesh.index.at(i + 1), c = mesh.index.at(i + 2);
          const glm::vec3 cross =
              glm::cross(mesh.position[b] - mesh.position[a], mesh.position[c] - mesh.position[a]);
          const glm::vec2 u = mesh.uv[0][b] - mesh.uv[0][a], v = mesh.uv[0][c] - mesh.uv[0][a];
          // One copy of the picture covers 4 m by 2 m.
          EXPECT_NEAR(glm::length(cross), 8 * std::abs(u.x * v.y - u.y * v.x), 1e-3);
          area += 0.5 * static_cast<double>(glm::length(cross));
        }
      }
    }
    EXPECT_GT(area, 50) << style;
    EXPECT_TRUE(model.warnings.empty());
  }
}

TEST(FacadeImage, IsReportedWhereNoWallShowsIt) {
  BuildingParams params = with("Lot --> color(\"#ff0000\") comp(f){ all: Red. }");
  params.facade_image = picture;
  const Model model = model_of(params);
  ASSERT_EQ(model.warnings.size(), 1U);
  EXPECT_EQ(model.warnings[0].pointer, "/facade_image");
  params.facade_image = "facade.png";
  EXPECT_EQ(check(params, Limits{}).front().pointer, "/facade_image");
}

TEST(CoplanarRectangles, GiveAnEdgeTheCornersOfItsNeighbours) {
  const BuildingParams params = with(
      "Lot --> comp(f){ front: split(y){ 3: Low. | ~1: split(x){ ~2: Wall. | 1: split(y){ ~1: Wall. | 2: "
      "Hole. | ~1: Wall. } }* } }",
      {11, 9, 1});
  const Model model = model_of(params);
  EXPECT_EQ(corners_on_edges(model), 0U);
  EXPECT_THAT(faults(model), IsEmpty());
  EXPECT_EQ(model.meshes.size(), 1U);
  double area = 0;
  for (const Primitive& each : model.meshes[0].primitives) area += measure({&each.mesh}).area;
  EXPECT_NEAR(area, 99, 1e-3);
}

TEST(CoplanarRectangles, PutAStripBehindASideWithManyCorners) {
  const auto made = [](const char* tile) {
    return model_of(with(
        std::string("Lot --> comp(f){ front: split(y){ 1: Low. | ~1: split(x){ ") + tile + ": Wall. }* } }",
        {20, 4, 1}));
  };
  EXPECT_EQ(count(made("4")).triangles, 2U + 4 + 5 * 2);
  const Model many = made("1");
  EXPECT_EQ(count(many).triangles, 2U + 2 + 20 * 2);
  EXPECT_THAT(faults(many), IsEmpty());
  // The strip is as long as the wall and some millimetres behind it, above and below where the two meet.
  float front = -1e9F, behind = 1e9F, low = 1e9F, high = -1e9F;
  const Array<glm::vec3>& position = many.meshes[0].primitives[0].mesh.position;
  for (const glm::vec3& p : position.span()) front = std::max(front, p.z);
  for (const glm::vec3& p : position.span()) {
    if (p.z == front) continue;
    behind = std::min(behind, p.z);
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  EXPECT_NEAR(front - behind, 0.0012, 0.0002);
  EXPECT_NEAR(high - 1, 0.002, 0.0002);
  EXPECT_NEAR(1 - low, 0.002, 0.0002);
}

TEST(CoplanarRectangles, MakeOneMeshOfWallsAroundACorner) {
  const Model model = model_of(with("Lot --> comp(f){ side: split(x){ ~2: split(y){ ~2: Wall. }* }* }"));
  EXPECT_EQ(model.meshes.size(), 1U);
  EXPECT_EQ(measure({&model.meshes[0].primitives[0].mesh}).open_edges, 40U);  // above and below
  EXPECT_THAT(faults(model), IsEmpty());
}

TEST(Layers, OfBlueprintsAreFew) {
  for (const BuildingBlueprint name : {BuildingBlueprint::house, BuildingBlueprint::terraced_house,
                                       BuildingBlueprint::villa, BuildingBlueprint::warehouse}) {
    const Model model = model_of(blueprint(name), 1);
    std::size_t draws = 0;
    for (const Node& node : model.nodes)
      draws += node.mesh < 0 ? 0 : model.meshes[static_cast<std::size_t>(node.mesh)].primitives.size();
    EXPECT_LE(draws, model.materials.size() + 8) << text_of(name);
    EXPECT_THAT(faults(model), IsEmpty()) << text_of(name);
  }
}

std::set<std::string> kinds_of(const Model& model) {
  std::set<std::string> kinds;
  for (const Material& material : model.materials) {
    if (!material.recipe.kind.empty()) kinds.insert(material.recipe.kind);
  }
  return kinds;
}

TEST(Surfaces, OfBlueprintsAreTexturesWithCoordinatesInMetres) {
  BuildingParams params = blueprint(BuildingBlueprint::house);
  params.attributes["style"] = std::string("brick");
  const Model model = model_of(params);
  EXPECT_EQ(kinds_of(model).count("brick"), 1U);
  std::size_t seen = 0;
  for (const MeshGroup& mesh : model.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      const Material& material = model.materials[static_cast<std::size_t>(primitive.material)];
      EXPECT_EQ(primitive.mesh.uv[0].empty(), material.recipe.kind.empty()) << material.name;
      // Doors, rooms and dirt show a fixed part of a texture at any size.
      const std::set<std::string> fixed{"joinery", "rooms", "grime"};
      if (material.recipe.kind.empty() || fixed.contains(material.recipe.kind)) continue;
      const glm::dvec2 tile = texture::wall_kind(material.recipe.kind)->tile;
      const Mesh& m = primitive.mesh;
      for (std::size_t t = 0; t < m.index.size(); t += 3) {
        const std::uint32_t a = m.index.at(t), b = m.index.at(t + 1);
        const glm::dvec2 on_wall = glm::dvec2(m.uv[0][b] - m.uv[0][a]) * tile;
        const glm::vec3 in_space = m.position[b] - m.position[a];
        ASSERT_NEAR(glm::length(on_wall), glm::length(in_space), 1e-3);
        // Upright is down in glTF's pictures. The normals of round faces are smooth, so those of the triangle count.
        const glm::vec3 across = glm::cross(in_space, m.position[m.index.at(t + 2)] - m.position[a]);
        if (std::abs(across.y) < 1e-6F * glm::length(across)) {
          ASSERT_NEAR(on_wall.y, -in_space.y, 1e-3);
        }
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 100U);
}

TEST(Surfaces, OfRoundWallsAreNotStretched) {
  BuildingParams params =
      with("Lot --> t(7, 0, 3) color(\"#96594a\") material(\"brick\") i(\"cylinder\") W.");
  params.textures = BuildingTextures::made;
  const Model model = model_of(params);
  const Mesh& m = model.meshes[0].primitives[0].mesh;
  const glm::dvec2 tile = texture::wall_kind("brick")->tile;
  ASSERT_GT(m.uv[0].size(), 24U);
  for (std::size_t i = 0; i < m.index.size(); ++i) {
    const std::uint32_t a = m.index.at(i), b = m.index.at(i % 3 == 2 ? i - 2 : i + 1);
    ASSERT_NEAR(glm::length(glm::dvec2(m.uv[0][b] - m.uv[0][a]) * tile),
                glm::length(glm::dvec3(m.position[b] - m.position[a])), 1e-3);
  }
}

TEST(Surfaces, AreLeftOutOnRequest) {
  BuildingParams params = blueprint(BuildingBlueprint::house);
  params.textures = BuildingTextures::none;
  const Model by_request = model_of(params);
  Job job(0, Job::Options{});
  params.textures = BuildingTextures::auto_;
  Result<Model> by_output = generate(params, context_of(job, {.textures = 0}));
  ASSERT_TRUE(by_output);
  for (const Model* model : {&by_request, std::as_const(by_output).operator->()}) {
    EXPECT_THAT(kinds_of(*model), IsEmpty());
    for (const MeshGroup& mesh : model->meshes) {
      for (const Primitive& primitive : mesh.primitives) EXPECT_TRUE(primitive.mesh.uv[0].empty());
    }
  }
  // The colours are those that the pictures have.
  const Model textured = model_of(blueprint(BuildingBlueprint::house));
  for (std::size_t i = 0; i < textured.materials.size(); ++i)
    EXPECT_EQ(textured.materials[i].base_color, by_request.materials[i].base_color);
}

TEST(Surfaces, OfOwnRulesNeedARequest) {
  BuildingParams params =
      with("Lot --> comp(f){ front: color(\"#203040\") material(\"brick\") B. | side: W. }");
  EXPECT_THAT(kinds_of(model_of(params)), IsEmpty());
  params.textures = BuildingTextures::made;
  const Model made = model_of(params);
  EXPECT_EQ(kinds_of(made), (std::set<std::string>{"brick", "plaster"}));
  EXPECT_EQ(made.materials[0].recipe.color->at(2), 0x40);
  params.textures = BuildingTextures::auto_;
  params.materials["brick"].texture = BuildingTexture::ashlar;
  params.materials["brick"].texture_seed = 5;
  const Model own = model_of(params);
  EXPECT_EQ(kinds_of(own), std::set<std::string>{"ashlar"});
  EXPECT_EQ(own.materials[0].recipe.seed, 5U);
  params.materials["brick"].texture = BuildingTexture::none;
  params.textures = BuildingTextures::made;
  EXPECT_EQ(kinds_of(model_of(params)), std::set<std::string>{"plaster"});
}

TEST(Materials, StoneOfAPartTakesTheCurrentColour) {
  const auto materials = [](const char* rules, std::map<std::string, BuildingMaterial> given = {}) {
    BuildingParams params = with(rules, {1, 3, 1});
    params.materials = std::move(given);
    std::set<std::string> names;
    for (const Material& each : model_of(params).materials) names.insert(each.name);
    return names;
  };
  EXPECT_THAT(materials("A --> i(\"column\")"), testing::ElementsAre("stone"));
  EXPECT_THAT(materials("A --> color(\"#E2DDD0\") i(\"column\")"), testing::ElementsAre("color_e2ddd0"));
  // Two of one size and two colours are two.
  EXPECT_THAT(
      materials("A --> [ color(\"#e2ddd0\") i(\"ledge\") ] t(0, 4, 0) color(\"#804020\") i(\"ledge\")"),
      testing::ElementsAre("color_804020", "color_e2ddd0"));
  // Frames, panes and what the request says of stone stay.
  EXPECT_FALSE(materials("A --> color(\"#e2ddd0\") i(\"window\")").contains("color_e2ddd0"));
  EXPECT_THAT(materials("A --> color(\"#e2ddd0\") i(\"column\")", {{"stone", {}}}),
              testing::ElementsAre("stone"));
}

}  // namespace
}  // namespace seedmesh::building
