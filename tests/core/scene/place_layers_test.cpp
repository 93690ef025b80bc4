/// Placement rules, checked on random scenes.
#include <cmath>

#include "core/base/math.h"
#include "tests/core/scene/support.h"
#include "tests/support/context.h"

namespace seedmesh {
namespace {

using scene::Placement;

Json hills(std::uint64_t seed) {
  return {{"generator", "terrain"},
          {"seed", seed},
          {"parameters",
           {{"iterations", 6}, {"size", 200}, {"amplitude", 40}, {"hurst", 0.8}, {"water_level", -2}}}};
}

Json layer(const std::string& name, const Json& place) {
  return {{"name", name}, {"model", cube()}, {"variants", 1}, {"place", place}};
}

Json poisson(double distance) { return {{"distance", distance}}; }

double steepness(const scene::Ground& ground, const Placement& placement) {
  return math::degrees(math::atan2(glm::length(ground.gradient(placement.at)), 1));
}

double least_distance(const Array<Placement>& placements) {
  double least = 1e30;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      least = std::min(least, glm::distance(placements[i].at, placements[k].at));
  }
  return least;
}

TEST(PlaceLayers, KeepsEveryRuleOnRandomScenes) {
  Rng rng(99);
  for (std::uint64_t round = 0; round < 24; ++round) {
    const double distance = rng.uniform(2, 8), steepest = rng.uniform(8, 40), low = rng.uniform(-10, 5);
    const double high = low + rng.uniform(5, 40);
    Json place = poisson(distance);
    place["slope"] = {{"to", steepest}, {"soft", rng.uniform(0, 10)}};
    place["altitude"] = {{"from", low}, {"to", high}};
    place["edge"] = rng.uniform(0, 20);
    const Json json = {{"terrain", hills(round)}, {"layers", {layer("a", place)}}};
    const Planted made = planted(json, round);
    EXPECT_GE(least_distance(made.layer(0)), distance);
    for (const Placement& placement : made.layer(0)) {
      EXPECT_LE(steepness(made.ground, placement), steepest);
      const double height = made.ground.height(placement.at);
      EXPECT_GE(height, low);
      EXPECT_LE(height, high);
      if (made.ground.water()) {
        EXPECT_GE(height, *made.ground.water());
      }
      EXPECT_TRUE(made.ground.contains(placement.at, place["edge"].get<double>()));
    }
  }
}

TEST(PlaceLayers, KeepsOffFootprintsAndPaths) {
  Rng rng(5);
  for (std::uint64_t round = 0; round < 12; ++round) {
    Json houses = layer("house", {{"method", "scatter"}, {"count", 6}, {"edge", 10}});
    houses["footprint"] = {rng.uniform(4, 12), rng.uniform(4, 12)};
    houses["scale"] = {0.5, 1.5};
    Json trees = layer("tree", poisson(1.5));
    trees["footprint"] = 0.4;
    const Json json = {
        {"ground", {{"size", 80}}},
        {"paths", {{{"points", {{-40, rng.uniform(-20, 20)}, {0, 5}, {40, 0}}}, {"width", 4}}}},
        {"layers", {houses, trees}}};
    const Planted made = planted(json, round);
    const Generator::Params params = read_scene_params(json);
    std::vector<glm::dvec2> points;
    for (const auto& p : own(params).paths[0].points) points.emplace_back(p[0], p[1]);
    const scene::PathBand way = scene::path_band_of(points, 4);
    const auto& size = std::get<1>(*own(params).layers[0].footprint);
    EXPECT_GT(made.layer(1).size(), 500U);
    for (const Placement& tree : made.layer(1)) {
      EXPECT_FALSE(way.covers(tree.at, 0.4 * 0.999));
      for (const Placement& house : made.layer(0)) {
        const auto footprint = scene::Footprint::of(house, glm::dvec2(size[0], size[1]) / 2.0, false);
        EXPECT_GE(footprint.outside(tree.at), 0.4 * 0.999);
      }
    }
  }
}

TEST(PlaceLayers, KeepsOtherLayersWhenOneChanges) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Json json = {
        {"terrain", hills(3)},
        {"layers",
         {layer("a", poisson(5)), layer("b", {{"method", "scatter"}, {"count", 90}}),
          layer("c", {{"method", "clusters"}, {"count", 50}, {"clusters", {{"count", 4}, {"radius", 6}}}})}}};
    const Planted before = planted(json, seed);
    json["layers"][1]["place"]["count"] = 30;
    json["layers"][1]["scale"] = {1, 2};
    const Planted after = planted(json, seed);
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
      ASSERT_EQ(before.layer(i).size(), after.layer(i).size());
      for (std::size_t k = 0; k < before.layer(i).size(); ++k) {
        EXPECT_EQ(before.layer(i)[k].at, after.layer(i)[k].at);
        EXPECT_EQ(before.layer(i)[k].turn, after.layer(i)[k].turn);
      }
    }
    json["layers"].erase(0);  // names, not indices, select random streams
    const Planted fewer = planted(json, seed);
    ASSERT_EQ(fewer.layer(1).size(), after.layer(2).size());
    for (std::size_t k = 0; k < fewer.layer(1).size(); ++k)
      EXPECT_EQ(fewer.layer(1)[k].at, after.layer(2)[k].at);
  }
}

