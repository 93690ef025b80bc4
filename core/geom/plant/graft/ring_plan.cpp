#include "core/geom/plant/graft/ring_plan.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

constexpr float pi = static_cast<float>(math::pi);
// The least angle between two junctions on one ring, or on two rings whose junctions overlap in height;
// radians.
constexpr float least_gap = 0.2F;
// A child below this share of its parent's radius gets no fork even where a collar finds no room.
constexpr float least_fork_share = 0.4F;
// The limits of GraftOptions::every_bend, instead of straight_cosine (half a degree) and radius_tolerance.
constexpr float every_bend_cosine = 0.99996F, every_bend_tolerance = 0.005F;
// An end thinner than this share of the ring before it may be a point.
constexpr float pointed_share = 0.5F;
// Junctions of one whorl share a ring where their positions differ by at most this share of their extent.
constexpr float same_ring = 0.2F;

float angle_between(float a, float b) {
  float difference = std::abs(a - b);
  while (difference > 2 * pi) difference -= 2 * pi;
  return std::min(difference, 2 * pi - difference);
}

template <class Test>
bool any_on(const RingPlan& plan, const PlannedRing& ring, const Test& test) {
  for (std::uint32_t i = ring.first; i != Junction::none; i = plan.junction[i].next) {
    if (test(plan.junction[i])) return true;
  }
  return false;
}

bool overlaps_any_on(const RingPlan& plan, const PlannedRing& ring, const Junction& wanted) {
  return any_on(plan, ring, [&](const Junction& other) {
    return angle_between(wanted.middle, other.middle) < wanted.half_width + other.half_width + least_gap;
  });
}

/// The distance that rings keep from loops at `at`, which is on a piece near `near`.
float margin_at(const RingPlan& plan, const LimbAxis& axis, float at, std::size_t near) {
  return std::max(4 * plan.least_distance, plan.bulge * axis.radius_at(at, axis.first_piece_at(at, near)));
}

/// Does the junction have room for a ring of its own between the rings number `before - 1` and `before`?
bool fits_before(const RingPlan& plan, const LimbAxis& axis, const Junction& wanted, std::size_t before) {
  const float margin =
      std::max(margin_at(plan, axis, wanted.at, wanted.piece), 0.12F * (wanted.high - wanted.low));
  if (wanted.low < plan.start + margin || wanted.high > plan.tip - margin) return false;
  if (before > 0) {
    const PlannedRing& below = plan.ring[before - 1];
    if (wanted.low < below.at + margin || below.high > wanted.at - margin) return false;
    if (wanted.low < below.high + margin && overlaps_any_on(plan, below, wanted)) return false;
  }
  if (before < plan.ring.size()) {
    const PlannedRing& above = plan.ring[before];
    if (wanted.high > above.at - margin || above.low < wanted.at + margin) return false;
    if (wanted.high > above.low - margin && overlaps_any_on(plan, above, wanted)) return false;
  }
  return true;
}

void link_to(RingPlan& plan, PlannedRing& ring, const Junction& wanted) {
  const auto number = static_cast<std::uint32_t>(plan.junction.size());
  (ring.is_open() ? plan.junction[ring.last].next : ring.first) = number;
  ring.last = number;
  plan.junction.push_back(wanted);
}

/// Puts a collar on an existing ring next to position `number`. Returns false where none has room.
bool share_ring(RingPlan& plan, const LimbAxis& axis, const Junction& wanted, std::size_t number) {
  for (std::size_t near = number > 0 ? number - 1 : 0; near < std::min(number + 1, plan.ring.size());
       ++near) {
    PlannedRing& ring = plan.ring[near];
    if (ring.is_bend || std::abs(wanted.at - ring.at) > same_ring * (wanted.high - wanted.low)) continue;
    if (overlaps_any_on(plan, ring, wanted)) continue;
    const float margin = margin_at(plan, axis, wanted.at, wanted.piece);
    const float low = near > 0 ? plan.ring[near - 1].high : plan.start;
    const float high = near + 1 < plan.ring.size() ? plan.ring[near + 1].low : plan.tip;
    if (!(wanted.low > low + margin && wanted.high < high - margin)) continue;
    ring.low = std::min(ring.low, wanted.low);
    ring.high = std::max(ring.high, wanted.high);
    link_to(plan, ring, wanted);
    return true;
  }
  return false;
}

bool put_junction(RingPlan& plan, const LimbAxis& axis, std::size_t at_point, const Junction& wanted) {
  const auto after = std::lower_bound(plan.ring.begin(), plan.ring.end(), wanted.at,
                                      [](const PlannedRing& ring, float at) { return ring.at < at; });
  const auto number = static_cast<std::size_t>(after - plan.ring.begin());
  if (!wanted.is_fork && share_ring(plan, axis, wanted, number)) return true;
  if (!fits_before(plan, axis, wanted, number)) return false;
  PlannedRing ring;
  ring.at = wanted.at;
  ring.low = wanted.low;
  ring.high = wanted.high;
  ring.is_bend = wanted.is_fork;
  ring.piece = wanted.is_fork ? at_point : axis.piece_at(wanted.at, wanted.piece);
  link_to(plan, ring, wanted);
  plan.ring.insert(plan.ring.begin() + static_cast<std::ptrdiff_t>(number), ring);
  return true;
}

