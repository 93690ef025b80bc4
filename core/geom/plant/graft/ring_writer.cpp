#include "core/geom/plant/graft/ring_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/quick_math.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = Limbs::none;
constexpr float pi = static_cast<float>(math::pi);

float texture_width(const LimbWriter& w, float radius) { return w.turns > 0 ? w.turns : radius; }

/// The angle within half a turn of the seam.
float near_seam(const LimbWriter& w, float angle) {
  while (angle >= w.seam + pi) angle -= 2 * pi;
  while (angle < w.seam - pi) angle += 2 * pi;
  return angle;
}

const UnitCircle& circle_of(const LimbWriter& w, int sides) {
  return w.in.rings.circles[static_cast<std::size_t>(sides)];
}

/// Four corners of a ring.
struct CornerBlock {
  Vec3x4 position, normal, around;  ///< around: the direction of rising angle
};

/// Corners in the directions (x, y) before the seam turns them. `factor` multiplies the radius; `fall` is its
/// relative decrease for each radian, by which normals lean.
CornerBlock corner_block(const LimbWriter& w, const RingPlane& plane, Float4 x, Float4 y, float factor,
                         float fall) {
  const Float4 along_u = x * w.seam_turn.x - y * w.seam_turn.y,
               along_v = x * w.seam_turn.y + y * w.seam_turn.x;
  const glm::vec3 &u = plane.u, &v = plane.v, lean = plane.tangent * plane.slope;
  const Vec3x4 out{u.x * along_u + v.x * along_v, u.y * along_u + v.y * along_v,
                   u.z * along_u + v.z * along_v};
  const Vec3x4 around{v.x * along_u - u.x * along_v, v.y * along_u - u.y * along_v,
                      v.z * along_u - u.z * along_v};
  const float radius = plane.radius * factor;
  const glm::vec3& c = plane.centre;
  const Vec3x4 normal{out.x + lean.x - around.x * fall, out.y + lean.y - around.y * fall,
                      out.z + lean.z - around.z * fall};
  return {{c.x + out.x * radius, c.y + out.y * radius, c.z + out.z * radius}, units(normal, out), around};
}

/// Where the corners of a ring go. The arrays have capacity for the corners, the first one again, and three
/// more.
struct RingArrays {
  glm::vec3 *position, *normal;
  glm::vec4* tangent;  ///< null: no tangents
};

void write_circle(const LimbWriter& w, const RingPlane& plane, int sides, const RingArrays& to) {
  const UnitCircle& circle = circle_of(w, sides);
  for (std::size_t i = 0; i <= static_cast<std::size_t>(sides); i += Vec3x4::size) {
    Float4 x, y;
    std::memcpy(&x, circle.x.data() + i, sizeof(x));
    std::memcpy(&y, circle.y.data() + i, sizeof(y));
    const CornerBlock block = corner_block(w, plane, x, y, 1, 0);
    block.position.write(to.position + i);
    block.normal.write(to.normal + i);
    if (!to.tangent) continue;
    Float4 rows[Vec3x4::size];
    block.around.to_rows(rows);
    for (Float4& row : rows) {
      row += 0.0F;
      row[3] = -1;
    }
    std::memcpy(static_cast<void*>(to.tangent + i), rows, sizeof(rows));
  }
}

/// add_vertex() where capacity is reserved. `tangent`: null where it is not known yet.
std::uint32_t put_vertex(LimbWriter& w, const glm::vec3& position, const glm::vec3& normal, glm::vec2 uv,
                         std::uint32_t group, const glm::vec4* tangent = nullptr) {
  BarkBuffers& bark = w.out;
  const std::size_t index = bark.vertices++;
  bark.mesh.position[index] = position + 0.0F;
  bark.mesh.normal[index] = normal + 0.0F;
  bark.mesh.uv[0][index] = glm::vec2(uv.x, uv.y * bark.v_scale) + 0.0F;
  bark.group[index] = group;
  bark.twin[index] = 0;
  if (bark.has_joints) bark.joints[index] = w.joint;
  if (bark.has_tangents && tangent) {
    bark.mesh.tangent[index] = *tangent;
  } else if (bark.has_tangents) {
    bark.mesh.tangent[index] = {glm::cross(w.along, position - w.on_axis), -1};
    if (group == none) level_tangent(bark.mesh, index);  // a loop's vertex has no normal yet
  }
  return static_cast<std::uint32_t>(index);
}