TEST(PlaceLayers, KeepsThePositionsThatSatisfyAStricterRule) {
  Json json = {{"terrain", hills(3)}, {"layers", {layer("a", poisson(4))}}};
  const Planted all = planted(json);
  json["layers"][0]["place"]["slope"] = {{"to", 20}};
  const Planted some = planted(json);
  EXPECT_LT(some.layer(0).size(), all.layer(0).size());
  for (const Placement& placement : some.layer(0)) {
    EXPECT_TRUE(std::any_of(all.layer(0).begin(), all.layer(0).end(),
                            [&](const Placement& other) { return other.at == placement.at; }));
  }
}

TEST(PlaceLayers, KeepsTheLargerCrowns) {
  Json big = layer("big", {{"method", "scatter"}, {"count", 120}});
  big["scale"] = {1, 2};
  big["crown"] = 3;
  Json small = layer("small", {{"method", "scatter"}, {"count", 600}});
  small["crown"] = 0.8;
  Json json = {{"ground", {{"size", 80}}}, {"layers", {small, big}}, {"competition", 0.9}};
  const Planted made = planted(json);
  std::vector<std::pair<glm::dvec2, double>> crowns;
  for (std::size_t i = 0; i < 2; ++i) {
    for (const Placement& placement : made.layer(i))
      crowns.emplace_back(placement.at, (i == 0 ? 0.8 : 3.0) * static_cast<double>(placement.scale));
  }
  for (std::size_t i = 0; i < crowns.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE(glm::distance(crowns[i].first, crowns[k].first),
                0.9 * (crowns[i].second + crowns[k].second) * 0.999999);
    }
  }
  json["competition"] = 0;
  const Planted all = planted(json);
  EXPECT_EQ(all.layer(1).size(), 120U);
  EXPECT_LT(made.layer(1).size(), 100U);
  // The largest crown always survives.
  const auto largest =
      std::max_element(all.layer(1).begin(), all.layer(1).end(),
                       [](const Placement& a, const Placement& b) { return a.scale < b.scale; });
  EXPECT_TRUE(std::any_of(made.layer(1).begin(), made.layer(1).end(),
                          [&](const Placement& placement) { return placement.at == largest->at; }));
}

TEST(PlaceLayers, FollowsNeighboursAndShade) {
  Json trees = layer("tree", poisson(12));
  trees["crown"] = 4;
  Json moss = layer("moss", {{"method", "scatter"}, {"count", 200}, {"shade", {{"from", 0.4}}}});
  Json ring = layer(
      "ring",
      {{"method", "scatter"}, {"count", 200}, {"near", {{{"layer", "tree"}, {"from", 4.5}, {"to", 6}}}}});
  const Planted made = planted({{"ground", {{"size", 100}}}, {"layers", {trees, moss, ring}}});
  const auto nearest = [&](const Placement& placement) {
    double least = 1e30;
    for (const Placement& tree : made.layer(0)) least = std::min(least, glm::distance(tree.at, placement.at));
    return least;
  };
  EXPECT_EQ(made.layer(1).size(), 200U);
  for (const Placement& placement : made.layer(1)) EXPECT_LE(nearest(placement), 4 * std::sqrt(0.6));
  for (const Placement& placement : made.layer(2)) {
    EXPECT_GE(nearest(placement), 4.5);
    EXPECT_LE(nearest(placement), 6);
  }
}

TEST(PlaceLayers, FollowsADensityImage) {
  // 2 x 1 pixels: black in the west, white in the east.
  const std::string image =
      "data:image/"
      "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR4nGNg+A8AAQIBAEK+"
      "vGgAAAAASUVORK5CYII=";
  const Planted made = planted(
      {{"ground", {{"size", 100}}}, {"layers", {layer("a", {{"distance", 2}, {"density_image", image}})}}});
  int west = 0, east = 0;
  for (const Placement& placement : made.layer(0)) (placement.at.x < 0 ? west : east) += 1;
  EXPECT_GT(east, 4 * west);
  for (const Placement& placement : made.layer(0)) EXPECT_GT(placement.at.x, -26);
}

