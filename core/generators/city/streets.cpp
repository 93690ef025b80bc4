// The street graph from pieces: planar by construction, then cut to the area and to one component.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/city/grades.h"
#include "core/generators/city/growth.h"
#include "core/generators/city/landform.h"
#include "core/generators/city/pruned_graph.h"
#include "core/generators/city/roundabouts.h"
#include "core/generators/city/tensor.h"
#include "core/generators/city/wards.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

constexpr auto border_tag = static_cast<std::uint32_t>(EdgeClass::border);
constexpr auto shore_tag = static_cast<std::uint32_t>(EdgeClass::shore);
constexpr double least_street = 320;  // cm
// Separate networks of at least this share of the longest one stay until links between them have been tried.
constexpr double share_of_a_network = 0.05;
constexpr double largest_alone = 2;

/// The graph of the outlines of land and water and of streets. Given streets come first, so that others bend to them.
PlanarGraph graph_of(const Region& region, const Route& route, Job& job) {
  PlanarGraph graph;
  for (const OutlineEdge& edge : region.outline)
    graph.add(edge.a, edge.b, edge.is_shore ? shore_tag : border_tag);
  Meter meter(job, Resource::shapes);
  for (const bool is_given : {true, false}) {
    for (const StreetPiece& piece : route.pieces) {
      if ((piece.kind >= first_given) != is_given) continue;
      meter.spend();
      graph.add(piece.a, piece.b, piece.kind);
    }
  }
  return graph;
}

/// A graph, and the bridges and tunnels whose ends are its nodes.
struct Majors {
  StreetGraph graph;
  std::vector<SeparatedLine> separated;
};

Majors majors_of(const GrowthInput& input, const Route& route, Job& job) {
  PrunedGraph pruned(graph_of(input.region, route, job), route.separated);
  pruned.drop_outside(input.region);
  pruned.drop_short(least_street);
  pruned.drop_sharp(math::cos(math::radians(input.streets.minimal_angle)));
  pruned.drop_near(widths_of(input.sections), job);
  pruned.drop_loose_majors();
  pruned.keep_large(share_of_a_network);
  pruned.drop_loose_majors();
  return {pruned.finished(), pruned.separated()};
}

std::vector<StreetPiece> pieces_of(const StreetGraph& graph) {
  std::vector<StreetPiece> pieces;
  for (const PlanarEdge& edge : graph.edges) {
    if (is_street(edge)) pieces.push_back({graph.nodes[edge.from], graph.nodes[edge.to], edge.tag});
  }
  return pieces;
}

std::vector<SeparatedLine> separated_lines(const StreetGraph& graph) {
  std::vector<SeparatedLine> lines;
  for (const SeparatedStreet& each : graph.separated) lines.push_back({each.line, each.tag, each.level});
  return lines;
}

/// The minor streets of all cells, in the order of the cells.
CellStreets grow_cells(const GrowthInput& input, const StreetGraph& majors, Job& job) {
  const PlanarFaces faces = faces_of(majors.nodes, majors.edges, job);
  std::vector<CellStreets> grown(faces.faces.size());
  parallel_for(job, faces.faces.size(), 1, [&](std::size_t begin, std::size_t, std::size_t) {
    const PlanarFaces::Face& face = faces.faces[begin];
    std::vector<std::vector<std::uint32_t>> loops;
    const auto add = [&](std::uint32_t loop) {
      const auto span = faces.of(faces.loops[loop]);
      loops.emplace_back(span.begin(), span.end());
    };
    add(face.outer);
    for (const std::uint32_t hole : face.holes) add(hole);
    // A hole of the area is a face, too, and so is water.
    const glm::dvec2 inside = position_in(majors.nodes, majors.edges, loops[0]);
    if (!is_on_land(input.region, inside)) return;
    if (input.wards) {
      const Ward* ward = ward_at(input.wards->wards, inside);
      if (!ward || ward->zone == zone_square || ward->zone == zone_citadel) return;
    }
    grown[begin] = grow_cell(input, majors, loops, job);
  });
  CellStreets all;
  for (const CellStreets& each : grown) {
    all.pieces.insert(all.pieces.end(), each.pieces.begin(), each.pieces.end());
    all.has_branches |= each.has_branches;
  }
  // Joining another street can move an end towards a given building.
  if (input.footprints)
    std::erase_if(all.pieces, [&](const StreetPiece& piece) { return input.is_on_footprint(piece); });
  return all;
}

/// Given streets in pieces of at most 30 m, so that others can join them.
Route given_pieces(const GrowthInput& input) {
  constexpr double longest = 3000;
  Route route;
  if (!input.given) return route;
  route.separated = input.given->separated;
  for (const StreetPiece& piece : input.given->pieces) {
    const glm::dvec2 from = in_cm(piece.a), along = in_cm(piece.b) - from;
    const int count = std::max(1, math::to_int32(std::ceil(distance(piece.a, piece.b) / longest)));
    CmPoint last = piece.a;
    for (int n = 1; n <= count; ++n) {
      const CmPoint next = n == count ? piece.b : rounded_cm(from + along * (static_cast<double>(n) / count));
      route.pieces.push_back({last, next, piece.kind});
      last = next;
    }
  }
  return route;
}

void append(Route& route, const Route& more) {
  route.pieces.insert(route.pieces.end(), more.pieces.begin(), more.pieces.end());
  route.separated.insert(route.separated.end(), more.separated.begin(), more.separated.end());
}

