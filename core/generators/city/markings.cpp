#include "core/generators/city/markings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

// Metres, from the end of a carriageway at a junction.
constexpr double crossing_begin = 0.6, crossing_end = 3.6, stop_begin = 4.6, stop_end = 5.0;
constexpr double least_between = 3;    // the markings of both ends
constexpr double least_width = 5;      // of a carriageway with crossings
constexpr double perpendicular = 0.3;  // greatest difference of the ends of two kerbs
constexpr double line_width = 0.12, bar_width = 0.6;
constexpr double line_spacing = 6;  // on a terrain
constexpr double least_strip = 0.3;

struct Cut {
  double station = 0;
  StripKind before = StripKind::lanes;  ///< what ends here
};

/// The kerbs of a street along its axis.
struct Kerbs {
  dvec2 from{0}, along{0};
  std::array<dvec2, 2> left{}, right{};  ///< start and end, metres
  double station(const dvec2& p) const { return glm::dot(p - from, along); }
  static dvec2 at(const std::array<dvec2, 2>& kerb, double start, double end, double station) {
    return kerb[0] + (kerb[1] - kerb[0]) * ((station - start) / (end - start));
  }
};

/// Whether traffic on a half-edge stops before its start: at junctions, but not on the through street of one with three
/// arms.
bool has_crossing(const CityPlan& plan, std::uint32_t half) {
  constexpr double straight = -0.9;  // cosine between the arms of a through street
  const StreetGraph& graph = plan.graph;
  const std::uint32_t node = start_of(graph.edges, half);
  if (graph.is_border[node] != 0 || graph.degree(node) < 3 || graph.is_on_ring(node)) return false;
  if (graph.degree(node) > 3) return true;
  const auto direction = [&](std::uint32_t arm) {
    const dvec2 along = in_cm(graph.nodes[end_of(graph.edges, arm)]) - in_cm(graph.nodes[node]);
    return along / glm::length(along);
  };
  const auto arms = graph.arms.of(node);
  return std::none_of(arms.begin(), arms.end(), [&](std::uint32_t arm) {
    return arm != half && graph.is_street(arm / 2) && glm::dot(direction(arm), direction(half)) < straight &&
           graph.edges[arm / 2].tag <= graph.edges[half / 2].tag;
  });
}

}  // namespace

StreetStrips strips_of_street(const CityPlan& plan, std::uint32_t edge) {
  const StreetGraph& graph = plan.graph;
  const std::array<CmPoint, 4>& corners = plan.kerbs[edge];
  if (corners[0] == corners[1] || corners[2] == corners[3]) return {};
  Kerbs kerbs;
  kerbs.from = in_metres(graph.nodes[graph.edges[edge].from]);
  const dvec2 axis = in_metres(graph.nodes[graph.edges[edge].to]) - kerbs.from;
  kerbs.along = axis / glm::length(axis);
  kerbs.left = {in_metres(corners[0]), in_metres(corners[1])};
  kerbs.right = {in_metres(corners[2]), in_metres(corners[3])};
  const std::array<double, 2> left = {kerbs.station(kerbs.left[0]), kerbs.station(kerbs.left[1])},
                              right = {kerbs.station(kerbs.right[0]), kerbs.station(kerbs.right[1])};
  const double begin = std::max(left[0], right[0]), end = std::min(left[1], right[1]);
  if (end - begin < 3 * least_strip) return {};
  const CrossSection& section = plan.class_of(edge);
  const auto is_marked = [&](std::uint32_t half, std::size_t side) {
    return section.width >= least_width && has_crossing(plan, half) &&
           std::abs(left[side] - right[side]) < perpendicular;
  };
  bool at_start = is_marked(2 * edge, 0), at_end = is_marked(2 * edge + 1, 1);
  if (end - begin < stop_end * ((at_start ? 1 : 0) + (at_end ? 1 : 0)) + least_between)
    at_start = at_end = false;
  std::vector<Cut> cuts;
  if (at_start) {
    cuts = {{begin + crossing_begin, StripKind::plain},
            {begin + crossing_end, StripKind::zebra},
            {begin + stop_begin, StripKind::plain},
            {begin + stop_end, StripKind::stop_at_start}};
  }
  // Ends without a crossing are plain, so that the line there has no further vertices.
  if (!at_start) cuts.push_back({begin + least_strip, StripKind::plain});
  const double first = begin + (at_start ? stop_end : least_strip);
  const double last = end - (at_end ? stop_end : least_strip);
  if (!plan.heights.is_level()) {
    const int count = std::max(1, math::to_int32(std::ceil((last - first) / line_spacing)));
    for (int k = 1; k < count; ++k) cuts.push_back({first + (last - first) * k / count, StripKind::lanes});
  }
  if (at_end) {
    cuts.push_back({end - stop_end, StripKind::lanes});
    cuts.push_back({end - stop_begin, StripKind::stop_at_end});
    cuts.push_back({end - crossing_end, StripKind::plain});
    cuts.push_back({end - crossing_begin, StripKind::zebra});
  }
  if (!at_end) cuts.push_back({end - least_strip, StripKind::lanes});
  StreetStrips strips;
  strips.lines.push_back({kerbs.left[0], kerbs.right[0]});
  for (const Cut& cut : cuts) {
    strips.lines.push_back({Kerbs::at(kerbs.left, left[0], left[1], cut.station),
                            Kerbs::at(kerbs.right, right[0], right[1], cut.station)});
    strips.kinds.push_back(cut.before);
  }
  strips.lines.push_back({kerbs.left[1], kerbs.right[1]});
  strips.kinds.push_back(StripKind::plain);
  return strips;
}

int bars_of(const CrossSection& section) {
  return std::max(1, math::to_int32(section.width / bar_width / 2));
}

void set_pieces(StripKind kind, const CrossSection& section, bool has_textures,
                std::vector<StripPiece>& pieces) {
  pieces.clear();
  if (kind == StripKind::plain) {
    pieces.push_back({0, 1, false});
  } else if (kind == StripKind::stop_at_start || kind == StripKind::stop_at_end) {
    const bool is_left = kind == StripKind::stop_at_start;
    pieces.push_back({0, 0.5, is_left});
    pieces.push_back({0.5, 1, !is_left});
  } else if (kind == StripKind::zebra) {
    const int count = has_textures ? 1 : 2 * bars_of(section) + 1;
    for (int k = 0; k < count; ++k) {
      pieces.push_back(
          {static_cast<double>(k) / count, static_cast<double>(k + 1) / count, has_textures || k % 2 == 1});
    }
  } else {
    double before = 0;
    for (int lane = 1; lane < section.lanes; ++lane) {
      const double middle = static_cast<double>(lane) / section.lanes, half = line_width / 2 / section.width;
      pieces.push_back({before, middle - half, false});
      pieces.push_back({middle - half, middle + half, true});
      before = middle + half;
    }
    pieces.push_back({before, 1, false});
  }
}

}  // namespace seedmesh::city
