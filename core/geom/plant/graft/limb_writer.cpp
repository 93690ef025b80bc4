#include "core/geom/plant/graft/limb_writer.h"

#include <algorithm>
#include <cmath>

#include "core/base/quick_math.h"
#include "core/base/rng.h"
#include "core/geom/plant/graft/junction_plan.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = Limbs::none;
constexpr float pi = static_cast<float>(math::pi);
// Rings keep this number of bulges (begin_plan()) from loops.
constexpr float bulge_share = 1.2F;
// A closed limb is thinner by a random share up to this one, and shorter by that many radii.
constexpr float most_slimmer = 0.04F;
// The slope of the normals at the rim of the cone that closes a limb inside its parent.
constexpr float cap_slope = -0.5F;
// The foot of a limb is levelled where its sine from the vertical is at least the first number, and its
// cosine at least the second one: flatter limbs lie on the ground.
constexpr float least_lean_of_foot = 0.05F, least_rise_of_foot = 0.3F;
// The largest ring that a vertex cache of 16 entries still contains when the next ring needs it.
constexpr std::size_t cached_corners = 13;

/// The limb that is written, and how it begins.
struct LimbBeginning {
  std::uint32_t head;
  bool is_root, has_loop;
  bool is_twig;  ///< a closed limb thinner than GraftOptions::thinnest_joint, turned as a welded one would be
};

/// Gives the triangles that have no colour yet that of the piece at length `at`.
void color_triangles(LimbWriter& w, float at) {
  if (!w.out.has_colors) return;
  const std::size_t count = w.out.mesh.index.wide.size() / 3 - w.out.colors.size();
  std::fill_n(w.out.colors.extend(count), count, w.axis.color[w.axis.first_piece_at(at, w.near_piece)]);
}

/// Where the rings of the plan draw the points of the axis (GraftOptions::drawn).
void record_drawn(const LimbWriter& w, float start) {
  const LimbAxis& axis = w.axis;
  Array<glm::vec3>& drawn = *w.in.options.drawn;
  float before = start;
  glm::vec3 from = axis.point_at(start);
  std::size_t point = 1;
  for (; point + 1 < axis.point.size() && axis.at[point] <= start;) ++point;
  for (const PlannedRing& ring : w.plan.ring) {
    const glm::vec3 to = axis.point_at(ring.at);
    for (; point + 1 < axis.point.size() && axis.at[point] <= ring.at; ++point) {
      const float share = ring.at > before ? (axis.at[point] - before) / (ring.at - before) : 1.0F;
      drawn[axis.joint[point]] = from + (to - from) * share;
    }
    before = ring.at;
    from = to;
  }
}

/// The direction of the corner that a collar would have nearest to the parent's tip.
glm::vec3 toward_parents_tip(const LimbWriter& w, std::uint32_t head) {
  const Limbs& limbs = w.in.limbs;
  const std::uint32_t joint = limbs.parent[head];
  std::uint32_t to = w.in.chains.next[joint], from = joint;
  if (to == none) {
    to = joint;
    from = limbs.parent[joint];
  }
  const glm::vec3& along = w.axis.along[0];
  if (from == none) return unit_perpendicular(along);
  const glm::vec3 step = limbs.position[to] - limbs.position[from];
  const glm::vec3 aside = step - along * glm::dot(step, along);
  const float least = 1e-3F * std::sqrt(glm::dot(step, step));
  return glm::dot(aside, aside) > least * least ? math::unit(aside, unit_perpendicular(along))
                                                : unit_perpendicular(along);
}

/// Reads the axis. Returns false where nothing of the limb can be seen.
bool read_axis(LimbWriter& w, const LimbBeginning& beginning) {
  const GraftInput& in = w.in;
  const Scale& scale = in.scale;
  LimbAxis& axis = w.axis;
  if (!axis.read(in.limbs, in.chains, beginning.head, scale.shortest)) return false;
  if (axis.radius[0] < std::max(2 * scale.thinnest, in.options.thinnest)) return false;
  if (in.options.colors) axis.read_colors(in.limbs);
  for (float& radius : axis.radius) radius = std::max(radius, 2 * scale.thinnest);
  if (beginning.is_root || beginning.has_loop) return true;
  // A closed limb that stays inside its parent is hidden. Many very short ones at one position would
  // meet in points that readers of the file weld.
  const float hidden = in.limbs.radius[in.limbs.parent[beginning.head]];
  return !(axis.length() < std::max(hidden, least_closed_length * scale.apart));
}

