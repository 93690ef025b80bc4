#include "core/generators/building/estimate.h"

#include <array>
#include <map>

#include "core/base/math.h"
#include "core/generators/building/bodies.h"

namespace seedmesh::building {
namespace {

constexpr std::size_t most_part_sizes = 500;
// Of a GLB: position and normal of a vertex, an index of 16 bits, JSON of a node and of a mesh, and the rest.
constexpr std::uint64_t vertex_bytes = 24, index_bytes = 2, node_bytes = 110, mesh_bytes = 330,
                        file_bytes = 900;

/// What one body has.
struct BodyCost {
  std::uint64_t triangles = 0, vertices = 0, primitives = 1;
  std::uint64_t bytes() const { return vertices * vertex_bytes + triangles * 3 * index_bytes; }
};

}  // namespace

std::optional<Estimate> estimate_of(const Shapes& shapes, CopyForm copies, bool shares_all, Job& job) {
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::array<std::int64_t, 3>>;
  std::map<Key, BodyCost> costs;
  std::size_t parts = 0;
  std::uint64_t triangles = 0, own = 0, bodies = 0, draws = 0;
  for (const Shape& shape : shapes.shapes) {
    if (!shape.is_active || dimension(shape.size) < 2) continue;
    const bool is_part = (shape.geometry & asset_bit) != 0;
    const std::uint32_t options = is_part ? shapes.styles[shape.style].options : 0;
    const Key key{shape.geometry,
                  options,
                  is_part ? 0U : shape.style,
                  {math::to_int64(shape.size.x * 1e6 + 0.5), math::to_int64(shape.size.y * 1e6 + 0.5),
                   math::to_int64(shape.size.z * 1e6 + 0.5)}};
    const auto [found, is_new] = costs.try_emplace(key);
    BodyCost& cost = found->second;
    if (is_new && is_part) {
      const PartRow* const row = part_named(shapes.asset_names[shape.geometry & ~asset_bit]);
      if (row == nullptr || ++parts > most_part_sizes || dimension(shape.size) < 3) return std::nullopt;
      cost.primitives = 0;
      for (const PartPiece& piece : make_part(*row, shape.size, shapes.part_options[options], job)) {
        cost.triangles += piece.mesh.elements();
        cost.vertices += piece.mesh.position.size();
        ++cost.primitives;
      }
    } else if (is_new && shape.geometry == box_geometry) {
      const std::uint64_t sides = dimension(shape.size) == 3 ? 6 : 1;
      cost = {2 * sides, 4 * sides, 1};
    } else if (is_new) {
      // A polygon of n corners with h holes has n + 2 h - 2 triangles.
      for (const Face& face : shapes.solid_of(shape.geometry).faces) {
        std::uint64_t corners = 0;
        for (std::uint32_t l = 0; l < face.loop_count; ++l)
          corners += shapes.solid_of(shape.geometry).loops[face.first_loop + l].count;
        cost.triangles += corners + 2 * (face.loop_count - 1) - 2;
        cost.vertices += corners;
      }
    }
    if (is_new) own += cost.bytes() + mesh_bytes * cost.primitives;
    triangles += cost.triangles;
    draws += cost.primitives;
    bodies += cost.bytes();
    if ((draws & 4095U) == 0) job.check();
  }
  Estimate estimate;
  estimate.triangles = triangles;
  const bool is_merged = copies == CopyForm::merge || (!shares_all && draws > most_nodes);
  estimate.bytes = file_bytes + (is_merged ? bodies : own + node_bytes * draws);
  return estimate;
}

}  // namespace seedmesh::building
