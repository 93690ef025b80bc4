/// What stands in a city: houses and their requests, landmarks, furniture, trees and borders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/child.h"
#include "core/generators/city/city.h"
#include "core/generators/city/furniture_models.h"
#include "core/generators/city/ground_mesh.h"
#include "core/generators/city/house_requests.h"
#include "core/generators/city/landmarks.h"
#include "core/generators/city/model_copies.h"
#include "core/generators/city/objects.h"
#include "core/generators/city/shape.h"
#include "core/generators/city/surface.h"
#include "core/geom/mesh/finish.h"
#include "core/texture/wall.h"
#include "generated/params/city.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

CityParams params_of(const char* json) {
  IssueList errors;
  Job job(1, Job::Options{});
  const Generator& city = *find_generator(generators(), "city");
  const Generator::Params read = read_parameters(city, Json::parse(json), "", {job, generators()}, errors);
  for (const Issue& each : errors.issues()) ADD_FAILURE() << each.pointer << ": " << each.message;
  return *static_cast<const CityParams*>(read.get());
}

std::vector<std::string> pointers_of(const char* json) {
  IssueList errors;
  Job job(1, Job::Options{});
  read_parameters(*find_generator(generators(), "city"), Json::parse(json), "", {job, generators()}, errors);
  std::vector<std::string> pointers;
  for (const Issue& each : errors.issues()) pointers.push_back(each.pointer);
  return pointers;
}

CityPlan plan_with(const CityParams& params, std::uint64_t seed) {
  Job job(seed, Job::Options{});
  Result<CityPlan> plan = plan_of(params, job);
  EXPECT_TRUE(plan);
  return *std::move(plan);
}

Model model_with(const CityParams& params, std::uint64_t seed, const Demand& demand = {}) {
  Job job(seed, Job::Options{});
  Result<Model> model = generate(params, context_of(job, demand));
  EXPECT_TRUE(model);
  return *std::move(model);
}

bool is_in(const Part& part, const dvec2& metres) {
  bool inside = false;
  for (const CmRing& ring : part.rings) inside ^= is_inside(ring, metres * 100.0);
  return inside;
}

/// The kinds of the parts around a position.
std::vector<PartKind> kinds_at(const CityPlan& plan, const dvec2& metres) {
  std::vector<PartKind> kinds;
  for (const Part& part : plan.parts) {
    if (is_in(part, metres)) kinds.push_back(part.kind);
  }
  return kinds;
}

const ObjectKind* kind_named(const std::vector<ObjectKind>& kinds, std::string_view name) {
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const ObjectKind& k) { return k.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

constexpr const char* furnished =
    R"({"area": {"size": [500, 420]}, "furniture": {"lamps": {}, "trees": {}, "benches": {},
  "bins": {}, "signs": {}, "cars": {}}, "parks": {}, "yards": {}, "lots": {"park_share": 0.2}})";

TEST(CityHouses, AreTheSameBuildingsAsTheirRequestsAlone) {
  const CityParams params =
      params_of(R"({"area": {"size": [260, 240]}, "buildings": {"variants": 3, "detail": 1}})");
  const CityPlan plan = plan_with(params, 4);
  const Model city = model_with(params, 4);
  std::map<std::string, int> meshes;
  for (const Node& node : city.nodes) {
    if (node.mesh >= 0) meshes[node.name] = node.mesh;
  }
  const std::vector<SharedHouse> houses = shared_houses(plan, params);
  ASSERT_GT(houses.size(), 20U);
  std::size_t compared = 0;
  auto mesh = meshes.begin();
  while (mesh != meshes.end() && !mesh->first.starts_with("building_")) ++mesh;
  std::vector<std::pair<std::uint64_t, Box>> in_city, alone;
  for (; mesh != meshes.end() && mesh->first.starts_with("building_"); ++mesh) {
    std::uint64_t triangles = 0;
    Box box{glm::vec3(1e9F), glm::vec3(-1e9F)};
    for (const Primitive& each : city.meshes[static_cast<std::size_t>(mesh->second)].primitives) {
      triangles += each.mesh.elements();
      const Box own = bounds_of(each.mesh);
      box = {glm::min(box.min, own.min), glm::max(box.max, own.max)};
    }
    in_city.emplace_back(triangles, box);
  }
  for (const SharedHouse& each : houses) {
    Job job(*each.request.seed, Job::Options{});
    const Result<Model> made = generate_child(each.request, "", Rng(0), context_of(job));
    ASSERT_TRUE(made);
    alone.emplace_back(count(*made).triangles, bounds_of(*made));
  }
  ASSERT_EQ(in_city.size(), alone.size());
  for (const auto& [triangles, box] : alone) {
    const auto same =
        std::find_if(in_city.begin(), in_city.end(), [&, &own = box, &number = triangles](const auto& each) {
          return each.first == number && glm::length(each.second.min - own.min) < 0.02F &&
                 glm::length(each.second.max - own.max) < 0.02F;
        });
    ASSERT_NE(same, in_city.end());
    in_city.erase(same);
    ++compared;
  }
  EXPECT_EQ(compared, houses.size());
}

