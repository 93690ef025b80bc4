/// Operations that make one shape of several: inline, modify, union, subtract and intersect. Definitions as in the CGA
/// reference.
#include <algorithm>
#include <set>
#include <utility>

#include "core/base/math.h"
#include "core/generators/building/boolean.h"
#include "core/generators/building/components.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/solid_tools.h"
#include "core/generators/building/tags.h"
#include "core/generators/building/united_shapes.h"

namespace seedmesh::building::operators {
namespace {

constexpr int deepest_inline = 20;

/// Runs a body until no rule applies, and takes the shapes that it made out of the tree again.
std::vector<Shape> leaves_of(Derivation& d, std::uint32_t body, const ShapeState& state,
                             const StepContext& site, std::uint64_t place) {
  if (++d.depth_of_inline > deepest_inline)
    reject(d, 0, "inline, modify and Boolean operations are nested more than 20 deep");
  const auto first = static_cast<std::uint32_t>(d.out.shapes.size());
  Frame own = site.frame;
  own.key = key_at(site.key, place);
  const bool was_finishing = std::exchange(d.is_finishing, true);
  run_body(d, body, state, own);
  finish_from(d, first);
  d.is_finishing = was_finishing;
  --d.depth_of_inline;
  std::vector<Shape> leaves;
  for (auto i = first; i < d.out.shapes.size(); ++i) {
    if (d.out.shapes[i].is_active) leaves.push_back(d.out.shapes[i]);
  }
  d.out.shapes.resize(first);
  if (d.out.choices.size() > first) d.out.choices.resize(first);
  return leaves;
}

/// Gives the state the geometry and the style of the leaves.
void take_joined(Derivation& d, const Step& step, ShapeState& state, std::span<const Shape> leaves,
                 Solid solid) {
  if (solid.faces.empty()) {
    state.size = glm::dvec3(0);
    state.geometry = box_geometry;
    return;
  }
  if (!leaves.empty()) {
    Style style = d.out.styles[state.style];
    const Style& first = d.out.styles[leaves[0].style];
    for (const Shape& leaf : leaves) {
      const Style& own = d.out.styles[leaf.style];
      if (own.color != first.color || own.material != first.material) {
        warn(d, step.offset, "the joined shapes have different materials; the result has the first one");
        break;
      }
    }
    style.color = first.color;
    style.material = first.material;
    state.style = style_with(d, style);
  }
  state.roof_up = no_roof;
  take_solid(d, state, std::move(solid));
}

/// The face of a solid that a component is, with the points of the solid in the axes of `frame`; `none`: no face.
std::size_t face_of(const Derivation& d, const Solid& solid, const ShapeState& frame,
                    const ShapeState& component, double near) {
  const glm::dmat3 to_world = d.out.axes[frame.axes], from_world = glm::transpose(d.out.axes[component.axes]);
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    if (f % 256 == 0) d.job.check();
    const glm::dvec3 normal = math::unit(area_vector(solid, solid.faces[f], glm::dvec3(1)), glm::dvec3(0));
    if ((from_world * (to_world * normal)).z < 1 - 1e-6) continue;
    bool is_in = true;
    for (const std::uint32_t k : points_of(solid, solid.loops[solid.faces[f].first_loop])) {
      const glm::dvec3 p = from_world * (frame.origin + to_world * solid.points[k] - component.origin);
      for (int axis = 0; axis < 3; ++axis)
        is_in &= p[axis] >= -near && p[axis] <= component.size[axis] + near;
    }
    if (is_in) return f;
  }
  return none;
}

bool is_division(Op op) {
  constexpr Op divisions[] = {
      Op::split,           Op::split_area,      Op::repeat,          Op::comp,
      Op::offset,          Op::setback,         Op::setback_to_area, Op::setback_per_edge,
      Op::split_perimeter, Op::inner_rectangle, Op::inner_rect,      Op::shape_l,
      Op::shape_u,         Op::shape_o};
  return std::ranges::find(divisions, op) != std::end(divisions);
}

/// Whether a body, or a rule that it calls, can divide the shape. `seen` are symbols that were checked before.
bool divides(const Grammar& grammar, std::uint32_t body, std::set<std::uint32_t>& seen) {
  if (body == none) return false;
  const Body& own = grammar.bodies[body];
  for (std::uint32_t b = 0; b < own.branch_count; ++b) {
    const Branch& branch = grammar.branches[own.first_branch + b];
    for (std::uint32_t c = 0; c < branch.choice_count; ++c) {
      const Choice& choice = grammar.choices[branch.first_choice + c];
      for (std::uint32_t s = 0; s < choice.step_count; ++s) {
        const Step& step = grammar.steps[choice.first_step + s];
        if (is_division(step.op)) return true;
        for (std::uint32_t p = 0; p < step.part_count; ++p) {
          if (divides(grammar, grammar.parts[step.first_part + p].body, seen)) return true;
        }
        if (step.op != Op::symbol || step.is_leaf || !seen.emplace(step.symbol).second) continue;
        for (const std::uint32_t rule : grammar.symbols[step.symbol].rules) {
          if (divides(grammar, grammar.rules[rule].body, seen)) return true;
        }
      }
    }
  }
  return false;
}

}  // namespace

/// inline(append | unify | recompose) operation
void inline_shapes(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  const std::string mode = word_or(d, step, 0, "append");
  if (mode != "append" && mode != "unify" && mode != "recompose")
    reject(d, step.offset, "found " + lang::in_quotes(mode) + ", expected append, unify or recompose");
  const UnionMode joining = mode == "unify"       ? UnionMode::unify
                            : mode == "recompose" ? UnionMode::recompose
                                                  : UnionMode::append;
  const ShapeState given = state;
  const std::vector<Shape> leaves = leaves_of(d, d.grammar.parts[step.first_part].body, given, site, 0);
  take_joined(d, step, state, leaves, united_solid(d, step.offset, given, leaves, joining));
}

