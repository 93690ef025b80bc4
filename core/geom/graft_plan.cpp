#include "core/geom/graft_plan.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

constexpr float pi = static_cast<float>(math::pi);
// Two openings of one ring, or of two that reach past each other, stay so far apart: radians.
constexpr float least_gap = 0.2F;
// Limbs from this share of their parent's radius on want a fork rather than a collar.
constexpr float fork_share = 0.55F, least_fork_share = 0.4F;
// Rings are kept where the axis has turned by more than 9 degrees since the last, or the radius is off by so
// much.
constexpr float straight = 0.9877F, radius_off = 0.05F;
// Where every bend is wanted: by half a degree.
constexpr float all_but_straight = 0.99996F, all_but_even = 0.005F;
// An end thinner than this share of the ring before it may be a point.
constexpr float pointed_share = 0.5F;
// Joints of one whorl may differ by this share of their extent and still lie on one ring.
constexpr float same_ring = 0.2F;

float apart_on_circle(float a, float b) {
  float difference = std::abs(a - b);
  while (difference > 2 * pi) difference -= 2 * pi;
  return std::min(difference, 2 * pi - difference);
}

bool overlap(const Opening& a, const Opening& b) {
  return apart_on_circle(a.middle, b.middle) < a.half + b.half + least_gap;
}

}  // namespace

void GraftPlan::begin(float start, float tip, float apart, float bulge) {
  opening.clear();
  loop_point.clear();
  band.clear();
  refused.clear();
  start_ = start;
  tip_ = tip;
  apart_ = apart;
  bulge_ = bulge;
}

float GraftPlan::margin(const GraftAxis& axis, float at, std::size_t near) const {
  return std::max(4 * apart_, bulge_ * axis.radius_at(at, axis.first_piece_at(at, near)));
}

bool GraftPlan::joins(const Opening& wanted, const Band& there) const {
  if (std::abs(wanted.at - there.at) > same_ring * (wanted.high - wanted.low)) return false;
  return !any_on(there, [&](const Opening& other) { return overlap(wanted, other); });
}

/// Does it fit between the bands before and at `place`?
bool GraftPlan::fits(const GraftAxis& axis, const Opening& wanted, std::size_t place) const {
  const float margin =
      std::max(this->margin(axis, wanted.at, wanted.piece), 0.12F * (wanted.high - wanted.low));
  if (wanted.low < start_ + margin || wanted.high > tip_ - margin) return false;
  const auto crosses = [&](const Band& there) {
    return any_on(there, [&](const Opening& other) { return overlap(wanted, other); });
  };
  if (place > 0) {
    const Band& before = band[place - 1];
    if (wanted.low < before.at + margin || before.high > wanted.at - margin) return false;
    if (wanted.low < before.high + margin && crosses(before)) return false;
  }
  if (place < band.size()) {
    const Band& after = band[place];
    if (wanted.high > after.at - margin || after.low < wanted.at + margin) return false;
    if (wanted.high > after.low - margin && crosses(after)) return false;
  }
  return true;
}

bool GraftPlan::open(const GraftAxis& axis, std::size_t at_point, Bud bud) {
  const float share = bud.radius / axis.radius[at_point];
  std::optional<Opening> wanted;
  const std::size_t points = loop_point.size();
  const auto fork = [&] {
    Bud even = bud;
    even.sides = std::max(4, bud.sides + bud.sides % 2);
    loop_point.resize(points);
    return fork_at(axis, at_point, even, loop_point);
  };
  if (share >= fork_share) wanted = fork();
  if (wanted && leaves_room(*wanted, bud) && put(axis, at_point, *wanted)) return true;
  const bool has_forked = share >= fork_share;
  loop_point.resize(points);
  wanted = collar(axis, at_point, bud, loop_point);
  if (!wanted && share >= least_fork_share && !has_forked) wanted = fork();
  return wanted && leaves_room(*wanted, bud) && put(axis, at_point, *wanted);
}

void GraftPlan::add(Band& there, const Opening& wanted) {
  const auto number = static_cast<std::uint32_t>(opening.size());
  (there.is_open() ? opening[there.last].next : there.first) = number;
  there.last = number;
  opening.push_back(wanted);
}