TEST(CityHouses, AreTheSameWithRulesThatWereReadBefore) {
  Job job(4, Job::Options{});
  const GenerateContext context = context_of(job);
  const auto request = [](const char* blueprint, double width, std::uint64_t seed) {
    const Json body = {{"blueprint", blueprint},
                       {"size", {width, 0, 10}},
                       {"attributes", {{"lod", 1}, {"style", "brick"}, {"floors", 2}}}};
    return Child{"building", seed, body.dump()};
  };
  const Generator::Prepared prepared = prepare_child(request("house", 9, 1), context);
  ASSERT_TRUE(prepared);
  // Rules of another blueprint do not fit and are not used.
  for (const char* blueprint : {"house", "terraced_house"}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const Child child = request(blueprint, 8 + static_cast<double>(seed), seed);
      const Result<Model> alone = generate_child(child, "", Rng(0), context);
      const Result<Model> fast = generate_prepared(child, "", Rng(0), context, {}, prepared);
      ASSERT_TRUE(alone && fast);
      ASSERT_EQ(alone->meshes.size(), fast->meshes.size());
      EXPECT_EQ(count(*alone).triangles, count(*fast).triangles);
      for (std::size_t i = 0; i < alone->meshes.size(); ++i) {
        ASSERT_EQ(alone->meshes[i].primitives.size(), fast->meshes[i].primitives.size());
        for (std::size_t k = 0; k < alone->meshes[i].primitives.size(); ++k) {
          const auto a = alone->meshes[i].primitives[k].mesh.position.span(),
                     b = fast->meshes[i].primitives[k].mesh.position.span();
          EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << blueprint << " " << seed;
        }
      }
    }
  }
  EXPECT_FALSE(prepare_child({"building", 1, R"({"rules": "Lot --> extrude("})"}, context));
}

TEST(CityHouses, AreMergedWhereThousandsDiffer) {
  const CityParams params =
      params_of(R"({"area": {"size": [1400, 1400]}, "lots": {"area": [120, 320], "width": 7},
    "buildings": {"variants": 100000, "detail": 2,
      "rules": [{"blueprint": "house", "floors": [1, 3], "side": 1, "rear": 1, "depth": [6, 12]}]}})");
  const std::vector<SharedHouse> houses = shared_houses(plan_with(params, 2), params);
  ASSERT_GT(houses.size(), 2000U);
  std::uint64_t alone = 0;
  for (const SharedHouse& each : houses) {
    Job job(*each.request.seed, Job::Options{});
    const Result<Model> made = generate_child(each.request, "", Rng(0), context_of(job));
    ASSERT_TRUE(made);
    if (each.lots.size() == 1) alone += count(*made).triangles;
  }
  const Model city = model_with(params, 2);
  std::uint64_t merged = 0;
  std::size_t nodes = 0;
  for (const Node& node : city.nodes) {
    if (node.name != "houses") continue;
    ++nodes;
    for (const Primitive& each : city.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      merged += each.mesh.elements();
      EXPECT_LE(each.mesh.position.size(), 65'535U);
    }
  }
  EXPECT_EQ(merged, alone);
  EXPECT_LT(nodes, 60U);
}

TEST(CityHouses, FollowRulesByStreetFrontageAndZone) {
  const CityParams params = params_of(R"({"area": {"size": [600, 500]},
    "maps": {"zones": [{"zone": "east", "area": {"type": "Polygon",
      "coordinates": [[[0, -250], [300, -250], [300, 250], [0, 250], [0, -250]]]}}]},
    "buildings": {"rules": [{"blueprint": "villa", "zones": ["east"], "front": 2}, {"blueprint": "warehouse",
      "streets": ["major"], "frontage": [20, 1000], "front": 2, "side": 1}]}})");
  const CityPlan plan = plan_with(params, 9);
  std::size_t villas = 0, warehouses = 0;
  for (const Lot& lot : plan.lots) {
    if (!lot.house) continue;
    if (lot.house->rule == 0) {
      ++villas;
      EXPECT_EQ(lot.zone, "east");
    } else {
      ++warehouses;
      EXPECT_EQ(plan.class_of(lot.street).name, "major");
      EXPECT_GE(lot.frontage, 20);
    }
  }
  EXPECT_GT(villas, 20U);
  EXPECT_GT(warehouses, 5U);
}

TEST(CityHouses, FillTheirLotsToACentimetreWithSharedWalls) {
  const char* text =
      R"({"area": {"size": [500, 400]}, "streets": {"pattern": "raster"}, "lots": {"irregularity": 0.7},
    "buildings": {"rules": [{"blueprint": "terraced_house", "floors": [2, 3], "front": 1, "share": 1, "shared_walls": true}]}})";
  const CityPlan plan = plan_with(params_of(text), 2);
  std::size_t houses = 0, whole = 0;
  for (const Lot& lot : plan.lots) {
    if (!lot.house || lot.is_corner) continue;
    ++houses;
    const double rest = lot.house->width - std::floor(lot.house->width);
    whole += rest < 0.005 || rest > 0.995 ? 1 : 0;
  }
  ASSERT_GT(houses, 100U);
  EXPECT_LT(whole, houses / 10);  // a hundredth would be whole metres by chance
}

