/// innerRectangle(scope){ shape: A | remainder: B }: the largest rectangle inside a face, and the rest of it.
#include <algorithm>

#include "core/generators/building/inner_rectangle.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/operators.h"

namespace seedmesh::building::operators {
namespace {

constexpr double same_share = 1e-9;

/// A face in the scope that its rectangle lies along.
struct Candidate {
  ShapeState state;
  InnerRectangle rectangle;
};

InnerRectangle largest_in(Derivation& d, const ShapeState& state) {
  const int w = flat_axis(state.size), u = (w + 1) % 3, v = (w + 2) % 3;
  const Solid solid = solid_of(d, state);
  InnerRectangle largest;
  for (const Face& face : solid.faces) {
    std::vector<std::vector<glm::dvec2>> rings;
    for (const Loop& loop : loops_of(solid, face)) {
      std::vector<glm::dvec2>& ring = rings.emplace_back();
      for (const std::uint32_t point : points_of(solid, loop)) {
        const glm::dvec3 p = solid.points[point] * state.size;
        ring.emplace_back(p[u], p[v]);
      }
    }
    const InnerRectangle own = building::inner_rectangle(rings, d.job);
    if (own.area() > largest.area()) largest = own;
  }
  return largest;
}

/// The largest rectangle along one of the edges that are at least a quarter as long as the longest.
Candidate largest_along_edges(Derivation& d, const ShapeState& state) {
  const int w = flat_axis(state.size);
  const glm::dmat3 axes = d.out.axes[state.axes];
  const Solid solid = solid_of(d, state);
  double longest = 0;
  std::vector<glm::dvec3> edges;
  for (const Loop& loop : solid.loops) {
    const std::span<const std::uint32_t> points = points_of(solid, loop);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 &a = solid.points[points[i]], &b = solid.points[points[(i + 1) % points.size()]];
      edges.push_back((b - a) * state.size);
      longest = std::max(longest, glm::length(edges.back()));
    }
  }
  Candidate best{state, {}};
  for (const glm::dvec3& edge : edges) {
    if (glm::length(edge) < 0.25 * longest) continue;
    ShapeState turned = state;
    glm::dmat3 own(1);
    own[w] = axes[w];
    own[(w + 1) % 3] = axes * (edge / glm::length(edge));
    own[(w + 2) % 3] = glm::cross(own[w], own[(w + 1) % 3]);
    reframe(d, turned, own);
    const InnerRectangle found = largest_in(d, turned);
    if (found.area() > best.rectangle.area() * (1 + same_share)) best = {turned, found};
  }
  return best;
}

ShapeState rectangle_of(const Derivation& d, const Candidate& best) {
  const int w = flat_axis(best.state.size), u = (w + 1) % 3, v = (w + 2) % 3;
  const auto& [low, high] = best.rectangle;
  ShapeState piece = best.state;
  glm::dvec3 at(0);
  at[u] = low.x;
  at[v] = low.y;
  piece.origin += d.out.axes[piece.axes] * at;
  piece.size[u] = high.x - low.x;
  piece.size[v] = high.y - low.y;
  piece.geometry = box_geometry;
  return piece;
}

/// What is left beside the rectangle, below it and above it.
std::vector<ShapeState> remainder_of(Derivation& d, const Candidate& best) {
  const ShapeState& state = best.state;
  const int w = flat_axis(state.size), u = (w + 1) % 3, v = (w + 2) % 3;
  const auto& [low, high] = best.rectangle;
  std::vector<ShapeState> pieces;
  const auto add = [&](Solid rest) {
    if (rest.faces.empty()) return;
    glm::dvec3 from, extent;
    fit(rest, from, extent);
    ShapeState piece = state;
    piece.origin += d.out.axes[state.axes] * (from * state.size);
    piece.size = extent * state.size;
    if (dimension(piece.size) != 2) return;
    piece.geometry = add_solid(d, std::move(rest));
    pieces.push_back(piece);
  };
  const auto cut = [&](const Solid& solid, int axis, double at, double sign) {
    const double share = at / state.size[axis];
    if (sign > 0 ? share <= same_share : share >= 1 - same_share) return Solid{};
    return clipped(solid, axis, share, sign);
  };
  const Solid whole = solid_of(d, state);
  const Solid right = low.x > same_share * state.size[u] ? cut(whole, u, low.x, -1) : whole;
  const Solid middle = high.x < (1 - same_share) * state.size[u] ? cut(right, u, high.x, 1) : right;
  add(cut(whole, u, low.x, 1));
  add(cut(middle, v, low.y, 1));
  add(cut(middle, v, high.y, -1));
  add(cut(whole, u, high.x, -1));
  return pieces;
}

}  // namespace

void inner_rect(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  if (dimension(state.size) != 2 || state.has_asset())
    reject(d, step.offset, "found a solid or an edge, expected a face for innerRect");
  const Candidate best = largest_along_edges(d, state);
  if (best.rectangle.area() > 0) state = rectangle_of(d, best);
}

void inner_rectangle(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  if (dimension(state.size) != 2 || state.has_asset())
    reject(d, step.offset, "found a solid or an edge, expected a face for innerRectangle");
  const std::string word =
      step.argument_count > 0 ? d.grammar.words[d.grammar.arguments[step.first_argument].word] : "scope";
  if (word != "scope" && word != "edge")
    reject(d, step.offset, "found " + lang::in_quotes(word) + ", expected scope or edge");
  const Candidate best =
      word == "scope" ? Candidate{state, largest_in(d, state)} : largest_along_edges(d, state);
  if (!(best.rectangle.area() > 0)) return;
  Frame own = site.frame;
  std::uint64_t number = 0;
  for (std::uint32_t p = 0; p < step.part_count; ++p) {
    const Part& part = d.grammar.parts[step.first_part + p];
    std::vector<ShapeState> pieces =
        part.is_remainder ? remainder_of(d, best) : std::vector{rectangle_of(d, best)};
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      pieces[i].comp_index = i;
      pieces[i].comp_total = static_cast<std::uint32_t>(pieces.size());
      own.key = key_at(site.key, number++);
      run_body(d, part.body, pieces[i], own);
    }
  }
}

}  // namespace seedmesh::building::operators
