#include "core/generators/city/wards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/generators/city/city.h"
#include "core/geom/polygon/planar_graph.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

CityParams walled_town() {
  CityParams params;
  params.area.size = {1000, 1000};
  params.streets.method = CityMethod::wards;
  params.streets.length = 58;
  params.streets.snap = 12;
  params.streets.clearance = 21;
  params.streets.classes.minor.width = 4;
  params.streets.classes.minor.sidewalk = 0.7;
  params.lots.division = CityDivision::burgage;
  params.lots.area = {55, 420};
  params.lots.width = 5;
  return params;
}

Result<CityPlan> planned(const CityParams& params, std::uint64_t seed) {
  Job job(seed, Job::Options{});
  return plan_of(params, job);
}

bool has_wall(const CityPlan& plan, std::uint32_t edge) {
  return plan.graph.is_street(edge) && plan.class_of(edge).has_wall;
}

TEST(Wards, HaveTheirNumberAndMeanArea) {
  CityParams params = walled_town();
  for (const int count : {8, 16, 30}) {
    params.streets.wards.count = count;
    double area = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Result<CityPlan> plan = planned(params, seed);
      ASSERT_TRUE(plan);
      ASSERT_EQ(plan->wards.size(), static_cast<std::size_t>(count));
      for (const Ward& ward : plan->wards) {
        ASSERT_TRUE(is_simple(ward.ring));
        area += area_of({ward.ring}) / count / 10;
      }
    }
    // The points of the spiral have this area each; smoothing rounds the outline off.
    EXPECT_NEAR(area / (85.0 * 85.0), 1, 0.15) << count;
  }
}

TEST(Wards, OpenTheirWallAtGatesOnly) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Result<CityPlan> plan = planned(walled_town(), seed);
    ASSERT_TRUE(plan);
    ASSERT_GE(plan->gates.size(), 2U) << "seed " << seed;
    std::set<std::uint32_t> wall;
    for (std::uint32_t e = 0; e < plan->graph.edges.size(); ++e) {
      if (!has_wall(*plan, e)) continue;
      wall.insert(plan->graph.edges[e].from);
      wall.insert(plan->graph.edges[e].to);
    }
    int roads = 0;
    for (std::uint32_t e = 0; e < plan->graph.edges.size(); ++e) {
      if (!plan->graph.is_street(e) || has_wall(*plan, e)) continue;
      const PlanarEdge& edge = plan->graph.edges[e];
      const CmPoint &a = plan->graph.nodes[edge.from], &b = plan->graph.nodes[edge.to];
      if (ward_at(plan->wards, (in_cm(a) + in_cm(b)) / 2.0)) continue;
      for (const std::uint32_t node : {edge.from, edge.to}) {
        if (!wall.contains(node)) continue;
        ++roads;
        EXPECT_EQ(std::count(plan->gates.begin(), plan->gates.end(), plan->graph.nodes[node]), 1);
      }
    }
    EXPECT_GE(roads, 1) << "seed " << seed;
    EXPECT_LE(roads, static_cast<int>(plan->gates.size()));
  }
}

TEST(Wards, AreSurroundedByOneClosedWall) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Result<CityPlan> plan = planned(walled_town(), seed);
    ASSERT_TRUE(plan);
    std::map<std::uint32_t, std::uint32_t> next;
    for (std::uint32_t e = 0; e < plan->graph.edges.size(); ++e) {
      if (!has_wall(*plan, e)) continue;
      ASSERT_TRUE(next.emplace(plan->graph.edges[e].from, plan->graph.edges[e].to).second);
    }
    CmRing ring;
    std::uint32_t at = next.begin()->first;
    do {
      ring.push_back(plan->graph.nodes[at]);
      ASSERT_TRUE(next.contains(at));
      at = next.at(at);
    } while (at != next.begin()->first);
    ASSERT_EQ(ring.size(), next.size());
    EXPECT_TRUE(is_simple(ring));
    double wards = 0, walls = 0, length = 0;
    for (const Ward& ward : plan->wards) wards += area_of({ward.ring});
    EXPECT_NEAR(area_of({ring}) / wards, 1, 1e-4);
    for (const Part& part : plan->parts) walls += part.is_wall ? area_of(part.rings) : 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
      length += distance(ring[i], ring[(i + 1) % ring.size()]) / 100;
    // Three metres wide, except at the gates; the outline is longer than the street inside of it.
    EXPECT_GT(walls, 3 * (length - 40.0 * static_cast<double>(plan->gates.size()))) << "seed " << seed;
    EXPECT_LT(walls, 3 * length * 1.1) << "seed " << seed;
  }
}