TEST(CityHouses, PassTheNumberOfFloorsToTheNamedAttribute) {
  const CityParams params =
      params_of(R"({"area": {"size": [300, 300]}, "buildings": {"rules": [{"floors": [2, 5],
    "floors_as": "levels", "building": {"generator": "building", "seed": 7, "parameters": {
      "rules": "attr levels = 1\nLot --> extrude(levels * 3) Mass."}}}]}})");
  const CityPlan plan = plan_with(params, 3);
  const HouseRequests requests(params);
  std::size_t houses = 0;
  for (const Lot& lot : plan.lots) {
    if (!lot.house) continue;
    const Child request = requests.of(*lot.house);
    Job job(*request.seed, Job::Options{});
    const Result<Model> made = generate_child(request, "", Rng(0), context_of(job));
    ASSERT_TRUE(made);
    const Box box = bounds_of(*made);
    EXPECT_NEAR(static_cast<double>(box.max.y), 3.0 * lot.house->floors, 1e-4);
    EXPECT_NEAR(static_cast<double>(box.max.x - box.min.x), lot.house->width, 1e-4);
    EXPECT_NEAR(static_cast<double>(box.max.z - box.min.z), lot.house->depth, 1e-4);
    if (++houses == 20) break;
  }
  EXPECT_EQ(houses, 20U);
}

TEST(CityHouses, RefuseAttributesAndGeneratorsThatTheirBuildingsDoNotHave) {
  using testing::Contains;
  EXPECT_THAT(
      pointers_of(R"({"buildings": {"rules": [{"blueprint": "house", "attributes": {"roof": "dome"}}]}})"),
      Contains("/buildings/rules/0/attributes/roof"));
  EXPECT_THAT(
      pointers_of(R"({"buildings": {"rules": [{"blueprint": "house", "attributes": {"colour": 1}}]}})"),
      Contains("/buildings/rules/0/attributes/colour"));
  EXPECT_THAT(pointers_of(R"({"buildings": {"rules": [{"building": {"generator": "tree"}}]}})"),
              Contains("/buildings/rules/0/building/generator"));
  EXPECT_THAT(
      pointers_of(R"({"buildings": {"rules": [{"floors_as": "levels", "building": {"preset": "house"}}]}})"),
      Contains("/buildings/rules/0/floors_as"));
  EXPECT_THAT(pointers_of(R"({"buildings": {"rules": [{"building": {"generator": "building",
    "parameters": {"rules": "Lot --> extrude("}}}]}})"),
              Contains("/buildings/rules/0/building/parameters/rules"));
}

TEST(Landmarks, ReplaceTheBuildingOfTheirLotOrKeepTheirBlockWhole) {
  const CityPlan plain = plan_with(params_of(R"({"area": {"size": [500, 400]}})"), 5);
  const auto built = std::find_if(plain.lots.begin(), plain.lots.end(),
                                  [](const Lot& lot) { return lot.house.has_value(); });
  ASSERT_NE(built, plain.lots.end());
  const dvec2 place = built->house->position;
  for (const std::string plot : {"lot", "block"}) {
    Json json = {{"area", {{"size", {500, 400}}}}};
    json["buildings"]["landmarks"] = Json::array({{{"model", {{"preset", "koch_snowflake"}}},
                                                   {"position", {place.x, place.y}},
                                                   {"turn", 30},
                                                   {"plot", plot}}});
    const CityParams params = params_of(json.dump().c_str());
    const CityPlan plan = plan_with(params, 5);
    ASSERT_EQ(plan.landmarks.size(), 1U);
    ASSERT_NE(plan.landmarks[0].lot, no_index);
    const Lot& lot = plan.lots[plan.landmarks[0].lot];
    EXPECT_FALSE(lot.house);
    EXPECT_EQ(lot.landmark, 0U);
    EXPECT_EQ(plan.graph.edge_key, plain.graph.edge_key) << "landmarks move no street";
    EXPECT_EQ(plan.lots.size() < plain.lots.size(), plot == "block");
    const double block = area_of(plan.blocks[plan.parts[lot.part].block].rings);
    EXPECT_EQ(std::abs(lot.area - block) < 1e-6, plot == "block");
    const Model model = model_with(params, 5);
    const auto node = std::find_if(model.nodes.begin(), model.nodes.end(), [](const Node& each) {
      return each.name == "landmark_0" && each.mesh >= 0;
    });
    ASSERT_NE(node, model.nodes.end());
    EXPECT_NEAR(static_cast<double>(node->transform.translation.x), place.x, 1e-4);
    EXPECT_NEAR(static_cast<double>(node->transform.translation.z), -place.y, 1e-4);
  }
}

TEST(Yards, CloseTheFrontsOfLotsBesideTheirBuildings) {
  const CityParams params = params_of(R"({"area": {"size": [400, 300]}, "streets": {"pattern": "raster"},
    "buildings": {"rules": [{"blueprint": "terraced_house", "floors": [2, 3], "front": 0.3, "depth": [8, 11]}]}})");
  const CityPlan plan = plan_with(params, 3);
  Job job(1, Job::Options{});
  std::map<std::uint32_t, double> length;  // by part
  for (const BorderPiece& piece : front_borders(plan, job)) {
    length[piece.part] += glm::length(piece.b - piece.a);
    for (const dvec2& p : {piece.a, piece.b})
      EXPECT_TRUE(is_inside(plan.parts[piece.part].rings[0], p * 100.0)) << p.x << ' ' << p.y;
  }
  std::size_t closed = 0;
  for (const Lot& lot : plan.lots) {
    if (!lot.house) continue;
    // A lot with four corners and right angles at the front is as wide as its front everywhere.
    const CmRing& ring = plan.parts[lot.part].rings[0];
    const double width = distance(lot.front_start, lot.front_end) / 100;
    const double area = area_of(plan.parts[lot.part].rings);
    const LeastBox box = least_box(ring);
    if (std::abs(box.short_side * box.long_side / 1e4 - area) > 0.002 * area) continue;
    const double open = width - lot.house->width;
    if (open < 0.6 ||
        std::min(std::abs(width - box.short_side / 100), std::abs(width - box.long_side / 100)) > 0.05)
      continue;
    EXPECT_NEAR(length[lot.part], open, 0.35);
    ++closed;
  }
  EXPECT_GT(closed, 5U);
}

