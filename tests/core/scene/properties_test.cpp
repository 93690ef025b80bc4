/// Properties of every scene, over hundreds of random ones. Everything is recomputed from the request and the
/// placements by brute force: every placement against every other.
#include <cmath>

#include "core/base/math.h"
#include "core/pipeline.h"
#include "tests/core/scene/by_chance.h"
#include "tests/core/scene/support.h"

namespace seedmesh {
namespace {

using scene::Placement;

constexpr double tiny = 1e-6;

/// The footprint of a placement: a polygon of its corners, or a disc.
struct Base {
  glm::dvec2 at;
  double radius = 0;                ///< radius of a disc, else 0
  std::vector<glm::dvec2> corners;  ///< corners of a rectangle, in order
};

Base base_of(const Json& layer, const Placement& placement) {
  Base base{placement.at, 0, {}};
  const double scale = static_cast<double>(placement.scale);
  const Json& given = layer["footprint"];
  if (given.is_number()) {
    base.radius = given.get<double>() * scale;
    return base;
  }
  const double angle = static_cast<double>(placement.turn), cos = std::cos(angle), sin = std::sin(angle);
  const double width = given[0].get<double>() * scale / 2, depth = given[1].get<double>() * scale / 2;
  for (const auto& [u, v] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
    const double x = u * width, z = v * depth;
    base.corners.push_back(placement.at + glm::dvec2(x * cos + z * sin, -x * sin + z * cos));
  }
  return base;
}

double distance_to_line(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  const glm::dvec2 way = b - a;
  const double squared = glm::dot(way, way);
  const double share = squared > 0 ? glm::clamp(glm::dot(p - a, way) / squared, 0.0, 1.0) : 0;
  return glm::distance(p, a + share * way);
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Returns the distance of a point from a footprint; 0 inside.
double distance_of(const Base& base, const glm::dvec2& p) {
  if (base.corners.empty()) return std::max(0.0, glm::distance(base.at, p) - base.radius);
  double nearest = 1e30;
  bool left = true, right = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 &a = base.corners[i], &b = base.corners[(i + 1) % 4];
    nearest = std::min(nearest, distance_to_line(a, b, p));
    (cross(b - a, p - a) > 0 ? right : left) = false;
  }
  return left || right ? 0 : nearest;
}

/// Returns true where two footprints overlap, tested by their edges and corners.
bool intersects(const Base& a, const Base& b) {
  if (a.corners.empty()) return glm::distance(a.at, b.at) < a.radius + b.radius - 1e-4;
  const auto is_deep_inside = [](const Base& base, const glm::dvec2& p) {
    if (distance_of(base, p) > 0) return false;
    double edge = 1e30;
    for (std::size_t i = 0; i < 4; ++i)
      edge = std::min(edge, distance_to_line(base.corners[i], base.corners[(i + 1) % 4], p));
    return edge > 1e-4;
  };
  for (std::size_t i = 0; i < 4; ++i) {
    if (is_deep_inside(a, b.corners[i]) || is_deep_inside(b, a.corners[i])) return true;
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::dvec2 &p = a.corners[i], &q = a.corners[(i + 1) % 4], &r = b.corners[k],
                       &s = b.corners[(k + 1) % 4];
      const double one = cross(q - p, r - p), two = cross(q - p, s - p);
      const double three = cross(s - r, p - r), four = cross(s - r, q - r);
      if (one * two < -1e-3 && three * four < -1e-3) return true;
    }
  }
  return is_deep_inside(a, b.at) || is_deep_inside(b, a.at);
}

void expect_within(const Json& limits, double value, const std::string& what) {
  if (limits.contains("from")) {
    EXPECT_GE(value, limits["from"].get<double>() - tiny) << what;
  }
  if (limits.contains("to")) {
    EXPECT_LE(value, limits["to"].get<double>() + tiny) << what;
  }
}

bool is_inside(const Json& area, const glm::dvec2& p) {
  double turned = 0;  // winding number
  for (std::size_t i = 0; i < area.size(); ++i) {
    const auto corner = [&](std::size_t k) {
      const Json& at = area[k % area.size()];
      return glm::dvec2(at[0].get<double>(), at[1].get<double>()) - p;
    };
    const glm::dvec2 a = corner(i), b = corner(i + 1);
    turned += std::atan2(cross(a, b), glm::dot(a, b));
  }
  return std::abs(turned) > 3;
}

class Checked {
 public:
  Checked(const Json& json, std::uint64_t seed) : json_(json), made_(planted(json, seed)) {}

