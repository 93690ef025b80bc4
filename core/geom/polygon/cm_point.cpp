#include "core/geom/polygon/cm_point.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/math.h"

namespace seedmesh {
namespace {

int sign(std::int64_t value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

/// Whether `p`, which lies on the line of a b, lies within the box of a b.
bool is_between(const CmPoint& p, const CmPoint& a, const CmPoint& b) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// 0 for directions with an angle in [0, 180) degrees, 1 for the others.
int half_of(std::int64_t x, std::int64_t y) { return y > 0 || (y == 0 && x > 0) ? 0 : 1; }

}  // namespace

CmPoint rounded_cm(const glm::dvec2& cm) {
  return {math::to_int32(std::floor(cm.x + 0.5)), math::to_int32(std::floor(cm.y + 0.5))};
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a, from = p - a;
  const double length2 = along.x * along.x + along.y * along.y;
  const double share =
      length2 > 0 ? std::clamp((from.x * along.x + from.y * along.y) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec2 rest = from - along * share;
  return std::sqrt(rest.x * rest.x + rest.y * rest.y);
}

bool cross_properly(const CmPoint& a, const CmPoint& b, const CmPoint& c, const CmPoint& d) {
  return sign(cross(a, b, c)) * sign(cross(a, b, d)) < 0 && sign(cross(c, d, a)) * sign(cross(c, d, b)) < 0;
}

bool segments_meet(const CmPoint& a, const CmPoint& b, const CmPoint& c, const CmPoint& d) {
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
    return false;
  const int abc = sign(cross(a, b, c)), abd = sign(cross(a, b, d));
  const int cda = sign(cross(c, d, a)), cdb = sign(cross(c, d, b));
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && is_between(c, a, b)) || (abd == 0 && is_between(d, a, b)) ||
         (cda == 0 && is_between(a, c, d)) || (cdb == 0 && is_between(b, c, d));
}

std::int64_t doubled_area(std::span<const CmPoint> ring) {
  std::int64_t sum = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += cross(ring[0], ring[i], ring[i + 1]);
  return sum;
}

namespace {

/// Whether a ring turns left or goes straight on at every point, and once around. Such a ring is simple.
bool winds_once(std::span<const CmPoint> ring) {
  const std::size_t count = ring.size();
  std::size_t lowest = 0;  // points before both neighbours in the order of points: one for each time around
  for (std::size_t i = 0; i < count; ++i) {
    const CmPoint &a = ring[i], &p = ring[i + 1 < count ? i + 1 : 0];
    const CmPoint& b = ring[i + 2 < count ? i + 2 : i + 2 - count];
    const std::int64_t turn = cross(a, p, b);
    if (turn < 0 || (turn == 0 && !is_between(p, a, b))) return false;
    lowest += p < a && p < b ? 1U : 0U;
  }
  return lowest == 1;
}

/// Whether edges i and k of a ring, i != k, meet except at the common end of neighbours.
bool do_edges_meet(std::span<const CmPoint> ring, std::size_t i, std::size_t k) {
  const auto next = [count = ring.size()](std::size_t n) { return n + 1 == count ? 0 : n + 1; };
  const CmPoint &a = ring[i], &b = ring[next(i)], &c = ring[k], &d = ring[next(k)];
  if (next(i) != k && next(k) != i) return segments_meet(a, b, c, d);
  // Neighbours share one point; they overlap if both leave it in one direction.
  const CmPoint &shared = next(i) == k ? b : a, &before = next(i) == k ? a : c, &after = next(i) == k ? d : b;
  return cross(shared, before, after) == 0 &&
         (is_between(before, shared, after) || is_between(after, shared, before));
}

}  // namespace

bool is_simple(std::span<const CmPoint> ring) {
  constexpr std::size_t few = 12;  // sorting takes longer than comparing all pairs
  const std::size_t count = ring.size();
  if (count < 3) return false;
  const auto next = [count](std::size_t i) { return i + 1 == count ? 0 : i + 1; };
  for (std::size_t i = 0; i < count; ++i) {
    if (ring[i] == ring[next(i)]) return false;
  }
  if (winds_once(ring)) return true;
  if (count <= few) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = i + 1; k < count; ++k) {
        if (do_edges_meet(ring, i, k)) return false;
      }
    }
    return true;
  }
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  const auto left = [&](std::uint32_t i) { return std::min(ring[i].x, ring[next(i)].x); };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t k) { return left(i) != left(k) ? left(i) < left(k) : i < k; });
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = order[n];
    for (std::size_t m = n + 1; m < count && left(order[m]) <= std::max(ring[i].x, ring[next(i)].x); ++m) {
      if (do_edges_meet(ring, i, order[m])) return false;
    }
  }
  return true;
}

bool is_inside(std::span<const CmPoint> ring, const glm::dvec2& p) {
  bool odd = false;
  for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++) {
    const glm::dvec2 a = in_cm(ring[i]), b = in_cm(ring[k]);
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  }
  return odd;
}

int compare_angles(const CmPoint& origin, const CmPoint& a, const CmPoint& b) {
  const int half_a = half_of(std::int64_t{a.x} - origin.x, std::int64_t{a.y} - origin.y);
  const int half_b = half_of(std::int64_t{b.x} - origin.x, std::int64_t{b.y} - origin.y);
  if (half_a != half_b) return half_a < half_b ? -1 : 1;
  return -sign(cross(origin, a, b));
}

}  // namespace seedmesh