TEST(Yards, CloseTheOtherStreetsOfCornerLots) {
  constexpr double half = 0.3;  // of a hedge
  const CityParams params = params_of(R"({"area": {"size": [400, 300]}, "streets": {"pattern": "raster"},
    "buildings": {"rules": [{"blueprint": "house", "floors": [1, 2], "front": 4, "side": 3, "rear": 6}]}})");
  const CityPlan plan = plan_with(params, 3);
  Job job(1, Job::Options{});
  const std::vector<BorderPiece> sides = side_street_borders(plan, half, job);
  const auto distance_of = [](const BorderPiece& piece, const dvec2& p) {
    return distance_to_segment(p * 100.0, piece.a * 100.0, piece.b * 100.0) / 100;
  };
  const std::vector<BorderPiece> borders = lot_borders(plan, job);
  std::vector<BorderPiece> all = borders, fronts = front_borders(plan, job);
  end_beside(fronts, borders, half);
  EXPECT_GT(fronts.size(), 100U);
  for (const BorderPiece& front : fronts) {
    for (const BorderPiece& other : borders) {
      for (const dvec2& p : {front.a, front.b}) EXPECT_GT(distance_of(other, p), half) << p.x << ' ' << p.y;
    }
  }
  all.insert(all.end(), sides.begin(), sides.end());
  for (const BorderPiece& piece : sides) {
    const CmRing& ring = plan.parts[piece.part].rings[0];
    for (const dvec2& p : {piece.a, piece.b, (piece.a + piece.b) / 2.0}) {
      EXPECT_TRUE(is_inside(ring, p * 100.0)) << p.x << ' ' << p.y;
      for (const BorderPiece& other : borders) {
        if (other.part == piece.part) {
          EXPECT_GT(distance_of(other, p), half - 0.01) << p.x << ' ' << p.y;
        }
      }
    }
  }
  std::size_t corners = 0, points = 0, open = 0;
  for (const Lot& lot : plan.lots) {
    if (!lot.house || !lot.is_corner) continue;
    ++corners;
    const dvec2 start = in_metres(lot.front_start), run = in_metres(lot.front_end) - start;
    const dvec2 inward = dvec2(-run.y, run.x) / glm::length(run);
    const double front = glm::dot(lot.house->position - start, inward) - lot.house->depth / 2;
    const CmRing& ring = plan.parts[lot.part].rings[0];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const dvec2 a = in_metres(ring[i]), b = in_metres(ring[(i + 1) % ring.size()]);
      const auto is_on_street = [&](const dvec2& p) {
        return std::any_of(plan.parts.begin(), plan.parts.end(), [&](const Part& part) {
          return (is_street_space(part) || part.kind == PartKind::verge) && is_in(part, p);
        });
      };
      const dvec2 outward = dvec2(b.y - a.y, a.x - b.x) / glm::length(b - a);
      for (double share = 0.01; share < 1; share += 0.02) {
        const dvec2 p = a + (b - a) * share;
        if (glm::dot(p - start, inward) < front + 1.5 || !is_on_street(p + outward * 0.05)) continue;
        ++points;
        double nearest = 1e9;
        for (const BorderPiece& piece : all) nearest = std::min(nearest, distance_of(piece, p));
        open += nearest > 1.2 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(corners, 10U);
  EXPECT_GT(points, 400U);
  EXPECT_LT(static_cast<double>(open), 0.02 * static_cast<double>(points));
}

TEST(Landmarks, MakeTheirBlockASquare) {
  const char* json = R"({"area": {"size": [300, 300]}, "streets": {"method": "given"},
    "given": {"streets": {"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {},
      "geometry": {"type": "LineString", "coordinates": [[-50, -50], [50, -50], [50, 50], [-50, 50], [-50, -50]]}}]}},
    "buildings": {"landmarks": [{"plot": "square", "position": [0, 0],
      "model": {"generator": "building", "parameters": {"blueprint": "church", "size": [SIZE, 9, 30]}}}]}})";
  for (const bool is_too_large : {false, true}) {
    std::string text = json;
    text.replace(text.find("SIZE"), 4, is_too_large ? "95" : "20");
    const CityParams params = params_of(text.c_str());
    const CityPlan plan = plan_with(params, 1);
    const Landmark& landmark = plan.landmarks[0];
    ASSERT_NE(landmark.part, no_index);
    EXPECT_EQ(plan.parts[landmark.part].kind, PartKind::square);
    // The inner block, without half of the streets around it: 7 m and sidewalks of 2 m.
    EXPECT_NEAR(area_of(plan.parts[landmark.part].rings), 89 * 89, 60);
    EXPECT_EQ(landmark.is_too_large, is_too_large);
    EXPECT_EQ(landmark_warnings(plan).size(), is_too_large ? 1U : 0U);
    const Model model = model_with(params, 1);
    EXPECT_TRUE(std::any_of(model.nodes.begin(), model.nodes.end(),
                            [](const Node& each) { return each.name == "landmark_0" && each.mesh >= 0; }));
  }
}

