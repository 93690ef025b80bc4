#include "core/generators/city/city.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <variant>

#include "core/base/math.h"
#include "core/generators/city/growth.h"
#include "core/generators/city/shape.h"
#include "core/generators/city/statistics.h"
#include "core/schema/json.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

CityParams small_town(double east, double north) {
  CityParams params;
  params.area.size = {east, north};
  return params;
}

CityPlan made(const CityParams& params, std::uint64_t seed, int threads = 1) {
  Job::Options options;
  options.threads = threads;
  Job job(seed, options);
  Result<CityPlan> plan = plan_of(params, job);
  EXPECT_TRUE(plan);
  return *std::move(plan);
}

/// Parameters drawn by seed: sizes, patterns and densities of streets.
CityParams random_town(std::uint64_t seed) {
  Rng rng = Rng::of_seed(seed);
  CityParams params = small_town(rng.uniform(300, 900), rng.uniform(300, 900));
  params.streets.pattern = static_cast<CityPattern>(rng.below(3));
  params.streets.angle = rng.uniform(-90, 90);
  params.streets.length = rng.uniform(45, 120);
  params.streets.bend = rng.uniform(0, 60);
  params.streets.branch_probability = rng.uniform(0.2, 0.8);
  params.streets.dead_ends = rng.unit();
  params.lots.division = static_cast<CityDivision>(rng.below(5));
  if (params.lots.division == CityDivision::burgage) params.lots.area = {60, 500};
  return params;
}

/// The same with a river, a lake of two polygons that overlap, or a triangle of water.
CityParams random_town_at_water(std::uint64_t seed) {
  CityParams params = random_town(seed);
  Rng rng = Rng::of_seed(seed).at("water");
  const double x = rng.uniform(-100, 100), y = rng.uniform(-100, 100), size = rng.uniform(30, 200);
  if (rng.below(3) == 0) {
    params.maps.water = "abs(y + " + std::to_string(y) + " - 40 * sin(x)) < " + std::to_string(size / 8);
    return params;
  }
  const auto ring = [&](double east, double north) {
    return std::vector<std::vector<double>>{
        {east, north}, {east + size, north + 20}, {east + 15, north + size}};
  };
  Json water = Json::array();
  for (const double shift : {0.0, rng.uniform(0, 60)})
    water.push_back(Json::array({ring(x + shift, y - shift)}));
  params.maps.water = GeoJson{Json({{"type", "MultiPolygon"}, {"coordinates", water}}).dump()};
  return params;
}

/// Directed edges of all parts that no neighbour has the other way round. A partition leaves the border.
std::map<std::pair<CmPoint, CmPoint>, int> open_edges(const CityPlan& plan) {
  std::map<std::pair<CmPoint, CmPoint>, int> edges;
  for (const Part& part : plan.parts) {
    for (const CmRing& ring : part.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const CmPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
        if (--edges[{b, a}] == 0) edges.erase({b, a});
        if (++edges[{a, b}] == 0) edges.erase({a, b});
      }
    }
  }
  return edges;
}

TEST(City, PartitionsItsAreaIntoPolygonsThatShareTheirCorners) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const CityPlan plan = made(seed < 30 ? random_town(seed) : random_town_at_water(seed), seed);
    double sum = 0;
    for (const Part& part : plan.parts) {
      sum += area_of(part.rings);
      // A verge without space for kerbs passes dead ends on both sides.
      const bool may_touch_itself = part.kind == PartKind::verge && seed >= 30;
      for (const CmRing& ring : part.rings)
        ASSERT_TRUE(may_touch_itself || is_simple(ring)) << name_of(part.kind) << ", seed " << seed;
      ASSERT_GT(area_of(part.rings), 0) << name_of(part.kind) << ", seed " << seed;
    }
    // Rounded corners on shores leave seams of up to a centimetre.
    ASSERT_NEAR(sum / area_of(plan.area), 1, seed < 30 ? 1e-9 : 1e-5) << "seed " << seed;
    if (seed >= 30) continue;  // shores are checked by their area alone
    for (const auto& [edge, count] : open_edges(plan)) {
      bool is_on_border = false;
      for (const CmRing& ring : plan.area) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const CmPoint &c = ring[i], &d = ring[(i + 1) % ring.size()];
          is_on_border |= distance_to_segment(in_cm(edge.first), in_cm(c), in_cm(d)) < 1 &&
                          distance_to_segment(in_cm(edge.second), in_cm(c), in_cm(d)) < 1;
        }
      }
      ASSERT_TRUE(is_on_border) << edge.first.x << " " << edge.first.y << ", seed " << seed;
    }
  }
}

