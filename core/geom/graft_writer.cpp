#include "core/geom/graft_writer.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/rng.h"

namespace seedmesh {
namespace {

constexpr float pi = static_cast<float>(math::pi);
// Corners fall with this power of the radius: a limb a tenth as thick as the trunk has half its corners.
constexpr double corner_power = 0.3;
// Ribs need at least so many corners each.
constexpr int corners_a_rib = 3;
// A limb that others leave has at least so many; and rings stand so much of the bulge from loops.
constexpr int least_opened_sides = 6;
constexpr float bulge_share = 1.2F;
// The cone that closes a limb inside its parent, and where it begins: shares of the radius.
constexpr float cap_share = 0.5F;
// Triangles between two rings follow the shorter diagonal as long as neither ring is ahead by more, in
// radians.
constexpr float most_lead = 0.5F;
// A child thinner than so many of the least radius is not worth an opening.
constexpr float least_opened = 3;
// Faces within this of a right angle to a normal count as looking against it; area as a share of the squared
// size.
constexpr float least_area = 4e-12F;

float fraction(std::uint64_t hash) { return static_cast<float>(hash >> 40U) * 0x1p-24F; }

std::vector<std::vector<glm::vec2>> circles_up_to(int most) {
  std::vector<std::vector<glm::vec2>> circles(static_cast<std::size_t>(most) + 1);
  for (int sides = 3; sides <= most; ++sides) {
    for (int i = 0; i < sides; ++i) {
      const math::SinCos at = math::sincos(2 * math::pi * i / sides);
      circles[static_cast<std::size_t>(sides)].emplace_back(static_cast<float>(at.cos),
                                                            static_cast<float>(at.sin));
    }
  }
  return circles;
}

}  // namespace

GraftWriter::GraftWriter(const Context& context, Job& job)
    : context_(context), job_(job), triangles_(job, Resource::triangles), group_(job), group_normal_(job) {
  const Limbs& limbs = context.limbs;
  mesh_.position = Array<glm::vec3>(job);
  mesh_.normal = Array<glm::vec3>(job);
  mesh_.uv[0] = Array<glm::vec2>(job);
  mesh_.index.wide = Array<std::uint32_t>(job);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] != Limbs::none) thickest_ = std::max(thickest_, limbs.base_radius[i]);
  }
  const std::size_t count = context.chains.head.size();
  circles_ = circles_up_to(
      2 * std::max({least_opened_sides, context.options.sides, corners_a_rib * context.options.lobes}));
  loops_.resize(count);
  first_child_.assign(limbs.size(), none);
  next_sibling_.assign(count, none);
  for (std::size_t i = count; i-- > 0;) {
    const std::uint32_t parent = limbs.parent[context.chains.head[i]];
    if (parent == Limbs::none) continue;
    next_sibling_[i] = first_child_[parent];
    first_child_[parent] = static_cast<std::uint32_t>(i);
  }
}

void GraftWriter::write_all() {
  const std::size_t count = context_.chains.head.size();
  for (std::size_t i = 0; i < count; ++i) {
    first_triangle_.push_back(static_cast<std::uint32_t>(mesh_.index.wide.size() / 3));
    if (i % 64 == 0) job_.check();
    if (context_.trust[i] != Trust::none) write_limb(static_cast<std::uint32_t>(i));
  }
  first_triangle_.push_back(static_cast<std::uint32_t>(mesh_.index.wide.size() / 3));
}

/// Three, or an even number, so that rings of different limbs meet corner to corner.
int GraftWriter::corners_for(float radius) const {
  const double share = static_cast<double>(std::min(1.0F, radius / std::max(thickest_, 1e-9F)));
  const int wanted =
      static_cast<int>(math::to_int32(context_.options.sides * math::pow(share, corner_power) + 0.5));
  return wanted <= 3 || wanted == context_.options.sides ? std::max(3, wanted) : wanted + wanted % 2;
}

int GraftWriter::sides_for(float radius) const {
  int sides = corners_for(radius);
  if (axis_.order == 0 && context_.options.lobes > 0)
    sides = std::max(sides, corners_a_rib * context_.options.lobes);
  sides = std::max(sides, least_sides_);
  // A limb keeps the corners of its loop until it is clearly thinner.
  return std::abs(sides - loop_sides_) <= 1 ? loop_sides_ : sides;
}