TEST(Foundations, StayOnTheirLots) {
  const CityParams params = params_of(R"({"area": {"size": [380, 360]}, "terrain": {"preset": "figure_5_11"},
    "streets": {"pattern": "slope", "major_spacing": 150}, "lots": {"method": "skeleton"},
    "buildings": {"rules": [{"blueprint": "warehouse", "front": 0.3, "depth": [8, 12], "width": [4, 30],
      "shared_walls": true}]}})");
  const CityPlan plan = plan_with(params, 4);
  Job job(4, Job::Options{});
  const Surface surface(plan, 0, job);
  std::size_t houses = 0;
  for (const Lot& lot : plan.lots) {
    if (!lot.house) continue;
    ++houses;
    GroundMesh mesh(plan, surface, false, job);
    mesh.add_foundation(lot.footing());
    const Mesh foundation = mesh.take(job);
    for (const glm::vec3& corner : foundation.position.span()) {
      const dvec2 p(static_cast<double>(corner.x), -static_cast<double>(corner.z));
      EXPECT_TRUE(is_inside(plan.parts[lot.part].rings[0], p * 100.0)) << p.x << ' ' << p.y;
    }
  }
  EXPECT_GT(houses, 30U);
}

TEST(Landmarks, AreNotInThePlanWhereTheyAreLargerThanTheirLot) {
  const CityPlan plain = plan_with(params_of(R"({"area": {"size": [500, 400]}})"), 5);
  const auto built = std::find_if(plain.lots.begin(), plain.lots.end(),
                                  [](const Lot& lot) { return lot.house.has_value(); });
  ASSERT_NE(built, plain.lots.end());
  const dvec2 place = built->house->position;
  for (const double size : {2.0, 120.0}) {
    Json json = {{"area", {{"size", {500, 400}}}}};
    json["buildings"]["landmarks"] =
        Json::array({{{"model",
                       {{"generator", "building"},
                        {"parameters", {{"blueprint", "warehouse"}, {"size", {size, 0, size}}}}}},
                      {"position", {place.x, place.y}}}});
    const CityPlan plan = plan_with(params_of(json.dump().c_str()), 5);
    const Lot& lot = plan.lots[plan.landmarks[0].lot];
    EXPECT_EQ(lot.landmark == no_index, size > 100);
    EXPECT_EQ(plan.landmarks[0].is_too_large, size > 100);
    EXPECT_FALSE(lot.house);
  }
}

TEST(Landmarks, AreNotInThePlanWhereAnEdgeOfTheirLotCutsThem) {
  // A dead end runs into the block, so that its lot is not convex. The corners of the landmark lie on both sides of it.
  const char* json = R"({"area": {"size": [300, 300]}, "streets": {"method": "given"},
    "given": {"streets": {"type": "FeatureCollection", "features": [
      {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates":
        [[-100, -100], [0, -100], [100, -100], [100, 100], [-100, 100], [-100, -100]]}},
      {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[0, -100], [0, 0]]}}]}},
    "buildings": {"rules": [], "landmarks": [{"plot": "block", "position": [POSITION, 0],
      "model": {"generator": "building", "parameters": {"blueprint": "warehouse", "size": [60, 0, 60]}}}]}})";
  for (const bool is_cut : {true, false}) {
    std::string text = json;
    text.replace(text.find("POSITION"), 8, is_cut ? "-20" : "-55");
    const CityPlan plan = plan_with(params_of(text.c_str()), 1);
    ASSERT_NE(plan.landmarks[0].lot, no_index) << is_cut;
    EXPECT_EQ(plan.landmarks[0].is_too_large, is_cut);
  }
}

TEST(Landmarks, StandOnFoundationsOnASlope) {
  Json json = {{"area", {{"size", {400, 300}}}}, {"maps", {{"height", "x / 8"}}}};
  json["buildings"] = {
      {"rules", Json::array()},
      {"landmarks",
       {{{"model",
          {{"generator", "building"}, {"parameters", {{"blueprint", "warehouse"}, {"size", {12, 0, 8}}}}}},
         {"position", {20, 20}},
         {"turn", 30},
         {"plot", "free"}}}}};
  const CityParams params = params_of(json.dump().c_str());
  const CityPlan plan = plan_with(params, 5);
  ASSERT_NE(plan.landmarks[0].part, no_index);
  Job job(5, Job::Options{});
  const Surface surface(plan, 0, job);
  const Model model = model_with(params, 5);
  const auto named = [&](const char* name) {
    return std::find_if(model.nodes.begin(), model.nodes.end(),
                        [&](const Node& node) { return node.name == name && node.mesh >= 0; });
  };
  const auto landmark = named("landmark_0"), foundation = named("foundations");
  ASSERT_NE(landmark, model.nodes.end());
  ASSERT_NE(foundation, model.nodes.end());
  const auto floor = static_cast<double>(landmark->transform.translation.y);
  double lowest = 1e9;
  for (int i = -6; i <= 6; i += 3) {
    for (int k = -4; k <= 4; k += 2) {
      const double c = std::cos(math::pi / 6), s = std::sin(math::pi / 6);
      const double here =
          surface.height(plan.landmarks[0].part, dvec2(20 + i * c - k * s, 20 + i * s + k * c));
      EXPECT_LE(here, floor + 1e-3);
      lowest = std::min(lowest, here);
    }
  }
  const MeshGroup& group = model.meshes[static_cast<std::size_t>(foundation->mesh)];
  const Box box = bounds_of(group.primitives[0].mesh);
  EXPECT_NEAR(static_cast<double>(box.max.y), floor, 0.03);
  EXPECT_LT(static_cast<double>(box.min.y), lowest);
}

