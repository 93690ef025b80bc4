/// Operations that make one shape of several: inline, modify, union, subtract and intersect. Definitions as in the CGA
/// reference.
#include <algorithm>
#include <cmath>
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
std::vector<Shape> leaves_of(Derivation& d, std::uint32_t body, const ShapeState& state, const Site& site,
                             std::uint64_t place) {
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
        warn(d, step.offset, "the shapes that become one have different materials; it has the first of them");
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

}  // namespace

/// inline(append | unify | recompose) operation
void inline_shapes(Derivation& d, const Step& step, ShapeState& state, const Site& site) {
  const std::string mode = word_or(d, step, 0, "append");
  if (mode != "append" && mode != "unify" && mode != "recompose")
    reject(d, step.offset, "found " + lang::in_quotes(mode) + ", expected append, unify or recompose");
  const Joining joining = mode == "unify"       ? Joining::unify
                          : mode == "recompose" ? Joining::recompose
                                                : Joining::append;
  const ShapeState given = state;
  const std::vector<Shape> leaves = leaves_of(d, d.grammar.parts[step.first_part].body, given, site, 0);
  take_joined(d, step, state, leaves, united_solid(d, step.offset, given, leaves, joining));
}

/// union, subtract and intersect { A | B }
void combine(Derivation& d, const Step& step, ShapeState& state, const Site& site) {
  const ShapeState given = state;
  Solid operands[2];
  std::vector<Shape> first;
  for (std::uint32_t i = 0; i < 2; ++i) {
    const std::vector<Shape> leaves = leaves_of(d, d.grammar.parts[step.first_part + i].body, given, site, i);
    operands[i] = united_solid(d, step.offset, given, leaves, Joining::unify);
    if (i == 0) first = leaves;
    if (!operands[i].faces.empty() && !operands[i].is_closed) {
      warn(d, step.offset,
           "an operand of a Boolean operation is no closed solid, so that the result may be wrong");
    }
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
  } else {
    made = boolean(operands[0], operands[1], kind, d.job);
    if (!made.faces.empty() && !made.is_closed)
      warn(d, step.offset, "the result of the Boolean operation is not closed");
  }
  take_joined(d, step, state, first, std::move(made));
}

/// modify(f){ top: s('0.5, '1, '0.5) X. }: the corners of a component move with its scope; a component that is removed leaves a
/// hole.
void modify(Derivation& d, const Step& step, ShapeState& state, const Site& site) {
  if (state.has_asset() || dimension(state.size) < 2)
    return warn(d, step.offset, "modify needs faces, and leaves this shape as it is");
  const ShapeState given = state;
  const glm::dmat3 axes = d.out.axes[given.axes], back = glm::transpose(axes);
  Solid solid = welded(solid_in_metres(d, given), 0);
  const double near = 1e-6 * std::max({given.size.x, given.size.y, given.size.z});
  std::vector<glm::dvec3> moved(solid.points.size(), glm::dvec3(0));
  const std::vector<Component> all = components_of(d, given, step.axis);
  std::vector<std::uint8_t> is_taken(all.size(), 0), is_removed(solid.faces.size(), 0);
  for (std::uint32_t p = 0; p < step.part_count; ++p) {
    const Part& part = d.grammar.parts[step.first_part + p];
    std::int32_t number = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!part.condition.is_given && (all[i].classes[part.frame] & part.classes) == 0) continue;
      const std::int32_t own = part.index == -2 ? static_cast<std::int32_t>(i) : number++;
      if (is_taken[i] != 0 || !is_selected(d, part, all[i], own, site.frame.shape)) continue;
      is_taken[i] = 1;
      const ShapeState& before = all[i].state;
      d.job.check();
      const std::vector<Shape> leaves = leaves_of(d, part.body, before, site, key_at(p, i));
      if (leaves.empty() && step.axis == component_faces && i < is_removed.size()) is_removed[i] = 1;
      if (leaves.size() != 1 || (leaves[0].geometry != before.geometry && step.axis == component_faces)) {
        if (!leaves.empty()) {
          warn(d, step.offset,
               "modify moves components; operations that make other geometry of them have no effect");
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
  if (std::ranges::any_of(is_removed, [](std::uint8_t each) { return each != 0; })) {
    std::vector<Face> kept;
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      if (is_removed[f] == 0) kept.push_back(solid.faces[f]);
    }
    solid.faces = std::move(kept);
    solid.is_closed = false;
  } else if (given.geometry == box_geometry && dimension(given.size) == 3) {
    solid.is_closed = true;
  }
  take_solid(d, state, std::move(solid));
}

}  // namespace seedmesh::building::operators