PlannedRing plain_ring(float at, std::size_t piece, bool is_bend) {
  PlannedRing ring;
  ring.at = ring.low = ring.high = at;
  ring.piece = piece;
  ring.is_bend = is_bend;
  return ring;
}

/// Merges plain rings into the rings with junctions, by rising length.
class RingMerge {
 public:
  RingMerge(RingPlan& plan, const LimbAxis& axis, const GraftOptions& options)
      : plan_(plan),
        axis_(axis),
        all_(plan.scratch),
        high_(plan.start),
        heading_(axis.along[0]),
        least_cosine_(options.every_bend ? every_bend_cosine : straight_cosine),
        tolerance_(options.every_bend ? every_bend_tolerance : radius_tolerance) {
    all_.clear();
  }

  void add_first() {
    const float limit = plan_.ring.empty() ? plan_.tip : plan_.ring.front().low;
    const float start = plan_.start;
    const float at =
        start + std::min(0.5F * axis_.radius_at(start, axis_.piece_at(start, 0)), 0.4F * (limit - start));
    if (!(at > start + 4 * plan_.least_distance && at < limit - 4 * plan_.least_distance)) return;
    all_.push_back(plain_ring(at, axis_.piece_at(at, 0), false));
    high_ = at;
  }

  /// The ring at an inner point of the axis, where one is needed and has room.
  void add_point(std::size_t point) {
    const float at = axis_.at[point];
    take_junctions(at);
    if (!all_.empty() && all_.back().at == at) return;
    const float last_at = all_.empty() ? plan_.start : all_.back().at;
    const float last_radius = axis_.radius_at(last_at, axis_.first_piece_at(last_at, point));
    const float share = (at - last_at) / (axis_.at[point + 1] - last_at);
    const float between = last_radius + (axis_.radius[point + 1] - last_radius) * share;
    const float cosine = glm::dot(heading_, axis_.along[point]);
    if (!(cosine < least_cosine_) && !axis_.is_border(point) &&
        std::abs(between - axis_.radius[point]) < tolerance_ * axis_.radius[point])
      return;
    const float sine = std::sqrt(std::max(0.0F, 1 - cosine * cosine));
    const float clear = std::max(margin_at(plan_, axis_, at, point), 0.5F * axis_.radius[point] * sine);
    const float low = next_ < plan_.ring.size() ? plan_.ring[next_].low : plan_.tip;
    if (at < high_ + clear || at > low - clear) return;
    all_.push_back(plain_ring(at, point, true));
    heading_ = axis_.along[point];
    high_ = at;
  }

  void add_last(bool may_be_pointed) {
    take_junctions(plan_.tip);
    const float last_at = all_.empty() ? plan_.start : all_.back().at;
    const float last_radius = axis_.radius_at(last_at, axis_.first_piece_at(last_at, axis_.pieces() - 1));
    if (!may_be_pointed || axis_.radius.back() > pointed_share * last_radius)
      all_.push_back(plain_ring(plan_.tip, axis_.pieces() - 1, false));
    std::swap(plan_.ring, all_);
  }

 private:
  void take_junctions(float before) {
    for (; next_ < plan_.ring.size() && plan_.ring[next_].at <= before; ++next_) {
      high_ = plan_.ring[next_].high;
      heading_ = axis_.along[plan_.ring[next_].piece];
      all_.push_back(plan_.ring[next_]);
    }
  }

  RingPlan& plan_;
  const LimbAxis& axis_;
  std::vector<PlannedRing>& all_;
  std::size_t next_ = 0;  ///< the first ring with junctions that is not merged yet
  float high_;            ///< the end of the last ring and its junctions
  glm::vec3 heading_;     ///< of the limb at the last ring
  float least_cosine_, tolerance_;
};

}  // namespace

void begin_plan(RingPlan& plan, float start, float tip, float least_distance, float bulge) {
  plan.junction.clear();
  plan.loop_point.clear();
  plan.ring.clear();
  plan.start = start;
  plan.tip = tip;
  plan.least_distance = least_distance;
  plan.bulge = bulge;
}

bool add_junction(RingPlan& plan, const LimbAxis& axis, std::size_t at_point, const ChildLimb& child) {
  const float share = child.radius / axis.radius[at_point];
  const std::size_t points = plan.loop_point.size();
  const auto fork = [&] {
    ChildLimb even = child;
    even.sides = std::max(4, child.sides + child.sides % 2);
    plan.loop_point.resize(points);
    return fork_at(axis, at_point, even, plan.loop_point);
  };
  const auto put = [&](const std::optional<Junction>& wanted) {
    // The junction must leave a part of the child beyond itself.
    return wanted && !(wanted->child_reach > child.tip - 8 * plan.least_distance) &&
           put_junction(plan, axis, at_point, *wanted);
  };
  const bool prefers_fork = share >= fork_share;
  if (prefers_fork && put(fork())) return true;
  plan.loop_point.resize(points);
  std::optional<Junction> wanted = collar_at(axis, at_point, child, plan.loop_point);
  if (!wanted && share >= least_fork_share && !prefers_fork) wanted = fork();
  return put(wanted);
}

void complete_plan(RingPlan& plan, const LimbAxis& axis, bool has_first, const GraftOptions& options) {
  RingMerge merge(plan, axis, options);
  if (has_first) merge.add_first();
  for (std::size_t point = 1; point < axis.pieces(); ++point) merge.add_point(point);
  merge.add_last(options.pointed);
}

}  // namespace seedmesh