TEST(Landmarks, WarnWhereTheyStandOnAStreetOrOutside) {
  const CityParams params = params_of(R"({"area": {"size": [400, 400]}, "streets": {"method": "given"},
    "given": {"streets": {"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {},
      "geometry": {"type": "LineString", "coordinates": [[-200, 0], [200, 0]]}}]}},
    "buildings": {"rules": [], "landmarks": [{"model": {"preset": "koch_snowflake"}, "position": [0, 0]},
      {"model": {"preset": "koch_snowflake"}, "position": [900, 0]}]}})");
  Job job(1, Job::Options{});
  const Result<Json> derived = derive(params, context_of(job));
  ASSERT_TRUE(derived);
  std::vector<std::string> pointers;
  for (const Json& each : (*derived)["warnings"]) pointers.push_back(each["pointer"]);
  EXPECT_THAT(pointers, testing::Contains("/buildings/landmarks/0/position"));
  EXPECT_THAT(pointers, testing::Contains("/buildings/landmarks/1/position"));
}

TEST(Furniture, StandsOnSidewalksAndCarsOnCarriageways) {
  const CityParams params = params_of(furnished);
  std::map<std::string, std::size_t> counts;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const CityPlan plan = plan_with(params, seed);
    Job job(seed, Job::Options{});
    for (const ObjectKind& kind : street_furniture(plan, params, job)) {
      counts[kind.name] += kind.objects.size();
      for (const CityObject& each : kind.objects) {
        const std::vector<PartKind> around = kinds_at(plan, each.position);
        ASSERT_EQ(around.size(), 1U) << kind.name;
        if (kind.name == "cars") {
          ASSERT_EQ(around[0], PartKind::carriageway) << "seed " << seed;
        } else {
          ASSERT_TRUE(around[0] == PartKind::sidewalk || around[0] == PartKind::verge)
              << kind.name << ", seed " << seed;
        }
      }
    }
  }
  for (const char* name : {"lamps", "trees", "benches", "bins", "signs", "cars"})
    EXPECT_GT(counts[name], 40U) << name;
}

TEST(Furniture, KeepsCarsOneLengthApartAndTreesEightMetresFromJunctions) {
  const CityParams params = params_of(furnished);
  const CityPlan plan = plan_with(params, 8);
  Job job(8, Job::Options{});
  const std::vector<ObjectKind> kinds = street_furniture(plan, params, job);
  const ObjectKind* cars = kind_named(kinds, "cars");
  ASSERT_NE(cars, nullptr);
  for (std::size_t i = 0; i < cars->objects.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      ASSERT_GT(glm::length(cars->objects[i].position - cars->objects[k].position), 1.9);
  }
  const ObjectKind* trees = kind_named(kinds, "trees");
  ASSERT_NE(trees, nullptr);
  for (const CityObject& tree : trees->objects) {
    for (std::uint32_t node = 0; node < plan.graph.nodes.size(); ++node) {
      if (plan.graph.street_ends(node) <= 2) continue;
      ASSERT_GT(glm::length(in_metres(plan.graph.nodes[node]) - tree.position), 8);
    }
  }
}

TEST(Furniture, DoesNotDependOnLotsAndBuildings) {
  Json json = Json::parse(furnished);
  const CityParams before = params_of(json.dump().c_str());
  json["lots"]["area"] = {300, 1200};
  json["buildings"]["rules"] = Json::array();
  const CityParams after = params_of(json.dump().c_str());
  const CityPlan plan = plan_with(before, 6), other = plan_with(after, 6);
  Job job(6, Job::Options{}), again(6, Job::Options{});
  const auto a = street_furniture(plan, before, job), b = street_furniture(other, after, again);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].objects.size(), b[i].objects.size()) << a[i].name;
    for (std::size_t k = 0; k < a[i].objects.size(); ++k)
      EXPECT_EQ(a[i].objects[k].position, b[i].objects[k].position);
  }
}

TEST(FurnitureModels, AreClosedBodiesWithoutDefects) {
  for (const char* name : {"lamps", "trees", "benches", "bins", "signs", "cars", "park_trees"}) {
    for (std::uint32_t number = 0; number < built_in_count(name); ++number) {
      Job job(0, Job::Options{});
      Model model = built_in_model(name, number, job);
      EXPECT_GE(count(model).triangles, 12U) << name;
      EXPECT_LE(count(model).triangles, 220U) << name;
      finish(model, job);
      for (const std::string& each : faults(model)) ADD_FAILURE() << name << " " << number << ": " << each;
      for (const Primitive& each : model.meshes[0].primitives) {
        const MeshMeasures measures = measure({&each.mesh});
        EXPECT_EQ(measures.open_edges, 0U) << name;
        EXPECT_GT(measures.volume, 0) << name;
      }
    }
  }
}

