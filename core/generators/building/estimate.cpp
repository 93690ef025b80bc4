#include "core/generators/building/estimate.h"

#include <array>
#include <map>

#include "core/base/math.h"
#include "core/generators/building/bodies.h"
#include "core/generators/building/coplanar_rectangles.h"

namespace seedmesh::building {
namespace {

constexpr std::size_t most_part_sizes = 500;
// Bytes of a GLB: the JSON of a node, the JSON of a mesh, and the rest.
constexpr std::uint64_t node_bytes = 110, mesh_bytes = 330, file_bytes = 900;

/// A body and the number of its copies.
struct BodyCount {
  BodyCost cost;
  std::uint64_t count = 0, tangents = 0;  ///< vertices of one body with tangents
  bool is_part = false;
};

/// The additional triangles of rectangles with corners of neighbours on their edges.
std::uint64_t more_by_neighbours(const Shapes& shapes, Job& job) {
  std::vector<std::uint32_t> drawn;
  glm::dvec3 low(1e300), high(-1e300);
  for (std::uint32_t i = 0; i < shapes.shapes.size(); ++i) {
    const Shape& shape = shapes.shapes[i];
    if (!shape.is_active || dimension(shape.size) < 2) continue;
    drawn.push_back(i);
    low = glm::min(low, shape.origin);
    high = glm::max(high, shape.origin);
  }
  if (drawn.empty()) return 0;
  const CoplanarRectangles rectangles(shapes, drawn, glm::length(high - low), job);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) sum += rectangles.extra_triangles(i);
  return sum;
}

/// The bytes of a body in a file, where every mesh has texture coordinates.
std::uint64_t bytes_of(const BodyCost& cost, std::uint64_t tangents = 0) {
  return cost.bytes() + 8 * cost.vertices + 16 * tangents;
}

}  // namespace

std::optional<Estimate> estimate_of(const Shapes& shapes, MaterialTable& materials,
                                    const EstimateOptions& options, Job& job) {
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::array<std::int64_t, 3>>;
  std::map<Key, BodyCount> bodies;
  std::size_t parts = 0;
  std::uint64_t seen = 0;
  const auto needs_tangents = [&](int material) {
    return options.tangents && materials.has_normal_map(material);
  };
  for (const Shape& shape : shapes.shapes) {
    if (!shape.is_active || dimension(shape.size) < 2) continue;
    const bool is_part = (shape.geometry & asset_bit) != 0;
    const std::uint32_t part_options = is_part ? shapes.styles[shape.style].options : 0;
    const Key key{shape.geometry,
                  part_options,
                  is_part ? 0U : shape.style,
                  {math::to_int64(shape.size.x * 1e6 + 0.5), math::to_int64(shape.size.y * 1e6 + 0.5),
                   math::to_int64(shape.size.z * 1e6 + 0.5)}};
    const auto [found, is_new] = bodies.try_emplace(key);
    BodyCost& cost = found->second.cost;
    if (is_new && is_part) {
      const PartRow* const row = part_named(shapes.asset_names[shape.geometry & ~asset_bit]);
      if (row == nullptr || ++parts > most_part_sizes || dimension(shape.size) < 3) return std::nullopt;
      cost.primitives = 0;
      for (const PartPiece& piece : make_part(*row, shape.size, shapes.part_options[part_options], job)) {
        cost.triangles += piece.mesh.elements();
        cost.vertices += piece.mesh.position.size();
        ++cost.primitives;
        if (needs_tangents(materials.material_of_part(piece.role, shapes.styles[shape.style])))
          found->second.tangents += piece.mesh.position.size();
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
    if (is_new && !is_part && needs_tangents(materials.material_of(shape)))
      found->second.tangents = cost.vertices;
    found->second.is_part = is_part;
    ++found->second.count;
    if ((++seen & 4095U) == 0) job.check();
  }
  Estimate estimate;
  estimate.bytes = file_bytes;
  if (!options.shares_all) {
    const BodyCost more{more_by_neighbours(shapes, job), 0};
    estimate.triangles = more.triangles;
    estimate.bytes += bytes_of(more);
  }
  for (const auto& each : bodies) {
    const auto& [cost, count, tangents, is_own_part] = each.second;
    estimate.triangles += cost.triangles * count;
    const bool is_shared = options.shares_all ||
                           (options.copies != CopyForm::merge && is_own_part && cost.saves_if_shared(count));
    const std::uint64_t bytes = bytes_of(cost, tangents);
    estimate.bytes += is_shared ? bytes + mesh_bytes * cost.primitives + node_bytes * count : bytes * count;
  }
  return estimate;
}

}  // namespace seedmesh::building
