// Streamlines of a tensor field and the streets that they become; see tensor.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "core/base/math.h"
#include "core/generators/city/growth.h"
#include "core/generators/city/tensor.h"
#include "core/geom/polygon/segment_pairs.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;
using Line = std::vector<dvec2>;

constexpr double step = 800;                                 // of the integration, cm
constexpr double piece_length = 3000;                        // of a street that others can join, cm
constexpr double margin = 4000;                              // around the area, cm
constexpr double seed_distance = 0.95, end_distance = 0.62;  // of the spacing
constexpr double shortest = 2000;                            // between two crossings of a street, cm
constexpr double least_density = 0.1;
constexpr std::uint32_t major = static_cast<std::uint32_t>(EdgeClass::major),
                        minor = static_cast<std::uint32_t>(EdgeClass::minor),
                        highway = static_cast<std::uint32_t>(EdgeClass::highway);

std::uint64_t point_key(const CmPoint& p) {
  return key_at(key_at(0x7E45, static_cast<std::uint32_t>(p.x)), static_cast<std::uint32_t>(p.y));
}

/// The points of the streamlines of one direction, by squares of the spacing.
class PointGrid {
 public:
  explicit PointGrid(double cell) : cell_(cell) {}
  void add(const dvec2& p) { cells_[key(p, 0, 0)].push_back(p); }
  bool has_near(const dvec2& p, double distance) const {
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto at = cells_.find(key(p, dx, dy));
        if (at == cells_.end()) continue;
        for (const dvec2& other : at->second) {
          if (glm::dot(other - p, other - p) < distance * distance) return true;
        }
      }
    }
    return false;
  }

 private:
  std::pair<std::int32_t, std::int32_t> key(const dvec2& p, int dx, int dy) const {
    return {math::to_int32(std::floor(p.x / cell_)) + dx, math::to_int32(std::floor(p.y / cell_)) + dy};
  }
  double cell_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<dvec2>> cells_;
};

class Tracer {
 public:
  /// `spacing`: of the lines of one direction, cm.
  Tracer(const GrowthInput& input, const TensorField& field, double spacing)
      : field_(field), spacing_(spacing), grids_{PointGrid(spacing_), PointGrid(spacing_)} {
    low_ = high_ = in_cm(input.region.outline.front().a);
    for (const OutlineEdge& edge : input.region.outline) {
      low_ = glm::min(low_, in_cm(edge.a));
      high_ = glm::max(high_, in_cm(edge.a));
    }
    low_ -= dvec2(margin);
    high_ += dvec2(margin);
  }

  /// Keeps further lines of a direction away from these.
  void keep_off(const std::vector<Line>& lines, std::size_t family) {
    for (const Line& line : lines) {
      for (const dvec2& p : line) grids_[family].add(p);
    }
  }

