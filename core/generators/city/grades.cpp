// Lipschitz limits of heights on a graph, after the extension of McShane, "Extension of range of functions", 1934.
#include "core/generators/city/grades.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <queue>

#include "core/base/math.h"
#include "core/generators/city/landform.h"
#include "core/generators/city/plan.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double sample_spacing = 10;   // m
constexpr double past_corners = 0.02;   // m: covers the rounding of corners to centimetres
constexpr double shortest_slope = 0.5;  // m: a shorter street between two corners is level
constexpr double resolution = 1e-5;     // of heights, m
constexpr double clearance = 5.5;       // of a bridge above the streets, m, for each level
constexpr double steepest_ramp = 0.06;
constexpr int smoothing_rounds = 12;

double rounded(double height) { return std::floor(height / resolution + 0.5) * resolution; }

/// Vertices with heights, and links with the greatest difference of the heights of their ends.
class GradeGraph {
 public:
  struct Link {
    std::uint32_t a = 0, b = 0;
    double rise = 0, length = 0;
  };
  std::vector<double> ground;
  std::vector<Link> links;

  void index() {
    first_.assign(ground.size() + 1, 0);
    for (const Link& link : links) {
      ++first_[link.a + 1];
      ++first_[link.b + 1];
    }
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    arms_.resize(links.size() * 2);
    std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
    for (std::uint32_t n = 0; n < links.size(); ++n) {
      arms_[at[links[n].a]++] = n;
      arms_[at[links[n].b]++] = n;
    }
  }

  /// The mean of the highest and the lowest heights that keep all links on ways of at most `reach` metres.
  std::vector<double> limited(const std::vector<double>& heights, double reach, const Job& job) const {
    std::vector<double> low(heights.size()), high = spread(heights, reach, job);
    for (std::size_t i = 0; i < heights.size(); ++i) low[i] = 0 - heights[i];
    low = spread(low, reach, job);
    for (std::size_t i = 0; i < heights.size(); ++i) high[i] = (high[i] - low[i]) / 2;
    return high;
  }

  /// Moves each height towards the mean of its neighbours, weighted by their nearness.
  void smooth(std::vector<double>& heights) const {
    std::vector<double> next(heights.size());
    for (int round = 0; round < smoothing_rounds; ++round) {
      for (std::uint32_t i = 0; i < heights.size(); ++i) {
        double sum = 0, weights = 0;
        for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k) {
          const Link& link = links[arms_[k]];
          const double weight = 1 / std::max(link.length, 1.0);
          sum += heights[link.a == i ? link.b : link.a] * weight;
          weights += weight;
        }
        next[i] = weights > 0 ? (heights[i] + sum / weights) / 2 : heights[i];
      }
      std::swap(heights, next);
    }
  }

 private:
  /// The least of the heights plus distances: Dijkstra's algorithm from all vertices at once. Ways end at `reach`.
  std::vector<double> spread(const std::vector<double>& heights, double reach, const Job& job) const {
    std::vector<double> least = heights;
    std::vector<double> way(reach < everywhere ? least.size() : 0,
                            0.0);  // length of the way to each vertex, m
    using Entry = std::pair<double, std::uint32_t>;
    std::vector<Entry> entries;
    entries.reserve(least.size());
    for (std::uint32_t i = 0; i < least.size(); ++i) entries.emplace_back(least[i], i);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue(std::greater<>(),
                                                                         std::move(entries));
    std::uint32_t steps = 0;
    while (!queue.empty()) {
      if (steps++ % 4096 == 0) job.check();
      const auto [height, at] = queue.top();
      queue.pop();
      if (height > least[at]) continue;
      for (std::uint32_t k = first_[at]; k < first_[at + 1]; ++k) {
        const Link& link = links[arms_[k]];
        const std::uint32_t other = link.a == at ? link.b : link.a;
        if (height + link.rise >= least[other]) continue;
        if (!way.empty()) {
          if (way[at] + link.length > reach) continue;
          way[other] = way[at] + link.length;
        }
        least[other] = height + link.rise;
        queue.emplace(least[other], other);
      }
    }
    return least;
  }

  std::vector<std::uint32_t> first_, arms_;
};