/// A corner cut by 20 cm moves no street away from the border: lots are there as without it.
TEST(City, LaysOutStreetsBesideShortEdgesOfTheBorder) {
  CityParams params;
  params.area.polygon = {{{0, 0}, {300, 0}, {300, 299.8}, {299.8, 300}, {0, 300}}};
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const CityPlan plan = made(params, seed);
    double sum = 0;
    for (const Part& part : plan.parts) {
      sum += area_of(part.rings);
      EXPECT_NE(part.kind, PartKind::verge) << "seed " << seed;
    }
    EXPECT_NEAR(sum, 300.0 * 300 - 0.2 * 0.2 / 2, 1e-4) << "seed " << seed;
    EXPECT_GT(plan.lots.size(), 40U) << "seed " << seed;
  }
}

/// Half of a street along the border is outside: a street of 7 m leaves 3.5 m.
TEST(City, TakesTheInnerHalfOfAStreetAlongTheBorder) {
  const std::string along = R"({"type":"LineString","coordinates":[[-100,-100],[100,-100]]})";
  const std::string away = R"({"type":"LineString","coordinates":[[0,-100],[0,-40]]})";
  for (const bool has_branch : {false, true}) {
    Json features = Json::array();
    for (const std::string& line : {along, away}) {
      if (line == along || has_branch) {
        features.push_back(
            {{"type", "Feature"}, {"properties", {{"width", 7}}}, {"geometry", Json::parse(line)}});
      }
    }
    IssueList errors;
    const CityParams params = read_city(
        {{"area", {{"size", {200, 200}}}},
         {"streets", {{"method", "given"}}},
         {"given", {{"streets", {{"type", "FeatureCollection"}, {"features", std::move(features)}}}}}},
        "", errors);
    ASSERT_TRUE(errors.empty());
    double sum = 0, road = 0;
    const CityPlan plan = made(params, 1);
    for (const Part& part : plan.parts) {
      const double area = area_of(part.rings);
      EXPECT_GT(area, 0) << name_of(part.kind);
      sum += area;
      if (part.kind == PartKind::carriageway || part.kind == PartKind::junction) road += area;
    }
    EXPECT_NEAR(sum, 200.0 * 200, 1e-6) << "with a branch: " << has_branch;
    double length = 0;
    for (std::uint32_t edge = 0; edge < plan.graph.edges.size(); ++edge) {
      const auto& [from, to] = std::pair(plan.graph.edges[edge].from, plan.graph.edges[edge].to);
      if (plan.graph.is_street(edge)) length += distance(plan.graph.nodes[from], plan.graph.nodes[to]) / 100;
    }
    EXPECT_GT(length, 150);
    if (!has_branch) {
      EXPECT_NEAR(road, length * 3.5, 1);
    }
  }
}

TEST(City, GivesEveryLotItsFrontageWidthAndCorners) {
  std::size_t lots = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const CityParams params = random_town(seed);
    const CityPlan plan = made(params, seed);
    lots += plan.lots.size();
    for (const Lot& lot : plan.lots) {
      if (lot.is_inner) {
        ASSERT_EQ(params.lots.division, CityDivision::offset);
        ASSERT_EQ(lot.frontage, 0);
      } else {
        ASSERT_GE(lot.frontage, params.lots.width);
      }
      ASSERT_GE(least_box(lot.corners).short_side / 100, params.lots.width);
      ASSERT_LE(sharpest_cosine(lot.corners), math::cos(math::radians(12)));
      ASSERT_GE(lot.area, params.lots.area[0] * 0.999);
    }
  }
  EXPECT_GT(lots, 2000U);
}

