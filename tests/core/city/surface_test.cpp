#include "core/generators/city/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/city/city.h"
#include "core/generators/city/city_model.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

/// Hills of a few wavelengths, which streets have to follow, cut or fill.
CityParams random_hills(std::uint64_t seed) {
  Rng rng = Rng::of_seed(seed);
  CityParams params;
  params.area.size = {rng.uniform(250, 600), rng.uniform(250, 600)};
  params.maps.height = std::to_string(rng.uniform(4, 22)) + " * sin(x * " +
                       std::to_string(rng.uniform(0.3, 1)) + ") + " + std::to_string(rng.uniform(4, 22)) +
                       " * cos(y * " + std::to_string(rng.uniform(0.3, 1)) + ") + 0.02 * x";
  params.streets.pattern = static_cast<CityPattern>(rng.below(4));
  params.streets.major_spacing = rng.uniform(130, 260);
  params.streets.classes.minor.grade = rng.uniform(0.08, 0.2);
  params.lots.division = static_cast<CityDivision>(rng.below(5));
  if (params.lots.division == CityDivision::burgage) params.lots.area = {60, 500};
  if (seed % 3 == 0) params.maps.water = "abs(y - 30 * sin(x)) < 22";
  params.buildings.rules = std::vector<CityBuildingRule>{};
  return params;
}

Result<CityPlan> plan_by(const CityParams& params, std::uint64_t seed) {
  Job job(seed, Job::Options{});
  return plan_of(params, job);
}

/// The greatest cut or fill at a node.
double greatest_change(const CityPlan& plan) {
  double greatest = 0;
  for (std::uint32_t n = 0; n < plan.graph.nodes.size(); ++n) {
    if (plan.graph.street_ends(n) == 0) continue;
    greatest = std::max(greatest,
                        std::abs(plan.heights.node[n] - plan.landform->at(in_metres(plan.graph.nodes[n]))));
  }
  return greatest;
}

/// The steepest grade of a street, as rise over run.
double steepest_grade(const StreetHeights& heights, std::uint32_t edge) {
  double steepest = 0;
  for (std::uint32_t k = heights.first[edge] + 1; k < heights.first[edge + 1]; ++k) {
    const ProfilePoint &a = heights.points[k - 1], &b = heights.points[k];
    const double run = distance(a.at, b.at) / 100;
    if (run > 0) steepest = std::max(steepest, std::abs(b.height - a.height) / run);
  }
  return steepest;
}

TEST(CityGrades, KeepTheLimitOfEachClassAndLevelJunctions) {
  std::size_t streets = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Result<CityPlan> plan = plan_by(random_hills(seed), seed);
    if (!plan) continue;  // some hills are too steep for any street
    for (std::uint32_t edge = 0; edge < plan->graph.edges.size(); ++edge) {
      if (!plan->graph.is_street(edge)) continue;
      ++streets;
      ASSERT_LE(steepest_grade(plan->heights, edge), plan->class_of(edge).grade_limit + 1e-9)
          << "seed " << seed;
      const PlanarEdge& each = plan->graph.edges[edge];
      ASSERT_EQ(height_on_street(plan->heights, edge, -1), plan->heights.node[each.from]);
      ASSERT_EQ(height_on_street(plan->heights, edge, 1e6), plan->heights.node[each.to]);
    }
    for (const SeparatedStreet& bridge : plan->graph.separated) {
      const std::vector<ProfilePoint> line = separated_profile(*plan, bridge);
      for (std::size_t k = 1; k < line.size(); ++k) {
        const double run = distance(line[k - 1].at, line[k].at) / 100;
        ASSERT_LE(std::abs(line[k].height - line[k - 1].height),
                  plan->classes[bridge.tag].grade_limit * run + 1e-6);
      }
    }
  }
  EXPECT_GT(streets, 1000U);
}

TEST(CityGrades, StayNearTheGroundWhereStreetsGrow) {
  std::vector<double> changes;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Result<CityPlan> plan = plan_by(random_hills(seed), seed);
    if (plan) changes.push_back(greatest_change(*plan));
  }
  std::sort(changes.begin(), changes.end());
  ASSERT_GT(changes.size(), 10U);
  EXPECT_LT(changes[changes.size() / 2], 8);
}

/// The triangles of the ground and the town wall of a model, without bridges, foundations and buildings.
struct GroundFaces {
  std::map<std::array<std::array<float, 3>, 2>, int> open;  ///< directed edges without their reverse
  double area_from_above = 0;
  std::size_t hanging = 0;  ///< triangles seen from below
};

