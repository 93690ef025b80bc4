#include "core/generators/building/interpret.h"

#include <algorithm>

#include "core/generators/building/choose_rule.h"
#include "core/generators/building/containment.h"
#include "core/generators/building/evaluate.h"
#include "core/generators/building/lifted_faces.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/raised_solids.h"
#include "core/generators/building/slabs.h"
#include "core/generators/building/tags.h"

namespace seedmesh::building {
namespace {

std::uint32_t add_shape(Derivation& d, const ShapeState& state, const Frame& frame, std::uint64_t key,
                        std::uint32_t symbol) {
  const Shape& parent = d.out.shapes[frame.shape];
  if (d.is_finishing && parent.depth >= deepest_shape) {
    const Symbol& name = d.grammar.symbols[parent.symbol];
    d.guarded_steps = 0;  // not a fault of one step
    reject(d, name.rules.empty() ? 0 : d.grammar.rules[name.rules.front()].offset,
           "`" + name.name + "` is nested 1,000 shapes deep: its rules call each other without an end");
  }
  Shape shape(state);
  shape.depth = static_cast<std::uint16_t>(parent.depth + 1);
  shape.key = key;
  shape.parent = frame.shape;
  shape.symbol = symbol;
  shape.is_carried = frame.is_carried;
  d.meter.spend();
  d.out.shapes.push_back(shape);
  const auto index = static_cast<std::uint32_t>(d.out.shapes.size()) - 1;
  edit_shape(d, index);
  return index;
}

/// Has an edit chosen the rule of the shape?
bool has_own_rule(const Derivation& d, std::uint32_t index) {
  return d.out.symbols_before_edits.contains(index);
}

/// No rule is applied to the shape any more. Its scope has the depth of its geometry.
void make_leaf(Derivation& d, std::uint32_t index) {
  Shape& shape = d.out.shapes[index];
  if (d.grammar.turns_scopes) lower_face(d, shape);
  shape.is_leaf = true;
}

/// Adds a shape of the step's symbol, with the values of its arguments.
void call_symbol(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  check_containment(d, site.frame.shape, state, step.offset);
  const std::uint32_t index = add_shape(d, state, site.frame, site.key, step.symbol);
  const bool is_edited = has_own_rule(d, index);
  if (!is_edited && (step.is_leaf || (step.stays_whole && d.is_finishing))) make_leaf(d, index);
  if (step.argument_count == 0) return;
  if (is_edited && least_parameters(d.grammar, d.out.shapes[index].symbol) != step.argument_count) return;
  const auto first = static_cast<std::uint32_t>(d.out.parameters.size());
  for (std::uint32_t i = 0; i < step.argument_count; ++i)
    d.out.parameters.push_back(number_or_text(d, d.grammar.arguments[step.first_argument + i].value));
  Shape& shape = d.out.shapes[index];
  shape.first_parameter = first;
  shape.parameter_count = static_cast<std::uint8_t>(step.argument_count);
}

void take_away(Derivation& d, const Step&, ShapeState&, const StepContext&) {
  d.out.has_removed_shape = true;
}

void ignore(Derivation&, const Step&, ShapeState&, const StepContext&) {}

/// Cases or percentages in the place of steps.
void nested_body(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  Frame own = site.frame;
  own.key = site.key;
  run_body(d, d.grammar.parts[step.first_part].body, state, own);
}

/// What an operation leaves of the shape that a successor works on.
enum class Rest : std::uint8_t {
  same,  ///< as open as before
  open,  ///< the shape has new geometry: it becomes a leaf unless a later step uses it
  used,  ///< other shapes were made of it
};

struct OperatorRow {
  Op op;
  Operator* run;
  Rest rest;
};

/// In the order of Op. push and pop are handled by run_choice.
constexpr OperatorRow operator_rows[] = {
    {Op::symbol, call_symbol, Rest::used},
    {Op::nil, take_away, Rest::used},
    {Op::push, nullptr, Rest::same},
    {Op::pop, nullptr, Rest::same},
    {Op::body, nested_body, Rest::used},
    {Op::ignored, ignore, Rest::same},
    {Op::translate, operators::translate, Rest::same},
    {Op::size, operators::resize, Rest::same},
    {Op::rotate, operators::rotate, Rest::same},
    {Op::center, operators::center, Rest::same},
    {Op::mirror_scope, operators::mirror_scope, Rest::same},
    {Op::align_to_axes, operators::align_to_axes, Rest::same},
    {Op::align_to_geometry, operators::align_to_geometry, Rest::same},
    {Op::align_to_box, operators::align_to_geometry, Rest::same},
    {Op::split, operators::split, Rest::used},
    {Op::split_area, operators::split_area, Rest::used},
    {Op::repeat, operators::repeat, Rest::used},
    {Op::comp, operators::comp, Rest::used},
    {Op::snap, operators::snap, Rest::same},
    {Op::extrude, operators::extrude, Rest::open},
    {Op::taper, operators::taper, Rest::open},
    {Op::offset, operators::offset, Rest::open},
    {Op::setback, operators::setback, Rest::used},
    {Op::shape_l, operators::setback, Rest::used},
    {Op::shape_u, operators::setback, Rest::used},
    {Op::shape_o, operators::setback, Rest::used},
    {Op::inner_rectangle, operators::inner_rectangle, Rest::used},
    {Op::inner_rect, operators::inner_rect, Rest::open},
    {Op::roof_hip, operators::roof, Rest::open},
    {Op::roof_gable, operators::roof, Rest::open},
    {Op::roof_pyramid, operators::roof, Rest::open},
    {Op::roof_shed, operators::roof, Rest::open},
    {Op::roof_mansard, operators::roof, Rest::open},
    {Op::roof_gambrel, operators::roof, Rest::open},
    {Op::roof, operators::roof_2006, Rest::used},
    {Op::insert, operators::insert, Rest::open},
    {Op::place, operators::place, Rest::used},
    {Op::color, operators::style, Rest::same},
    {Op::material, operators::style, Rest::same},
    {Op::set, operators::set, Rest::same},
    {Op::setup_projection, operators::setup_projection, Rest::same},
    {Op::project_uv, operators::project_uv, Rest::same},
    {Op::report, operators::report, Rest::same},
    {Op::label, operators::style, Rest::same},
    {Op::translate_in, operators::translate_in, Rest::same},
    {Op::rotate_in, operators::rotate_in, Rest::same},
    {Op::rotate_scope, operators::rotate_scope, Rest::same},
    {Op::set_pivot, operators::set_pivot, Rest::same},
    {Op::mirror, operators::mirror, Rest::same},
    {Op::reverse_normals, operators::reverse_normals, Rest::same},
    {Op::cleanup, operators::cleanup, Rest::same},
    {Op::convexify, operators::convexify, Rest::same},
    {Op::delete_holes, operators::delete_holes, Rest::same},
    {Op::rectify, operators::rectify, Rest::same},
    {Op::reduce, operators::reduce, Rest::same},
    {Op::set_normals, operators::set_normals, Rest::same},
    {Op::trim, ignore, Rest::same},
    {Op::reset_geometry, operators::reset_geometry, Rest::open},
    {Op::reset_material, operators::reset_material, Rest::same},
    {Op::set_material, operators::set_material, Rest::same},
    {Op::footprint, operators::footprint, Rest::open},
    {Op::envelope, operators::envelope, Rest::open},
    {Op::primitive_quad, operators::primitive, Rest::open},
    {Op::primitive_disk, operators::primitive, Rest::open},
    {Op::primitive_cube, operators::primitive, Rest::open},
    {Op::primitive_sphere, operators::primitive, Rest::open},
    {Op::primitive_cylinder, operators::primitive, Rest::open},
    {Op::primitive_cone, operators::primitive, Rest::open},
    {Op::primitive_fitted, operators::primitive_fitted, Rest::open},
    {Op::primitive_polygon, operators::primitive_polygon, Rest::open},
    {Op::insert_along_uv, operators::insert_along_uv, Rest::used},
    {Op::roof_ridge, operators::roof_ridge, Rest::open},
    {Op::setback_per_edge, operators::setback, Rest::used},
    {Op::setback_to_area, operators::setback, Rest::used},
    {Op::split_perimeter, operators::split_perimeter, Rest::used},
    {Op::scatter, operators::scatter, Rest::used},
    {Op::inline_shapes, operators::inline_shapes, Rest::open},
    {Op::modify, operators::modify, Rest::open},
    {Op::unite, operators::combine, Rest::open},
    {Op::subtract, operators::combine, Rest::open},
    {Op::intersect, operators::combine, Rest::open},
    {Op::tag, operators::tag, Rest::same},
    {Op::delete_tags, operators::tag, Rest::same},
    {Op::edge_tags, ignore, Rest::same},
    {Op::texture, operators::texture, Rest::same},
    {Op::normalize_uv, operators::normalize_uv, Rest::same},
    {Op::scale_uv, operators::change_uv, Rest::same},
    {Op::rotate_uv, operators::change_uv, Rest::same},
    {Op::translate_uv, operators::change_uv, Rest::same},
    {Op::tile_uv, operators::tile_uv, Rest::same},
    {Op::copy_uv, operators::copy_uv, Rest::same},
    {Op::delete_uv, operators::delete_uv, Rest::same},
    {Op::print, operators::print, Rest::same},
};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < std::size(operator_rows); ++i) {
    if (static_cast<std::size_t>(operator_rows[i].op) != i) return false;
  }
  return std::size(operator_rows) == static_cast<std::size_t>(Op::print) + 1;
}
static_assert(is_in_order());

