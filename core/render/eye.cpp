#include "core/render/eye.h"

#include <algorithm>
#include <limits>

#include "core/base/parallel.h"

namespace seedmesh::render {

Scene scene_of(const Model& model, const Items& items, const Surfaces& surfaces) {
  Scene scene{model, items, surfaces, {}, {}};
  for (const MeshGroup& group : model.meshes) scene.boxes.push_back(box_of(group));
  return scene;
}

void project(Scene& scene, const Eye& eye, const Job& job) {
  constexpr std::size_t most_vertices = 2'000'000, chunk = 16'384;
  std::size_t vertices = 0;
  for (const Item& item : scene.items.list) {
    for (const Primitive& each : scene.model.meshes[item.group].primitives)
      vertices += each.mesh.position.size();
  }
  if (vertices > most_vertices) return;
  for (const Item& item : scene.items.list) {
    for (const Primitive& each : scene.model.meshes[item.group].primitives) {
      const Mesh& mesh = each.mesh;
      Array<Projected> seen(job, mesh.position.size());
      parallel_for(job, seen.size(), chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        job.check();
        for (std::size_t i = begin; i < end; ++i) seen[i] = projected(eye, item, mesh, i);
      });
      scene.seen.push_back(std::move(seen));
    }
  }
}

bool touches(const Scene& scene, const Item& item, const Eye& eye, const texture::ScanWindow& rows) {
  std::int64_t top = std::numeric_limits<std::int64_t>::max(),
               bottom = std::numeric_limits<std::int64_t>::min();
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(glm::vec3(item.at * glm::vec4(corner_of(scene.boxes[item.group], corner), 1)));
    const std::int64_t y = eye(p).point.y;
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
  constexpr std::int64_t edge = 2 * texture::fixed_one;
  return bottom + edge >= rows.y0 * texture::fixed_one && top - edge <= rows.y1 * texture::fixed_one;
}

}  // namespace seedmesh::render