/// On a ring that is there, or on one of its own. False: there is no room.
bool GraftPlan::put(const GraftAxis& axis, std::size_t at_point, const Opening& wanted) {
  const auto after = std::lower_bound(band.begin(), band.end(), wanted.at,
                                      [](const Band& there, float at) { return there.at < at; });
  auto place = static_cast<std::size_t>(after - band.begin());
  if (!wanted.is_fork) {
    for (std::size_t near = place > 0 ? place - 1 : 0; near < std::min(place + 1, band.size()); ++near) {
      Band& there = band[near];
      if (there.is_bend || !joins(wanted, there)) continue;
      const float margin = this->margin(axis, wanted.at, wanted.piece);
      const bool has_room = wanted.low > (near > 0 ? band[near - 1].high : start_) + margin &&
                            wanted.high < (near + 1 < band.size() ? band[near + 1].low : tip_) - margin;
      if (!has_room) continue;
      there.low = std::min(there.low, wanted.low);
      there.high = std::max(there.high, wanted.high);
      add(there, wanted);
      return true;
    }
  }
  if (!fits(axis, wanted, place)) return false;
  Band made;
  made.at = wanted.at;
  made.low = wanted.low;
  made.high = wanted.high;
  made.is_bend = wanted.is_fork;
  made.piece = wanted.is_fork ? at_point : axis.piece_at(wanted.at, wanted.piece);
  add(made, wanted);
  band.insert(band.begin() + static_cast<std::ptrdiff_t>(place), made);
  return true;
}

void GraftPlan::complete(const GraftAxis& axis, bool has_first, const GraftOptions& options) {
  const float most_turn = options.every_bend ? all_but_straight : straight;
  const float most_off = options.every_bend ? all_but_even : radius_off;
  std::vector<Band>& all = all_;
  all.clear();
  std::size_t next = 0;
  float high = start_;
  glm::vec3 heading = axis.along[0];
  const auto plain = [](float at, std::size_t piece, bool is_bend) {
    Band ring;
    ring.at = ring.low = ring.high = at;
    ring.piece = piece;
    ring.is_bend = is_bend;
    return ring;
  };
  const auto take_openings = [&](float before) {
    for (; next < band.size() && band[next].at <= before; ++next) {
      high = band[next].high;
      heading = axis.along[band[next].piece];
      all.push_back(band[next]);
    }
  };
  if (has_first) {
    const float limit = band.empty() ? tip_ : band.front().low;
    const float at =
        start_ + std::min(0.5F * axis.radius_at(start_, axis.piece_at(start_, 0)), 0.4F * (limit - start_));
    if (at > start_ + 4 * apart_ && at < limit - 4 * apart_) {
      all.push_back(plain(at, axis.piece_at(at, 0), false));
      high = at;
    }
  }
  for (std::size_t point = 1; point < axis.pieces(); ++point) {
    const float at = axis.at[point];
    take_openings(at);
    if (!all.empty() && all.back().at == at) continue;
    const float last_at = all.empty() ? start_ : all.back().at;
    const float last_radius = axis.radius_at(last_at, axis.first_piece_at(last_at, point));
    const float share = (at - last_at) / (axis.at[point + 1] - last_at);
    const float between = last_radius + (axis.radius[point + 1] - last_radius) * share;
    const bool turns = glm::dot(heading, axis.along[point]) < most_turn;
    if (!turns && !axis.is_border(point) &&
        std::abs(between - axis.radius[point]) < most_off * axis.radius[point])
      continue;
    const float sine = std::sqrt(
        std::max(0.0F, 1 - glm::dot(heading, axis.along[point]) * glm::dot(heading, axis.along[point])));
    const float clear = std::max(margin(axis, at, point), 0.5F * axis.radius[point] * sine);
    const float low = next < band.size() ? band[next].low : tip_;
    if (at < high + clear || at > low - clear) continue;
    all.push_back(plain(at, point, true));
    heading = axis.along[point];
    high = at;
  }
  take_openings(tip_);
  const float last_at = all.empty() ? start_ : all.back().at;
  const float last_radius = axis.radius_at(last_at, axis.first_piece_at(last_at, axis.pieces() - 1));
  if (!options.pointed || axis.radius.back() > pointed_share * last_radius)
    all.push_back(plain(tip_, axis.pieces() - 1, false));
  std::swap(band, all);
}

}  // namespace seedmesh
