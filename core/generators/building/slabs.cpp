#include "core/generators/building/slabs.h"

#include <algorithm>
#include <cmath>

#include "core/generators/building/evaluate.h"

namespace seedmesh::building {

std::optional<ShapeState> slab_of(Derivation& d, const ShapeState& state, int axis, const Cut& cut,
                                  bool keeps_slab) {
  ShapeState piece = state;
  if (state.geometry == box_geometry) {
    piece.origin = state.origin + d.out.axes[state.axes][axis] * cut.start;
    piece.size[axis] = cut.size;
    return piece;
  }
  const Solid& solid = d.out.solid_of(state.geometry);
  const double whole = state.size[axis];
  const double low = cut.start / whole, high = (cut.start + cut.size) / whole;
  Solid part = low > 1e-12 ? clipped(solid, axis, low, -1) : solid;
  if (high < 1 - 1e-12) part = clipped(part, axis, high, 1);
  if (part.faces.empty()) return std::nullopt;
  glm::dvec3 from, extent;
  if (keeps_slab) {
    // The slab stays the scope: its share of the old cube is stretched over the new one.
    for (glm::dvec3& p : part.points) p[axis] = std::clamp((p[axis] - low) / (high - low), 0.0, 1.0);
    from = glm::dvec3(0);
    extent = glm::dvec3(1);
    from[axis] = low;
    extent[axis] = high - low;
  } else {
    fit(part, from, extent);
  }
  piece.origin = state.origin + d.out.axes[state.axes] * (from * state.size);
  piece.size = extent * state.size;
  piece.geometry = add_solid(d, std::move(part));
  return piece;
}

std::vector<Cut> stack_of(Derivation& d, const Choice& choice, const ShapeState& state, const Frame& frame) {
  constexpr double rounding = 1e-9;
  const Shape& shape = d.out.shapes[frame.shape];
  if (shape.parameter_count != 1 || state.has_asset()) return {};
  const lang::TaggedValue height = d.out.parameters[shape.first_parameter];
  const double whole = state.size.y;
  if (height.is_text() || !(whole > 0) || !(std::abs(height.number - whole) <= rounding * whole)) return {};
  std::vector<Cut> cuts;
  double sum = 0;
  look_at(d, state, frame.shape);
  for (std::uint32_t i = 0; i < choice.step_count; ++i) {
    const Step& step = d.grammar.steps[choice.first_step + i];
    d.random = Rng(key_at(frame.key, i));
    const lang::TaggedValue value = number_or_text(d, d.grammar.arguments[step.first_argument].value);
    if (value.is_text() || !(value.number > 0)) return {};
    cuts.push_back({sum, value.number, i});
    sum += value.number;
  }
  if (!(std::abs(sum - whole) <= rounding * whole)) return {};
  return cuts;
}

}  // namespace seedmesh::building