TEST(City, FillsEachBlockWithItsLots) {
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    CityParams params = random_town_at_water(seed);
    if (seed >= 60) params.lots.division = seed % 2 == 0 ? CityDivision::skeleton : CityDivision::offset;
    const CityPlan plan = made(params, seed);
    std::vector<double> filled(plan.blocks.size(), 0);
    for (const Part& part : plan.parts) {
      if (part.block != no_index) filled[part.block] += area_of(part.rings);
    }
    for (std::size_t i = 0; i < filled.size(); ++i)
      ASSERT_NEAR(filled[i], area_of(plan.blocks[i].rings), 1e-6) << "seed " << seed;
  }
}

TEST(City, CountsANarrowSliverOfWaterAsWater) {
  CityParams params;
  params.area.polygon = {{{180.5, 42.5},
                          {88.5, 264.5},
                          {-7.5, 432},
                          {-95, 256},
                          {-113.5, 76},
                          {-104.5, -115},
                          {-80, -389.5},
                          {90, -367.5},
                          {102.5, -149}}};
  params.maps.water = "sqrt((x + 180.93) ^ 2 + (y + 352.43) ^ 2) < 105.955";
  const CityPlan plan = made(params, 124);
  double sum = 0, water = 0;
  for (const Part& part : plan.parts) {
    sum += area_of(part.rings);
    water += part.kind == PartKind::water ? area_of(part.rings) : 0;
  }
  EXPECT_GT(water, 300);
  // Corners on a slanted border are whole centimetres.
  EXPECT_NEAR(sum / area_of(plan.area), 1, 1e-4);
}

TEST(City, KeepsTheLeastAngleAndTheLeastLengthOfStreets) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const StreetGraph graph = made(random_town(seed), seed).graph;
    for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
      std::vector<double> angles;
      for (const std::uint32_t half : graph.arms.of(node)) {
        if (!graph.is_street(half / 2)) continue;
        const CmPoint& end = graph.nodes[end_of(graph.edges, half)];
        ASSERT_GE(distance(graph.nodes[node], end), 300);
        angles.push_back(std::atan2(end.y - graph.nodes[node].y, end.x - graph.nodes[node].x) * 180 /
                         math::pi);
      }
      std::sort(angles.begin(), angles.end());
      for (std::size_t i = 0; angles.size() > 1 && i < angles.size(); ++i) {
        const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 360;
        ASSERT_GE(next - angles[i], 22.5) << "seed " << seed;
      }
    }
  }
}

TEST(City, IsTheSameWithAnyNumberOfThreads) {
  const CityParams params = small_town(1200, 1200);
  for (const int threads : {2, 8}) {
    const CityPlan one = made(params, 3), many = made(params, 3, threads);
    ASSERT_EQ(one.graph.nodes, many.graph.nodes);
    ASSERT_EQ(one.parts.size(), many.parts.size());
    for (std::size_t i = 0; i < one.parts.size(); ++i) ASSERT_EQ(one.parts[i].rings, many.parts[i].rings);
  }
}

TEST(City, LeavesStreetsAloneWhenLotsChange) {
  CityParams params = small_town(700, 700);
  const CityPlan before = made(params, 9);
  params.lots.irregularity = 0.8;
  const CityPlan after = made(params, 9);
  EXPECT_EQ(before.graph.nodes, after.graph.nodes);
  EXPECT_NE(before.lots[0].corners, after.lots[0].corners);
}

