#include "core/generators/building/blueprints/blueprints.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "core/base/math.h"
#include "core/generators/building/building.h"
#include "core/generators/child.h"
#include "core/geom/mesh/finish.h"
#include "core/registry/registry.h"
#include "generated/params/building.h"
#include "tests/core/building/blueprints/blueprint_shapes.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::building {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

const std::map<std::string, Json>& lots() {
  static const std::map<std::string, Json> all{
      {"church", {12, 0, 30}},       {"factory", {40, 0, 22}},        {"house", {11, 0, 9}},
      {"office_tower", {30, 0, 18}}, {"parisian_block", {30, 0, 16}}, {"skyscraper", {32, 0, 32}},
      {"temple", {16, 0, 32}},       {"terraced_house", {32, 0, 10}}, {"villa", {22, 0, 14}},
      {"warehouse", {42, 0, 26}}};
  return all;
}

Json request(std::string_view name) {
  return {{"blueprint", std::string(name)}, {"size", lots().at(std::string(name))}};
}

Result<Model> model_of(const Json& json, std::uint64_t seed) {
  IssueList faults;
  const Generator* generator = find_generator("building");
  const Generator::Params params =
      read_parameters(*generator, json, "", {Job(0, Job::Options{}), generators()}, faults);
  if (!faults.empty()) return Error{Code::invalid, faults.take()};
  Job job(seed, Job::Options{});
  try {
    Result<Model> model = generator->generate(params, context_of(job));
    if (model) finish(*model, job);
    return model;
  } catch (const Stop& stop) {
    return Error{stop.code(), {stop.issue()}};
  }
}

/// Of shapes that were replaced: what a rule's brackets leave has the rule's name too.
int count(const Json& shapes, std::string_view symbol) {
  int sum = 0;
  for (const Json& shape : shapes) sum += shape["symbol"] == symbol && !shape["active"].get<bool>();
  return sum;
}

/// Where the only shape of a symbol begins, and the way it looks.
struct Place {
  double x = 0, z = 0, out_x = 0, out_z = 0;
};
Place place_of(const Json& shapes, std::string_view symbol) {
  for (const Json& shape : shapes) {
    if (shape["symbol"] != symbol || shape["active"].get<bool>()) continue;
    const Json& scope = shape["scope"];
    return {scope["origin"][0], scope["origin"][2], scope["axes"][2][0], scope["axes"][2][2]};
  }
  ADD_FAILURE() << "no " << symbol;
  return {};
}

void expect_sound(const Json& json, std::uint64_t seed, const std::string& place) {
  const Result<Model> model = model_of(json, seed);
  if (!model) {
    ADD_FAILURE() << place << ": " << model.error().issues[0].message;
    return;
  }
  EXPECT_GT(seedmesh::count(*model).triangles, 50U) << place;
  EXPECT_THAT(faults(*model), IsEmpty()) << place;
  EXPECT_THAT(model->warnings, IsEmpty()) << place << ": " << model->warnings[0].message;
}

TEST(Blueprints, AreTheOnesOfTheSchema) {
  std::set<std::string_view> names;
  for (const Blueprint& blueprint : blueprints()) {
    names.insert(blueprint.name);
    EXPECT_EQ(lots().count(std::string(blueprint.name)), 1U) << blueprint.name;
    EXPECT_EQ(blueprint_named(blueprint.name), &blueprint);
  }
  EXPECT_THAT(names, SizeIs(10));
  EXPECT_EQ(blueprint_named("igloo"), nullptr);
}

TEST(Blueprints, ReplaceOnlyRules) {
  EXPECT_FALSE(model_of({{"blueprint", "house"}, {"rules", "A --> B."}}, 0));
  EXPECT_FALSE(model_of(Json::object(), 0));
  EXPECT_FALSE(model_of({{"blueprint", "house"}, {"attributes", {{"height", 3}}}}, 0))
      << "a house has floors";
}

TEST(Blueprints, AreSoundForManySeeds) {
  for (const auto& [name, size] : lots()) {
    for (std::uint64_t seed = 0; seed < 6; ++seed)
      expect_sound(request(name), seed, name + " " + std::to_string(seed));
  }
}

