#pragma once
/// Triangles between two rings, and between a ring and a point.
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace seedmesh {

/// A corner of a ring, by rising angle; the last corner of a ring is its first one again, a full turn later.
struct RingCorner {
  float angle = 0;
  std::uint32_t vertex = 0;
};
using RingCorners = std::vector<RingCorner>;

/// Returns the number of triangles between two rings.
inline std::size_t strip_triangles(const RingCorners& below, const RingCorners& above) {
  return below.size() + above.size() - 2;
}

/// Writes 3 * strip_triangles() indices, counter-clockwise seen from outside. Triangles follow the shorter
/// diagonal, as long as neither ring is ahead of the other by more than `most_lead` radians. A side to a
/// farther corner would face away from its neighbours. Linear time. Reads a float behind each position.
void write_strip(const RingCorners& below, const RingCorners& above, float most_lead,
                 const glm::vec3* position, std::uint32_t* out);

/// Writes the triangles from a ring to an apex, 3 * (ring.size() - 1) indices. `is_below`: the apex is before
/// the ring, else after it.
void write_fan(const RingCorners& ring, std::uint32_t apex, bool is_below, std::uint32_t* out);

}  // namespace seedmesh
