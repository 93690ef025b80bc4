/// Several flat shapes as one; see components.h.
#include <array>
#include <map>

#include "core/base/math.h"
#include "core/generators/building/components.h"
#include "core/generators/building/tags.h"

namespace seedmesh::building {

ShapeState merged_faces(Derivation& d, const ShapeState& state, std::span<const ShapeState> faces) {
  Solid all;
  const glm::dmat3 back = glm::transpose(d.out.axes[state.axes]);
  std::map<std::array<std::int64_t, 3>, std::uint32_t> points;  // corners that faces share are one point
  for (const ShapeState& face : faces) {
    const Solid& solid = flat_solid(d, face);
    for (const Face& each : solid.faces) {
      Face copy{static_cast<std::uint32_t>(all.loops.size()), each.loop_count, false};
      copy.tags = joined_tags(d, each.tags,
                              d.out.styles[face.style].tags == d.out.styles[state.style].tags
                                  ? 0
                                  : d.out.styles[face.style].tags);
      for (const Loop& loop : loops_of(solid, each)) {
        all.loops.push_back({static_cast<std::uint32_t>(all.corners.size()), loop.count});
        for (std::uint32_t i = 0; i < loop.count; ++i) {
          const glm::dvec3 p =
              back * (face.origin +
                      d.out.axes[face.axes] * (solid.points[solid.corners[loop.first + i]] * face.size) -
                      state.origin);
          const std::array<std::int64_t, 3> key = {math::to_int64(p.x * 1e7 + 0.5),
                                                   math::to_int64(p.y * 1e7 + 0.5),
                                                   math::to_int64(p.z * 1e7 + 0.5)};
          const auto [found, is_new] = points.try_emplace(key, static_cast<std::uint32_t>(all.points.size()));
          if (is_new) all.points.push_back(p);
          all.corners.push_back(found->second);
        }
      }
      all.faces.push_back(copy);
    }
  }
  glm::dvec3 low, extent;
  fit(all, low, extent);
  ShapeState out = state;
  out.origin = state.origin + d.out.axes[state.axes] * low;
  out.size = extent;
  out.geometry = add_solid(d, std::move(all));
  return out;
}

}  // namespace seedmesh::building