void GraftWriter::write_limb(std::uint32_t limb) {
  const Scale& scale = context_.scale;
  const std::uint32_t head = context_.chains.head[limb];
  if (!axis_.read(context_.limbs, context_.chains, head, scale.shortest)) return;
  if (axis_.radius[0] < std::max(2 * scale.thinnest, context_.options.thinnest)) return;
  for (float& radius : axis_.radius) radius = std::max(radius, 2 * scale.thinnest);
  const bool is_root = context_.limbs.parent[head] == Limbs::none;
  const Loop& loop = loops_[limb];
  const bool has_loop = loop.first != none;
  ++counts_.limbs;
  if (!is_root) ++(has_loop ? (loop.is_fork ? counts_.forks : counts_.collars) : counts_.closed);

  const std::uint64_t hash = key_at(context_.limbs.key.empty() ? head : context_.limbs.key[head], 0x62AF7);
  const float last_length = axis_.at.back() - axis_.at[axis_.at.size() - 2];
  const float end = axis_.radius.back();
  const float tip = axis_.length() - std::min(end, 0.3F * last_length);
  const float start = has_loop ? loop.reach : 0;
  if (start > tip - 8 * scale.apart) return;
  glm::vec3 first = any_aside(axis_.along[0]);
  if (has_loop) {
    first = loop.u;
  } else {
    const math::SinCos turn = math::sincos(static_cast<double>(fraction(hash)) * 2 * math::pi);
    first = first * static_cast<float>(turn.cos) +
            glm::cross(axis_.along[0], first) * static_cast<float>(turn.sin);
  }
  axis_.carry(first);
  least_sides_ = 3;
  loop_sides_ = has_loop ? static_cast<int>(loop.count) : 0;
  const float middle = axis_.radius_at(0.5F * axis_.length(), axis_.piece_at(0.5F * axis_.length(), 0));
  const int sides = std::max(least_opened_sides, sides_for(middle));
  plan_.begin(start, tip, scale.apart,
              bulge_share * (1 - circles_[static_cast<std::size_t>(2 * sides)][1].x));
  if (context_.trust[limb] <= Trust::detached) plan_children(start);
  if (!plan_.opening.empty()) least_sides_ = least_opened_sides;
  plan_.complete(axis_, has_loop && sides_for(axis_.radius[0]) > 4);
  if (has_loop) {
    begin_loop(loop);
  } else {
    begin_closed(is_root, limb);
  }
  for (const Band& band : plan_.band) write_band(band);
  write_tip(end);
}

Bud GraftWriter::bud_of(std::uint32_t child) const {
  const Limbs& limbs = context_.limbs;
  Bud bud;
  bud.limb = child;
  std::uint32_t joint = context_.chains.head[child];
  glm::vec3 from = limbs.position[limbs.parent[joint]];
  bud.radius = limbs.base_radius[joint];
  for (; joint != Limbs::none; joint = context_.chains.next[joint]) {
    const glm::vec3 step = limbs.position[joint] - from;
    const float length = std::sqrt(glm::dot(step, step));
    if (length <= context_.scale.shortest) continue;
    if (bud.length == 0) {
      bud.along = step * (1 / length);
      bud.first_length = length;
    }
    bud.length += length;
    from = limbs.position[joint];
    if (bud.length > 16 * bud.radius) break;
  }
  return bud;
}

void GraftWriter::plan_children(float start) {
  struct Wish {
    std::size_t point;
    Bud bud;
    bool is_thick;
  };
  std::vector<Wish> wishes;
  for (std::size_t point = 1; point + 1 < axis_.point.size(); ++point) {
    if (axis_.at[point] <= start) continue;
    for (std::uint32_t child = first_child_[axis_.joint[point]]; child != none;
         child = next_sibling_[child]) {
      if (context_.trust[child] != Trust::full) continue;
      Bud bud = bud_of(child);
      if (bud.length == 0 || bud.radius < least_opened * context_.scale.thinnest ||
          bud.radius < context_.options.thinnest)
        continue;
      bud.sides = corners_for(bud.radius);
      wishes.push_back({point, bud, bud.radius > 0.5F * axis_.radius[point]});
    }
  }
  // Thick ones first: a fork has one place only, a collar of a thin limb may give way.
  for (const bool thick : {true, false}) {
    for (const Wish& wish : wishes) {
      if (wish.is_thick == thick) plan_.open(axis_, wish.point, wish.bud);
    }
  }
}