TEST(City, KeepsStreetsFarFromAQuarterThatBecomesDenser) {
  CityParams params = small_town(2000, 2000);
  params.maps.density = "0.55";
  const CityPlan before = made(params, 11);
  params.maps.density = "0.55 + 0.3 * (x > 200 && y > 200)";
  const CityPlan after = made(params, 11);
  const std::set<std::uint64_t> there(after.graph.edge_key.begin(), after.graph.edge_key.end());
  int far = 0, kept = 0;
  for (std::uint32_t e = 0; e < before.graph.edges.size(); ++e) {
    if (!before.graph.is_street(e)) continue;
    bool is_far = true;
    for (const std::uint32_t node : {before.graph.edges[e].from, before.graph.edges[e].to}) {
      const glm::dvec2 p = in_metres(before.graph.nodes[node]);
      is_far &= std::hypot(std::max(0.0, 200 - p.x), std::max(0.0, 200 - p.y)) > 300;
    }
    if (!is_far) continue;
    ++far;
    kept += there.contains(before.graph.edge_key[e]) ? 1 : 0;
  }
  ASSERT_GT(far, 100);
  EXPECT_GE(kept, 0.95 * far);
}

TEST(CityStatistics, MeasureTheInnerAreaOfARectangleAndOfASquareWithAHole) {
  const Job job(0, Job::Options{});
  const CmRing square = {{0, 0}, {100'000, 0}, {100'000, 80'000}, {0, 80'000}};
  EXPECT_NEAR(inner_area({square}, 60, job), 880.0 * 680.0, 5);
  const CmRing hole = {{40'000, 40'000}, {40'000, 50'000}, {50'000, 50'000}, {50'000, 40'000}};
  // The hole takes its own area, four bands, and the four quarters of a disc.
  const double taken = 100.0 * 100.0 + 4 * 100.0 * 60.0 + math::pi * 3600;
  EXPECT_NEAR(inner_area({square, hole}, 60, job), 880.0 * 680.0 - taken, 20);
}

TEST(City, LeavesCourtsWithoutAccessBehindLotsOfTheOffset) {
  CityParams params = small_town(900, 900);
  params.streets.length = 120;
  params.lots.division = CityDivision::offset;
  const CityPlan plan = made(params, 4);
  const auto inner =
      std::count_if(plan.lots.begin(), plan.lots.end(), [](const Lot& lot) { return lot.is_inner; });
  EXPECT_GT(inner, 3);
  EXPECT_LT(inner, static_cast<std::ptrdiff_t>(plan.lots.size() / 3));
}

TEST(City, CutsNarrowDeepLotsOfBurgages) {
  CityParams params = small_town(800, 800);
  params.lots.division = CityDivision::burgage;
  params.lots.area = {60, 600};
  params.lots.width = 5;
  const CityPlan plan = made(params, 2);
  std::vector<double> fronts;
  for (const Lot& lot : plan.lots) fronts.push_back(lot.frontage);
  ASSERT_GT(fronts.size(), 200U);
  std::nth_element(fronts.begin(), fronts.begin() + static_cast<std::ptrdiff_t>(fronts.size() / 2),
                   fronts.end());
  const double median = fronts[fronts.size() / 2];
  EXPECT_GT(median, 5);
  EXPECT_LT(median, 13);
}

TEST(City, CrossesARiverOnBridges) {
  CityParams params = small_town(1200, 900);
  params.maps.water = "abs(y) < 25";
  const CityPlan plan = made(params, 6);
  EXPECT_FALSE(plan.graph.separated.empty());
  for (const SeparatedStreet& bridge : plan.graph.separated) {
    EXPECT_NEAR(std::abs(bridge.line.front().y - bridge.line.back().y), 5000, 60);
    EXPECT_GT(plan.graph.degree(bridge.from), 0U);
    EXPECT_GT(plan.graph.degree(bridge.to), 0U);
  }
  double water = 0;
  for (const Part& part : plan.parts) water += part.kind == PartKind::water ? area_of(part.rings) : 0;
  EXPECT_NEAR(water / (1200.0 * 50), 1, 0.01);
  params.streets.bridge_length = 40;
  EXPECT_TRUE(made(params, 6).graph.separated.empty());
}

/// The streets that have all of their length on the given side of x = 0.
std::size_t streets_beside(const CityPlan& plan, int side) {
  return static_cast<std::size_t>(
      std::count_if(plan.graph.edges.begin(), plan.graph.edges.end(), [&](const PlanarEdge& edge) {
        return is_street_tag(edge.tag) && plan.graph.nodes[edge.from].x * side > 0 &&
               plan.graph.nodes[edge.to].x * side > 0;
      }));
}

