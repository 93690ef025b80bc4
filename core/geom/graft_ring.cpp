#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/quick_math.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

constexpr float pi = static_cast<float>(math::pi);
// A limb leans from so much off the upright on, and lies rather than stands below so much of it: sine,
// cosine.
constexpr float least_lean_of_foot = 0.05F, least_rise_of_foot = 0.3F;

}  // namespace

GraftWriter::Plane GraftWriter::plane_at(float at, std::size_t piece) const {
  Plane plane;
  plane.at = at;
  plane.tangent = axis_.along[piece];
  plane.centre = axis_.point[piece] + plane.tangent * (at - axis_.at[piece]);
  plane.u = axis_.u[piece];
  plane.v = axis_.aside(piece);
  const float length = axis_.at[piece + 1] - axis_.at[piece];
  plane.radius = axis_.radius_at(std::clamp(at, axis_.at[piece], axis_.at[piece + 1]), piece);
  plane.slope = (axis_.radius[piece] - axis_.radius[piece + 1]) / length;
  plane.v_at = axis_.v_at(at, piece);
  return plane;
}

GraftWriter::Plane GraftWriter::plane_of(const Band& band) const {
  Plane plane = plane_at(band.at, band.piece);
  if (!band.is_bend || band.piece == 0) return plane;
  const glm::vec3 &before = axis_.along[band.piece - 1], &after = axis_.along[band.piece];
  plane.tangent = math::quick_unit(before + after, after);
  // Halfway back from the frame of the later piece: the least turn that takes its axis to the tangent.
  const float cosine = glm::dot(after, plane.tangent);
  glm::vec3 u = axis_.u[band.piece];
  u -= (after + plane.tangent) * (glm::dot(u, plane.tangent) / (1 + cosine));
  u -= plane.tangent * glm::dot(u, plane.tangent);
  plane.u = unit_again(u, [&] { return any_aside(plane.tangent); });
  plane.v = glm::cross(plane.tangent, plane.u);
  const float length = axis_.at[band.piece] - axis_.at[band.piece - 1];
  plane.slope = 0.5F * (plane.slope + (axis_.radius[band.piece - 1] - axis_.radius[band.piece]) / length);
  return plane;
}

/// The factor of the radius that ribs make.
float GraftWriter::ribbed(float angle) const {
  if (!has_ribs()) return 1;
  const double at = static_cast<double>(angle) * context_.options.lobes;
  return 1 + context_.options.lobe_depth * static_cast<float>(math::quick_sincos(at).sin);
}

/// Where there is room for it.
std::uint32_t GraftWriter::put_vertex(const glm::vec3& position, const glm::vec3& normal, glm::vec2 uv,
                                      std::uint32_t group, const glm::vec4* tangent) {
  const std::size_t index = vertices_++;
  mesh_.position[index] = position + 0.0F;
  mesh_.normal[index] = normal + 0.0F;
  mesh_.uv[0][index] = glm::vec2(uv.x, uv.y * context_.options.v_scale) + 0.0F;
  group_[index] = group;
  twin_[index] = 0;
  if (context_.options.joints) joints_[index] = joint_;
  if (!has_tangents()) return static_cast<std::uint32_t>(index);
  if (tangent) {
    mesh_.tangent[index] = *tangent;
    return static_cast<std::uint32_t>(index);
  }
  // Round the limb; that of a loop's vertex waits for its normal.
  mesh_.tangent[index] = {glm::cross(along_, position - on_axis_), -1};
  if (group == none) lay_tangent(mesh_, index);
  return static_cast<std::uint32_t>(index);
}

/// At right angles to the normal, which may be new.
void GraftWriter::lay_tangent(Mesh& mesh, std::size_t vertex) const {
  glm::vec4& tangent = mesh.tangent[vertex];
  const glm::vec3& normal = mesh.normal[vertex];
  glm::vec3 way(tangent);
  const float before = glm::dot(way, way);
  way -= normal * glm::dot(way, normal);
  constexpr float least = 1e-3F;
  const bool is_found = before > 0 && glm::dot(way, way) > least * least * before;
  tangent = {math::quick_unit(is_found ? way : any_aside(normal), {1, 0, 0}) + 0.0F, tangent.w};
}

/// u round the limb and v along it.
glm::vec2 GraftWriter::picture_at(float radius, float angle, float at) const {
  return {picture_width(radius) * angle, axis_.v_at(at, axis_.first_piece_at(at, near_piece_))};
}

/// The joint whose internode holds the length `at`; of two that meet there the older one.
void GraftWriter::stand_at(float at) { joint_ = axis_.joint[axis_.first_piece_at(at, near_piece_) + 1]; }