GraftWriter::Plane GraftWriter::plane_at(float at, std::size_t piece) const {
  Plane plane;
  plane.at = at;
  plane.tangent = axis_.along[piece];
  plane.centre = axis_.point[piece] + plane.tangent * (at - axis_.at[piece]);
  plane.u = axis_.u[piece];
  plane.v = axis_.v(piece);
  const float length = axis_.at[piece + 1] - axis_.at[piece];
  plane.radius = axis_.radius_at(std::clamp(at, axis_.at[piece], axis_.at[piece + 1]), piece);
  plane.slope = (axis_.radius[piece] - axis_.radius[piece + 1]) / length;
  return plane;
}

GraftWriter::Plane GraftWriter::plane_of(const Band& band) const {
  Plane plane = plane_at(band.at, band.piece);
  if (!band.is_bend || band.piece == 0) return plane;
  const glm::vec3 &before = axis_.along[band.piece - 1], &after = axis_.along[band.piece];
  plane.tangent = math::unit(before + after, after);
  // Halfway back from the frame of the later piece: the least turn that takes its axis to the tangent.
  const float cosine = glm::dot(after, plane.tangent);
  glm::vec3 u = axis_.u[band.piece];
  u -= (after + plane.tangent) * (glm::dot(u, plane.tangent) / (1 + cosine));
  u -= plane.tangent * glm::dot(u, plane.tangent);
  plane.u = math::unit(u, any_aside(plane.tangent));
  plane.v = glm::cross(plane.tangent, plane.u);
  const float length = axis_.at[band.piece] - axis_.at[band.piece - 1];
  plane.slope = 0.5F * (plane.slope + (axis_.radius[band.piece - 1] - axis_.radius[band.piece]) / length);
  return plane;
}

/// The factor of the radius that ribs make.
float GraftWriter::ribbed(float angle) const {
  if (axis_.order != 0 || context_.options.lobes == 0) return 1;
  const double at = static_cast<double>(angle) * context_.options.lobes;
  return 1 + context_.options.lobe_depth * static_cast<float>(math::sin(at));
}

std::uint32_t GraftWriter::vertex(const glm::vec3& position, const glm::vec3& normal, glm::vec2 uv,
                                  std::uint32_t group) {
  const auto index = static_cast<std::uint32_t>(mesh_.position.size());
  mesh_.position.push_back(position + 0.0F);
  mesh_.normal.push_back(normal + 0.0F);
  mesh_.uv[0].push_back(glm::vec2(uv.x, uv.y * context_.options.v_scale) + 0.0F);
  group_.push_back(group);
  return index;
}

std::uint32_t GraftWriter::ring_corner(const Plane& plane, float angle, glm::vec2 direction) {
  const float factor = ribbed(angle);
  const glm::vec3 out = plane.u * direction.x + plane.v * direction.y;
  glm::vec3 normal = out + plane.tangent * plane.slope;
  if (factor != 1) {
    const double at = static_cast<double>(angle) * context_.options.lobes;
    const float fall = context_.options.lobe_depth * static_cast<float>(context_.options.lobes) *
                       static_cast<float>(math::cos(at)) / factor;
    normal -= (plane.v * direction.x - plane.u * direction.y) * fall;
  }
  return vertex(plane.centre + out * (plane.radius * factor), math::unit(normal, out),
                {plane.radius * angle, plane.at}, none);
}

/// The angle within half a turn of the seam.
float GraftWriter::by_seam(float angle) const {
  while (angle >= seam_ + pi) angle -= 2 * pi;
  while (angle < seam_ - pi) angle += 2 * pi;
  return angle;
}

std::uint32_t GraftWriter::group_for(const LoopPoint& point, std::uint32_t child) {
  const auto group = static_cast<std::uint32_t>(group_normal_.size());
  group_normal_.push_back(glm::vec3(0));  // of the parent's faces
  group_normal_.push_back(glm::vec3(0));  // of the child's
  group_limb_.push_back(child);
  loop_vertices_.push_back({point.position, point.phase, point.reach, group + 1});
  return group;
}