TEST(City, HasStreetsOnBothBanksOfAWindingRiver) {
  CityParams params = small_town(1100, 1000);
  params.maps.water = "abs(x - 60 * sin(y / 3)) < 26";
  params.streets.major_spacing = 250;
  params.streets.bend = 90;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const CityPlan plan = made(params, seed);
    const std::size_t west = streets_beside(plan, -1), east = streets_beside(plan, 1);
    EXPECT_GE(plan.graph.separated.size(), 1U) << seed;
    EXPECT_GT(std::min(west, east) * 4, std::max(west, east)) << seed << ": " << west << " and " << east;
  }
}

TEST(City, GrowsOnTheOtherBankWithoutABridgeIfTheFirstStartIsOnAnIsland) {
  // No link of the net ends on an island of 40 m, where the net starts.
  CityParams params = small_town(1100, 1000);
  params.maps.water = "sqrt(x * x + y * y) < 300 && sqrt(x * x + y * y) > 20";
  params.streets.bridge_length = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_GT(streets_beside(made(params, seed), 1), 20U) << seed;
}

/// A feature collection of lines without properties.
GeoJson lines(const std::vector<std::vector<std::array<double, 2>>>& list, const Json& properties = nullptr) {
  Json features = Json::array();
  for (const auto& line : list) {
    features.push_back({{"type", "Feature"},
                        {"properties", properties},
                        {"geometry", {{"type", "LineString"}, {"coordinates", line}}}});
  }
  return {Json({{"type", "FeatureCollection"}, {"features", features}}).dump()};
}

TEST(City, StreetsLeaveTheEndsOfAGivenBridgeAtClearAngles) {
  // Least angle between two streets at a node, degrees: the published bound for grown streets.
  constexpr double least_angle = 22.5;
  CityParams params = small_town(800, 700);
  params.maps.water = "abs(x) < 25";
  params.given.given_streets = lines({{{-120, 20}, {110, -15}}}, {{"level", 1}, {"class", "minor"}});
  std::size_t streets = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const CityPlan plan = made(params, seed);
    for (const SeparatedStreet& bridge : plan.graph.separated) {
      const glm::dvec2 from = in_cm(bridge.line.front()), to = in_cm(bridge.line.back());
      for (const auto& [node, along] : {std::pair(bridge.from, to - from), std::pair(bridge.to, from - to)}) {
        for (const std::uint32_t half : plan.graph.arms.of(node)) {
          if (!plan.graph.is_street(half / 2)) continue;
          const glm::dvec2 arm =
              in_cm(plan.graph.nodes[end_of(plan.graph.edges, half)]) - in_cm(plan.graph.nodes[node]);
          const double angle = std::acos(glm::dot(arm, along) / glm::length(arm) / glm::length(along));
          EXPECT_GT(angle * 180 / std::numbers::pi, least_angle) << seed;
          ++streets;
        }
      }
    }
  }
  EXPECT_GT(streets, 60U);
}

TEST(City, KeepsGivenStreetsAndGrowsFromThem) {
  CityParams params = small_town(700, 700);
  params.given.given_streets = lines({{{-300, 20}, {-40, 60}, {310, -30}}, {{-42, 61}, {-60, 250}}});
  for (const bool grows : {false, true}) {
    params.streets.method = grows ? CityMethod::growth : CityMethod::given;
    const CityPlan plan = made(params, 8);
    double given = 0, all = 0;
    for (std::uint32_t e = 0; e < plan.graph.edges.size(); ++e) {
      if (!plan.graph.is_street(e)) continue;
      const double length =
          distance(plan.graph.nodes[plan.graph.edges[e].from], plan.graph.nodes[plan.graph.edges[e].to]) /
          100;
      all += length;
      given += plan.graph.edges[e].tag >= first_given ? length : 0;
    }
    const double wanted = std::hypot(260, 40) + std::hypot(350, 90) + std::hypot(20, 190);
    EXPECT_NEAR(given, wanted, 5);
    EXPECT_EQ(all > given * 1.5, grows);
  }
}