TEST(CityTrees, StandInParksAndInYardsBesideTheHouses) {
  const CityParams params = params_of(furnished);
  std::size_t in_parks = 0, in_yards = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const CityPlan plan = plan_with(params, seed);
    Job job(seed, Job::Options{});
    for (const ObjectKind& kind : trees_of(plan, params, job)) {
      const bool is_park = kind.name == "park_trees";
      (is_park ? in_parks : in_yards) += kind.objects.size();
      for (const CityObject& each : kind.objects) {
        const std::vector<PartKind> around = kinds_at(plan, each.position);
        ASSERT_EQ(around.size(), 1U);
        ASSERT_EQ(around[0], is_park ? PartKind::park : PartKind::lot);
        for (const Lot& lot : plan.lots) {
          if (!lot.house) continue;
          const double half = std::min(lot.house->width, lot.house->depth) / 2;
          ASSERT_GT(glm::length(lot.house->position - each.position), half);
        }
      }
    }
  }
  EXPECT_GT(in_parks, 100U);
  EXPECT_GT(in_yards, 100U);
}

TEST(LotBorders, AreEachThereOnceAndPassNoHouse) {
  const CityParams params = params_of(furnished);
  const CityPlan plan = plan_with(params, 3);
  Job job(3, Job::Options{});
  const std::vector<BorderPiece> pieces = lot_borders(plan, job);
  ASSERT_GT(pieces.size(), 100U);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (double share = 0; share <= 1; share += 0.05) {
      const dvec2 p = pieces[i].a + (pieces[i].b - pieces[i].a) * share;
      for (const Lot& lot : plan.lots) {
        if (!lot.house) continue;
        const math::SinCos turn = math::sincos_degrees(lot.house->turn);
        const dvec2 off = p - lot.house->position;
        const double x = off.x * turn.cos + off.y * turn.sin, y = off.y * turn.cos - off.x * turn.sin;
        // A border may end at the corner of a third lot, 0.6 m from its house.
        ASSERT_FALSE(std::abs(x) < lot.house->width / 2 + 0.2 && std::abs(y) < lot.house->depth / 2 + 0.2);
      }
    }
    for (std::size_t k = 0; k < i; ++k) {
      const dvec2 gap = (pieces[i].a + pieces[i].b - pieces[k].a - pieces[k].b) / 2.0;
      ASSERT_GT(glm::length(gap), 0.01) << "a border is there twice";
    }
  }
}

TEST(LaneLines, HaveWholeDashesOfAboutTwelveMetres) {
  const CityParams params = params_of(R"({"area": {"size": [500, 420]}, "buildings": {"rules": []}})");
  Demand demand;
  demand.textures = 256;
  const Model model = model_with(params, 3, demand);
  std::size_t quads = 0;
  for (const Node& node : model.nodes) {
    if (node.name != "lane_lines" || node.mesh < 0) continue;
    const Primitive& each = model.meshes[static_cast<std::size_t>(node.mesh)].primitives[0];
    const Material& material = model.materials[static_cast<std::size_t>(each.material)];
    EXPECT_GE(material.base_color_texture.texture, 0);
    const auto& index = each.mesh.index;
    for (std::size_t i = 0; i < each.mesh.elements() * 3; ++i) {
      const auto corner = index.at(i), next = index.at(i % 3 == 2 ? i - 2 : i + 1);
      const double u = static_cast<double>(each.mesh.uv[0][corner].x),
                   v = static_cast<double>(each.mesh.uv[0][next].x);
      EXPECT_NEAR(u, std::round(u), 2e-3) << "a line begins and ends in the middle of a gap";
      if (std::abs(u - v) < 0.5) continue;
      ++quads;
      const double metres =
          static_cast<double>(glm::length(each.mesh.position[corner] - each.mesh.position[next]));
      if (std::abs(u - v) > 1.5) {
        EXPECT_NEAR(metres / std::abs(u - v), 12, 3);
      }
    }
  }
  EXPECT_GT(quads, 50U);
  demand.textures = 0;
  const Model plain = model_with(params, 3, demand);
  EXPECT_TRUE(std::none_of(plain.nodes.begin(), plain.nodes.end(),
                           [](const Node& node) { return node.name == "lane_lines"; }));
}

TEST(Chunks, DivideAModelWithoutChangingItsTriangles) {
  Json json = Json::parse(furnished);
  const Model whole = model_with(params_of(json.dump().c_str()), 5);
  for (const char* by : {"blocks", "squares"}) {
    json["chunks"] = {{"by", by}};
    if (std::string(by) == "squares") json["chunks"]["size"] = 120;
    const Model divided = model_with(params_of(json.dump().c_str()), 5);
    EXPECT_EQ(count(divided).triangles, count(whole).triangles) << by;
    EXPECT_EQ(bounds_of(divided).min, bounds_of(whole).min);
    std::size_t chunks = 0;
    for (const Node& node : divided.nodes) chunks += node.parent == 0 && node.mesh < 0 ? 1 : 0;
    EXPECT_GE(chunks, 12U) << by;
  }
}