/// The vertex of a corner, beyond the seam or before it.
std::uint32_t GraftWriter::vertex_of(Mark& mark, const Plane& plane, bool is_beyond) {
  std::uint32_t& made = mark.vertex[is_beyond ? 1 : 0];
  if (made != none) return made;
  const float angle = mark.angle + (is_beyond ? 2 * pi : 0);
  if (mark.point) {
    const float height = std::clamp(mark.point->height, 0.0F, axis_.length());
    const float radius = axis_.radius_at(height, axis_.piece_at(height, 0));
    made = vertex(mark.point->position, {0, 0, 0}, {radius * angle, mark.point->height}, mark.group);
  } else {
    made = ring_corner(plane, angle, mark.direction);
  }
  return made;
}

/// One side of a ring in order, from the corner that is nearest to the seam all round to it again.
void GraftWriter::go_round(std::vector<std::uint32_t>& order, const Plane& plane, Corners& out) {
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return marks_[a].angle != marks_[b].angle ? marks_[a].angle < marks_[b].angle : a < b;
  });
  std::size_t start = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (std::abs(marks_[order[i]].angle - seam_) < std::abs(marks_[order[start]].angle - seam_)) start = i;
  }
  out.clear();
  for (std::size_t i = 0; i <= order.size(); ++i) {
    const std::size_t at = (start + i) % order.size();
    const bool is_beyond = at < start || i == order.size();
    Mark& mark = marks_[order[at]];
    out.push_back({mark.angle + (is_beyond ? 2 * pi : 0), vertex_of(mark, plane, is_beyond)});
  }
}

/// The corners of a ring that nothing leaves.
void GraftWriter::plain_ring(const Plane& plane, Corners& out) {
  const int sides = sides_for(plane.radius);
  const float step = 2 * pi / static_cast<float>(sides);
  const auto& circle = circles_[static_cast<std::size_t>(sides)];
  out.clear();
  for (int i = 0; i <= sides; ++i) {
    const glm::vec2 c = circle[static_cast<std::size_t>(i % sides)];
    const glm::vec2 direction{c.x * seam_turn_.x - c.y * seam_turn_.y,
                              c.x * seam_turn_.y + c.y * seam_turn_.x};
    const float angle = seam_ + step * static_cast<float>(i);
    out.push_back({angle, ring_corner(plane, angle, direction)});
  }
}

/// A ring that others leave: `lower_` for the strip below, `upper_` for the one above, which differ there.
void GraftWriter::open_ring(const Plane& plane, const Band& band) {
  marks_.clear();
  lower_order_.clear();
  upper_order_.clear();
  const int sides = sides_for(plane.radius);
  const float step = 2 * pi / static_cast<float>(sides);
  const auto& circle = circles_[static_cast<std::size_t>(sides)];
  const auto add = [&](const Mark& mark, bool below, bool above) {
    if (below) lower_order_.push_back(static_cast<std::uint32_t>(marks_.size()));
    if (above) upper_order_.push_back(static_cast<std::uint32_t>(marks_.size()));
    marks_.push_back(mark);
  };
  for (int i = 0; i < sides; ++i) {
    const float angle = by_seam(seam_ + step * static_cast<float>(i));
    const bool is_taken = std::any_of(band.openings.begin(), band.openings.end(), [&](std::uint32_t number) {
      const Opening& opening = plan_.opening[number];
      const float off = std::abs(by_seam(angle - opening.middle + seam_) - seam_);
      return off < opening.half + std::min(0.35F * step, 0.25F);
    });
    if (is_taken) continue;
    const glm::vec2 c = circle[static_cast<std::size_t>(i)];
    Mark mark;
    mark.angle = angle;
    mark.direction = {c.x * seam_turn_.x - c.y * seam_turn_.y, c.x * seam_turn_.y + c.y * seam_turn_.x};
    add(mark, true, true);
  }
  for (const std::uint32_t number : band.openings) {
    const Opening& opening = plan_.opening[number];
    Loop& loop = loops_[opening.limb];
    loop = {static_cast<std::uint32_t>(loop_vertices_.size()),
            0,
            opening.radius,
            opening.child_reach,
            opening.child_u,
            opening.is_fork};
    const auto put = [&](const LoopPoint& point, bool below, bool above) {
      Mark mark;
      mark.angle = by_seam(opening.middle + point.angle);
      mark.point = &point;
      mark.group = group_for(point, opening.limb);
      add(mark, below, above);
    };
    put(opening.first, true, true);
    put(opening.last, true, true);
    for (const LoopPoint& point : opening.lower) put(point, true, false);
    for (const LoopPoint& point : opening.upper) put(point, false, true);
    loop.count = static_cast<std::uint32_t>(loop_vertices_.size()) - loop.first;
  }
  go_round(lower_order_, plane, lower_);
  go_round(upper_order_, plane, upper_);
}