/// A corner of a ring with ribs.
std::uint32_t add_ribbed_corner(LimbWriter& w, const RingPlane& plane, const UnitCircle& circle, int corner,
                                float angle) {
  const float lobes = static_cast<float>(w.in.options.lobes), depth = w.in.options.lobe_depth;
  const math::SinCos rib = math::quick_sincos(static_cast<double>(angle) * w.in.options.lobes);
  const float factor = 1 + depth * static_cast<float>(rib.sin);
  const float fall = factor != 1 ? depth * lobes * static_cast<float>(rib.cos) / factor : 0;
  const auto i = static_cast<std::size_t>(corner);
  const CornerBlock block =
      corner_block(w, plane, all_lanes(circle.x[i]), all_lanes(circle.y[i]), factor, fall);
  return add_vertex(w, block.position.at(0), block.normal.at(0),
                    {texture_width(w, plane.radius) * angle, plane.v_at}, none);
}

/// The vertex of a point of a loop.
std::uint32_t put_loop_point(LimbWriter& w, const OpenCorner& corner, float angle) {
  const LoopPoint& point = *corner.point;
  const LimbAxis& axis = w.axis;
  const float height = std::clamp(point.height, 0.0F, axis.length());
  const std::size_t piece = axis.first_piece_at(height, w.near_piece);
  // v is extrapolated beyond both ends of the limb.
  return put_vertex(w, point.position, {0, 0, 0},
                    {texture_width(w, axis.radius_at(height, piece)) * angle, axis.v_at(point.height, piece)},
                    corner.group);
}

std::uint32_t vertex_of(LimbWriter& w, OpenCorner& corner, const RingPlane& plane, bool is_after_seam) {
  std::uint32_t& made = corner.vertex[is_after_seam ? 1 : 0];
  if (made != none) return made;
  const float angle = corner.angle + (is_after_seam ? 2 * pi : 0);
  if (corner.point) {
    made = put_loop_point(w, corner, angle);
  } else if (has_ribs(w)) {
    made = add_ribbed_corner(w, plane, circle_of(w, sides_for(w, plane.radius)), corner.corner, angle);
  } else {
    const auto i = static_cast<std::size_t>(corner.corner);
    const glm::vec2 uv{texture_width(w, plane.radius) * angle, plane.v_at};
    made = put_vertex(w, w.ring_position[i], w.ring_normal[i], uv, none,
                      w.out.has_tangents ? &w.ring_tangent[i] : nullptr);
  }
  if (corner.vertex[is_after_seam ? 0 : 1] != none) w.out.twin[made] = 1;
  return made;
}

/// Sorts corners by angle, equal angles by number. Insertion sort: all except the points of loops are in order.
void sort_corners(RingCorners& order) {
  for (std::size_t i = 1; i < order.size(); ++i) {
    const RingCorner corner = order[i];
    std::size_t k = i;
    for (; k > 0 && (corner.angle < order[k - 1].angle ||
                     (corner.angle == order[k - 1].angle && corner.vertex < order[k - 1].vertex));
         --k)
      order[k] = order[k - 1];
    order[k] = corner;
  }
}

/// Writes one side of an open ring: from the corner nearest to the seam once around and that corner again.
void write_side(LimbWriter& w, const RingPlane& plane, RingCorners& order, RingCorners& out) {
  sort_corners(order);
  std::size_t start = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (std::abs(order[i].angle - w.seam) < std::abs(order[start].angle - w.seam)) start = i;
  }
  out.resize(order.size() + 1);
  reserve_vertices(w.out, order.size() + 1);
  RingCorner* to = out.data();
  const auto add = [&](std::size_t begin, std::size_t end, bool is_after_seam) {
    for (std::size_t at = begin; at < end; ++at) {
      OpenCorner& corner = w.open_corners[order[at].vertex];
      *to++ = {corner.angle + (is_after_seam ? 2 * pi : 0), vertex_of(w, corner, plane, is_after_seam)};
    }
  };
  add(start, order.size(), false);
  add(0, start, true);
  add(start, start + 1, true);
}

/// Lists the corners of an open ring in w.open_corners, and in lower_order and upper_order those of each
/// side.
class OpenCornerList {
 public:
  explicit OpenCornerList(LimbWriter& w, std::size_t most) : w_(w) {
    w.open_corners.resize(most);
    w.lower_order.resize(most);
    w.upper_order.resize(most);
  }

