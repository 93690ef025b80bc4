#include "core/generators/city/kerb_sides.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seedmesh::city {

using glm::dvec2;

namespace {

constexpr double least_straight = 300;  // of a carriageway between perpendicular ends, cm

bool is_cut(const StreetGraph& graph, std::uint32_t node) {
  return graph.is_border[node] == 0 && graph.degree(node) >= 3;
}

bool is_sound_or_empty(const CmRing& ring) {
  return ring.size() < 3 || doubled_area(ring) == 0 || (is_simple(ring) && doubled_area(ring) > 0);
}

}  // namespace

dvec2 unit_of(const StreetGraph& graph, std::uint32_t half) {
  const dvec2 along =
      in_cm(graph.nodes[end_of(graph.edges, half)]) - in_cm(graph.nodes[start_of(graph.edges, half)]);
  return along / std::sqrt(along.x * along.x + along.y * along.y);
}

std::vector<double> corner_reaches(const StreetGraph& graph, const std::vector<KerbSide>& sides) {
  std::vector<double> reaches(sides.size(), 0);
  for (std::uint32_t half = 0; half < sides.size(); ++half) {
    if (!graph.is_street(half / 2)) continue;
    const dvec2 start = in_cm(graph.nodes[start_of(graph.edges, half)]), d = unit_of(graph, half);
    const KerbSide &left = sides[half], &right = sides[half ^ 1U];
    double reach = 0;
    const auto add = [&](const KerbSide& side) {
      for (const auto* corner : {&side.corner, &side.outer_corner}) {
        for (const CmPoint& p : *corner) reach = std::max(reach, glm::dot(in_cm(p) - start, d));
      }
    };
    if (left.is_laid_out) add(left);
    if (right.is_laid_out) add(sides[right.after]);
    reaches[half] = reach / 100;
  }
  return reaches;
}

CmRing junction_ring(const StreetGraph& graph, const std::vector<KerbSide>& sides, std::uint32_t node) {
  const auto around = graph.arms.of(node);
  CmRing ring;
  std::size_t first = 0;  // behind the outside
  while (first < around.size() && sides[around[first] ^ 1U].is_laid_out) ++first;
  const bool is_open = graph.is_border[node] != 0 || first < around.size();
  for (std::size_t n = 0; n < around.size(); ++n) {
    const std::uint32_t arm = around[(first + n) % around.size()];
    const KerbSide &left = sides[arm], &right = sides[arm ^ 1U];
    if (right.is_laid_out) {
      append_new(ring, right.to);
      append_new(ring, right.cut_to);
    }
    if (!left.is_laid_out) continue;
    append_new(ring, left.cut_from);
    for (std::size_t i = left.corner.size(); i-- > 0;) append_new(ring, left.corner[i]);
  }
  if (is_open) append_new(ring, graph.nodes[node]);
  close(ring);
  return ring;
}

CmRing carriageway_ring(const StreetGraph& graph, const std::vector<KerbSide>& sides, std::uint32_t edge) {
  const KerbSide &left = sides[2 * edge], &right = sides[2 * edge + 1];
  const std::uint32_t from = graph.edges[edge].from, to = graph.edges[edge].to;
  const auto ends_at_border = [&](std::uint32_t node) {
    return graph.is_border[node] != 0 && graph.degree(node) == 1;
  };
  CmRing ring;
  // Of a street along the border, the half inside is part of the area.
  const auto add_side = [&](const KerbSide& side, std::uint32_t begin, std::uint32_t end) {
    append_new(ring, side.is_laid_out ? side.cut_to : graph.nodes[begin]);
    append_new(ring, side.is_laid_out ? side.cut_from : graph.nodes[end]);
  };
  add_side(right, from, to);
  if (ends_at_border(to)) append_new(ring, graph.nodes[to]);
  add_side(left, to, from);
  if (ends_at_border(from)) append_new(ring, graph.nodes[from]);
  close(ring);
  return ring;
}

CmRing sidewalk_ring(const std::vector<KerbSide>& sides, std::uint32_t half) {
  const KerbSide& side = sides[half];
  const KerbSide& next = sides[side.after];
  const auto middle = [](const std::vector<CmPoint>& corner) { return (corner.size() - 1) / 2; };
  CmRing ring;
  ring.reserve(side.corner.size() + side.outer_corner.size() + next.corner.size() + next.outer_corner.size() +
               2);
  for (std::size_t i = middle(side.corner); i < side.corner.size(); ++i) append_new(ring, side.corner[i]);
  append_new(ring, side.cut_from);
  append_new(ring, side.cut_to);
  for (std::size_t i = 0; i <= middle(next.corner); ++i) append_new(ring, next.corner[i]);
  for (std::size_t i = middle(next.outer_corner) + 1; i-- > 0;) append_new(ring, next.outer_corner[i]);
  for (std::size_t i = side.outer_corner.size(); i-- > middle(side.outer_corner);)
    append_new(ring, side.outer_corner[i]);
  close(ring);
  return ring;
}

void cut_carriageways(const StreetGraph& graph, std::vector<KerbSide>& sides) {
  for (KerbSide& side : sides) {
    if (!side.is_laid_out) continue;
    side.cut_from = side.from();
    side.cut_to = side.to;
  }
  for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge) {
    if (!graph.is_street(edge)) continue;
    KerbSide &left = sides[2 * edge], &right = sides[2 * edge + 1];
    if (!left.is_laid_out || !right.is_laid_out) continue;
    const dvec2 start = in_cm(graph.nodes[graph.edges[edge].from]), d = unit_of(graph, 2 * edge);
    const auto along = [&](const CmPoint& p) { return glm::dot(in_cm(p) - start, d); };
    const bool cuts_start = is_cut(graph, graph.edges[edge].from),
               cuts_end = is_cut(graph, graph.edges[edge].to);
    const double left_start = along(left.from()), right_start = along(right.to);
    const double left_end = along(left.to), right_end = along(right.from());
    const double begin = std::max(left_start, right_start), end = std::min(left_end, right_end);
    if (end - begin < least_straight) continue;
    const auto on_kerb = [&](const CmPoint& a, const CmPoint& b, double at) {
      const double share = (at - along(a)) / (along(b) - along(a));
      return rounded_cm(in_cm(a) + (in_cm(b) - in_cm(a)) * share);
    };
    constexpr double same = 20;  // cm
    if (cuts_start && begin - left_start > same) left.cut_from = on_kerb(left.from(), left.to, begin);
    if (cuts_start && begin - right_start > same) right.cut_to = on_kerb(right.from(), right.to, begin);
    if (cuts_end && left_end - end > same) left.cut_to = on_kerb(left.from(), left.to, end);
    if (cuts_end && right_end - end > same) right.cut_from = on_kerb(right.from(), right.to, end);
  }
}

std::vector<std::uint32_t> undo_unsound_cuts(const StreetGraph& graph, std::vector<KerbSide>& sides) {
  std::vector<std::uint32_t> unsound;
  for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
    if (is_sound_or_empty(junction_ring(graph, sides, node))) continue;
    for (const std::uint32_t arm : graph.arms.of(node)) {
      if (!graph.is_street(arm / 2)) continue;
      if (sides[arm].is_laid_out) sides[arm].cut_from = sides[arm].from();
      sides[arm ^ 1U].cut_to = sides[arm ^ 1U].to;
    }
    if (!is_sound_or_empty(junction_ring(graph, sides, node))) unsound.push_back(node);
  }
  return unsound;
}

}  // namespace seedmesh::city