TEST(Wards, LeaveTheSquareFreeAndGiveTheCitadelOneLot) {
  int citadels = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Result<CityPlan> plan = planned(walled_town(), seed);
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->wards[0].zone, zone_square);
    int lots = 0;
    for (const Lot& lot : plan->lots) {
      ASSERT_NE(lot.zone, zone_square);
      ASSERT_FALSE(lot.zone.empty());
      lots += lot.zone == zone_citadel ? 1 : 0;
      glm::dvec2 middle{0};
      for (const CmPoint& p : lot.corners) middle += in_cm(p) / static_cast<double>(lot.corners.size());
      ASSERT_TRUE(ward_at(plan->wards, middle));
    }
    EXPECT_LE(lots, 1);
    citadels += lots;
    const bool has_square = std::any_of(plan->parts.begin(), plan->parts.end(), [&](const Part& part) {
      return part.kind == PartKind::square && is_inside(plan->wards[0].ring, in_cm(part.rings[0][0])) &&
             area_of(part.rings) > 0.4 * area_of({plan->wards[0].ring});
    });
    EXPECT_TRUE(has_square) << "seed " << seed;
  }
  EXPECT_GE(citadels, 8);
}

TEST(Wards, PartitionTheAreaBesideARiver) {
  CityParams params = walled_town();
  params.maps.water = "abs(y + 0.4 * x + 180 - 25 * sin(0.6 * x)) < 16";
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Result<CityPlan> plan = planned(params, seed);
    ASSERT_TRUE(plan);
    double sum = 0;
    for (const Part& part : plan->parts) sum += area_of(part.rings);
    EXPECT_NEAR(sum / area_of(plan->area), 1, 1e-5) << "seed " << seed;
    for (const Ward& ward : plan->wards) {
      for (const CmPoint& p : ward.ring) ASSERT_TRUE(is_on_land(plan->region, in_cm(p)));
    }
  }
}

TEST(Wards, KeepOffSteepGround) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    CityParams params = walled_town();
    params.maps.height = "max(0, x - 60) * 0.6";  // a steep hillside in the east
    const Result<CityPlan> plan = planned(params, seed);
    ASSERT_TRUE(plan) << seed;
    ASSERT_GE(plan->wards.size(), 4U);
    for (const Ward& ward : plan->wards) {
      for (std::size_t i = 0; i < ward.ring.size(); ++i) {
        const glm::dvec2 a = in_metres(ward.ring[i]), b = in_metres(ward.ring[(i + 1) % ward.ring.size()]);
        const double rise = 0.6 * std::abs(std::max(0.0, a.x - 60) - std::max(0.0, b.x - 60));
        // Corners of the outline move a little once the wards are chosen.
        EXPECT_LE(rise, 0.3 * distance(ward.ring[i], ward.ring[(i + 1) % ward.ring.size()]) / 100) << seed;
      }
    }
  }
}

TEST(Wards, AreRefusedWhereTheyFindNoSpace) {
  CityParams params = walled_town();
  params.area.size = {200, 200};
  const Result<CityPlan> plan = planned(params, 1);
  ASSERT_FALSE(plan);
  ASSERT_EQ(plan.error().issues.size(), 1U);
  EXPECT_EQ(plan.error().issues[0].pointer, "/streets/wards");
}

}  // namespace
}  // namespace seedmesh::city