/// Whether an operation uses the geometry of a shape, and not only the scope around it.
bool needs_face(const OperatorRow& row) {
  constexpr Op filling[] = {Op::symbol,           Op::insert,           Op::place,
                            Op::primitive_quad,   Op::primitive_disk,   Op::primitive_cube,
                            Op::primitive_sphere, Op::primitive_cone,   Op::primitive_cylinder,
                            Op::primitive_fitted, Op::primitive_polygon};
  return row.rest != Rest::same && std::ranges::find(filling, row.op) == std::end(filling);
}

/// Runs one step. In a rule file of CityEngine a step that cannot be done is left out with a warning, as there. In other
/// rules, solids and roofs over a level face, such as a terrace, stand up as those over a lot do.
void run_step(Derivation& d, const OperatorRow& row, const Step& step, ShapeState& state,
              const StepContext& site) {
  if (!d.grammar.is_cityengine) {
    if (d.grammar.keeps_scopes || !raises_faces(step.op)) return row.run(d, step, state, site);
    const ShapeState face = state;
    row.run(d, step, state, site);
    if (is_level_face(d, face)) stand_up(d, step, face, state);
    return;
  }
  const ShapeState before = state;
  const int depth = d.depth_of_inline;
  const Component* const component = d.component;
  ++d.guarded_steps;
  try {
    const bool is_theirs = d.grammar.turns_scopes;
    if (is_theirs && needs_face(row)) lower_face(d, state);
    if (is_theirs) face_forward(d, step, state);
    const ShapeState face = state;
    row.run(d, step, state, site);
    if (is_theirs) stand_up(d, step, face, state);
  } catch (const StepError& error) {
    state = before;
    d.depth_of_inline = depth;
    d.component = component;
    warn(d, error.offset, error.message + "; the operation is left out");
  }
  --d.guarded_steps;
}