/// union, subtract and intersect { A | B }
void combine(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  const ShapeState given = state;
  Solid operands[2];
  std::vector<Shape> first;
  for (std::uint32_t i = 0; i < 2; ++i) {
    const std::vector<Shape> leaves = leaves_of(d, d.grammar.parts[step.first_part + i].body, given, site, i);
    operands[i] = united_solid(d, step.offset, given, leaves, UnionMode::unify);
    if (i == 0) first = leaves;
    const std::uint32_t tag = with_tag(d, 0, i == 0 ? "bool.A" : "bool.B");
    for (Face& face : operands[i].faces) face.tags = joined_tags(d, face.tags, tag);
  }
  if (operands[0].faces.size() + operands[1].faces.size() > most_faces)
    reject(d, step.offset, "the Boolean operation has more than 20,000 faces");
  const BooleanKind kind = step.op == Op::unite      ? BooleanKind::unite
                           : step.op == Op::subtract ? BooleanKind::subtract
                                                     : BooleanKind::intersect;
  Solid made;
  if (operands[0].faces.empty() || operands[1].faces.empty()) {
    if (kind == BooleanKind::unite) made = operands[0].faces.empty() ? operands[1] : operands[0];
    if (kind == BooleanKind::subtract) made = operands[0];
  } else if (std::optional<Solid> flat = flat_boolean(operands[0], operands[1], kind, d.job)) {
    made = std::move(*flat);
  } else {
    if (!operands[0].is_closed || !operands[1].is_closed) {
      warn(d, step.offset,
           "an operand of a Boolean operation is not a closed solid, so the result may be wrong");
    }
    made = boolean(operands[0], operands[1], kind, d.job);
    if (!made.faces.empty() && !made.is_closed)
      warn(d, step.offset, "the result of the Boolean operation is not closed");
  }
  take_joined(d, step, state, first, std::move(made));
}

/// modify(f){ top: s('0.5, '1, '0.5) X. }: the corners of a component move with its scope. Other geometry takes the place
/// of a face; without any, a hole stays.
void modify(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  if (state.has_asset() || dimension(state.size) < 2)
    return warn(d, step.offset, "modify needs a shape with faces; this one does not change");
  const ShapeState given = state;
  const glm::dmat3 axes = d.out.axes[given.axes], back = glm::transpose(axes);
  Solid solid = welded(solid_in_metres(d, given), 0);
  const double near = 1e-6 * std::max({given.size.x, given.size.y, given.size.z});
  std::vector<glm::dvec3> moved(solid.points.size(), glm::dvec3(0));
  const std::vector<Component> all = components_of(d, given, step.axis);
  std::vector<std::uint8_t> is_taken(all.size(), 0), is_replaced(solid.faces.size(), 0);
  Solid added;
  for (std::uint32_t p = 0; p < step.part_count; ++p) {
    const Part& part = d.grammar.parts[step.first_part + p];
    std::int32_t number = 0;
    std::set<std::uint32_t> seen;
    const bool is_divided = divides(d.grammar, part.body, seen);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!part.condition.is_given && (all[i].classes[part.frame] & part.classes) == 0) continue;
      const std::int32_t own = part.index == -2 ? static_cast<std::int32_t>(i) : number++;
      if (is_taken[i] != 0 || !is_selected(d, part, all[i], own, site.frame.shape)) continue;
      is_taken[i] = 1;
      const ShapeState& before = all[i].state;
      d.job.check();
      const std::vector<Shape> leaves = leaves_of(d, part.body, before, site, key_at(p, i));
      const bool is_moved = !is_divided && leaves.size() == 1 && leaves[0].geometry == before.geometry &&
                            dimension(leaves[0].size) == dimension(before.size);
      if (step.axis == component_faces && !is_moved) {
        if (const std::size_t face = face_of(d, solid, given, before, near); face < is_replaced.size())
          is_replaced[face] = 1;
        append(added, united_solid(d, step.offset, given, leaves, UnionMode::append));
        continue;
      }
      if (leaves.size() != 1) {
        if (!leaves.empty()) {
          warn(d, step.offset,
               "modify moves edges and corners; operations that make other geometry of them have no effect");
        }
        continue;
      }
      const glm::dmat3 from = glm::transpose(d.out.axes[before.axes]), to = d.out.axes[leaves[0].axes];
      for (std::size_t k = 0; k < solid.points.size(); ++k) {
        const glm::dvec3 world = given.origin + axes * solid.points[k];
        glm::dvec3 share = from * (world - before.origin);
        bool is_in = true;
        for (int axis = 0; axis < 3; ++axis) {
          is_in &= share[axis] >= -near && share[axis] <= before.size[axis] + near;
          share[axis] = before.size[axis] > 0 ? share[axis] / before.size[axis] : 0;
        }
        if (is_in) moved[k] += back * (leaves[0].origin + to * (share * leaves[0].size) - world);
      }
    }
  }
  for (std::size_t k = 0; k < moved.size(); ++k) solid.points[k] += moved[k];
  if (std::ranges::any_of(is_replaced, [](std::uint8_t each) { return each != 0; })) {
    std::vector<Face> kept;
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      if (is_replaced[f] == 0) kept.push_back(solid.faces[f]);
    }
    solid.faces = std::move(kept);
    append(solid, added);
    solid = recomposed(solid, d.job);
  } else if (given.geometry == box_geometry && dimension(given.size) == 3) {
    solid.is_closed = true;
  }
  take_solid(d, state, std::move(solid));
}

}  // namespace seedmesh::building::operators
