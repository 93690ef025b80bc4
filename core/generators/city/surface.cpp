#include "core/generators/city/surface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/base/parallel.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double natural_slope = 0.45;  // of the natural ground within blocks
constexpr double edge_spacing = 6;      // of vertices along edges, m
constexpr double same_height = 1e-3;    // m
constexpr double lattice_spacing = 5;   // m
constexpr std::int32_t most_columns = 1500;
constexpr std::size_t grounds_a_chunk = 4;

bool is_low(PartKind kind) { return kind == PartKind::carriageway || kind == PartKind::junction; }

/// Heights without slopes above the limit: the mean of the greatest ones below and the least ones above, by two sweeps
/// over a lattice each (Borgefors, "Distance transformations in digital images", 1986).
void limit_lattice(std::vector<double>& heights, std::int32_t columns, std::int32_t rows, double rise,
                   const Job& job) {
  const auto spread = [&](std::vector<double>& values) {
    const auto at = [columns](std::int32_t x, std::int32_t y) {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
    };
    const auto relax = [&](std::int32_t x, std::int32_t y, std::int32_t dx, std::int32_t dy) {
      const std::int32_t u = x + dx, v = y + dy;
      if (u < 0 || v < 0 || u >= columns || v >= rows) return;
      const double step = rise * (dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0);
      values[at(x, y)] = std::min(values[at(x, y)], values[at(u, v)] + step);
    };
    for (std::int32_t y = 0; y < rows; ++y) {
      job.check();
      for (std::int32_t x = 0; x < columns; ++x) {
        for (const std::int32_t dx : {-1, 0, 1}) relax(x, y, dx, -1);
        relax(x, y, -1, 0);
      }
    }
    for (std::int32_t y = rows; y-- > 0;) {
      job.check();
      for (std::int32_t x = columns; x-- > 0;) {
        for (const std::int32_t dx : {-1, 0, 1}) relax(x, y, dx, 1);
        relax(x, y, 1, 0);
      }
    }
  };
  std::vector<double> low(heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) low[i] = 0 - heights[i];
  spread(heights);
  spread(low);
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = (heights[i] - low[i]) / 2;
}

}  // namespace

Surface::Surface(const CityPlan& plan, double wall_height, Job& job)
    : plan_(plan), wall_height_(wall_height) {
  find_edges(job);
  divide_carriageways(job);
  if (is_level()) return;
  tunnels_ = Tunnels(plan, part_of_edge_);
  limit_natural_ground(job);
  grounds_.resize(plan.blocks.size());
  ground_of_.assign(plan.parts.size(), no_index);
  for (std::uint32_t n = 0; n < plan.parts.size(); ++n) {
    const Part& part = plan.parts[n];
    if (is_street_space(part) || part.kind == PartKind::water) continue;
    ground_of_[n] = part.block != no_index ? part.block : static_cast<std::uint32_t>(grounds_.size());
    if (part.block == no_index) grounds_.emplace_back();
    grounds_[ground_of_[n]].parts.push_back(n);
  }
  parallel_for(job, grounds_.size(), grounds_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t i = begin; i < end; ++i) limit_border(grounds_[i]);
  });
  water_level_.assign(plan.parts.size(), 0);
  for (std::uint32_t n = 0; n < plan.parts.size(); ++n) {
    if (plan.parts[n].kind == PartKind::water) water_level_[n] = level_of_water(plan.parts[n]);
  }
}

/// On level ground without town walls, walls stand only at the edges of low parts.
void Surface::find_edges(const Job& job) {
  const bool has_wall =
      std::any_of(plan_.parts.begin(), plan_.parts.end(), [](const Part& part) { return part.is_wall; });
  const auto counts = [&](const Part& part) {
    return !is_level() || has_wall || is_low(part.kind) || part.kind == PartKind::water;
  };
  std::size_t count = 0;
  for (const Part& part : plan_.parts) {
    if (!counts(part)) continue;
    for (const CmRing& ring : part.rings) count += ring.size();
  }
  // Nearly all edges have a part on both sides. Low parts share few of their edges.
  const bool has_all = !is_level() || has_wall;
  part_of_edge_ = EdgeTable(has_all ? count / 2 + count / 16 : count - count / 8);
  for (std::uint32_t n = 0; n < plan_.parts.size(); ++n) {
    if (n % 1024 == 0) job.check();
    if (!counts(plan_.parts[n])) continue;
    for (const CmRing& ring : plan_.parts[n].rings) {
      for (std::size_t i = 0; i < ring.size(); ++i)
        part_of_edge_.add(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0], n);
    }
  }
}

void Surface::release_edges() {
  part_of_edge_ = {};
  strips_ = {};
  divided_at_ = {};
  divided_ = {};
  edge_points_ = {};
}

