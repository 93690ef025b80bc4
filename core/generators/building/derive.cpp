#include "core/generators/building/derive.h"

#include <algorithm>
#include <set>

#include "core/generators/building/evaluate.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/joined_shapes.h"

namespace seedmesh::building {
namespace {

/// Adds the first shape, and evaluates the attributes for it.
void begin(Derivation& d) {
  ShapeState state;
  state.origin = d.task.origin;
  state.size = d.task.size;
  if (d.task.footprint != nullptr) state.geometry = add_solid(d, *d.task.footprint);
  d.out.shapes.reserve(64);
  Shape shape(state);
  shape.symbol = d.grammar.start;
  shape.key = d.job.rng().at("building").key();
  const std::uint32_t least = least_parameters(d.grammar, d.grammar.start);
  if (least > 1) {  // a rule file of CityEngine; the check of the request has warned
    shape.parameter_count = static_cast<std::uint8_t>(least);
    d.out.parameters.resize(d.out.parameters.size() + least);
  } else if (least == 1) {
    // facade(h) of 2006 as the first rule: h is the height. The check of the request has warned.
    shape.parameter_count = 1;
    d.out.parameters.push_back({state.size.y, 0});
  }
  d.meter.spend();
  d.out.shapes.push_back(shape);
  evaluate_attributes(d, state);
  d.filled_attributes = 0;
  edit_shape(d, 0);
}

void finish_all(Derivation& d) {
  d.is_finishing = true;
  finish_from(d, 0);
}

bool can_go_first(const Derivation& d, const Shape& shape) { return has_rule(d, shape) && !waits(d, shape); }

/// Replaces all shapes of a round at once.
void run_rounds(Derivation& d, int rounds) {
  std::vector<std::uint32_t> open, next;
  if (can_go_first(d, d.out.shapes[0])) open.push_back(0);
  for (int round = 0; round < rounds && d.out.shapes.size() <= d.task.most_shapes; ++round) {
    if (open.empty()) open = take_waiting(d, 0);
    if (open.empty()) break;
    next.clear();
    for (const std::uint32_t index : open) {
      const auto first = static_cast<std::uint32_t>(d.out.shapes.size());
      expand(d, index);
      for (auto i = first; i < d.out.shapes.size(); ++i) {
        if (can_go_first(d, d.out.shapes[i])) next.push_back(i);
      }
    }
    std::swap(open, next);
  }
}

/// Replaces one shape in each step: of the lowest priority, the oldest (breadth first) or the newest (depth
/// first).
void run_steps(Derivation& d, int steps) {
  std::set<std::tuple<std::int32_t, std::int64_t>> open;
  std::int64_t family = 0;
  std::map<std::int64_t, std::uint32_t> shapes_by_order;
  // Depth first: later families come before earlier ones, siblings keep their order.
  const auto enter = [&](std::uint32_t index) {
    const Shape& shape = d.out.shapes[index];
    const std::int64_t order =
        d.task.is_depth_first ? family * 4'294'967'296 + index : static_cast<std::int64_t>(index);
    const std::int32_t priority = d.grammar.rules[d.grammar.symbols[shape.symbol].rules.front()].priority;
    shapes_by_order.emplace(order, index);
    open.emplace(priority, order);
  };
  if (can_go_first(d, d.out.shapes[0])) enter(0);
  for (int step = 0; step < steps && d.out.shapes.size() <= d.task.most_shapes;) {
    if (open.empty()) std::ranges::for_each(take_waiting(d, 0), enter);
    if (open.empty()) break;
    const auto [priority, order] = *open.begin();
    open.erase(open.begin());
    const std::uint32_t index = shapes_by_order[order];
    const auto first = static_cast<std::uint32_t>(d.out.shapes.size());
    if (expand(d, index)) ++step;
    --family;
    for (auto i = first; i < d.out.shapes.size(); ++i) {
      if (can_go_first(d, d.out.shapes[i])) enter(i);
    }
  }
}

Shapes run(Derivation& d) {
  begin(d);
  if (!d.task.iterations) {
    finish_all(d);
  } else if (d.task.is_sequential) {
    run_steps(d, *d.task.iterations);
  } else {
    run_rounds(d, *d.task.iterations);
  }
  d.out.found_edits = d.edits.found();
  return std::move(d.out);
}

}  // namespace

void finish_from(Derivation& d, std::uint32_t first_open) {
  std::vector<std::uint32_t> open;
  const auto enter = [&](std::uint32_t first) {
    for (auto i = static_cast<std::uint32_t>(d.out.shapes.size()); i-- > first;) {
      if (can_go_first(d, d.out.shapes[i])) open.push_back(i);
    }
  };
  enter(first_open);
  while (d.out.shapes.size() <= d.task.most_shapes) {
    if (open.empty()) {
      if (d.grammar.joints.empty()) return;
      open = take_waiting(d, first_open);
      if (open.empty()) return;
      std::ranges::reverse(open);
    }
    const std::uint32_t index = open.back();
    open.pop_back();
    const auto first = static_cast<std::uint32_t>(d.out.shapes.size());
    expand(d, index);
    enter(first);
  }
}

Issue issue_in_rules(const Task& task, IssueKind kind, std::size_t offset, const std::string& message) {
  if (!task.is_blueprint) return issue_at(kind, *task.text, offset, message);
  return {kind, "/blueprint",
          message + " (line " + std::to_string(text_position(task.text->text, offset).line) +
              " of the blueprint's rules)"};
}

Shapes derive_shapes(const Task& task, Job& job) {
  const Grammar& grammar = *task.grammar;
  if (grammar.queries.empty() && !grammar.has_snap_splits) {
    Derivation only(task, nullptr, job);
    return run(only);
  }
  Derivation first(task, nullptr, job);
  Shapes shapes = run(first);
  const FirstPassIndex first_pass(std::move(shapes), std::move(first.snap_planes), grammar);
  Derivation second(task, &first_pass, job);
  return run(second);
}

}  // namespace seedmesh::building