TEST(Blueprints, StandOnFootprintsOfAnyForm) {
  const Json l = Json::parse("[[[-14,-10],[14,-10],[14,2],[2,2],[2,12],[-14,12]]]");
  const Json court =
      Json::parse("[[[-20,-16],[20,-16],[20,10],[14,16],[-20,16]],[[-7,-4],[7,-4],[7,4],[-7,4]]]");
  const Json plus =
      Json::parse("[[[0,7],[7,7],[7,0],[14,0],[14,7],[21,7],[21,14],[14,14],[14,21],[7,21],[7,14],[0,14]]]");
  const Json oblique = Json::parse("[[[0,0],[20,4],[17,15],[-3,10]]]"),
             rectangle = Json::parse("[[[0,0],[22,0],[22,9],[0,9]]]");
  for (const auto& [name, size] : lots()) {
    for (const Json& footprint : {l, court, plus, oblique, rectangle}) {
      const Result<Model> model = model_of({{"blueprint", name}, {"footprint", footprint}}, 1);
      ASSERT_TRUE(model) << name << ": " << model.error().issues[0].message;
      EXPECT_GT(seedmesh::count(*model).triangles, 50U) << name;
      for (const Warning& warning : model->warnings) ADD_FAILURE() << name << ": " << warning.message;
    }
  }
}

/// Over arms of 6 m the ridge is 3 m times the tangent of the slope above the eaves.
TEST(Blueprints, TerracedHouseHasItsChimneysOnTheRoofOfEachWing) {
  const Json plus =
      Json::parse("[[[0,6],[6,6],[6,0],[12,0],[12,6],[18,6],[18,12],[12,12],[12,18],[6,18],[6,12],[0,12]]]");
  const Json shapes = shapes_of({{"blueprint", "terraced_house"}, {"footprint", plus}}, 1);
  const double ridge = 0.3 + 2 * 2.75 + 3 * std::tan(38 * 3.14159265358979 / 180);
  int chimneys = 0;
  for (const Json& shape : shapes) {
    if (shape["symbol"] != "Chimney") continue;
    ++chimneys;
    EXPECT_LT(shape["scope"]["origin"][1].get<double>(), ridge);
  }
  EXPECT_GE(chimneys, 3);
}

/// Every attribute at its ends and with each of its choices; one of them must show in the shapes.
TEST(Blueprints, UseEveryAttribute) {
  const std::regex range(R"(@Range\(([-0-9.]+), ([-0-9.]+)\) attr (\w+))"),
      choice(R"(@Enum\(([^)]*)\) attr (\w+))"), word(R"re("(\w+)")re");
  for (const Blueprint& blueprint : blueprints()) {
    const std::string rules(blueprint.rules);
    std::map<std::string, std::vector<Json>> values;
    for (std::sregex_iterator it(rules.begin(), rules.end(), range), end; it != end; ++it) {
      values[(*it)[3]] = {std::stod((*it)[1]), std::stod((*it)[2])};
    }
    for (std::sregex_iterator it(rules.begin(), rules.end(), choice), end; it != end; ++it) {
      const std::string list = (*it)[1];
      for (std::sregex_iterator w(list.begin(), list.end(), word); w != std::sregex_iterator(); ++w)
        values[(*it)[2]].push_back((*w)[1].str());
    }
    EXPECT_GE(values.size(), 4U) << blueprint.name;
    for (const auto& [attribute, given] : values) {
      std::set<std::string> results;
      for (const Json& value : given) {
        Json json = request(blueprint.name);
        for (const std::size_t axis : {0U, 2U}) json["size"][axis] = 0.7 * json["size"][axis].get<double>();
        json["attributes"] = {{attribute, value}};
        const Result<Model> model = model_of(json, 5);
        ASSERT_TRUE(model) << blueprint.name << " " << attribute << "=" << value.dump() << ": "
                           << model.error().issues[0].message;
        std::string result;
        for (const Material& material : model->materials)
          result += material.name + std::to_string(material.base_color.x) + " ";
        double sum = 0;
        for (const MeshGroup& group : model->meshes) {
          for (const Primitive& primitive : group.primitives) {
            for (const glm::vec3& p : primitive.mesh.position) sum += p.x * 3 + p.y * 5 + p.z * 7;
          }
        }
        results.insert(result + std::to_string(seedmesh::count(*model).triangles) + " " +
                       std::to_string(sum));
      }
      EXPECT_GT(results.size(), 1U) << blueprint.name << " " << attribute;
    }
  }
}

