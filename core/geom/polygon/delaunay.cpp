#include "core/geom/polygon/delaunay.h"

#include <algorithm>

namespace seedmesh {
namespace {

using glm::dvec2;

constexpr std::uint32_t none = 0xFFFFFFFFU;
constexpr double least_inside = 1e-13;  // of a circle test, relative to the fourth power of its size

double cross_of(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Positive where `p` is inside the circle through the counter-clockwise corners a, b and c.
double in_circle(const dvec2& a, const dvec2& b, const dvec2& c, const dvec2& p) {
  const dvec2 u = a - p, v = b - p, w = c - p;
  const double uu = u.x * u.x + u.y * u.y, vv = v.x * v.x + v.y * v.y, ww = w.x * w.x + w.y * w.y;
  const double size = std::max({uu, vv, ww});
  const double inside = uu * cross_of(v, w) + vv * cross_of(w, u) + ww * cross_of(u, v);
  return inside - least_inside * size * size;
}

/// Half-edge 3 t + k runs from corner k of triangle t to the next.
class Triangulation {
 public:
  Triangulation(std::vector<dvec2>& points, std::vector<std::uint32_t>& corners, const Job* job)
      : points_(points), corners_(corners), job_(job) {
    link();
    flips_left_ = 64 * corners_.size() + 4096;
    open_.reserve(2 * corners_.size());
    for (std::uint32_t half = 0; half < corners_.size(); ++half) open_.push_back(half);
    flip_open();
  }

  void insert(const dvec2& p) {
    const std::uint32_t found = triangle_at(p);
    if (found == none) return;
    const auto number = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    const std::uint32_t first = 3 * found, second = static_cast<std::uint32_t>(corners_.size()),
                        third = second + 3;
    const std::uint32_t a = corners_[first], b = corners_[first + 1], c = corners_[first + 2];
    const std::uint32_t of_b = twin_[first + 1], of_c = twin_[first + 2];
    corners_[first + 2] = number;
    corners_.insert(corners_.end(), {b, c, number, c, a, number});
    twin_.resize(corners_.size(), none);
    join(second, of_b);
    join(third, of_c);
    join(first + 1, second + 2);
    join(second + 1, third + 2);
    join(third + 1, first + 2);
    flips_left_ += 64;
    open_.insert(open_.end(), {first, second, third});
    flip_open();
  }

 private:
  static std::uint32_t after(std::uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; }
  std::uint32_t from(std::uint32_t half) const { return corners_[half]; }
  std::uint32_t apex(std::uint32_t half) const { return corners_[after(after(half))]; }

  void join(std::uint32_t half, std::uint32_t other) {
    twin_[half] = other;
    if (other != none) twin_[other] = half;
  }

  void link() {
    struct Side {
      std::uint64_t ends;
      std::uint32_t half;
    };
    std::vector<Side> sides;
    sides.reserve(corners_.size());
    for (std::uint32_t half = 0; half < corners_.size(); ++half) {
      const std::uint32_t a = from(half), b = from(after(half));
      sides.push_back({std::uint64_t{std::min(a, b)} << 32U | std::max(a, b), half});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
      return s.ends != t.ends ? s.ends < t.ends : s.half < t.half;
    });
    twin_.assign(corners_.size(), none);
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      if (sides[i].ends == sides[i + 1].ends) join(sides[i].half, sides[i + 1].half);
    }
  }

  void flip_open() {
    while (!open_.empty()) {
      const std::uint32_t half = open_.back();
      open_.pop_back();
      if (job_ && flips_left_ % 4096 == 0) job_->check();
      if (flips_left_ == 0) return;
      if (may_flip(half)) flip(half);
    }
  }

  bool may_flip(std::uint32_t half) const {
    if (twin_[half] == none) return false;
    const dvec2 &a = points_[from(half)], &b = points_[from(after(half))], &c = points_[apex(half)],
                &d = points_[apex(twin_[half])];
    if (cross_of(d - a, c - a) <= 0 || cross_of(c - b, d - b) <= 0) return false;
    return in_circle(a, b, c, d) > 0;
  }

  /// Triangles (a, b, c) and (b, a, d) become (c, a, d) and (d, b, c).
  void flip(std::uint32_t half) {
    --flips_left_;
    const std::uint32_t other = twin_[half];
    const std::uint32_t bc = after(half), ca = after(bc), ad = after(other), db = after(ad);
    const std::uint32_t a = corners_[half], b = corners_[other], c = corners_[ca], d = corners_[db];
    const std::uint32_t of_bc = twin_[bc], of_ca = twin_[ca], of_ad = twin_[ad], of_db = twin_[db];
    corners_[half] = c;
    corners_[bc] = a;
    corners_[ca] = d;
    corners_[other] = d;
    corners_[ad] = b;
    corners_[db] = c;
    join(half, of_ca);
    join(bc, of_ad);
    join(other, of_db);
    join(ad, of_bc);
    join(ca, db);
    open_.insert(open_.end(), {half, bc, other, ad});
  }

  /// Walks from the last triangle towards the point; none where it is outside or on an edge.
  std::uint32_t triangle_at(const dvec2& p) {
    const auto count = static_cast<std::uint32_t>(corners_.size() / 3);
    if (count == 0) return none;
    std::uint32_t at = std::min(last_, count - 1);
    for (std::uint32_t steps = 0; steps <= count; ++steps) {
      std::uint32_t leave = none;
      double worst = 0;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t half = 3 * at + k;
        const double side =
            cross_of(points_[from(after(half))] - points_[from(half)], p - points_[from(half)]);
        if (side < worst && twin_[half] != none) {
          worst = side;
          leave = half;
        }
      }
      if (leave == none) break;
      at = twin_[leave] / 3;
    }
    last_ = at;
    return contains(at, p) ? at : scan(p);
  }

  bool contains(std::uint32_t triangle, const dvec2& p) const {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t half = 3 * triangle + k;
      if (cross_of(points_[from(after(half))] - points_[from(half)], p - points_[from(half)]) <= 0)
        return false;
    }
    return true;
  }

  /// A walk in a polygon that is not convex can end at its outline.
  std::uint32_t scan(const dvec2& p) const {
    for (std::uint32_t t = 0; 3 * t < corners_.size(); ++t) {
      if (contains(t, p)) return t;
    }
    return none;
  }

  std::vector<dvec2>& points_;
  std::vector<std::uint32_t>& corners_;
  const Job* job_;
  std::vector<std::uint32_t> twin_, open_;
  std::size_t flips_left_ = 0;
  std::uint32_t last_ = 0;
};

}  // namespace

void refine_triangles(std::vector<dvec2>& points, std::vector<std::uint32_t>& triangles,
                      std::span<const dvec2> inner, const Job* job) {
  if (triangles.size() <= 3 && inner.empty()) return;
  Triangulation triangulation(points, triangles, job);
  for (const dvec2& p : inner) triangulation.insert(p);
}

}  // namespace seedmesh
