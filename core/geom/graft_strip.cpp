#include <cmath>

#include "core/base/math.h"
#include "core/base/wide.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

// Triangles between two rings follow the shorter diagonal as long as neither ring is ahead by more, in
// radians.
constexpr float most_lead = 0.5F;

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

/// Triangles between two rings, by rising angle.
void GraftWriter::strip(const Corners& below, const Corners& above) {
  const std::size_t count = below.size() + above.size() - 2;
  spend_triangles(count);
  // Deep ribs go from crest to crest.
  const bool is_deep = has_ribs() && has_deep_ribs(context_.options);
  const float lead =
      is_deep ? static_cast<float>(math::pi) / static_cast<float>(std::max(below.size(), above.size()))
              : most_lead;
  write_strip(below, above, lead, mesh_.position.data(), mesh_.index.wide.extend(3 * count));
}

SEEDMESH_WIDE void GraftWriter::write_strip(const Corners& below, const Corners& above, float farthest,
                                            const glm::vec3* position, std::uint32_t* out) {
  const Corner *a = below.data(), *b = above.data();
  const Corner *const last_a = a + below.size() - 1, *const last_b = b + above.size() - 1;
  const auto apart = [&](const Corner& one, const Corner& other) {
    const FourFloats between = Four::row(position + one.vertex) - Four::row(position + other.vertex);
    const FourFloats squares = between * between;
    return squares[0] + squares[1] + squares[2];
  };
  for (; a < last_a || b < last_b; out += 3) {
    const Corner &next_a = a[a < last_a ? 1 : 0], &next_b = b[b < last_b ? 1 : 0];
    // The shorter diagonal, unless one side has fallen far behind. Chosen, not branched to: nobody can
    // foresee which it is.
    const float lead = next_a.angle - next_b.angle;
    const bool is_shorter = apart(next_a, *b) < apart(*a, next_b);
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

}  // namespace seedmesh