  /// Lines of both directions from the points of a jittered lattice, in the order of their keys.
  std::array<std::vector<Line>, 2> trace(const Rng& rng, Job& job) {
    std::vector<std::pair<std::uint64_t, dvec2>> seeds;
    const double cell = spacing_ / 2;
    const auto first = [cell](double v) { return math::to_int32(std::floor(v / cell)); };
    for (std::int32_t i = first(low_.x); i <= first(high_.x); ++i) {
      for (std::int32_t k = first(low_.y); k <= first(high_.y); ++k) {
        Rng draw = rng.at(point_key({i, k}));
        const std::uint64_t order = draw.at("order").key();
        const double east = i + draw.unit(), north = k + draw.unit();
        seeds.emplace_back(order, dvec2(east, north) * cell);
      }
    }
    std::sort(seeds.begin(), seeds.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::array<std::vector<Line>, 2> lines;
    Meter meter(job, Resource::shapes);
    for (const auto& [order, seed] : seeds) {
      job.check();
      for (const std::size_t family : {std::size_t{0}, std::size_t{1}}) {
        if (!is_inside(seed) || grids_[family].has_near(seed, spacing_ * seed_distance)) continue;
        Line line = line_through(seed, family);
        if (static_cast<double>(line.size()) * step < spacing_ * 0.8) continue;
        meter.spend(line.size());
        for (const dvec2& p : line) grids_[family].add(p);
        lines[family].push_back(std::move(line));
      }
    }
    return lines;
  }

 private:
  bool is_inside(const dvec2& p) const {
    return p.x >= low_.x && p.x <= high_.x && p.y >= low_.y && p.y <= high_.y;
  }

  dvec2 direction(const dvec2& p, std::size_t family, const dvec2& before) const {
    dvec2 d = field_.direction_at(p);
    if (family == 1) d = {-d.y, d.x};
    return glm::dot(d, before) < 0 ? -d : d;
  }

  /// One step of the method of Runge and Kutta of order four.
  dvec2 next(const dvec2& p, std::size_t family, const dvec2& before) const {
    const dvec2 k1 = direction(p, family, before), k2 = direction(p + k1 * (step / 2), family, k1),
                k3 = direction(p + k2 * (step / 2), family, k2), k4 = direction(p + k3 * step, family, k3);
    return p + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (step / 6);
  }

  Line line_through(const dvec2& seed, std::size_t family) const {
    Line line = half_line(seed, family, 1);
    const bool is_closed = line.size() > 3 && line.back() == line.front();
    if (is_closed) return line;
    Line back = half_line(seed, family, -1);
    std::reverse(back.begin(), back.end());
    back.pop_back();
    back.insert(back.end(), line.begin(), line.end());
    return back;
  }

  /// From a seed until the line leaves the area, comes near to another line, or meets its own start.
  Line half_line(const dvec2& seed, std::size_t family, int sign) const {
    constexpr std::size_t most_points = 20'000;
    Line line = {seed};
    dvec2 before = direction(seed, family, {0, 0}) * static_cast<double>(sign);
    const auto own =
        static_cast<std::size_t>(spacing_ * 1.6 / step);  // points of the line itself that are near
    while (line.size() < most_points) {
      const dvec2 p = next(line.back(), family, before);
      const dvec2 moved = p - line.back();
      if (glm::dot(moved, moved) < step * step / 4) break;  // a degenerate point
      if (line.size() > own && glm::length(p - seed) < spacing_ * end_distance) {
        if (sign > 0) line.push_back(seed);
        break;
      }
      if (grids_[family].has_near(p, spacing_ * end_distance) || is_near_itself(line, p, own)) break;
      line.push_back(p);
      if (!is_inside(p)) break;
      before = moved / glm::length(moved);
    }
    return line;
  }

  bool is_near_itself(const Line& line, const dvec2& p, std::size_t own) const {
    const double least = spacing_ * end_distance;
    for (std::size_t i = 0; i + own < line.size(); i += 4) {
      if (glm::length(line[i] - p) < least) return true;
    }
    return false;
  }

  const TensorField& field_;
  double spacing_;
  std::array<PointGrid, 2> grids_;
  dvec2 low_{0}, high_{0};
};

/// A crossing on a line: the position along it, in points.
struct Stop {
  double at = 0;
  CmPoint p;
};

/// The crossings of lines of different directions, by line.
std::vector<std::vector<Stop>> stops_of(const std::vector<Line>& lines, std::size_t first_of_second,
                                        const Job& job) {
  std::vector<Segment> segments;
  std::vector<std::pair<std::size_t, std::size_t>> source;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    for (std::size_t i = 0; i + 1 < lines[n].size(); ++i) {
      segments.push_back({lines[n][i], lines[n][i + 1]});
      source.emplace_back(n, i);
    }
  }
  std::vector<std::vector<Stop>> stops(lines.size());
  each_near_pair(segments, 1, &job, [&](std::size_t i, std::size_t k) {
    if ((source[i].first < first_of_second) == (source[k].first < first_of_second)) return true;
    const dvec2 a = segments[i].from, along = segments[i].to - a, c = segments[k].from,
                across = segments[k].to - c;
    const double scale = along.x * across.y - along.y * across.x;
    if (scale == 0) return true;
    const double share = ((c.x - a.x) * across.y - (c.y - a.y) * across.x) / scale;
    const double other = ((c.x - a.x) * along.y - (c.y - a.y) * along.x) / scale;
    if (share < 0 || share >= 1 || other < 0 || other >= 1) return true;
    const CmPoint p = rounded_cm(a + along * share);
    stops[source[i].first].push_back({static_cast<double>(source[i].second) + share, p});
    stops[source[k].first].push_back({static_cast<double>(source[k].second) + other, p});
    return true;
  });
  for (std::vector<Stop>& each : stops)
    std::sort(each.begin(), each.end(), [](const Stop& u, const Stop& v) { return u.at < v.at; });
  return stops;
}

