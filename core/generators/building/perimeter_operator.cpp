/// splitAndSetbackPerimeter(offset, first edge, edges){ length : depth : A | ... }* { remainder : B }
#include <algorithm>
#include <cmath>

#include "core/generators/building/cuts.h"
#include "core/generators/building/face_plans.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/value_functions.h"

namespace seedmesh::building::operators {
namespace {

constexpr double same_place = 1e-7;  ///< metres along the border
constexpr double most_sections = 10'000;

/// An edge of the outline, where it begins along the chosen edges, and whether it is one of them.
struct BorderEdge {
  glm::dvec2 from, to;
  double start = 0, length = 0;
  bool is_chosen = true;
};

std::vector<BorderEdge> border_of(Derivation& d, const Step& step, const PlanRing& ring) {
  const double wanted = number_or(d, step, 1, 0), count = static_cast<double>(ring.size());
  const auto first = static_cast<std::size_t>(wanted - count * std::floor(wanted / count)) % ring.size();
  std::vector<std::uint8_t> mask(ring.size(), 1);
  if (step.argument_count > 2) {
    const Evaluation at{d, step.offset};
    const ValueArray array = array_in(at, evaluate(d, argument_at(d, step, 2).value));
    for (std::size_t i = 0; i < ring.size(); ++i)
      mask[i] = i < array.values.size() && number_in(at, array.values[i]) != 0;
  }
  std::vector<BorderEdge> edges;
  double start = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t e = (first + i) % ring.size();
    BorderEdge edge{ring[e], ring[(e + 1) % ring.size()], start, 0, mask[e] != 0};
    edge.length = glm::length(edge.to - edge.from);
    if (edge.is_chosen) start += edge.length;
    edges.push_back(edge);
  }
  return edges;
}

/// The sections along a length, by the rules of a split.
std::vector<Cut> sections_of(Derivation& d, const Step& step, double length) {
  std::vector<Cell> cells;
  if (step.is_repeated) cells.emplace_back();
  const std::uint32_t first = step.is_repeated ? 1 : 0;
  std::uint32_t count = 0;
  for (std::uint32_t p = 0; p < step.part_count; ++p) {
    const Part& part = d.grammar.parts[step.first_part + p];
    if (part.is_remainder) continue;
    Cell cell;
    cell.size = number_of(d, part.size.value);
    cell.measure = part.size.measure;
    cell.part = step.first_part + p;
    cells.push_back(cell);
    ++count;
  }
  if (step.is_repeated) {
    cells[0].is_group = true;
    cells[0].first = first;
    cells[0].count = count;
    count = 1;
  }
  std::vector<Cut> cuts;
  double wanted = 0;
  if (!cut(cells, count, length, {Rounding::nearest, most_sections}, cuts, wanted))
    reject(d, step.offset, "the border would have more than 10,000 sections");
  return cuts;
}

}  // namespace

void split_perimeter(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  if (dimension(state.size) != 2 || state.has_asset())
    reject(d, step.offset, "found a solid or an edge, expected a face for splitAndSetbackPerimeter");
  const FacePlane plane(state.size);
  Frame own = site.frame;
  std::uint32_t place = 0;
  const auto run = [&](std::uint32_t body, const std::vector<Plan>& plans, const ShapeState& like) {
    Solid solid;
    for (const Plan& plan : plans) add_plan(solid, plan, plane, 0);
    if (solid.faces.empty()) return;
    ShapeState piece = like;
    take_solid(d, piece, std::move(solid));
    if (dimension(piece.size) != 2) return;
    own.key = key_at(site.key, place++);
    run_body(d, body, piece, own);
  };
  for (const Plan& plan : plans_of(flat_solid(d, state), state.size, plane)) {
    const std::vector<BorderEdge> edges = border_of(d, step, plan.rings[0]);
    double length = 0;
    for (const BorderEdge& edge : edges) length += edge.is_chosen ? edge.length : 0;
    if (!(length > 0)) continue;
    double offset = length_of(d, argument_at(d, step, 0), length);
    offset -= length * std::floor(offset / length);
    const std::vector<Cut> cuts = sections_of(d, step, length);
    // The outline with the ends of all sections as corners, and the section of each edge.
    Plan cut_plan;
    PlanRing& ring = cut_plan.rings.emplace_back();
    std::vector<double> distances;
    std::vector<std::uint32_t> section;
    for (const BorderEdge& edge : edges) {
      std::vector<double> ends{0};
      for (const Cut& each : cuts) {
        for (const double end : {each.start, each.start + each.size}) {
          double at = end + offset;
          at -= length * std::floor(at / length);
          at -= edge.start;
          if (edge.is_chosen && at > same_place && at < edge.length - same_place) ends.push_back(at);
        }
      }
      std::ranges::sort(ends);
      ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < same_place; }),
                 ends.end());
      for (std::size_t i = 0; i < ends.size(); ++i) {
        const double next = i + 1 < ends.size() ? ends[i + 1] : edge.length;
        double middle = edge.start + 0.5 * (ends[i] + next) - offset;
        middle -= length * std::floor(middle / length);
        std::uint32_t found = none;
        for (std::uint32_t c = 0; c < cuts.size() && edge.is_chosen; ++c) {
          if (middle >= cuts[c].start && middle <= cuts[c].start + cuts[c].size) found = c;
        }
        ring.push_back(edge.from + (edge.to - edge.from) * (ends[i] / edge.length));
        section.push_back(found);
        const double depth = found == none ? 0 : number_of(d, d.grammar.parts[cuts[found].part].depth.value);
        distances.push_back(std::max(0.0, depth));
      }
    }
    for (std::size_t r = 1; r < plan.rings.size(); ++r) {
      cut_plan.rings.push_back(plan.rings[r]);
      distances.insert(distances.end(), plan.rings[r].size(), 0.0);
      section.insert(section.end(), plan.rings[r].size(), none);
    }
    const Setback made = seedmesh::setback(cut_plan, distances, d.job);
    for (std::uint32_t c = 0; c < cuts.size(); ++c) {
      std::vector<Plan> plans;
      for (const PlanStrip& strip : made.strips) {
        if (section[strip.edge] == c) plans.push_back(strip.plan);
      }
      ShapeState like = state;
      like.split_index = c;
      like.split_total = static_cast<std::uint32_t>(cuts.size());
      run(d.grammar.parts[cuts[c].part].body, plans, like);
    }
    for (std::uint32_t p = 0; p < step.part_count; ++p) {
      const Part& part = d.grammar.parts[step.first_part + p];
      if (!part.is_remainder) continue;
      for (const DerivedPlan& rest : made.remainder) run(part.body, {rest.plan}, state);
    }
  }
}

}  // namespace seedmesh::building::operators
