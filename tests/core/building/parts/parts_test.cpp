#include "core/generators/building/parts/parts.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "core/base/rng.h"
#include "tests/support/mesh_faults.h"
#include "tests/support/narrow.h"

namespace seedmesh::building {
namespace {

using testing::IsEmpty;

Job job_of() { return Job(1, Job::Options{}); }

Model model_of(std::vector<PartPiece> pieces) {
  Model model;
  MeshGroup group;
  group.name = "part";
  for (PartPiece& piece : pieces) {
    narrow(piece.mesh, job_of());
    group.primitives.push_back({std::move(piece.mesh), -1, {}});
  }
  model.meshes.push_back(std::move(group));
  return model;
}

MeshMeasures measure_of(const Model& model) {
  std::vector<const Mesh*> meshes;
  for (const Primitive& primitive : model.meshes[0].primitives) meshes.push_back(&primitive.mesh);
  return measure(meshes);
}

/// Closed, without a fault (but for the order of triangles, which finish() sets), and as large as asked.
void expect_sound(const PartRow& row, const glm::dvec3& size, const PartOptions& options) {
  Job job = job_of();
  const Model model = model_of(make_part(row, size, options, job));
  const std::string place = std::string(row.name) + " " + std::to_string(size.x) + " " +
                            std::to_string(size.y) + " " + std::to_string(size.z);
  for (const std::string& fault : faults(model))
    EXPECT_THAT(fault, testing::HasSubstr("cache misses")) << place;
  const MeshMeasures m = measure_of(model);
  EXPECT_EQ(m.open_edges, 0U) << place;
  EXPECT_GT(m.volume, 0) << place;
  glm::dvec3 low(1e9), high(-1e9);
  for (const Primitive& primitive : model.meshes[0].primitives) {
    const Box box = bounds_of(primitive.mesh.position.span());
    low = glm::min(low, glm::dvec3(box.min));
    high = glm::max(high, glm::dvec3(box.max));
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(low[axis], 0, 1e-6 * size[axis]) << place;
    EXPECT_NEAR(high[axis], size[axis], 1e-6 * size[axis]) << place;
  }
  EXPECT_EQ(job.spent(Resource::triangles) >= m.triangles, true) << place;
}

TEST(Parts, AreNamedInOrderAndHaveMaterials) {
  std::set<std::string_view> roles;
  for (const PartMaterial& material : part_materials()) roles.insert(material.role);
  std::string_view before;
  for (const PartRow& row : part_rows()) {
    EXPECT_LT(before, row.name);
    before = row.name;
    EXPECT_EQ(part_named(row.name), &row);
    Job job = job_of();
    for (const PartPiece& piece : make_part(row, row.size, {}, job))
      EXPECT_EQ(roles.count(piece.role), 1U) << piece.role;
  }
  EXPECT_EQ(part_named("portcullis"), nullptr);
}

TEST(Parts, AreClosedAndFillTheirScope) {
  for (const PartRow& row : part_rows()) expect_sound(row, row.size, {});
}

TEST(Parts, AreSoundAtAnySizeAndOption) {
  Rng rng(8);
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Rng here = rng.at(seed);
    const PartRow& row = part_rows()[seed % part_rows().size()];
    glm::dvec3 size = row.size;
    for (int axis = 0; axis < 3; ++axis) size[axis] *= here.uniform(0.4, 3);
    PartOptions options;
    if (here.below(2)) options.count = 1 + static_cast<int>(here.below(12));
    if (here.below(2)) options.frame = here.uniform(0.01, 0.3);
    if (here.below(2)) options.angle = here.uniform(0.3, 1.2);
    options.room = static_cast<int>(here.below(4));
    expect_sound(row, size, options);
  }
}

TEST(Parts, AreClosedWhereTheirScopeIsAlmostFlat) {
  for (const PartRow& row : part_rows()) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double size : {0.1, 0.01}) {
        glm::dvec3 flat(1);
        flat[axis] = size;
        expect_sound(row, flat, {});
      }
    }
  }
}

TEST(Parts, WindowHasAFrameAndGlassAndADoorAHandle) {
  Job job = job_of();
  std::set<std::string_view> window, door;
  for (const PartPiece& piece : make_part(*part_named("window"), {1, 1.4, 0.1}, {}, job))
    window.insert(piece.role);
  for (const PartPiece& piece : make_part(*part_named("door"), {1, 2, 0.2}, {}, job)) door.insert(piece.role);
  EXPECT_THAT(window, testing::ElementsAre("frame", "glass"));
  EXPECT_THAT(door, testing::ElementsAre("door", "frame", "metal"));
}

TEST(Parts, WindowsShowOneRoomOfTheTextureEach) {
  std::set<std::pair<float, float>> corners;
  for (int room = 0; room < 16; ++room) {
    Job job = job_of();
    PartOptions options;
    options.room = room;
    for (const PartPiece& piece : make_part(*part_named("window"), {1, 1.4, 0.1}, options, job)) {
      if (!piece.role.starts_with("glass")) continue;
      // The outer face; the sides show a little of what lies beside the room.
      float front = 0;
      for (const glm::vec3& p : piece.mesh.position) front = std::max(front, p.z);
      glm::vec2 low(2), high(-2);
      for (std::size_t i = 0; i < piece.mesh.position.size(); ++i) {
        if (piece.mesh.position[i].z < front) continue;
        low = glm::min(low, piece.mesh.uv[0][i]);
        high = glm::max(high, piece.mesh.uv[0][i]);
      }
      EXPECT_NEAR(high.x - low.x, 0.25, 1e-6) << room;
      EXPECT_NEAR(high.y - low.y, 0.25, 1e-6) << room;
      corners.insert({low.x, low.y});
      const char* const role = room == 0 || (room >= 4 && room <= 10)  ? "glass"
                               : room == 2 || room == 13 || room == 14 ? "glass_shaded"
                                                                       : "glass_curtained";
      EXPECT_EQ(piece.role, role) << room;
    }
  }
  EXPECT_EQ(corners.size(), 16U);
}

TEST(Parts, StairsHaveTheRequestedNumberOfSteps) {
  Job job = job_of();
  PartOptions options;
  options.count = 7;
  const auto pieces = make_part(*part_named("stairs"), {1, 1, 2}, options, job);
  std::set<float> heights;
  for (const glm::vec3& p : pieces[0].mesh.position) heights.insert(p.y);
  EXPECT_EQ(heights.size(), 8U);
}

}  // namespace
}  // namespace seedmesh::building