dvec2 point_on(const Line& line, double at) {
  const auto i = std::min(static_cast<std::size_t>(math::to_int32(std::floor(at))), line.size() - 2);
  return line[i] + (line[i + 1] - line[i]) * (at - static_cast<double>(i));
}

/// A street between two crossings, or from one to the end of its line.
struct Span {
  std::vector<CmPoint> points;
  bool has_end = false;  ///< whether it ends at a crossing
  std::uint32_t kind = major;
};

/// The points of a line between two positions, ends included.
std::vector<CmPoint> points_between(const Line& line, double from, double to) {
  const double length = std::abs(to - from) * step;
  const int count = std::max(1, math::to_int32(length / piece_length + 0.5));
  std::vector<CmPoint> points;
  for (int n = 0; n <= count; ++n)
    points.push_back(rounded_cm(point_on(line, from + (to - from) * n / count)));
  return points;
}

std::vector<Span> spans_of(const Line& line, const std::vector<Stop>& stops, std::uint32_t kind) {
  std::vector<Span> spans;
  if (stops.empty()) return spans;
  const auto add = [&](double from, double to, const CmPoint& start, const CmPoint* end) {
    if (std::abs(to - from) * step < shortest) return;
    Span span{points_between(line, from, to), end != nullptr, kind};
    span.points.front() = start;
    if (end) span.points.back() = *end;
    spans.push_back(std::move(span));
  };
  add(stops.front().at, 0, stops.front().p, nullptr);
  for (std::size_t i = 1; i < stops.size(); ++i)
    add(stops[i - 1].at, stops[i].at, stops[i - 1].p, &stops[i].p);
  add(stops.back().at, static_cast<double>(line.size() - 1), stops.back().p, nullptr);
  return spans;
}

/// Removes one arm of a share of the crossings of four arms, never two of one crossing and never a highway.
void make_t_junctions(std::vector<Span>& spans, double share, const Rng& rng) {
  std::map<CmPoint, std::vector<std::size_t>> arms;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    arms[spans[i].points.front()].push_back(i);
    if (spans[i].has_end) arms[spans[i].points.back()].push_back(i);
  }
  std::vector<std::pair<std::uint64_t, CmPoint>> order;
  for (const auto& [p, list] : arms) order.emplace_back(rng.at(point_key(p)).key(), p);
  std::sort(order.begin(), order.end());
  std::map<CmPoint, bool> is_done;
  for (const auto& [key, p] : order) {
    Rng draw = rng.at(point_key(p));
    if (arms[p].size() != 4 || is_done[p] || draw.unit() >= share) continue;
    const std::size_t first = draw.below(4);
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t i = arms[p][(first + n) % 4];
      Span& span = spans[i];
      if (!span.has_end || span.points.empty() || span.kind == highway) continue;
      const CmPoint other = span.points.front() == p ? span.points.back() : span.points.front();
      if (is_done[other] || arms[other].size() != 4) continue;
      is_done[p] = is_done[other] = true;
      span.points.clear();
      break;
    }
  }
}

