#include "core/geom/plan.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/geom/triangulate.h"

namespace seedmesh {
namespace {

using glm::dvec2;

// Shares of the diagonal: points nearer than the first are one; edges nearer than the second touch.
constexpr double same_point = 1e-6;
constexpr double touching = 1e-7;
// A triangle or ring of less than this share of the squared diagonal has no area.
constexpr double no_area = 1e-14;
// More would help nobody.
constexpr std::size_t most_faults = 64;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

std::string name_of(std::uint32_t ring, std::uint32_t vertex) {
  return "point " + std::to_string(vertex) + " of ring " + std::to_string(ring);
}

struct Side {
  dvec2 from, to;
  std::uint32_t ring, vertex;
};

std::vector<Side> sides_of(const Plan& plan) {
  std::vector<Side> sides;
  for (std::uint32_t r = 0; r < plan.rings.size(); ++r) {
    const PlanRing& ring = plan.rings[r];
    for (std::uint32_t i = 0; i < ring.size(); ++i)
      sides.push_back({ring[i], ring[(i + 1) % ring.size()], r, i});
  }
  return sides;
}

double distance_to(const dvec2& p, const Side& side) {
  const dvec2 along = side.to - side.from;
  const double share = std::clamp(glm::dot(p - side.from, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(p - side.from - along * share);
}

bool do_meet(const Side& a, const Side& b, double reach) {
  const double c = cross(a.to - a.from, b.from - a.from), d = cross(a.to - a.from, b.to - a.from);
  const double e = cross(b.to - b.from, a.from - b.from), f = cross(b.to - b.from, a.to - b.from);
  if (((c > 0) != (d > 0)) && ((e > 0) != (f > 0))) return true;
  return distance_to(a.from, b) <= reach || distance_to(a.to, b) <= reach ||
         distance_to(b.from, a) <= reach || distance_to(b.to, a) <= reach;
}

/// Whether `next` runs back along the side before it.
bool turns_back(const Side& side, const Side& next, double reach) {
  return glm::dot(side.to - side.from, next.to - next.from) < 0 &&
         (distance_to(next.to, side) <= reach || distance_to(side.from, next) <= reach);
}

void find_ring_faults(const Plan& plan, double diagonal, std::vector<PlanFault>& faults) {
  for (std::uint32_t r = 0; r < plan.rings.size(); ++r) {
    const PlanRing& ring = plan.rings[r];
    const auto count = static_cast<std::uint32_t>(ring.size());
    if (count < 3) {
      faults.push_back({r, 0,
                        "ring " + std::to_string(r) + " has " + std::to_string(count) +
                            " points; an outline needs at least 3"});
      continue;
    }
    for (std::uint32_t i = 0; i < count && faults.size() < most_faults; ++i) {
      const std::uint32_t next = (i + 1) % count;
      if (glm::length(ring[next] - ring[i]) <= same_point * diagonal)
        faults.push_back({r, next, name_of(r, next) + " repeats the point before it"});
    }
    if (std::abs(signed_area(ring)) <= no_area * diagonal * diagonal)
      faults.push_back({r, 0, "ring " + std::to_string(r) + " has no area"});
  }
}

void find_meetings(const Plan& plan, double reach, std::vector<PlanFault>& faults) {
  const std::vector<Side> sides = sides_of(plan);
  std::vector<std::size_t> order(sides.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto low = [&](std::size_t i) { return std::min(sides[i].from.x, sides[i].to.x); };
  const auto high = [&](std::size_t i) { return std::max(sides[i].from.x, sides[i].to.x); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair{low(a), a} < std::pair{low(b), b};
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = i + 1; k < order.size() && low(order[k]) <= high(order[i]) + reach; ++k) {
      const Side &a = sides[std::min(order[i], order[k])], &b = sides[std::max(order[i], order[k])];
      if (std::min(a.from.y, a.to.y) > std::max(b.from.y, b.to.y) + reach ||
          std::min(b.from.y, b.to.y) > std::max(a.from.y, a.to.y) + reach)
        continue;
      const std::size_t count = plan.rings[a.ring].size();
      const bool is_next = a.ring == b.ring && (a.vertex + 1) % count == b.vertex,
                 is_before = a.ring == b.ring && (b.vertex + 1) % count == a.vertex;
      const bool is_fault = is_next     ? turns_back(a, b, reach)
                            : is_before ? turns_back(b, a, reach)
                                        : do_meet(a, b, reach);
      if (!is_fault) continue;
      faults.push_back({b.ring, b.vertex,
                        "the edge from " + name_of(b.ring, b.vertex) + " crosses or touches the edge from " +
                            name_of(a.ring, a.vertex)});
      if (faults.size() >= most_faults) return;
    }
  }
}

void find_lost_holes(const Plan& plan, std::vector<PlanFault>& faults) {
  const auto is_in = [&](std::size_t ring, const dvec2& p) { return contains(Plan{{plan.rings[ring]}}, p); };
  for (std::uint32_t r = 1; r < plan.rings.size() && faults.size() < most_faults; ++r) {
    const dvec2 p = plan.rings[r][0];
    if (!is_in(0, p)) {
      faults.push_back({r, 0, "ring " + std::to_string(r) + " is a hole outside of ring 0"});
      continue;
    }
    for (std::uint32_t other = 1; other < plan.rings.size(); ++other) {
      if (other == r || !is_in(other, p)) continue;
      faults.push_back(
          {r, 0,
           "ring " + std::to_string(r) + " is a hole inside of the hole of ring " + std::to_string(other)});
      break;
    }
  }
}

/// One outline of all rings, holes joined to it by ways that are walked twice (Eberly, "Triangulation by ear
/// clipping", 2008).
class Bridges {
 public:
  explicit Bridges(const Plan& plan) {
    std::vector<std::vector<std::uint32_t>> rings;
    for (const PlanRing& ring : plan.rings) {
      rings.emplace_back();
      for (const dvec2& p : ring) {
        rings.back().push_back(static_cast<std::uint32_t>(points_.size()));
        points_.push_back(p);
      }
    }
    outline_ = rings[0];
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t r = 1; r < rings.size(); ++r) {
      std::vector<std::uint32_t>& ring = rings[r];
      if (ring.size() < 3 || outline_.size() < 3) continue;
      std::rotate(ring.begin(),
                  std::max_element(ring.begin(), ring.end(),
                                   [&](auto a, auto b) { return points_[a].x < points_[b].x; }),
                  ring.end());
      order.emplace_back(-points_[ring[0]].x, r);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [x, r] : order) join(rings[r]);
  }

  const std::vector<std::uint32_t>& outline() const { return outline_; }
  const std::vector<dvec2>& points() const { return points_; }

 private:
  void join(const std::vector<std::uint32_t>& ring) {
    const std::size_t at = seen_from(points_[ring[0]]);
    std::vector<std::uint32_t> way(ring);
    way.push_back(ring[0]);
    way.push_back(outline_[at]);
    outline_.insert(outline_.begin() + static_cast<std::ptrdiff_t>(at) + 1, way.begin(), way.end());
  }

  /// A place in the outline that can be seen from p, to its right.
  std::size_t seen_from(const dvec2& p) const {
    const std::size_t count = outline_.size();
    double best = 1e300;
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const dvec2 a = points_[outline_[i]], b = points_[outline_[(i + 1) % count]];
      // Edges that go up have the inside to their left, towards p.
      if (!(a.y <= p.y && b.y > p.y)) continue;
      const double x = a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y);
      if (x < p.x || x >= best) continue;
      best = x;
      found = b.x > a.x ? (i + 1) % count : i;
    }
    // Points in the triangle between p, where the look ends, and the candidate hide it; the one nearest to
    // the line of sight is seen.
    const dvec2 end{best, p.y}, candidate = points_[outline_[found]];
    double flattest = 1e300;
    std::size_t seen = found;
    for (std::size_t i = 0; i < count; ++i) {
      const dvec2 q = points_[outline_[i]];
      if (q.x < p.x || !is_in_triangle(q, p, end, candidate)) continue;
      const dvec2 before = points_[outline_[(i + count - 1) % count]],
                  after = points_[outline_[(i + 1) % count]];
      if (q != candidate && cross(q - before, after - q) > 0) continue;
      if (!faces(before, q, after, p)) continue;
      const double slope = std::abs(q.y - p.y) / std::max(q.x - p.x, 1e-300);
      if (slope < flattest) {
        flattest = slope;
        seen = i;
      }
    }
    return seen;
  }