void GraftWriter::set_seam(float angle) {
  seam_ = angle;
  const math::SinCos turn = math::sincos(static_cast<double>(angle));
  seam_turn_ = {static_cast<float>(turn.cos), static_cast<float>(turn.sin)};
}

void GraftWriter::begin_closed(bool is_root, std::uint32_t limb) {
  set_seam(0);
  const std::uint32_t head = context_.chains.head[limb];
  const std::uint64_t hash = key_at(context_.limbs.key.empty() ? head : context_.limbs.key[head], 0x0C10);
  Plane plane = plane_at(0, 0);
  const glm::vec3 along = axis_.along[0];
  if (is_root) {
    plane.slope = 0;
    plain_ring(plane, below_);
    const std::uint32_t centre = vertex(plane.centre, -along, {0, 0}, none);
    std::vector<std::uint32_t> rim;
    for (std::size_t i = 0; i + 1 < below_.size(); ++i) {
      const glm::vec3 at = mesh_.position[below_[i].vertex];
      const glm::vec3 off = at - plane.centre;
      rim.push_back(vertex(at, -along, {glm::dot(off, plane.u), glm::dot(off, plane.v)}, none));
    }
    for (std::size_t i = 0; i < rim.size(); ++i) triangle(centre, rim[(i + 1) % rim.size()], rim[i]);
    return;
  }
  // Rings of limbs that begin at one place are kept apart by chance.
  const float back = (0.05F + 0.4F * fraction(hash)) * plane.radius + context_.scale.apart;
  plane.centre -= along * back;
  plane.at = -back;
  plane.slope = -0.5F;
  plain_ring(plane, below_);
  const float cone = cap_share * plane.radius;
  const std::uint32_t apex =
      vertex(plane.centre - along * cone, -along, {pi * plane.radius, -back - cone}, none);
  for (std::size_t i = 0; i + 1 < below_.size(); ++i) triangle(apex, below_[i + 1].vertex, below_[i].vertex);
}

void GraftWriter::begin_loop(const Loop& loop) {
  // The child's angles run the other way round than the phases of its loop.
  below_.clear();
  std::vector<const LoopVertex*> order;
  for (std::uint32_t i = 0; i < loop.count; ++i) order.push_back(&loop_vertices_[loop.first + i]);
  std::sort(order.begin(), order.end(),
            [](const LoopVertex* a, const LoopVertex* b) { return a->angle > b->angle; });
  const auto add = [&](const LoopVertex& at, float angle) {
    below_.push_back({angle, vertex(at.position, {0, 0, 0}, {loop.radius * angle, at.reach}, at.group)});
  };
  for (const LoopVertex* each : order) add(*each, -each->angle);
  add(*order.front(), 2 * pi - order.front()->angle);
  set_seam(below_.front().angle);
}

void GraftWriter::write_band(const Band& band) {
  if (band.openings.empty()) {
    plain_ring(plane_of(band), upper_);
    strip(below_, upper_);
  } else {
    open_ring(plane_of(band), band);
    strip(below_, lower_);
  }
  std::swap(below_, upper_);
}

void GraftWriter::write_tip(float end_radius) {
  const glm::vec3 along = axis_.along.back();
  const std::uint32_t apex =
      vertex(axis_.point.back(), along, {pi * end_radius + seam_ * end_radius, axis_.length()}, none);
  for (std::size_t i = 0; i + 1 < below_.size(); ++i) triangle(below_[i].vertex, below_[i + 1].vertex, apex);
}

