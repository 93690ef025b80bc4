#include <cmath>

#include "core/base/math.h"
#include "core/base/wide.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

// Triangles between two rings follow the shorter diagonal as long as the next side of neither has its middle
// ahead of the other's by more, in radians: a side that went to the farther corner would look past it.
constexpr float most_lead = 0.3F;

}  // namespace

void GraftWriter::note_loop_triangles(std::size_t first) {
  const std::size_t end = mesh_.index.wide.size() / 3;
  const std::uint32_t* corner = mesh_.index.wide.data() + 3 * first;
  // Each is put on the list, and stays if it touches a loop: nobody can foresee which do.
  std::uint32_t* noted = loop_triangles_.extend(end - first);
  for (std::size_t t = first; t < end; ++t, corner += 3) {
    *noted = static_cast<std::uint32_t>(t);
    noted += (group_[corner[0]] & group_[corner[1]] & group_[corner[2]]) != none ? 1 : 0;
  }
  loop_triangles_.resize(static_cast<std::size_t>(noted - loop_triangles_.data()));
}

/// Triangles between two rings, by rising angle. `is_even`: nothing leaves either, and they have as many
/// corners.
void GraftWriter::strip(const Corners& below, const Corners& above, bool is_even) {
  const std::size_t count = below.size() + above.size() - 2;
  spend_triangles(count);
  if (is_even && !has_ribs())
    return write_quads(below, above, mesh_.position.data(), mesh_.index.wide.extend(3 * count));
  // Deep ribs go from crest to crest.
  const bool is_deep = has_ribs() && has_deep_ribs(context_.options);
  const float lead =
      is_deep ? static_cast<float>(math::pi) / static_cast<float>(std::max(below.size(), above.size()))
              : most_lead;
  write_strip(below, above, lead, mesh_.position.data(), mesh_.index.wide.extend(3 * count));
}

namespace {

float apart(const glm::vec3& one, const glm::vec3& other) {
  const FourFloats between = Four::row(&one) - Four::row(&other);
  const FourFloats squares = between * between;
  return squares[0] + squares[1] + squares[2];
}

}  // namespace

/// As write_strip() has them where no corner is ahead: between two corners each, by the shorter diagonal.
SEEDMESH_WIDE void GraftWriter::write_quads(const Corners& below, const Corners& above,
                                            const glm::vec3* position, std::uint32_t* out) {
  const Corner *a = below.data(), *b = above.data();
  for (const Corner* const last = a + below.size() - 1; a < last; ++a, ++b, out += 6) {
    const std::uint32_t a0 = a[0].vertex, a1 = a[1].vertex, b0 = b[0].vertex, b1 = b[1].vertex;
    const bool take_below = apart(position[a1], position[b0]) < apart(position[a0], position[b1]);
    out[0] = a0;
    out[1] = take_below ? a1 : b1;
    out[2] = b0;
    out[3] = take_below ? a1 : a0;
    out[4] = take_below ? b1 : a1;
    out[5] = take_below ? b0 : b1;
  }
}

SEEDMESH_WIDE void GraftWriter::write_strip(const Corners& below, const Corners& above, float farthest,
                                            const glm::vec3* position, std::uint32_t* out) {
  const Corner *a = below.data(), *b = above.data();
  const Corner *const last_a = a + below.size() - 1, *const last_b = b + above.size() - 1;
  for (; a < last_a || b < last_b; out += 3) {
    const Corner &next_a = a[a < last_a ? 1 : 0], &next_b = b[b < last_b ? 1 : 0];
    // The shorter diagonal, unless one side has fallen far behind. Chosen, not branched to: nobody can
    // foresee which it is.
    const float lead = 0.5F * ((a->angle + next_a.angle) - (b->angle + next_b.angle));
    const bool is_shorter = apart(position[next_a.vertex], position[b->vertex]) <
                            apart(position[a->vertex], position[next_b.vertex]);
    const bool is_behind = lead<0, is_far = std::abs(lead)> farthest;
    const bool is_next = (is_far & is_behind) | (!is_far & is_shorter);
    const bool take_below = (b == last_b) | ((a < last_a) & is_next);
    out[0] = a->vertex;
    out[1] = take_below ? next_a.vertex : next_b.vertex;
    out[2] = b->vertex;
    a += take_below ? 1 : 0;
    b += take_below ? 0 : 1;
  }
}

/// From the ring `below_` to a point above it or below.
void GraftWriter::triangles_to(std::uint32_t apex, bool is_below) {
  const std::size_t count = below_.size() - 1;
  spend_triangles(count);
  std::uint32_t* out = mesh_.index.wide.extend(3 * count);
  for (std::size_t i = 0; i < count; ++i, out += 3) {
    const std::uint32_t one = below_[i].vertex, next = below_[i + 1].vertex;
    out[0] = is_below ? apex : one;
    out[1] = next;
    out[2] = is_below ? one : apex;
  }
}

void GraftWriter::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  spend_triangles(1);
  std::uint32_t* out = mesh_.index.wide.extend(3);
  out[0] = a;
  out[1] = b;
  out[2] = c;
}

void GraftWriter::write_tip(float end_radius) {
  const glm::vec3 along = axis_.along.back();
  const std::uint32_t apex =
      vertex(axis_.point.back(), along,
             picture_at(end_radius, static_cast<float>(math::pi) + seam_, axis_.length()), none);
  const std::size_t first = mesh_.index.wide.size() / 3;
  triangles_to(apex, false);
  if (is_at_loop_) note_loop_triangles(first);
}

}  // namespace seedmesh
