#include "core/generators/terrain/triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "core/generators/terrain/noise.h"
#include "core/generators/terrain/scan.h"
#include "core/generators/terrain/surface.h"
#include "core/geom/mesh/finish.h"
#include "tests/core/terrain/support.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::terrain {
namespace {

using Reducer = Triangulation (*)(const Field&, double, Border, Job&);
const std::pair<const char*, Reducer> reducers[] = {{"rtin", rtin}, {"greedy", greedy}};

Field hills(std::int32_t side, std::int64_t west = 0) {
  NoisePlan plan;
  plan.amplitude = 10;
  plan.wavelength = 30;
  plan.gain = 0.5;
  Field field = noisy(plan, {west, 0, side, side}, 1, Rng(9), any_job());
  return field;
}

Field rough(std::int32_t side) {
  return field_from(side, side, [](int x, int z) {
    return Rng(3).at(static_cast<std::uint64_t>(x)).at(static_cast<std::uint64_t>(z)).below(1000) / 100.0;
  });
}

/// All samples are covered once: areas add up, and no triangle is turned over.
void expect_cover(const Field& field, const Triangulation& mesh) {
  std::int64_t area = 0;
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return grid_point_of(mesh.samples[mesh.index[i + k]], field.width);
    };
    const std::int64_t own = doubled_area(at(0), at(1), at(2));
    ASSERT_GT(own, 0);
    area += own;
  }
  EXPECT_EQ(area, std::int64_t{2} * (field.width - 1) * (field.depth - 1));
}

TEST(ReducedMesh, OfAPlaneHasTwoTriangles) {
  const Field field = field_from(1025, 1025, [](int x, int z) { return 0.25 * x - 0.5 * z + 3; });
  for (const auto& [name, reduce] : reducers) {
    Job job = any_job();
    EXPECT_EQ(reduce(field, 1e-3, Border::by_error, job).index.size(), 6U) << name;
  }
}

TEST(ReducedMesh, OfARidgeHasSixTriangles) {
  const Field field = field_from(129, 129, [](int x, int) { return std::abs(x - 64); });
  Job job = any_job();
  EXPECT_EQ(rtin(field, 0.1, Border::by_error, job).index.size() / 3, 6U);
  EXPECT_LE(greedy(field, 0.1, Border::by_error, job).index.size() / 3, 6U);
}

/// No corner of a triangle lies within a side of another: sides inside are sides of two triangles, in
/// opposite directions.
TEST(ReducedMesh, HasNoCornerWithinASide) {
  for (const auto& [name, reduce] : reducers) {
    for (const std::int32_t side : {2, 3, 9, 129}) {
      for (const double error : {0.0, 0.3, 4.0}) {
        const Field field = rough(side);
        Job job = any_job();
        const Triangulation mesh = reduce(field, error, Border::by_error, job);
        std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
        for (std::size_t i = 0; i < mesh.index.size(); ++i) {
          const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
          EXPECT_TRUE(sides.insert({mesh.index[i], mesh.index[next]}).second) << name;
        }
        const auto on_border = [&](std::uint32_t vertex) {
          const GridPoint at = grid_point_of(mesh.samples[vertex], side);
          return at.x == 0 || at.z == 0 || at.x == side - 1 || at.z == side - 1;
        };
        for (const auto& [from, to] : sides) {
          const bool within = on_border(from) && on_border(to);
          EXPECT_TRUE(within || sides.count({to, from}) == 1) << name << " of " << side << " at " << error;
        }
      }
    }
  }
}

TEST(ReducedMesh, KeepsItsBoundAtEverySample) {
  const std::function<Field()> fields[] = {
      [] { return hills(129); }, [] { return rough(65); },
      [] { return field_from(65, 65, [](int x, int z) { return x == 20 && z == 33 ? 50 : 0; }); }};
  for (const auto& [name, reduce] : reducers) {
    for (const auto& make : fields) {
      const Field field = make();
      for (const double error : {0.0, 0.01, 0.3, 4.0}) {
        for (const Border border : {Border::by_error, Border::whole}) {
          Job job = any_job();
          const Triangulation mesh = reduce(field, error, border, job);
          expect_cover(field, mesh);
          EXPECT_LE(measured_error(field, mesh, job), error + 1e-5) << name << " at " << error;
        }
      }
    }
  }
}