TEST(PlaceLayers, ThinsOutToACount) {
  Json json = {{"ground", {{"size", 100}}}, {"layers", {layer("a", poisson(3))}}};
  const Planted all = planted(json);
  json["layers"][0]["place"]["count"] = 57;
  const Planted some = planted(json);
  EXPECT_EQ(some.layer(0).size(), 57U);
  for (const Placement& placement : some.layer(0)) {
    EXPECT_TRUE(std::any_of(all.layer(0).begin(), all.layer(0).end(),
                            [&](const Placement& other) { return other.at == placement.at; }));
  }
}

TEST(PlaceLayers, LevelsTheGroundUnderFoundations) {
  Json houses = layer("house", {{"method", "scatter"}, {"count", 5}, {"edge", 20}});
  houses["footprint"] = {10, 6};
  houses["foundation"] = Json::object();
  const Json json = {{"terrain", hills(4)}, {"layers", {houses}}};
  const Planted made = planted(json, 3);
  ASSERT_EQ(made.layer(0).size(), 5U);
  const Placement& house = made.layer(0)[4];  // the last one, whose ground no other foundation changed
  const double height = made.ground.height(house.at);
  const auto footprint = scene::Footprint::of(house, {5, 3}, false);
  Rng rng(3);
  for (int i = 0; i < 500; ++i) {
    const double x = rng.uniform(-6, 6);
    const glm::dvec2 p = house.at + glm::dvec2(x, rng.uniform(-6, 6));
    if (footprint.outside(p) <= 0) {
      EXPECT_NEAR(made.ground.height(p), height, 1e-4);
    }
  }
}

TEST(PlaceLayers, WarnsWhereTooFewPositionsAreLeft) {
  const Planted made =
      planted({{"ground", {{"size", 10}}},
               {"layers", {layer("a", {{"method", "scatter"}, {"count", 5}, {"altitude", {{"from", 5}}}})}}});
  ASSERT_EQ(made.all_placements.warnings.size(), 2U);
  EXPECT_EQ(made.all_placements.warnings[0].pointer, "/layers/0/place/count");
  EXPECT_EQ(made.all_placements.warnings[0].message, "only 0 of 5 found a position that suits the layer");
}

TEST(PlaceLayers, StandsOnTheGroundAndLeansWithIt) {
  Json tilted = layer("a", poisson(6));
  tilted["upright"] = 0;
  tilted["sink"] = 0.5;
  const Json json = {{"terrain", hills(4)}, {"layers", {tilted}}};
  const Planted made = planted(json);
  const Generator::Params params = read_scene_params(json);
  for (const Placement& placement : made.layer(0)) {
    const Transform t = scene::transform_of(placement, own(params).layers[0], made.ground);
    EXPECT_NEAR(static_cast<double>(t.translation.y), made.ground.height(placement.at) - 0.5, 1e-4);
    const glm::dvec2 rise = made.ground.gradient(placement.at);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-rise.x, 1, -rise.y));
    EXPECT_NEAR(glm::dot(glm::dvec3(t.rotation * glm::vec3(0, 1, 0)), normal), 1, 1e-5);
    EXPECT_NEAR(static_cast<double>(glm::length(t.rotation)), 1, 1e-6);
  }
}

TEST(PlaceLayers, SeparatesFootprintsOfALayer) {
  Json houses = layer("house", {{"method", "scatter"}, {"count", 12}, {"edge", 9}});
  houses["footprint"] = {12, 8};
  Json json = {{"ground", {{"size", 120}}}, {"layers", {houses}}};
  const Planted made = planted(json);
  EXPECT_EQ(made.layer(0).size(), 12U) << "rejected positions are replaced by others";
  for (std::size_t i = 0; i < made.layer(0).size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(overlap(scene::Footprint::of(made.layer(0)[i], {6, 4}, false),
                           scene::Footprint::of(made.layer(0)[k], {6, 4}, false)));
    }
  }
  // Explicit positions ignore the rules.
  json["layers"][0]["place"] = {{"method", "positions"}, {"positions", {{{"at", {0, 0}}}, {{"at", {1, 0}}}}}};
  EXPECT_EQ(planted(json).layer(0).size(), 2U);
}

TEST(PlaceLayers, AllowsHousesOfARowToShareWalls) {
  Json houses = layer("house", {{"method", "rows"}, {"spacing", {7.3, 30}}, {"angle", 33}});
  houses["footprint"] = {7.3, 9};
  houses["turn"] = 0;
  Json json = {{"ground", {{"size", 100}}}, {"layers", {houses}}};
  const std::size_t beside = planted(json).layer(0).size();
  json["layers"][0].erase("footprint");
  EXPECT_EQ(beside, planted(json).layer(0).size());
}

