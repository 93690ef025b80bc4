/// Footprints with holes as closed solids.
#include <gmock/gmock.h>

#include <cmath>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "tests/core/building/rules.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::building {
namespace {

using Ring = std::vector<std::array<double, 2>>;

BuildingParams on(std::vector<Ring> footprint, std::string rules) {
  BuildingParams params = with(std::move(rules));
  params.footprint = std::move(footprint);
  return params;
}

MeshMeasures measured(const BuildingParams& params) {
  const Model model = model_of(params);
  std::vector<const Mesh*> meshes;
  for (const MeshGroup& group : model.meshes) {
    for (const Primitive& primitive : group.primitives) meshes.push_back(&primitive.mesh);
  }
  return measure(meshes);
}

double area_of(const std::vector<Ring>& rings) {
  double area = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    double twice = 0;
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const auto &a = rings[r][i], &b = rings[r][(i + 1) % rings[r].size()];
      twice += a[0] * b[1] - a[1] * b[0];
    }
    area += (r == 0 ? 0.5 : -0.5) * std::abs(twice);
  }
  return area;
}

TEST(Footprint, IsClosedWithTwoThinHoles) {
  const BuildingParams params =
      on({{{36.842, -111.542}, {-65.34, 112.511}, {-64.57, -231.103}, {21.216, -133.046}},
          {{-40.093, -72.297}, {-37.799, -68.468}, {-33.555, -71.269}, {-35.908, -74.869}},
          {{-34.708, -63.605}, {-12.309, -35.775}, {-25.343, -52.325}, {-30.634, -66.445}}},
         "Lot --> extrude(9) A.");
  const MeshMeasures measures = measured(params);
  EXPECT_EQ(measures.open_edges, 0U);
  // Two caps of n + 2 h - 2 = 14 triangles each, and two triangles on each of 12 walls.
  EXPECT_EQ(measures.triangles, 52U);
}

TEST(Footprint, IsClosedWithManyRandomHoles) {
  const Rng rng(5);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng here = rng.at(seed);
    const std::uint32_t columns = 1 + here.below(5), rows = 1 + here.below(4);
    const double width = 10.0 * columns, depth = 10.0 * rows;
    std::vector<Ring> rings{{{0, 0}, {width, 0}, {width, depth}, {0, depth}}};
    for (std::uint32_t cell = 0; cell < columns * rows; ++cell) {
      Ring& hole = rings.emplace_back();
      const std::uint32_t corners = 3 + here.below(4);
      for (std::uint32_t i = 0; i < corners; ++i) {
        const math::SinCos turn = math::sincos_degrees(360.0 * i / corners);
        const double radius = here.uniform(0.5, 4.5);
        hole.push_back({10.0 * (cell % columns) + 5 + radius * turn.cos,
                        10.0 * (cell / columns) + 5 + radius * turn.sin});
      }
    }
    const double expected = 7 * area_of(rings);
    const MeshMeasures measures = measured(on(rings, "Lot --> extrude(7) A."));
    EXPECT_EQ(measures.open_edges, 0U) << seed;
    EXPECT_NEAR(measures.volume, expected, 1e-4 * expected) << seed;
  }
}

}  // namespace
}  // namespace seedmesh::building