GroundFaces faces_of_ground(const Model& model) {
  GroundFaces faces;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const std::string& parent =
        node.parent < 0 ? node.name : model.nodes[static_cast<std::size_t>(node.parent)].name;
    if (parent != "ground" && node.name != "wall") continue;
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      const Mesh& mesh = primitive.mesh;
      const auto corner = [&](std::size_t i) {
        const glm::vec3& p = mesh.position[mesh.index.at(i)];
        return std::array<float, 3>{p.x, p.y, p.z};
      };
      for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
        const std::array<std::array<float, 3>, 3> at = {corner(i), corner(i + 1), corner(i + 2)};
        const auto side = [&](std::size_t a, std::size_t b) {
          return dvec2(double{at[b][0]} - double{at[a][0]}, double{at[a][2]} - double{at[b][2]});
        };
        const dvec2 u = side(0, 1), v = side(0, 2);
        const double area = (u.x * v.y - u.y * v.x) / 2;
        faces.area_from_above += area;
        faces.hanging += area < -1e-6 ? 1 : 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const auto &a = at[k], &b = at[(k + 1) % 3];
          if (--faces.open[{b, a}] == 0) faces.open.erase({b, a});
          if (++faces.open[{a, b}] == 0) faces.open.erase({a, b});
        }
      }
    }
  }
  return faces;
}

bool is_on_border(const CityPlan& plan, const std::array<float, 3>& p) {
  const dvec2 at(double{p[0]} * 100, 0 - double{p[2]} * 100);
  for (const CmRing& ring : plan.area) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (distance_to_segment(at, in_cm(ring[i]), in_cm(ring[(i + 1) % ring.size()])) < 2) return true;
    }
  }
  return false;
}

/// Edges with one face alone that are not upright and not on the border of the area: gaps, or corners that only one of two
/// neighbours has.
std::vector<std::string> gaps_of(const CityPlan& plan, const GroundFaces& faces) {
  std::vector<std::string> gaps;
  for (const auto& [edge, count] : faces.open) {
    const auto& [a, b] = edge;
    if (count <= 0 || (a[0] == b[0] && a[2] == b[2])) continue;
    if (is_on_border(plan, a) && is_on_border(plan, b)) continue;
    gaps.push_back(std::to_string(a[0]) + " " + std::to_string(a[1]) + " " + std::to_string(a[2]) + " to " +
                   std::to_string(b[0]) + " " + std::to_string(b[1]) + " " + std::to_string(b[2]));
  }
  return gaps;
}

void expect_closed_ground(const CityParams& params, std::uint64_t seed) {
  Job job(seed, Job::Options{});
  Result<CityPlan> plan = plan_of(params, job);
  if (!plan) return;
  const Result<Model> model = city_model(*plan, params, {job});
  ASSERT_TRUE(model);
  const GroundFaces faces = faces_of_ground(*model);
  EXPECT_EQ(faces.hanging, 0U) << "seed " << seed;
  EXPECT_NEAR(faces.area_from_above / area_of(plan->area), 1, 1e-5) << "seed " << seed;
  const std::vector<std::string> gaps = gaps_of(*plan, faces);
  EXPECT_TRUE(gaps.empty()) << gaps.size() << " gaps, seed " << seed << ", first " << gaps[0];
}

TEST(CityGrades, CutAndFillAtMostEightMetres) {
  int plans = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CityParams params = random_hills(seed);
    params.lots.division = CityDivision::none;
    const Result<CityPlan> plan = plan_by(params, seed);
    if (!plan) continue;  // too steep for any street
    ++plans;
    for (std::uint32_t edge = 0; edge < plan->graph.edges.size(); ++edge) {
      if (!plan->graph.is_street(edge)) continue;
      for (std::uint32_t k = plan->heights.first[edge]; k < plan->heights.first[edge + 1]; ++k) {
        const ProfilePoint& point = plan->heights.points[k];
        const double change = std::abs(point.height - plan->landform->at(in_metres(point.at)));
        EXPECT_LE(change, 8) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(plans, 30);
}

TEST(CityGround, HasNoGapsAndNoOverlapsOnLevelGround) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CityParams params = random_hills(seed);
    params.maps.height.reset();
    expect_closed_ground(params, seed);
  }
}

TEST(CityGround, HasNoGapsAndNoOverlapsOnHills) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) expect_closed_ground(random_hills(seed), seed);
}