TEST(City, MakesNoLotWithANarrowTailAlongTheBorder) {
  CityParams params = small_town(731.37, 883.52);
  params.streets.pattern = CityPattern::raster;
  params.streets.centre = {169.25, 435.24};
  params.streets.block = {49.47, 141.84};
  // The sidewalk of the northernmost street ends 2 cm before the border.
  const CityPlan plan = made(params, 277);
  EXPECT_GT(plan.lots.size(), 200U);
  for (const Lot& lot : plan.lots) {
    for (std::size_t i = 0; i < lot.corners.size(); ++i) {
      const glm::dvec2 p = in_cm(lot.corners[i]);
      for (std::size_t k = 0; k < lot.corners.size(); ++k) {
        const std::size_t next = (k + 1) % lot.corners.size();
        if (k == i || next == i) continue;
        ASSERT_GT(distance_to_segment(p, in_cm(lot.corners[k]), in_cm(lot.corners[next])), 10);
      }
    }
  }
}

/// The number of street networks without a common node.
std::size_t networks(const StreetGraph& graph) {
  std::vector<std::uint32_t> network(graph.nodes.size());
  for (std::uint32_t n = 0; n < network.size(); ++n) network[n] = n;
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t old = network[a], now = network[b];
    for (std::uint32_t& each : network) each = each == old ? now : each;
  };
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (graph.is_street(e)) join(graph.edges[e].from, graph.edges[e].to);
  }
  for (const SeparatedStreet& bridge : graph.separated) join(bridge.from, bridge.to);
  std::set<std::uint32_t> all;
  for (std::uint32_t n = 0; n < network.size(); ++n) {
    if (graph.street_ends(n) > 0) all.insert(network[n]);
  }
  return all.size();
}

TEST(City, ConnectsGivenStreetsThatGrowthDoesNotReach) {
  CityParams params = small_town(1025.56, 399.99);
  params.streets.pattern = CityPattern::radial;
  params.streets.clearance = 51;
  params.lots.division = CityDivision::none;
  params.maps.density = "0.5 + 0.5 * sin(x)";
  params.given.given_streets = lines({{{-208.29, 1.75}, {-87.74, 238.36}, {-57.9, 515.08}}});
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const CityPlan plan = made(params, seed);
    ASSERT_GT(plan.graph.edges.size(), 20U);
    EXPECT_EQ(networks(plan.graph), 1U) << "seed " << seed;
  }
}

TEST(City, LeavesNoShortPieceOfAGivenStreetBesideACrossing) {
  CityParams params = small_town(514.73, 840.86);
  params.streets.pattern = CityPattern::raster;
  params.given.given_streets = lines({{{91.48, -98.64}, {-69.18, -69.35}, {-251.97, -108.49}}});
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    params.streets.angle = 0.25 * static_cast<double>(seed);
    const StreetGraph graph = made(params, seed).graph;
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
      if (!graph.is_street(e)) continue;
      ASSERT_GE(distance(graph.nodes[graph.edges[e].from], graph.nodes[graph.edges[e].to]), 300)
          << "seed " << seed;
    }
  }
}

// A corner of the given streets is at the border or up to 10 cm beyond it, and rounding adds a piece of 2 cm there.
TEST(City, LeavesNoShortPieceOfAGivenStreetAtTheBorder) {
  CityParams params = small_town(200, 200);
  params.lots.division = CityDivision::none;
  params.area.polygon = {{{-94.5, -125.5}, {94.5, -125.5}, {94.5, 125.5}, {-12.5, 11.77}, {-94.5, 125.5}}};
  for (int n = 0; n < 60; ++n) {
    // The border between the last two corners.
    const double share = 0.1 + 0.013 * n, east = -12.5 - 82 * share, north = 11.77 + 113.73 * share;
    params.given.given_streets = lines({{{east + 2.5, -140}, {east, north + 0.003 * n}, {east - 6, 251}}});
    for (const CityMethod method : {CityMethod::given, CityMethod::growth}) {
      params.streets.method = method;
      const StreetGraph graph = made(params, 3).graph;
      for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
        if (!graph.is_street(e)) continue;
        ASSERT_GE(distance(graph.nodes[graph.edges[e].from], graph.nodes[graph.edges[e].to]), 300) << n;
      }
    }
  }
}