/// The points of an edge: its nodes, the ends of the level parts, and samples between.
void add_points(const CityPlan& plan, std::uint32_t edge, std::vector<ProfilePoint>& points) {
  const StreetGraph& graph = plan.graph;
  const CmPoint from = graph.nodes[graph.edges[edge].from], to = graph.nodes[graph.edges[edge].to];
  const double length = distance(from, to) / 100;
  const dvec2 along = (in_cm(to) - in_cm(from)) / (length * 100);
  const double begin = plan.corner_reaches[2 * edge] + past_corners;
  const double end = length - plan.corner_reaches[2 * edge + 1] - past_corners;
  points.push_back({from, 0, 0});
  if (end - begin >= shortest_slope) {
    const int count = std::max(1, math::to_int32(std::ceil((end - begin) / sample_spacing)));
    for (int k = 0; k <= count; ++k) {
      const double station = begin + (end - begin) * k / count;
      const CmPoint at = rounded_cm(in_cm(from) + along * (station * 100));
      points.push_back({at, glm::dot(in_cm(at) - in_cm(from), along) / 100, 0});
    }
  }
  points.push_back({to, length, 0});
}

/// The greatest difference of heights over a length, less what rounding may add.
double rise_over(double limit, double length) { return std::max(0.0, limit * length - 2 * resolution); }

double length_of(const SeparatedStreet& street) {
  double length = 0;
  for (std::size_t k = 1; k < street.line.size(); ++k)
    length += distance(street.line[k - 1], street.line[k]) / 100;
  return length;
}

/// Vertices: the nodes, then the inner samples of each edge except the ends of its level parts, which are as high as its
/// nodes.
GradeGraph grade_graph(const CityPlan& plan, const Landform& landform, double least,
                       const StreetHeights& heights) {
  const StreetGraph& graph = plan.graph;
  GradeGraph grades;
  const auto ground_at = [&](const CmPoint& p) { return std::max(least, landform.at(in_metres(p))); };
  for (const CmPoint& p : graph.nodes) grades.ground.push_back(ground_at(p));
  for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge) {
    if (!graph.is_street(edge)) continue;
    const double limit = plan.class_of(edge).grade_limit;
    const std::uint32_t first = heights.first[edge], last = heights.first[edge + 1] - 1;
    std::uint32_t before = graph.edges[edge].from;
    for (std::uint32_t k = first + 2; k < last; ++k) {
      std::uint32_t here = graph.edges[edge].to;
      if (k + 1 < last) {
        here = static_cast<std::uint32_t>(grades.ground.size());
        grades.ground.push_back(ground_at(heights.points[k].at));
      }
      const double length = distance(heights.points[k - 1].at, heights.points[k].at) / 100;
      grades.links.push_back({before, here, rise_over(limit, length), length});
      before = here;
    }
    if (last - first == 1) grades.links.push_back({before, graph.edges[edge].to, 0, 1});
  }
  for (const SeparatedStreet& each : graph.separated) {
    const double length = length_of(each);
    grades.links.push_back(
        {each.from, each.to, rise_over(plan.classes[each.tag].grade_limit, length), length});
  }
  grades.index();
  return grades;
}

}  // namespace

StreetHeights street_heights(const CityPlan& plan, const Landform& landform, double least, double reach,
                             Job& job) {
  StreetHeights heights;
  if (landform.is_level()) return heights;
  const StreetGraph& graph = plan.graph;
  heights.first.push_back(0);
  for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge) {
    if (graph.is_street(edge)) add_points(plan, edge, heights.points);
    heights.first.push_back(static_cast<std::uint32_t>(heights.points.size()));
  }
  const GradeGraph grades = grade_graph(plan, landform, least, heights);
  std::vector<double> limited = grades.limited(grades.ground, reach, job);
  grades.smooth(limited);
  limited = grades.limited(limited, reach, job);
  for (double& height : limited) height = rounded(height);
  heights.node.assign(limited.begin(), limited.begin() + static_cast<std::ptrdiff_t>(graph.nodes.size()));
  std::size_t at = graph.nodes.size();
  for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge) {
    const std::uint32_t first = heights.first[edge], end = heights.first[edge + 1];
    if (first == end) continue;
    for (std::uint32_t k = first; k < end; ++k) {
      double& height = heights.points[k].height;
      if (k < first + 2 && k + 1 < end) {
        height = heights.node[graph.edges[edge].from];
      } else if (k + 2 >= end) {
        height = heights.node[graph.edges[edge].to];
      } else {
        height = limited[at++];
      }
    }
  }
  return heights;
}

