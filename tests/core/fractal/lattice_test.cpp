/// Copy machines on a lattice: counts against closed forms and figures known from elsewhere.
#include "core/generators/fractal/lattice.h"

#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "core/generators/fractal/faces.h"
#include "core/generators/fractal/measure.h"
#include "core/generators/fractal/merged.h"
#include "core/generators/fractal/topology.h"
#include "tests/core/fractal/support.h"

namespace seedmesh::fractal {
namespace {

Lattice named(const std::string& name) {
  const auto lattice = lattice_of(instructions_of(fractal_params(R"({"instructions": ")" + name + R"("})")));
  EXPECT_TRUE(lattice) << name;
  return lattice.value_or(Lattice{});
}

Job plain_job() { return Job(0, Job::Options{}); }

TEST(Lattice, ExposesTheSquaresOfTheClosedFormOfTheSponge) {
  const Job job = plain_job();
  double twenties = 1, eights = 1;
  for (int rounds = 0; rounds <= 4; ++rounds) {
    const double expected = 2 * twenties + 4 * eights;
    EXPECT_EQ(exposed_quads(named("menger_sponge"), rounds), expected) << rounds;
    EXPECT_EQ(static_cast<double>(count_exposed(solid_of(named("menger_sponge"), rounds, job), job)),
              expected);
    twenties *= 20;
    eights *= 8;
  }
}

TEST(Lattice, CountsEveryNamedLatticeEquallyByCellsAndByFormula) {
  const Job job = plain_job();
  for (const char* name : {"menger_sponge", "koch_cube", "corner_cube", "corner_cube_centre", "vicsek",
                           "mosely_snowflake", "cantor_dust"}) {
    for (int rounds = 0; rounds <= 3; ++rounds) {
      const Solid solid = solid_of(named(name), rounds, job);
      const SolidTopology topology = topology_of(solid.by_x, job);
      EXPECT_EQ(exposed_quads(named(name), rounds), static_cast<double>(topology.squares)) << name << rounds;
      EXPECT_EQ(count_exposed(solid, job), topology.squares) << name << rounds;
      EXPECT_EQ(topology.cells, solid.by_z.count()) << name << rounds;
    }
  }
}

TEST(Topology, ComputesTheGenusOfTheSponge) {
  const Job job = plain_job();
  const std::uint64_t genus[] = {0, 5, 81, 1409};
  for (int rounds = 0; rounds < 4; ++rounds) {
    const SolidTopology topology = topology_of(grid_of(named("menger_sponge"), rounds, {0, 1, 2}, job), job);
    EXPECT_EQ(topology.genus(), genus[rounds]) << rounds;
    EXPECT_EQ(topology.surfaces, 1U);
  }
}

TEST(Topology, FindsWhereTheKochCubeIsNotManifold) {
  const Job job = plain_job();
  const std::uint64_t edges[] = {0, 24, 312, 3768};
  for (int rounds = 0; rounds < 4; ++rounds) {
    const SolidTopology topology = topology_of(grid_of(named("koch_cube"), rounds, {0, 1, 2}, job), job);
    EXPECT_EQ(topology.four_face_edges, edges[rounds]) << rounds;
    EXPECT_EQ(topology.genus().has_value(), rounds == 0);
  }
}

TEST(Topology, CountsCavitiesAsSurfaces) {
  const Job job = plain_job();
  BitGrid grid(job, glm::ivec3(0), {3, 3, 3});
  grid.fill_block(glm::ivec3(0), glm::ivec3(3));
  grid.row(1, 1)[0] &= ~std::uint64_t{2};
  const SolidTopology topology = topology_of(grid, job);
  EXPECT_EQ(topology.surfaces, 2U);
  EXPECT_EQ(topology.genus(), 0U);
  EXPECT_EQ(topology.squares, 60U);
}

TEST(Lattice, IsRecognisedInMapsUnlessTheyTurnOrDiffer) {
  const auto lattice = [](const char* maps) {
    return lattice_of(instructions_of(fractal_params(std::string(R"({"instructions": )") + maps + "}")));
  };
  EXPECT_TRUE(lattice(R"([{"scale": 0.25, "translate": [0.375, 0.375, -0.125]}])"));
  EXPECT_TRUE(lattice(R"([{"scale": 0.5, "translate": [3, 0, 0]}, {"scale": 0.5, "translate": [0, 0, 0]}])"));
  EXPECT_FALSE(lattice(R"([{"scale": 0.5, "rotate": [0, 0, 45]}])"));
  EXPECT_FALSE(lattice(R"([{"scale": 0.4}])"));
  EXPECT_FALSE(lattice(R"([{"scale": 0.5}, {"scale": 0.25}])"));
  EXPECT_FALSE(lattice(R"([{"scale": 0.5}, {"scale": 0.5, "translate": [0.1, 0, 0]}])"));
  EXPECT_EQ(named("sierpinski_triangle").block, glm::ivec3(2, 1, 1));
}

TEST(Lattice, IncludesCopiesBetweenOthers) {
  const Job job = plain_job();
  const BitGrid grid = grid_of(named("sierpinski_triangle"), 5, {0, 1, 2}, job);
  EXPECT_EQ(grid.count(), 2U * 243U);
  const Result<Model> model = fractal_of(R"({"instructions": "sierpinski_triangle", "iterations": 5})");
  ASSERT_TRUE(model);
  EXPECT_NEAR(seedmesh::measure({&only_mesh(*model)}).volume, std::pow(3.0 / 8, 5), 1e-6);
}

TEST(Lattice, PutsCellsAtThePositionsOfTheirMaps) {
  const Job job = plain_job();
  const FractalParams params = fractal_params(
      R"({"instructions": [{"scale": 0.5, "translate": [1.1, 0, 0]}, {"scale": 0.5, "translate": [-0.4, 0.5, 0]}]})");
  const Instructions instructions = instructions_of(params);
  const auto lattice = lattice_of(instructions);
  ASSERT_TRUE(lattice);
  const BitGrid grid = grid_of(*lattice, 2, {0, 1, 2}, job);
  const Placement placement = placement_of(*lattice, 2);
  EXPECT_EQ(grid.count(), 4U);
  for (const Affine& outer : instructions.maps) {
    for (const Affine& inner : instructions.maps) {
      const glm::dvec3 cell = (compose(outer, inner).offset - placement.origin) / placement.cell;
      const glm::ivec3 at = glm::ivec3(glm::floor(cell)) - grid.low();
      EXPECT_TRUE(grid.at(at.x, at.y, at.z));
    }
  }
}

TEST(Faces, MakeAClosedSoundSponge) {
  const Result<Model> model = fractal_of("{}");
  ASSERT_TRUE(model);
  EXPECT_THAT(faults(*model), testing::IsEmpty());
  const MeshMeasures measures = seedmesh::measure({&only_mesh(*model)});
  EXPECT_EQ(measures.triangles, 2U * 18048U);
  EXPECT_EQ(measures.open_edges, 0U);
  EXPECT_NEAR(measures.volume, std::pow(20.0 / 27, 3), 1e-5);
  EXPECT_NEAR(measures.area, 24.7572016, 1e-4);
}

TEST(Faces, KeepABlockThatIsOutsideOfAllCopies) {
  const Result<Model> model =
      fractal_of(R"({"instructions": "corner_cube_outside", "iterations": 1, "size": 3})");
  ASSERT_TRUE(model);
  const MeshMeasures measures = seedmesh::measure({&only_mesh(*model)});
  EXPECT_NEAR(measures.volume, 27 + 24, 1e-4);
  EXPECT_EQ(measures.open_edges, 0U);
}

TEST(Faces, HaveTheColoursOfTheRainbowCube) {
  const Result<Model> model = fractal_of(R"({"element": "rainbow_cube", "iterations": 1})");
  ASSERT_TRUE(model);
  const Mesh& mesh = only_mesh(*model);
  std::map<std::tuple<float, float, float>, std::set<int>> colors;
  for (std::size_t i = 0; i < mesh.position.size(); ++i)
    colors[{mesh.normal[i].x, mesh.normal[i].y, mesh.normal[i].z}].insert(
        mesh.color[i].x * 65536 + mesh.color[i].y * 256 + mesh.color[i].z);
  ASSERT_EQ(colors.size(), 6U);
  for (const auto& [normal, seen] : colors) EXPECT_EQ(seen.size(), 1U);
}

TEST(Faces, AreTheSameWithAnyNumberOfThreads) {
  const Result<Model> one = fractal_of("{}", 0, {.threads = 1}), eight = fractal_of("{}", 0, {.threads = 8});
  ASSERT_TRUE(one && eight);
  const Mesh &a = only_mesh(*one), &b = only_mesh(*eight);
  ASSERT_EQ(a.position.bytes(), b.position.bytes());
  EXPECT_EQ(std::memcmp(a.position.data(), b.position.data(), a.position.bytes()), 0);
  ASSERT_EQ(a.index.small.bytes(), b.index.small.bytes());
  EXPECT_EQ(std::memcmp(a.index.small.data(), b.index.small.data(), a.index.small.bytes()), 0);
}

/// The mesh whose squares are joined, beside the one of all squares.
struct Joined {
  MeshMeasures squares, rectangles;
};
Joined joined(const std::string& name, int rounds) {
  Job job = plain_job();
  const Solid solid = solid_of(named(name), rounds, job);
  const Mesh squares = exposed_faces(solid, nullptr, job), rectangles = merged_faces(solid, nullptr, job);
  return {seedmesh::measure({&squares}), seedmesh::measure({&rectangles})};
}

TEST(Merged, IsTheSameSurfaceWithFewerTriangles) {
  for (const char* name : {"menger_sponge", "koch_cube", "corner_cube", "corner_cube_outside", "vicsek",
                           "mosely_snowflake", "sierpinski_triangle"}) {
    const Joined at = joined(name, 3);
    EXPECT_LE(at.rectangles.triangles, at.squares.triangles) << name;
    EXPECT_NEAR(at.rectangles.area, at.squares.area, 1e-5 * at.squares.area) << name;
    EXPECT_NEAR(at.rectangles.volume, at.squares.volume, 1e-5 * at.squares.volume) << name;
  }
  const Joined sponge = joined("menger_sponge", 3);
  EXPECT_LT(sponge.rectangles.triangles, sponge.squares.triangles * 3 / 4);
}

TEST(Merged, LeavesNoGapAndNoCornerWithinAnEdge) {
  for (const char* name : {"menger_sponge", "koch_cube", "mosely_snowflake", "corner_cube_outside"}) {
    const MeshMeasures mesh = joined(name, 3).rectangles, squares = joined(name, 3).squares;
    EXPECT_EQ(mesh.open_edges, 0U) << name;
    EXPECT_EQ(mesh.zero_area, 0U) << name;
    EXPECT_EQ(mesh.flipped_corners, 0U) << name;
    EXPECT_EQ(mesh.unused, 0U) << name;
    EXPECT_EQ(mesh.over_used_edges > 0, squares.over_used_edges > 0) << name;
  }
}

TEST(Merged, MakesOneRectangleOfAPlainSide) {
  Job job = plain_job();
  const Lattice block = *lattice_of(instructions_of(fractal_params(
      R"({"instructions": [{"scale": 0.5, "translate": [0.25, 0.25, 0.25]}, {"scale": 0.5, "translate": [-0.25, 0.25, 0.25]}]})")));
  EXPECT_EQ(merged_faces(solid_of(block, 1, job), nullptr, job).index.size(), 36U);
}

TEST(Merged, IsTheSameOnAnyNumberOfThreads) {
  const char* request = R"({"iterations": 3, "surface": "merged", "element": "rainbow_cube"})";
  const Result<Model> one = fractal_of(request), eight = fractal_of(request, 0, {.threads = 8});
  ASSERT_TRUE(one && eight);
  const Mesh &a = only_mesh(*one), &b = only_mesh(*eight);
  EXPECT_TRUE(std::equal(a.position.begin(), a.position.end(), b.position.begin(), b.position.end()));
  EXPECT_THAT(faults(*one), testing::IsEmpty());
}

TEST(Merged, WorksWhereTheSquaresWouldExceedTheLimit) {
  Job::Options options;
  options.limits.triangles = 26'000;
  EXPECT_THAT(refusal(R"({"iterations": 3})", options), testing::StartsWith("/iterations: needs 36096"));
  EXPECT_EQ(refusal(R"({"iterations": 3, "surface": "merged"})", options), "");
  EXPECT_THAT(refusal(R"({"iterations": 4, "surface": "merged"})", options), testing::HasSubstr("26000"));
}

}  // namespace
}  // namespace seedmesh::fractal