/// `least_share`: of the longest network, for others to stay.
StreetGraph finished_graph(const GrowthInput& input, const Route& route, double least_share, Job& job) {
  PrunedGraph pruned(graph_of(input.region, route, job), route.separated);
  pruned.drop_short(least_street);
  pruned.drop_sharp(math::cos(math::radians(22.6)));
  pruned.drop_near(widths_of(input.sections), job);
  pruned.join_short_given(least_street);
  pruned.keep_large(least_share);
  return pruned.finished();
}

/// Links separate networks by minor streets, and removes those that stay apart without a given street.
StreetGraph connected(const GrowthInput& input, StreetGraph graph, std::vector<SeparatedLine> separated,
                      Job& job) {
  if (is_one_network(graph)) return graph;
  Route whole = {pieces_of(graph), std::move(separated), true};
  const std::vector<StreetPiece> links = links_between_networks(input, graph, job);
  whole.pieces.insert(whole.pieces.end(), links.begin(), links.end());
  std::vector<CmPoint> ring_nodes = std::move(graph.ring_nodes);
  graph = finished_graph(input, whole, largest_alone, job);
  graph.ring_nodes = std::move(ring_nodes);
  return graph;
}

StreetGraph grow_all(const GrowthInput& input, std::vector<CmPoint>& ring_nodes, bool& has_branches,
                     Job& job) {
  const CityStreets& streets = input.streets;
  Route route = given_pieces(input);
  if (streets.method == CityMethod::given) {
    PrunedGraph pruned(graph_of(input.region, route, job), route.separated);
    pruned.drop_outside(input.region);
    pruned.drop_short(least_street);
    pruned.keep_largest();
    return pruned.finished();
  }
  Route majors_route = input.wards    ? input.wards->route
                       : input.tensor ? trace_majors(input, *input.tensor, job)
                                      : grow_majors(input, job);
  if (!input.wards) join_near_bends(input, majors_route.pieces, job);
  append(route, majors_route);
  Majors majors = majors_of(input, route, job);
  const bool has_streets = std::any_of(majors.graph.edges.begin(), majors.graph.edges.end(), is_street);
  if (!has_streets) {
    PrunedGraph pruned(graph_of(input.region, {through_street(input, job), {}, true}, job), {});
    pruned.drop_outside(input.region);
    pruned.drop_sharp(math::cos(math::radians(22.6)));
    majors = {pruned.finished(), {}};
  }
  if (streets.roundabouts > 0 && !input.wards) {
    const std::vector<StreetPiece> pieces =
        with_roundabouts(majors.graph, streets, job.rng().at("roundabouts"), ring_nodes, job);
    PrunedGraph pruned(graph_of(input.region, {pieces, {}, true}, job), majors.separated);
    pruned.drop_short(least_street);
    majors.graph = pruned.finished();
  }
  if (streets.pattern == CityPattern::raster && !input.given && !input.wards && !input.tensor &&
      (!streets.minor_pattern || *streets.minor_pattern == CityMinorPattern::raster))
    return connected(input, std::move(majors.graph), std::move(majors.separated), job);
  Route whole = {pieces_of(majors.graph), std::move(majors.separated), true};
  const CellStreets minors = grow_cells(input, majors.graph, job);
  has_branches = minors.has_branches;
  whole.pieces.insert(whole.pieces.end(), minors.pieces.begin(), minors.pieces.end());
  StreetGraph graph = finished_graph(input, whole, share_of_a_network, job);
  return connected(input, std::move(graph), std::move(whole.separated), job);
}

}  // namespace

StreetGraph grow_streets(const GrowthInput& input, Job& job) {
  std::vector<CmPoint> ring_nodes;
  bool has_branches = false;
  StreetGraph graph = grow_all(input, ring_nodes, has_branches, job);
  graph.has_branches = has_branches;
  choose_lanes(graph, input.streets.lane_share, job.rng().at("lanes"));
  graph.ring_nodes = std::move(ring_nodes);
  return graph;
}

bool drop_deep_streets(const GrowthInput& input, const StreetHeights& heights, Separate separate,
                       StreetGraph& graph, Job& job) {
  constexpr double deepest = 8;  // metres
  Route kept;
  bool is_any_deep = false;
  for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge) {
    if (!graph.is_street(edge)) continue;
    const PlanarEdge& each = graph.edges[edge];
    bool is_deep = false;
    for (std::uint32_t k = heights.first[edge]; k < heights.first[edge + 1] && !is_given(each); ++k) {
      const ProfilePoint& point = heights.points[k];
      const double ground = std::max(input.least_height, input.landform->at(in_metres(point.at)));
      is_deep |= std::abs(point.height - ground) > deepest;
    }
    is_any_deep |= is_deep;
    if (!is_deep) kept.pieces.push_back({graph.nodes[each.from], graph.nodes[each.to], each.tag});
  }
  if (!is_any_deep) return false;
  kept.separated = separated_lines(graph);
  std::vector<CmPoint> ring_nodes = std::move(graph.ring_nodes);
  const bool has_branches = graph.has_branches;
  const double least_share = separate == Separate::kept ? share_of_a_network : largest_alone;
  graph = finished_graph(input, kept, least_share, job);
  graph.ring_nodes = std::move(ring_nodes);
  graph.has_branches = has_branches;
  return true;
}

void link_networks(const GrowthInput& input, StreetGraph& graph, Job& job) {
  const bool has_branches = graph.has_branches;
  std::vector<SeparatedLine> separated = separated_lines(graph);
  graph = connected(input, std::move(graph), std::move(separated), job);
  graph.has_branches = has_branches;
}

}  // namespace seedmesh::city