/// Triangles between two rings, by rising angle.
void GraftWriter::strip(const Corners& below, const Corners& above) {
  std::size_t i = 0, j = 0;
  const auto apart = [&](const Corner& a, const Corner& b) {
    const glm::vec3 between = mesh_.position[a.vertex] - mesh_.position[b.vertex];
    return glm::dot(between, between);
  };
  while (i + 1 < below.size() || j + 1 < above.size()) {
    // The shorter diagonal, unless one side has fallen far behind.
    bool take_below = j + 1 == above.size();
    if (i + 1 < below.size() && j + 1 < above.size()) {
      const float lead = below[i + 1].angle - above[j + 1].angle;
      take_below = std::abs(lead) > most_lead ? lead < 0
                                              : apart(below[i + 1], above[j]) < apart(below[i], above[j + 1]);
    }
    if (take_below) {
      triangle(below[i].vertex, below[i + 1].vertex, above[j].vertex);
      ++i;
    } else {
      triangle(below[i].vertex, above[j + 1].vertex, above[j].vertex);
      ++j;
    }
  }
}

void GraftWriter::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  triangles_.spend();
  std::uint32_t* out = mesh_.index.wide.extend(3);
  out[0] = a;
  out[1] = b;
  out[2] = c;
}

std::size_t GraftWriter::settle(std::vector<Trust>& trust, bool is_late) {
  const auto& index = mesh_.index.wide;
  const auto& position = mesh_.position;
  const auto face = [&](std::size_t t) {
    const glm::vec3 &a = position[index[3 * t]], &b = position[index[3 * t + 1]],
                    &c = position[index[3 * t + 2]];
    return glm::cross(b - a, c - a);
  };
  const std::size_t count = index.size() / 3;
  if (!loop_vertices_.empty()) {
    for (std::size_t t = 0; t < count; ++t) {
      const std::uint32_t groups[3] = {group_[index[3 * t]], group_[index[3 * t + 1]],
                                       group_[index[3 * t + 2]]};
      if ((groups[0] & groups[1] & groups[2]) == none) continue;
      const glm::vec3 normal = face(t);
      const float size = std::sqrt(glm::dot(normal, normal));
      if (!(size > 0)) continue;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        if (groups[corner] == none) continue;
        // By the angle of the face there, so that it does not matter how the surface is cut into triangles.
        const glm::vec3& here = position[index[3 * t + corner]];
        const glm::vec3 one = position[index[3 * t + (corner + 1) % 3]] - here;
        const glm::vec3 other = position[index[3 * t + (corner + 2) % 3]] - here;
        const auto angle = static_cast<float>(
            math::atan2(static_cast<double>(size), static_cast<double>(glm::dot(one, other))));
        group_normal_[groups[corner]] += normal * (angle / size);
      }
    }
    for (std::size_t i = 0; i < group_.size(); ++i) {
      if (group_[i] == none) continue;
      // The mean of both surfaces, whatever the size of their faces.
      const std::size_t parent = group_[i] & ~std::uint32_t{1};
      const glm::vec3 one = math::unit(group_normal_[parent], glm::vec3{0});
      const glm::vec3 other = math::unit(group_normal_[parent + 1], glm::vec3{0});
      mesh_.normal[i] = math::unit(one + other, glm::vec3{0, 1, 0}) + 0.0F;
    }
  }
  const float least = 2 * least_area * context_.scale.size * context_.scale.size;
  std::size_t bad = 0;
  for (std::size_t limb = 0; limb + 1 < first_triangle_.size(); ++limb) {
    if (limb % 64 == 0) job_.check();
    bool is_bad = false;
    for (std::size_t t = first_triangle_[limb]; t < first_triangle_[limb + 1]; ++t) {
      const glm::vec3 normal = face(t);
      bool is_sound = glm::dot(normal, normal) > least * least;
      for (std::size_t corner = 0; is_sound && corner < 3; ++corner)
        is_sound = glm::dot(normal, mesh_.normal[index[3 * t + corner]]) > 0;
      if (is_sound) continue;
      // The fault of the openings that it touches, if it touches any.
      bool touches = false;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t group = group_[index[3 * t + corner]];
        if (group == none) continue;
        touches = true;
        Trust& child = trust[group_limb_[group / 2]];
        child = std::max(child, is_late ? Trust::closed : Trust::detached);
      }
      is_bad = is_bad || !touches;
      ++bad;
    }
    if (!is_bad) continue;
    trust[limb] = trust[limb] < Trust::closed && !is_late ? Trust::closed : Trust::none;
  }
  return bad;
}

}  // namespace seedmesh