TEST(City, AvoidsObstacles) {
  CityParams params = small_town(900, 900);
  params.maps.obstacles = "sqrt(x * x + (y - 100) ^ 2) < 120";
  const CityPlan plan = made(params, 3);
  ASSERT_GT(plan.graph.edges.size(), 50U);
  for (std::uint32_t e = 0; e < plan.graph.edges.size(); ++e) {
    if (!plan.graph.is_street(e)) continue;
    const glm::dvec2 middle = (in_metres(plan.graph.nodes[plan.graph.edges[e].from]) +
                               in_metres(plan.graph.nodes[plan.graph.edges[e].to])) /
                              2.0;
    EXPECT_GT(std::hypot(middle.x, middle.y - 100), 118);
  }
}

std::vector<std::string> pointers(const CityParams& params) {
  std::vector<std::string> found;
  const Job job(0, Job::Options{});
  for (const Issue& issue : check(params, {job, {}})) found.push_back(issue.pointer);
  return found;
}

TEST(City, RefusesWhatContradictsItself) {
  CityParams params;
  params.lots.area = {800, 200};
  EXPECT_EQ(pointers(params), std::vector<std::string>{"/lots/area"});
  params = {};
  params.lots.area = {40, 90};
  params.lots.width = 60;
  EXPECT_EQ(pointers(params), std::vector<std::string>{"/lots/width"});
  params = {};
  params.area.polygon = {{{0, 0}, {500, 500}, {500, 0}, {0, 500}}};
  ASSERT_FALSE(pointers(params).empty());
  EXPECT_TRUE(pointers(params)[0].starts_with("/area/polygon"));
  params = {};
  params.maps.density = "x +* 2";
  EXPECT_EQ(pointers(params), std::vector<std::string>{"/maps/density"});
  params = {};
  params.streets.method = CityMethod::given;
  EXPECT_EQ(pointers(params), std::vector<std::string>{"/given/streets"});
  params.given.given_streets = lines({{{-200, 0}, {200, 0}}, {{0, -200}, {0, 200}}});
  EXPECT_EQ(pointers(params), std::vector<std::string>{"/given/streets/features/1/geometry"});
  params.given.given_streets = lines({{{-200, 0}, {0, 2}, {200, 0}}, {{0, -200}, {1, 200}}});
  EXPECT_TRUE(pointers(params).empty());
  params.given.given_streets = lines({{{-200, 0}, {200, 0}}}, {{"class", "alley"}});
  EXPECT_EQ(pointers(params), std::vector<std::string>{"/given/streets/features/0/properties/class"});
  params = {};
  params.streets.productions = {"R(del,rule) e"};
  ASSERT_FALSE(pointers(params).empty());
  EXPECT_EQ(pointers(params)[0], "/streets/productions/0");
}

TEST(City, MakesNoStreetsFromProductionsThatEraseTheFirstRoad) {
  CityParams params = small_town(600, 600);
  params.streets.productions = {"R(del, rule) -> *", "I(road, state) -> *"};
  const CityPlan plan = made(params, 1);
  EXPECT_TRUE(plan.lots.empty());
  ASSERT_EQ(plan.parts.size(), 1U);
  EXPECT_EQ(plan.parts[0].kind, PartKind::park);
}

TEST(City, RefusesNoRoadNumberThatProductionsInvent) {
  CityParams params = small_town(500, 500);
  for (const char* road : {"road + 1000000", "0 - 5", "1 / 0", "0 / 0"}) {
    params.streets.productions[7] = "I(road, state) : state == UNASSIGNED { localConstraints(" +
                                    std::string(road) + ") } -> I(road, state)";
    EXPECT_EQ(made(params, 1).parts.size(), 1U) << road;
  }
}

