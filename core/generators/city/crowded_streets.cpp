#include "core/generators/city/crowded_streets.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/generators/city/near_streets.h"
#include "core/schema/json.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr std::size_t most_warnings = 20;

/// The given line of level 0 on which the middle of an edge lies; no_index if there is none.
std::uint32_t line_of(const std::vector<GivenLine>& lines, const StreetGraph& graph, const PlanarEdge& edge) {
  constexpr double tolerance = 5;  // cm
  const dvec2 middle = (in_cm(graph.nodes[edge.from]) + in_cm(graph.nodes[edge.to])) / 2.0;
  for (std::uint32_t n = 0; n < lines.size(); ++n) {
    const CmRing& points = lines[n].points;
    if (lines[n].level != 0) continue;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (distance_to_segment(middle, in_cm(points[i - 1]), in_cm(points[i])) <= tolerance) return n;
    }
  }
  return no_index;
}

/// The end of one of two edges that is nearest to the other edge.
CmPoint nearest_end(const StreetGraph& graph, const PlanarEdge& first, const PlanarEdge& second) {
  CmPoint best{};
  double least = 1e300;
  const auto try_ends = [&](const PlanarEdge& edge, const PlanarEdge& other) {
    for (const std::uint32_t end : {edge.from, edge.to}) {
      const double apart = distance_to_segment(in_cm(graph.nodes[end]), in_cm(graph.nodes[other.from]),
                                               in_cm(graph.nodes[other.to]));
      if (apart >= least) continue;
      least = apart;
      best = graph.nodes[end];
    }
  };
  try_ends(first, second);
  try_ends(second, first);
  return best;
}

/// A distance in metres, rounded to centimetres.
std::string metres_text(double cm) { return number_text(std::round(cm) / 100); }

}  // namespace

std::vector<Warning> crowded_streets(const std::vector<GivenLine>& lines, const CityPlan& plan,
                                     const Job& job) {
  const StreetGraph& graph = plan.graph;
  std::vector<double> widths = widths_of(plan.classes);
  // Streets that grow keep off all others already.
  for (std::size_t tag = 0; tag < std::min<std::size_t>(first_given, widths.size()); ++tag) widths[tag] = 0;
  std::vector<Warning> warnings;
  for (const NearPair& pair : near_pairs(graph.nodes, graph.edges, widths, job)) {
    const PlanarEdge &first = graph.edges[pair.first], &second = graph.edges[pair.second];
    if (first.tag < first_given || second.tag < first_given) continue;
    if (are_linked({graph.nodes, graph.edges, graph.arms}, pair)) continue;
    const std::uint32_t a = line_of(lines, graph, first), b = line_of(lines, graph, second);
    if (a == no_index || b == no_index) continue;
    const GivenLine &earlier = lines[std::min(a, b)], &later = lines[std::max(a, b)];
    const auto is_known = [&](const Warning& each) { return each.pointer == later.pointer; };
    if (std::any_of(warnings.begin(), warnings.end(), is_known)) continue;
    const CmPoint at = nearest_end(graph, first, second);
    warnings.push_back({later.pointer, "runs " + metres_text(pair.distance) + " m beside the street `" +
                                           earlier.pointer.substr(1) + "` at " + metres_text(at.x) + ", " +
                                           metres_text(at.y) +
                                           ", so that their carriageways overlap; expected at least " +
                                           metres_text((widths[first.tag] + widths[second.tag]) / 2) +
                                           " m, or a common corner"});
    if (warnings.size() == most_warnings) break;
  }
  return warnings;
}

}  // namespace seedmesh::city
