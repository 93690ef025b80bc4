/// Streets without a common node keep apart.
#include "core/generators/city/near_streets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/generators/city/pruned_graph.h"
#include "core/pipeline.h"
#include "core/schema/json.h"

namespace seedmesh::city {
namespace {

constexpr auto major = static_cast<std::uint32_t>(EdgeClass::major),
               minor = static_cast<std::uint32_t>(EdgeClass::minor);
const std::vector<double> widths = {0, 0, 2200, 1400, 700, 400};

/// The streets that drop_near() keeps.
std::size_t kept(const std::vector<StreetPiece>& pieces) {
  PlanarGraph graph;
  for (const StreetPiece& each : pieces) graph.add(each.a, each.b, each.kind);
  PrunedGraph pruned(graph, {});
  const Job job(0, Job::Options{});
  pruned.drop_near(widths, job);
  return pruned.finished().edges.size();
}

TEST(NearStreets, DropTheLowerClassOfTwoParallelStreetsBelowHalfOfBothWidths) {
  // Half of 14 m and of 7 m are 10.5 m.
  EXPECT_EQ(kept({{{0, 0}, {5000, 0}, major}, {{0, 1049}, {5000, 1049}, minor}}), 1U);
  EXPECT_EQ(kept({{{0, 0}, {5000, 0}, major}, {{0, 1050}, {5000, 1050}, minor}}), 2U);
}

TEST(NearStreets, KeepArmsOfAJunctionAt23DegreesAndTheirNextPieces) {
  // Pieces of 5 m: the second ones are 1.99 m apart, 2 * 5 * sin(11.5 degrees).
  const CmPoint a{500, 0}, b{460, 195}, c{1000, 0}, d{921, 391};
  EXPECT_EQ(kept({{{0, 0}, a, minor}, {{0, 0}, b, minor}, {a, c, minor}, {b, d, minor}}), 4U);
}

TEST(NearStreets, DropADeadEndThatBendsBackToTheOtherArm) {
  // The last piece ends 0.5 m beside the straight arm, 30 m from the junction.
  const CmPoint a{1500, 0}, b{1386, 574}, c{3000, 0};
  EXPECT_EQ(kept({{{0, 0}, a, minor}, {{0, 0}, b, minor}, {a, c, minor}, {b, {2900, 50}, minor}}), 3U);
}

struct Point {
  double x, y;
};
double distance_to(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double share = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
}

/// The least distance in metres of corners of streets to other streets without a common node.
double least_distance(const std::string& parameters) {
  const Result<Request> request =
      read_request(R"({"generator": "city", "seed": 1, "parameters": )" + parameters + "}", Limits{});
  EXPECT_TRUE(request);
  const Result<std::string> text = derive(*request, {});
  EXPECT_TRUE(text);
  const Json answer = Json::parse(*text);
  std::vector<Json> streets;
  for (const Json& each : answer["plan"]["features"]) {
    if (each["properties"]["kind"] == "street" && each["properties"]["level"] == 0) streets.push_back(each);
  }
  EXPECT_GT(streets.size(), 100U);
  const auto point = [](const Json& p) { return Point{p[0], p[1]}; };
  double least = 1e9;
  for (const Json& one : streets) {
    for (const Json& two : streets) {
      const Json &p = one["properties"], &q = two["properties"];
      if (p["from"] == q["from"] || p["from"] == q["to"] || p["to"] == q["from"] || p["to"] == q["to"])
        continue;
      const Json &corners = one["geometry"]["coordinates"], &line = two["geometry"]["coordinates"];
      for (const Json& corner : corners) {
        for (std::size_t k = 1; k < line.size(); ++k)
          least = std::min(least, distance_to(point(corner), point(line[k - 1]), point(line[k])));
      }
    }
  }
  return least;
}

// Streets are at least 3.1 m long and arms of junctions at least 22.5 degrees apart, so the ends of two arms are
// 2 * 3.1 m * sin(11.25 degrees) = 1.21 m apart.
TEST(NearStreets, KeepApartInTownsOnHillsAndInOrganicTowns) {
  EXPECT_GT(least_distance(
                R"({"area": {"size": [750, 750]}, "streets": {"pattern": "slope", "minor_pattern": "radial",
    "major_spacing": 61, "length": 128, "snap": 30}, "terrain": {"generator": "terrain", "seed": 233, "parameters":
    {"algorithm": "fbm", "size": 1400, "amplitude": 20, "wavelength": 503}}, "lots": {"method": "none"},
    "buildings": {"rules": []}})"),
            1.2);
  EXPECT_GT(
      least_distance(R"({"area": {"size": [1200, 1200]}, "streets": {"pattern": "organic", "jitter": 0.3,
    "major_spacing": 120, "bend": 40}, "lots": {"method": "none"}, "buildings": {"rules": []}})"),
      1.2);
}

}  // namespace
}  // namespace seedmesh::city