void Surface::divide_edge(const CmPoint& from, const CmPoint& to, std::span<const dvec2> points) {
  divided_at_.add(std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(divided_.size()));
  divided_.push_back(
      {static_cast<std::uint32_t>(edge_points_.size()), static_cast<std::uint32_t>(points.size())});
  edge_points_.insert(edge_points_.end(), points.begin(), points.end());
  if (to < from)
    std::reverse(edge_points_.end() - static_cast<std::ptrdiff_t>(points.size()), edge_points_.end());
}

/// Kerbs have the ends of the strips, and the ends of carriageways no further vertices.
void Surface::divide_carriageways(const Job& job) {
  constexpr std::size_t divided_a_street = 8;
  strips_.resize(plan_.graph.edges.size());
  divided_at_ = EdgeTable(divided_a_street * plan_.graph.edges.size());
  std::vector<dvec2> points;
  for (std::uint32_t edge = 0; edge < plan_.graph.edges.size(); ++edge) {
    if (!plan_.graph.is_street(edge)) continue;
    job.check();
    strips_[edge] = strips_of_street(plan_, edge);
    const StreetStrips& strips = strips_[edge];
    if (strips.lines.empty()) continue;
    const std::array<CmPoint, 4>& corners = plan_.kerbs[edge];
    for (const bool is_left : {true, false}) {
      points.clear();
      for (std::size_t i = 1; i + 1 < strips.lines.size(); ++i)
        points.push_back(is_left ? strips.lines[i].left : strips.lines[i].right);
      divide_edge(corners[is_left ? 0 : 2], corners[is_left ? 1 : 3], points);
    }
    for (const bool is_start : {true, false}) {
      const CmPoint &left = corners[is_start ? 0 : 1], &right = corners[is_start ? 2 : 3];
      // A node on the border of the area can be a corner between them.
      const PlanarEdge& each = plan_.graph.edges[edge];
      const CmPoint& node = plan_.graph.nodes[is_start ? each.from : each.to];
      divide_edge(left, right, {});
      divide_edge(left, node, {});
      divide_edge(node, right, {});
    }
  }
}

double Surface::street_height(const Part& part, const dvec2& metres) const {
  if (part.kind == PartKind::junction) return plan_.heights.node[part.node];
  const StreetGraph& graph = plan_.graph;
  const PlanarEdge& edge = graph.edges[part.street];
  const dvec2 from = in_cm(graph.nodes[edge.from]), along = in_cm(graph.nodes[edge.to]) - from;
  const double station = glm::dot(metres * 100.0 - from, along / glm::length(along)) / 100;
  return height_on_street(plan_.heights, part.street, station);
}

double Surface::height(std::uint32_t number, const dvec2& metres) const {
  const Part& part = plan_.parts[number];
  const double raised = is_low(part.kind) ? 0 : part.is_wall ? wall_height_ : kerb_height;
  if (is_level()) return part.kind == PartKind::water ? 0 - water_depth : raised;
  if (part.kind == PartKind::water) return water_level_[number];
  if (is_street_space(part)) return street_height(part, metres) + raised;
  return ground_height(grounds_[ground_of_[number]], metres);
}

void Surface::points_between(const CmPoint& a, const CmPoint& b, std::vector<dvec2>& points) const {
  points.clear();
  const std::uint32_t number = divided_at_.value_of(std::min(a, b), std::max(a, b));
  if (number != EdgeTable::absent) {
    const auto first = edge_points_.begin() + divided_[number].first;
    points.assign(first, first + divided_[number].count);
    if (b < a) std::reverse(points.begin(), points.end());
    return;
  }
  if (is_level()) return;
  const int count = math::to_int32(std::ceil(distance(a, b) / (edge_spacing * 100)));
  const dvec2 low = in_metres(std::min(a, b)), along = in_metres(std::max(a, b)) - low;
  for (int k = 1; k < count; ++k) points.push_back(low + along * (static_cast<double>(k) / count));
  if (!tunnels_.all().empty()) {
    std::erase_if(points, [this](const dvec2& p) { return tunnels_.lintel(p).has_value(); });
    tunnels_.append_corners(a, b, points);
    std::sort(points.begin(), points.end(), [&](const dvec2& p, const dvec2& q) {
      return glm::dot(p - low, along) < glm::dot(q - low, along);
    });
  }
  if (b < a) std::reverse(points.begin(), points.end());
}

std::uint32_t Surface::part_beyond(const CmPoint& a, const CmPoint& b) const {
  return part_of_edge_.value_of(b, a);
}