  OpenCorner& add(float angle, bool is_below, bool is_above) {
    w_.lower_order[lower_] = w_.upper_order[upper_] = {angle, count_};
    lower_ += is_below ? 1 : 0;
    upper_ += is_above ? 1 : 0;
    OpenCorner& corner = w_.open_corners[count_++];
    corner = {};
    corner.angle = angle;
    return corner;
  }

  void finish() {
    w_.lower_order.resize(lower_);
    w_.upper_order.resize(upper_);
  }

 private:
  LimbWriter& w_;
  std::uint32_t count_ = 0, lower_ = 0, upper_ = 0;
};

/// Makes a pair of groups for a point of a loop and notes the point for the child. Returns the parent's
/// group.
std::uint32_t add_loop_vertex(LimbWriter& w, const LoopPoint& point, std::uint32_t child) {
  BarkBuffers& bark = w.out;
  const auto group = static_cast<std::uint32_t>(bark.group_normal.size());
  std::fill_n(bark.group_normal.extend(2), 2, GroupNormal{});
  bark.group_limb.push_back(child);
  *bark.loop_vertices.extend(1) = {point.position, point.phase, point.reach, group + 1, w.joint};
  return group;
}

void add_loop(LimbWriter& w, const Junction& junction, OpenCornerList& list) {
  BarkBuffers& bark = w.out;
  Loop& loop = bark.loops[junction.limb];
  loop = {static_cast<std::uint32_t>(bark.loop_vertices.size()),
          0,
          junction.radius,
          junction.child_reach,
          junction.child_u,
          junction.is_fork};
  const auto add = [&](const LoopPoint& point, bool is_below, bool is_above) {
    OpenCorner& corner = list.add(near_seam(w, junction.middle + point.angle), is_below, is_above);
    corner.point = &point;
    corner.group = add_loop_vertex(w, point, junction.limb);
  };
  add(junction.first, true, true);
  add(junction.last, true, true);
  for (const LoopPoint& point : junction.below(w.plan.loop_point)) add(point, true, false);
  for (const LoopPoint& point : junction.above(w.plan.loop_point)) add(point, false, true);
  loop.count = static_cast<std::uint32_t>(bark.loop_vertices.size()) - loop.first;
}

}  // namespace

RingPlane plane_at(const LimbAxis& axis, float at, std::size_t piece) {
  RingPlane plane;
  plane.at = at;
  plane.tangent = axis.along[piece];
  plane.centre = axis.point[piece] + plane.tangent * (at - axis.at[piece]);
  plane.u = axis.u[piece];
  plane.v = axis.aside(piece);
  const float length = axis.at[piece + 1] - axis.at[piece];
  plane.radius = axis.radius_at(std::clamp(at, axis.at[piece], axis.at[piece + 1]), piece);
  plane.slope = (axis.radius[piece] - axis.radius[piece + 1]) / length;
  plane.v_at = axis.v_at(at, piece);
  return plane;
}

RingPlane plane_of(const LimbAxis& axis, const PlannedRing& ring) {
  RingPlane plane = plane_at(axis, ring.at, ring.piece);
  if (!ring.is_bend || ring.piece == 0) return plane;
  const glm::vec3 &before = axis.along[ring.piece - 1], &after = axis.along[ring.piece];
  plane.tangent = math::quick_unit(before + after, after);
  plane.u = least_rotation(axis.u[ring.piece], after, plane.tangent);
  plane.v = glm::cross(plane.tangent, plane.u);
  const float length = axis.at[ring.piece] - axis.at[ring.piece - 1];
  plane.slope = 0.5F * (plane.slope + (axis.radius[ring.piece - 1] - axis.radius[ring.piece]) / length);
  return plane;
}

int sides_for(const LimbWriter& w, float radius) {
  int sides = std::max(corners_by_table(w.in.rings, w.in.options, radius), w.least_sides);
  if (has_ribs(w)) sides = ribbed_corners(w.in.options, sides);
  return std::abs(sides - w.loop_sides) <= 1 ? w.loop_sides : sides;
}

void set_seam(LimbWriter& w, float angle) {
  w.seam = angle;
  const math::SinCos turn = math::quick_sincos(static_cast<double>(angle));
  w.seam_turn = {static_cast<float>(turn.cos), static_cast<float>(turn.sin)};
}

