#include "core/generators/city/missing_streets.h"

#include <cmath>
#include <string>

#include "core/generators/city/route.h"
#include "core/geom/polygon/segment_pairs.h"
#include "core/schema/json.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double tolerance = 5;      // of positions, cm
constexpr double least_rest = 310;   // of a piece beside one that was built, cm
constexpr double least_piece = 100;  // that counts, cm
constexpr std::size_t most_warnings = 20;

/// A piece of a given line between two corners or borders, and the point in its middle.
struct Probe {
  std::uint32_t line = 0;
  dvec2 middle{0};
  double length = 0;      ///< cm
  bool is_built = false;  ///< the plan has a street there
};

void add_probes(const Region& region, const GivenLine& line, std::uint32_t number,
                std::vector<Probe>& probes) {
  if (line.level != 0) {
    if (!is_on_land(region, in_cm(line.points.front())) || !is_on_land(region, in_cm(line.points.back())))
      return;
    const dvec2 a = in_cm(line.points[0]), b = in_cm(line.points[1]);
    probes.push_back({number, (a + b) / 2.0, distance(line.points[0], line.points[1])});
    return;
  }
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const dvec2 a = in_cm(line.points[i - 1]), along = in_cm(line.points[i]) - a;
    const double length = distance(line.points[i - 1], line.points[i]);
    double from = 0;
    const auto add = [&](double to) {
      const dvec2 middle = a + along * ((from + to) / 2);
      if ((to - from) * length >= least_piece && is_on_land(region, middle))
        probes.push_back({number, middle, (to - from) * length});
      from = to;
    };
    for (const OutlineHit& hit : hits_of(region, a, in_cm(line.points[i]))) add(hit.share);
    add(1);
  }
}

/// Marks the probes that lie on an edge, a bridge or a tunnel of the plan.
void mark_built(const StreetGraph& graph, std::vector<Probe>& probes) {
  std::vector<Segment> all;
  all.reserve(probes.size() + graph.edges.size());
  for (const Probe& each : probes) all.push_back({each.middle, each.middle});
  for (const PlanarEdge& edge : graph.edges)
    all.push_back({in_cm(graph.nodes[edge.from]), in_cm(graph.nodes[edge.to])});
  for (const SeparatedStreet& each : graph.separated) {
    for (std::size_t i = 1; i < each.line.size(); ++i)
      all.push_back({in_cm(each.line[i - 1]), in_cm(each.line[i])});
  }
  each_near_pair(all, tolerance, nullptr, [&](std::size_t i, std::size_t k) {
    if (i < probes.size() && k >= probes.size() && !probes[i].is_built)
      probes[i].is_built = distance_to_segment(probes[i].middle, all[k].from, all[k].to) <= tolerance;
    return true;
  });
}

}  // namespace

std::vector<Warning> missing_streets(const std::vector<GivenLine>& lines, const CityPlan& plan) {
  std::vector<Probe> probes;
  for (std::uint32_t n = 0; n < lines.size(); ++n) add_probes(plan.region, lines[n], n, probes);
  mark_built(plan.graph, probes);
  std::vector<Warning> warnings;
  const auto is_built = [&](std::size_t i, std::uint32_t line) {
    return i < probes.size() && probes[i].line == line && probes[i].is_built;
  };
  for (std::size_t i = 0; i < probes.size() && warnings.size() < most_warnings; ++i) {
    const Probe& each = probes[i];
    const bool is_beside_built = is_built(i + 1, each.line) || (i > 0 && is_built(i - 1, each.line));
    if (each.is_built || (each.length < least_rest && is_beside_built)) continue;
    const GivenLine& line = lines[each.line];
    if (!warnings.empty() && warnings.back().pointer == line.pointer) continue;
    const bool is_flat = line.level == 0;
    warnings.push_back({line.pointer, std::string(is_flat ? "a piece" : "the bridge or tunnel") + " at " +
                                          number_text(std::round(each.middle.x) / 100) + ", " +
                                          number_text(std::round(each.middle.y) / 100) +
                                          " is left out; expected " +
                                          (is_flat ? "pieces of more than 3.1 m in the area"
                                                   : "ends or corners of streets of level 0 at both ends")});
  }
  return warnings;
}

}  // namespace seedmesh::city
