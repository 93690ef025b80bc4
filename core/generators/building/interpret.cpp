/// Which rule a shape takes, and the walk through its successor.
#include <algorithm>
#include <cmath>

#include "core/generators/building/deriver.h"

namespace seedmesh::building {
namespace {

// Numbers of places below a shape that no operation has.
constexpr std::uint64_t place_of_conditions = 0xFFFF'FFFF'0001U, place_of_choice = 0xFFFF'FFFF'0002U;
constexpr double longest = 1e7;  ///< metres; beyond it single precision has no centimetres

}  // namespace

void Deriver::reject(std::uint32_t offset, const std::string& message) const {
  Job::reject(issue_in_rules(plan_, offset, message));
}

/// Rejects the attribute of the request that is the value; else does nothing.
void Deriver::blame_attribute(std::uint32_t offset, double given, const std::string& message) const {
  const bool is_text = out_.texts.of(given) != nullptr;
  for (const Attribute& attribute : grammar_.attributes) {
    const auto found = plan_.attributes.find(attribute.name);
    if (found == plan_.attributes.end() || found->second != given) continue;
    const lang::Expression& own = attribute.value.expression;
    // A number may be equal by chance: it is to blame where the rules' own value is a text.
    if (!is_text && (!own.is_constant || out_.texts.of(own.value) == nullptr)) continue;
    const TextPlace place = place_of(plan_.text, offset);
    Job::reject({"/attributes/" + attribute.name, message + " as the rules use it in line " +
                                                      std::to_string(place.line) + ", column " +
                                                      std::to_string(place.column)});
  }
}

void Deriver::warn(std::uint32_t offset, const std::string& message) {
  if (warned_.size() >= 100 || std::ranges::find(warned_, offset) != warned_.end()) return;
  warned_.push_back(offset);
  const Issue issue = issue_in_rules(plan_, offset, message);
  out_.warnings.push_back({issue.pointer, issue.message, issue.line, issue.column});
}

void Deriver::look_at(const State& state, std::uint32_t shape) {
  seen_ = &state;
  seen_shape_ = shape;
  is_filled_ = false;
}

void Deriver::fill_slots() {
  const State& state = *seen_;
  slots_[slot_sx] = state.size.x;
  slots_[slot_sy] = state.size.y;
  slots_[slot_sz] = state.size.z;
  slots_[slot_tx] = state.origin.x;
  slots_[slot_ty] = state.origin.y;
  slots_[slot_tz] = state.origin.z;
  slots_[slot_split_index] = state.split_index;
  slots_[slot_split_total] = state.split_total;
  slots_[slot_comp_index] = state.comp_index;
  slots_[slot_comp_total] = state.comp_total;
  slots_[slot_area] = area(state);
  slots_[slot_volume] = volume(state);
  const Shape& shape = out_.shapes[seen_shape_];
  slots_[slot_depth] = shape.depth;
  for (std::uint32_t i = 0; i < shape.parameter_count; ++i)
    slots_[grammar_.first_parameter_slot + i] = out_.parameters[shape.first_parameter + i];
  is_filled_ = true;
  if (out_.attribute_sets.empty()) return;
  const std::uint32_t set = out_.styles[state.style].attributes;
  if (set == filled_attributes_) return;
  std::ranges::copy(out_.attribute_sets[set], slots_.begin() + grammar_.first_attribute_slot);
  filled_attributes_ = set;
}

double Deriver::value(const Value& value) {
  if (value.expression.is_constant) return value.expression.value;
  if (!is_filled_) fill_slots();
  for (std::uint32_t i = 0; i < value.query_count; ++i) {
    const std::uint32_t index = grammar_.query_uses[value.first_query + i];
    double answer = 0;
    const Query& query = grammar_.queries[index];
    if (query.kind == Query::Kind::visible) answer = 1;  // nothing is in the way in the first pass
    if (first_ != nullptr) {
      std::vector<std::uint64_t> lineage;
      for (std::uint32_t s = seen_shape_; s != none; s = out_.shapes[s].parent)
        lineage.push_back(out_.shapes[s].key);
      answer = first_->answer(query, {seen_->origin, seen_->size, out_.axes[seen_->axes]}, lineage, job_);
    }
    if (query.kind == Query::Kind::occlusion) {
      answer = out_.texts.number_of(answer == 0 ? "none" : answer == 1 ? "part" : "full");
    }
    slots_[first_free_slot + index] = answer;
  }
  return grammar_.program.evaluate(value.expression, slots_.data(), draws_);
}

double Deriver::number(const Value& given) {
  const double result = value(given);
  if (!std::isfinite(result)) {
    reject(given.offset, std::isnan(result)
                             ? "the value is not a number (0/0, or the root of a negative number)"
                             : "the value is infinite: something is divided by 0");
  }
  if (std::abs(result) > longest) {
    if (const std::string* text = out_.texts.of(result)) {
      const std::string message = "found the text " + lang::in_quotes(*text) + ", expected a number";
      blame_attribute(given.offset, result, message);
      reject(given.offset, message);
    }
    reject(given.offset, "the value is beyond 10,000 km");
  }
  return result;
}

double Deriver::length(const Argument& argument, double whole) {
  const double result = number(argument.value);
  return argument.measure == Measure::absolute ? result : result * whole;
}

double Deriver::text_number(const Argument& argument) {
  const double result = value(argument.value);
  if (out_.texts.of(result) == nullptr) {
    blame_attribute(argument.value.offset, result, "found a number, expected a text");
    reject(argument.value.offset, "found a number, expected a text in quotes");
  }
  return result;
}

const std::string& Deriver::text(const Argument& argument) { return *out_.texts.of(text_number(argument)); }

const Choice* Deriver::choose(std::uint32_t index) {
  const Shape& shape = out_.shapes[index];
  const Symbol& symbol = grammar_.symbols[shape.symbol];
  if (symbol.rules.size() == 1) {  // the common case: one rule, always
    const Rule& rule = grammar_.rules[symbol.rules[0]];
    const Body& body = grammar_.bodies[rule.body];
    const Branch& branch = grammar_.branches[body.first_branch];
    if (body.branch_count == 1 && !branch.condition.is_given && branch.choice_count == 1 &&
        rule.parameter_count == shape.parameter_count)
      return &grammar_.choices[branch.first_choice];
  }
  State state = state_of(shape);
  look_at(state, index);
  return choose_in(symbol.rules, shape.parameter_count, shape.key);
}

/// The first branch that holds; where its choices leave something of 1, later rules that hold take part too.
const Choice* Deriver::choose_in(std::span<const std::uint32_t> rules, std::uint32_t parameters,
                                 std::uint64_t key) {
  draws_ = Rng(key_at(key, place_of_conditions));
  std::vector<std::pair<const Choice*, double>> open;
  double sum = 0;
  bool is_complete = false;
  for (std::size_t r = 0; r < rules.size() && !is_complete; ++r) {
    const Rule& rule = grammar_.rules[rules[r]];
    if (rule.parameter_count != parameters) continue;
    const Body& body = grammar_.bodies[rule.body];
    for (std::uint32_t b = 0; b < body.branch_count; ++b) {
      const Branch& branch = grammar_.branches[body.first_branch + b];
      if (branch.condition.is_given && value(branch.condition) == 0) continue;
      for (std::uint32_t c = 0; c < branch.choice_count && !is_complete; ++c) {
        const Choice& choice = grammar_.choices[branch.first_choice + c];
        const double weight =
            choice.weight.is_given ? std::max(0.0, number(choice.weight)) : std::max(0.0, 1 - sum);
        is_complete = !choice.weight.is_given;
        open.emplace_back(&choice, weight);
        sum += weight;
      }
      is_complete |= sum >= 1 - 1e-9;
      break;
    }
  }
  if (open.empty()) return nullptr;
  if (open.size() == 1) return open[0].first;
  double at = Rng(key_at(key, place_of_choice)).unit() * sum;
  for (const auto& [choice, weight] : open) {
    at -= weight;
    if (at < 0) return choice;
  }
  return open.back().first;
}

void Deriver::run_body(std::uint32_t index, const State& state, const Frame& frame) {
  const Body& body = grammar_.bodies[index];
  const Branch& first = grammar_.branches[body.first_branch];
  if (body.branch_count == 1 && !first.condition.is_given && first.choice_count == 1)
    return run_choice(grammar_.choices[first.first_choice], state, frame);
  draws_ = Rng(key_at(frame.key, place_of_conditions));
  for (std::uint32_t b = 0; b < body.branch_count; ++b) {
    const Branch& branch = grammar_.branches[body.first_branch + b];
    look_at(state, frame.shape);
    if (branch.condition.is_given && value(branch.condition) == 0) continue;
    double sum = 0;
    for (std::uint32_t c = 0; c < branch.choice_count; ++c) {
      const Choice& choice = grammar_.choices[branch.first_choice + c];
      sum += choice.weight.is_given ? std::max(0.0, number(choice.weight)) : std::max(0.0, 1 - sum);
    }
    double at = Rng(key_at(frame.key, place_of_choice)).unit() * sum, before = 0;
    for (std::uint32_t c = 0; c < branch.choice_count; ++c) {
      const Choice& choice = grammar_.choices[branch.first_choice + c];
      const double weight =
          choice.weight.is_given ? std::max(0.0, number(choice.weight)) : std::max(0.0, 1 - before);
      before += weight;
      at -= weight;
      if (at < 0 || c + 1 == branch.choice_count) return run_choice(choice, state, frame);
    }
    return;
  }
}

void Deriver::run_choice(const Choice& choice, const State& given, const Frame& frame) {
  struct Bracket {
    State state, before;
    bool is_pending;
  };
  State state = given;
  Frame own = frame;
  own.before = given;
  std::vector<Bracket> brackets;
  bool is_pending = true;
  const std::uint32_t symbol = out_.shapes[frame.shape].symbol;
  for (std::uint32_t i = 0; i < choice.step_count; ++i) {
    const Step& step = grammar_.steps[choice.first_step + i];
    const std::uint64_t key = key_at(frame.key, i);
    if (step.op == Op::push) {
      brackets.push_back({state, own.before, is_pending});
      own.before = state;
      is_pending = false;
    } else if (step.op == Op::pop) {
      if (is_pending) leaf(state, own, key, symbol);
      state = brackets.back().state;
      own.before = brackets.back().before;
      is_pending = false;
      brackets.pop_back();
    } else {
      run_step(step, state, own, key, is_pending);
    }
  }
  if (is_pending) leaf(state, own, key_at(frame.key, choice.step_count), symbol);
}

void Deriver::run_step(const Step& step, State& state, const Frame& frame, std::uint64_t key,
                       bool& is_pending) {
  look_at(state, frame.shape);
  draws_ = Rng(key);
  switch (step.op) {
    case Op::symbol:
      is_pending = false;
      return call(step, state, frame, key);
    case Op::nil:
      is_pending = false;
      out_.takes_away = true;
      return;
    case Op::translate:
      return translate(step, state);
    case Op::size:
      return resize(step, state);
    case Op::rotate:
      return rotate(step, state);
    case Op::center:
      return center(step, state, frame);
    case Op::mirror_scope:
      return mirror(state);
    case Op::align_to_axes:
      return align_to_axes(step, state);
    case Op::align_to_geometry:
    case Op::align_to_box:
      return align_to_geometry(step, state);
    case Op::setup_projection:
      return setup_projection(step, state);
    case Op::project_uv:
      return project_uv(step, state);
    case Op::split:
      is_pending = false;
      return split(step, state, frame, key);
    case Op::split_area:
      is_pending = false;
      return split_area(step, state, frame, key);
    case Op::inner_rectangle:
      is_pending = false;
      return inner_rectangle(step, state, frame, key);
    case Op::repeat:
      is_pending = false;
      return repeat(step, state, frame, key);
    case Op::comp:
      is_pending = false;
      return comp(step, state, frame, key);
    case Op::snap:
      return snap(step, state);
    case Op::extrude:
      is_pending = true;
      return extrude(step, state);
    case Op::taper:
      is_pending = true;
      return taper(step, state);
    case Op::roof_hip:
    case Op::roof_gable:
    case Op::roof_pyramid:
    case Op::roof_shed:
    case Op::roof_mansard:
    case Op::roof_gambrel:
      is_pending = true;
      return roof_over(step, state);
    case Op::roof: {
      is_pending = false;
      State roof = state;
      roof_over(step, roof);
      Frame own = frame;
      own.key = key;
      return run_body(grammar_.parts[step.first_part].body, roof, own);
    }
    case Op::offset:
      is_pending = true;
      return offset_face(step, state);
    case Op::setback:
    case Op::shape_l:
    case Op::shape_u:
    case Op::shape_o:
      is_pending = false;
      return set_back(step, state, frame, key);
    case Op::insert:
      is_pending = true;
      return insert(step, state);
    case Op::place: {
      is_pending = false;
      State placed = state;
      insert(step, placed);
      return leaf(placed, frame, key, out_.shapes[frame.shape].symbol);
    }
    case Op::color:
    case Op::material:
    case Op::label:
      return color(step, state);
    case Op::set:
      return set(step, state);
    case Op::report:
      return report(step);
    default:
      return;
  }
}

std::uint32_t Deriver::add(const State& state, const Frame& frame, std::uint64_t key, std::uint32_t symbol) {
  const Shape& parent = out_.shapes[frame.shape];
  if (is_finishing_ && parent.depth >= deepest_shape) {
    const Symbol& name = grammar_.symbols[parent.symbol];
    reject(name.rules.empty() ? 0 : grammar_.rules[name.rules.front()].offset,
           "`" + name.name + "` stands 1,000 shapes deep: its rules call each other without an end");
  }
  Shape shape;
  shape.depth = static_cast<std::uint16_t>(parent.depth + 1);
  shape.origin = state.origin;
  shape.size = state.size;
  shape.key = key;
  shape.parent = frame.shape;
  shape.symbol = symbol;
  shape.axes = state.axes;
  shape.geometry = state.geometry;
  shape.style = state.style;
  shape.split_index = state.split_index;
  shape.split_total = state.split_total;
  shape.comp_index = state.comp_index;
  shape.comp_total = state.comp_total;
  shape.roof_up = state.roof_up;
  shape.is_carried = frame.is_carried;
  meter_.spend();
  out_.shapes.push_back(shape);
  return static_cast<std::uint32_t>(out_.shapes.size()) - 1;
}

void Deriver::leaf(const State& state, const Frame& frame, std::uint64_t key, std::uint32_t symbol) {
  out_.shapes[add(state, frame, key, symbol)].is_leaf = true;
}

void Deriver::call(const Step& step, const State& state, const Frame& frame, std::uint64_t key) {
  const std::uint32_t index = add(state, frame, key, step.symbol);
  if (step.is_leaf || (step.stays_whole && is_finishing_)) out_.shapes[index].is_leaf = true;
  if (step.argument_count == 0) return;
  const auto first = static_cast<std::uint32_t>(out_.parameters.size());
  for (std::uint32_t i = 0; i < step.argument_count; ++i) {
    const Value& argument = grammar_.arguments[step.first_argument + i].value;
    double result = value(argument);
    if (out_.texts.of(result) == nullptr) result = number(argument);
    out_.parameters.push_back(result);
  }
  Shape& shape = out_.shapes[index];
  shape.first_parameter = first;
  shape.parameter_count = static_cast<std::uint8_t>(step.argument_count);
}

}  // namespace seedmesh::building