double height_on_street(const StreetHeights& heights, std::uint32_t edge, double station) {
  const auto begin = heights.points.begin() + heights.first[edge],
             end = heights.points.begin() + heights.first[edge + 1];
  const auto after = std::lower_bound(
      begin, end, station, [](const ProfilePoint& point, double at) { return point.station < at; });
  if (after == begin) return begin->height;
  if (after == end) return (end - 1)->height;
  const ProfilePoint &a = *(after - 1), &b = *after;
  if (a.height == b.height) return a.height;
  return a.height + (b.height - a.height) * ((station - a.station) / (b.station - a.station));
}

std::vector<ProfilePoint> shown_profile(const CityPlan& plan, std::uint32_t edge) {
  constexpr double least = 0.5;  // of a level part at a node, m
  const StreetHeights& heights = plan.heights;
  const PlanarEdge& each = plan.graph.edges[edge];
  if (heights.is_level()) return {{plan.graph.nodes[each.from]}, {plan.graph.nodes[each.to]}};
  std::vector<ProfilePoint> points(heights.points.begin() + heights.first[edge],
                                   heights.points.begin() + heights.first[edge + 1]);
  const auto is_short = [&points](std::size_t a, std::size_t b) {
    return points[b].station - points[a].station < least;
  };
  if (points.size() > 2 && is_short(points.size() - 2, points.size() - 1)) points.erase(points.end() - 2);
  if (points.size() > 2 && is_short(0, 1)) points.erase(points.begin() + 1);
  return points;
}

std::vector<ProfilePoint> separated_profile(const CityPlan& plan, const SeparatedStreet& street) {
  std::vector<ProfilePoint> points;
  for (std::size_t k = 0; k + 1 < street.line.size(); ++k) {
    const dvec2 a = in_cm(street.line[k]), b = in_cm(street.line[k + 1]);
    const int count = std::max(1, math::to_int32(glm::length(b - a) / (sample_spacing * 100)));
    for (int n = 0; n < count; ++n)
      points.push_back({rounded_cm(a + (b - a) * (static_cast<double>(n) / count)), 0, 0});
  }
  points.push_back({street.line.back(), 0, 0});
  for (std::size_t k = 1; k < points.size(); ++k)
    points[k].station = points[k - 1].station + distance(points[k - 1].at, points[k].at) / 100;
  const double length = points.back().station;
  const std::vector<double>& node = plan.heights.node;
  const double from = node.empty() ? 0 : node[street.from], to = node.empty() ? 0 : node[street.to];
  const auto is_on_shore = [&](std::uint32_t at) {
    return plan.graph.is_border[at] != 0 && plan.graph.degree(at) == 1;
  };
  const bool is_over_water = is_on_shore(street.from) && is_on_shore(street.to);
  const double limit = plan.classes[street.tag].grade_limit;
  const double ramp =
      is_over_water ? 0 : std::clamp(limit - std::abs(to - from) / length - 2e-6, 0.0, steepest_ramp);
  for (ProfilePoint& point : points) {
    const double rise =
        std::min(clearance * std::abs(street.level), ramp * std::min(point.station, length - point.station));
    point.height =
        rounded(from + (to - from) * (point.station / length) + (street.level > 0 ? rise : 0 - rise));
  }
  points.front().height = from;
  points.back().height = to;
  return points;
}

}  // namespace seedmesh::city