/// The streamlines of both directions, and the classes of their streets.
struct Streamlines {
  std::vector<Line> lines;
  std::vector<std::uint32_t> kinds;
  std::size_t first_of_second = 0;  ///< the first line of the second direction

  void add(std::vector<Line> more, std::uint32_t kind) {
    kinds.insert(kinds.end(), more.size(), kind);
    for (Line& line : more) lines.push_back(std::move(line));
  }
};

/// Highways first, then major streets between them.
Streamlines streamlines_of(const GrowthInput& input, const TensorField& field, const Rng& rng, Job& job) {
  const CityStreets& streets = input.streets;
  std::array<std::vector<Line>, 2> highways;
  Tracer tracer(input, field, streets.major_spacing * 100);
  if (streets.highway_spacing > 0) {
    const double spacing = std::max(streets.highway_spacing, streets.major_spacing) * 100;
    highways = Tracer(input, field, spacing).trace(rng.at("highways"), job);
    for (const std::size_t family : {std::size_t{0}, std::size_t{1}})
      tracer.keep_off(highways[family], family);
  }
  std::array<std::vector<Line>, 2> majors = tracer.trace(rng.at("seeds"), job);
  Streamlines all;
  all.add(std::move(highways[0]), highway);
  all.add(std::move(majors[0]), major);
  all.first_of_second = all.lines.size();
  all.add(std::move(highways[1]), highway);
  all.add(std::move(majors[1]), major);
  return all;
}

/// The street of a span, with tunnels where it needs them. On ground that is too steep for its class, those pieces that
/// can be minor streets.
std::optional<Route> free_route(const GrowthInput& input, const Span& span) {
  const double bridge_length = input.streets.bridge_length * 100;
  Route built = route_of(input.region, span.points, span.kind, bridge_length);
  if (input.is_free(built)) return built;
  if (std::optional<Route> tunnelled = input.tunnelled(built)) return tunnelled;
  if (!input.landform) return std::nullopt;
  built = route_of(input.region, span.points, minor, bridge_length);
  if (!built.separated.empty()) return input.is_free(built) ? std::optional(built) : std::nullopt;
  std::erase_if(built.pieces, [&](const StreetPiece& piece) { return !input.is_free({{piece}, {}, true}); });
  return built;
}

}  // namespace

Route trace_majors(const GrowthInput& input, const TensorField& field, Job& job) {
  const Rng rng = job.rng().at("tensor");
  const Streamlines all = streamlines_of(input, field, rng, job);
  const std::vector<std::vector<Stop>> stops = stops_of(all.lines, all.first_of_second, job);
  std::vector<Span> spans;
  for (std::size_t n = 0; n < all.lines.size(); ++n) {
    for (Span& span : spans_of(all.lines[n], stops[n], all.kinds[n])) spans.push_back(std::move(span));
  }
  make_t_junctions(spans, input.streets.tensor.t_junctions, rng.at("arms"));
  Route route;
  for (Span& span : spans) {
    if (span.points.empty()) continue;
    job.check();
    if (span.has_end && !is_on_land(input.region, in_cm(span.points.front())))
      std::reverse(span.points.begin(), span.points.end());
    const CmPoint& middle = span.points[span.points.size() / 2];
    if (!is_on_land(input.region, in_cm(span.points.front()))) continue;
    if (input.density.at(in_metres(span.points.front())) < least_density ||
        input.density.at(in_metres(middle)) < least_density)
      continue;
    std::optional<Route> free = free_route(input, span);
    if (!free) continue;
    Route built = *std::move(free);
    if (meets_separated(built, route.separated) ||
        (input.given && meets_separated(built, input.given->separated)))
      continue;
    route.pieces.insert(route.pieces.end(), built.pieces.begin(), built.pieces.end());
    route.separated.insert(route.separated.end(), built.separated.begin(), built.separated.end());
  }
  return route;
}

}  // namespace seedmesh::city