TEST(CityCamera, ShowsCoarserModelsFarAway) {
  Json json = Json::parse(R"({"area": {"size": [400, 400]}, "buildings": {"detail": 0,
    "rules": [{"blueprint": "house", "floors": [1, 2]}]}})");
  const std::uint64_t finest = count(model_with(params_of(json.dump().c_str()), 2)).triangles;
  std::uint64_t before = finest;
  for (const double height : {15.0, 250.0}) {
    json["camera"] = {{"position", {0, 0, height}}};
    const std::uint64_t triangles = count(model_with(params_of(json.dump().c_str()), 2)).triangles;
    EXPECT_LT(triangles, before) << height;
    before = triangles;
  }
}

TEST(CityCollision, HasABoxAroundEachHouse) {
  const CityParams params = params_of(R"({"area": {"size": [300, 300]}})");
  Demand demand;
  demand.collision = CollisionNames::plain;
  const CityPlan plan = plan_with(params, 2);
  const Model model = model_with(params, 2, demand);
  std::size_t houses = 0, bodies = 0;
  for (const Lot& lot : plan.lots) houses += lot.house ? 1 : 0;
  for (const Node& node : model.nodes) bodies += node.collision == CollisionShape::convex ? 1 : 0;
  ASSERT_GT(houses, 20U);
  EXPECT_EQ(bodies, houses);
}

TEST(CityEstimate, IsWithinAFifthOfTheTriangles) {
  for (const std::string& text :
       {std::string(furnished), std::string(R"({"area": {"size": [600, 500]}})"),
        std::string(R"({"area": {"size": [400, 400]}, "camera": {"position": [0, 0, 80]},
                                    "buildings": {"detail": 0}})")}) {
    const CityParams params = params_of(text.c_str());
    Job job(3, Job::Options{});
    const Result<Appraisal> appraisal = appraise(params, context_of(job));
    ASSERT_TRUE(appraisal && appraisal->estimate);
    const double made = static_cast<double>(count(model_with(params, 3)).triangles);
    EXPECT_NEAR(static_cast<double>(appraisal->estimate->triangles) / made, 1, 0.2) << text;
  }
}

TEST(CityInAScene, IsAModelOfALayer) {
  const Json town = {{"area", {{"size", {200, 180}}}}, {"furniture", {{"lamps", Json::object()}}}};
  const std::uint64_t alone = count(model_with(params_of(town.dump().c_str()), 5)).triangles;
  Json layer = {{"name", "town"}, {"model", {{"generator", "city"}, {"seed", 5}, {"parameters", town}}}};
  layer["place"] = {{"method", "positions"}, {"positions", {{{"at", {-200, 0}}}, {{"at", {250, 100}}}}}};
  const Json scene = {{"ground", {{"outline", "none"}}}, {"layers", Json::array({layer})}};
  const Generator& generator = *find_generator(generators(), "scene");
  IssueList errors;
  Job job(1, Job::Options{});
  const Generator::Params read = read_parameters(generator, scene, "", {job, generators()}, errors);
  ASSERT_TRUE(errors.empty());
  const Result<Model> model = generator.generate(read, context_of(job));
  ASSERT_TRUE(model);
  // The variant of the layer has a seed of its own, so its town differs a little.
  EXPECT_NEAR(static_cast<double>(count(*model).triangles), 2.0 * static_cast<double>(alone),
              0.1 * 2 * static_cast<double>(alone));
}

TEST(CityModel, GroundsRepeatTheirTexturesByTheSizeOfTheTexture) {
  Demand demand;
  demand.textures = 512;
  const Model model = model_with(params_of(R"({"area": {"size": [300, 300]}, "surfaces": [
      {"name": "sidewalk", "roughness": 0.5}, {"name": "lot", "color": "#336633"},
      {"name": "junction", "color": "#f0f0f0"}]})"),
                                 3, demand);
  std::map<std::string, std::string> kinds;
  for (const Material& material : model.materials) kinds[material.name] = material.recipe.kind;
  EXPECT_EQ(kinds.at("asphalt"), "asphalt_ground");
  EXPECT_EQ(kinds.at("lot"), "grass_ground");
  EXPECT_EQ(kinds.at("sidewalk"), "") << "its roughness would be that of the texture";
  EXPECT_EQ(kinds.at("junction"), "") << "its colour is brighter than the texture";
  for (const MeshGroup& group : model.meshes) {
    for (const Primitive& primitive : group.primitives) {
      const Material& material = model.materials[static_cast<std::size_t>(primitive.material)];
      if (material.name != "lot") continue;
      const Mesh& mesh = primitive.mesh;
      for (std::size_t i = 0; i < mesh.position.size(); ++i) {
        if (mesh.normal[i].y < 0.5F) continue;
        // The image covers 2 m, east is +X, and north is -Z.
        EXPECT_NEAR(mesh.uv[0][i].x, mesh.position[i].x / 2, 1e-4);
        EXPECT_NEAR(mesh.uv[0][i].y, -mesh.position[i].z / 2, 1e-4);
      }
      EXPECT_NEAR(material.recipe.factor.g * texture::grey_of("grass_ground"), linear_of_srgb(0x66), 1e-4);
    }
  }
}

}  // namespace
}  // namespace seedmesh::city