/// Runs symbols side by side as a stack. False: they are none.
bool run_stack(Derivation& d, const Choice& choice, const ShapeState& given, const Frame& frame) {
  const std::vector<Cut> cuts = stack_of(d, choice, given, frame);
  for (const Cut& cut : cuts) {
    std::optional<ShapeState> piece = slab_of(d, given, 1, cut, false);
    if (!piece) continue;
    piece->split_index = cut.part;
    piece->split_total = choice.step_count;
    const std::uint64_t key = key_at(frame.key, cut.part);
    look_at(d, given, frame.shape);
    d.random = Rng(key);
    call_symbol(d, d.grammar.steps[choice.first_step + cut.part], *piece, {frame, key});
  }
  return !cuts.empty();
}

void run_choice(Derivation& d, const Choice& choice, const ShapeState& given, const Frame& frame) {
  struct Bracket {
    ShapeState state, before;
    bool is_pending;
  };
  if (choice.is_stack && run_stack(d, choice, given, frame)) return;
  ShapeState state = given;
  Frame own = frame;
  own.before = given;
  std::vector<Bracket> brackets;
  bool is_pending = true;
  const std::uint32_t symbol = d.out.shapes[frame.shape].symbol;
  std::uint32_t last = 0;  // the latest operation, which made what is pending
  const auto add_pending = [&](std::uint64_t key) {
    if (!is_pending) return;
    check_containment(d, frame.shape, state, last);
    add_leaf(d, state, own, key, symbol);
  };
  for (std::uint32_t i = 0; i < choice.step_count; ++i) {
    const Step& step = d.grammar.steps[choice.first_step + i];
    const std::uint64_t key = key_at(frame.key, i);
    if (step.op == Op::push) {
      brackets.push_back({state, own.before, is_pending});
      own.before = state;
      is_pending = false;
    } else if (step.op == Op::pop) {
      add_pending(key);
      state = brackets.back().state;
      own.before = brackets.back().before;
      is_pending = false;
      brackets.pop_back();
    } else {
      const OperatorRow& row = operator_rows[static_cast<std::size_t>(step.op)];
      look_at(d, state, frame.shape);
      d.random = Rng(key);
      if (row.rest != Rest::same) is_pending = row.rest == Rest::open;
      const ShapeState before = state;
      run_step(d, row, step, state, {own, key});
      if (d.grammar.uses_tags) add_auto_tags(d, step.op, before, state);
      last = step.offset;
    }
  }
  add_pending(key_at(frame.key, choice.step_count));
}

}  // namespace