  const Planted& made() const { return made_; }

  void check() const {
    for (std::size_t i = 0; i < json_["layers"].size(); ++i) {
      check_ground(i);
      check_neighbours(i);
      check_bases(i);
      check_crowns(i);
    }
  }

 private:
  const Json& layer(std::size_t i) const { return json_["layers"][i]; }

  void check_ground(std::size_t i) const {
    const Json& place = layer(i)["place"];
    for (const Placement& placement : made_.layer(i)) {
      EXPECT_TRUE(made_.ground.contains(placement.at, place.value("edge", 0.0)));
      expect_within({{"from", layer(i)["scale"][0]}, {"to", layer(i)["scale"][1]}},
                    static_cast<double>(placement.scale), "scale");
      if (place.contains("area")) {
        EXPECT_TRUE(is_inside(place["area"], placement.at));
      }
      if (i == 0 && layer(i).contains("foundation")) continue;  // its foundation has changed its own ground
      const double height = made_.ground.height(placement.at);
      const double slope = std::atan(glm::length(made_.ground.gradient(placement.at))) * 180 / math::pi;
      if (place.contains("slope")) expect_within(place["slope"], slope, "slope");
      if (place.contains("altitude")) expect_within(place["altitude"], height, "altitude");
      if (made_.ground.water()) {
        EXPECT_GE(height, *made_.ground.water());
      }
    }
  }

  void check_neighbours(std::size_t i) const {
    const Json& place = layer(i)["place"];
    const Array<Placement>& own = made_.layer(i);
    if (place.value("method", "poisson") == "poisson") {
      for (std::size_t a = 0; a < own.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b)
          EXPECT_GE(glm::distance(own[a].at, own[b].at), place["distance"].get<double>());
      }
    }
    for (const Placement& placement : own) {
      if (place.contains("near")) {
        const Json& near = place["near"][0];
        double nearest = 1e30;
        for (std::size_t k = 0; k < i; ++k) {
          if (layer(k)["name"] != near["layer"]) continue;
          for (const Placement& other : made_.layer(k))
            nearest = std::min(nearest, glm::distance(other.at, placement.at));
        }
        expect_within(near, nearest, "near");
      }
      if (place.contains("shade")) expect_within(place["shade"], shade(i, placement.at), "shade");
    }
  }

  double shade(std::size_t before, const glm::dvec2& p) const {
    double light = 1;
    for (std::size_t k = 0; k < before; ++k) {
      for (const Placement& other : made_.layer(k)) {
        const double crown = layer(k).value("crown", 0.0) * static_cast<double>(other.scale);
        const double distance = glm::distance(other.at, p);
        if (distance < crown) light *= distance * distance / (crown * crown);
      }
    }
    return 1 - light;
  }

  void check_bases(std::size_t i) const {
    const bool has_base = layer(i).contains("footprint");
    for (const Placement& placement : made_.layer(i)) {
      double reach = 0;
      if (has_base) {
        const Base own = base_of(layer(i), placement);
        reach = own.corners.empty() ? own.radius : glm::distance(own.at, own.corners[0]);
        for (const Placement* other = made_.layer(i).begin(); other != &placement; ++other)
          EXPECT_FALSE(intersects(base_of(layer(i), *other), own)) << "two of layer " << i;
      }
      for (std::size_t k = 0; k < i; ++k) {
        if (!layer(k).contains("footprint")) continue;
        for (const Placement& other : made_.layer(k))
          EXPECT_GE(distance_of(base_of(layer(k), other), placement.at), reach - 1e-4) << k << " and " << i;
      }
      for (const Json& path : json_.value("paths", Json::array())) {
        const Json& points = path["points"];
        for (std::size_t k = 1; k < points.size(); ++k) {
          const glm::dvec2 a(points[k - 1][0].get<double>(), points[k - 1][1].get<double>());
          const glm::dvec2 b(points[k][0].get<double>(), points[k][1].get<double>());
          EXPECT_GE(distance_to_line(a, b, placement.at), path["width"].get<double>() / 2 + reach - 1e-4);
        }
      }
    }
  }

  void check_crowns(std::size_t i) const {
    const double competition = json_.value("competition", 0.0), own = layer(i).value("crown", 0.0);
    if (competition == 0 || own == 0) return;
    for (std::size_t k = 0; k <= i; ++k) {
      const double crown = layer(k).value("crown", 0.0);
      if (crown == 0) continue;
      for (const Placement& a : made_.layer(i)) {
        for (const Placement& b : made_.layer(k)) {
          if (&a == &b) continue;
          const double least =
              competition * (own * static_cast<double>(a.scale) + crown * static_cast<double>(b.scale));
          EXPECT_GE(glm::distance(a.at, b.at), least - 1e-4);
        }
      }
    }
  }

