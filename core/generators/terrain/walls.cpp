/// Walls, floors and water of a field; see surface.h.
#include <algorithm>
#include <array>

#include "core/generators/terrain/ground.h"
#include "core/generators/terrain/scan.h"
#include "core/generators/terrain/surface.h"
#include "core/model/empty_mesh.h"

namespace seedmesh::terrain {

Array<std::uint32_t> border_samples(const Field& field, const Job& job) {
  Array<std::uint32_t> all(job);
  const auto wide = static_cast<std::uint32_t>(field.width), deep = static_cast<std::uint32_t>(field.depth);
  all.reserve(std::size_t{2} * (wide + deep));
  for (std::uint32_t z = 0; z < deep; ++z) {
    for (std::uint32_t x = 0; x < wide; x += z == 0 || z == deep - 1 ? 1 : wide - 1)
      all.push_back(z * wide + x);
  }
  return all;
}

Mesh walls(const Field& field, const Array<std::uint32_t>& samples, const WallPlan& plan, Job& job) {
  const std::int32_t east = field.width - 1, south = field.depth - 1;
  struct Side {
    glm::vec3 outward;
    bool along_x, forward;  ///< direction of the border with the ground on its left, seen from above
    std::int32_t line;
  };
  // Counter-clockwise from above: along the south to the east, then north, then west, then south.
  const std::array<Side, 4> sides{{{{0, 0, 1}, true, true, south},
                                   {{1, 0, 0}, false, false, east},
                                   {{0, 0, -1}, true, false, 0},
                                   {{-1, 0, 0}, false, true, 0}}};
  const Ground ground(field);
  Mesh mesh = empty_mesh(job);
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t i : {a, b, c}) mesh.index.wide.push_back(i);
  };
  std::vector<glm::vec3> foot;
  for (const Side& side : sides) {
    std::vector<GridPoint> line;
    for (const std::uint32_t sample : samples) {
      const GridPoint at = grid_point_of(sample, field.width);
      if ((side.along_x ? at.z : at.x) == side.line) line.push_back(at);
    }
    std::sort(line.begin(), line.end(), [&](GridPoint a, GridPoint b) {
      const std::int32_t difference = side.along_x ? a.x - b.x : a.z - b.z;
      return side.forward ? difference < 0 : difference > 0;
    });
    job.spend(Resource::triangles, 2 * (line.size() - 1) + (plan.closed ? line.size() - 1 : 0));
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (const GridPoint at : line) {
      const glm::vec3 top(ground.x(at.x), field.at(at.x, at.z), ground.z(at.z));
      const float down = plan.closed ? plan.floor : top.y - static_cast<float>(plan.depth);
      mesh.position.push_back(top);
      mesh.position.push_back({top.x, down, top.z});
      mesh.normal.push_back(side.outward);
      mesh.normal.push_back(side.outward);
      if (!(at == line.back())) foot.push_back({top.x, down, top.z});
    }
    for (std::uint32_t i = 0; i + 1 < line.size(); ++i) {
      const std::uint32_t a = first + 2 * i;
      quad(a, a + 1, a + 2);
      quad(a + 2, a + 1, a + 3);
    }
  }
  if (plan.closed) {
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    const auto count = static_cast<std::uint32_t>(foot.size());
    for (const glm::vec3& at : foot) mesh.position.push_back(at);
    mesh.position.push_back({0, plan.floor, 0});
    for (std::uint32_t i = 0; i <= count; ++i) mesh.normal.push_back({0, -1, 0});
    for (std::uint32_t i = 0; i < count; ++i) quad(first + i, first + count, first + (i + 1) % count);
  }
  return mesh;
}

Mesh sheet(const Field& field, float level, Job& job) {
  job.spend(Resource::triangles, 2);
  const Ground ground(field);
  const std::int32_t east = field.width - 1, south = field.depth - 1;
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job, 4, glm::vec3(0, 1, 0));
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const GridPoint at :
       {GridPoint{0, 0}, GridPoint{0, south}, GridPoint{east, south}, GridPoint{east, 0}})
    mesh.position.push_back({ground.x(at.x), level, ground.z(at.z)});
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(i);
  return mesh;
}

}  // namespace seedmesh::terrain