std::uint32_t GraftWriter::ring_corner(const Plane& plane, float angle, glm::vec2 direction) {
  const float factor = ribbed(angle);
  const glm::vec3 out = plane.u * direction.x + plane.v * direction.y;
  glm::vec3 normal = out + plane.tangent * plane.slope;
  if (factor != 1) {
    const double at = static_cast<double>(angle) * context_.options.lobes;
    const float fall = context_.options.lobe_depth * static_cast<float>(context_.options.lobes) *
                       static_cast<float>(math::quick_sincos(at).cos) / factor;
    normal -= (plane.v * direction.x - plane.u * direction.y) * fall;
  }
  return vertex(plane.centre + out * (plane.radius * factor), math::quick_unit(normal, out),
                {picture_width(plane.radius) * angle, plane.v_at}, none);
}

/// The angle within half a turn of the seam.
float GraftWriter::by_seam(float angle) const {
  while (angle >= seam_ + pi) angle -= 2 * pi;
  while (angle < seam_ - pi) angle += 2 * pi;
  return angle;
}

std::uint32_t GraftWriter::group_for(const LoopPoint& point, std::uint32_t child) {
  const auto group = static_cast<std::uint32_t>(group_normal_.size());
  std::fill_n(group_normal_.extend(2), 2, GroupNormal{});  // of the parent's faces, of the child's
  group_limb_.push_back(child);
  *loop_vertices_.extend(1) = {point.position, point.phase, point.reach, group + 1, joint_};
  return group;
}

/// The vertex of a point of a loop.
std::uint32_t GraftWriter::loop_corner(const Mark& mark, float angle) {
  const LoopPoint& point = *mark.point;
  const float height = std::clamp(point.height, 0.0F, axis_.length());
  const std::size_t piece = axis_.first_piece_at(height, near_piece_);
  const float from = axis_.at[piece], share = (height - from) / (axis_.at[piece + 1] - from);
  const float radius = axis_.radius[piece] + (axis_.radius[piece + 1] - axis_.radius[piece]) * share;
  // The picture goes on beyond both ends of the limb.
  const float v = height == point.height ? axis_.v[piece] + (axis_.v[piece + 1] - axis_.v[piece]) * share
                                         : axis_.v_at(point.height, piece);
  return put_vertex(point.position, {0, 0, 0}, {picture_width(radius) * angle, v}, mark.group);
}

/// The vertex of a corner, beyond the seam or before it.
std::uint32_t GraftWriter::vertex_of(Mark& mark, const Plane& plane, bool is_beyond) {
  std::uint32_t& made = mark.vertex[is_beyond ? 1 : 0];
  if (made != none) return made;
  const float angle = mark.angle + (is_beyond ? 2 * pi : 0);
  if (mark.point) {
    made = loop_corner(mark, angle);
  } else if (is_ring_known_) {
    const auto corner = static_cast<std::size_t>(mark.corner);
    made = put_vertex(ring_position_[corner], ring_normal_[corner],
                      {picture_width(plane.radius) * angle, plane.v_at}, none,
                      has_tangents() ? &ring_tangent_[corner] : nullptr);
  } else {
    const Circle& circle = common_->circles[static_cast<std::size_t>(sides_for(plane.radius))];
    made = ring_corner(plane, angle, turned_to_seam(circle.at(mark.corner)));
  }
  if (mark.vertex[is_beyond ? 0 : 1] != none) mark_twin();
  return made;
}

/// One side of a ring in order, from the corner that is nearest to the seam all round to it again.
void GraftWriter::go_round(Corners& order, const Plane& plane, Corners& out) {
  // Few, and in order but for the points of loops.
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Corner corner = order[i];
    std::size_t k = i;
    for (; k > 0 && (corner.angle < order[k - 1].angle ||
                     (corner.angle == order[k - 1].angle && corner.vertex < order[k - 1].vertex));
         --k)
      order[k] = order[k - 1];
    order[k] = corner;
  }
  std::size_t start = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (std::abs(order[i].angle - seam_) < std::abs(order[start].angle - seam_)) start = i;
  }
  out.resize(order.size() + 1);
  make_room_for(order.size() + 1);
  Corner* to = out.data();
  const auto go = [&](std::size_t begin, std::size_t end, bool is_beyond) {
    for (std::size_t at = begin; at < end; ++at) {
      Mark& mark = marks_[order[at].vertex];
      *to++ = {mark.angle + (is_beyond ? 2 * pi : 0), vertex_of(mark, plane, is_beyond)};
    }
  };
  go(start, order.size(), false);
  go(0, start, true);
  go(start, start + 1, true);
}