  Json json_;
  Planted made_;
};

TEST(SceneProperties, EveryRuleIsKeptInEveryRandomScene) {
  std::size_t placements = 0;
  for (std::uint64_t seed = 0; seed < 300 && !testing::Test::HasFailure(); ++seed) {
    const Json json = scene_by_chance(seed);
    SCOPED_TRACE(json.dump());
    const Checked checked(json, seed);
    checked.check();
    for (std::size_t i = 0; i < json["layers"].size(); ++i) placements += checked.made().layer(i).size();
  }
  EXPECT_GT(placements, 10'000U) << "the rules leave too few placements to check";
}

TEST(SceneProperties, AnotherRuleOfOneLayerMovesNoOther) {
  for (std::uint64_t seed = 0; seed < 100 && !testing::Test::HasFailure(); ++seed) {
    Json json = scene_by_chance(seed);
    json.erase("competition");
    for (Json& layer : json["layers"]) {  // dependencies between layers
      for (const char* name : {"footprint", "foundation"}) layer.erase(name);
      for (const char* name : {"near", "shade"}) layer["place"].erase(name);
    }
    SCOPED_TRACE(json.dump());
    const Planted before = planted(json, seed);
    const std::size_t changed = seed % json["layers"].size();
    json["layers"][changed]["place"].update({{"edge", 9}, {"slope", {{"to", 12}}}});
    json["layers"][changed].update({{"scale", 2}, {"turn", 0}, {"variants", 5}});
    const Planted after = planted(json, seed);
    for (std::size_t i = 0; i < json["layers"].size(); ++i) {
      if (i == changed) continue;
      ASSERT_EQ(before.layer(i).size(), after.layer(i).size());
      for (std::size_t k = 0; k < before.layer(i).size(); ++k) {
        EXPECT_EQ(before.layer(i)[k].at, after.layer(i)[k].at);
        EXPECT_EQ(before.layer(i)[k].scale, after.layer(i)[k].scale);
        EXPECT_EQ(before.layer(i)[k].turn, after.layer(i)[k].turn);
      }
    }
  }
}

TEST(SceneProperties, TheNumberOfThreadsMovesNothing) {
  for (std::uint64_t seed = 0; seed < 80 && !testing::Test::HasFailure(); ++seed) {
    const Json json = scene_by_chance(seed);
    SCOPED_TRACE(json.dump());
    const Planted one = planted(json, seed, 1), eight = planted(json, seed, 8);
    for (std::size_t i = 0; i < json["layers"].size(); ++i) {
      ASSERT_EQ(one.layer(i).size(), eight.layer(i).size());
      for (std::size_t k = 0; k < one.layer(i).size(); ++k) {
        EXPECT_EQ(one.layer(i)[k].at, eight.layer(i)[k].at);
        EXPECT_EQ(one.layer(i)[k].key, eight.layer(i)[k].key);
        EXPECT_EQ(one.ground.height(one.layer(i)[k].at), eight.ground.height(one.layer(i)[k].at));
      }
    }
  }
}

/// Returns all copies of the nodes of a layer, with the squares in their names.
void expect_all_copies(const Model& model, const Json& json, const Planted& made, std::size_t i) {
  const Generator::Params params = read_scene_params(json);
  const std::string name = json["layers"][i]["name"];
  std::vector<glm::vec3> shown, wanted;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0 || node.parent < 0 || model.nodes[static_cast<std::size_t>(node.parent)].name != name)
      continue;
    if (node.instances.transforms.empty()) shown.push_back(node.transform.translation);
    for (const Transform& each : node.instances.transforms) shown.push_back(each.translation);
  }
  for (const Placement& placement : made.layer(i))
    wanted.push_back(scene::transform_of(placement, own(params).layers[i], made.ground).translation);
  const auto by_position = [](const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::sort(shown.begin(), shown.end(), by_position);
  std::sort(wanted.begin(), wanted.end(), by_position);
  EXPECT_EQ(shown, wanted) << name;
}

