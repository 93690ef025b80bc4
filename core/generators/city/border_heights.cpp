// Heights between given ones by McShane's extension, "Extension of range of functions", 1934.
#include "core/generators/city/border_heights.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double slope = 0.5;  // of embankments, rise over run
constexpr std::size_t points_a_stretch = 16;

double squared_length(const dvec2& v) { return v.x * v.x + v.y * v.y; }

}  // namespace

BorderHeights::BorderHeights(std::vector<BorderPoint> points) : points_(std::move(points)) {
  for (std::size_t begin = 0; begin < points_.size(); begin += points_a_stretch) {
    const BorderPoint& first = points_[begin];
    Stretch stretch{first.at,     first.at, first.height,
                    first.height, begin,    std::min(points_a_stretch, points_.size() - begin)};
    for (const BorderPoint& p : points_of(stretch)) {
      stretch.low = glm::min(stretch.low, p.at);
      stretch.high = glm::max(stretch.high, p.at);
      stretch.least = std::min(stretch.least, p.height);
      stretch.most = std::max(stretch.most, p.height);
    }
    stretches_.push_back(stretch);
  }
}

/// At most that to each of its points, also after rounding.
double BorderHeights::squared_distance(const Stretch& stretch, const dvec2& position) {
  return squared_length(glm::max(glm::max(stretch.low - position, position - stretch.high), dvec2(0)));
}

double BorderHeights::limited(const BorderPoint& point) const {
  double low = point.height, high = point.height;
  for (const Stretch& stretch : stretches_) {
    const double least_rise = slope * std::sqrt(squared_distance(stretch, point.at));
    if (stretch.most - least_rise <= low && stretch.least + least_rise >= high) continue;
    for (const BorderPoint& q : points_of(stretch)) {
      const double rise = slope * std::sqrt(squared_length(q.at - point.at));
      low = std::max(low, q.height - rise);
      high = std::min(high, q.height + rise);
    }
  }
  return low == point.height && high == point.height ? point.height : (low + high) / 2;
}

double BorderHeights::at(const dvec2& position, double natural) const {
  double low = natural, high = natural;
  for (const Stretch& stretch : stretches_) {
    const double most_above = std::max(stretch.most - natural, natural - stretch.least);
    if (most_above * most_above < slope * slope * squared_distance(stretch, position)) continue;
    for (const BorderPoint& p : points_of(stretch)) {
      const double squared = squared_length(p.at - position), above = p.height - natural;
      if (squared == 0) return p.height;
      if (above * above <= slope * slope * squared) continue;  // most points; without a square root
      const double rise = slope * std::sqrt(squared);
      low = std::max(low, p.height - rise);
      high = std::min(high, p.height + rise);
    }
  }
  return low > natural ? std::min(low, highest_below(position)) : high;
}

double BorderHeights::highest_below(const dvec2& position) const {
  double high = 1e300;
  for (const Stretch& stretch : stretches_) {
    if (stretch.least + slope * std::sqrt(squared_distance(stretch, position)) >= high) continue;
    for (const BorderPoint& p : points_of(stretch))
      high = std::min(high, p.height + slope * std::sqrt(squared_length(p.at - position)));
  }
  return high;
}

}  // namespace seedmesh::city
