#include "core/geom/plant/tube_writer.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/rng.h"

namespace seedmesh {
namespace {

// Two rings of a column eight quads wide take 10 entries of the 16 that the smallest vertex caches have.
// Where a column begins with an empty cache its first two rings are loaded alternately, and only six quads
// fit.
constexpr std::uint32_t widest_column = 8, widest_cold_column = 6;
// A tube starts with one of the square of this number of angles: a coarse angle turned by a fine one.
constexpr std::uint32_t phase_count = 64;
// The limit of v for each metre, relative to the beginning of the limb: at a tip the texture would shrink to
// nothing.
constexpr float most_rate = 4;

glm::vec2 slope_of(float radius, float next_radius, float length) {
  const float drop = radius - next_radius;
  if (drop == 0) return {1, 0};
  const float by_flank = 1 / std::sqrt(length * length + drop * drop);
  return {length * by_flank, drop * by_flank};
}

glm::vec2 circle_point(double angle) {
  const math::SinCos at = math::sincos(angle);
  return {static_cast<float>(at.cos), static_cast<float>(at.sin)};
}

std::vector<TubeTables::Column> columns_of(const CrossSection& section, std::uint32_t widest) {
  std::vector<TubeTables::Column> columns;
  const std::uint32_t count = (section.sides + widest - 1) / widest;
  for (std::uint32_t i = 0; i < count; ++i) {
    TubeTables::Column column;
    for (std::uint32_t k = i * section.sides / count; k < (i + 1) * section.sides / count; ++k) {
      const std::uint32_t low = k, low_next = (k + 1) % section.corners;
      const std::uint32_t high = low + section.corners, high_next = low_next + section.corners;
      for (std::uint32_t corner : {low, low_next, high, low_next, high_next, high}) column.push_back(corner);
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

}  // namespace

TubeTables::TubeTables(const CrossSection& section, std::span<const Contour> outlines)
    : columns(columns_of(section, widest_column)), narrow_columns(columns_of(section, widest_cold_column)) {
  for (std::uint32_t i = 0; i < section.sides; ++i)
    circle.push_back(circle_point(2 * math::pi * i / section.sides));
  if (!outlines.empty()) contours.push_back(corners_of_circle(section.sides));
  for (const Contour& outline : outlines) contours.push_back(corners_of(outline, section.sides));
  half_side = circle_point(math::pi / section.sides);
  const double side = 2 * math::pi / section.sides;
  for (std::uint32_t i = 0; i < phase_count; ++i) {
    coarse_phases.push_back(circle_point(side * (i + 0.5) / phase_count));
    fine_phases.push_back(circle_point(side * i / (phase_count * phase_count)));
  }
}

/// u half way around a ring.
float TubeWriter::half_round(float radius) const {
  return context_.options.wrap ? 0.5F * turns_ : static_cast<float>(math::pi) * radius;
}

std::uint64_t TubeWriter::hash_of(std::uint32_t joint) const {
  return key_at(context_.limbs.key.empty() ? joint : context_.limbs.key[joint], 0x5EA3);
}

/// A small length, different for every joint, by which rings of tubes with a common beginning are moved
/// apart.
float TubeWriter::nudge(std::uint64_t hash, float radius) const {
  return (1 + 8 * fraction_of(hash)) * std::max(0.05F * radius, context_.scale.apart);
}

void TubeWriter::start_frame(const glm::vec3& along, std::uint64_t hash) {
  const glm::vec3 u = unit_perpendicular(along);
  const TubeTables& angles = context_.tables[finest_sides_];
  const auto both = [](const glm::vec2& one, const glm::vec2& other) {
    return glm::vec2{one.x * other.x - one.y * other.y, one.x * other.y + one.y * other.x};
  };
  glm::vec2 phase =
      both(angles.coarse_phases[hash % phase_count], angles.fine_phases[hash / phase_count % phase_count]);
  // Corners of half the number of sides lie where the finest level has the middles of sides.
  if (section_.sides != finest_sides_) phase = both(phase, angles.half_side);
  u_ = u * phase.x + glm::cross(along, u) * phase.y;
}

TubeWriter::Ring TubeWriter::plain_ring(const glm::vec3& centre, float radius, float v) const {
  Ring ring;
  ring.centre = centre;
  ring.tangent = internode_.along;
  ring.normal_u = u_;
  ring.normal_v = glm::cross(internode_.along, u_);
  ring.side_u = ring.normal_u * radius;
  ring.side_v = ring.normal_v * radius;
  ring.radius = radius;
  ring.v = v;
  ring.joint = internode_.joint;
  ring.next_color = internode_.color;
  ring.contour = last_contour(internode_.joint);
  ring.spin = spin_;
  return ring;
}

void TubeWriter::begin_piece(std::int16_t color) {
  here_ = &cursors_[context_.palette.slot(color)];
  piece_ = {here_->vertex, 0, Limbs::none, Limbs::none};
  is_ring_turned_.clear();
}

/// Sets v for each metre of an internode.
void TubeWriter::set_texture_rate(const Internode& internode) {
  if (!context_.options.wrap) return;
  const auto round = static_cast<float>(2 * math::pi);
  if (turns_ == 0) {
    turns_ = texture_repeats(internode.base, context_.options.least_repeats);
    first_v_per_metre_ = turns_ / (round * std::max(internode.base, context_.scale.thinnest));
  }
  const float radius = std::max(0.5F * (internode.base + internode.end), context_.scale.thinnest);
  const float first = turns_ / (round * first_v_per_metre_);
  const float mean = texture_radius(radius, first, context_.options.least_repeats);
  v_per_metre_ = std::min(turns_ / (round * mean), most_rate * first_v_per_metre_);
}

void TubeWriter::open(const Internode& first, TubeOpening opening) {
  internode_ = first;
  radius_ = first.base;
  reach_ = 0;
  set_texture_rate(first);
  begin_piece(first.color);
  is_turned_ = false;
  const std::uint64_t hash = hash_of(first.first);
  start_frame(first.along, hash);
  if (has_contours() && !context_.limbs.frame.empty()) u_ = first_side(context_.limbs, first);
  first_u_ = u_;
  twist_ = 1;
  spin_ = 0;
  has_pending_ring_ = opening != TubeOpening::point;
  switch (opening) {
    case TubeOpening::point:
      radius_ = 0;
      // Points may share a position, but not all attributes of a vertex, which would then be in the mesh
      // twice.
      piece_.start_apex = write_apex(first.from - first.along * nudge(hash, 0), -first.along, {0, v_so_far_});
      break;
    case TubeOpening::root: {
      const bool is_revisit = context_.chains.mark[context_.limbs.parent[first.first]] & revisit;
      const float up = is_revisit ? std::min(nudge(hash, radius_), 0.2F * first.length) : 0;
      pending_ring_ = plain_ring(first.from + first.along * up, radius_, v_so_far_);
      pending_ring_.contour = first_contour(first.joint);
      if (begins_flat(context_.options)) {
        write_flat(pending_ring_, -1);
      } else {
        write_disc(pending_ring_);
      }
      break;
    }
    case TubeOpening::branch: {
      const float back = nudge(hash, radius_), cone = cap_share * radius_;
      pending_ring_ = plain_ring(first.from - first.along * back, radius_, v_so_far_ - back * v_per_metre_);
      pending_ring_.contour = first_contour(first.joint);
      if (begins_flat(context_.options)) {
        write_flat(pending_ring_, -1);
        break;
      }
      pending_ring_.before = slope_of(0, radius_, cone);
      piece_.start_apex = write_apex(pending_ring_.centre - first.along * cone, -first.along,
                                     {half_round(radius_), pending_ring_.v - cone * v_per_metre_});
      break;
    }
  }
  piece_.first_ring = here_->vertex;
}

void TubeWriter::join(const Turn& turn, const Internode& next) {
  const glm::vec3 &along = internode_.along, &tangent = turn.tangent;
  const Slope slope = slope_of(radius_, next.base, internode_.length);
  write_pending_ring(slope);
  write_inner_rings({next.base, internode_.length, reach_, internode_.length - turn.reach});

  v_so_far_ += internode_.length * v_per_metre_;
  Ring ring;
  ring.centre = internode_.to;
  if (context_.chains.mark[internode_.joint] & revisit) {
    const std::uint64_t hash = hash_of(internode_.joint);
    ring.centre += tangent * std::min(nudge(hash, next.base), (0.004F + 0.004F * fraction_of(hash)) *
                                                                  std::min(internode_.length, next.length));
  }
  const glm::vec3 v = glm::cross(along, u_);
  const float mitre = 1 / turn.cosine, half = 1 / (1 + turn.cosine);
  const float u_lean = glm::dot(u_, tangent), v_lean = glm::dot(v, tangent);
  ring.side_u = (u_ - along * (u_lean * mitre)) * next.base;
  ring.side_v = (v - along * (v_lean * mitre)) * next.base;
  ring.normal_u = u_ - (along + tangent) * (u_lean * half);
  ring.normal_v = v - (along + tangent) * (v_lean * half);
  ring.tangent = tangent;
  ring.radius = next.base;
  ring.v = v_so_far_;
  ring.joint = internode_.joint;  // the older one: the younger is a point there before it grows
  ring.before = slope;
  ring.next_color = next.color;
  ring.contour = last_contour(internode_.joint);
  ring.spin = spin_;
  ring.is_turned = is_turned_;
  pending_ring_ = ring;
  has_pending_ring_ = true;

  u_ = carried(u_, along, turn, next.along);
  internode_ = next;
  radius_ = next.base;
  reach_ = turn.reach;
  twist(u_);
  set_texture_rate(next);
}

void TubeWriter::close(TubeClosing closing, float free) {
  const glm::vec3 along = internode_.along;
  const float end = closing == TubeClosing::point ? 0 : internode_.end;
  const std::uint64_t hash = hash_of(internode_.joint);
  const bool is_flat = closing != TubeClosing::point && ends_flat(context_.options, section_.sides);
  const float tip = is_flat ? flat_tip_length(end, free) : tip_length(end, free);
  const float cone = closing == TubeClosing::tip ? tip : cap_share * end;
  const float ring_at = closing == TubeClosing::tip ? internode_.length - cone : internode_.length;
  const Slope slope = slope_of(radius_, end, ring_at);
  spin_ *= internode_.length / ring_at;  // the whole twist is before the cone
  write_pending_ring(slope);
  write_inner_rings({end, ring_at, reach_, ring_at});

  v_so_far_ += internode_.length * v_per_metre_;
  glm::vec3 apex = internode_.to;
  if (context_.chains.mark[internode_.joint] & revisit) apex += along * nudge(hash, 0);
  if (closing != TubeClosing::point) {
    const bool is_revisit = context_.chains.mark[internode_.joint] & revisit;
    const float nudged = closing == TubeClosing::cap ? nudge(hash, end)
                         : is_revisit                ? -0.25F * cone * fraction_of(hash)
                                                     : 0;
    Ring ring = plain_ring(internode_.from + along * (ring_at + nudged), end,
                           v_so_far_ - (internode_.length - ring_at) * v_per_metre_);
    ring.before = slope;
    ring.is_turned = is_turned_;
    if (closing == TubeClosing::cap) apex = ring.centre + along * cone;
    // The normals of a twisted flank that lean down would face away from faces that lean up with the cone.
    write_ring(ring, is_flat || is_twisted(twist_) ? slope : slope_of(end, 0, cone));
    if (is_flat) {
      write_flat(ring.is_turned ? turned(ring) : ring, 1);
      end_piece();
      return;
    }
  }
  const float v = closing == TubeClosing::cap ? v_so_far_ + cone * v_per_metre_ : v_so_far_;
  piece_.end_apex = write_apex(apex, along, {half_round(end), v});
  end_piece();
}

void TubeWriter::write_pending_ring(Slope after) {
  if (!has_pending_ring_) return;
  has_pending_ring_ = false;
  write_ring(pending_ring_, after);
  if (&cursors_[context_.palette.slot(pending_ring_.next_color)] == here_) return;
  end_piece();
  begin_piece(pending_ring_.next_color);
  write_ring(pending_ring_, after);
}

void TubeWriter::write_inner_rings(const Taper& taper) {
  const int count =
      inner_rings(context_.options, context_.scale, {radius_, taper.end}, taper.high - taper.low, twist_);
  const Slope slope = slope_of(radius_, taper.end, taper.length);
  const float way = (taper.high - taper.low) / static_cast<float>(count + 1);
  const glm::vec3 last_u = u_;
  for (int i = 1; i <= count; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(count + 1);
    const float at = taper.low + (taper.high - taper.low) * share;
    // By the free length only: on the inner side of a bend the whole change of radius is there.
    const float radius = radius_ + (taper.end - radius_) * share;
    if (twist_ < 1) {
      u_ = first_u_ + (last_u - first_u_) * (at / taper.length);
      u_ *= 1 / std::sqrt(glm::dot(u_, u_));
    }
    Ring ring = plain_ring(internode_.from + internode_.along * at, radius, v_so_far_ + at * v_per_metre_);
    turn_on(way, std::max(radius_, taper.end));
    ring.is_turned = is_turned_;
    ring.before = slope;
    ring.next_contour = ring.contour;
    ring.contour = first_contour(internode_.joint);
    if (ring.contour != ring.next_contour) ring.blend = at / taper.length;
    write_ring(ring, slope);
  }
  u_ = last_u;
  turn_on(way, std::max(radius_, taper.end));
}

void TubeWriter::write_ring(const Ring& ring, Slope after) {
  if (ring.is_turned) return write_ring(turned(ring), after);
  Slope slope = after;
  if (ring.before != after) {
    const Slope both = ring.before + after;
    slope = both * (1 / std::sqrt(glm::dot(both, both)));
  }
  if (has_contours()) {
    piece_.is_twisted = piece_.is_twisted || is_twisted(twist_);
    write_contour(ring, slope);
    write_bones(here_->vertex, section_.corners, ring.joint);
    here_->vertex += section_.corners;
    ++piece_.rings;
    return;
  }
  // Adding 0 makes -0 a 0, here for all corners at once: a sum that does not begin with -0 is never -0.
  const glm::vec3 centre = ring.centre + 0.0F;
  const glm::vec3 lean = ring.tangent * slope.y + 0.0F;
  const glm::vec3 normal_u = ring.normal_u * slope.x, normal_v = ring.normal_v * slope.x;
  const std::size_t first = here_->vertex;
  glm::vec3* position = here_->position + first;
  glm::vec3* normal = here_->normal + first;
  const glm::vec2* circle = tables().circle.data();
  for (std::uint32_t k = 0; k < section_.sides; ++k) {
    const glm::vec2 at = circle[k];
    position[k] = (centre + ring.side_u * at.x) + ring.side_v * at.y;
    normal[k] = (lean + normal_u * at.x) + normal_v * at.y;
  }
  if (here_->uv) {
    position[section_.sides] = position[0];
    normal[section_.sides] = normal[0];
    const float step = (context_.options.wrap ? turns_ : static_cast<float>(2 * math::pi) * ring.radius) /
                       static_cast<float>(section_.sides);
    const float v = ring.v + 0.0F;
    glm::vec2* uv = here_->uv + first;
    const float first_u = step * ring.sides_on;
    for (std::uint32_t k = 0; k <= section_.sides; ++k) uv[k] = {first_u + step * static_cast<float>(k), v};
  }
  write_bones(first, section_.corners, ring.joint);
  here_->vertex += section_.corners;
  ++piece_.rings;
  if (section_.sides != finest_sides_) is_ring_turned_.push_back(ring.sides_on > 0);
}

std::uint32_t TubeWriter::write_apex(const glm::vec3& position, const glm::vec3& normal, glm::vec2 uv) {
  const std::size_t at = here_->vertex++;
  here_->position[at] = position + 0.0F;
  here_->normal[at] = normal + 0.0F;
  if (here_->uv) here_->uv[at] = uv + 0.0F;
  write_bones(at, 1, internode_.joint);
  return static_cast<std::uint32_t>(at);
}

void TubeWriter::write_bones(std::size_t first, std::size_t count, std::uint32_t joint) {
  if (here_->bone) std::fill_n(here_->bone + first, count, context_.options.bones[joint]);
}

void TubeWriter::end_piece() {
  const std::size_t first_corner = here_->corner;
  std::uint32_t* out = here_->index + here_->corner;
  const std::size_t last_ring = piece_.first_ring + std::size_t{piece_.rings - 1} * section_.corners;
  const bool is_warm = piece_.start_apex != Limbs::none;
  for (const TubeTables::Column& column : is_warm ? tables().columns : tables().narrow_columns) {
    const std::size_t size = column.size();
    const std::uint32_t* corners = column.data();
    if (piece_.start_apex != Limbs::none) {
      for (std::size_t i = 0; i < size; i += 6) {
        *out++ = piece_.start_apex;
        *out++ = static_cast<std::uint32_t>(piece_.first_ring) + corners[i + 1];
        *out++ = static_cast<std::uint32_t>(piece_.first_ring) + corners[i];
      }
    }
    for (std::size_t ring = piece_.first_ring; ring != last_ring; ring += section_.corners) {
      const auto base = static_cast<std::uint32_t>(ring);
      for (std::size_t i = 0; i < size; ++i) out[i] = base + corners[i];
      out += size;
    }
    if (piece_.end_apex != Limbs::none) {
      for (std::size_t i = 0; i < size; i += 6) {
        *out++ = static_cast<std::uint32_t>(last_ring) + corners[i];
        *out++ = static_cast<std::uint32_t>(last_ring) + corners[i + 1];
        *out++ = piece_.end_apex;
      }
    }
  }
  here_->corner = static_cast<std::size_t>(out - here_->index);
  if (piece_.is_twisted) split_by_shorter(first_corner);
  if (!is_ring_turned_.empty()) split_by_turns(first_corner);
}

}  // namespace seedmesh