/// Makes a closed limb slimmer and shorter at random: limbs that lie on each other, as those of a split
/// without an angle do, must not share vertices.
void slim_closed_limb(LimbAxis& axis, bool is_twig, std::uint64_t hash) {
  const float widest = is_twig ? 1 + 0.5F * most_slimmer : 1.0F;
  for (float& radius : axis.radius) radius *= widest - most_slimmer * fraction_of(hash);
  axis.point.back() -= axis.along.back() * (most_slimmer * fraction_of(mix(hash)) * axis.radius.back());
}

/// The direction of angle 0 at the first piece.
glm::vec3 first_direction(const LimbWriter& w, const LimbBeginning& beginning, const Loop& loop,
                          std::uint64_t hash) {
  if (beginning.has_loop) return loop.u;
  if (beginning.is_twig) return toward_parents_tip(w, beginning.head);
  const glm::vec3 first = unit_perpendicular(w.axis.along[0]);
  const math::SinCos turn = math::quick_sincos(static_cast<double>(fraction_of(hash)) * 2 * math::pi);
  return first * static_cast<float>(turn.cos) +
         glm::cross(w.axis.along[0], first) * static_cast<float>(turn.sin);
}

/// Plans rings and junctions from the length `start` to `tip`.
void plan_limb(LimbWriter& w, std::uint32_t limb, float start, float tip, bool has_loop) {
  const LimbAxis& axis = w.axis;
  const float middle = axis.radius_at(0.5F * axis.length(), axis.piece_at(0.5F * axis.length(), 0));
  const int sides = std::max(least_opened_corners, sides_for(w, middle));
  const float half_side_cosine = w.in.rings.circles[static_cast<std::size_t>(2 * sides)].x[1];
  begin_plan(w.plan, start, tip, w.in.scale.apart, bulge_share * (1 - half_side_cosine));
  if (w.in.join[limb] <= JoinMode::detached) plan_junctions(w.in, axis, w.angles, w.plan);
  if (!w.plan.junction.empty()) w.least_sides = least_opened_corners;
  complete_plan(w.plan, axis, has_loop && sides_for(w, axis.radius[0]) > 4, w.in.options);
}

/// The child's vertices at the loop. The angles of a ring run the other way around than the phases of the
/// loop.
void write_loop(LimbWriter& w, const Loop& loop) {
  w.below_has_loop = true;
  const RingPlane plane = plane_at(w.axis, loop.reach, w.axis.piece_at(loop.reach, 0));
  w.along = plane.tangent;
  w.on_axis = plane.centre;
  std::vector<LoopVertex>& order = w.loop_order;
  order.clear();
  for (std::uint32_t i = 0; i < loop.count; ++i) order.push_back(w.out.loop_vertices[loop.first + i]);
  for (std::size_t i = 1; i < order.size(); ++i) {  // insertion sort by falling phase
    const LoopVertex each = order[i];
    std::size_t k = i;
    for (; k > 0 && order[k - 1].angle < each.angle; --k) order[k] = order[k - 1];
    order[k] = each;
  }
  w.below.clear();
  const auto add = [&](const LoopVertex& at, float angle) {
    w.joint = at.joint;
    const std::uint32_t vertex =
        add_vertex(w, at.position, {0, 0, 0}, texture_at(w, loop.radius, angle, at.reach), at.group);
    w.below.push_back({angle, vertex});
    w.out.twin[vertex] = 1;
  };
  for (const LoopVertex& each : order) add(each, -each.angle);
  add(order.front(), 2 * pi - order.front().angle);
  set_seam(w, w.below.front().angle);
}

void note_rib_seam(LimbWriter& w, const RingCorners& ring) {
  if (has_ribs(w)) w.out.rib_seams.emplace_back(ring.front().vertex, ring.back().vertex);
}

