#include "core/generators/building/evaluate.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::building {
namespace {

constexpr double longest = 1e7;  ///< metres; beyond it single precision has no centimetres

/// Rejects the attribute of the request that has the value, if there is one.
void reject_attribute(const Derivation& d, std::uint32_t offset, const lang::TaggedValue& value,
                      const std::string& message) {
  for (const Attribute& attribute : d.grammar.attributes) {
    const auto found = d.task.attributes.find(attribute.name);
    if (found == d.task.attributes.end() || found->second != value) continue;
    // Equal numbers may be a coincidence, unless the value in the rules is a text.
    if (!value.is_text() && attribute.value.expression.text == 0) continue;
    const Issue place = issue_in_rules(d.task, IssueKind::evaluation, offset, "");
    d.job.refuse({IssueKind::wrong_type, "/attributes/" + attribute.name,
                  message + "; the rules use it in line " + std::to_string(place.line) + ", column " +
                      std::to_string(place.column)});
  }
}

}  // namespace

void fill_slots(Derivation& d) {
  const ShapeState& state = *d.seen;
  d.slots[slot_sx].number = state.size.x;
  d.slots[slot_sy].number = state.size.y;
  d.slots[slot_sz].number = state.size.z;
  d.slots[slot_tx].number = state.origin.x;
  d.slots[slot_ty].number = state.origin.y;
  d.slots[slot_tz].number = state.origin.z;
  d.slots[slot_split_index].number = state.split_index;
  d.slots[slot_split_total].number = state.split_total;
  d.slots[slot_comp_index].number = state.comp_index;
  d.slots[slot_comp_total].number = state.comp_total;
  d.slots[slot_area].number = area_of(d, state);
  d.slots[slot_volume].number = volume_of(d, state);
  const Shape& shape = d.out.shapes[d.seen_shape];
  d.slots[slot_depth].number = shape.depth;
  for (std::uint32_t i = 0; i < shape.parameter_count; ++i)
    d.slots[d.grammar.first_parameter_slot + i] = d.out.parameters[shape.first_parameter + i];
  if (!d.locals.empty()) {
    const auto found = d.locals.find(d.seen_shape);
    if (found != d.locals.end()) {
      std::ranges::copy(found->second,
                        d.slots.begin() + d.grammar.first_parameter_slot + shape.parameter_count);
    }
  }
  d.is_filled = true;
  if (d.out.attribute_sets.empty()) return;
  const std::uint32_t set = d.out.styles[state.style].attributes;
  if (set == d.filled_attributes) return;
  std::ranges::copy(d.out.attribute_sets[set], d.slots.begin() + d.grammar.first_attribute_slot);
  d.filled_attributes = set;
}

void look_at(Derivation& d, const ShapeState& state, std::uint32_t shape) {
  d.seen = &state;
  d.seen_shape = shape;
  d.is_filled = false;
}

lang::TaggedValue answer_of(Derivation& d, const Query& query) {
  double answer = query.kind == Query::Kind::visible ? 1 : 0;  // in the first pass no shape covers another
  if (d.first_pass != nullptr) {
    std::vector<std::uint64_t> lineage;
    for (std::uint32_t s = d.seen_shape; s != none; s = d.out.shapes[s].parent)
      lineage.push_back(d.out.shapes[s].key);
    const Scope scope{d.seen->origin, d.seen->size, d.out.axes[d.seen->axes]};
    answer = d.first_pass->answer(query, scope, lineage, d.job);
  }
  if (query.kind != Query::Kind::occlusion) return {answer, 0};
  return {0, d.out.texts.id_of(answer == 0 ? "none" : answer == 1 ? "part" : "full")};
}