TEST(Blueprints, HouseHasItsDoorAnywhereInTheFrontAndWindowsAtRandom) {
  std::set<int> doors, windows;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Json shapes = shapes_of(request("house"), seed);
    EXPECT_EQ(count(shapes, "DoorLeaf"), 1) << seed;
    const Place door = place_of(shapes, "Door");
    EXPECT_NEAR(door.out_z, 1, 1e-9) << seed;
    doors.insert(door.x < -2 ? -1 : door.x > 2 ? 1 : 0);
    windows.insert(count(shapes, "Window"));
  }
  EXPECT_THAT(doors, SizeIs(3));
  EXPECT_GT(windows.size(), 4U);
}

TEST(Blueprints, HaveDoorsAndWindowsInSidesOfTwoMetres) {
  Json ring = Json::array();
  for (int i = 0; i < 24; ++i) {
    const math::SinCos turn = math::sincos_degrees(15.0 * i);
    ring.push_back({8 * turn.cos, 8 * turn.sin});
  }
  struct Openings {
    const char *blueprint, *door, *window;
    int least;  ///< of windows
  };
  for (const Openings& each : {Openings{"house", "Door", "Window", 24},
                               {"parisian_block", "Portal", "Window", 96},
                               {"warehouse", "OfficeDoor", "Light", 20},
                               {"office_tower", "EntranceDoor", "Window", 12},
                               {"church", "Portal", "TallWindow", 3},
                               {"skyscraper", "EntranceDoor", "ShopWindow", 12}}) {
    const Json shapes = shapes_of({{"blueprint", each.blueprint}, {"footprint", Json::array({ring})}}, 1);
    EXPECT_GE(count(shapes, each.door), 1) << each.blueprint;
    EXPECT_GE(count(shapes, each.window), each.least) << each.blueprint;
    expect_sound({{"blueprint", each.blueprint}, {"footprint", Json::array({ring})}}, 1, each.blueprint);
  }
}

TEST(Blueprints, ChurchHasItsDoorInTheTowerOrASide) {
  std::map<int, int> sides;
  std::set<int> windows;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Json shapes = shapes_of(request("church"), seed);
    EXPECT_EQ(count(shapes, "Portal"), 1) << seed;
    EXPECT_EQ(count(shapes, "Bell"), 1) << seed;
    const Place door = place_of(shapes, "Portal");
    ++sides[door.out_z > 0.5 ? 0 : door.out_x > 0.5 ? 1 : -1];
    windows.insert(count(shapes, "TallWindow"));
  }
  EXPECT_THAT(sides, SizeIs(3));
  EXPECT_GT(windows.size(), 3U);
}

TEST(Blueprints, FactoryHasFourTeethAndItsGateAnywhere) {
  std::set<int> gates, windows;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Json shapes = shapes_of(request("factory"), seed);
    EXPECT_EQ(count(shapes, "Tooth"), 4) << seed;
    EXPECT_EQ(count(shapes, "GateLeaf"), 1) << seed;
    gates.insert(static_cast<int>(place_of(shapes, "Gate").x / 8));
    windows.insert(count(shapes, "Window"));
  }
  EXPECT_GT(gates.size(), 3U);
  EXPECT_GT(windows.size(), 3U);
}

TEST(Blueprints, SkyscraperHasEitherRoofAndADoorOnAnySide) {
  std::set<bool> roofs;
  std::set<std::pair<int, int>> sides;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Json shapes = shapes_of(
        {{"blueprint", "skyscraper"}, {"size", {14, 0, 14}}, {"attributes", {{"height", 30}}}}, seed);
    roofs.insert(count(shapes, "Mast") == 1);
    EXPECT_EQ(count(shapes, "Entrance"), 1) << seed;
    const Place door = place_of(shapes, "Entrance");
    sides.emplace(static_cast<int>(1.5 * door.out_x), static_cast<int>(1.5 * door.out_z));
  }
  EXPECT_THAT(roofs, SizeIs(2));
  EXPECT_THAT(sides, SizeIs(4));
}