TEST(CityGround, HasNoGapsAndNoOverlapsInAnyPreset) {
  const std::filesystem::path folder = std::filesystem::path(SEEDMESH_SOURCE_DIR) / "api_schema/presets/city";
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_GT(files.size(), 12U);
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file.filename().string());
    std::ifstream in(file);
    IssueList errors;
    CityParams params = read_city(Json::parse(in)["parameters"], "", errors);
    params.area.size = {std::min(params.area.size[0], 700.0), std::min(params.area.size[1], 600.0)};
    // The ground alone: what stands on it needs other generators.
    params.buildings.rules = std::vector<CityBuildingRule>{};
    params.buildings.landmarks.clear();
    params.furniture = {};
    params.parks.reset();
    params.yards.reset();
    expect_closed_ground(params, 1);
  }
}

TEST(CityGround, StaysWithinItsSlopeWithoutAWall) {
  // Of the triangles of blocks; corners of long triangles can differ more than the ground that they sample.
  double all = 0, steep = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const CityParams params = random_hills(seed);
    Job job(seed, Job::Options{});
    Result<CityPlan> plan = plan_of(params, job);
    if (!plan) continue;
    const Result<Model> model = city_model(*plan, params, {job});
    ASSERT_TRUE(model);
    for (const Node& node : model->nodes) {
      if (node.mesh < 0 || (node.name != "lot" && node.name != "park")) continue;
      const Mesh& mesh = model->meshes[static_cast<std::size_t>(node.mesh)].primitives[0].mesh;
      for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
        const glm::dvec3 a = mesh.position[mesh.index.at(i)], b = mesh.position[mesh.index.at(i + 1)],
                         c = mesh.position[mesh.index.at(i + 2)];
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        if (normal.y < 0.01) continue;  // walls
        all += normal.y;
        if (std::sqrt(normal.x * normal.x + normal.z * normal.z) > normal.y / 1.5) steep += normal.y;
      }
    }
  }
  EXPECT_GT(all, 1e5);
  EXPECT_LT(steep / all, 0.01);
}

TEST(CityGround, MeetsTheStreetsExactlyWhereNoWallStands) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Result<CityPlan> plan = plan_by(random_hills(seed), seed);
    if (!plan) continue;
    Job job(seed, Job::Options{});
    const Surface surface(*plan, kerb_height, job);
    std::size_t corners = 0, walls = 0;
    for (std::uint32_t n = 0; n < plan->parts.size(); ++n) {
      const Part& part = plan->parts[n];
      if (part.kind != PartKind::lot) continue;
      for (std::size_t i = 0; i < part.rings[0].size(); ++i) {
        const CmPoint &a = part.rings[0][i], &b = part.rings[0][(i + 1) % part.rings[0].size()];
        const std::uint32_t beyond = surface.part_beyond(a, b);
        if (beyond == no_index || plan->parts[beyond].kind != PartKind::sidewalk) continue;
        ++corners;
        const double here = surface.height(n, in_metres(a)), there = surface.height(beyond, in_metres(a));
        if (here == there) continue;
        ++walls;
        ASSERT_GT(std::abs(here - there), 1e-3) << "seed " << seed;
      }
    }
    EXPECT_LT(walls, corners / 2 + 1) << "seed " << seed;
  }
}

TEST(CityGrades, KeepStreetsAboveTheWaterOfATerrain) {
  CityParams params;
  params.area.size = {500, 500};
  params.terrain = Child{
      "terrain", 4,
      R"({"algorithm":"fbm","size":600,"resolution":65,"wavelength":300,"amplitude":40,"water_level":-5})"};
  params.streets.major_spacing = 150;
  std::size_t water = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Result<CityPlan> plan = plan_by(params, seed);
    ASSERT_TRUE(plan);
    for (const Part& part : plan->parts) water += part.kind == PartKind::water ? 1 : 0;
    for (const ProfilePoint& point : plan->heights.points) ASSERT_GE(point.height, -5);
  }
  EXPECT_GT(water, 0U);
}

TEST(CityGrades, RefuseGroundThatIsTooSteepForAnyStreet) {
  CityParams params;
  params.area.size = {300, 300};
  params.maps.height = "400 * sin(11.3 * x + y) * sin(8.7 * y - x)";
  const Result<CityPlan> plan = plan_by(params, 1);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().issues[0].pointer, "/maps/height");
}

}  // namespace
}  // namespace seedmesh::city
