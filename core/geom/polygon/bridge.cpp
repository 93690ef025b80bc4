#include "core/geom/polygon/bridge.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geom/polygon/orientation.h"

namespace seedmesh {
namespace {

using glm::dvec2;

/// The outline so far, as numbers of points.
struct Outline {
  std::span<const dvec2> points;
  std::vector<std::uint32_t> corners;

  std::size_t size() const { return corners.size(); }
  const dvec2& at(std::size_t i) const { return points[corners[i]]; }
  const dvec2& before(std::size_t i) const { return at(i == 0 ? size() - 1 : i - 1); }
  const dvec2& after(std::size_t i) const { return at(i + 1 == size() ? 0 : i + 1); }
};

/// Whether p lies strictly within the angle of the inside at a corner.
bool is_within_angle(const dvec2& before, const dvec2& corner, const dvec2& after, const dvec2& p) {
  const int turn = orientation(before, corner, after);
  const bool is_left_in = orientation(before, corner, p) > 0, is_left_out = orientation(corner, after, p) > 0;
  return turn < 0 ? is_left_in || is_left_out : is_left_in && is_left_out;
}

/// Whether b lies between a and c, which are on one line with it.
bool is_between(const dvec2& a, const dvec2& b, const dvec2& c) {
  return a.x != c.x ? (a.x < b.x) == (b.x < c.x) : (a.y < b.y) == (b.y < c.y);
}

/// Whether the edge a, b meets the open segment from p to q; an end of the edge may lie at q.
bool blocks(const dvec2& a, const dvec2& b, const dvec2& p, const dvec2& q) {
  const int side_a = orientation(p, q, a), side_b = orientation(p, q, b);
  if (side_a == 0 && a != q && is_between(p, a, q)) return true;
  if (side_b == 0 && b != q && is_between(p, b, q)) return true;
  return side_a * side_b < 0 && orientation(a, b, p) * orientation(a, b, q) < 0;
}

/// Whether the corner can be seen from p, which lies to its left and on no edge of the outline.
bool is_visible(const Outline& outline, const dvec2& p, std::size_t corner) {
  const dvec2& q = outline.at(corner);
  if (!(q.x > p.x) || !is_within_angle(outline.before(corner), q, outline.after(corner), p)) return false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (blocks(outline.at(i), outline.after(i), p, q)) return false;
  }
  return true;
}

bool is_in_triangle(const dvec2& q, const dvec2& a, const dvec2& b, const dvec2& c) {
  const double u = doubled_area(a, b, q), v = doubled_area(b, c, q), w = doubled_area(c, a, q);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// Eberly's choice: a corner near the point where a ray from p along +x leaves the polygon. Its arithmetic is
/// not exact, so that the caller has to check the answer.
std::size_t corner_by_ray(const Outline& outline, const dvec2& p) {
  const std::size_t count = outline.size();
  double best = 1e300;
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const dvec2 &a = outline.at(i), &b = outline.after(i);
    // Edges that go up have the inside to their left, towards p.
    if (!(a.y <= p.y && b.y > p.y)) continue;
    const double x = a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y);
    if (x < p.x || x >= best) continue;
    best = x;
    found = b.x > a.x ? (i + 1) % count : i;
  }
  // Corners in the triangle of p, the end of the ray and the candidate hide the candidate. The one nearest
  // to the ray is visible.
  const dvec2 end{best, p.y}, candidate = outline.at(found);
  double flattest = 1e300;
  std::size_t seen = found;
  for (std::size_t i = 0; i < count; ++i) {
    const dvec2& q = outline.at(i);
    if (q.x < p.x || !is_in_triangle(q, p, end, candidate)) continue;
    if (q != candidate && doubled_area(outline.before(i), q, outline.after(i)) > 0) continue;
    if (!is_within_angle(outline.before(i), q, outline.after(i), p)) continue;
    const double slope = std::abs(q.y - p.y) / std::max(q.x - p.x, 1e-300);
    if (slope < flattest) {
      flattest = slope;
      seen = i;
    }
  }
  return seen;
}

/// A corner of the outline that p can be joined to. There is one to the right of p, because p is the
/// rightmost point of its hole and no other hole that is still apart reaches farther.
std::size_t corner_for(const Outline& outline, const dvec2& p, const Job* job) {
  if (job) job->check();
  const std::size_t first = corner_by_ray(outline, p);
  if (is_visible(outline, p, first)) return first;
  std::vector<std::size_t> order(outline.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto distance = [&](std::size_t i) {
    const dvec2 d = outline.at(i) - p;
    return d.x * d.x + d.y * d.y;
  };
  std::ranges::stable_sort(order, {}, distance);
  const auto visible = std::ranges::find_if(order, [&](std::size_t corner) {
    if (job) job->check();
    return is_visible(outline, p, corner);
  });
  return visible == order.end() ? first : *visible;
}

}  // namespace

std::vector<std::uint32_t> join_holes(std::span<const dvec2> points,
                                      std::span<const std::uint32_t> ring_sizes, const Job* job) {
  Outline outline{points, {}};
  if (ring_sizes.empty()) return outline.corners;
  outline.corners.resize(ring_sizes[0]);
  std::iota(outline.corners.begin(), outline.corners.end(), 0U);
  if (outline.size() < 3) return outline.corners;
  std::vector<std::vector<std::uint32_t>> holes;
  std::uint32_t first = ring_sizes[0];
  for (const std::uint32_t size : ring_sizes.subspan(1)) {
    std::vector<std::uint32_t> hole(size);
    std::iota(hole.begin(), hole.end(), first);
    first += size;
    if (size < 3) continue;
    // Clang 14 does not compile std::ranges::rotate of GCC 12's library.
    std::rotate(hole.begin(), std::ranges::max_element(hole, {}, [&](auto i) { return points[i].x; }),
                hole.end());
    holes.push_back(std::move(hole));
  }
  std::ranges::stable_sort(holes,
                           [&](const auto& a, const auto& b) { return points[a[0]].x > points[b[0]].x; });
  for (std::vector<std::uint32_t>& hole : holes) {
    const std::size_t at = corner_for(outline, points[hole[0]], job);
    hole.push_back(hole[0]);
    hole.push_back(outline.corners[at]);
    outline.corners.insert(outline.corners.begin() + static_cast<std::ptrdiff_t>(at) + 1, hole.begin(),
                           hole.end());
  }
  return outline.corners;
}

}  // namespace seedmesh