/// Extends a limb that leaves the ground at an angle straight down to a level floor at its lowest corner.
/// Returns the normal of the floor.
glm::vec3 level_foot(LimbWriter& w, RingPlane& plane) {
  const glm::vec3 along = w.axis.along[0];
  const float sine = std::sqrt(along.x * along.x + along.z * along.z);
  if (sine < least_lean_of_foot || along.y < least_rise_of_foot) return -along;
  Mesh& mesh = w.out.mesh;
  float lowest = plane.centre.y;
  for (const RingCorner& corner : w.below) lowest = std::min(lowest, mesh.position[corner.vertex].y);
  for (const RingCorner& corner : w.below) {
    glm::vec3& at = mesh.position[corner.vertex];
    const float down = (lowest - at.y) / along.y;
    at += along * down;
    at.y = lowest;
    mesh.uv[0][corner.vertex].y = w.axis.v_at(down, 0) * w.out.v_scale + 0.0F;
  }
  plane.centre += along * ((lowest - plane.centre.y) / along.y);
  return {0, -1, 0};
}

/// The floor of a root, with a rim of its own: its texture is seen from below.
void write_floor(LimbWriter& w, RingPlane plane) {
  plane.slope = 0;
  write_plain_ring(w, plane, w.below);
  note_rib_seam(w, w.below);
  const glm::vec3 down = level_foot(w, plane);
  const std::uint32_t centre = add_vertex(w, plane.centre, down, {0, 0}, none);
  RingCorners rim;
  for (std::size_t i = 0; i + 1 < w.below.size(); ++i) {
    const glm::vec3 at = w.out.mesh.position[w.below[i].vertex], off = at - plane.centre;
    rim.push_back({0, add_vertex(w, at, down, {glm::dot(off, plane.u), glm::dot(off, plane.v)}, none)});
    w.out.twin[rim.back().vertex] = 1;
  }
  for (std::size_t i = centre; w.out.has_tangents && i <= rim.back().vertex; ++i) {
    w.out.mesh.tangent[i] = {plane.u, 1};
    level_tangent(w.out.mesh, i);
  }
  std::uint32_t* out = add_triangles(w.out, rim.size());
  for (std::size_t i = 0; i < rim.size(); ++i) {
    *out++ = centre;
    *out++ = rim[(i + 1) % rim.size()].vertex;
    *out++ = rim[i].vertex;
  }
}

/// The cone that closes a limb inside its parent.
void write_cap(LimbWriter& w, RingPlane plane, std::uint64_t hash) {
  const glm::vec3 along = w.axis.along[0];
  // Random: the rings of limbs that begin at one position keep a distance.
  const float back = (0.05F + 0.4F * fraction_of(hash)) * plane.radius + w.in.scale.apart;
  plane.centre -= along * back;
  plane.at = -back;
  plane.v_at = w.axis.v_at(-back, 0);
  plane.slope = cap_slope;
  write_plain_ring(w, plane, w.below);
  const float cone = cap_share * plane.radius;
  const std::uint32_t apex =
      add_vertex(w, plane.centre - along * cone, -along, texture_at(w, plane.radius, pi, -back - cone), none);
  write_fan(w.below, apex, true, add_triangles(w.out, w.below.size() - 1));
}

void write_closed_beginning(LimbWriter& w, const LimbBeginning& beginning) {
  w.below_has_loop = false;
  set_seam(w, 0);
  const float radius = w.axis.radius[0];
  if (!beginning.is_root && radius < w.in.options.thinnest_joint)
    set_seam(w, -w.angles.of(corners_by_table(w.in.rings, w.in.options, radius)).back().angle);
  const RingPlane plane = plane_at(w.axis, 0, 0);
  set_joint(w, 0);
  if (beginning.is_root) {
    write_floor(w, plane);
  } else {
    write_cap(w, plane, key_at(w.in.key_of(beginning.head), 0x0C10));
  }
}

/// Triangles between the last ring and the next. `is_even`: neither has junctions, both have as many corners.
void write_strip_to(LimbWriter& w, const RingCorners& above, bool is_even) {
  // Rings of equal corners, and crests of deep ribs, are joined corner to corner. Elsewhere a lead is
  // bounded.
  constexpr float most_lead = 0.3F;
  const bool is_paired = is_even || (has_ribs(w) && has_deep_ribs(w.in.options));
  const float lead = is_paired ? pi / static_cast<float>(std::max(w.below.size(), above.size())) : most_lead;
  std::uint32_t* out = add_triangles(w.out, strip_triangles(w.below, above));
  write_strip(w.below, above, lead, w.out.mesh.position.data(), out);
}

