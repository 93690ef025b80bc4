#include "core/generators/building/derive.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "core/generators/building/deriver.h"

namespace seedmesh::building {

std::string text_of_number(double number) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() ? std::string(text.data(), end) : std::string();
}

Issue issue_in_rules(const Task& task, std::size_t offset, const std::string& message) {
  if (!task.is_blueprint) return issue_at("/rules", task.text, offset, message);
  return {"/blueprint", message + " (line " + std::to_string(place_of(task.text, offset).line) +
                            " of the blueprint's rules)"};
}

Deriver::Deriver(const Task& plan, const Context* first, Job& job)
    : plan_(plan),
      grammar_(*plan.grammar),
      first_(first),
      job_(job),
      meter_(job, Resource::shapes),
      out_(job) {
  slots_.assign(grammar_.first_parameter_slot + grammar_.most_parameters + 1, 0.0);
  for (int axis = 0; axis < 3; ++axis) squares_[static_cast<std::size_t>(axis)] = square(axis);
  for (const AssetBox& asset : plan.assets) out_.asset_names.push_back(asset.name);
  styles_.emplace(Style{}, 0);
  part_options_.emplace(PartOptions{}, 0);
  out_.texts = grammar_.texts;
}

/// Attributes are worked out once, against the first shape; each has random numbers of its own.
void Deriver::evaluate_attributes() {
  std::vector<double> values(grammar_.attributes.size(), 0.0);
  for (const Attribute& attribute : grammar_.attributes) {
    const auto given = plan_.attributes.find(attribute.name);
    double number = 0;
    if (given != plan_.attributes.end() && !attribute.is_constant) {
      number = given->second;
    } else {
      draws_ = job_.rng().at("attribute").at(attribute.name);
      is_filled_ = true;
      number = value(attribute.value);
    }
    slots_[attribute.slot] = number;
    values[attribute.slot - grammar_.first_attribute_slot] = number;
  }
  attribute_sets_.emplace(values, 0);
  out_.attribute_sets.push_back(std::move(values));
}

void Deriver::begin() {
  State state;
  state.origin = plan_.origin;
  state.size = plan_.size;
  if (plan_.footprint != nullptr) state.geometry = add_solid(*plan_.footprint);
  out_.shapes.reserve(64);
  Shape shape;
  shape.origin = state.origin;
  shape.size = state.size;
  shape.geometry = state.geometry;
  shape.symbol = grammar_.start;
  shape.key = job_.rng().at("building").key();
  if (least_parameters(grammar_, grammar_.start) == 1) {
    // As facade(h) of 2006 alone: h is the height. The check of the request has warned.
    shape.parameter_count = 1;
    out_.parameters.push_back(state.size.y);
  }
  meter_.spend();
  out_.shapes.push_back(shape);
  seen_ = &state;
  seen_shape_ = 0;
  fill_slots();
  evaluate_attributes();
  filled_attributes_ = 0;
}

bool Deriver::has_rule(const Shape& shape) const {
  return shape.is_active && !shape.is_leaf && !grammar_.symbols[shape.symbol].rules.empty();
}

Deriver::State Deriver::state_of(const Shape& shape) {
  State state;
  state.origin = shape.origin;
  state.size = shape.size;
  state.axes = shape.axes;
  state.geometry = shape.geometry;
  state.style = shape.style;
  state.split_index = shape.split_index;
  state.split_total = shape.split_total;
  state.comp_index = shape.comp_index;
  state.comp_total = shape.comp_total;
  state.roof_up = shape.roof_up;
  return state;
}

/// Replaces a shape; false where no rule holds, and then it is a leaf.
bool Deriver::expand(std::uint32_t index) {
  const Choice* const choice = choose(index);
  if (choice == nullptr) {
    out_.shapes[index].is_leaf = true;
    return false;
  }
  if (plan_.keeps_choices) {
    if (out_.choices.size() <= index) out_.choices.resize(out_.shapes.size(), none);
    out_.choices[index] = static_cast<std::uint32_t>(choice - grammar_.choices.data());
  }
  const Shape shape = out_.shapes[index];
  out_.shapes[index].is_active = false;
  const State state = state_of(shape);
  run_choice(*choice, state, {index, shape.key, state, shape.is_carried});
  return true;
}

void Deriver::finish_all() {
  is_finishing_ = true;
  std::vector<std::uint32_t> open{0};
  while (!open.empty() && out_.shapes.size() <= plan_.most_shapes) {
    const std::uint32_t index = open.back();
    open.pop_back();
    if (!has_rule(out_.shapes[index])) continue;
    const auto first = static_cast<std::uint32_t>(out_.shapes.size());
    expand(index);
    for (auto i = static_cast<std::uint32_t>(out_.shapes.size()); i-- > first;) {
      if (has_rule(out_.shapes[i])) open.push_back(i);
    }
  }
}

void Deriver::parallel(int rounds) {
  std::vector<std::uint32_t> open{0}, next;
  for (int round = 0; round < rounds && !open.empty() && out_.shapes.size() <= plan_.most_shapes; ++round) {
    next.clear();
    for (const std::uint32_t index : open) {
      const auto first = static_cast<std::uint32_t>(out_.shapes.size());
      if (has_rule(out_.shapes[index])) expand(index);
      for (auto i = first; i < out_.shapes.size(); ++i) next.push_back(i);
    }
    std::swap(open, next);
  }
}

/// One rule a step: the shape of the lowest priority level that is oldest (breadth) or newest (depth).
void Deriver::sequential(int steps) {
  std::set<std::tuple<std::int32_t, std::int64_t>> open;
  const auto enter = [&](std::uint32_t index, std::int64_t order) {
    const Shape& shape = out_.shapes[index];
    if (!has_rule(shape)) return;
    const std::int32_t priority = grammar_.rules[grammar_.symbols[shape.symbol].rules.front()].priority;
    open.emplace(priority, order);
  };
  // Depth first: later families come before earlier ones, siblings keep their order.
  std::vector<std::uint32_t> shape_of{0};
  std::int64_t family = 0;
  std::map<std::int64_t, std::uint32_t> shapes_by_order;
  shapes_by_order.emplace(0, 0U);
  enter(0, 0);
  for (int step = 0; step < steps && !open.empty() && out_.shapes.size() <= plan_.most_shapes;) {
    const auto [priority, order] = *open.begin();
    open.erase(open.begin());
    const std::uint32_t index = shapes_by_order[order];
    const auto first = static_cast<std::uint32_t>(out_.shapes.size());
    if (expand(index)) ++step;
    --family;
    for (auto i = first; i < out_.shapes.size(); ++i) {
      const std::int64_t place =
          plan_.is_depth_first ? family * 4'294'967'296 + i : static_cast<std::int64_t>(i);
      shapes_by_order.emplace(place, i);
      enter(i, place);
    }
  }
}

Shapes Deriver::run() {
  begin();
  if (!plan_.iterations)
    finish_all();
  else if (plan_.is_sequential)
    sequential(*plan_.iterations);
  else
    parallel(*plan_.iterations);
  return std::move(out_);
}

Shapes derive_shapes(const Task& plan, Job& job) {
  const Grammar& grammar = *plan.grammar;
  if (grammar.queries.empty() && !grammar.listens_to_snaps) return Deriver(plan, nullptr, job).run();
  Deriver first(plan, nullptr, job);
  Shapes shapes = first.run();
  const Context context(std::move(shapes), first.take_snaps(), grammar);
  return Deriver(plan, &context, job).run();
}

}  // namespace seedmesh::building