  /// Whether p lies in the inside's angle at q.
  static bool faces(const dvec2& before, const dvec2& q, const dvec2& after, const dvec2& p) {
    const bool is_left_in = cross(q - before, p - q) >= 0, is_left_out = cross(after - q, p - q) >= 0;
    return cross(q - before, after - q) > 0 ? is_left_in && is_left_out : is_left_in || is_left_out;
  }

  static bool is_in_triangle(const dvec2& q, const dvec2& a, const dvec2& b, const dvec2& c) {
    const double u = cross(b - a, q - a), v = cross(c - b, q - b), w = cross(a - c, q - c);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  }

  std::vector<dvec2> points_;
  std::vector<std::uint32_t> outline_;
};

}  // namespace

std::vector<PlanFault> faults_of(const Plan& plan) {
  std::vector<PlanFault> faults;
  if (plan.rings.empty()) return {{0, 0, "a plan needs at least one ring"}};
  for (std::uint32_t r = 0; r < plan.rings.size(); ++r) {
    for (std::uint32_t i = 0; i < plan.rings[r].size() && faults.size() < most_faults; ++i) {
      const dvec2 p = plan.rings[r][i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        faults.push_back({r, i, name_of(r, i) + " is not finite"});
    }
  }
  if (!faults.empty()) return faults;
  const double diagonal = diagonal_of(plan);
  find_ring_faults(plan, diagonal, faults);
  if (!faults.empty()) return faults;
  find_meetings(plan, touching * diagonal, faults);
  if (faults.empty()) find_lost_holes(plan, faults);
  return faults;
}

Plan read_plan(std::vector<PlanRing> rings) {
  Plan plan{std::move(rings)};
  for (std::size_t r = 0; r < plan.rings.size(); ++r) {
    PlanRing& ring = plan.rings[r];
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if ((signed_area(ring) < 0) == (r == 0)) std::reverse(ring.begin(), ring.end());
  }
  return plan;
}

double signed_area(std::span<const dvec2> ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  return 0.5 * twice;
}

double area(const Plan& plan) {
  double sum = 0;
  for (const PlanRing& ring : plan.rings) sum += signed_area(ring);
  return sum;
}

dvec2 centroid_of(std::span<const dvec2> ring) {
  dvec2 sum{0};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    sum += (a + b) * cross(a, b);
  }
  return ring[0] + sum / (6 * signed_area(ring));
}

