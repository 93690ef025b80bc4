/// The ground is compressed before the rest of the scene is generated.
#include "core/gltf/write/write.h"
#include "tests/core/scene/support.h"
#include "tests/support/context.h"

namespace seedmesh {
namespace {

/// Writes the scene like the pipeline for the profile web, and counts the meshes that were compressed early.
std::string compressed_file_of(const Json& json, Demand demand, std::size_t& packed) {
  const Generator::Params params = read_scene_params(json);
  Job job = job_of(5, 2);
  Result<Model> model = scene::generate(own(params), context_of(job, demand));
  EXPECT_TRUE(model);
  packed = 0;
  for (const MeshGroup& group : model->meshes)
    for (const Primitive& each : group.primitives) packed += each.mesh.packed ? 1 : 0;
  finish(*model, job);
  ModelCounts counts = count(*model);
  WriteOptions options;
  options.dialect = {.compressed = true, .gpu_instances = true, .lods_inside = true};
  options.counts = &counts;
  return write(std::move(*model), options, job).text() + std::to_string(counts.triangles) + " " +
         std::to_string(counts.vertices);
}

TEST(PackedScene, GivesTheSameBytesWithItsGroundPackedAhead) {
  Json json = {{"layers",
                {{{"model", {{"preset", "willow"}}},
                  {"variants", 2},
                  {"place", {{"method", "scatter"}, {"count", 20}}}}}}};
  json["terrain"] = {{"generator", "terrain"},
                     {"parameters",
                      {{"algorithm", "fbm"},
                       {"resolution", 370},
                       {"size", 60},
                       {"amplitude", 6},
                       {"base", 1},
                       {"water_level", 0},
                       {"palette", "alpine"}}}};
  json["paths"] = {{{"points", {{-25, 0}, {25, 4}}}, {"width", 2}}};
  for (const int lods : {1, 3}) {
    std::size_t none = 0, some = 0;
    const std::string plain = compressed_file_of(json, {.lods = lods}, none);
    EXPECT_EQ(plain, compressed_file_of(json, {.lods = lods, .packs = true}, some));
    EXPECT_EQ(none, 0U);
    EXPECT_GE(some, 2U);  // the ground with its walls, water, path
  }
}

TEST(PackedScene, LevelsItsGroundUnderFoundationsFirst) {
  Json json = {{"terrain", {{"generator", "terrain"}, {"parameters", {{"iterations", 6}, {"size", 80}}}}},
               {"layers",
                {{{"model", cube(4)},
                  {"footprint", 4},
                  {"foundation", {{"slope_width", 3}}},
                  {"place", {{"method", "scatter"}, {"count", 5}}}}}}};
  std::size_t none = 0, some = 0;
  const std::string plain = compressed_file_of(json, {}, none);
  EXPECT_EQ(plain, compressed_file_of(json, {.packs = true}, some));
  EXPECT_EQ(some, 1U);
  json["layers"][0].erase("foundation");
  EXPECT_NE(plain, compressed_file_of(json, {.packs = true}, some));
}

}  // namespace
}  // namespace seedmesh
