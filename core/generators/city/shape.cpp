#include "core/generators/city/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace seedmesh::city {

using glm::dvec2;

namespace {

/// Whether a ring is strictly convex: it turns left everywhere, and once around.
bool is_convex(std::span<const CmPoint> ring) {
  const std::size_t count = ring.size();
  if (count < 3) return false;
  std::size_t lowest = 0;  // corners before both neighbours in the order of points
  for (std::size_t i = 0; i < count; ++i) {
    const CmPoint &a = ring[i], &p = ring[i + 1 < count ? i + 1 : 0];
    const CmPoint& b = ring[i + 2 < count ? i + 2 : i + 2 - count];
    if (cross(a, p, b) <= 0) return false;
    lowest += p < a && p < b ? 1 : 0;
  }
  return lowest == 1;
}

}  // namespace

CmRing hull_of(std::span<const CmPoint> ring) {
  CmRing sorted(ring.begin(), ring.end()), hull;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 3) return sorted;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t first = hull.size();
    for (const CmPoint& p : sorted) {
      while (hull.size() > first + 1 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(sorted.begin(), sorted.end());
  }
  return hull;
}

LeastBox least_box(std::span<const CmPoint> ring) {
  constexpr std::size_t few = 32;
  std::array<dvec2, few> own;
  std::vector<dvec2> more;
  std::span<dvec2> hull;
  // Most lots are convex and have few corners, which need no memory.
  if (is_convex(ring) && ring.size() <= few) {
    for (std::size_t i = 0; i < ring.size(); ++i) own[i] = in_cm(ring[i]);
    const auto first = std::min_element(ring.begin(), ring.end()) - ring.begin();
    hull = std::span(own).first(ring.size());
    std::rotate(hull.begin(), hull.begin() + first, hull.end());
  } else {
    for (const CmPoint& p : hull_of(ring)) more.push_back(in_cm(p));
    hull = more;
  }
  struct EdgeBox {
    double area = 0, side = 0;
  };
  std::array<EdgeBox, few> own_boxes;
  std::vector<EdgeBox> more_boxes(hull.size() > few ? hull.size() : 0);
  const std::span<EdgeBox> boxes =
      hull.size() > few ? std::span(more_boxes) : std::span(own_boxes).first(hull.size());
  LeastBox best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const dvec2 a = hull[i], edge = hull[i + 1 < hull.size() ? i + 1 : 0] - a;
    const dvec2 d = edge / std::sqrt(edge.x * edge.x + edge.y * edge.y), n(-d.y, d.x);
    double low = 0, high = 0, height = 0;
    for (const dvec2& p : hull) {
      const dvec2 off = p - a;
      const double along = glm::dot(off, d), across = glm::dot(off, n);
      low = along < low ? along : low;
      high = along > high ? along : high;
      height = across > height ? across : height;
    }
    boxes[i] = {(high - low) * height, std::min(high - low, height)};
    if ((high - low) * height >= least) continue;
    least = (high - low) * height;
    const bool is_long = high - low >= height;
    best = {std::min(high - low, height), std::max(high - low, height), 0,
            a + d * ((low + high) / 2) + n * (height / 2), is_long ? d : n};
  }
  best.narrowest = best.short_side;
  for (const EdgeBox& box : boxes) {
    if (box.area < least * 1.02) best.narrowest = std::min(best.narrowest, box.side);
  }
  return best;
}

double sharpest_cosine(std::span<const CmPoint> ring) {
  double sharpest = -1;
  const std::size_t count = ring.size();
  for (std::size_t i = 0; i < count; ++i) {
    const CmPoint &p = ring[i], &a = ring[(i + count - 1) % count], &b = ring[(i + 1) % count];
    if (cross(a, p, b) <= 0) continue;  // a reflex corner
    const dvec2 u = in_cm(a) - in_cm(p), v = in_cm(b) - in_cm(p);
    sharpest = std::max(sharpest, glm::dot(u, v) / std::sqrt(glm::dot(u, u) * glm::dot(v, v)));
  }
  return sharpest;
}

bool is_blunt(std::span<const CmPoint> ring, double most_cosine) {
  constexpr double least_bend = 2;
  if (sharpest_cosine(ring) > most_cosine) return false;
  const std::size_t count = ring.size();
  for (std::size_t i = 0; i < count; ++i) {
    const CmPoint &a = ring[i > 0 ? i - 1 : count - 1], &b = ring[i + 1 < count ? i + 1 : 0];
    if (distance_to_segment(in_cm(ring[i]), in_cm(a), in_cm(b)) < least_bend)
      return sharpest_cosine(without_bends(ring, least_bend)) <= most_cosine;
  }
  return true;
}

CmRing without_bends(std::span<const CmPoint> ring, double least) {
  CmRing kept(ring.begin(), ring.end());
  for (std::size_t i = 0; i < kept.size() && kept.size() > 3;) {
    const CmPoint &a = kept[i > 0 ? i - 1 : kept.size() - 1], &b = kept[i + 1 < kept.size() ? i + 1 : 0];
    if (distance_to_segment(in_cm(kept[i]), in_cm(a), in_cm(b)) < least) {
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
      i -= i > 0 ? 1 : 0;
    } else {
      ++i;
    }
  }
  return kept;
}

bool has_narrow_part(std::span<const CmPoint> ring, double least) {
  constexpr double opposite = -0.8;  // cosine
  const std::size_t count = ring.size();
  const auto along = [&](std::size_t i) {
    const dvec2 d = in_cm(ring[(i + 1) % count]) - in_cm(ring[i]);
    return d / std::sqrt(glm::dot(d, d));
  };
  for (std::size_t k = 0; k < count; ++k) {
    const CmPoint &a = ring[k], &b = ring[(k + 1) % count];
    const dvec2 edge = along(k);
    const double length = glm::dot(in_cm(b) - in_cm(a), edge);
    for (std::size_t i = 0; i < count; ++i) {
      if (i == k || i == (k + 1) % count) continue;
      const dvec2 off = in_cm(ring[i]) - in_cm(a);
      const double at = glm::dot(off, edge), side = edge.x * off.y - edge.y * off.x;
      if (side <= 0 || side >= least || at < 0 || at > length) continue;
      if (glm::dot(along(i), edge) < opposite || glm::dot(along((i + count - 1) % count), edge) < opposite)
        return true;
    }
  }
  return false;
}

bool are_apart(std::span<const CmRing> rings) {
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t s = r + 1; s < rings.size(); ++s) {
      for (std::size_t i = 0; i < rings[r].size(); ++i) {
        for (std::size_t k = 0; k < rings[s].size(); ++k) {
          if (segments_meet(rings[r][i], rings[r][(i + 1) % rings[r].size()], rings[s][k],
                            rings[s][(k + 1) % rings[s].size()]))
            return false;
        }
      }
    }
  }
  return true;
}

}  // namespace seedmesh::city