TEST(PlaceLayers, PointsToTheLayerThatHasTooManyPositions) {
  const auto pointer = [](const Json& place) {
    const Json json = {{"layers", {layer("a", {{"distance", 5}}), layer("b", place)}}};
    const Generator::Params params = read_scene_params(json);
    Job job = job_of(1);
    Result<scene::Ground> ground = scene::Ground::make(own(params), job);
    try {
      scene::place_layers(own(params), *ground, job);
    } catch (const Stop& stop) {
      return stop.issue().pointer;
    }
    return std::string("it was planted");
  };
  const Json json = {{"layers", {layer("a", {{"method", "scatter"}, {"count", 10'000'000}})}}};
  EXPECT_THAT(scene_errors(json), testing::ElementsAre("/layers/0/place/count: found 10000000; the limit on "
                                                       "shapes is 4000000"));
  EXPECT_EQ(pointer({{"distance", 0.001}}), "/layers/1/place/distance");
  EXPECT_EQ(pointer({{"method", "rows"}, {"spacing", {0.001, 0.001}}}), "/layers/1/place/spacing");
  EXPECT_EQ(pointer({{"method", "path"}, {"distance", 0.001}, {"points", {{-90000, 0}, {90000, 0}}}}),
            "/layers/1/place/distance");
}

TEST(PlaceLayers, RefusesPatternsThatAreTooDenseBeforeAnythingIsMade) {
  struct Case {
    Json place;
    std::string member;
  };
  const std::vector<Case> cases = {
      {{{"method", "poisson"}, {"distance", 0.05}}, "distance"},
      {{{"method", "poisson"}, {"distance", 0.02}, {"area", {{-40, -40}, {40, -40}, {0, 40}}}}, "distance"},
      {{{"method", "rows"}, {"spacing", {0.05, 0.05}}}, "spacing"},
      {{{"method", "path"}, {"points", {{-50, 0}, {50, 0}}}, {"distance", 0.01}}, "distance"}};
  const Json hills = {{"generator", "terrain"}, {"parameters", {{"iterations", 5}, {"size", 100}}}};
  for (const bool is_terrain : {false, true}) {
    for (const Case& each : cases) {
      Json json = {{"layers", {{{"model", cube()}, {"place", each.place}}}}};
      json[is_terrain ? "terrain" : "ground"] = is_terrain ? hills : Json{{"size", 100}};
      Limits limits;
      limits.shapes = 10'000;
      const Generator::Params params = read_scene_params(json);
      Job job(1, {.limits = limits});
      const auto issue = [&](const auto& work) {
        try {
          work();
        } catch (const Stop& stop) {
          EXPECT_EQ(stop.code(), Code::limit);
          return stop.issue().pointer + ": " + stop.issue().message;
        }
        return std::string("nothing");
      };
      const std::string message =
          issue([&] { static_cast<void>(scene::appraise(own(params), context_of(job))); });
      EXPECT_THAT(message, testing::StartsWith("/layers/0/place/" + each.member + ": ")) << json;
      EXPECT_THAT(message, testing::HasSubstr("more positions than 10000"));
      EXPECT_EQ(message, issue([&] { static_cast<void>(scene::generate(own(params), context_of(job))); }));
      EXPECT_EQ(message, issue([&] { static_cast<void>(scene::derive(own(params), context_of(job))); }));
      EXPECT_EQ(message, issue([&] {
                  static_cast<void>(scene::encode(own(params), {"placements"}, context_of(job)));
                }));
      EXPECT_EQ(job.budget()->used(), 0U);
    }
  }
}

TEST(PlaceLayers, EndsSoonAfterTheDeadlineForAnyScene) {
  // Each position checks thousands of path segments and all trees around.
  Json points = Json::array();
  for (int i = 0; i < 4096; ++i) points.push_back({i % 2 == 0 ? -500 : 500, -400 + i * 0.2});
  Json path = {{"points", points}, {"width", 0.01}};
  Json json = {{"ground", {{"size", 1000}}},
               {"paths", Json::array()},
               {"layers",
                {layer("trees", {{"method", "scatter"}, {"count", 100'000}}),
                 layer("moss", {{"method", "scatter"},
                                {"count", 1'000'000},
                                {"near", {{{"layer", "trees"}, {"from", 1e5}}}},
                                {"shade", {{"from", 0.5}}}})}}};
  json["layers"][0]["crown"] = 900;
  for (int i = 0; i < 64; ++i) json["paths"].push_back(path);
  const Generator::Params params = read_scene_params(json);
  Job::Options options;
  const auto start = Job::Clock::now();
  options.deadline = start + std::chrono::milliseconds(200);
  Job job(1, options);
  Result<scene::Ground> ground = scene::Ground::make(own(params), job);
  EXPECT_THROW(static_cast<void>(scene::place_layers(own(params), *ground, job)), Stop);
  EXPECT_LT(Job::Clock::now() - start, std::chrono::seconds(2));
}

}  // namespace
}  // namespace seedmesh