std::uint32_t edge_count(const Plan& plan) {
  std::size_t count = 0;
  for (const PlanRing& ring : plan.rings) count += ring.size();
  return static_cast<std::uint32_t>(count);
}

std::pair<dvec2, dvec2> edge_of(const Plan& plan, std::uint32_t edge) {
  for (const PlanRing& ring : plan.rings) {
    if (edge < ring.size()) return {ring[edge], ring[(edge + 1) % ring.size()]};
    edge -= static_cast<std::uint32_t>(ring.size());
  }
  return {dvec2(0), dvec2(0)};
}

bool contains(const Plan& plan, const dvec2& p) {
  bool is_inside = false;
  for (const PlanRing& ring : plan.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      if (cross(b - a, p - a) == 0 && glm::dot(p - a, p - b) <= 0) return true;
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
        is_inside = !is_inside;
    }
  }
  return is_inside;
}

double diagonal_of(const Plan& plan) {
  if (plan.rings.empty() || plan.rings[0].empty()) return 0;
  dvec2 low = plan.rings[0][0], high = low;
  for (const dvec2& p : plan.rings[0]) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return glm::length(high - low);
}

std::vector<std::uint32_t> triangulate(const Plan& plan) {
  if (plan.rings.empty()) return {};
  const Bridges bridges(plan);
  std::vector<dvec2> outline;
  for (const std::uint32_t i : bridges.outline()) outline.push_back(bridges.points()[i]);
  const double diagonal = diagonal_of(plan);
  Triangulator triangulator;
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t i : triangulator.run(outline, no_area * diagonal * diagonal))
    triangles.push_back(bridges.outline()[i]);
  return triangles;
}

}  // namespace seedmesh
