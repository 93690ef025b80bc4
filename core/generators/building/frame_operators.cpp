/// Operations that move and rotate the scope in other frames than its own.
#include <algorithm>

#include "core/generators/building/evaluate.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/shape_grammar/rotation.h"

namespace seedmesh::building::operators {
namespace {

struct FrameWords {
  bool is_absolute = false, is_scope = true;
};

FrameWords frame_words(Derivation& d, const Step& step) {
  FrameWords out;
  const std::string mode = word_at(d, step, 0);
  const std::string frame = word_at(d, step, 1);
  if (mode != "rel" && mode != "abs")
    reject(d, step.offset, "found " + lang::in_quotes(mode) + ", expected rel or abs");
  if (frame != "scope" && frame != "pivot" && frame != "object" && frame != "world")
    reject(d, step.offset, "found " + lang::in_quotes(frame) + ", expected scope, pivot, object or world");
  out.is_absolute = mode == "abs";
  out.is_scope = frame == "scope" || frame == "pivot";
  return out;
}

}  // namespace

void translate_in(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const FrameWords words = frame_words(d, step);
  const Argument* a = &d.grammar.arguments[step.first_argument + 2];
  glm::dvec3 by(0);
  for (int axis = 0; axis < 3; ++axis) by[axis] = length_of(d, a[axis], state.size[axis]);
  const glm::dmat3& axes = d.out.axes[state.axes];
  if (words.is_absolute && !words.is_scope) {
    state.origin = by;
  } else {
    state.origin += words.is_scope ? axes * by : by;
  }
}

void rotate_in(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const FrameWords words = frame_words(d, step);
  const Argument* a = &d.grammar.arguments[step.first_argument + 2];
  glm::dvec3 angles(0);
  for (int axis = 0; axis < 3; ++axis) angles[axis] = number_of(d, a[axis].value);
  const glm::dmat3 before = d.out.axes[state.axes], m = rotation_xyz(angles);
  state.axes = add_axes(d, words.is_absolute ? m : words.is_scope ? before * m : m * before);
}

void rotate_scope(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const Argument* a = &d.grammar.arguments[step.first_argument];
  glm::dvec3 angles(0);
  for (int axis = 0; axis < 3; ++axis) angles[axis] = number_of(d, a[axis].value);
  reframe(d, state, d.out.axes[state.axes] * rotation_xyz(angles));
}

/// setPivot(xzy, 0): the axes in another order. The last one follows from the right hand.
void set_pivot(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const std::string order = word_at(d, step, 0);
  std::string sorted = order;
  std::ranges::sort(sorted);
  if (sorted != "xyz")
    reject(d, step.offset, "found " + lang::in_quotes(order) + ", expected an order of axes such as xzy");
  if (step.argument_count > 1 && number_of(d, d.grammar.arguments[step.first_argument + 1].value) != 0)
    warn(d, step.offset, "the corner of setPivot has no effect, because shapes have no pivot");
  const glm::dmat3 before = d.out.axes[state.axes];
  glm::dmat3 axes(1);
  axes[0] = before[order[0] - 'x'];
  axes[1] = before[order[1] - 'x'];
  axes[2] = glm::cross(axes[0], axes[1]);
  reframe(d, state, axes);
}

}  // namespace seedmesh::building::operators