TEST(Blueprints, VillaHasNoWindowBehindThePorticosRoof) {
  for (const int floors : {2, 3}) {
    Json json = request("villa");
    json["attributes"] = {{"floors", floors}, {"floor_height", 3.8}, {"wealth", 0.7}};
    // The front is 22 m wide and looks to z = 7; the portico begins at 0.31 of it and its roof stands out
    // 0.35 m.
    const double half = 0.19 * 22 + 0.35, eaves = 1.5 + 3.8 + 0.7, ridge = eaves + 2.8;
    int seen = 0, beside = 0;
    for (const Json& shape : shapes_of(json, 1)) {
      if (shape["symbol"] != "Window" || shape["active"]) continue;
      const Json &origin = shape["scope"]["origin"], &size = shape["scope"]["size"];
      if (std::abs(origin[2].get<double>() - 7) > 1e-6) continue;
      const double low = origin[1], high = low + size[1].get<double>();
      if (high < eaves || low > ridge) continue;
      const double left = origin[0], right = left + size[0].get<double>();
      seen += right > -half && left < half;
      beside += right < -half || left > half;
    }
    EXPECT_EQ(seen, 0) << floors;
    EXPECT_GE(beside, 4) << floors;
  }
}

/// Linear luminance of what is on a facade in any light: glass as dark as a pane before an unlit room, paint
/// and plaster no lighter than fresh lime.
TEST(Blueprints, HaveColoursThatAreSafeInAnyLight) {
  for (const auto& [name, size] : lots()) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Result<Model> model = model_of(request(name), seed);
      ASSERT_TRUE(model) << name;
      for (const Material& material : model->materials) {
        const glm::vec4& color = material.base_color;
        const float luminance = 0.2126F * color.x + 0.7152F * color.y + 0.0722F * color.z;
        EXPECT_LE(luminance, 0.76F) << name << " " << material.name;
        if (!material.name.starts_with("glass")) continue;
        EXPECT_GE(luminance, 0.02F) << name;
        EXPECT_LE(luminance, 0.06F) << name;
        EXPECT_LE(material.roughness, 0.12F) << name;
      }
    }
  }
}

/// Texture coordinates of a wall go from 0 to the number of its bays and floors.
TEST(Blueprints, HaveWholeBaysWithWindowsWhereTheyAreMassesAlone) {
  const std::map<std::string, int> floors{
      {"house", 2}, {"office_tower", 6}, {"parisian_block", 4}, {"terraced_house", 3}, {"villa", 2}};
  for (const auto& [name, count] : floors) {
    Json json = request(name);
    json["attributes"] = {{"lod", 2}, {"floors", count}};
    if (name == "office_tower") json["attributes"]["style"] = "brick";
    const Result<Model> model = model_of(json, 3);
    ASSERT_TRUE(model) << name;
    std::size_t walls = 0;
    for (const MeshGroup& group : model->meshes) {
      for (const Primitive& primitive : group.primitives) {
        const Material& material = model->materials[static_cast<std::size_t>(primitive.material)];
        if (!material.recipe.kind.ends_with("_bay")) continue;
        float highest = 0;
        for (const glm::vec2& uv : primitive.mesh.uv[0]) {
          EXPECT_NEAR(uv.x, std::round(uv.x), 1e-4) << name;
          EXPECT_NEAR(uv.y, std::round(uv.y), 1e-4) << name;
          highest = std::max({highest, uv.y, -uv.y});
        }
        // Bases and shops have windows, too.
        EXPECT_GE(highest, static_cast<float>(count)) << name;
        EXPECT_LE(highest, static_cast<float>(count) + 1) << name;
        walls += primitive.mesh.elements() / 2;
      }
    }
    EXPECT_GE(walls, name == "terraced_house" ? 8U : 4U) << name;
  }
}

TEST(Blueprints, HaveAPictureOnEveryPartButOpeningsAndMetal) {
  for (const auto& [name, size] : lots()) {
    const Result<Model> model = model_of(request(name), 3);
    ASSERT_TRUE(model) << name;
    double plain = 0, all = 0;
    for (const Node& node : model->nodes) {
      if (node.mesh < 0) continue;
      const auto copies = static_cast<double>(std::max<std::size_t>(node.instances.transforms.size(), 1));
      for (const Primitive& primitive : model->meshes[static_cast<std::size_t>(node.mesh)].primitives) {
        const Material& material = model->materials[static_cast<std::size_t>(primitive.material)];
        const double area = copies * measure({&primitive.mesh}).area;
        const bool is_opening = material.name.starts_with("glass") || material.name.starts_with("frame");
        if (is_opening || material.metallic > 0.5F) continue;
        all += area;
        if (material.recipe.kind.empty()) plain += area;
      }
    }
    EXPECT_LE(plain, 0.05 * all) << name;
  }
}

}  // namespace
}  // namespace seedmesh::building
