#include "core/generators/scene/shapes.h"

#include <algorithm>

#include "core/base/math.h"

namespace seedmesh::scene {
namespace {

constexpr double most_squares_a_side = 2048;
constexpr std::size_t pieces_a_box = 16;
// Tolerance as a share of the size, so that rounding does not affect rows of houses with common walls.
constexpr double touching = 1e-6;

double distance_to_piece(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  const glm::dvec2 delta = b - a;
  const double squared = glm::dot(delta, delta);
  const double share = squared > 0 ? std::clamp(glm::dot(p - a, delta) / squared, 0.0, 1.0) : 0;
  return glm::distance(p, a + delta * share);
}

bool is_beyond(const Extent& box, const glm::dvec2& p, double margin) {
  return p.x < box.min.x - margin || p.y < box.min.y - margin || p.x > box.max.x + margin ||
         p.y > box.max.y + margin;
}

/// Returns the extent of a rectangle along a direction.
double reach_along(const Footprint& footprint, const glm::dvec2& delta) {
  return footprint.half.x * std::abs(delta.x * footprint.cos - delta.y * footprint.sin) +
         footprint.half.y * std::abs(delta.x * footprint.sin + delta.y * footprint.cos);
}

}  // namespace

/// Two rectangles are disjoint if they are disjoint along a side of one of them.
bool overlap(const Footprint& a, const Footprint& b) {
  const glm::dvec2 delta = b.at - a.at;
  if (a.round) return glm::length(delta) < (a.half.x + b.half.x) * (1 - touching);
  for (const glm::dvec2& side : {glm::dvec2(a.cos, -a.sin), glm::dvec2(a.sin, a.cos),
                                 glm::dvec2(b.cos, -b.sin), glm::dvec2(b.sin, b.cos)}) {
    const double sum = reach_along(a, side) + reach_along(b, side);
    if (std::abs(glm::dot(delta, side)) >= sum * (1 - touching)) return false;
  }
  return true;
}

Footprint Footprint::of(const Placement& placement, const glm::dvec2& half, bool round) {
  const math::SinCos turn = math::sincos(static_cast<double>(placement.turn));
  return {placement.at, half * static_cast<double>(placement.scale), turn.cos, turn.sin, round};
}

double Footprint::outside(const glm::dvec2& p) const {
  const glm::dvec2 delta = p - at;
  if (round) return glm::length(delta) - half.x;
  const glm::dvec2 own(delta.x * cos - delta.y * sin, delta.x * sin + delta.y * cos);
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

bool PathBand::covers(const glm::dvec2& p, double margin) const {
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

PathBand path_band_of(std::vector<glm::dvec2> points, double width) {
  PathBand band;
  const auto covered = [&](std::size_t first, std::size_t count) {
    Extent box = extent_of(std::span<const glm::dvec2>(points).subspan(first, count));
    box.min -= width / 2;
    box.max += width / 2;
    return box;
  };
  band.box = covered(0, points.size());
  for (std::size_t first = 0; first + 1 < points.size(); first += pieces_a_box)
    band.boxes.push_back(covered(first, std::min(pieces_a_box + 1, points.size() - first)));
  band.points = std::move(points);
  band.half_width = width / 2;
  return band;
}

Neighbours::Neighbours(const Extent& extent, double cell, const Job& job)
    : extent_(extent), head_(job), next_(job), id_(job), position_(job) {
  const glm::dvec2 size = extent.size();
  const double side = std::max({cell, size.x / most_squares_a_side, size.y / most_squares_a_side, 1e-6});
  per_cell_ = 1 / side;
  wide_ = static_cast<std::size_t>(math::to_int64(size.x * per_cell_)) + 1;
  deep_ = static_cast<std::size_t>(math::to_int64(size.y * per_cell_)) + 1;
  head_.resize(wide_ * deep_);
  std::fill(head_.begin(), head_.end(), none);
}

Neighbours::Square Neighbours::square_of(const glm::dvec2& at) const {
  const glm::dvec2 position = (at - extent_.min) * per_cell_;
  return {math::to_int32(std::clamp(position.x, 0.0, static_cast<double>(wide_ - 1))),
          math::to_int32(std::clamp(position.y, 0.0, static_cast<double>(deep_ - 1)))};
}

void Neighbours::add(const glm::dvec2& at, std::uint32_t id) {
  const Square square = square_of(at);
  std::uint32_t& head =
      head_[static_cast<std::size_t>(square.z) * wide_ + static_cast<std::size_t>(square.x)];
  next_.push_back(head);
  head = static_cast<std::uint32_t>(position_.size());
  position_.push_back(at);
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

bool FootprintSet::take(const Footprint& footprint) {
  const bool meets = by_position_.any(footprint.at, widest_ + footprint.reach(),
                                      [&](std::uint32_t id, double) { return overlap(all_[id], footprint); });
  if (meets) return false;
  by_position_.add(footprint.at, static_cast<std::uint32_t>(all_.size()));
  all_.push_back(footprint);
  widest_ = std::max(widest_, footprint.reach());
  return true;
}

}  // namespace seedmesh::scene