TEST(ReducedMesh, GetsSmallerWithAGreaterError) {
  const Field field = hills(257);
  for (const auto& [name, reduce] : reducers) {
    std::size_t last = field.heights.size() * 6 + 1;
    for (const double error : {0.01, 0.1, 0.5, 2.0}) {
      Job job = any_job();
      const std::size_t size = reduce(field, error, Border::by_error, job).index.size();
      EXPECT_LT(size, last) << name << " at " << error;
      last = size;
    }
  }
}

TEST(ReducedMesh, IsSmallerByTheGreedyMethod) {
  const Field field = hills(257);
  Job job = any_job();
  EXPECT_LT(greedy(field, 0.3, Border::by_error, job).index.size(),
            rtin(field, 0.3, Border::by_error, job).index.size());
}

TEST(ReducedMesh, SharesItsBorderWithTheNeighbour) {
  const Field west = hills(129), east = hills(129, 128);
  for (const auto& reducer : reducers) {
    const char* name = reducer.first;
    const Reducer reduce = reducer.second;
    Job job = any_job();
    const auto column = [&](const Field& field, std::uint32_t x, double error) {
      const Triangulation mesh = reduce(field, error, Border::whole, job);
      std::set<std::uint32_t> rows;
      for (const std::uint32_t sample : mesh.samples) {
        if (sample % 129 == x) rows.insert(sample / 129);
      }
      return rows;
    };
    EXPECT_EQ(column(west, 128, 0.5), column(east, 0, 0.5)) << name;
  }
}

TEST(ReducedMesh, SupportsFieldsOfAnyShapeByTheGreedyMethod) {
  const Field field = field_from(37, 90, [](int x, int z) { return (x * z) % 17 + 0.1 * x; });
  Job job = any_job();
  const Triangulation mesh = greedy(field, 1, Border::by_error, job);
  expect_cover(field, mesh);
  EXPECT_LE(measured_error(field, mesh, job), 1.0);
}

TEST(ReducedMesh, IsTheSameWithAnyNumberOfThreads) {
  const Field field = hills(257);
  for (const auto& [name, reduce] : reducers) {
    Job one = any_job(1), eight = any_job(8);
    const Triangulation a = reduce(field, 0.2, Border::by_error, one),
                        b = reduce(field, 0.2, Border::by_error, eight);
    EXPECT_TRUE(std::ranges::equal(a.index, b.index)) << name;
    EXPECT_TRUE(std::ranges::equal(a.samples, b.samples)) << name;
  }
}

TEST(ReducedMesh, SpendsItsTriangles) {
  Job::Options options;
  options.limits.triangles = 5'000;
  for (const auto& [name, reduce] : reducers) {
    Job job(1, options);
    EXPECT_THROW((void)reduce(rough(129), 0.01, Border::by_error, job), Stop) << name;
  }
}

TEST(Scan, VisitsEverySampleOfATriangleOnce) {
  Rng rng(8);
  for (int i = 0; i < 2000; ++i) {
    const auto place = [&] {
      return GridPoint{static_cast<std::int32_t>(rng.below(40)), static_cast<std::int32_t>(rng.below(40))};
    };
    GridPoint a = place(), b = place(), c = place();
    if (doubled_area(a, b, c) < 0) std::swap(b, c);
    if (doubled_area(a, b, c) == 0) continue;
    std::multiset<std::pair<int, int>> seen, expected;
    each_row_inside(a, b, c, [&](std::int32_t z, std::int32_t first, std::int32_t last) {
      for (std::int32_t x = first; x <= last; ++x) seen.insert({x, z});
    });
    for (std::int32_t z = 0; z < 40; ++z) {
      for (std::int32_t x = 0; x < 40; ++x) {
        const GridPoint p{x, z};
        if (doubled_area(a, b, p) >= 0 && doubled_area(b, c, p) >= 0 && doubled_area(c, a, p) >= 0)
          expected.insert({x, z});
      }
    }
    ASSERT_EQ(seen, expected);
  }
}