TEST(City, StopsProductionsThatMultiplyWithoutEnd) {
  CityParams params = small_town(500, 500);
  params.streets.productions = {"R(del, rule) -> B(1, 0, 0) B(1, 0, 0)",
                                "B(del, rule, road) -> B(1, 0, 0) B(1, 0, 0)"};
  Job job(1, Job::Options{});
  EXPECT_THROW(plan_of(params, job), Stop);
  params.streets.productions = {"R(a, b) -> R(a, b) R(a, b)"};
  EXPECT_THROW(plan_of(params, job), Stop);
}

TEST(City, RefusesFarTooManyStreetsBeforeTheyGrow) {
  CityParams params = small_town(40000, 40000);
  params.streets.length = 20;
  params.streets.major_spacing = 60;
  Job job(1, Job::Options{});
  EXPECT_THROW(plan_of(params, job), Stop);
  EXPECT_LT(job.budget()->peak(), 1U << 20U);
  // Most of this area has too few people for streets.
  params.maps.density = "(abs(x) < 150) * (abs(y) < 150)";
  Job sparse(1, Job::Options{});
  EXPECT_TRUE(plan_of(params, sparse));
}

/// The estimate is below what grows, so that it refuses nothing that fits.
TEST(City, EstimatesFewerStreetsThanGrow) {
  for (const CityPattern pattern : {CityPattern::organic, CityPattern::radial, CityPattern::raster}) {
    for (const double length : {25.0, 75.0}) {
      for (const double spacing : {80.0, 300.0}) {
        CityParams params = small_town(900, 900);
        params.streets.pattern = pattern;
        params.streets.length = length;
        params.streets.major_spacing = spacing;
        params.streets.branch_probability = 0;
        params.streets.fill = 0.6;
        params.maps.density = "0.5";
        std::vector<Issue> issues;
        const Job job(1, Job::Options{});
        const CityPlan plan = made(params, 1);
        const StreetGrammar grammar(params.streets.productions, "", issues);
        const auto density = FieldMap::read(params.maps.density, "", {-1, -1}, {1, 1}, job, issues);
        GrowthInput input{
            .streets = params.streets, .density = *density, .grammar = grammar, .region = plan.region};
        EXPECT_LT(least_pieces(input), plan.graph.edges.size()) << length << " " << spacing;
        EXPECT_GT(least_pieces(input), 0.2 * static_cast<double>(plan.graph.edges.size()));
      }
    }
  }
}

/// Streets wider than the space between them have no width, and left rings of two corners.
TEST(City, ClosesThePartitionAroundStreetsWithoutSpace) {
  CityParams params = small_town(39.47, 37.96);
  params.given.given_streets =
      lines({{{-23.22, 31.75}, {-24.44, 26.89}, {-22.96, 22.1}, {-19.11, 18.89}, {-17.41, 14.17}},
             {{-24.44, 26.89}, {-7.07, 33.14}},
             {{-21.78, -11.14}, {-7.62, -7.8}, {6.33, -3.68}, {16.21, 7}},
             {{8.61, 6.57}, {9.86, 1.64}, {8.25, -3.19}},
             {{8.61, 6.57}, {19.73, 2.84}}},
            {{"width", 27.82}});
  const CityPlan plan = made(params, 5);
  double covered = 0;
  for (const Part& part : plan.parts) {
    covered += area_of(part.rings);
    for (const CmRing& ring : part.rings) EXPECT_GE(ring.size(), 3U);
  }
  EXPECT_NEAR(covered / area_of(plan.area), 1, 1e-4);
}

TEST(City, GrowsMoreWhereBranchesAreNotErased) {
  CityParams params = small_town(900, 900);
  params.streets.branch_probability = 1;
  const std::size_t many = made(params, 1).graph.edges.size();
  // p6 erases every branch instead of those with a negative delay.
  params.streets.productions[5] = "B(del, rule, road) : del >= 0 -> *";
  std::rotate(params.streets.productions.begin() + 3, params.streets.productions.begin() + 5,
              params.streets.productions.begin() + 6);
  EXPECT_LT(made(params, 1).graph.edges.size(), many);
}

}  // namespace
}  // namespace seedmesh::city