/// The outer edges of the streets around a ground.
std::vector<BorderPoint> Surface::border_of(const Ground& ground) const {
  std::vector<dvec2> between;
  std::vector<BorderPoint> border;
  const auto add = [&](const Part& street, const dvec2& at) {
    if (!border.empty() && border.back().at == at) return;
    border.push_back({at, street_height(street, at) + kerb_height});
  };
  for (const std::uint32_t number : ground.parts) {
    for (const CmRing& ring : plan_.parts[number].rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const CmPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
        const std::uint32_t beyond = part_beyond(a, b);
        if (beyond == no_index || !is_street_space(plan_.parts[beyond])) continue;
        const Part& street = plan_.parts[beyond];
        add(street, in_metres(a));
        points_between(a, b, between);
        for (const dvec2& p : between) add(street, p);
        add(street, in_metres(b));
      }
    }
  }
  return border;
}

/// The border of a ground, raised and lowered where embankments would be too steep.
void Surface::limit_border(Ground& ground) const {
  std::vector<BorderPoint> border = border_of(ground);
  const BorderHeights given(border);
  std::vector<double> limited;
  limited.reserve(border.size());
  for (const BorderPoint& p : border) limited.push_back(std::max(given.limited(p), tunnels_.cover(p.at)));
  // A wall stands on one side of an edge only.
  for (std::size_t i = 0; i + 1 < border.size(); ++i) {
    const double here = limited[i] - border[i].height, next = limited[i + 1] - border[i + 1].height;
    if (here * next >= 0) continue;
    const std::size_t less = std::abs(here) < std::abs(next) ? i : i + 1;
    limited[less] = border[less].height;
  }
  for (std::size_t i = 0; i < border.size(); ++i) {
    if (std::abs(limited[i] - border[i].height) > same_height) border[i].height = limited[i];
  }
  ground.border = BorderHeights(std::move(border));
}

double Surface::ground_height(const Ground& ground, const dvec2& metres) const {
  return std::max(ground.border.at(metres, natural_height(metres)), tunnels_.cover(metres));
}

void Surface::limit_natural_ground(const Job& job) {
  dvec2 high = in_metres(plan_.area[0][0]);
  low_ = high;
  for (const CmPoint& p : plan_.area[0]) {
    low_ = glm::min(low_, in_metres(p));
    high = glm::max(high, in_metres(p));
  }
  cell_ = std::max(lattice_spacing, std::max(high.x - low_.x, high.y - low_.y) / most_columns);
  columns_ = math::to_int32(std::ceil((high.x - low_.x) / cell_)) + 1;
  rows_ = math::to_int32(std::ceil((high.y - low_.y) / cell_)) + 1;
  natural_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  constexpr double above_water = 0.3;
  const double least = plan_.landform->water_level().value_or(-1e9) + above_water;
  for (std::int32_t y = 0; y < rows_; ++y) {
    job.check();
    for (std::int32_t x = 0; x < columns_; ++x)
      natural_.push_back(std::max(least, plan_.landform->at(low_ + dvec2(x, y) * cell_)));
  }
  limit_lattice(natural_, columns_, rows_, natural_slope * cell_, job);
}

double Surface::natural_height(const dvec2& metres) const {
  const double x = std::clamp((metres.x - low_.x) / cell_, 0.0, columns_ - 1.0);
  const double y = std::clamp((metres.y - low_.y) / cell_, 0.0, rows_ - 1.0);
  const std::int32_t i = std::min(math::to_int32(x), columns_ - 2),
                     j = std::min(math::to_int32(y), rows_ - 2);
  const double u = x - i, v = y - j;
  const auto at = [&](std::int32_t column, std::int32_t row) {
    return natural_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
  };
  return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) +
         (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
}

/// That of the terrain, or below the lowest point of the shore.
double Surface::level_of_water(const Part& part) const {
  double least = 1e300;
  for (const CmRing& ring : part.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t beyond = part_beyond(ring[i], ring[(i + 1) % ring.size()]);
      if (beyond == no_index || plan_.parts[beyond].kind == PartKind::water) continue;
      for (const CmPoint& p : {ring[i], ring[(i + 1) % ring.size()]})
        least = std::min(least, height(beyond, in_metres(p)));
    }
  }
  if (least > 1e299) least = natural_height(in_metres(part.rings[0][0])) + water_depth;
  const double below = least - water_depth;
  return plan_.landform->water_level() ? std::max(*plan_.landform->water_level(), below) : below;
}

double Surface::floor_height(const Footing& footing, double& lowest) const {
  lowest = height(footing.part, footing.position);
  if (is_level()) return lowest;
  double highest = lowest;
  const math::SinCos turn = math::sincos_degrees(footing.turn);
  constexpr int steps = 4, middle = steps / 2;
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= steps; ++k) {
      const double x = footing.width * (i - middle) / steps, y = footing.depth * (k - middle) / steps;
      const dvec2 at = footing.position + dvec2(x * turn.cos - y * turn.sin, x * turn.sin + y * turn.cos);
      const double here = height(footing.part, at);
      highest = std::max(highest, here);
      lowest = std::min(lowest, here);
    }
  }
  return highest;
}

}  // namespace seedmesh::city