/// Four corners of a ring without ribs, from `first` on, as ring_corner() has them one by one. False: one has
/// no direction, and nothing is written.
bool GraftWriter::write_ring_block(const Plane& plane, const Circle& circle, std::size_t first,
                                   const RingRoom& to) const {
  FourFloats x, y;
  std::memcpy(&x, circle.x.data() + first, sizeof(x));
  std::memcpy(&y, circle.y.data() + first, sizeof(y));
  const FourFloats along_u = x * seam_turn_.x - y * seam_turn_.y,
                   along_v = x * seam_turn_.y + y * seam_turn_.x;
  const glm::vec3& u = plane.u;
  const glm::vec3& v = plane.v;
  const glm::vec3 lean = plane.tangent * plane.slope;
  const Four out{u.x * along_u + v.x * along_v, u.y * along_u + v.y * along_v, u.z * along_u + v.z * along_v};
  Four normal{out.x + lean.x, out.y + lean.y, out.z + lean.z};
  if (!to_units(normal)) return false;
  const float r = plane.radius;
  const Four position{plane.centre.x + out.x * r, plane.centre.y + out.y * r, plane.centre.z + out.z * r};
  position.write(to.position + first);
  normal.write(to.normal + first);
  if (!to.tangent) return true;
  const Four way{v.x * along_u - u.x * along_v, v.y * along_u - u.y * along_v, v.z * along_u - u.z * along_v};
  FourFloats rows[Four::size];
  way.to_rows(rows);
  for (std::size_t k = 0; k < Four::size; ++k) {
    rows[k] += 0.0F;
    rows[k][3] = -1;
  }
  std::memcpy(static_cast<void*>(to.tangent + first), rows, sizeof(rows));
  return true;
}

/// All corners of a ring without ribs, the first again at the end, and up to three more. False: one has no
/// direction.
bool GraftWriter::write_ring(const Plane& plane, int sides, const RingRoom& to) const {
  const Circle& circle = common_->circles[static_cast<std::size_t>(sides)];
  for (std::size_t i = 0; i <= static_cast<std::size_t>(sides); i += Four::size) {
    if (!write_ring_block(plane, circle, i, to)) return false;
  }
  return true;
}

/// The corners of a ring that nothing leaves.
void GraftWriter::plain_ring(const Plane& plane, Corners& out) {
  const int sides = sides_for(plane.radius);
  const auto count = static_cast<std::size_t>(sides) + 1;
  const float step = 2 * pi / static_cast<float>(sides);
  stand_on(plane);
  make_room_for(count);
  out.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    out[i] = {seam_ + step * static_cast<float>(i), static_cast<std::uint32_t>(vertices_ + i)};
  if (!has_ribs() && write_ring(plane, sides,
                                {mesh_.position.data() + vertices_, mesh_.normal.data() + vertices_,
                                 has_tangents() ? mesh_.tangent.data() + vertices_ : nullptr})) {
    const float wide = picture_width(plane.radius), far = plane.v_at * context_.options.v_scale + 0.0F;
    for (std::size_t i = 0; i < count; ++i) mesh_.uv[0][vertices_ + i] = {wide * out[i].angle + 0.0F, far};
    std::fill_n(group_.data() + vertices_, count, none);
    std::fill_n(twin_.data() + vertices_, count, std::uint8_t{0});
    if (context_.options.joints) std::fill_n(joints_.data() + vertices_, count, joint_);
    vertices_ += count;
  } else {
    const Circle& circle = common_->circles[static_cast<std::size_t>(sides)];
    for (int i = 0; i <= sides; ++i)
      ring_corner(plane, out[static_cast<std::size_t>(i)].angle, turned_to_seam(circle.at(i)));
  }
  mark_twin();
}

