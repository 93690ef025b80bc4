#include "core/generators/city/tunnels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/city/city.h"
#include "core/generators/city/city_model.h"
#include "core/generators/city/surface.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

/// A street through a ridge of the given height: up to its foot, a tunnel, and on behind it.
CityParams city_with_tunnel(double ridge, double skew = 0, double width = 9) {
  const auto line = [](double from, double from_north, double to, double to_north, Json properties) {
    return Json{
        {"type", "Feature"},
        {"properties", std::move(properties)},
        {"geometry", {{"type", "LineString"}, {"coordinates", {{from, from_north}, {to, to_north}}}}}};
  };
  const double north = 80 * skew;
  const Json streets = {{"type", "FeatureCollection"},
                        {"features",
                         {line(-240, 0, -80, 0, {{"class", "major"}, {"width", width}}),
                          line(-80, 0, 80, north, {{"class", "major"}, {"width", width}, {"tunnel", true}}),
                          line(80, north, 240, north, {{"class", "major"}, {"width", width}})}}};
  const std::string height = std::to_string(ridge) + " * exp(-(x / 40) * (x / 40))";
  IssueList errors;
  CityParams params = read_city({{"area", {{"size", {480, 360}}}},
                                 {"maps", {{"height", height}}},
                                 {"given", {{"streets", streets}}},
                                 {"streets", {{"method", "given"}}},
                                 {"lots", {{"method", "none"}}}},
                                "", errors);
  EXPECT_TRUE(errors.take().empty());
  params.buildings.rules = std::vector<CityBuildingRule>{};
  return params;
}

CityPlan plan_by(const CityParams& params) {
  Job job(1, Job::Options{});
  Result<CityPlan> plan = plan_of(params, job);
  EXPECT_TRUE(plan);
  return *std::move(plan);
}

/// The triangles of the nodes that `wanted` selects, as directed edges without their reverse.
template <class Wanted>
std::map<std::array<std::array<float, 3>, 2>, int> open_edges(const Model& model, const Wanted& wanted) {
  std::map<std::array<std::array<float, 3>, 2>, int> open;
  for (const Node& node : model.nodes) {
    const bool is_ground =
        node.parent >= 0 && model.nodes[static_cast<std::size_t>(node.parent)].name == "ground";
    if (node.mesh < 0 || !(is_ground || wanted(node.name))) continue;
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(node.mesh)].primitives[0].mesh;
    const auto corner = [&](std::size_t i) {
      const glm::vec3& p = mesh.position[mesh.index.at(i)];
      return std::array<float, 3>{p.x, p.y, p.z};
    };
    for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::array<std::array<float, 3>, 2> edge = {corner(i + k), corner(i + (k + 1) % 3)};
        if (--open[{edge[1], edge[0]}] == 0) open.erase({edge[1], edge[0]});
        if (++open[edge] == 0) open.erase(edge);
      }
    }
  }
  return open;
}

TEST(Tunnels, AreCoveredByTheGroundAlongTheirWholeLength) {
  for (const double ridge : {4.0, 12.0, 30.0}) {
    for (const double skew : {0.0, 0.2}) {
      const CityParams params = city_with_tunnel(ridge, skew);
      const CityPlan plan = plan_by(params);
      Job job(1, Job::Options{});
      const Surface surface(plan, 0, job);
      ASSERT_EQ(surface.tunnels().all().size(), 1U) << ridge << " " << skew;
      const Tunnel& tunnel = surface.tunnels().all()[0];
      const auto ground_at = [&](const dvec2& p) {
        for (std::uint32_t n = 0; n < plan.parts.size(); ++n) {
          bool is_in = false;
          for (const CmRing& ring : plan.parts[n].rings) is_in ^= is_inside(ring, p * 100.0);
          if (is_in) return surface.height(n, p);
        }
        return -1e9;
      };
      for (std::size_t k = 1; k + 1 < tunnel.stations.size(); ++k) {
        const TunnelStation& here = tunnel.stations[k];
        for (const dvec2& p : {here.left, here.middle, here.right}) {
          EXPECT_GE(ground_at(p), here.height + Tunnels::clear_height + Tunnels::slab)
              << ridge << " at " << p.x;
        }
      }
    }
  }
}

TEST(Tunnels, KeepTheGradeLimitOfTheirClass) {
  for (const double ridge : {4.0, 12.0, 30.0}) {
    const CityPlan plan = plan_by(city_with_tunnel(ridge));
    ASSERT_EQ(plan.graph.separated.size(), 1U);
    const SeparatedStreet& bridge = plan.graph.separated[0];
    const std::vector<ProfilePoint> line = separated_profile(plan, bridge);
    for (std::size_t k = 1; k < line.size(); ++k) {
      const double run = distance(line[k - 1].at, line[k].at) / 100;
      EXPECT_LE(std::abs(line[k].height - line[k - 1].height) / run,
                plan.classes[bridge.tag].grade_limit + 1e-6);
    }
  }
}

TEST(Tunnels, CloseTheGroundWithTheirTubes) {
  Rng draw(3);
  for (int n = 0; n < 60; ++n) {
    const CityParams params =
        city_with_tunnel(draw.uniform(2, 40), draw.uniform(-0.3, 0.3), draw.uniform(4, 14));
    CityPlan plan = plan_by(params);
    Job job(1, Job::Options{});
    const Result<Model> model = city_model(plan, params, {job});
    ASSERT_TRUE(model);
    ASSERT_TRUE(model->warnings.empty());
    for (const auto& [edge, count] : open_edges(*model, [](const auto& name) { return name == "tunnels"; })) {
      const auto& [a, b] = edge;
      const bool is_upright = a[0] == b[0] && a[2] == b[2];
      const bool is_at_border = (std::abs(a[0]) > 239.9F && std::abs(b[0]) > 239.9F) ||
                                (std::abs(a[2]) > 179.9F && std::abs(b[2]) > 179.9F);
      EXPECT_TRUE(count <= 0 || is_upright || is_at_border)
          << n << ": " << a[0] << " " << a[1] << " " << a[2] << " to " << b[0] << " " << b[1] << " " << b[2];
    }
  }
}

TEST(Tunnels, BelowLevelGroundHaveNoMeshAndAWarning) {
  CityParams params = city_with_tunnel(10);
  params.maps.height.reset();
  Job job(1, Job::Options{});
  const Result<Model> model = generate(params, {job});
  ASSERT_TRUE(model);
  ASSERT_EQ(model->warnings.size(), 1U);
  EXPECT_EQ(model->warnings[0].pointer, "/given/streets");
  for (const Node& node : model->nodes) EXPECT_NE(node.name, "tunnels");
}

}  // namespace
}  // namespace seedmesh::city