lang::TaggedValue evaluate(Derivation& d, const Value& value) {
  const bool is_tree = value.tree != none && !value.is_fallback;
  if (!is_tree && value.expression.is_constant) return value.expression.constant();
  if (!d.is_filled) fill_slots(d);
  if (is_tree) return evaluate_tree(d, value.tree);
  for (std::uint32_t i = 0; i < value.query_count; ++i) {
    const std::uint32_t index = d.grammar.query_uses[value.first_query + i];
    d.slots[first_free_slot + index] = answer_of(d, d.grammar.queries[index]);
  }
  const Rng random = d.random;
  const lang::TaggedValue result =
      d.grammar.program.evaluate_tagged(value.expression, d.slots.data(), d.random);
  if (!value.is_fallback || result.is_text() || !std::isnan(result.number)) return result;
  d.random = random;  // a parameter is a text or an array
  return evaluate_tree(d, value.tree);
}

bool holds(Derivation& d, const Value& condition) {
  const lang::TaggedValue value = evaluate(d, condition);
  return value.is_text() || value.number != 0;
}

double number_of(Derivation& d, const Value& given) {
  const lang::TaggedValue result = evaluate(d, given);
  if (result.is_text()) {
    const std::string message =
        (is_array(result) ? "found an array"
                          : "found the text " + lang::in_quotes(*d.out.texts.find(result.text))) +
        ", expected a number";
    reject_attribute(d, given.offset, result, message);
    reject(d, given.offset, message);
  }
  if (std::isnan(result.number)) {
    reject(d, given.offset,
           "the value is not a number: it divides 0 by 0, takes the root of a negative number or computes "
           "with a text");
  }
  if (std::isinf(result.number)) reject(d, given.offset, "the value is infinite: something is divided by 0");
  if (std::abs(result.number) > longest) reject(d, given.offset, "the value is beyond 10,000 km");
  return result.number;
}

double length_of(Derivation& d, const Argument& argument, double whole) {
  const double result = number_of(d, argument.value);
  return argument.measure == Measure::absolute ? result : result * whole;
}

std::uint32_t text_id_of(Derivation& d, const Argument& argument) {
  const lang::TaggedValue result = evaluate(d, argument.value);
  if (is_array(result)) reject(d, argument.value.offset, "found an array, expected a text in quotes");
  if (result.is_text()) return result.text;
  reject_attribute(d, argument.value.offset, result, "found a number, expected a text");
  reject(d, argument.value.offset, "found a number, expected a text in quotes");
}

const std::string& text_of(Derivation& d, const Argument& argument) {
  return *d.out.texts.find(text_id_of(d, argument));
}

lang::TaggedValue number_or_text(Derivation& d, const Value& value) {
  const lang::TaggedValue result = evaluate(d, value);
  if (result.is_text() || value.tree != none) return result;
  // The second evaluation draws random numbers of its own, which are those of all earlier versions.
  return {number_of(d, value), 0};
}

namespace {

/// The value of an attribute. In a rule file of CityEngine one that cannot be computed is 0, with a warning.
lang::TaggedValue value_or_zero(Derivation& d, const Attribute& attribute) {
  if (!d.grammar.is_cityengine) return evaluate(d, attribute.value);
  lang::TaggedValue value;
  ++d.guarded_steps;
  try {
    value = evaluate(d, attribute.value);
  } catch (const StepError& error) {
    warn(d, error.offset, error.message + "; " + lang::in_quotes(attribute.name) + " is 0");
  }
  --d.guarded_steps;
  return value;
}

}  // namespace

void evaluate_attributes(Derivation& d, const ShapeState& first) {
  look_at(d, first, 0);
  fill_slots(d);
  std::vector<lang::TaggedValue> values(d.grammar.attributes.size());
  for (const Attribute& attribute : d.grammar.attributes) {
    const auto given = d.task.attributes.find(attribute.name);
    lang::TaggedValue value;
    if (given != d.task.attributes.end() && !attribute.is_constant) {
      value = given->second;
    } else {
      d.random = d.job.rng().at("attribute").at(attribute.name);
      d.is_filled = true;
      value = value_or_zero(d, attribute);
    }
    d.slots[attribute.slot] = value;
    values[attribute.slot - d.grammar.first_attribute_slot] = value;
  }
  d.attribute_set_ids.emplace(values, 0);
  d.out.attribute_sets.push_back(std::move(values));
}

}  // namespace seedmesh::building