/// A ring that others leave: `lower_` for the strip below, `upper_` for the one above, which differ there.
void GraftWriter::open_ring(const Plane& plane, const Band& band) {
  stand_on(plane);
  const int sides = sides_for(plane.radius);
  auto most = static_cast<std::size_t>(sides);
  for (std::uint32_t k = band.first; k != Opening::none; k = plan_.opening[k].next)
    most += 2 + plan_.opening[k].lower + plan_.opening[k].upper;
  marks_.resize(most);
  lower_order_.resize(most);
  upper_order_.resize(most);
  std::uint32_t marks = 0, lower = 0, upper = 0;
  // Put on both lists, of which it stays on those that it belongs to.
  const auto add = [&](float angle, bool below, bool above) -> Mark& {
    lower_order_[lower] = upper_order_[upper] = {angle, marks};
    lower += below ? 1 : 0;
    upper += above ? 1 : 0;
    Mark& mark = marks_[marks++];
    mark.angle = angle;
    mark.vertex[0] = mark.vertex[1] = none;
    return mark;
  };
  const float step = 2 * pi / static_cast<float>(sides), near = std::min(0.35F * step, 0.25F);
  const std::size_t room = static_cast<std::size_t>(sides) + 1 + Four::size;
  ring_position_.resize(room);
  ring_normal_.resize(room);
  if (has_tangents()) ring_tangent_.resize(room);
  is_ring_known_ = !has_ribs() && write_ring(plane, sides,
                                             {ring_position_.data(), ring_normal_.data(),
                                              has_tangents() ? ring_tangent_.data() : nullptr});
  for (int turn = 0, i = (sides + 1) / 2; turn < sides; ++turn, ++i) {  // by rising angle
    if (i >= sides) i -= sides;
    const float angle = by_seam(seam_ + step * static_cast<float>(i));
    const auto takes = [&](const Opening& opening) {
      const float off = std::abs(by_seam(angle - opening.middle + seam_) - seam_);
      return off < opening.half + near;
    };
    bool is_taken = false;
    for (std::uint32_t k = band.first; k != Opening::none && !is_taken; k = plan_.opening[k].next)
      is_taken = takes(plan_.opening[k]);
    if (is_taken) continue;
    Mark& mark = add(angle, true, true);
    mark.corner = i;
    mark.point = nullptr;
    mark.group = none;
  }
  for (std::uint32_t number = band.first; number != Opening::none; number = plan_.opening[number].next) {
    const Opening& opening = plan_.opening[number];
    Loop& loop = loops_[opening.limb];
    loop = {static_cast<std::uint32_t>(loop_vertices_.size()),
            0,
            opening.radius,
            opening.child_reach,
            opening.child_u,
            opening.is_fork};
    const auto put = [&](const LoopPoint& point, bool below, bool above) {
      Mark& mark = add(by_seam(opening.middle + point.angle), below, above);
      mark.point = &point;
      mark.group = group_for(point, opening.limb);
    };
    put(opening.first, true, true);
    put(opening.last, true, true);
    for (const LoopPoint& point : opening.below(plan_.loop_point)) put(point, true, false);
    for (const LoopPoint& point : opening.above(plan_.loop_point)) put(point, false, true);
    loop.count = static_cast<std::uint32_t>(loop_vertices_.size()) - loop.first;
  }
  lower_order_.resize(lower);
  upper_order_.resize(upper);
  go_round(lower_order_, plane, lower_);
  go_round(upper_order_, plane, upper_);
}

void GraftWriter::begin_loop(const Loop& loop) {
  // The child's angles run the other way round than the phases of its loop.
  is_at_loop_ = true;
  stand_on(plane_at(loop.reach, axis_.piece_at(loop.reach, 0)));
  below_.clear();
  std::vector<const LoopVertex*>& order = loop_order_;
  order.clear();
  for (std::uint32_t i = 0; i < loop.count; ++i) order.push_back(&loop_vertices_[loop.first + i]);
  for (std::size_t i = 1; i < order.size(); ++i) {  // few
    const LoopVertex* const each = order[i];
    std::size_t k = i;
    for (; k > 0 && order[k - 1]->angle < each->angle; --k) order[k] = order[k - 1];
    order[k] = each;
  }
  const auto add = [&](const LoopVertex& at, float angle) {
    joint_ = at.joint;
    below_.push_back(
        {angle, vertex(at.position, {0, 0, 0}, picture_at(loop.radius, angle, at.reach), at.group)});
    mark_twin();
  };
  for (const LoopVertex* each : order) add(*each, -each->angle);
  add(*order.front(), 2 * pi - order.front()->angle);
  set_seam(below_.front().angle);
}

/// A limb that leans where it leaves the ground goes on straight down into it, to a level end: its first ring
/// as deep as its lowest corner. Returns where that end looks.
glm::vec3 GraftWriter::level_foot(Plane& plane) {
  const glm::vec3 along = axis_.along[0];
  const float sine = std::sqrt(along.x * along.x + along.z * along.z);
  if (sine < least_lean_of_foot || along.y < least_rise_of_foot) return -along;
  float lowest = plane.centre.y;
  for (const Corner& corner : below_) lowest = std::min(lowest, mesh_.position[corner.vertex].y);
  for (const Corner& corner : below_) {
    glm::vec3& at = mesh_.position[corner.vertex];
    const float down = (lowest - at.y) / along.y;
    at += along * down;
    at.y = lowest;
    mesh_.uv[0][corner.vertex].y = axis_.v_at(down, 0) * context_.options.v_scale + 0.0F;
  }
  plane.centre += along * ((lowest - plane.centre.y) / along.y);
  return {0, -1, 0};
}

/// Has the ends of a ring with ribs kept together, whose normals may be made anew.
void GraftWriter::note_seam(const Corners& ring) {
  if (has_ribs()) rib_seams_.emplace_back(ring.front().vertex, ring.back().vertex);
}

void GraftWriter::set_seam(float angle) {
  seam_ = angle;
  const math::SinCos turn = math::quick_sincos(static_cast<double>(angle));
  seam_turn_ = {static_cast<float>(turn.cos), static_cast<float>(turn.sin)};
}

}  // namespace seedmesh