void set_joint(LimbWriter& w, float at) {
  w.joint = w.axis.joint[w.axis.first_piece_at(at, w.near_piece) + 1];
}

glm::vec2 texture_at(const LimbWriter& w, float radius, float angle, float at) {
  return {texture_width(w, radius) * angle, w.axis.v_at(at, w.axis.first_piece_at(at, w.near_piece))};
}

std::uint32_t add_vertex(LimbWriter& w, const glm::vec3& position, const glm::vec3& normal, glm::vec2 uv,
                         std::uint32_t group) {
  reserve_vertices(w.out, 1);
  return put_vertex(w, position, normal, uv, group);
}

void write_plain_ring(LimbWriter& w, const RingPlane& plane, RingCorners& out) {
  BarkBuffers& bark = w.out;
  const int sides = sides_for(w, plane.radius);
  const auto count = static_cast<std::size_t>(sides) + 1;
  const float step = 2 * pi / static_cast<float>(sides);
  w.along = plane.tangent;
  w.on_axis = plane.centre;
  reserve_vertices(bark, count);
  const std::size_t first = bark.vertices;
  out.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    out[i] = {w.seam + step * static_cast<float>(i), static_cast<std::uint32_t>(first + i)};
  if (has_ribs(w)) {
    const UnitCircle& circle = circle_of(w, sides);
    for (int i = 0; i <= sides; ++i)
      add_ribbed_corner(w, plane, circle, i, out[static_cast<std::size_t>(i)].angle);
  } else {
    write_circle(w, plane, sides,
                 {bark.mesh.position.data() + first, bark.mesh.normal.data() + first,
                  bark.has_tangents ? bark.mesh.tangent.data() + first : nullptr});
    const float width = texture_width(w, plane.radius), v = plane.v_at * bark.v_scale + 0.0F;
    for (std::size_t i = 0; i < count; ++i) bark.mesh.uv[0][first + i] = {width * out[i].angle + 0.0F, v};
    std::fill_n(bark.group.data() + first, count, none);
    std::fill_n(bark.twin.data() + first, count, std::uint8_t{0});
    if (bark.has_joints) std::fill_n(bark.joints.data() + first, count, w.joint);
    bark.vertices += count;
  }
  bark.twin[bark.vertices - 1] = 1;
}

void write_open_ring(LimbWriter& w, const RingPlane& plane, const PlannedRing& ring) {
  w.along = plane.tangent;
  w.on_axis = plane.centre;
  const std::vector<Junction>& junctions = w.plan.junction;
  const int sides = sides_for(w, plane.radius);
  auto most = static_cast<std::size_t>(sides);
  for (std::uint32_t k = ring.first; k != Junction::none; k = junctions[k].next)
    most += 2 + junctions[k].lower + junctions[k].upper;
  OpenCornerList list(w, most);
  if (!has_ribs(w)) {
    const std::size_t capacity = static_cast<std::size_t>(sides) + 1 + Vec3x4::size;
    w.ring_position.resize(capacity);
    w.ring_normal.resize(capacity);
    if (w.out.has_tangents) w.ring_tangent.resize(capacity);
    write_circle(
        w, plane, sides,
        {w.ring_position.data(), w.ring_normal.data(), w.out.has_tangents ? w.ring_tangent.data() : nullptr});
  }
  // Corners of the circle that are in a junction or close to it are left out.
  const float step = 2 * pi / static_cast<float>(sides), near = std::min(0.35F * step, 0.25F);
  for (int turn = 0, i = (sides + 1) / 2; turn < sides; ++turn, ++i) {  // by rising angle
    if (i >= sides) i -= sides;
    const float angle = near_seam(w, w.seam + step * static_cast<float>(i));
    bool is_taken = false;
    for (std::uint32_t k = ring.first; k != Junction::none && !is_taken; k = junctions[k].next) {
      const float distance = std::abs(near_seam(w, angle - junctions[k].middle + w.seam) - w.seam);
      is_taken = distance < junctions[k].half_width + near;
    }
    if (!is_taken) list.add(angle, true, true).corner = i;
  }
  for (std::uint32_t k = ring.first; k != Junction::none; k = junctions[k].next)
    add_loop(w, junctions[k], list);
  list.finish();
  write_side(w, plane, w.lower_order, w.lower);
  write_side(w, plane, w.upper_order, w.upper);
}

}  // namespace seedmesh
