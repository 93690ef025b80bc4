#include "core/geom/plant/graft/ring_strip.h"

#include <cmath>

#include "core/base/wide.h"
#include "core/geom/mesh/vec3x4.h"

namespace seedmesh {
namespace {

float square_distance(const glm::vec3& one, const glm::vec3& other) {
  const Float4 between = Vec3x4::row(&one) - Vec3x4::row(&other);
  const Float4 squares = between * between;
  return squares[0] + squares[1] + squares[2];
}

}  // namespace

SEEDMESH_WIDE void write_strip(const RingCorners& below, const RingCorners& above, float most_lead,
                               const glm::vec3* position, std::uint32_t* out) {
  const RingCorner *a = below.data(), *b = above.data();
  const RingCorner *const last_a = a + below.size() - 1, *const last_b = b + above.size() - 1;
  for (; a < last_a || b < last_b; out += 3) {
    const RingCorner &next_a = a[a < last_a ? 1 : 0], &next_b = b[b < last_b ? 1 : 0];
    // Selected without a branch, which would be mispredicted.
    const float lead = 0.5F * ((a->angle + next_a.angle) - (b->angle + next_b.angle));
    const bool is_shorter = square_distance(position[next_a.vertex], position[b->vertex]) <
                            square_distance(position[a->vertex], position[next_b.vertex]);
    const bool is_behind = lead<0, is_far = std::abs(lead)> most_lead;
    const bool is_next = (is_far & is_behind) | (!is_far & is_shorter);
    const bool take_below = (b == last_b) | ((a < last_a) & is_next);
    out[0] = a->vertex;
    out[1] = take_below ? next_a.vertex : next_b.vertex;
    out[2] = b->vertex;
    a += take_below ? 1 : 0;
    b += take_below ? 0 : 1;
  }
}

void write_fan(const RingCorners& ring, std::uint32_t apex, bool is_below, std::uint32_t* out) {
  for (std::size_t i = 0; i + 1 < ring.size(); ++i, out += 3) {
    const std::uint32_t one = ring[i].vertex, next = ring[i + 1].vertex;
    out[0] = is_below ? apex : one;
    out[1] = next;
    out[2] = is_below ? one : apex;
  }
}

}  // namespace seedmesh