bool has_rule(const Derivation& d, const Shape& shape) {
  return shape.is_active && !shape.is_leaf && !d.grammar.symbols[shape.symbol].rules.empty();
}

bool expand(Derivation& d, std::uint32_t index) {
  const Choice* choice = nullptr;
  if (d.grammar.is_cityengine) ++d.guarded_steps;
  try {
    choice = choose(d, index);
  } catch (const StepError& error) {  // the shape stays as it is
    warn(d, error.offset, error.message + "; the rule is left out");
  }
  if (d.grammar.is_cityengine) --d.guarded_steps;
  if (choice == nullptr) {
    make_leaf(d, index);
    return false;
  }
  if (d.task.keeps_choices) {
    if (d.out.choices.size() <= index) d.out.choices.resize(d.out.shapes.size(), none);
    d.out.choices[index] = static_cast<std::uint32_t>(choice - d.grammar.choices.data());
  }
  const Shape shape = d.out.shapes[index];
  d.out.shapes[index].is_active = false;
  run_choice(d, *choice, shape, {index, shape.key, static_cast<const ShapeState&>(shape), shape.is_carried});
  d.locals.erase(index);
  return true;
}

void run_body(Derivation& d, std::uint32_t index, const ShapeState& state, const Frame& frame) {
  const Body& body = d.grammar.bodies[index];
  const Branch& first = d.grammar.branches[body.first_branch];
  if (body.branch_count == 1 && !first.condition.is_given && first.choice_count == 1)
    return run_choice(d, d.grammar.choices[first.first_choice], state, frame);
  d.random = Rng(key_at(frame.key, step_of_conditions));
  for (std::uint32_t b = 0; b < body.branch_count; ++b) {
    const Branch& branch = d.grammar.branches[body.first_branch + b];
    look_at(d, state, frame.shape);
    if (branch.condition.is_given && !holds(d, branch.condition)) continue;
    double sum = 0;
    for (std::uint32_t c = 0; c < branch.choice_count; ++c)
      sum += weight_of(d, d.grammar.choices[branch.first_choice + c], sum);
    check_sum_of_weights(d, sum, d.grammar.choices[branch.first_choice].weight.offset);
    double at = Rng(key_at(frame.key, step_of_choice)).unit() * sum, before = 0;
    for (std::uint32_t c = 0; c < branch.choice_count; ++c) {
      const Choice& choice = d.grammar.choices[branch.first_choice + c];
      const double weight = weight_of(d, choice, before);
      before += weight;
      at -= weight;
      if (at < 0 || c + 1 == branch.choice_count) return run_choice(d, choice, state, frame);
    }
    return;
  }
}

void add_leaf(Derivation& d, const ShapeState& state, const Frame& frame, std::uint64_t key,
              std::uint32_t symbol) {
  const std::uint32_t index = add_shape(d, state, frame, key, symbol);
  if (!has_own_rule(d, index)) make_leaf(d, index);
}

}  // namespace seedmesh::building