/// IssueList of a mesh as it goes out.
std::vector<std::string> defects_of(Mesh mesh) {
  Model model;
  model.nodes.emplace_back();
  model.nodes[0].mesh = 0;
  model.materials.emplace_back();
  model.meshes.emplace_back();
  model.meshes[0].primitives.push_back({std::move(mesh), 0, {}});
  Job job = any_job();
  finish(model, job);
  return faults(model);
}

TEST(Surface, IsSoundOnGentleAndOnRoughGround) {
  const Array<glm::u8vec4> plain;
  for (const Field& field : {hills(65), rough(65)}) {
    Job job = any_job();
    EXPECT_EQ(defects_of(grid_mesh(field, {0, 0, 65, 65}, plain, {}, job)), std::vector<std::string>{});
    EXPECT_EQ(defects_of(grid_mesh(field, {0, 0, 65, 65}, plain, Shading::upright, job)),
              std::vector<std::string>{});
    for (const auto& [name, reduce] : reducers) {
      EXPECT_EQ(defects_of(reduced_mesh(field, reduce(field, 0.4, Border::by_error, job), {}, {}, job)),
                std::vector<std::string>{})
          << name;
    }
  }
}

TEST(Surface, IsClosedByWallsAndAFloor) {
  const Field field = hills(33);
  const Array<glm::u8vec4> plain;
  Job job = any_job();
  const Range range = range_of(field, job);
  const WallPlan plan{.closed = true, .floor = range.low - 2};
  Triangulation coarse = greedy(field, 0.5, Border::by_error, job);
  Array<std::uint32_t> border(job);
  for (const std::uint32_t sample : coarse.samples) {
    const GridPoint at = grid_point_of(sample, 33);
    if (at.x == 0 || at.z == 0 || at.x == 32 || at.z == 32) border.push_back(sample);
  }
  const std::pair<Mesh, Mesh> solids[] = {
      {grid_mesh(field, {0, 0, 33, 33}, plain, {}, job), walls(field, border_samples(field, job), plan, job)},
      {reduced_mesh(field, std::move(coarse), {}, {}, job), walls(field, border, plan, job)}};
  double mean = 0;
  for (const float h : field.heights)
    mean += static_cast<double>(h) / static_cast<double>(field.heights.size());
  for (const auto& [top, sides] : solids) {
    const MeshMeasures measures = measure({&top, &sides});
    EXPECT_EQ(measures.open_edges, 0U);
    EXPECT_EQ(measures.over_used_edges, 0U);
    EXPECT_EQ(measures.inconsistent_edges, 0U);
    EXPECT_EQ(measures.flipped_corners, 0U);
    EXPECT_NEAR(measures.volume, 32 * 32 * (mean - static_cast<double>(plan.floor)), 0.05 * measures.volume);
  }
}

TEST(Surface, IsTheSameOnBothSidesOfABorderBetweenTiles) {
  // With a margin of one sample, normals at a shared border are made from the same heights.
  const auto tile = [](std::int64_t west) {
    NoisePlan plan;
    plan.amplitude = 10;
    plan.wavelength = 30;
    Field field = noisy(plan, {west - 1, -1, 67, 67}, 1, Rng(9), any_job());
    field.margin = 1;
    field.width = field.depth = 65;
    return field;
  };
  const Field west = tile(0), east = tile(64);
  const Array<glm::u8vec4> plain;
  Job job = any_job();
  const Mesh a = grid_mesh(west, {0, 0, 65, 65}, plain, {}, job);
  const Mesh b = grid_mesh(east, {0, 0, 65, 65}, plain, {}, job);
  for (std::size_t z = 0; z < 65; ++z) {
    EXPECT_EQ(a.position[z * 65 + 64].y, b.position[z * 65].y);
    EXPECT_EQ(a.normal[z * 65 + 64], b.normal[z * 65]);
    EXPECT_FLOAT_EQ(a.position[z * 65 + 64].x, -b.position[z * 65].x);
  }
}

}  // namespace
}  // namespace seedmesh::terrain