TEST(SceneProperties, TheModelShowsEveryPlacementOnceForAnyChunks) {
  for (std::uint64_t seed = 0; seed < 60 && !testing::Test::HasFailure(); ++seed) {
    const Json json = scene_by_chance(seed);
    SCOPED_TRACE(json.dump());
    const Result<Model> model = scene_of(json, seed);
    ASSERT_TRUE(model);
    EXPECT_THAT(faults(*model), testing::IsEmpty());
    const Planted made = planted(json, seed);
    for (std::size_t i = 0; i < json["layers"].size(); ++i) expect_all_copies(*model, json, made, i);
  }
}

TEST(SceneProperties, FoundationsStayLevelBesideEachOther) {
  for (std::uint64_t seed = 0; seed < 40 && !testing::Test::HasFailure(); ++seed) {
    Rng rng = Rng::of_seed(seed).at("foundations");
    Json json = {{"layers", Json::array()}};
    json["terrain"] = {{"generator", "terrain"},
                       {"seed", seed},
                       {"parameters", {{"iterations", 6}, {"size", 120}, {"amplitude", 15}, {"hurst", 0.9}}}};
    json["layers"].push_back({{"name", "house"},
                              {"model", cube()},
                              {"variants", 1},
                              {"footprint", {rng.uniform(4, 12), rng.uniform(4, 12)}},
                              {"foundation", {{"slope_width", rng.uniform(0, 6)}}},
                              {"place", {{"method", "scatter"}, {"count", 12}, {"edge", 8}}}});
    const Planted made = planted(json, seed);
    EXPECT_GT(made.layer(0).size(), 3U);
    for (const Placement& house : made.layer(0)) {
      const double height = made.ground.height(house.at);
      const Base base = base_of(json["layers"][0], house);
      for (int i = 0; i < 200; ++i) {
        const double u = rng.unit(), v = rng.unit();
        const glm::dvec2 p = base.corners[0] + u * (base.corners[1] - base.corners[0]) +
                             v * (base.corners[3] - base.corners[0]);
        ASSERT_NEAR(made.ground.height(p), height, 1e-4);
      }
    }
  }
}

/// Returns the copies of a layer with their meshes.
std::vector<std::pair<Transform, int>> copies_of(const Model& model, const std::string& layer) {
  std::vector<std::pair<Transform, int>> copies;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0 || node.parent < 0 || model.nodes[static_cast<std::size_t>(node.parent)].name != layer)
      continue;
    if (node.instances.transforms.empty()) copies.emplace_back(node.transform, node.mesh);
    for (const Transform& each : node.instances.transforms) copies.emplace_back(each, node.mesh);
  }
  return copies;
}

/// Returns the area inside the walls of a house, at the height of a person.
Box walls_of(const MeshGroup& house) {
  Box box{glm::vec3(1e9F), glm::vec3(-1e9F)};
  for (const Primitive& primitive : house.primitives) {
    for (const glm::vec3& p : primitive.mesh.position) {
      if (p.y < 0.8F || p.y > 2.5F) continue;  // skips steps and roofs
      box = {glm::min(box.min, p), glm::max(box.max, p)};
    }
  }
  return box;
}

TEST(SceneProperties, NoPlantOfAPresetStandsInAHouse) {
  for (const char* preset : {"village_edge", "hutsko_garden"}) {
    const Result<Request> request = read_request(Json{{"preset", preset}}.dump(), Limits{});
    ASSERT_TRUE(request);
    const Json parameters = Json::parse(request->canonical())["parameters"];
    const Result<Model> model = scene_of(parameters, request->seed());
    ASSERT_TRUE(model);
    std::vector<std::pair<Transform, int>> houses, plants;
    for (const Json& layer : parameters["layers"]) {
      auto& to = layer["model"]["generator"] == "building" ? houses : plants;
      for (const auto& copy : copies_of(*model, layer["name"])) to.push_back(copy);
    }
    EXPECT_GE(houses.size(), 1U) << preset;
    EXPECT_GE(plants.size(), 50U) << preset;
    for (const auto& [house, mesh] : houses) {
      const Box walls = walls_of(model->meshes[static_cast<std::size_t>(mesh)]);
      ASSERT_LT(walls.min.x, walls.max.x) << preset;
      for (const auto& [plant, its_mesh] : plants) {
        const glm::vec3 p =
            glm::inverse(house.rotation) * (plant.translation - house.translation) / house.scale;
        const bool is_inside =
            p.x > walls.min.x && p.x < walls.max.x && p.z > walls.min.z && p.z < walls.max.z;
        EXPECT_FALSE(is_inside) << preset << ": " << model->meshes[static_cast<std::size_t>(its_mesh)].name;
      }
    }
  }
}

}  // namespace
}  // namespace seedmesh
