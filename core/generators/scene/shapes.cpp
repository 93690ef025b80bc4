#include "core/generators/scene/shapes.h"

#include <algorithm>

#include "core/base/math.h"

namespace seedmesh::scene {
namespace {

constexpr double most_squares_a_side = 2048;
constexpr std::size_t pieces_a_box = 16;
// Of their size: rows of houses that share walls are not to depend on rounding.
constexpr double touching = 1e-6;

double distance_to_piece(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  const glm::dvec2 way = b - a;
  const double squared = glm::dot(way, way);
  const double share = squared > 0 ? std::clamp(glm::dot(p - a, way) / squared, 0.0, 1.0) : 0;
  return glm::distance(p, a + way * share);
}

bool is_beyond(const Extent& box, const glm::dvec2& p, double margin) {
  return p.x < box.min.x - margin || p.y < box.min.y - margin || p.x > box.max.x + margin ||
         p.y > box.max.y + margin;
}

/// How far a rectangle reaches along a direction.
double reach_along(const Footprint& footprint, const glm::dvec2& way) {
  return footprint.half.x * std::abs(way.x * footprint.cos - way.y * footprint.sin) +
         footprint.half.y * std::abs(way.x * footprint.sin + way.y * footprint.cos);
}

}  // namespace

/// Rectangles are apart where they are so along a side of one of them.
bool overlap(const Footprint& a, const Footprint& b) {
  const glm::dvec2 way = b.at - a.at;
  if (a.round) return glm::length(way) < (a.half.x + b.half.x) * (1 - touching);
  for (const glm::dvec2& side : {glm::dvec2(a.cos, -a.sin), glm::dvec2(a.sin, a.cos),
                                 glm::dvec2(b.cos, -b.sin), glm::dvec2(b.sin, b.cos)}) {
    const double sum = reach_along(a, side) + reach_along(b, side);
    if (std::abs(glm::dot(way, side)) >= sum * (1 - touching)) return false;
  }
  return true;
}

Footprint Footprint::of(const Stand& stand, const glm::dvec2& half, bool round) {
  const math::SinCos turn = math::sincos(static_cast<double>(stand.turn));
  return {stand.at, half * static_cast<double>(stand.scale), turn.cos, turn.sin, round};
}

double Footprint::outside(const glm::dvec2& p) const {
  const glm::dvec2 way = p - at;
  if (round) return glm::length(way) - half.x;
  const glm::dvec2 own(way.x * cos - way.y * sin, way.x * sin + way.y * cos);
  const glm::dvec2 over = glm::abs(own) - half;
  return glm::length(glm::max(over, glm::dvec2(0))) + std::min(std::max(over.x, over.y), 0.0);
}

bool is_inside(std::span<const glm::dvec2> polygon, const glm::dvec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const glm::dvec2 &a = polygon[i], &b = polygon[j];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y))) inside = !inside;
  }
  return inside;
}

Extent extent_of(std::span<const glm::dvec2> points) {
  Extent extent{points.front(), points.front()};
  for (const glm::dvec2& p : points) {
    extent.min = glm::min(extent.min, p);
    extent.max = glm::max(extent.max, p);
  }
  return extent;
}

bool Way::covers(const glm::dvec2& p, double margin) const {
  const double reach = half_width + margin;
  if (is_beyond(box, p, margin)) return false;
  for (std::size_t run = 0; run < boxes.size(); ++run) {
    if (is_beyond(boxes[run], p, margin)) continue;
    const std::size_t first = run * pieces_a_box + 1, last = std::min(first + pieces_a_box, points.size());
    for (std::size_t i = first; i < last; ++i) {
      if (distance_to_piece(points[i - 1], points[i], p) < reach) return true;
    }
  }
  return false;
}

Way way_of(std::vector<glm::dvec2> points, double width) {
  Way way;
  const auto covered = [&](std::size_t first, std::size_t count) {
    Extent box = extent_of(std::span<const glm::dvec2>(points).subspan(first, count));
    box.min -= width / 2;
    box.max += width / 2;
    return box;
  };
  way.box = covered(0, points.size());
  for (std::size_t first = 0; first + 1 < points.size(); first += pieces_a_box)
    way.boxes.push_back(covered(first, std::min(pieces_a_box + 1, points.size() - first)));
  way.points = std::move(points);
  way.half_width = width / 2;
  return way;
}

Neighbours::Neighbours(const Extent& extent, double cell, const Job& job)
    : extent_(extent), head_(job), next_(job), id_(job), place_(job) {
  const glm::dvec2 size = extent.size();
  const double side = std::max({cell, size.x / most_squares_a_side, size.y / most_squares_a_side, 1e-6});
  per_cell_ = 1 / side;
  wide_ = static_cast<std::size_t>(math::to_int64(size.x * per_cell_)) + 1;
  deep_ = static_cast<std::size_t>(math::to_int64(size.y * per_cell_)) + 1;
  head_.resize(wide_ * deep_);
  std::fill(head_.begin(), head_.end(), none);
}

Neighbours::Square Neighbours::square_of(const glm::dvec2& at) const {
  const glm::dvec2 place = (at - extent_.min) * per_cell_;
  return {math::to_int32(std::clamp(place.x, 0.0, static_cast<double>(wide_ - 1))),
          math::to_int32(std::clamp(place.y, 0.0, static_cast<double>(deep_ - 1)))};
}

void Neighbours::add(const glm::dvec2& at, std::uint32_t id) {
  const Square square = square_of(at);
  std::uint32_t& head =
      head_[static_cast<std::size_t>(square.z) * wide_ + static_cast<std::size_t>(square.x)];
  next_.push_back(head);
  head = static_cast<std::uint32_t>(place_.size());
  place_.push_back(at);
  id_.push_back(id);
}

double Neighbours::nearest(const glm::dvec2& at, double radius) const {
  double best = radius * radius * 2 + 1;
  any(at, radius, [&](std::uint32_t, double squared) {
    best = std::min(best, squared);
    return false;
  });
  return best;
}

bool Plots::take(const Footprint& footprint) {
  const bool meets = by_place_.any(footprint.at, widest_ + footprint.reach(),
                                   [&](std::uint32_t id, double) { return overlap(all_[id], footprint); });
  if (meets) return false;
  by_place_.add(footprint.at, static_cast<std::uint32_t>(all_.size()));
  all_.push_back(footprint);
  widest_ = std::max(widest_, footprint.reach());
  return true;
}

}  // namespace seedmesh::scene
