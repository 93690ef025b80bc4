#include "core/generators/city/near_streets.h"

#include <algorithm>
#include <limits>
#include <map>

#include "core/geom/polygon/segment_pairs.h"

namespace seedmesh::city {
namespace {

/// The distance of two segments that do not cross.
double distance_of(const Segment& a, const Segment& b) {
  return std::min(
      std::min(distance_to_segment(a.from, b.from, b.to), distance_to_segment(a.to, b.from, b.to)),
      std::min(distance_to_segment(b.from, a.from, a.to), distance_to_segment(b.to, a.from, a.to)));
}

/// The corners of pieces of streets, and the pieces that meet there.
struct Corners {
  std::vector<CmPoint> points;                        ///< in the order of the pieces
  std::vector<std::vector<std::size_t>> pieces;       ///< by corner
  std::vector<std::array<std::uint32_t, 2>> corners;  ///< by piece

  explicit Corners(const std::vector<StreetPiece>& all) {
    std::map<CmPoint, std::uint32_t> known;
    for (std::size_t i = 0; i < all.size(); ++i) {
      corners.emplace_back();
      for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
        const CmPoint& p = end == 0 ? all[i].a : all[i].b;
        const auto [at, is_new] = known.emplace(p, static_cast<std::uint32_t>(points.size()));
        if (is_new) {
          points.push_back(p);
          pieces.emplace_back();
        }
        corners.back()[end] = at->second;
        pieces[at->second].push_back(i);
      }
    }
  }
};

}  // namespace

std::vector<double> widths_of(const std::vector<CrossSection>& sections) {
  std::vector<double> widths;
  widths.reserve(sections.size());
  for (const CrossSection& each : sections) widths.push_back(each.width * 100);
  return widths;
}

std::vector<NearPair> near_pairs(const std::vector<CmPoint>& nodes, const std::vector<PlanarEdge>& edges,
                                 const std::vector<double>& widths, const Job& job) {
  std::vector<Segment> segments;
  std::vector<std::uint32_t> source;
  double widest = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (edges[e].is_removed() || !is_street_tag(edges[e].tag)) continue;
    segments.push_back({in_cm(nodes[edges[e].from]), in_cm(nodes[edges[e].to])});
    source.push_back(e);
    widest = std::max(widest, widths[edges[e].tag]);
  }
  std::vector<NearPair> pairs;
  each_near_pair(segments, widest, &job, [&](std::size_t i, std::size_t k) {
    const PlanarEdge &a = edges[source[i]], &b = edges[source[k]];
    if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) return true;
    const double apart = distance_of(segments[i], segments[k]);
    if (apart < (widths[a.tag] + widths[b.tag]) / 2) pairs.push_back({source[i], source[k], apart});
    return true;
  });
  return pairs;
}

bool are_linked(const StreetNet& net, const NearPair& pair) {
  constexpr double way_between_arms = 5.13;  // over their distance, of arms at 22.5 degrees
  const double most = way_between_arms * pair.distance;
  const PlanarEdge &from = net.edges[pair.first], &to = net.edges[pair.second];
  struct Visit {
    std::uint32_t node;
    double way;
  };
  std::vector<Visit> visits = {{from.from, 0}, {from.to, 0}};
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const Visit at = visits[i];
    if (at.node == to.from || at.node == to.to) return true;
    for (const std::uint32_t half : net.arms.of(at.node)) {
      const PlanarEdge& edge = net.edges[half / 2];
      if (edge.is_removed() || !is_street_tag(edge.tag)) continue;
      const std::uint32_t next = edge.from == at.node ? edge.to : edge.from;
      const double way = at.way + distance(net.nodes[at.node], net.nodes[next]);
      const auto is_known = [&](const Visit& visit) { return visit.node == next && visit.way <= way; };
      if (way <= most && std::none_of(visits.begin(), visits.end(), is_known)) visits.push_back({next, way});
    }
  }
  return false;
}

void join_near_bends(const GrowthInput& input, std::vector<StreetPiece>& pieces, const Job& job) {
  const std::vector<double> widths = widths_of(input.sections);
  Corners all(pieces);
  std::vector<Segment> points;
  points.reserve(all.points.size());
  for (const CmPoint& p : all.points) points.push_back({in_cm(p), in_cm(p)});
  double widest = 0;
  for (const StreetPiece& piece : pieces) widest = std::max(widest, widths[piece.kind]);
  std::vector<std::uint8_t> is_joined(points.size(), 0);
  const auto width_at = [&](std::size_t corner) {
    double width = 0;
    for (const std::size_t i : all.pieces[corner]) width = std::max(width, widths[pieces[i].kind]);
    return width;
  };
  const auto other_end = [&](std::size_t piece, std::size_t corner) {
    return all.corners[piece][all.corners[piece][0] == corner ? 1 : 0];
  };
  const auto try_move = [&](std::size_t corner, std::size_t target) {
    if (all.pieces[corner].size() != 2 || all.pieces[target].size() < 2) return false;
    std::vector<StreetPiece> moved;
    for (const std::size_t i : all.pieces[corner]) {
      const std::uint32_t end = other_end(i, corner);
      const StreetPiece piece = {all.points[end], all.points[target], pieces[i].kind};
      const auto is_there = [&](std::size_t k) { return other_end(k, target) == end; };
      if (end == target || pieces[i].kind >= first_given ||
          std::any_of(all.pieces[target].begin(), all.pieces[target].end(), is_there) ||
          !input.is_free({{piece}, {}, true}))
        return false;
      moved.push_back(piece);
    }
    for (std::size_t n = 0; n < 2; ++n) pieces[all.pieces[corner][n]] = moved[n];
    return true;
  };
  each_near_pair(points, widest / 2, &job, [&](std::size_t i, std::size_t k) {
    if (is_joined[i] != 0 || is_joined[k] != 0) return true;
    if (distance(all.points[i], all.points[k]) >= (width_at(i) + width_at(k)) / 4) return true;
    if (try_move(k, i) || try_move(i, k)) is_joined[i] = is_joined[k] = 1;
    return true;
  });
}

}  // namespace seedmesh::city
