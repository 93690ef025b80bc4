/// Operations on texture coordinates, which are projections (projections.h). Definitions as in the CGA reference.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/projections.h"

namespace seedmesh::building::operators {
namespace {

/// Whether the coordinates of a set can be changed: those of a flat shape, or of a projection. Others differ from face to
/// face, which gives a warning.
bool can_change(Derivation& d, const Step& step, const ShapeState& state, int set) {
  if (dimension(state.size) == 2 || has_projection(d, state, set)) return true;
  if (dimension(state.size) == 3) {
    warn(d, step.offset,
         "the faces of this solid have texture coordinates of their own, which this operation cannot change; "
         "use it after comp(f) or setupProjection");
  }
  return false;
}

/// u' = a u + b v + c and v' likewise.
Projection combined(const Projection& p, const glm::dvec3& u, const glm::dvec3& v) {
  Projection out;
  out.u = u.x * p.u + u.y * p.v;
  out.u_at = u.x * p.u_at + u.y * p.v_at + u.z;
  out.v = v.x * p.u + v.y * p.v;
  out.v_at = v.x * p.u_at + v.y * p.v_at + v.z;
  return out;
}

/// The name of a file without directories and ending, as a name of `materials`: letters, digits and underscores.
std::string material_of_file(std::string path) {
  if (const std::size_t slash = path.find_last_of("/\\"); slash != std::string::npos)
    path = path.substr(slash + 1);
  if (const std::size_t dot = path.find_last_of('.'); dot != std::string::npos && dot > 0) path.resize(dot);
  for (char& c : path) {
    const bool is_kept = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (!is_kept) c = '_';
  }
  if (!path.empty() && path[0] >= '0' && path[0] <= '9') path.insert(path.begin(), '_');
  return path;
}

}  // namespace

void texture(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const std::string path = text_of(d, argument_at(d, step, 0));
  use_image(d, step, state, path);
}

/// scaleUV(set, u, v), rotateUV(set, angle) and translateUV(set, u, v)
void change_uv(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const int set = uv_set_at(d, step, 0);
  if (!can_change(d, step, state, set)) return;
  const Projection before = projection_of(d, state, set);
  if (step.op == Op::rotate_uv) {
    const math::SinCos turn = math::sincos_degrees(number_or(d, step, 1, 0));
    use_projection(d, state, set, combined(before, {turn.cos, -turn.sin, 0}, {turn.sin, turn.cos, 0}));
    return;
  }
  const double u = number_or(d, step, 1, 0), v = number_or(d, step, 2, 0);
  use_projection(d, state, set,
                 step.op == Op::scale_uv ? combined(before, {u, 0, 0}, {0, v, 0})
                                         : combined(before, {1, 0, u}, {0, 1, v}));
}

/// normalizeUV(set, u | v | uv, separatePerFace | collectiveAllFaces)
void normalize_uv(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const int set = uv_set_at(d, step, 0);
  if (!can_change(d, step, state, set)) return;
  const std::string axes = word_or(d, step, 1, "uv"), kind = word_or(d, step, 2, "collectiveAllFaces");
  if (axes != "u" && axes != "v" && axes != "uv")
    reject(d, step.offset, "found " + lang::in_quotes(axes) + ", expected u, v or uv");
  if (kind != "separatePerFace" && kind != "collectiveAllFaces") {
    reject(d, step.offset,
           "found " + lang::in_quotes(kind) + ", expected separatePerFace or collectiveAllFaces");
  }
  const UvRange range = uv_range(d, state, set);
  glm::dvec3 u(1, 0, 0), v(0, 1, 0);
  const double wide = range.high[0] - range.low[0], high = range.high[1] - range.low[1];
  if (axes != "v" && wide > 0) u = {1 / wide, 0, -range.low[0] / wide};
  if (axes != "u" && high > 0) v = {0, 1 / high, -range.low[1] / high};
  use_projection(d, state, set, combined(projection_of(d, state, set), u, v));
}

/// tileUV(set, width, height): tiles of a size in metres from the lowest corner. 0 keeps the coordinate.
void tile_uv(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const int set = uv_set_at(d, step, 0);
  if (!can_change(d, step, state, set)) return;
  const UvRange range = uv_range(d, state, set);
  glm::dvec3 out[2] = {{1, 0, 0}, {0, 1, 0}};
  for (std::uint32_t i = 0; i < 2; ++i) {
    const Argument& argument = argument_at(d, step, 1 + i);
    double tile = number_of(d, argument.value);
    const double metres = (range.high[i] - range.low[i]) * range.metres[i];
    if (argument.measure == Measure::relative) tile *= metres;
    if (tile < 0)
      reject(d, argument.value.offset, "found a tile of " + text_of_number(tile) + " m, expected 0 or more");
    if (tile == 0 || !(metres > 0)) continue;
    if (argument.measure == Measure::floating) tile = metres / std::max(1.0, std::floor(metres / tile + 0.5));
    const double scale = range.metres[i] / tile;
    out[i] = glm::dvec3(0);
    out[i][static_cast<int>(i)] = scale;
    out[i].z = -range.low[i] * scale;
  }
  use_projection(d, state, set, combined(projection_of(d, state, set), out[0], out[1]));
}

void copy_uv(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const int from = uv_set_at(d, step, 0), to = uv_set_at(d, step, 1);
  if (can_change(d, step, state, from)) use_projection(d, state, to, projection_of(d, state, from));
}

void delete_uv(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const int set = uv_set_at(d, step, 0);
  for (const bool is_applied : {true, false}) set_projection_id(d, state, set, is_applied, 0);
}

}  // namespace seedmesh::building::operators

namespace seedmesh::building {

void use_image(Derivation& d, const Step& step, ShapeState& state, const std::string& path) {
  if (path.empty()) return;
  const std::string name = operators::material_of_file(path);
  Style style = d.out.styles[state.style];
  style.material = d.out.texts.id_of(name);
  state.style = style_with(d, style);
  if (!std::ranges::binary_search(d.task.files, name)) {
    warn(d, step.offset,
         "the request has no material " + lang::in_quotes(name) + ", whose image would replace " +
             lang::in_quotes(path) + "; shapes have the plain material of this name");
  }
}

}  // namespace seedmesh::building