void write_next_ring(LimbWriter& w, const PlannedRing& ring) {
  w.near_piece = ring.piece;
  set_joint(w, ring.at);
  const std::size_t first = w.out.mesh.index.wide.size() / 3;
  const RingPlane plane = plane_of(w.axis, ring);
  if (ring.is_open()) {
    write_open_ring(w, plane, ring);
    note_rib_seam(w, w.lower);
    note_rib_seam(w, w.upper);
    write_strip_to(w, w.lower, false);
  } else {
    write_plain_ring(w, plane, w.upper);
    note_rib_seam(w, w.upper);
    write_strip_to(w, w.upper, !has_ribs(w) && !w.below_has_loop && w.below.size() == w.upper.size());
  }
  if (w.below_has_loop || ring.is_open()) note_loop_triangles(w.out, first);
  w.below_has_loop = ring.is_open();
  std::swap(w.below, w.upper);
  w.out.corners += w.below.size();
  if (w.below.size() > cached_corners) w.out.wide_corners += w.below.size();
}

void write_tip(LimbWriter& w, float radius) {
  const std::uint32_t apex = add_vertex(w, w.axis.point.back(), w.axis.along.back(),
                                        texture_at(w, radius, pi + w.seam, w.axis.length()), none);
  const std::size_t first = w.out.mesh.index.wide.size() / 3;
  write_fan(w.below, apex, false, add_triangles(w.out, w.below.size() - 1));
  if (w.below_has_loop) note_loop_triangles(w.out, first);
}

void write_visible_limb(LimbWriter& w, std::uint32_t limb) {
  const Loop& loop = w.out.loops[limb];
  LimbAxis& axis = w.axis;
  LimbBeginning beginning{w.in.chains.head[limb], false, loop.first != none, false};
  beginning.is_root = w.in.limbs.parent[beginning.head] == none;
  if (!read_axis(w, beginning)) return;
  const bool has_loop = beginning.has_loop, is_closed = !beginning.is_root && !has_loop;
  w.out.start[limb] = beginning.is_root ? LimbStart::root
                      : is_closed       ? LimbStart::closed
                      : loop.is_fork    ? LimbStart::fork
                                        : LimbStart::collar;
  beginning.is_twig = is_closed && axis.radius[0] < w.in.options.thinnest_joint;
  const std::uint64_t hash = key_at(w.in.key_of(beginning.head), 0x62AF7);
  if (is_closed) slim_closed_limb(axis, beginning.is_twig, hash);
  const float end = axis.radius.back();
  const float tip = axis.length() - tip_length(end, axis.at.back() - axis.at[axis.at.size() - 2]);
  const float start = has_loop ? loop.reach : 0;
  if (start > tip - 8 * w.in.scale.apart) return;
  axis.set_frames(first_direction(w, beginning, loop, hash));
  w.near_piece = 0;
  w.turns = w.in.options.wrap ? texture_repeats(axis.radius[0], w.in.options.least_repeats) / (2 * pi) : 0;
  axis.set_v(w.turns, w.in.options.least_repeats);
  w.least_sides = 3;
  w.loop_sides = has_loop ? static_cast<int>(loop.count) : 0;
  plan_limb(w, limb, start, tip, has_loop);
  if (w.in.options.drawn) record_drawn(w, start);
  if (has_loop) {
    write_loop(w, loop);
  } else {
    write_closed_beginning(w, beginning);
    color_triangles(w, 0);
  }
  float before = start;
  for (const PlannedRing& ring : w.plan.ring) {
    write_next_ring(w, ring);
    color_triangles(w, 0.5F * (before + ring.at));
    before = ring.at;
    if (has_loop && &ring == &w.plan.ring.front()) w.out.range[limb].first_end = sizes_of(w.out).triangle;
  }
  write_tip(w, end);
  color_triangles(w, axis.length());
}

}  // namespace

void write_limb(LimbWriter& w, std::uint32_t limb) {
  LimbRange& range = w.out.range[limb];
  w.out.start[limb] = LimbStart::none;
  range.begin = sizes_of(w.out);
  range.first_end = range.begin.triangle;
  if (w.in.join[limb] != JoinMode::none) write_visible_limb(w, limb);
  range.end = sizes_of(w.out);
}

}  // namespace seedmesh
